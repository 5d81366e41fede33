"""Minimal radii: from points P of the main curve to the nearest visible Q of the auxiliary one.

A radius is *lopsided* if Q sees the main curve nearer than P by a given factor: then P lies in a
bay, and the middle of PQ is not between the banks.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import nearest_on_chain
from midrib.kernels.chain import TIE_OF_RADIUS, Chain, Goal, goal_of, slack_of
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.tables import with_rows
from midrib.kernels.visibility import View, keep_ties, look, new_view, sees
from midrib.kernels.windows import spot_at
from midrib.types import Bools, Floats, Ints

__all__ = ["draw_radii"]


class Drawn(NamedTuple):
    """Radii in order of travel."""

    points: Floats  # (k, 6) P, Q, arc length of Q, radius
    at: Ints  # (k, 6) index, side and vertex of P; segment, vertex and kind of Q
    is_lopsided: Bools  # (k,)


@njit(entry=True)
def draw_radii(
    mesh: Mesh,
    main: Chain,
    auxiliary: Chain,
    points: Floats,
    p_side: Ints,
    p_vertex: Ints,
    low: Floats,
    high: Floats,
    lopsided: float,
    scale_x: float,
    scale_y: float,
) -> Drawn:
    """Nearest points of the auxiliary curve that each P sees.

    Parameters
    ----------
    mesh : the area
    main, auxiliary : the two curves
    points : (n, 2) points P of the main curve
    p_side : (n,) the boundary side that each P lies on
    p_vertex : (n,) the mesh vertex that P is, or -1
    low, high : (n,) only points with an arc length from low to high count
    lopsided : a radius is, if Q sees the main curve nearer by this factor; 0 to leave that open
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    Drawn
        Several radii for one P where they tie, in order of travel along the auxiliary curve; none
        where P sees nothing.

    Notes
    -----
    Exact but for the rounding of the points themselves: every sign is. Time per P grows with the
    number of triangles nearer than the answer, some 10 to 20 in an area that is triangulated well.
    """
    n = points.shape[0]
    found, at, total = np.empty((n + 8, 6)), np.empty((n + 8, 6), np.intp), 0
    goal = goal_of(mesh, auxiliary, scale_x, scale_y)
    # Fields taken out once: each access to one of a tuple counts references.
    vertex, side, arc = auxiliary
    x, y, goal_x, goal_y, boxes = mesh.x, mesh.y, goal.x, goal.y, goal.boxes
    view = new_view()
    nodes = view.nodes
    reach, seen = np.inf, np.inf  # how far the nearest point at all is, and the nearest one seen
    for i in range(n):
        spot = spot_at(mesh, points[i, 0], points[i, 1], p_side[i], p_vertex[i])
        # 1. Both are at most a step farther than from the P before, if as many points count; the
        #    nearest one seen only mostly.
        if i > 0:
            dx, dy = spot.x - points[i - 1, 0], spot.y - points[i - 1, 1]
            step = length(dx * scale_x, dy * scale_y)
            reach = (reach + step) * (1.0 + TIE_OF_RADIUS) + goal.tie
            seen = (seen + step) * (1.0 + TIE_OF_RADIUS) + goal.tie
            if low[i] > low[i - 1] or high[i] < high[i - 1]:
                reach = np.inf
        # 2. The nearest point at all is the answer if P sees it, and it is not on a bridge.
        j, share, kind, squared, is_tie = nearest_on_chain(
            spot.x * scale_x,
            spot.y * scale_y,
            goal_x,
            goal_y,
            arc,
            boxes,
            low[i],
            high[i],
            reach,
            goal.tie if reach == np.inf else slack_of(goal.tie, reach),
            nodes,
        )
        reach = np.sqrt(squared)
        if j < 0:
            continue
        if total == at.shape[0]:
            room = 2 * found.shape[0]
            found, at = with_rows(found, room), with_rows(at, room)
        a, b = vertex[j], vertex[j + 1]
        qx = x[b] if share == 1.0 else x[a] + share * (x[b] - x[a])
        qy = y[b] if share == 1.0 else y[a] + share * (y[b] - y[a])
        if not is_tie and side[j] >= 0 and sees(mesh, spot, side[j], qx, qy):
            at_vertex = a if share == 0.0 else b if share == 1.0 else -1
            at_arc = arc[j + 1] if share == 1.0 else arc[j] + share * (arc[j + 1] - arc[j])
            found[total, 2], found[total, 3], found[total, 4] = qx, qy, at_arc
            found[total, 5] = seen = reach
            at[total, 0], at[total, 3], at[total, 4], at[total, 5] = i, j, at_vertex, kind
            total += 1
            continue
        # 3. Where it does not, or there are several, P looks around.
        view, count = look(mesh, goal, spot, low[i], high[i], seen, view)
        if count == 0 and seen < np.inf:
            view, count = look(mesh, goal, spot, low[i], high[i], np.inf, view)
        count = keep_ties(goal.tie, view, count)
        while total + count > at.shape[0]:
            room = 2 * found.shape[0]
            found, at = with_rows(found, room), with_rows(at, room)
        for k in range(count):
            found[total, 2], found[total, 3] = view.near[k, 0], view.near[k, 1]
            found[total, 4], found[total, 5] = view.near[k, 2], np.sqrt(view.near[k, 3])
            at[total, 0] = i
            for column in range(3):
                at[total, 3 + column] = view.near_at[k, column]
            total += 1
        seen = np.sqrt(view.near[0, 3]) if count > 0 else np.inf
    found, at = found[:total], at[:total]
    for k in range(total):
        i = at[k, 0]
        found[k, 0], found[k, 1] = points[i, 0], points[i, 1]
        at[k, 1], at[k, 2] = p_side[i], p_vertex[i]
    is_lopsided = np.zeros(total, np.bool_)
    if lopsided > 0.0:
        goal = goal_of(mesh, main, scale_x, scale_y)
        find_lopsided(mesh, goal, side, found, at, lopsided, view, is_lopsided)
    return Drawn(found, at, is_lopsided)


@njit(borrows=True)
def find_lopsided(
    mesh: Mesh,
    goal: Goal,
    side: Ints,
    found: Floats,
    at: Ints,
    factor: float,
    view: View,
    is_lopsided: Bools,
) -> None:
    """Write which radii are lopsided.

    The nearest point of the main curve at all comes nearer at most as fast as Q moves: as long as
    it cannot have come near enough, nobody has to look for it.
    """
    clear, last_x, last_y = 0.0, 0.0, 0.0  # nothing of the main curve is nearer to last than clear
    for i in range(found.shape[0]):
        x, y, radius = found[i, 2], found[i, 3], found[i, 5]
        bound = radius / factor
        moved = length((x - last_x) * goal.scale_x, (y - last_y) * goal.scale_y)
        if (clear - moved) * (1.0 - TIE_OF_RADIUS) > bound:
            continue
        last_x, last_y = x, y
        j, share, _, squared, _ = nearest_on_chain(
            x * goal.scale_x,
            y * goal.scale_y,
            goal.x,
            goal.y,
            goal.chain.arc,
            goal.boxes,
            -np.inf,
            np.inf,
            radius,
            0.0,
            view.nodes,
        )
        clear = min(radius, np.sqrt(squared))
        if clear > bound:
            continue
        a, b = goal.chain.vertex[j], goal.chain.vertex[j + 1]
        qx = mesh.x[b] if share == 1.0 else mesh.x[a] + share * (mesh.x[b] - mesh.x[a])
        qy = mesh.y[b] if share == 1.0 else mesh.y[a] + share * (mesh.y[b] - mesh.y[a])
        spot = spot_at(mesh, x, y, side[at[i, 3]], at[i, 4])
        is_lopsided[i] = sees(mesh, spot, goal.chain.side[j], qx, qy)
        if not is_lopsided[i]:
            view, count = look(mesh, goal, spot, -np.inf, np.inf, bound, view)
            is_lopsided[i] = count > 0
