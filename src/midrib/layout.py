"""A strip as the kernels see it: one mesh, and which of its boundary sides each curve runs on."""

from typing import Literal, NamedTuple

import numpy as np

from midrib.errors import InvalidAreaError, InvariantError
from midrib.kernels.chain import Chain
from midrib.kernels.channels import with_islands
from midrib.kernels.division import AGAINST, LONGER, WITH, Divided, divide_shell
from midrib.kernels.mesh import Mesh, mesh_rings
from midrib.kernels.rings import Rings
from midrib.types import Floats, Ints

__all__ = [
    "NO_HEIGHT",
    "Boundary",
    "EndPoints",
    "Layout",
    "Main",
    "Scale",
    "boundary_of",
    "lay_out",
    "layout_of",
]

Scale = tuple[float, float]  # length of one unit of x and of y
Main = Literal["longer", "with", "against"]
RULES = {"longer": LONGER, "with": WITH, "against": AGAINST}
NO_HEIGHT = np.empty(0)


class Boundary(NamedTuple):
    """An area's mesh and its shell: vertices in order and the side that leaves each."""

    mesh: Mesh
    order: Ints
    side: Ints
    has_holes: bool
    height: Floats | None  # of each mesh vertex


class EndPoints(NamedTuple):
    """Two points for the ends of a curve, or none, and where the search for each begins."""

    point: Floats  # (2, 2)
    origin: Floats  # (2, 2) points of the boundary that see them
    at: Ints  # (2, 2) the boundary side each origin is on, and the mesh vertex it is or -1
    height: Floats  # (2,) Z, NaN if unknown


class Layout(NamedTuple):
    """Everything that the construction needs to know about a strip."""

    mesh: Mesh
    main: Chain
    auxiliary: Chain
    middle: EndPoints  # halfway between the two curves' starts, and their ends
    scale: Scale
    height: Floats | None
    mean_width: float  # area within the shell over the mean length of the two curves

    def bridged(self) -> "Layout":
        """Return the same strip with an auxiliary curve that goes round the islands too."""
        strip = self.mesh, self.main, self.auxiliary
        return self._replace(auxiliary=with_islands(*strip, *self.scale))

    def swapped(self) -> "Layout":
        """Return the same strip with main and auxiliary curve swapped."""
        return self._replace(main=self.auxiliary, auxiliary=self.main)

    @property
    def has_bridges(self) -> bool:
        """Whether the auxiliary curve goes round islands."""
        return bool(self.auxiliary.side.min() < 0)

    @property
    def shares_start(self) -> bool:
        """Whether the two curves start in the same vertex."""
        return bool(self.main.vertex[0] == self.auxiliary.vertex[0])

    @property
    def shares_end(self) -> bool:
        """Whether the two curves end in the same vertex."""
        return bool(self.main.vertex[-1] == self.auxiliary.vertex[-1])


def boundary_of(rings: Rings, height: Floats | None = None) -> Boundary:
    """Triangulate an area; where a vertex of one ring lies on a segment of another, both get it.

    Raises
    ------
    InvalidAreaError
        If rings cross or run along each other.
    """
    while True:
        # As they came: straight skeletons, which take what happens at once in the order of
        # triangles, are then found of street grids that have none by rings.
        done = mesh_rings(rings.x, rings.y, rings.ring_next, False)
        if done.status > 0:
            k = done.status - 1
            msg = f"the boundary crosses itself near ({rings.x[k]:.12g}, {rings.y[k]:.12g})"
            raise InvalidAreaError(msg)
        if done.status < 0:
            msg = f"triangulation of {rings.x.size} vertices did not end"
            raise InvariantError(msg)
        if done.touches.max() < 0:
            n = rings.n_shell
            if height is not None:
                height = height[rings.origin]
            order, side = done.vertex_of[:n], done.side_of_segment[:n]
            return Boundary(done.mesh, order, side, rings.x.size > n, height)
        rings = with_touches(rings, done.touches)


def with_touches(rings: Rings, touches: Ints) -> Rings:
    """Insert vertex touches[k] into segment k wherever it is not negative."""
    touched = np.flatnonzero(touches >= 0)
    index = np.insert(np.arange(rings.x.size), touched + 1, touches[touched])
    shift = np.cumsum(np.bincount(touched + 1, minlength=rings.x.size + 1))
    place = np.arange(rings.x.size) + shift[:-1]  # of each old vertex
    ring_next = np.empty(index.size, np.intp)
    ring_next[place] = place[rings.ring_next]
    new = place[touched] + 1
    ring_next[place[touched]] = new
    ring_next[new] = place[rings.ring_next[touched]]
    n_shell = rings.n_shell + int(np.count_nonzero(touched < rings.n_shell))
    return Rings(rings.x[index], rings.y[index], ring_next, rings.origin[index], n_shell)


def lay_out(
    boundary: Boundary, places: Ints, shares: Floats, scale: Scale, main: Main = "longer"
) -> Layout:
    """Divide an area at two ends, given as in ``kernels.division``.

    The main curve is the part of the shell that runs ``with`` it from start to end, or the one
    ``against`` it, or the longer one, which sees more of the area.

    Raises
    ------
    InvalidAreaError
        If the ends are one point.
    """
    divided = divide_shell(
        boundary.mesh,
        boundary.order,
        boundary.side,
        NO_HEIGHT if boundary.height is None else boundary.height,
        places,
        shares,
        RULES[main],
        *scale,
    )
    if not divided.is_divided:
        x, y, _ = divided.middle[0]
        msg = f"start and end are the same point of the boundary, ({x:.12g}, {y:.12g})"
        raise InvalidAreaError(msg)
    return layout_of(divided, scale)


def layout_of(divided: Divided, scale: Scale) -> Layout:
    """Layout of a divided shell."""
    middle = np.ascontiguousarray(divided.middle[:, :2])
    return Layout(
        divided.mesh,
        divided.main,
        divided.auxiliary,
        EndPoints(middle, middle, divided.middle_at, divided.middle[:, 2]),
        scale,
        divided.height if divided.height.size else None,
        divided.mean_width,
    )
