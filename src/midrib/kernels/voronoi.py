"""Voronoi diagram of the points of a boundary, inside: centres of the circles around triangles."""

import numpy as np

from midrib.kernels.chordal import circumcentre
from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh
from midrib.kernels.tables import with_rows
from midrib.types import Floats, Ints

__all__ = ["voronoi_inside"]


@njit(entry=True)
def voronoi_inside(mesh: Mesh) -> tuple[Floats, Ints]:
    """Voronoi vertices and edges whose triangles and sides are inside an area.

    Parameters
    ----------
    mesh : the area; its triangles are Delaunay but for its sides

    Returns
    -------
    points : (n, 2) one for each triangle; not finite where it has no area
    edges : (m, 2) rows of points. O(n).
    """
    n = mesh.tri.size // 3
    points, edges, count = np.empty((n, 2)), np.empty((mesh.tri.size, 2), np.intp), 0
    for t in range(n):
        a, b, c = mesh.tri[3 * t], mesh.tri[3 * t + 1], mesh.tri[3 * t + 2]
        points[t, 0], points[t, 1] = circumcentre(
            mesh.x[a], mesh.y[a], mesh.x[b], mesh.y[b], mesh.x[c], mesh.y[c]
        )
    for e in range(mesh.tri.size):
        if e < mesh.twin[e]:
            edges[count, 0], edges[count, 1] = e // 3, mesh.twin[e] // 3
            count += 1
    return points, with_rows(edges[:count], count)
