"""The straight skeleton of an area: where the bisectors of its shrinking edges run."""

from typing import NamedTuple

import numpy as np

from midrib.curves.turning import TURNS, turned, turned_back
from midrib.errors import InvariantError
from midrib.kernels.mesh import Mesh
from midrib.kernels.roof import Faces, faces_of, ridges_of
from midrib.kernels.straight import Roof, straight_skeleton
from midrib.layout import boundary_of
from midrib.ragged import normalised
from midrib.types import Floats, Ints

__all__ = ["StraightSkeleton", "straight_skeleton_in", "straight_skeleton_of"]


class StraightSkeleton(NamedTuple):
    """A straight skeleton as a roof over its area.

    points  (n, 2) nodes: first the vertices of the area, as many as it has edges
    time    (n,) distance of each to the lines of its edges: not the radius near reflex vertices
    ridges  (m, 2) nodes that are joined
    faces   the nodes round the face of each edge, from its end to its start
    """

    points: Floats
    time: Floats
    ridges: Ints
    faces: list[Ints]


def straight_skeleton_of(coordinates: Floats, starts: Ints) -> StraightSkeleton:
    """Find the straight skeleton of one valid area.

    Parameters
    ----------
    coordinates : (n, 2) array of float
        Closed rings one after the other, the shell first.
    starts : (k + 1,) array of int
        Where each starts.

    Returns
    -------
    StraightSkeleton

    Raises
    ------
    InvalidAreaError
        If rings cross.
    InvariantError
        If the skeleton that was found is not sound.

    Notes
    -----
    O(n log n) in practice. Things that happen within 1e-12 of the extent of each other are taken
    to happen at once. Every skeleton is checked before it is returned: nodes lie on the planes of
    their faces to 1e-9 of the extent, and every face is one walk; see ``kernels.roof``. One that is
    not sound is found again of the area turned by a radian, and so on: where many things happen at
    once, as on squared paper, rounding decides in which order, and decides anew.
    """
    return straight_skeleton_in(boundary_of(normalised(coordinates, starts)[0]).mesh)


def straight_skeleton_in(mesh: Mesh) -> StraightSkeleton:
    """Find the straight skeleton of the area of a mesh; see ``straight_skeleton_of``."""
    mesh, origin, unit = unit_mesh(mesh)
    for turn in range(TURNS):
        roof = turned_roof(mesh, float(turn))
        faces = faces_of(mesh, roof)
        if faces.is_sound:
            break
    else:
        raise InvariantError(unsound(mesh, roof, faces))
    walks = np.split(faces.nodes, faces.offsets[1:-1])
    points = roof.node[:, :2] * unit + origin
    return StraightSkeleton(points, roof.node[:, 2] * unit, ridges_of(mesh, roof), walks)


def turned_roof(mesh: Mesh, angle: float) -> Roof:
    """Roof of the area of a unit mesh, found of the area turned by an angle in radians."""
    if angle == 0.0:
        return straight_skeleton(mesh)
    unit = np.ones(2)
    roof = straight_skeleton(turned(mesh, angle, unit))
    points = turned_back(roof.node[:, :2], roof.node[:, 2] == 0.0, mesh, angle, unit)
    return roof._replace(node=np.column_stack([points, roof.node[:, 2]]))


def unit_mesh(mesh: Mesh) -> tuple[Mesh, Floats, float]:
    """Mesh about the origin with an extent of 1/2 to 1; where it was, and the unit of length."""
    origin = np.array([mesh.x[0], mesh.y[0]])
    extent = max(np.ptp(mesh.x), np.ptp(mesh.y))
    unit = float(2.0 ** np.ceil(np.log2(extent)))  # a power of two: nothing is rounded
    return mesh._replace(x=(mesh.x - origin[0]) / unit, y=(mesh.y - origin[1]) / unit), origin, unit


def unsound(mesh: Mesh, roof: Roof, faces: Faces) -> str:
    """Say what is wrong with a skeleton."""
    nodes, arcs = len(roof.node), len(roof.arc)
    return (
        f"the straight skeleton of {mesh.x.size} vertices has {nodes} nodes, {arcs} arcs and "
        f"a node {faces.miss:.3g} of the extent off its plane, "
        "expected a roof; please report the area"
    )
