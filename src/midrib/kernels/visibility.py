r"""The nearest visible point: from P on the main curve to the auxiliary curve.

The nearest point of the whole auxiliary curve, if P sees it, is the answer: a tree of boxes finds
it and a walk along PQ proves that nothing is in the way. Where something is, P looks out of its
triangle. Through each open side goes a *window*, the part of the side that P sees between two mesh
vertices; behind it lies one more triangle, whose other two sides get what is left of the window.
A side farther than the best point so far is not looked through. A side on the auxiliary curve
offers the point of its visible part that is nearest to P.

        left                        P        a point of the main curve
          \\      .                  E        a point of the auxiliary curve that P sees
           \\   .   \\  E             window   the rays from P by ``right`` and ``left``
            \\.......\\......
           P --------- right ---

Kinds of E: FOOT of a perpendicular, VERTEX, GRAZE (the view ends at a vertex that is not on the
auxiliary curve), LIMIT (the end clearance cuts the segment there).
Distances are in the metric scale_x dx, scale_y dy; sides of lines do not depend on it.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import (
    DEPTH,
    GRAZE,
    LIMIT,
    VERTEX,
    box_tree,
    nearest_on_chain,
    nearest_share,
)
from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh, is_beyond
from midrib.kernels.paths import triangle_towards, walk
from midrib.kernels.predicates import orient
from midrib.kernels.triangulation import next_side, previous_side
from midrib.types import Bools, Floats, Ints

__all__ = ["nearest_visible", "sees_within"]

# Two radii are a tie if they differ by less than rounding can explain: this share of the radius,
# or this share of the largest coordinate, whichever is more.
TIE_OF_RADIUS = 2.0**-40
TIE_OF_COORDINATE = 2.0**-50
WINDOWS_PER_SIDE = 64  # rays go forward only, so that a side is looked through once a hole at most


class Goal(NamedTuple):
    """A curve to look for: its segments on half-edges, its vertices, and a tree of boxes."""

    segment: Ints  # for each half-edge the curve's segment on it, or -1
    vertex: Ints
    arc: Floats
    x: Floats  # in lengths, as y and boxes
    y: Floats
    boxes: Floats
    scale_x: float
    scale_y: float
    tie: float  # radii that differ by less than this are equal


class View(NamedTuple):
    """Tables to work in, kept from one point to the next."""

    near: Floats  # points found: x, y, arc length, squared distance
    near_kind: Ints
    stack: Ints  # windows that wait: side, right, left
    windows: Ints
    nodes: Ints
    segments: Ints
    shares: Floats
    kinds: Ints
    squares: Floats


@njit()
def goal_of(
    mesh: Mesh, segment: Ints, vertex: Ints, arc: Floats, scale_x: float, scale_y: float
) -> Goal:
    """Prepare to look for a curve."""
    x, y = mesh.x[vertex] * scale_x, mesh.y[vertex] * scale_y
    largest = 0.0
    for v in range(mesh.x.size):
        largest = max(largest, abs(mesh.x[v]) * scale_x, abs(mesh.y[v]) * scale_y)
    tie = TIE_OF_COORDINATE * largest
    return Goal(segment, vertex, arc, x, y, box_tree(x, y), scale_x, scale_y, tie)


@njit()
def new_view() -> View:
    """Empty tables."""
    return View(
        np.empty((16, 4)),
        np.empty(16, np.intp),
        np.empty((64, 3), np.intp),
        np.empty((64, 3), np.intp),
        np.empty(DEPTH, np.intp),
        np.empty(16, np.intp),
        np.empty(16),
        np.empty(16, np.intp),
        np.empty(16),
    )


@njit()
def squared_distance_to_side(
    px: float, py: float, ax: float, ay: float, bx: float, by: float, scale_x: float, scale_y: float
) -> float:
    """Squared distance from p to the segment a b, which may have no length."""
    dx, dy = (bx - ax) * scale_x, (by - ay) * scale_y
    ex, ey = (px - ax) * scale_x, (py - ay) * scale_y
    length_squared = dx * dx + dy * dy
    if length_squared > 0.0:
        t = min(max((ex * dx + ey * dy) / length_squared, 0.0), 1.0)
        ex, ey = ex - t * dx, ey - t * dy
    return ex * ex + ey * ey


@njit()
def ray_meets_side(
    px: float, py: float, rx: float, ry: float, ax: float, ay: float, bx: float, by: float
) -> float:
    """Share of the way from a to b at which the ray from p by r meets it; NaN if it does not."""
    at_a = (rx - px) * (ay - py) - (ry - py) * (ax - px)
    at_b = (rx - px) * (by - py) - (ry - py) * (bx - px)
    return at_a / (at_a - at_b) if at_a != at_b else np.nan


@njit()
def nearest_on_side(
    mesh: Mesh,
    e: int,
    right: int,
    left: int,
    px: float,
    py: float,
    scale_x: float,
    scale_y: float,
    low: float,
    high: float,
) -> tuple[float, int]:
    """Where on side e (0 at its start, 1 at its end) the nearest point to p lies, and its kind.

    Only what the window shows and what is not outside low..high counts; NaN if that is nothing.
    """
    u, v = mesh.tri[e], mesh.tri[next_side(e)]
    ux, uy, vx, vy = mesh.x[u], mesh.y[u], mesh.x[v], mesh.y[v]
    first, last = 0.0, 1.0
    kind_first, kind_last = VERTEX, VERTEX
    if right != u and orient(px, py, mesh.x[right], mesh.y[right], ux, uy) < 0.0:
        cut = ray_meets_side(px, py, mesh.x[right], mesh.y[right], ux, uy, vx, vy)
        if cut > first:
            first, kind_first = cut, GRAZE
    if left != v and orient(px, py, mesh.x[left], mesh.y[left], vx, vy) > 0.0:
        cut = ray_meets_side(px, py, mesh.x[left], mesh.y[left], ux, uy, vx, vy)
        if cut < last:
            last, kind_last = cut, GRAZE
    if low > first:
        first, kind_first = low, LIMIT
    if high < last:
        last, kind_last = high, LIMIT
    return nearest_share(
        px * scale_x,
        py * scale_y,
        ux * scale_x,
        uy * scale_y,
        vx * scale_x,
        vy * scale_y,
        first,
        last,
        kind_first,
        kind_last,
    )


@njit()
def keep_ties(found: Floats, kinds: Ints, count: int, tie: float) -> int:
    """Sort the points found by arc length, drop those that are not nearest or double."""
    best = np.inf
    for i in range(count):
        best = min(best, found[i, 3])
    radius = np.sqrt(best)
    limit = (radius + max(tie, TIE_OF_RADIUS * radius)) ** 2
    kept = 0
    for i in range(count):
        if found[i, 3] > limit:
            continue
        arc, k = found[i, 2], kinds[i]
        row_x, row_y, row_d = found[i, 0], found[i, 1], found[i, 3]
        double = False
        j = kept
        while j > 0 and found[j - 1, 2] >= arc:
            double = double or found[j - 1, 2] == arc
            j -= 1
        if double or (j > 0 and found[j - 1, 0] == row_x and found[j - 1, 1] == row_y):
            continue
        for m in range(kept, j, -1):
            found[m] = found[m - 1]
            kinds[m] = kinds[m - 1]
        found[j, 0], found[j, 1], found[j, 2], found[j, 3] = row_x, row_y, arc, row_d
        kinds[j] = k
        kept += 1
    return kept


@njit()
def grown(array: Floats, rows: int) -> Floats:
    """Copy of a table of floats with room for ``rows`` rows."""
    larger = np.empty((rows, array.shape[1]))
    larger[: array.shape[0]] = array
    return larger


@njit()
def grown_ints(array: Ints, size: int) -> Ints:
    """Copy of an array of integers with room for ``size``."""
    larger = np.empty(size, np.intp)
    larger[: array.size] = array
    return larger


@njit()
def with_room(rows: Ints, count: int) -> Ints:
    """Return the table itself, or a copy twice as long where fewer than three rows are left."""
    if count + 3 <= rows.shape[0]:
        return rows
    larger = np.empty((2 * rows.shape[0], 3), np.intp)
    larger[:count] = rows[:count]
    return larger


@njit()
def add_window(windows: Ints, count: int, side: int, right: int, left: int) -> int:
    """Append a window; return the new count."""
    windows[count, 0], windows[count, 1], windows[count, 2] = side, right, left
    return count + 1


@njit()
def first_windows(
    mesh: Mesh, side: int, vertex: int, x: float, y: float, windows: Ints
) -> tuple[Ints, int]:
    """Return the sides that a boundary point sees without looking through another one.

    Of a point on a side, those of its triangle; of a vertex, the rims and outer sides of its fans.
    In a triangle thinner than rounding the point may lie beyond a side; then it looks out of the
    triangle there.
    """
    count = 0
    if vertex < 0:
        count = add_window(windows, count, side, mesh.tri[side], mesh.tri[next_side(side)])
        for e in (next_side(side), previous_side(side)):
            if not is_beyond(mesh, e, x, y):
                count = add_window(windows, count, e, mesh.tri[e], mesh.tri[next_side(e)])
                continue
            f = mesh.twin[e]
            if f < 0:
                continue
            for g in (next_side(f), previous_side(f)):
                if not is_beyond(mesh, g, x, y):
                    count = add_window(windows, count, g, mesh.tri[g], mesh.tri[next_side(g)])
        return windows, count
    door = mesh.door[vertex]
    while door >= 0:
        e = door
        count = add_window(windows, count, e, mesh.tri[e], mesh.tri[next_side(e)])
        while e >= 0:
            windows = with_room(windows, count)
            across, rim = next_side(e), previous_side(e)
            count = add_window(windows, count, across, mesh.tri[across], mesh.tri[rim])
            if mesh.twin[rim] < 0:
                count = add_window(windows, count, rim, mesh.tri[rim], vertex)
            e = mesh.twin[rim]
        door = mesh.other_door[door]
        windows = with_room(windows, count)
    return windows, count


@njit()
def next_windows(
    mesh: Mesh, side: int, right: int, left: int, x: float, y: float, windows: Ints
) -> int:
    """Look through a side: the windows on the two sides behind it. Return their number."""
    e = mesh.twin[side]  # runs from left to right as P sees it, so its next side is the right one
    w = mesh.tri[previous_side(e)]
    by_right = orient(x, y, mesh.x[right], mesh.y[right], mesh.x[w], mesh.y[w])
    by_left = orient(x, y, mesh.x[left], mesh.y[left], mesh.x[w], mesh.y[w])
    count = 0
    if by_right >= 0.0:
        count = add_window(windows, count, next_side(e), right, w if by_left < 0.0 else left)
    if by_left <= 0.0:
        count = add_window(windows, count, previous_side(e), w if by_right > 0.0 else right, left)
    return count


@njit()
def offer_of_segment(
    mesh: Mesh,
    goal: Goal,
    side: int,
    right: int,
    left: int,
    x: float,
    y: float,
    j: int,
    low: float,
    high: float,
) -> tuple[float, float, int]:
    """Return what segment j of the curve offers.

    Share of the way along its side, arc length, kind.
    """
    length = goal.arc[j + 1] - goal.arc[j]
    is_forward = goal.vertex[j] == mesh.tri[side]
    share_low, share_high = 0.0, 1.0
    if low > goal.arc[j] or high < goal.arc[j + 1]:
        share_low, share_high = (low - goal.arc[j]) / length, (high - goal.arc[j]) / length
        if not is_forward:
            share_low, share_high = 1.0 - share_high, 1.0 - share_low
    share, kind = nearest_on_side(
        mesh, side, right, left, x, y, goal.scale_x, goal.scale_y, share_low, share_high
    )
    along = share if is_forward else 1.0 - share
    arc = goal.arc[j + 1] if along == 1.0 else goal.arc[j] + along * length
    return share, arc, kind


@njit()
def offer_of_end(
    mesh: Mesh,
    goal: Goal,
    side: int,
    right: int,
    left: int,
    x: float,
    y: float,
    low: float,
    high: float,
) -> tuple[float, float, int]:
    """Return an end of the curve can be seen where its own segment is not.

    At the end of a boundary side next to it.
    """
    u, v = mesh.tri[side], mesh.tri[next_side(side)]
    for end, arc in ((goal.vertex[0], 0.0), (goal.vertex[-1], goal.arc[-1])):
        if arc < low or arc > high:
            continue
        if end == u and (
            right == u or orient(x, y, mesh.x[right], mesh.y[right], mesh.x[u], mesh.y[u]) >= 0.0
        ):
            return 0.0, arc, VERTEX
        if end == v and (
            left == v or orient(x, y, mesh.x[left], mesh.y[left], mesh.x[v], mesh.y[v]) <= 0.0
        ):
            return 1.0, arc, VERTEX
    return np.nan, np.nan, VERTEX


@njit()
def look(
    mesh: Mesh,
    goal: Goal,
    x: float,
    y: float,
    side: int,
    vertex: int,
    low: float,
    high: float,
    bound: float,
    view: View,
) -> tuple[View, int]:
    """Look around: collect the points of the curve that are seen.

    Only those not farther than ``bound`` nor, when found, than the nearest so far. Return the
    view, with larger tables if need be, and a count.
    """
    near, near_kind, stack = view.near, view.near_kind, view.stack
    bound = bound * bound
    count, depth, left_to_do = 0, 0, WINDOWS_PER_SIDE * mesh.tri.size
    windows, n_windows = first_windows(mesh, side, vertex, x, y, view.windows)
    while True:
        # 1. Boundary sides make their offer; open sides that are near enough wait.
        for w in range(n_windows):
            e, right, left = windows[w, 0], windows[w, 1], windows[w, 2]
            u, v = mesh.tri[e], mesh.tri[next_side(e)]
            ux, uy, vx, vy = mesh.x[u], mesh.y[u], mesh.x[v], mesh.y[v]
            if squared_distance_to_side(x, y, ux, uy, vx, vy, goal.scale_x, goal.scale_y) > bound:
                continue
            if mesh.twin[e] >= 0:
                stack = with_room(stack, depth)
                depth = add_window(stack, depth, e, right, left)
                continue
            j = goal.segment[e]
            if j >= 0:
                share, arc, kind = offer_of_segment(mesh, goal, e, right, left, x, y, j, low, high)
            else:
                share, arc, kind = offer_of_end(mesh, goal, e, right, left, x, y, low, high)
            if np.isnan(share):
                continue
            qx, qy = ux + share * (vx - ux), uy + share * (vy - uy)
            if share == 1.0:
                qx, qy = vx, vy
            d = ((qx - x) * goal.scale_x) ** 2 + ((qy - y) * goal.scale_y) ** 2
            if d > bound:
                continue
            radius = np.sqrt(d)
            bound = min(bound, (radius + max(goal.tie, TIE_OF_RADIUS * radius)) ** 2)
            if count == near_kind.size:
                near, near_kind = grown(near, 2 * count), grown_ints(near_kind, 2 * count)
            near[count, 0], near[count, 1], near[count, 2], near[count, 3] = qx, qy, arc, d
            near_kind[count] = kind
            count += 1
        # 2. The open side that came last is looked through.
        left_to_do -= 1
        if depth == 0 or left_to_do == 0:
            break
        depth -= 1
        n_windows = next_windows(
            mesh, stack[depth, 0], stack[depth, 1], stack[depth, 2], x, y, windows
        )
    return View(
        near,
        near_kind,
        stack,
        windows,
        view.nodes,
        view.segments,
        view.shares,
        view.kinds,
        view.squares,
    ), count


@njit()
def sees(
    mesh: Mesh,
    target: Ints,
    x: float,
    y: float,
    side: int,
    vertex: int,
    j: int,
    qx: float,
    qy: float,
) -> bool:
    """Whether the straight way from P to Q, a point on auxiliary segment j, is free.

    Where rounding or a vertex on the way leaves a doubt, the answer is no.
    """
    t = side // 3 if vertex < 0 else triangle_towards(mesh, vertex, qx, qy)
    if t < 0 or (vertex < 0 and is_beyond(mesh, side, qx, qy)):
        return False
    _, obstacle = walk(mesh, t, x, y, qx, qy)
    return obstacle == -1 or (obstacle >= 0 and target[obstacle] == j)


@njit()
def nearest_if_seen(
    mesh: Mesh,
    goal: Goal,
    x: float,
    y: float,
    side: int,
    vertex: int,
    low: float,
    high: float,
    reach: float,
    view: View,
) -> tuple[int, float]:
    """Nearest points of a curve, in ``view.near``, if one point sees them.

    Return their number, or -1 where it cannot be told or something is in the way, and how far the
    nearest point is at all. Points farther than ``reach`` do not count.
    """
    # 1. The nearest point at all.
    slack = goal.tie if reach == np.inf else max(goal.tie, TIE_OF_RADIUS * reach)
    n_nearest = nearest_on_chain(
        x * goal.scale_x,
        y * goal.scale_y,
        goal.x,
        goal.y,
        goal.arc,
        goal.boxes,
        low,
        high,
        reach,
        slack,
        view.nodes,
        view.segments,
        view.shares,
        view.kinds,
        view.squares,
    )
    best = np.inf
    for k in range(n_nearest):
        best = min(best, view.squares[k])
    nearest = np.sqrt(best)
    limit = (nearest + max(goal.tie, TIE_OF_RADIUS * nearest)) ** 2
    # 2. If it is seen, and so is every point equally near, that is the answer.
    if n_nearest < 0:
        return -1, nearest
    count = 0
    for k in range(n_nearest):
        if view.squares[k] > limit:
            continue
        j, share = view.segments[k], view.shares[k]
        a, b = goal.vertex[j], goal.vertex[j + 1]
        qx = mesh.x[a] + share * (mesh.x[b] - mesh.x[a])
        qy = mesh.y[a] + share * (mesh.y[b] - mesh.y[a])
        arc = goal.arc[j] + share * (goal.arc[j + 1] - goal.arc[j])
        if share == 1.0:
            qx, qy, arc = mesh.x[b], mesh.y[b], goal.arc[j + 1]
        if not sees(mesh, goal.segment, x, y, side, vertex, j, qx, qy):
            return -1, nearest
        view.near[count, 0], view.near[count, 1], view.near[count, 2] = qx, qy, arc
        view.near[count, 3], view.near_kind[count] = view.squares[k], view.kinds[k]
        count += 1
    return count, nearest


@njit(entry=True)
def nearest_visible(
    mesh: Mesh,
    target: Ints,
    aux_vertex: Ints,
    aux_arc: Floats,
    px: Floats,
    py: Floats,
    p_side: Ints,
    p_vertex: Ints,
    low: Floats,
    high: Floats,
    scale_x: float,
    scale_y: float,
) -> tuple[Ints, Floats, Ints]:
    """Nearest points of the auxiliary curve that each P sees.

    Parameters
    ----------
    mesh : the area
    target : for each half-edge the auxiliary segment on it, or -1
    aux_vertex, aux_arc : (m + 1,) vertices of the auxiliary curve and their arc lengths
    px, py : (n,) points of the main curve
    p_side : (n,) the boundary side that each P lies on
    p_vertex : (n,) the mesh vertex that P is, or -1
    low, high : (n,) only points with an arc length from low to high count
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    station : (k,) index of P for each point found; several where radii tie, in order of travel
        along the auxiliary curve; none where P sees nothing
    found : (k, 4) x, y, arc length and squared radius
    kind : (k,) FOOT, VERTEX, GRAZE or LIMIT

    Notes
    -----
    Exact but for the rounding of the points themselves: every sign is. Time per P grows with the
    number of triangles nearer than the answer, some 10 to 20 in an area that is triangulated well.
    """
    n = px.size
    station, kind = np.empty(n + 8, np.intp), np.empty(n + 8, np.intp)
    found = np.empty((n + 8, 4))
    goal = goal_of(mesh, target, aux_vertex, aux_arc, scale_x, scale_y)
    view = new_view()
    total, reach, seen = 0, np.inf, np.inf
    for i in range(n):
        # The nearest point is at most a step farther than the one before, if as many count; so
        # is, mostly, the nearest one that is seen.
        if i > 0:
            step = np.hypot((px[i] - px[i - 1]) * scale_x, (py[i] - py[i - 1]) * scale_y)
            reach = (reach + step) * (1.0 + TIE_OF_RADIUS) + goal.tie
            seen = (seen + step) * (1.0 + TIE_OF_RADIUS) + goal.tie
            if low[i] > low[i - 1] or high[i] < high[i - 1]:
                reach = np.inf
        count, reach = nearest_if_seen(
            mesh, goal, px[i], py[i], p_side[i], p_vertex[i], low[i], high[i], reach, view
        )
        for bound in (seen, np.inf):
            if count < 0:
                view, count = look(
                    mesh, goal, px[i], py[i], p_side[i], p_vertex[i], low[i], high[i], bound, view
                )
                count = count if count > 0 or bound == np.inf else -1
        seen = np.inf
        if count == 0:
            continue
        kept = keep_ties(view.near, view.near_kind, count, goal.tie)
        seen = np.sqrt(view.near[0, 3])
        if total + kept > station.size:
            room = 2 * (total + kept)
            found = grown(found, room)
            station, kind = grown_ints(station, room), grown_ints(kind, room)
        station[total : total + kept] = i
        found[total : total + kept] = view.near[:kept]
        kind[total : total + kept] = view.near_kind[:kept]
        total += kept
    return station[:total], found[:total], kind[:total]


@njit(entry=True)
def sees_within(
    mesh: Mesh,
    target: Ints,
    vertex: Ints,
    arc: Floats,
    px: Floats,
    py: Floats,
    p_side: Ints,
    p_vertex: Ints,
    bound: Floats,
    scale_x: float,
    scale_y: float,
) -> Bools:
    """Whether each point of the boundary sees a curve nearer than its bound.

    Parameters are those of ``nearest_visible``; ``bound`` is (n,) distances.
    """
    goal = goal_of(mesh, target, vertex, arc, scale_x, scale_y)
    view = new_view()
    seen = np.zeros(px.size, np.bool_)
    for i in range(px.size):
        count, _ = nearest_if_seen(
            mesh, goal, px[i], py[i], p_side[i], p_vertex[i], -np.inf, np.inf, bound[i], view
        )
        if count < 0:
            view, count = look(
                mesh, goal, px[i], py[i], p_side[i], p_vertex[i], -np.inf, np.inf, bound[i], view
            )
        seen[i] = count > 0
    return seen
