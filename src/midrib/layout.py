"""A strip as the kernels see it: one mesh, and which of its boundary sides each curve runs on."""

from typing import Literal, NamedTuple

import numpy as np

from midrib.errors import InvalidAreaError, InvariantError
from midrib.kernels.mesh import Mesh, mesh_rings, split_side
from midrib.kernels.rings import Rings
from midrib.kernels.triangulation import next_side
from midrib.types import Floats, Ints

__all__ = [
    "Boundary",
    "Chain",
    "Layout",
    "Main",
    "Scale",
    "boundary_of",
    "lay_out",
    "place_point",
]

Scale = tuple[float, float]  # length of one unit of x and of y
Main = Literal["shorter", "with", "against"]
HALF = 0.5


class Chain(NamedTuple):
    """One curve: m + 1 mesh vertices, the m boundary sides between them, and arc lengths."""

    vertex: Ints
    side: Ints
    arc: Floats

    @property
    def length(self) -> float:
        """Length of the whole curve."""
        return float(self.arc[-1])


class Boundary(NamedTuple):
    """An area's mesh and its shell: vertices in order and the side that leaves each."""

    mesh: Mesh
    order: Ints
    side: Ints
    n_shell: int  # mesh vertices below it are the shell's
    has_holes: bool
    height: Floats | None  # of each mesh vertex


class Layout(NamedTuple):
    """Everything that the construction needs to know about a strip."""

    mesh: Mesh
    main: Chain
    auxiliary: Chain
    target: Ints  # for each half-edge the auxiliary segment on it, or -1
    middle: tuple[int, int]  # mesh vertices in the middle of the start and of the end
    scale: Scale
    height: Floats | None
    has_holes: bool

    @property
    def shares_start(self) -> bool:
        """Whether the two curves start in the same vertex."""
        return bool(self.main.vertex[0] == self.auxiliary.vertex[0])

    @property
    def mean_width(self) -> float:
        """Area within the shell over the mean length of the two curves."""
        around = np.concatenate([self.main.vertex, self.auxiliary.vertex[::-1]])
        x, y = self.mesh.x[around] * self.scale[0], self.mesh.y[around] * self.scale[1]
        x, y = x - x[0], y - y[0]
        doubled = abs(float(x[:-1] @ y[1:] - x[1:] @ y[:-1]))
        return doubled / (self.main.length + self.auxiliary.length)

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
        done = mesh_rings(rings.x, rings.y, rings.ring_next)
        if done.status > 0:
            k = done.status - 1
            msg = f"the boundary crosses or repeats itself near ({rings.x[k]:.12g}, {rings.y[k]:.12g})"
            raise InvalidAreaError(msg)
        if done.status < 0:
            msg = f"triangulation of {rings.x.size} vertices did not end"
            raise InvariantError(msg)
        if done.touches.max() < 0:
            n = rings.n_shell
            if height is not None:
                height = height[rings.origin]
            order, side = done.vertex_of[:n], done.side_of_segment[:n]
            return Boundary(done.mesh, order, side, n, rings.x.size > n, height)
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


def place_point(boundary: Boundary, k: int, share: float) -> tuple[Boundary, int]:
    """Make the point ``share`` of the way along shell segment k a vertex.

    Return the new boundary and the vertex's place in the order; a point that cannot be told from
    an end of the segment is that end.
    """
    mesh, order, n = boundary.mesh, boundary.order, boundary.order.size
    a, b = order[k], order[(k + 1) % n]
    x = mesh.x[a] + share * (mesh.x[b] - mesh.x[a])
    y = mesh.y[a] + share * (mesh.y[b] - mesh.y[a])
    old = boundary.side[k]
    mesh, side = split_side(mesh, old, x, y)
    if side < 0:
        return boundary, k if share <= HALF else (k + 1) % n
    # The triangle's next side has moved to the new triangle, where it follows the new side.
    sides = np.where(boundary.side == next_side(old), side + 1, boundary.side)
    height = boundary.height
    if height is not None:
        height = np.append(height, height[a] + share * (height[b] - height[a]))
    return boundary._replace(
        mesh=mesh,
        order=np.insert(order, k + 1, mesh.x.size - 1),
        side=np.insert(sides, k + 1, side),
        height=height,
    ), k + 1


def chain_of(boundary: Boundary, start: int, stop: int, scale: Scale) -> Chain:
    """The part of the shell from place ``start`` in its order on to place ``stop``."""
    n = boundary.order.size
    places = np.arange(start, start + (stop - start) % n + 1) % n
    return measured(boundary.mesh, boundary.order[places], boundary.side[places[:-1]], scale)


def measured(mesh: Mesh, vertex: Ints, side: Ints, scale: Scale) -> Chain:
    """Chain with its arc lengths."""
    dx, dy = np.diff(mesh.x[vertex]) * scale[0], np.diff(mesh.y[vertex]) * scale[1]
    arc = np.zeros(vertex.size)
    np.cumsum(np.hypot(dx, dy), out=arc[1:])
    return Chain(vertex, side, arc)


def lay_out(
    boundary: Boundary,
    start: tuple[int, int],
    stop: tuple[int, int],
    middle: tuple[int, int],
    scale: Scale,
    main: Main = "shorter",
) -> Layout:
    """Divide a shell at two ends.

    Each end is a pair of places in the order, before and after a cap in the shell's direction, or
    the same place twice; ``middle`` are the vertices in their middles. The main curve is the part
    that runs ``with`` the shell from start to stop, or the one ``against`` it, or the shorter one:
    the construction follows the roughness of the main curve, and a rough bank is a long one.
    """
    first = chain_of(boundary, start[1], stop[0], scale)
    second = chain_of(boundary, stop[1], start[0], scale)
    beside = measured(boundary.mesh, second.vertex[::-1].copy(), second.side[::-1].copy(), scale)
    is_first = first.length <= beside.length if main == "shorter" else main == "with"
    chains = (first, beside) if is_first else (beside, first)
    target = np.full(boundary.mesh.tri.size, -1, np.intp)
    target[chains[1].side] = np.arange(chains[1].side.size)
    return Layout(
        boundary.mesh, *chains, target, middle, scale, boundary.height, boundary.has_holes
    )
