"""Heights inside an area whose boundary has them: those of the triangles between its vertices."""

import numpy as np

from midrib.kernels.mesh import Mesh
from midrib.types import Floats

__all__ = ["heights_inside"]


def heights_inside(mesh: Mesh, height: Floats, points: Floats) -> Floats:
    """Height of each point on the triangle of the mesh that it lies in.

    Exact on a plane. O(k m) for k points and m triangles: it is for the few points of a curve that
    are on neither a radius nor a vertex.

    Parameters
    ----------
    mesh : Mesh
    height : (n,) of each mesh vertex
    points : (k, 2) in the area

    Returns
    -------
    (k,) heights; NaN where a corner of the triangle has none.
    """
    corners = mesh.tri.reshape(-1, 3)
    x, y, z = mesh.x[corners], mesh.y[corners], height[corners]
    found = np.empty(len(points))
    for i, (px, py) in enumerate(points):
        # Areas of the triangles that the point makes with each side, opposite of each corner.
        dx, dy = x - px, y - py
        parts = np.roll(dx, -1, axis=1) * np.roll(dy, -2, axis=1)
        parts -= np.roll(dy, -1, axis=1) * np.roll(dx, -2, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            shares = parts / parts.sum(axis=1, keepdims=True)
        # The triangle it is in, or that rounding leaves it nearest to; slivers may have no area.
        least = shares.min(axis=1)
        k = np.argmax(np.where(np.isfinite(least), least, -np.inf))
        found[i] = shares[k] @ z[k]
    return found
