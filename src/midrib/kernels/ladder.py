"""The ladder of a slope: directions of chords along its middle line, calm and nearly normal.

Rungs follow each other at an eighth of the gap that the local width asks for. Their directions
theta minimise

    integral of (theta - n)^2 + (stiffness w)^4 (d2 theta / d tau2)^2  over the middle line,

a compromise between being normal to the middle line (n), which halves the angle between the
normals of top and toe, and turning steadily: the smoothing spline of n. Discretised it is a
system of five diagonals with one solution. Steady bends it leaves as they are. A corner of angle A
is turned by at most A / (2.8 stiffness w) per unit of length, and two widths from it next to
nothing is left of it; what is much shorter than w is evened out.

tau       arc length along the middle line
w         length of the chord
l         local width, twice the distance from the line to the edges; l <= w
b         gap that the rule asks for: clamp(factor min(w, 1.5 l), least, most)
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.chain import Chain
from midrib.kernels.chords import ON_TOP, Chord, Ground, ground_of, locate, shoot
from midrib.kernels.gauging import MOST_TILT, Course, direction_on, is_straight
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.local import local_width
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import walk
from midrib.kernels.tables import with_rows
from midrib.types import Floats, Ints

__all__ = [
    "Ladder",
    "Spacing",
    "Strokes",
    "build_ladder",
    "draw_strokes",
    "draw_turned",
    "effective",
    "follow",
    "gap_at",
    "turn_rungs",
]

RUNGS = 8.0  # for each gap
MOST_RUNGS = 2**24
WHOLE_TURN = 2.0 * np.pi
FAR = 24.0  # stiffness w: e^(-24 / 1.41), so little is left of what the ends of a spline do
MOST_COPIES = 64
MOST_OFF = 0.8 * MOST_TILT  # so that some is left for what evening out does to directions
TAU, X, Y, NORMAL, THETA, WIDTH, GAP, LOCAL = range(8)
MOST_LOCAL = (
    1.5  # local widths: longer strokes ask for no wider gaps; at corners of 120 degrees, all do
)


class Spacing(NamedTuple):
    """The rule for gaps, in ground units; factor 0 for gaps of ``least`` throughout."""

    factor: float
    least: float
    most: float


class Ladder(NamedTuple):
    """Rungs along a middle line; of a closed one, the last is the first again."""

    ground: Ground
    top: Chain
    toe: Chain
    crest: Course  # the top
    line: Floats  # (m, 2) the middle line
    arc: Floats  # (m,) stations of its vertices
    rungs: Floats  # (n, 8) tau, x, y, normal, theta, width, gap, local width
    at: Ints  # (n, 2) triangle of the pivot, segment of the line


class Strokes(NamedTuple):
    """Whole strokes: pivots, what they aim at, and their chords."""

    pivot: Floats  # (n, 7) tau, x, y, calm direction, chosen one, gap, local width
    triangle: Ints  # (n,) of the pivot
    chord: Floats  # (n, 7) s, t, top x, y, toe x, y, width
    on: Ints  # (n, 2) the edges that the two ends lie on


@njit(borrows=True)
def gap_at(rule: Spacing, width: float) -> float:
    """Gap that the rule asks for where strokes are so long."""
    return min(max(rule.factor * width, rule.least), rule.most)


@njit(borrows=True)
def effective(width: float, local: float) -> float:
    """Length of a stroke as the rule takes it: of the local width so many times at most."""
    return min(width, MOST_LOCAL * local)


@njit(borrows=True)
def point_at(line: Floats, arc: Floats, k: int, tau: float) -> tuple[int, float, float]:
    """Segment of a line on which a station lies, looked for from segment k on, and the point."""
    while k + 2 < arc.size and arc[k + 1] < tau:
        k += 1
    while k > 0 and arc[k] > tau:
        k -= 1
    share = min(max((tau - arc[k]) / (arc[k + 1] - arc[k]), 0.0), 1.0)
    x = line[k, 0] + share * (line[k + 1, 0] - line[k, 0])
    y = line[k, 1] + share * (line[k + 1, 1] - line[k, 1])
    return k, x, y


@njit(borrows=True)
def follow(
    mesh: Mesh, line: Floats, arc: Floats, t: int, k: int, x: float, y: float, tau: float
) -> tuple[int, int, float, float]:
    """Walk along the line from (x, y) in triangle t on segment k to a station farther on.

    A vertex that lies on the boundary up to rounding may end the walk in the triangle before it,
    from where a chord is found as well.
    """
    while k + 2 < arc.size and arc[k + 1] < tau:
        k += 1
        t, _ = walk(mesh, t, -1, x, y, line[k, 0], line[k, 1])
        x, y = line[k, 0], line[k, 1]
    _, new_x, new_y = point_at(line, arc, k, tau)
    t, _ = walk(mesh, t, -1, x, y, new_x, new_y)
    return t, k, new_x, new_y


@njit(borrows=True)
def normal_at(line: Floats, arc: Floats, k: int, tau: float, half: float, is_closed: bool) -> float:
    """Direction to the left of the line between the points ``half`` before and after a station."""
    total = arc[arc.size - 1]
    low, high = tau - half, tau + half
    if is_closed:
        low, high = low % total, high % total
    else:
        low, high = max(low, 0.0), min(high, total)
    _, ax, ay = point_at(line, arc, k, low)
    _, bx, by = point_at(line, arc, k, high)
    return np.arctan2(bx - ax, ay - by)


@njit(borrows=True)
def upright(top: Course, station: float, width: float, normal: float) -> float:
    """Direction at most ``MOST_OFF`` from the top's own normal where that is straight.

    Edges that converge steeply have no direction normal to both.
    """
    off = normal - np.pi / 2.0 - direction_on(top, station, width)
    off -= WHOLE_TURN * np.round(off / WHOLE_TURN)
    if not abs(off) > MOST_OFF or not is_straight(top, station, width):
        return normal
    return normal - (abs(off) - MOST_OFF) * np.sign(off)


@njit(borrows=True)
def point_of(mesh: Mesh, chain: Chain, station: float, is_closed: bool) -> tuple[float, float]:
    """Point of a chain at a station, which goes round a closed one."""
    arc = chain.arc
    m = arc.size
    at = station % arc[m - 1] if is_closed else min(max(station, 0.0), arc[m - 1])
    k = min(max(np.searchsorted(arc, at, side="right") - 1, 0), m - 2)
    share = min((at - arc[k]) / (arc[k + 1] - arc[k]), 1.0)
    a, b = chain.vertex[k], chain.vertex[k + 1]
    x = mesh.x[a] + share * (mesh.x[b] - mesh.x[a])
    return x, mesh.y[a] + share * (mesh.y[b] - mesh.y[a])


@njit()
def spline(tau: Floats, normal: Floats, reach: Floats) -> Floats:
    """Directions that minimise the integral above; ``reach`` is stiffness w at each rung. O(n).

    What is solved for is how far they are off the normals: nothing at all where these bend
    steadily, without rounding.
    """
    n = tau.size
    matrix, off = np.zeros((n, 3)), np.zeros(n)  # row i: columns i, i + 1, i + 2
    for i in range(n - 1):
        step = tau[i + 1] - tau[i]
        matrix[i, 0] += step / 2.0
        matrix[i + 1, 0] += step / 2.0
    for i in range(1, n - 1):
        before, after = tau[i] - tau[i - 1], tau[i + 1] - tau[i]
        mean = (before + after) / 2.0
        first, last = 1.0 / (before * mean), 1.0 / (after * mean)
        middle, weight = -(first + last), reach[i] ** 4 * mean
        matrix[i - 1, 0] += weight * first * first
        matrix[i - 1, 1] += weight * first * middle
        matrix[i - 1, 2] += weight * first * last
        matrix[i, 0] += weight * middle * middle
        matrix[i, 1] += weight * middle * last
        matrix[i + 1, 0] += weight * last * last
        bend = (normal[i + 1] - normal[i]) / after - (normal[i] - normal[i - 1]) / before
        off[i - 1] -= weight * first * bend / mean
        off[i] -= weight * middle * bend / mean
        off[i + 1] -= weight * last * bend / mean
    # Cholesky without roots: each row is subtracted from the two below it.
    for i in range(n):
        for k in range(1, min(3, n - i)):
            share = matrix[i, k] / matrix[i, 0]
            for column in range(k, 3):
                matrix[i + k, column - k] -= share * matrix[i, column]
            off[i + k] -= share * off[i]
    for i in range(n - 1, -1, -1):
        for k in range(1, min(3, n - i)):
            off[i] -= matrix[i, k] * off[i + k]
        off[i] /= matrix[i, 0]
    for i in range(n):
        off[i] += normal[i]
    return off


@njit()
def calm_down(rungs: Floats, n: int, total: float, stiffness: float, is_closed: bool) -> None:
    """Write calm directions to the first n rungs.

    A closed line is unrolled so far both ways that its ends make no difference to one turn.
    """
    copies, turn = 0, 0.0
    if is_closed:
        widest = 0.0
        for i in range(n):
            widest = max(widest, rungs[i, WIDTH])
        copies = int(min(np.ceil(FAR * stiffness * widest / total), MOST_COPIES))
        turn = np.round((rungs[n - 1, NORMAL] - rungs[0, NORMAL]) / WHOLE_TURN) * WHOLE_TURN
    m = (2 * copies + 1) * n
    tau, normal, reach = np.empty(m), np.empty(m), np.empty(m)
    for i in range(m):
        copy, k = i // n - copies, i % n
        tau[i] = rungs[k, TAU] + copy * total
        normal[i] = rungs[k, NORMAL] + copy * turn
        reach[i] = stiffness * rungs[k, WIDTH]
    theta = spline(tau, normal, reach)
    for i in range(n):
        rungs[i, THETA] = theta[copies * n + i]


@njit(entry=True)
def build_ladder(
    mesh: Mesh,
    top: Chain,
    toe: Chain,
    line: Floats,
    rule: Spacing,
    stiffness: float,
    top_share: float,
) -> Ladder:
    """Build the ladder of a slope.

    Parameters
    ----------
    mesh : the slope
    top, toe : its edges, the top with the area on its left, the toe beside it
    line : (m, 2) the middle line beside them, closed if its last point is its first
    rule : how wide gaps are, in ground units
    stiffness : lengths of the chord over which directions are evened out
    top_share : 0 for normals of the line, 1 for those of the top, between them in proportion

    Returns
    -------
    Ladder
        Of n rungs in O(n + m) steps through triangles, for a slope that is long and not wide.
    """
    ground = ground_of(mesh, top, toe)
    m = line.shape[0]
    arc = np.zeros(m)
    for i in range(1, m):
        arc[i] = arc[i - 1] + length(line[i, 0] - line[i - 1, 0], line[i, 1] - line[i - 1, 1])
    total = arc[m - 1]
    is_closed = line[0, 0] == line[m - 1, 0] and line[0, 1] == line[m - 1, 1]
    rungs, at = np.empty((256, 8)), np.empty((256, 2), np.intp)
    crest = Course(np.column_stack((mesh.x[top.vertex], mesh.y[top.vertex])), top.arc, is_closed)
    # 1. Rungs at right angles to the line, as far apart as the last one asks for.
    tau, k, x, y = 0.0, 0, line[0, 0], line[0, 1]
    t = locate(mesh, x, y)
    n, gap, near = 0, rule.least, np.zeros((2, 2))
    while n < MOST_RUNGS:
        if n + 1 >= rungs.shape[0]:
            rungs, at = with_rows(rungs, 2 * n + 2), with_rows(at, 2 * n + 2)
        normal = normal_at(line, arc, k, tau, gap / 2.0, is_closed)
        chord = shoot(ground, t, x, y, normal)
        local = local_width(mesh, top, toe, near, chord, x, y, is_closed)
        width = effective(chord.width, local)
        if n > 0 or is_closed:  # a chord from the end of an open line may lie along the boundary
            gap = gap_at(rule, width)
        if top_share > 0.0 and chord.top_on == ON_TOP:
            ax, ay = point_of(mesh, top, chord.s - gap / 2.0, is_closed)
            bx, by = point_of(mesh, top, chord.s + gap / 2.0, is_closed)
            off = np.arctan2(bx - ax, ay - by) - normal
            normal += top_share * (off - WHOLE_TURN * np.round(off / WHOLE_TURN))
        if chord.top_on == ON_TOP:
            normal = upright(crest, chord.s, width, normal)
        if n > 0:
            normal += WHOLE_TURN * np.round((rungs[n - 1, NORMAL] - normal) / WHOLE_TURN)
        rungs[n, TAU], rungs[n, X], rungs[n, Y] = tau, x, y
        rungs[n, NORMAL], rungs[n, WIDTH] = normal, width
        rungs[n, LOCAL] = local
        at[n, 0], at[n, 1] = t, k
        n += 1
        if tau == total:
            break
        tau += gap / RUNGS
        if tau > total - gap / (2.0 * RUNGS):
            tau = total
        if tau == total and is_closed:
            break
        t, k, x, y = follow(mesh, line, arc, t, k, x, y, tau)
    # 2. Calm directions; the closing rung is the first one after whole turns.
    calm_down(rungs, n, total, stiffness, is_closed)
    if is_closed:
        for column in range(8):
            rungs[n, column] = rungs[0, column]
        turn = np.round((rungs[n - 1, NORMAL] - rungs[0, NORMAL]) / WHOLE_TURN) * WHOLE_TURN
        rungs[n, TAU], rungs[n, THETA] = total, rungs[0, THETA] + turn
        rungs[n, NORMAL] = rungs[0, NORMAL] + turn
        at[n, 0], at[n, 1] = at[0, 0], m - 2
        n += 1
    # 3. Gaps, by the chords in these directions.
    ladder = Ladder(
        ground, top, toe, crest, line, arc, with_rows(rungs[:n], n), with_rows(at[:n], n)
    )
    measure_gaps(ladder, rule, np.full(n, np.nan))
    return ladder


@njit(borrows=True)
def measure_gaps(ladder: Ladder, rule: Spacing, known: Floats) -> None:
    """Write the lengths of the chords of all rungs, and the gaps they ask for.

    What has the ``known`` direction has its length already.
    """
    rungs, line = ladder.rungs, ladder.line
    n, m = rungs.shape[0], line.shape[0]
    for i in range(n):
        x, y, theta = rungs[i, X], rungs[i, Y], rungs[i, THETA]
        if theta == known[i]:
            continue
        chord = shoot(ladder.ground, ladder.at[i, 0], x, y, theta)
        width = effective(chord.width, rungs[i, LOCAL])
        rungs[i, WIDTH], rungs[i, GAP] = width, gap_at(rule, width)
    if line[0, 0] != line[m - 1, 0] or line[0, 1] != line[m - 1, 1]:  # open: see build_ladder
        for i, beside in ((0, 1), (n - 1, n - 2)):
            rungs[i, WIDTH], rungs[i, GAP] = rungs[beside, WIDTH], rungs[beside, GAP]
            rungs[i, LOCAL] = rungs[beside, LOCAL]


@njit(entry=True)
def turn_rungs(ladder: Ladder, theta: Floats, rule: Spacing) -> Ladder:
    """Return the ladder with other directions of its rungs, and the gaps that they ask for."""
    rungs = with_rows(ladder.rungs, ladder.rungs.shape[0])
    known = rungs[:, THETA].copy()
    rungs[:, THETA] = theta
    turned = Ladder(
        ladder.ground, ladder.top, ladder.toe, ladder.crest, ladder.line, ladder.arc, rungs,
        ladder.at,
    )  # fmt: skip
    measure_gaps(turned, rule, known)
    return turned


@njit(borrows=True)
def write_chord(strokes: Strokes, i: int, chord: Chord) -> None:
    """Write a chord to a row."""
    row = strokes.chord
    row[i, 0], row[i, 1] = chord.s, chord.t
    row[i, 2], row[i, 3], row[i, 4], row[i, 5] = chord.top_x, chord.top_y, chord.toe_x, chord.toe_y
    row[i, 6] = chord.width
    strokes.on[i, 0], strokes.on[i, 1] = chord.top_on, chord.toe_on


@njit(entry=True)
def draw_strokes(ladder: Ladder, stations: Floats, rule: Spacing) -> Strokes:
    """Draw whole strokes at stations, in increasing order, in the ladder's directions; O(n).

    An end that lies on the wrong edge is for ``mend`` to see to.
    """
    return draw_turned(ladder, stations, np.zeros(stations.size), rule)


@njit(entry=True)
def draw_turned(ladder: Ladder, stations: Floats, turns: Floats, rule: Spacing) -> Strokes:
    """Draw whole strokes at stations, in increasing order, turned from the ladder's directions."""
    rungs, at, line, arc = ladder.rungs, ladder.at, ladder.line, ladder.arc
    n = stations.size
    strokes = Strokes(
        np.empty((n, 7)), np.empty(n, np.intp), np.empty((n, 7)), np.empty((n, 2), np.intp)
    )
    m, j, near = line.shape[0], 0, np.zeros((2, 2))
    is_closed = line[0, 0] == line[m - 1, 0] and line[0, 1] == line[m - 1, 1]
    mesh, top, toe = ladder.ground.mesh, ladder.top, ladder.toe
    for i in range(n):
        tau = stations[i]
        while j + 2 < rungs.shape[0] and rungs[j + 1, TAU] < tau:
            j += 1
        share = (tau - rungs[j, TAU]) / (rungs[j + 1, TAU] - rungs[j, TAU])
        t, _, x, y = follow(
            ladder.ground.mesh, line, arc, at[j, 0], at[j, 1], rungs[j, X], rungs[j, Y], tau
        )
        theta = rungs[j, THETA] + share * (rungs[j + 1, THETA] - rungs[j, THETA])
        chord = shoot(ladder.ground, t, x, y, theta + turns[i])
        strokes.pivot[i, 0], strokes.pivot[i, 1], strokes.pivot[i, 2] = tau, x, y
        strokes.pivot[i, 3], strokes.pivot[i, 4] = theta, theta + turns[i]
        local = local_width(mesh, top, toe, near, chord, x, y, is_closed)
        strokes.pivot[i, 5] = gap_at(rule, effective(chord.width, local))
        strokes.pivot[i, 6] = local
        strokes.triangle[i] = t
        write_chord(strokes, i, chord)
    return strokes
