r"""A ring-shaped area cut open along one side of its mesh, the seam.

      a'|b' ___ a b        e, f    the two half-edges of the seam
       \\ |   | /          a, b    its ends on the one edge and on the other; a' and b' are copies
    ___ e|   |f ___        The slit area has two curves with ends: from a to a', from b to b'.

Far from the seam, what is nearest there is nearest in the ring.
"""

import numpy as np

from midrib.kernels.chain import Chain
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh, doors, next_boundary_side
from midrib.kernels.tables import longer
from midrib.kernels.triangulation import next_side, previous_side

__all__ = ["around", "slit_open"]


@njit(entry=True)
def around(mesh: Mesh, side: int, start: int, last: int, is_backward: bool) -> Chain:
    """Chain of a ring, from vertex ``start`` of it back to there.

    Parameters
    ----------
    mesh : the area
    side : a boundary side of the ring
    start : vertex that the chain starts at
    last : number of the vertex that it ends at: the same, or its copy
    is_backward : whether it runs against its sides
    """
    n, e, first = 1, next_boundary_side(mesh, side), side
    while e != side and n < mesh.tri.size:
        if mesh.tri[next_side(e) if is_backward else e] == start:
            first = e
        n, e = n + 1, next_boundary_side(mesh, e)
    vertex, sides, arc = np.empty(n + 1, np.intp), np.empty(n, np.intp), np.zeros(n + 1)
    e = first
    for i in range(n):
        sides[(n - i) % n if is_backward else i] = e
        e = next_boundary_side(mesh, e)
    for i in range(n):
        a, b = mesh.tri[sides[i]], mesh.tri[next_side(sides[i])]
        vertex[i] = b if is_backward else a
        arc[i + 1] = arc[i] + length(mesh.x[b] - mesh.x[a], mesh.y[b] - mesh.y[a])
    vertex[n] = last
    return Chain(vertex, sides, arc)


@njit(entry=True)
def slit_open(mesh: Mesh, e: int) -> Mesh:
    """Cut a ring-shaped area along a side from edge to edge.

    Parameters
    ----------
    mesh : the area
    e : half-edge from a, on the edge that has the area on its left, to b

    Returns
    -------
    Mesh
        With a copy of a and one of b as its last vertices: those of the triangles left of e.
    """
    n = mesh.x.size
    f = mesh.twin[e]
    a, b = mesh.tri[e], mesh.tri[f]
    x, y = (
        longer(longer(mesh.x, mesh.x[a]), mesh.x[b]),
        longer(longer(mesh.y, mesh.y[a]), mesh.y[b]),
    )
    tri, twin = mesh.tri.copy(), mesh.twin.copy()
    twin[e] = twin[f] = -1
    g = e
    while g >= 0:
        tri[g] = n
        g = mesh.twin[previous_side(g)]
    g = next_side(e)
    while True:
        tri[g] = n + 1
        if mesh.twin[g] < 0:
            break
        g = next_side(mesh.twin[g])
    door, other_door = doors(n + 2, tri, twin)
    return Mesh(x, y, tri, twin, door, other_door)
