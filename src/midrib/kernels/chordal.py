r"""The chordal axis: the line through the middles of the sides of an area's triangles.

A *door* is a side that two triangles share. A triangle with one door holds a tip of the axis, one
with two doors a piece of a branch, one with three a junction:

      /|\          /\            .   door, at its middle the axis passes
     / . \       _/__\_
    /__|__\     /_.__._\          tip, piece, junction
       1           2
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh
from midrib.kernels.tables import with_rows
from midrib.kernels.triangulation import next_side, previous_side
from midrib.types import Floats, Ints

__all__ = ["chordal_axis", "circumcentre"]


@njit(borrows=True)
def circumcentre(
    ax: float, ay: float, bx: float, by: float, cx: float, cy: float
) -> tuple[float, float]:
    """Centre of the circle through three points; not finite if they lie on a line."""
    ux, uy, wx, wy = bx - ax, by - ay, cx - ax, cy - ay
    doubled = 2.0 * (ux * wy - uy * wx)
    u, w = ux * ux + uy * uy, wx * wx + wy * wy
    if doubled == 0.0:
        return np.inf, np.inf
    return ax + (wy * u - uy * w) / doubled, ay + (ux * w - wx * u) / doubled


@njit(borrows=True)
def widest_side(mesh: Mesh, t: int, scale_x: float, scale_y: float) -> tuple[int, bool]:
    """Longest side of a triangle, and whether the angle opposite is a right one or more."""
    longest, side, total = -1.0, -1, 0.0
    for e in range(3 * t, 3 * t + 3):
        a, b = mesh.tri[e], mesh.tri[next_side(e)]
        dx, dy = (mesh.x[b] - mesh.x[a]) * scale_x, (mesh.y[b] - mesh.y[a]) * scale_y
        squared = dx * dx + dy * dy
        total += squared
        if squared > longest:
            longest, side = squared, e
    return side, 2.0 * longest >= total


@njit(entry=True)
def chordal_axis(mesh: Mesh, scale_x: float, scale_y: float) -> tuple[Floats, Ints]:
    """Chordal axis of an area as a graph.

    Parameters
    ----------
    mesh : the area
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    points : (n, 2)
    edges : (m, 2) rows of points

    Notes
    -----
    A junction is the centre of the circle through the corners of its triangle where that lies
    inside; else it is the middle of the longest side, which the two others are joined to: the
    chord there is the widest, and a point inside would make the axis jag. O(n).

    References
    ----------
    Bader and Weibel, Detecting and resolving size and proximity conflicts in the generalization of
    polygonal maps, 18th International Cartographic Conference, 1997; for junctions Prasad,
    Morphological analysis of shapes, CNLS Newsletter 139, 1997.
    """
    m = mesh.tri.size
    points, edges = np.empty((m + 1, 2)), np.empty((m, 2), np.intp)
    place, n, count = np.full(m, -1, np.intp), 0, 0
    for e in range(m):
        if e < mesh.twin[e]:
            a, b = mesh.tri[e], mesh.tri[next_side(e)]
            points[n, 0], points[n, 1] = (
                (mesh.x[a] + mesh.x[b]) / 2.0,
                (mesh.y[a] + mesh.y[b]) / 2.0,
            )
            place[e] = place[mesh.twin[e]] = n
            n += 1
    door = np.empty(3, np.intp)
    for t in range(m // 3):
        doors = 0
        for e in range(3 * t, 3 * t + 3):
            if mesh.twin[e] >= 0:
                door[doors] = e
                doors += 1
        if doors == 1:
            v = mesh.tri[previous_side(door[0])]
            points[n, 0], points[n, 1] = mesh.x[v], mesh.y[v]
            edges[count, 0], edges[count, 1] = n, place[door[0]]
            n, count = n + 1, count + 1
        elif doors == 2:
            edges[count, 0], edges[count, 1] = place[door[0]], place[door[1]]
            count += 1
        else:
            n, count = write_junction(mesh, t, place, points, edges, n, count, scale_x, scale_y)
    return with_rows(points[:n], n), with_rows(edges[:count], count)


@njit(borrows=True)
def write_junction(
    mesh: Mesh,
    t: int,
    place: Ints,
    points: Floats,
    edges: Ints,
    n: int,
    count: int,
    scale_x: float,
    scale_y: float,
) -> tuple[int, int]:
    """Write the junction in a triangle with three doors, or the star of one that has none."""
    side, is_wide = widest_side(mesh, t, scale_x, scale_y)
    is_alone = mesh.twin[side] < 0
    a, b, c = mesh.tri[3 * t], mesh.tri[3 * t + 1], mesh.tri[3 * t + 2]
    hub = place[side]
    if is_alone or not is_wide:
        hub = n
        x, y = (mesh.x[a] + mesh.x[b] + mesh.x[c]) / 3.0, (mesh.y[a] + mesh.y[b] + mesh.y[c]) / 3.0
        if not is_alone:
            x, y = circumcentre(
                mesh.x[a] * scale_x, mesh.y[a] * scale_y, mesh.x[b] * scale_x,
                mesh.y[b] * scale_y, mesh.x[c] * scale_x, mesh.y[c] * scale_y,
            )  # fmt: skip
            x, y = x / scale_x, y / scale_y
        points[n, 0], points[n, 1] = x, y
        n += 1
    for e in range(3 * t, 3 * t + 3):
        end = place[e]
        if is_alone:
            end = n
            points[n, 0], points[n, 1] = mesh.x[mesh.tri[e]], mesh.y[mesh.tri[e]]
            n += 1
        if end != hub:
            edges[count, 0], edges[count, 1] = hub, end
            count += 1
    return n, count
