r"""Mending: other directions for strokes that would miss an edge, cross, or end too near another.

A stroke is in *trouble* if its chord does not lead from top to toe, or if it and the next one do
not advance on both edges by a decent share of a gap. Each run of strokes in trouble, with some
calm ones beside it, chooses anew from a fan of directions, by dynamic programming: the sequence of
chords that advance on both edges and are, and stay, nearest to the calm directions. Then the fan is
narrowed around the choice.

          first                     last      calm strokes that stay
            |   \\|/   \\|/   \\|/   |
            o    o     o     o     o          pivots, each with a fan of chords

Chords that advance on both edges do not cross (their ends do not interleave on the boundary), so
a chosen sequence is a matching whatever its cost. Where there is none, strokes are left out.
"""

import numpy as np

from midrib.kernels.chords import ON_TOE, ON_TOP, shoot
from midrib.kernels.jit import njit
from midrib.kernels.ladder import Ladder, Strokes, write_chord
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import walk
from midrib.kernels.predicates import orient
from midrib.types import Bools, Floats

__all__ = ["LEAST_FOOT", "MOST_FOOT", "MOST_TURN", "crosses", "mend"]

REACH = 4  # calm strokes on either side that choose again too
LEAST_FOOT, MOST_FOOT = 0.3, 1.6  # of a gap: feet nearer or farther than that cost
FOOT_COST = 60.0  # squared radians per squared gap
LEAP = (
    1.0  # gaps: ends that are too far apart by more cost no more, so that none is left out for it
)
MOST_TURN = np.pi / 9.0  # 20 degrees: neighbours that turn more, and more than calm ones, cost
TURN_COST = 60.0  # for each squared radian
OMISSION = 100.0  # cost of a stroke that is left out, more than any chosen one's
SKIP = 8  # strokes left out in a row
FAN = 15  # directions on either side, first of
STEP = np.pi / 45.0  # 4 degrees each: 60 degrees either way; then 4 on either side
NARROW, NARROWER = 4, 0.25  # of a quarter of the step before
LEVELS = 3


@njit(borrows=True)
def advance(
    strokes: Strokes, i: int, j: int, low: float, high: float, edge: int, periods: Floats
) -> float:
    """How far a foot of stroke j at station ``high`` is ahead of one of stroke i at ``low``.

    Round a closed edge, of all ways that differ by whole turns the one that is next to that of
    the pivots.
    """
    ahead, period = high - low, periods[edge]
    if period <= 0.0:
        return ahead
    way = (strokes.pivot[j, 0] - strokes.pivot[i, 0]) / periods[2]
    expected = (way - np.floor(way)) * period
    return ahead - period * np.round((ahead - expected) / period)


@njit(borrows=True)
def is_ahead(strokes: Strokes, i: int, j: int, periods: Floats) -> bool:
    """Whether stroke j is ahead of stroke i on both edges and has no point in common with it."""
    for edge in range(2):
        low, high = strokes.chord[i, edge], strokes.chord[j, edge]
        if advance(strokes, i, j, low, high, edge, periods) <= 0.0:
            return False
    return not crosses(strokes.chord, i, j)


@njit(borrows=True)
def leads_down(strokes: Strokes, i: int) -> bool:
    """Whether a chord leads from top to toe."""
    return strokes.on[i, 0] == ON_TOP and strokes.on[i, 1] == ON_TOE


@njit(borrows=True)
def is_calm(strokes: Strokes, i: int, periods: Floats) -> bool:
    """Whether two strokes after another are as they should be."""
    if not (leads_down(strokes, i) and leads_down(strokes, i + 1)):
        return False
    gap = (strokes.pivot[i, 5] + strokes.pivot[i + 1, 5]) / 2.0
    for edge in range(2):
        low, high = strokes.chord[i, edge], strokes.chord[i + 1, edge]
        ahead = advance(strokes, i, i + 1, low, high, edge, periods)
        if not LEAST_FOOT * gap <= ahead <= MOST_FOOT * gap:
            return False
    return True


