r"""The mesh of an area: its triangles, and which side of which triangle lies on which ring segment.

Half-edges are those of ``triangulation``. A *boundary side* is a half-edge without a twin; it runs
with its ring, so the area lies on its left. The interior triangles around a vertex form one *fan*
from one boundary side to the next, or several where rings touch.

           .-----.          door[v]        a boundary side that leaves v
          / \\ 2 / \\         other_door[e]  the next boundary side that leaves the same vertex
         / 3 \\ / 1 \\                       as e, or -1
        -------v-----> door[v]
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.places import place
from midrib.kernels.predicates import orient
from midrib.kernels.tables import longer, longer_ints
from midrib.kernels.triangulation import next_side, previous_side, triangulate_rings
from midrib.types import Floats, Ints

__all__ = [
    "Mesh",
    "Triangulated",
    "boundary_size",
    "contains",
    "doors",
    "is_beyond",
    "is_beyond_side",
    "mesh_rings",
    "next_boundary_side",
    "pull_inside",
    "split_side",
]

ROUNDING_REACH = 2.0**-48  # of the coordinates: 16 units in the last place
PULLS = 48


class Mesh(NamedTuple):
    """Vertices, half-edges of interior triangles, and the doors to the fans around vertices."""

    x: Floats
    y: Floats
    tri: Ints
    twin: Ints
    door: Ints
    other_door: Ints


class Triangulated(NamedTuple):
    """What triangulating rings gave; ``mesh`` is valid if status is 0 and nothing touches."""

    status: int
    mesh: Mesh
    side_of_segment: Ints
    vertex_of: Ints
    touches: Ints
    is_valid: bool  # rings are apart, simple and within each other as those of a valid area are


@njit(borrows=True)
def next_boundary_side(mesh: Mesh, e: int) -> int:
    """Return the boundary side that follows e around the inside: the other end of its fan."""
    e = next_side(e)
    door = mesh.door[mesh.tri[e]]
    if mesh.other_door[door] < 0:  # there is but one fan, and this is where it ends
        return door
    while mesh.twin[e] >= 0:
        e = next_side(place(mesh.twin[e]))
    return e


@njit(borrows=True)
def boundary_size(mesh: Mesh) -> int:
    """How many sides of the mesh are on the boundary."""
    count = 0
    for e in range(mesh.twin.size):
        if mesh.twin[e] < 0:
            count += 1
    return count


@njit()
def doors(n: int, tri: Ints, twin: Ints) -> tuple[Ints, Ints]:
    """Boundary sides by the vertex they leave."""
    door, other_door = np.full(n, -1, np.intp), np.full(tri.size, -1, np.intp)
    for e in range(tri.size):
        if twin[e] < 0:
            other_door[e] = door[tri[e]]
            door[tri[e]] = e
    return door, other_door


@njit(entry=True)
def mesh_rings(x: Floats, y: Floats, ring_next: Ints, by_rings: bool) -> Triangulated:
    """Mesh of what lies to the left of the rings; see ``triangulate_rings``.

    ``side_of_segment[k]`` is the boundary side on ring segment k, ``vertex_of[k]`` the mesh vertex
    of ring vertex k (rings that touch share one), ``touches[k]`` a vertex inside segment k or -1.
    """
    status, tri, twin, side_of_segment, same, touches, is_valid = triangulate_rings(
        x, y, ring_next, by_rings
    )
    if is_valid:  # one boundary side leaves each vertex: that on its own segment
        door, other_door = side_of_segment.copy(), np.full(tri.size, -1, np.intp)
    else:
        door, other_door = doors(x.size, tri, twin)
    return Triangulated(
        status, Mesh(x, y, tri, twin, door, other_door), side_of_segment, same, touches, is_valid
    )


@njit(borrows=True)
def is_beyond(mesh: Mesh, e: int, px: float, py: float) -> bool:
    """Whether p lies beyond side e, seen from its triangle."""
    a, b = place(mesh.tri[e]), place(mesh.tri[next_side(e)])
    return orient(mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b], px, py) < 0.0


@njit(borrows=True)
def contains(mesh: Mesh, t: int, px: float, py: float) -> bool:
    """Whether the closed triangle t holds p, exactly."""
    return side_before(mesh, t, px, py) < 0


@njit(borrows=True)
def side_before(mesh: Mesh, t: int, px: float, py: float) -> int:
    """Return a side of triangle t that has p beyond it; -1 if the closed triangle holds p."""
    for k in range(3):
        if is_beyond_side(mesh, t, k, px, py):
            return 3 * t + k
    return -1


@njit(borrows=True)
def is_beyond_side(mesh: Mesh, t: int, k: int, px: float, py: float) -> bool:
    """Whether p lies beyond side k of triangle t, as ``is_beyond``: with no remainder to take."""
    e = 3 * place(t)
    a, b = place(mesh.tri[e + k]), place(mesh.tri[e + (k + 1 if k < 2 else 0)])
    return orient(mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b], px, py) < 0.0


@njit(borrows=True)
def pull_inside(mesh: Mesh, t: int, px: float, py: float) -> tuple[float, float, bool]:
    """Return p, or a point next to it that is exactly inside triangle t, and whether there is one.

    The first of a series of points towards the middle of t; only rounding is made good.
    """
    e = side_before(mesh, t, px, py)
    if e < 0:
        return px, py, True
    a, b, c = mesh.tri[3 * t], mesh.tri[3 * t + 1], mesh.tri[3 * t + 2]
    middle_x = mesh.x[a] + ((mesh.x[b] - mesh.x[a]) + (mesh.x[c] - mesh.x[a])) / 3.0
    middle_y = mesh.y[a] + ((mesh.y[b] - mesh.y[a]) + (mesh.y[c] - mesh.y[a])) / 3.0
    share = 2.0**-52
    reach = ROUNDING_REACH * (abs(px) + abs(py) + abs(middle_x) + abs(middle_y))
    for _ in range(PULLS):
        qx, qy = px + (middle_x - px) * share, py + (middle_y - py) * share
        if abs(qx - px) + abs(qy - py) > reach:
            break
        if (qx != px or qy != py) and not is_beyond(mesh, e, qx, qy):
            e = side_before(mesh, t, qx, qy)
            if e < 0:
                return qx, qy, True
        share *= 2.0
    return px, py, False


@njit()
def split_side(mesh: Mesh, e: int, px: float, py: float) -> tuple[Mesh, int]:
    """Insert a vertex at p, a point on boundary side e; return the new mesh and the new side.

    p is pulled inside by rounding's width where it lies outside, so the new mesh never leaves the
    old area. The side e is cut to its first part; the new side is its second part and leaves the
    new vertex, which is the last one; the side that followed e now follows the new one. The side
    is -1, and the mesh unchanged, where p cannot be told from an end of e.
    """
    t = e // 3
    px, py, is_inside = pull_inside(mesh, t, px, py)
    a, b, c = mesh.tri[e], mesh.tri[next_side(e)], mesh.tri[previous_side(e)]
    turn_a = orient(mesh.x[c], mesh.y[c], mesh.x[a], mesh.y[a], px, py)
    turn_b = orient(mesh.x[b], mesh.y[b], mesh.x[c], mesh.y[c], px, py)
    if not is_inside or turn_a <= 0.0 or turn_b <= 0.0:
        return mesh, -1
    p, size = mesh.x.size, mesh.tri.size
    x, y = longer(mesh.x, px), longer(mesh.y, py)
    # (a, b, c) becomes (a, p, c) in place and (p, b, c) as the last triangle.
    tri = longer_ints(mesh.tri, size, (p, b, c))
    twin = longer_ints(mesh.twin, size, (-1, -1, -1))
    tri[next_side(e)] = p
    beyond = mesh.twin[next_side(e)]
    twin[next_side(e)], twin[size + 2] = size + 2, next_side(e)
    twin[size + 1] = beyond
    if beyond >= 0:
        twin[beyond] = size + 1
    door, other_door = doors(p + 1, tri, twin)
    return Mesh(x, y, tri, twin, door, other_door), size
