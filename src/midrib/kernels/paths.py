r"""Shortest paths inside an area: the join between consecutive points of a curve.

Most joins are straight: a walk from p to q through the triangles on the way proves it. Where the
walk runs into the boundary, a search finds the *sleeve*, the triangles from p to q, and the
*funnel* pulls the path in it tight.

        left chain                    apex   where the pulled path has arrived
      a .------.                      a-b    a door of the sleeve: the side between two triangles
       /   ____  \\                    The funnel is the apex and the two chains that bound what the
 apex /___/    \\__.                   apex sees of the last door; a door that misses it moves the
      \\_________. b                   apex along a chain.
        right chain

Source: D. T. Lee, F. P. Preparata, Euclidean Shortest Paths in the Presence of Rectilinear
Barriers, Networks 14, 1984. All signs are exact, so no join leaves the area by rounding.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.heap import pop, push
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import (
    ROUNDING_REACH,
    Mesh,
    contains,
    is_beyond,
    is_beyond_side,
    pull_inside,
)
from midrib.kernels.predicates import orient
from midrib.kernels.tables import with_places, with_rows
from midrib.kernels.triangulation import next_side, previous_side
from midrib.types import Floats, Ints

__all__ = [
    "FARTHER",
    "Beads",
    "Search",
    "find_sleeve",
    "join_points",
    "locate_beside",
    "locate_from",
    "new_search",
    "pull_tight",
    "triangle_towards",
    "walk",
]


FARTHER = -2  # what is looked for is not where it should be


class Beads(NamedTuple):
    """Points in an area, up to rounding, and where on the boundary the search for each begins."""

    point: Floats  # (n, 2)
    origin: Floats  # (n, 2) points of the boundary that see them
    side: Ints  # (n,) the boundary side that each origin is on
    vertex: Ints  # (n,) the mesh vertex that it is, or -1


class Search(NamedTuple):
    """Tables for ``find_sleeve``, kept from one search to the next, and the metric."""

    scale_x: float
    scale_y: float
    entered: Ints  # for each triangle the side it was entered by; -1 between searches
    cost: Floats
    key: Floats
    heap: Ints


@njit()
def new_search(mesh: Mesh, scale_x: float, scale_y: float) -> Search:
    """Clean tables."""
    m = mesh.tri.size
    entered = np.full(m // 3, -1, np.intp)
    return Search(scale_x, scale_y, entered, np.empty(m), np.empty(m), np.empty(m, np.intp))


@njit(borrows=True)
def walk(
    mesh: Mesh, t: int, goal: int, px: float, py: float, qx: float, qy: float
) -> tuple[int, int]:
    """Go straight from p, in or before triangle t, to q, which triangle ``goal`` holds (or -1).

    Return the triangle that holds q and -1, or the last triangle and the boundary side in the way.
    Where the segment passes a vertex exactly, one of two ways is tried; the other may be free.
    """
    came_from = -1
    for _ in range(mesh.tri.size):
        if t == goal:
            return t, -1
        ahead, second = -1, -1
        for k in range(3):
            e = 3 * t + k
            if e == came_from:
                continue
            if is_beyond_side(mesh, t, k, qx, qy):
                if ahead < 0:
                    ahead = e
                else:
                    second = e
        if ahead < 0:
            return t, -1
        if second >= 0:
            # q is beyond two sides; the segment leaves on this or that side of their vertex.
            right, left = (ahead, second) if next_side(ahead) == second else (second, ahead)
            v = mesh.tri[left]
            turn = orient(px, py, qx, qy, mesh.x[v], mesh.y[v])
            ahead = right if turn > 0.0 or (turn == 0.0 and mesh.twin[right] >= 0) else left
        came_from = mesh.twin[ahead]
        if came_from < 0:
            return t, ahead
        t = came_from // 3
    return t, -2


@njit()
def find_sleeve(
    mesh: Mesh,
    start: int,
    goal: int,
    px: float,
    py: float,
    qx: float,
    qy: float,
    search: Search,
) -> Ints:
    """Sides crossed on the way from triangle ``start`` to ``goal``, by the middles of sides.

    A*: the key of a side is the way so far and the straight distance left. ``goal`` may be -1:
    then the triangle that holds q is looked for, and a sleeve to it returned.
    """
    scale_x, scale_y, entered, cost, key, heap = search
    size = 0
    touched = np.empty(64, np.intp)
    n_touched = 0
    from_x, from_y, so_far = px, py, 0.0
    t = start
    entered[start] = -2
    while t != goal and not (goal < 0 and contains(mesh, t, qx, qy)):
        for e in range(3 * t, 3 * t + 3):
            f = mesh.twin[e]
            if f < 0 or entered[f // 3] != -1:
                continue
            a, b = mesh.tri[e], mesh.tri[next_side(e)]
            mx, my = (mesh.x[a] + mesh.x[b]) / 2.0, (mesh.y[a] + mesh.y[b]) / 2.0
            new = so_far + length((mx - from_x) * scale_x, (my - from_y) * scale_y)
            cost[e] = new
            key[e] = new + length((qx - mx) * scale_x, (qy - my) * scale_y)
            size = push(heap, key, size, e)
        while size > 0:
            e = pop(heap, key, size)
            size -= 1
            if entered[mesh.twin[e] // 3] == -1:
                break
        else:
            t = start  # everything was searched
            break
        t = mesh.twin[e] // 3
        entered[t] = e
        if n_touched == touched.size:
            touched = with_places(touched, 2 * n_touched)
        touched[n_touched] = t
        n_touched += 1
        a, b = mesh.tri[e], mesh.tri[next_side(e)]
        from_x, from_y = (mesh.x[a] + mesh.x[b]) / 2.0, (mesh.y[a] + mesh.y[b]) / 2.0
        so_far = cost[e]
    goal = t
    n = 0
    while entered[t] >= 0:
        n += 1
        t = entered[t] // 3
    sleeve = np.empty(n, np.intp)
    t = goal
    for i in range(n - 1, -1, -1):
        sleeve[i] = entered[t]
        t = entered[t] // 3
    entered[start] = -1
    for i in range(n_touched):
        entered[touched[i]] = -1
    return sleeve


@njit()
def pull_tight(mesh: Mesh, sleeve: Ints, px: float, py: float, qx: float, qy: float) -> Ints:
    """Vertices at which the shortest path from p to q inside the sleeve turns."""
    n = sleeve.size
    turns = np.empty(n + 1, np.intp)
    count = 0
    ax, ay = px, py
    left, right = -1, -1
    left_at, right_at = 0, 0
    i = 0
    while i <= n:
        if i < n:
            new_right, new_left = mesh.tri[sleeve[i]], mesh.tri[next_side(sleeve[i])]
            nrx, nry, nlx, nly = (
                mesh.x[new_right],
                mesh.y[new_right],
                mesh.x[new_left],
                mesh.y[new_left],
            )
        else:
            new_right, new_left = -2, -2
            nrx, nry, nlx, nly = qx, qy, qx, qy
        # A new right end inside the funnel narrows it; past the left chain it moves the apex.
        if right == -1 or orient(ax, ay, mesh.x[right], mesh.y[right], nrx, nry) >= 0.0:
            passes = (
                left >= 0
                and new_right != left
                and (orient(ax, ay, mesh.x[left], mesh.y[left], nrx, nry) > 0.0)
            )
            if passes:
                turns[count] = left
                count += 1
                ax, ay = mesh.x[left], mesh.y[left]
                i = left_at + 1
                left, right = -1, -1
                continue
            right, right_at = new_right, i
        if left == -1 or orient(ax, ay, mesh.x[left], mesh.y[left], nlx, nly) <= 0.0:
            passes = (
                right >= 0
                and new_left != right
                and (orient(ax, ay, mesh.x[right], mesh.y[right], nlx, nly) < 0.0)
            )
            if passes:
                turns[count] = right
                count += 1
                ax, ay = mesh.x[right], mesh.y[right]
                i = right_at + 1
                left, right = -1, -1
                continue
            left, left_at = new_left, i
        i += 1
    return turns[:count]


@njit(borrows=True)
def triangle_towards(mesh: Mesh, v: int, qx: float, qy: float) -> int:
    """Return the triangle around vertex v through which the ray from v to q leaves; -1 if none."""
    x, y = mesh.x[v], mesh.y[v]
    door = mesh.door[v]
    while door >= 0:
        e = door
        a = mesh.tri[next_side(e)]
        by_right = orient(x, y, mesh.x[a], mesh.y[a], qx, qy)
        while e >= 0:
            b = mesh.tri[previous_side(e)]
            by_left = orient(x, y, mesh.x[b], mesh.y[b], qx, qy)
            if by_right >= 0.0 and by_left <= 0.0:
                return e // 3
            by_right = by_left
            e = mesh.twin[previous_side(e)]
        door = mesh.other_door[door]
    return -1


@njit(borrows=True)
def nearest_triangle(mesh: Mesh, qx: float, qy: float) -> tuple[int, float, float]:
    """Return the triangle that q, outside by rounding, has to move least into.

    -1 if q is farther out.
    """
    best, best_x, best_y, least = -1, qx, qy, np.inf
    reach = ROUNDING_REACH * 4.0 * max(abs(qx), abs(qy))
    for t in range(mesh.tri.size // 3):
        a, b, c = mesh.tri[3 * t], mesh.tri[3 * t + 1], mesh.tri[3 * t + 2]
        if min(mesh.x[a], mesh.x[b], mesh.x[c]) > qx + reach:
            continue
        if max(mesh.x[a], mesh.x[b], mesh.x[c]) < qx - reach:
            continue
        if min(mesh.y[a], mesh.y[b], mesh.y[c]) > qy + reach:
            continue
        if max(mesh.y[a], mesh.y[b], mesh.y[c]) < qy - reach:
            continue
        x, y, is_inside = pull_inside(mesh, t, qx, qy)
        moved = abs(x - qx) + abs(y - qy)
        if is_inside and moved < least:
            best, best_x, best_y, least = t, x, y, moved
    return best, best_x, best_y


@njit(borrows=True)
def locate_beside(
    mesh: Mesh,
    side: int,
    vertex: int,
    px: float,
    py: float,
    qx: float,
    qy: float,
    near: int,
) -> tuple[int, float, float]:
    """Return the triangle that holds q, seen from p on ``side`` (or at ``vertex``).

    Q may be pulled inside by rounding's width, in triangle ``near`` for one. FARTHER if it is in
    none of those: then ``locate_from`` searches for it.
    """
    t = side // 3 if vertex < 0 else triangle_towards(mesh, vertex, qx, qy)
    if vertex < 0 and is_beyond(mesh, side, px, py):
        px, py, _ = pull_inside(mesh, t, px, py)
    end = side // 3
    if t >= 0 and (vertex >= 0 or not is_beyond(mesh, side, qx, qy)):
        end, obstacle = walk(mesh, t, -1, px, py, qx, qy)
        if obstacle == -1:
            return end, qx, qy
    for t in (end, near):
        if t >= 0:
            x, y, is_inside = pull_inside(mesh, t, qx, qy)
            if is_inside:
                return t, x, y
    # Collinear vertices of the boundary make triangles without an inside; the next ones have one.
    for e in range(3 * end, 3 * end + 3):
        t = mesh.twin[e] // 3
        if t >= 0:
            x, y, is_inside = pull_inside(mesh, t, qx, qy)
            if is_inside:
                return t, x, y
    return FARTHER, qx, qy


@njit()
def locate_from(
    mesh: Mesh, side: int, px: float, py: float, qx: float, qy: float, search: Search
) -> tuple[int, float, float]:
    """Return the triangle that holds q, searched for from p on ``side`` on.

    Q may be pulled inside by rounding's width. -1 if q is farther outside.
    """
    t = side // 3
    sleeve = find_sleeve(mesh, t, -1, px, py, qx, qy, search)
    if sleeve.size > 0:
        t = mesh.twin[sleeve[-1]] // 3
    if contains(mesh, t, qx, qy):
        return t, qx, qy
    return nearest_triangle(mesh, qx, qy)


@njit(entry=True)
def join_points(mesh: Mesh, beads: Beads, scale_x: float, scale_y: float) -> tuple[Floats, Ints]:
    """Join points inside an area, one after the other, by shortest paths.

    Parameters
    ----------
    mesh : the area
    beads : the points
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    path : (k, 2) every point of the path, none equal to the one before
    source : (k,) the index of the point, or -1 - v for a mesh vertex v at which the path turns

    Notes
    -----
    The path lies in the closed area, exactly: every piece has been walked with exact signs. Time is
    proportional to the triangles crossed, with a logarithm where the straight way is blocked. With
    holes the sleeve is the one shortest by the middles of its doors. A point that is outside by
    more than rounding is left out.
    """
    n = beads.side.size
    search = new_search(mesh, scale_x, scale_y)
    path, source = np.empty((2 * n + 16, 2)), np.empty(2 * n + 16, np.intp)
    count, t = 0, -1
    from_x, from_y = 0.0, 0.0
    for i in range(n):
        qx, qy = beads.point[i, 0], beads.point[i, 1]
        turns = np.empty(0, np.intp)
        end, obstacle = -1, -2
        if t >= 0:
            end, obstacle = walk(mesh, t, -1, from_x, from_y, qx, qy)
        if obstacle != -1:
            side, ox, oy = beads.side[i], beads.origin[i, 0], beads.origin[i, 1]
            end, qx, qy = locate_beside(mesh, side, beads.vertex[i], ox, oy, qx, qy, end)
            if end == FARTHER:
                end, qx, qy = locate_from(mesh, side, ox, oy, qx, qy, search)
            if end < 0:
                continue
            if t >= 0:
                sleeve = find_sleeve(mesh, t, end, from_x, from_y, qx, qy, search)
                turns = pull_tight(mesh, sleeve, from_x, from_y, qx, qy)
        if count + turns.size + 1 > source.size:
            room = 2 * (count + turns.size + 1)
            path, source = with_rows(path, room), with_places(source, room)
        for v in turns:
            if mesh.x[v] != path[count - 1, 0] or mesh.y[v] != path[count - 1, 1]:
                path[count, 0], path[count, 1], source[count] = mesh.x[v], mesh.y[v], -1 - v
                count += 1
        if count == 0 or qx != path[count - 1, 0] or qy != path[count - 1, 1]:
            path[count, 0], path[count, 1], source[count] = qx, qy, i
            count += 1
        t, from_x, from_y = end, qx, qy
    return path[:count], source[:count]
