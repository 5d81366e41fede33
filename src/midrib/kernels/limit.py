r"""The limit curve: what the curve of minimal radii becomes as the interval of stations goes to 0.

While P walks along the main curve, Q moves as one piece of the envelope after the other tells it.
Foot, vertex and limit give a straight piece of the curve, a graze an arc of a hyperbola. The
*knots* are the ends of pieces; where Q jumps there are two with one P.

    S0-------- C1        S0, S2   ends of an arc, two knots
       .  .      \\       C1       its control point, where the tangents meet
           .  .   \\     The arc lies in the triangle: it is a rational Bezier curve, with weights
               .  . S2   from m(t). It is farther off its chord by no more than C1 is.

Knots are left out where the straight way from knot to knot stays within a tolerance of all that
it replaces (Douglas and Peucker, with the points C1 for arcs), and is free.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import DEPTH, GRAZE, VERTEX
from midrib.kernels.chain import Chain, Goal, goal_of, slack_of
from midrib.kernels.envelope import (
    SLIVER,
    is_same_motion,
    place_at,
)
from midrib.kernels.glance import UNSURE, Others, glance_along, others_of
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.outlook import (
    Outlook,
    Scene,
    look_along,
    new_outlook,
    scene_of,
    walk_along,
)
from midrib.kernels.paths import triangle_towards, walk
from midrib.kernels.tables import with_rows
from midrib.kernels.triangulation import next_side
from midrib.kernels.visibility import squared_distance_to_side
from midrib.kernels.windows import spot_at
from midrib.types import Bools, Floats, Ints

__all__ = ["Limit", "draw_limit"]

SAME_OFF = 1.0 - 2.0**-20  # two knots are the farthest if rounding may have decided
HALVINGS = 14  # of an arc: chords within 2^-28 of its extent
AT_SIDE, AT_KIND, AT_MAIN = 0, 1, 3
FROM, TO = 0, 1


class Pieces(NamedTuple):
    """How Q moves, piece by piece."""

    row: Floats  # (k, 6) t from and to, n at 0 and 1, m at 0 and 1, as in ``Motions``
    at: Ints  # (k, 4) side, kind and vertex of Q, segment of the main curve


class Knots(NamedTuple):
    """Ends of pieces, and control points of arcs between them."""

    x: Floats  # S in lengths
    y: Floats
    t: Floats
    piece: Ints
    is_control: Bools
    breaks: Bools  # whether the way from the one before is not a part of the curve, or not straight


class Limit(NamedTuple):
    """Radii as ``draw_radii`` has them, and the stations they belong to."""

    points: Floats  # (k, 6) P, Q, arc length of Q, radius
    at: Ints  # (k, 6) index, side and vertex of P; segment, vertex and kind of Q
    stations: Floats  # (n,) those of the radii, and the ends of gaps, which have none


@njit(entry=True)
def draw_limit(
    mesh: Mesh,
    main: Chain,
    auxiliary: Chain,
    stations: Floats,
    segment: Ints,
    limits: Floats,
    tolerance: float,
    arcs_within: float,
    scale_x: float,
    scale_y: float,
    glances: bool,
) -> Limit:
    """Radii whose middles make a chain within the tolerance of the limit curve.

    Parameters
    ----------
    mesh : the area
    main, auxiliary : the two curves
    stations : (n,) where the main curve is cut, its vertices among them; they are no events
    segment : (n,) the main curve's segment that begins at each, or that it is on
    limits : (n - 1, 4) least arc length that counts at each station and the next one, and greatest
    tolerance : how far (in lengths) the chain may be from the limit curve and the limit curve from
        the chain; at 0 every event is a vertex
    arcs_within : how far chords may be from arcs of hyperbolas
    scale_x, scale_y : lengths of one unit of x and of y
    glances : whether to glance before looking around; the answer is the same, but comes sooner

    Returns
    -------
    Limit
        One radius for each knot that is kept; at a jump two. What is seen from one station only,
        and from none next to it, does not count.

    Notes
    -----
    Signs at the ends of main segments are exact; where events lie between them is known to
    rounding. Time grows with the number of triangles nearer than the answer from some P.
    """
    scene = scene_of(mesh, main, auxiliary, scale_x, scale_y)
    goal = goal_of(mesh, auxiliary, scale_x, scale_y)
    others = others_of(mesh, main, goal)
    pieces = trace_pieces(mesh, scene, goal, others, main, stations, segment, limits, glances)
    knots = tie_knots(mesh, scene, main, pieces, tolerance > 0.0)
    kept = np.ones(knots.t.size, np.bool_)
    if tolerance > 0.0:
        kept = needed_knots(mesh, scene, main, pieces, knots, tolerance)
    return radii_at(scene, main, pieces, knots, kept, arcs_within)


@njit()
def trace_pieces(
    mesh: Mesh,
    scene: Scene,
    goal: Goal,
    others: Others,
    main: Chain,
    stations: Floats,
    segment: Ints,
    limits: Floats,
    glances: bool,
) -> Pieces:
    """Pieces of the whole main curve; those that go on past a cut are one."""
    windows, rows = 256, 128
    outlook, seen = new_outlook(windows, rows), np.full(2, np.nan)
    row, at = np.empty((4 * rows, 6)), np.empty((4 * rows, 4), np.intp)
    limit, stack = np.empty(4), np.empty(DEPTH, np.intp)
    i, total = 0, 0
    while True:
        i, total = trace_from(
            mesh,
            scene,
            goal,
            others,
            main,
            stations,
            segment,
            limits,
            glances,
            i,
            total,
            row,
            at,
            outlook,
            seen,
            limit,
            stack,
        )
        if i == stations.size - 1:
            break
        if total + rows > row.shape[0]:
            room = 2 * (total + rows)
            row, at = with_rows(row, room), with_rows(at, room)
        else:
            windows, rows = 4 * windows, 4 * rows
            outlook = new_outlook(windows, rows)
    # Slivers are left out.
    kept, least = 0, SLIVER * main.arc[-1]
    for j in range(total):
        run = main.arc[at[j, AT_MAIN] + 1] - main.arc[at[j, AT_MAIN]]
        if (row[j, TO] - row[j, FROM]) * run > least:
            for column in range(6):
                row[kept, column] = row[j, column]
            for column in range(4):
                at[kept, column] = at[j, column]
            kept += 1
    return Pieces(row[:kept], at[:kept])


@njit(borrows=True)
def trace_from(
    mesh: Mesh,
    scene: Scene,
    goal: Goal,
    others: Others,
    main: Chain,
    stations: Floats,
    segment: Ints,
    limits: Floats,
    glances: bool,
    i: int,
    total: int,
    row: Floats,
    at: Ints,
    outlook: Outlook,
    seen: Floats,
    limit: Floats,
    stack: Ints,
) -> tuple[int, int]:
    """Go on with piece ``total`` from station i on, as far as tables have room: where that is."""
    found, found_at, base = outlook.motions.row, outlook.motions.at, outlook.motions.base
    while i < stations.size - 1 and total + base <= row.shape[0]:
        k = segment[i]
        run = main.arc[k + 1] - main.arc[k]
        start, stop = (stations[i] - main.arc[k]) / run, (stations[i + 1] - main.arc[k]) / run
        walk = walk_along(scene, main.vertex[k], main.vertex[k + 1])
        write_limits(limits[i], start, stop, limit)
        # 1. A glance, and where that is not enough a look around.
        count = UNSURE
        if glances:
            hint = max(goal.segment[at[total - 1, AT_SIDE]], 0) if total > 0 else 0
            count = glance_along(
                mesh,
                goal,
                others,
                walk,
                main.side[k],
                start,
                stop,
                limit,
                hint,
                seen,
                outlook,
                stack,
            )
        if count == UNSURE:
            count = look_along(scene, walk, main.side[k], start, stop, limit, outlook)
        if count < 0:
            break
        # 2. Pieces that go on past a cut are one.
        for j in range(count):
            last = total - 1
            is_next = total > 0 and at[last, AT_MAIN] == k and row[last, TO] == found[j, FROM]
            if is_next and is_same_motion(row, at, last, found, found_at, j):
                row[last, TO] = found[j, TO]
                continue
            for column in range(6):
                row[total, column] = found[j, column]
            at[total, AT_MAIN] = k
            for column in range(3):
                at[total, column] = found_at[j, column]
            total += 1
        i += 1
    return i, total


@njit(borrows=True)
def write_limits(given: Floats, start: float, stop: float, limit: Floats) -> None:
    """Write limits at the ends of a side that are those given at start and stop."""
    for i in (0, 2):
        slope = (given[i + 1] - given[i]) / (stop - start) if np.isfinite(given[i]) else 0.0
        limit[i], limit[i + 1] = given[i] - start * slope, given[i + 1] + (1.0 - stop) * slope


# -- points of the curve ---------------------------------------------------------------------------


@njit(borrows=True)
def station_of(main: Chain, k: int, t: float) -> float:
    """Arc length of P on a segment."""
    return main.arc[k + 1] if t == 1.0 else main.arc[k] + t * (main.arc[k + 1] - main.arc[k])


@njit(borrows=True)
def point_between(scene: Scene, a: int, b: int, t: float) -> tuple[float, float]:
    """Return the point at a share of the way from vertex a to vertex b."""
    if t == 1.0:
        return scene.x[b], scene.y[b]
    return scene.x[a] + t * (scene.x[b] - scene.x[a]), scene.y[a] + t * (scene.y[b] - scene.y[a])


@njit(borrows=True)
def foot_of(scene: Scene, main: Chain, k: int, t: float) -> tuple[float, float, int]:
    """P, and the mesh vertex that it is or -1."""
    a, b = main.vertex[k], main.vertex[k + 1]
    x, y = point_between(scene, a, b, t)
    return x, y, a if t == 0.0 else b if t == 1.0 else -1


@njit(borrows=True)
def end_of(scene: Scene, pieces: Pieces, j: int, t: float) -> tuple[float, float, float]:
    """Q, and its share of its side."""
    e = pieces.at[j, AT_SIDE]
    share = place_at(pieces.row, j, t)
    x, y = point_between(scene, scene.tri[e], scene.tri[next_side(e)], share)
    return x, y, share


@njit(borrows=True)
def middle_of(scene: Scene, main: Chain, pieces: Pieces, j: int, t: float) -> tuple[float, float]:
    """S, in lengths."""
    px, py, _ = foot_of(scene, main, pieces.at[j, AT_MAIN], t)
    qx, qy, _ = end_of(scene, pieces, j, t)
    return (px + qx) / 2.0 * scene.scale_x, (py + qy) / 2.0 * scene.scale_y


@njit(borrows=True)
def control_of(
    scene: Scene, main: Chain, pieces: Pieces, j: int, t: float, u: float
) -> tuple[float, float, float]:
    """Where the tangents of an arc from t to u meet, and its largest share in a point of the arc.

    The share is w / (w + root of the product of the other two weights) for the weight w.
    """
    row, e, k = pieces.row[j], pieces.at[j, AT_SIDE], pieces.at[j, AT_MAIN]
    px, py, _ = foot_of(scene, main, k, t)
    rx, ry, _ = foot_of(scene, main, k, u)
    m_t, m_u = row[4] + t * (row[5] - row[4]), row[4] + u * (row[5] - row[4])
    n = (row[2] + t * (row[3] - row[2]) + row[2] + u * (row[3] - row[2])) / 2.0
    m = (m_t + m_u) / 2.0
    a, b = scene.tri[e], scene.tri[next_side(e)]
    ax, ay = scene.x[a], scene.y[a]
    qx, qy = ax + n / m * (scene.x[b] - ax), ay + n / m * (scene.y[b] - ay)
    # The weights of P run the other way: its point is the mean with those of the other end.
    x = (px * m_u + rx * m_t) / (2.0 * m)
    y = (py * m_u + ry * m_t) / (2.0 * m)
    share = abs(m) / (abs(m) + np.sqrt(abs(m_t * m_u)))
    return (x + qx) / 2.0 * scene.scale_x, (y + qy) / 2.0 * scene.scale_y, share


# -- knots -----------------------------------------------------------------------------------------


@njit()
def tie_knots(mesh: Mesh, scene: Scene, main: Chain, pieces: Pieces, finds_ways: bool) -> Knots:
    """Return the ends of pieces, one where a piece goes on where the one before has ended.

    ``finds_ways``: whether jumps that a straight way crosses shall not break the curve.
    """
    n = 3 * pieces.row.shape[0]
    x, y, t, piece = np.empty(n), np.empty(n), np.empty(n), np.empty(n, np.intp)
    is_control, breaks = np.zeros(n, np.bool_), np.zeros(n, np.bool_)
    room = Knots(x, y, t, piece, is_control, breaks)
    n = write_knots(mesh, scene, main, pieces, finds_ways, room)
    return Knots(x[:n], y[:n], t[:n], piece[:n], is_control[:n], breaks[:n])


@njit(borrows=True)
def write_knots(
    mesh: Mesh, scene: Scene, main: Chain, pieces: Pieces, finds_ways: bool, room: Knots
) -> int:
    """Write the knots; their number."""
    x, y, t, piece, is_control, breaks = room
    count = 0
    for j in range(pieces.row.shape[0]):
        start, stop = pieces.row[j, FROM], pieces.row[j, TO]
        goes_on = j > 0 and meets(scene, main, pieces, j)
        if not goes_on:
            x[count], y[count] = middle_of(scene, main, pieces, j, start)
            t[count], piece[count] = start, j
            if j > 0:
                breaks[count] = not finds_ways or not (
                    is_gapless(main, pieces, j)
                    and is_free(mesh, scene, main, pieces, j - 1, t[count - 1], x[count], y[count])
                )
            count += 1
        elif pieces.at[j, AT_KIND] == VERTEX:
            t[count - 1], piece[count - 1] = start, j
        if pieces.at[j, AT_KIND] == GRAZE:
            x[count], y[count], _ = control_of(scene, main, pieces, j, start, stop)
            t[count], piece[count], is_control[count] = (start + stop) / 2.0, j, True
            count += 1
        x[count], y[count] = middle_of(scene, main, pieces, j, stop)
        t[count], piece[count] = stop, j
        count += 1
    return count


@njit(borrows=True)
def is_gapless(main: Chain, pieces: Pieces, j: int) -> bool:
    """Whether piece j begins at the station where the one before has ended."""
    before = station_of(main, pieces.at[j - 1, AT_MAIN], pieces.row[j - 1, TO])
    begins = station_of(main, pieces.at[j, AT_MAIN], pieces.row[j, FROM])
    return begins - before <= 2.0 * SLIVER * main.arc[-1]


@njit(borrows=True)
def meets(scene: Scene, main: Chain, pieces: Pieces, j: int) -> bool:
    """Whether piece j begins in the point in which the one before has ended."""
    if not is_gapless(main, pieces, j):
        return False
    x, y, _ = end_of(scene, pieces, j - 1, pieces.row[j - 1, TO])
    qx, qy, _ = end_of(scene, pieces, j, pieces.row[j, FROM])
    px, py, _ = foot_of(scene, main, pieces.at[j, AT_MAIN], pieces.row[j, FROM])
    radius = length((qx - px) * scene.scale_x, (qy - py) * scene.scale_y)
    off = length((qx - x) * scene.scale_x, (qy - y) * scene.scale_y)
    return off <= slack_of(scene.tie, radius)


@njit(borrows=True)
def is_free(
    mesh: Mesh,
    scene: Scene,
    main: Chain,
    pieces: Pieces,
    j: int,
    t: float,
    to_x: float,
    to_y: float,
) -> bool:
    """Whether the straight way from S(t) of piece j to a point (in lengths) is free."""
    k = pieces.at[j, AT_MAIN]
    px, py, vertex = foot_of(scene, main, k, t)
    x, y = middle_of(scene, main, pieces, j, t)
    x, y, to_x, to_y = (
        x / scene.scale_x,
        y / scene.scale_y,
        to_x / scene.scale_x,
        to_y / scene.scale_y,
    )
    spot = spot_at(mesh, px, py, main.side[k], vertex)
    first = spot.side // 3 if vertex < 0 else triangle_towards(mesh, vertex, x, y)
    if first < 0:
        return False
    first, obstacle = walk(mesh, first, -1, spot.x, spot.y, x, y)
    if obstacle != -1:
        return False
    _, obstacle = walk(mesh, first, -1, x, y, to_x, to_y)
    return obstacle == -1


@njit()
def needed_knots(
    mesh: Mesh, scene: Scene, main: Chain, pieces: Pieces, knots: Knots, tolerance: float
) -> Bools:
    """Which knots the chain needs to be within the tolerance of the curve.

    What is left out lies within the tolerance of a straight way, and so the way does of it: the
    nearest point of the way moves from one of its ends to the other.
    """
    n = knots.t.size
    kept = np.zeros(n, np.bool_)
    write_needed(mesh, scene, main, pieces, knots, tolerance, np.empty((n + 3, 2), np.intp), kept)
    return kept


@njit(borrows=True)
def write_needed(
    mesh: Mesh,
    scene: Scene,
    main: Chain,
    pieces: Pieces,
    knots: Knots,
    tolerance: float,
    stack: Ints,
    kept: Bools,
) -> None:
    """Write which knots are needed; ways that wait have no more than their ends in common."""
    n = knots.t.size
    start, depth = 0, 0
    for i in range(1, n + 1):
        if i == n or knots.breaks[i]:
            stack[depth, 0], stack[depth, 1] = start, i - 1
            start, depth = i, 1
        while depth > 0:
            depth -= 1
            a, b = stack[depth, 0], stack[depth, 1]
            kept[a] = kept[b] = True
            if b <= a + 1 or (b == a + 2 and knots.is_control[a + 1]):
                continue
            first, last, squared = farthest_knots(knots, a, b)
            if squared <= tolerance * tolerance and is_free(
                mesh, scene, main, pieces, knots.piece[a], knots.t[a], knots.x[b], knots.y[b]
            ):
                continue
            for begin, end in ((a, first), (first, last), (last, b)):
                if begin < end:
                    stack[depth, 0], stack[depth, 1] = begin, end
                    depth += 1


@njit(borrows=True)
def farthest_knots(knots: Knots, a: int, b: int) -> tuple[int, int, float]:
    """First and last of the knots between a and b farthest from the way between, and how far.

    The distance is squared. Of a control point its arc's ends.
    """
    most, first, last = -1.0, a + 1, a + 1
    ax, ay, bx, by = knots.x[a], knots.y[a], knots.x[b], knots.y[b]
    for i in range(a + 1, b):
        off = squared_distance_to_side(knots.x[i], knots.y[i], ax, ay, bx, by, 1.0, 1.0)
        if off > most / SAME_OFF:
            first = i
        if off >= most * SAME_OFF:
            last = i
        most = max(most, off)
    if knots.is_control[first]:
        first = first - 1 if first - 1 > a else first + 1
    if knots.is_control[last]:
        last = last + 1 if last + 1 < b else last - 1
    return first, last, most


# -- radii -----------------------------------------------------------------------------------------


@njit()
def radii_at(
    scene: Scene,
    main: Chain,
    pieces: Pieces,
    knots: Knots,
    kept: Bools,
    arcs_within: float,
) -> Limit:
    """Radii at the knots that are kept and on the arcs between them; stations without a radius."""
    waits, room = np.empty(HALVINGS + 2), 3 * int(np.count_nonzero(kept)) + 8
    while True:
        points, at, stations = np.empty((room, 6)), np.empty((room, 6), np.intp), np.empty(room)
        total, n = write_radii(
            scene, main, pieces, knots, kept, arcs_within, points, at, stations, waits
        )
        if max(total, n) <= room:
            return Limit(points[:total], at[:total], stations[:n])
        room = max(total, n)


@njit(borrows=True)
def write_radii(
    scene: Scene,
    main: Chain,
    pieces: Pieces,
    knots: Knots,
    kept: Bools,
    arcs_within: float,
    points: Floats,
    at: Ints,
    stations: Floats,
    waits: Floats,
) -> tuple[int, int]:
    """Write radii and stations, as many as there is room for; their numbers."""
    total, n, slack = 0, 0, 2.0 * SLIVER * main.arc[-1]
    seen, has_radius = 0.0, False  # the last station, and whether it is one of a radius
    for i in range(knots.t.size):
        if not kept[i] or knots.is_control[i]:
            continue
        j = knots.piece[i]
        # 1. From the last one on there may be an arc, or a gap.
        depth = 0
        waits[0] = knots.t[i]
        if i > 1 and kept[i - 2] and knots.is_control[i - 1]:
            j, before = knots.piece[i - 1], knots.t[i - 2]
            if knots.piece[i - 2] != j:
                before = pieces.row[j, FROM]
            waits[0] = pieces.row[j, TO]
        else:
            before = waits[0]
        station = station_of(main, pieces.at[j, AT_MAIN], before)
        if station - seen > slack and (i == 0 or (knots.breaks[i] and before == knots.t[i])):
            n = add_station(stations, add_station(stations, n, seen), station)
            has_radius = False
        # 2. An arc is halved until its chords are near enough.
        while depth >= 0:
            t = waits[depth]
            if (
                before < t
                and depth < HALVINGS
                and is_off(scene, main, pieces, j, before, t, arcs_within)
            ):
                depth += 1
                waits[depth] = (before + t) / 2.0
                continue
            row_piece, row_t = (knots.piece[i], knots.t[i]) if depth == 0 else (j, t)
            station = station_of(main, pieces.at[row_piece, AT_MAIN], row_t)
            if not has_radius or station != seen:
                n = add_station(stations, n, station)
            seen, has_radius = station, True
            if total < at.shape[0]:
                write_radius(scene, main, pieces, row_piece, row_t, points[total], at[total])
                at[total, 0] = n - 1
            total += 1
            before, depth = t, depth - 1
    if main.arc[-1] - seen > slack:
        n = add_station(stations, add_station(stations, n, seen), main.arc[-1])
    return total, n


@njit(borrows=True)
def add_station(stations: Floats, n: int, station: float) -> int:
    """Append a station where there is room; the new number of them."""
    if n < stations.size:
        stations[n] = station
    return n + 1


@njit(borrows=True)
def is_off(
    scene: Scene,
    main: Chain,
    pieces: Pieces,
    j: int,
    t: float,
    u: float,
    within: float,
) -> bool:
    """Whether an arc may be farther off its chord."""
    ax, ay = middle_of(scene, main, pieces, j, t)
    bx, by = middle_of(scene, main, pieces, j, u)
    x, y, share = control_of(scene, main, pieces, j, t, u)
    off = np.sqrt(squared_distance_to_side(x, y, ax, ay, bx, by, 1.0, 1.0))
    return share * off > within


@njit(borrows=True)
def write_radius(
    scene: Scene,
    main: Chain,
    pieces: Pieces,
    j: int,
    t: float,
    point: Floats,
    at: Ints,
) -> None:
    """Write one radius."""
    k, e, kind = pieces.at[j, AT_MAIN], pieces.at[j, AT_SIDE], pieces.at[j, AT_KIND]
    px, py, p_vertex = foot_of(scene, main, k, t)
    qx, qy, share = end_of(scene, pieces, j, t)
    v = scene.tri[e] if share == 0.0 else scene.tri[next_side(e)] if share == 1.0 else -1
    segment, arc = scene.segment[e], scene.arc
    if v >= 0 and scene.place[v] >= 0:
        segment, at_arc = min(scene.place[v], arc.size - 2), arc[scene.place[v]]
    else:
        is_forward = scene.vertex[segment] == scene.tri[e]
        along = share if is_forward else 1.0 - share
        at_arc = arc[segment] + along * (arc[segment + 1] - arc[segment])
    point[0], point[1], point[2], point[3], point[4] = px, py, qx, qy, at_arc
    point[5] = length((qx - px) * scene.scale_x, (qy - py) * scene.scale_y)
    at[1], at[2], at[3], at[4], at[5] = main.side[k], p_vertex, segment, v, kind