@njit(borrows=True)
def cost_of_step(
    strokes: Strokes, i: int, j: int, turn: float, ahead: float, beside: float, stiffness: float
) -> float:
    """Cost of strokes i and j: of bends that calm ones have not, of feet near or far, of turns."""
    gap = (strokes.pivot[i, 5] + strokes.pivot[j, 5]) / 2.0
    step = strokes.pivot[j, 0] - strokes.pivot[i, 0]
    reach = stiffness * (strokes.chord[i, 6] + strokes.chord[j, 6]) / 2.0
    cost = reach * reach / (step * gap) * turn * turn
    missing = j - i - 1
    calm = strokes.pivot[j, 3] - strokes.pivot[i, 3]
    most = max(MOST_TURN * (missing + 1), abs(calm))
    over = max(abs(calm + turn) - most, 0.0)
    cost += TURN_COST * over * over
    for foot in (ahead / gap, beside / gap):
        off = min(max(LEAST_FOOT - foot, foot - MOST_FOOT - missing, 0.0), LEAP)
        cost += FOOT_COST * off * off
    return cost + OMISSION * missing


@njit()
def choose(
    ladder: Ladder,
    strokes: Strokes,
    kept: Bools,
    first: int,
    last: int,
    fixed: tuple[bool, bool],
    periods: Floats,
    stiffness: float,
    half: int,
    step: float,
) -> None:
    """Choose directions for the strokes first..last of which each has 2 half + 1."""
    n, m = last - first + 1, 2 * half + 1
    theta, foot = np.empty((n, m)), np.full((n, m, 2), np.nan)
    cost, came = np.full((n, m), np.inf), np.full((n, m), -1, np.intp)
    least = np.full(n, np.inf)
    # 1. The fans.
    for k in range(n):
        i = first + k
        is_fixed = (k == 0 and fixed[0]) or (k == n - 1 and fixed[1])
        if not kept[i]:
            continue
        for c in range(half, half + 1) if is_fixed else range(m):
            theta[k, c] = strokes.pivot[i, 4] + (c - half) * step
            chord = shoot(
                ladder.ground,
                strokes.triangle[i],
                strokes.pivot[i, 1],
                strokes.pivot[i, 2],
                theta[k, c],
            )
            if chord.top_on == ON_TOP and chord.toe_on == ON_TOE:
                foot[k, c, 0], foot[k, c, 1] = chord.s, chord.t
    # 2. The cheapest way to each chord; it may begin with strokes left out.
    for k in range(n):
        i = first + k
        for c in range(m):
            if np.isnan(foot[k, c, 0]):
                continue
            tilt = theta[k, c] - strokes.pivot[i, 3]
            if k == 0 or not fixed[0]:
                cost[k, c] = OMISSION * k + tilt * tilt
            for before in range(k - 1, max(k - 1 - SKIP, 0) - 1, -1):
                missing = OMISSION * (k - 1 - before)
                if least[before] + missing + tilt * tilt >= cost[k, c]:
                    continue
                for d in range(m):
                    if cost[before, d] + missing + tilt * tilt >= cost[k, c]:
                        continue
                    j = first + before
                    ahead = advance(strokes, j, i, foot[before, d, 0], foot[k, c, 0], 0, periods)
                    beside = advance(strokes, j, i, foot[before, d, 1], foot[k, c, 1], 1, periods)
                    if ahead <= 0.0 or beside <= 0.0:
                        continue
                    turn = tilt - (theta[before, d] - strokes.pivot[j, 3])
                    way = (
                        cost[before, d]
                        + tilt * tilt
                        + cost_of_step(strokes, j, i, turn, ahead, beside, stiffness)
                    )
                    if way < cost[k, c]:
                        cost[k, c], came[k, c] = way, before * m + d
            least[k] = min(least[k], cost[k, c])
    # 3. The cheapest of all, from its end back; what it passes over is left out.
    best, at = np.inf, -1
    for k in range(n):
        for c in range(m):
            total = cost[k, c] + OMISSION * (n - 1 - k)
            if total < best and (k == n - 1 or not fixed[1]):
                best, at = total, k * m + c
    for k in range(n):
        is_fixed = (k == 0 and fixed[0]) or (k == n - 1 and fixed[1])
        kept[first + k] = kept[first + k] and is_fixed
    while at >= 0:
        i, k, c = first + at // m, at // m, at % m
        kept[i] = True
        strokes.pivot[i, 4] = theta[k, c]
        write_chord(
            strokes,
            i,
            shoot(
                ladder.ground,
                strokes.triangle[i],
                strokes.pivot[i, 1],
                strokes.pivot[i, 2],
                theta[k, c],
            ),
        )
        at = came[k, c]


