"""What a point P of the boundary sees of a curve: one point of it, or the nearest.

A walk from P to Q proves that nothing is in the way. To find the nearest Q, P looks around, window
by window, out to the nearest point so far. A side on the curve offers the point of its visible part
that is nearest to P.

Kinds of Q: FOOT of a perpendicular, VERTEX, GRAZE (the view ends at a vertex that is not on the
curve), LIMIT (the end clearance cuts the segment there).
Distances are in the metric scale_x dx, scale_y dy; sides of lines do not depend on it.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import DEPTH, GRAZE, LIMIT, VERTEX, nearest_share
from midrib.kernels.chain import Goal, slack_of
from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh, is_beyond
from midrib.kernels.paths import triangle_towards, walk
from midrib.kernels.predicates import orient
from midrib.kernels.tables import with_rows
from midrib.kernels.triangulation import next_side, previous_side
from midrib.kernels.windows import Spot, add_window, first_windows, part_window, with_room
from midrib.types import Floats, Ints

__all__ = [
    "WINDOWS_PER_SIDE",
    "View",
    "keep_ties",
    "look",
    "new_view",
    "ray_meets_side",
    "sees",
    "squared_distance_to_side",
]

WINDOWS_PER_SIDE = 64  # rays go forward only, so that a side is looked through once a hole at most


class View(NamedTuple):
    """Points found, and tables to work in that are kept from one P to the next."""

    near: Floats  # x, y, arc length, squared distance
    near_at: Ints  # segment of the curve, mesh vertex or -1, kind
    stack: Ints  # windows that wait
    windows: Ints
    nodes: Ints  # of the tree of boxes, that wait


@njit()
def new_view() -> View:
    """Empty tables."""
    return View(
        np.empty((16, 4)),
        np.empty((16, 3), np.intp),
        np.empty((64, 3), np.intp),
        np.empty((64, 3), np.intp),
        np.empty(DEPTH, np.intp),
    )


@njit(inline=True, borrows=True)
def sees(mesh: Mesh, spot: Spot, side: int, qx: float, qy: float) -> bool:
    """Whether the straight way from P to Q, a point on a boundary side, is free.

    Where rounding or a vertex on the way leaves a doubt, the answer is no.
    """
    if spot.vertex >= 0:
        t = triangle_towards(mesh, spot.vertex, qx, qy)
    else:
        t = -1 if is_beyond(mesh, spot.side, qx, qy) else spot.side // 3
    if t < 0:
        return False
    _, obstacle = walk(mesh, t, side // 3, spot.x, spot.y, qx, qy)
    return obstacle == -1


# -- looking around --------------------------------------------------------------------------------


@njit(inline=True, borrows=True)
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


@njit(borrows=True)
def ray_meets_side(
    px: float, py: float, rx: float, ry: float, ax: float, ay: float, bx: float, by: float
) -> float:
    """Share of the way from a to b at which the ray from p by r meets it; NaN if it does not."""
    at_a = (rx - px) * (ay - py) - (ry - py) * (ax - px)
    at_b = (rx - px) * (by - py) - (ry - py) * (bx - px)
    return at_a / (at_a - at_b) if at_a != at_b else np.nan


@njit(inline=True, borrows=True)
def nearest_on_side(
    mesh: Mesh,
    goal: Goal,
    e: int,
    right: int,
    left: int,
    px: float,
    py: float,
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
        px * goal.scale_x,
        py * goal.scale_y,
        ux * goal.scale_x,
        uy * goal.scale_y,
        vx * goal.scale_x,
        vy * goal.scale_y,
        first,
        last,
        kind_first,
        kind_last,
    )


@njit(inline=True, borrows=True)
def offer_of_segment(
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
    """Return what a side on the curve offers: share of the way along it, arc length, kind."""
    j, arc = goal.segment[side], goal.chain.arc
    length = arc[j + 1] - arc[j]
    is_forward = goal.chain.vertex[j] == mesh.tri[side]
    share_low, share_high = 0.0, 1.0
    if low > arc[j] or high < arc[j + 1]:
        share_low, share_high = (low - arc[j]) / length, (high - arc[j]) / length
        if not is_forward:
            share_low, share_high = 1.0 - share_high, 1.0 - share_low
    share, kind = nearest_on_side(mesh, goal, side, right, left, x, y, share_low, share_high)
    along = share if is_forward else 1.0 - share
    at = arc[j + 1] if along == 1.0 else arc[j] + along * length
    return share, at, kind


@njit(inline=True, borrows=True)
def offer_of_ends(
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
    """Return what a boundary side that is not on the curve offers: an end of it that is.

    Next to the curve's ends, and where a hole touches the curve, a vertex of the curve may be seen
    where no segment of it is.
    """
    best, share, at = np.inf, np.nan, np.nan
    for end in range(2):
        v = mesh.tri[side if end == 0 else next_side(side)]
        i = goal.place[v]
        if i < 0 or goal.chain.arc[i] < low or goal.chain.arc[i] > high:
            continue
        ray = right if end == 0 else left
        turn = 0.0 if ray == v else orient(x, y, mesh.x[ray], mesh.y[ray], mesh.x[v], mesh.y[v])
        is_shown = turn >= 0.0 if end == 0 else turn <= 0.0
        dx, dy = (mesh.x[v] - x) * goal.scale_x, (mesh.y[v] - y) * goal.scale_y
        if is_shown and dx * dx + dy * dy < best:
            best, share, at = dx * dx + dy * dy, float(end), goal.chain.arc[i]
    return share, at, VERTEX


@njit()
def look(
    mesh: Mesh, goal: Goal, spot: Spot, low: float, high: float, bound: float, view: View
) -> tuple[View, int]:
    """Look around: put the points of the curve that are seen in ``view.near``.

    Only those not farther than ``bound`` nor, when found, than the nearest so far. Return the
    view, with larger tables if need be, and a count.
    """
    x, y = spot.x, spot.y
    # Fields taken out once: each access to one of a tuple counts references (a fifth faster).
    tri, twin, mesh_x, mesh_y = mesh.tri, mesh.twin, mesh.x, mesh.y
    segment, scale_x, scale_y = goal.segment, goal.scale_x, goal.scale_y
    near, near_at, stack = view.near, view.near_at, view.stack
    bound = bound * bound
    count, depth, left_to_do = 0, 0, WINDOWS_PER_SIDE * mesh.tri.size
    windows, n_windows = first_windows(mesh, spot, view.windows)
    while True:
        # 1. Boundary sides make their offer; open sides that are near enough wait.
        for i in range(n_windows):
            e, right, left = windows[i, 0], windows[i, 1], windows[i, 2]
            u, v = tri[e], tri[next_side(e)]
            ux, uy, vx, vy = mesh_x[u], mesh_y[u], mesh_x[v], mesh_y[v]
            if squared_distance_to_side(x, y, ux, uy, vx, vy, scale_x, scale_y) > bound:
                continue
            if twin[e] >= 0:
                stack = with_room(stack, depth)
                depth = add_window(stack, depth, e, right, left)
                continue
            if segment[e] >= 0:
                share, arc, kind = offer_of_segment(mesh, goal, e, right, left, x, y, low, high)
            else:
                share, arc, kind = offer_of_ends(mesh, goal, e, right, left, x, y, low, high)
            if np.isnan(share):
                continue
            qx, qy = ux + share * (vx - ux), uy + share * (vy - uy)
            if share == 1.0:
                qx, qy = vx, vy
            d = ((qx - x) * scale_x) ** 2 + ((qy - y) * scale_y) ** 2
            if d > bound:
                continue
            radius = np.sqrt(d)
            bound = min(bound, (radius + slack_of(goal.tie, radius)) ** 2)
            if count == near.shape[0]:
                room = 2 * near.shape[0]
                near, near_at = with_rows(near, room), with_rows(near_at, room)
            vertex = v if share == 1.0 else u if share == 0.0 else -1
            near[count, 0], near[count, 1], near[count, 2], near[count, 3] = qx, qy, arc, d
            near_at[count, 1], near_at[count, 2] = vertex, kind
            near_at[count, 0] = segment[e] if vertex < 0 else segment_at(goal, vertex)
            count += 1
        # 2. The open side that came last is looked through.
        left_to_do -= 1
        if depth == 0 or left_to_do == 0:
            break
        depth -= 1
        right, left = stack[depth, 1], stack[depth, 2]
        e = twin[stack[depth, 0]]
        w = tri[previous_side(e)]
        by_right = orient(x, y, mesh_x[right], mesh_y[right], mesh_x[w], mesh_y[w])
        by_left = orient(x, y, mesh_x[left], mesh_y[left], mesh_x[w], mesh_y[w])
        n_windows = part_window(e, w, right, left, by_right, by_left, windows)
    return View(near, near_at, stack, windows, view.nodes), count


@njit(borrows=True)
def segment_at(goal: Goal, vertex: int) -> int:
    """Segment of the curve that leaves one of its vertices; of its end, the one that arrives.

    So too where a bridge leaves the vertex.
    """
    j = min(goal.place[vertex], goal.chain.side.size - 1)
    return j if goal.chain.side[j] >= 0 else j - 1


# -- ties ------------------------------------------------------------------------------------------


@njit(borrows=True)
def keep_ties(tie: float, view: View, count: int) -> int:
    """Sort the points found by arc length; drop those that are not nearest, or double.

    A vertex is double if a foot next to it differs by rounding only.
    """
    near, near_at = view.near, view.near_at
    best = np.inf
    for i in range(count):
        best = min(best, near[i, 3])
    radius = np.sqrt(best)
    slack = slack_of(tie, radius)
    limit = (radius + slack) ** 2
    kept = 0
    for i in range(count):
        x, y, arc, squared = near[i, 0], near[i, 1], near[i, 2], near[i, 3]
        segment, vertex, kind = near_at[i, 0], near_at[i, 1], near_at[i, 2]
        if squared > limit:
            continue
        is_double = False
        j = kept
        while j > 0 and near[j - 1, 2] >= arc - slack:
            is_double = is_double or near[j - 1, 2] <= arc + slack
            j -= 1
        if is_double:
            continue
        for m in range(kept, j, -1):
            for k in range(4):
                near[m, k] = near[m - 1, k]
            for k in range(3):
                near_at[m, k] = near_at[m - 1, k]
        near[j, 0], near[j, 1], near[j, 2], near[j, 3] = x, y, arc, squared
        near_at[j, 0], near_at[j, 1], near_at[j, 2] = segment, vertex, kind
        kept += 1
    return kept