@njit(borrows=True)
def crosses(chord: Floats, i: int, j: int) -> bool:
    """Whether the segments of two chords have a point in common, by exact signs."""
    ax, ay, bx, by = chord[i, 2], chord[i, 3], chord[i, 4], chord[i, 5]
    cx, cy, dx, dy = chord[j, 2], chord[j, 3], chord[j, 4], chord[j, 5]
    c, d = orient(ax, ay, bx, by, cx, cy), orient(ax, ay, bx, by, dx, dy)
    a, b = orient(cx, cy, dx, dy, ax, ay), orient(cx, cy, dx, dy, bx, by)
    if a == 0.0 and b == 0.0:  # on one line
        along_x, along_y = bx - ax, by - ay
        low = (cx - ax) * along_x + (cy - ay) * along_y
        high = (dx - ax) * along_x + (dy - ay) * along_y
        whole = along_x * along_x + along_y * along_y
        return not (max(low, high) < 0.0 or min(low, high) > whole)
    return (c <= 0.0 <= d or d <= 0.0 <= c) and (a <= 0.0 <= b or b <= 0.0 <= a)


@njit(borrows=True)
def is_inside(mesh: Mesh, strokes: Strokes, i: int) -> bool:
    """Whether a whole stroke lies in the area, walked anew from end to end with exact signs."""
    x, y = strokes.pivot[i, 1], strokes.pivot[i, 2]
    row = strokes.chord
    t, _ = walk(mesh, strokes.triangle[i], -1, x, y, row[i, 2], row[i, 3])
    _, obstacle = walk(mesh, t, -1, row[i, 2], row[i, 3], row[i, 4], row[i, 5])
    return obstacle == -1


@njit(entry=True)
def mend(
    ladder: Ladder, strokes: Strokes, periods: Floats, stiffness: float, is_final: bool
) -> Bools:
    """Mend strokes in place.

    Parameters
    ----------
    ladder : what they were drawn on
    strokes : in order along the middle line
    periods : (3,) lengths of top, toe and middle line of a closed slope, 0 of an open one; on a
        closed one the last stroke is the first one again, a turn later, and both stay as they are
    stiffness : as for the ladder
    is_final : whether directions stay, so that strokes that will not do are only left out

    Returns
    -------
    (n,) bool
        Whether each stroke stays; those that do lead from top to toe, inside, and do not cross.
    """
    n = strokes.triangle.size
    kept, is_ring = np.ones(n, np.bool_), periods[0] > 0.0
    # 1. Runs of trouble.
    i = n if is_final else 0
    while i < n:
        is_good = leads_down(strokes, i) and (i == n - 1 or is_calm(strokes, i, periods))
        if is_good:
            i += 1
            continue
        first = max(i - REACH, 0)
        last, calm = i, 0
        while last < n - 1 and calm < 2 * REACH:
            last += 1
            calm = calm + 1 if last < n - 1 and is_calm(strokes, last, periods) else 0
        last = max(last - REACH, i) if calm >= 2 * REACH else n - 1
        fixed = (first > 0 or is_ring, last < n - 1 or is_ring)
        half, step = FAN, STEP
        for _ in range(LEVELS):
            choose(ladder, strokes, kept, first, last, fixed, periods, stiffness, half, step)
            half, step = NARROW, step * NARROWER
        i = last + 1
    # 2. Rounding, and what could not be mended.
    before = -1
    for i in range(n - 1 if is_ring else n):
        kept[i] = kept[i] and leads_down(strokes, i) and is_inside(ladder.ground.mesh, strokes, i)
        if kept[i] and before >= 0:
            kept[i] = is_ahead(strokes, before, i, periods)
        if kept[i]:
            before = i
    if is_ring:
        for i in range(n - 2, 0, -1):
            if kept[i] and is_ahead(strokes, i, n - 1, periods):
                break
            kept[i] = False
    return kept
