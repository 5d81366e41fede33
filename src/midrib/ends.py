"""Where an area begins and ends: proposed, or given by the caller."""

from dataclasses import dataclass

import numpy as np

from midrib.errors import InvalidAreaError
from midrib.kernels.ends import propose_ends
from midrib.kernels.layout import lay_out_rings
from midrib.kernels.rings import Rings
from midrib.kernels.touches import propose_division
from midrib.layout import (
    NO_HEIGHT,
    Boundary,
    Layout,
    Main,
    Scale,
    boundary_of,
    lay_out,
    layout_of,
)
from midrib.ragged import place_text
from midrib.types import Floats, Ints

__all__ = ["End", "end_at", "end_far_from", "lay_out_ends", "lay_out_proposed", "proposed"]

HALF = 0.5


@dataclass(frozen=True)
class End:
    """One end of an area, by places in the order of its shell.

    A cap runs from ``place`` to ``other``; any other end has both the same, or lies ``share`` of
    the way along the segment that leaves ``place``.
    """

    place: int
    other: int
    share: float = 0.0

    @property
    def position(self) -> float:
        """Place and share in one number."""
        return self.place + self.share

    def turned(self) -> "End":
        """Return the end with its cap the other way."""
        return End(self.other, self.place, self.share)


def lay_out_proposed(rings: Rings, height: Floats | None, scale: Scale) -> Layout:
    """Divide an area at the two ends that its shape proposes."""
    known = NO_HEIGHT if height is None else height[rings.origin]
    divided = lay_out_rings(rings, known, True, *scale)
    if divided.is_divided:
        return layout_of(divided, scale)
    boundary = boundary_of(rings, height)
    found = propose_division(
        boundary.mesh,
        boundary.order,
        boundary.side,
        NO_HEIGHT if boundary.height is None else boundary.height,
        not boundary.has_holes,
        *scale,
    )
    boundary = boundary._replace(
        mesh=found.mesh,
        order=found.order,
        side=found.side,
        height=None if boundary.height is None else found.height,
    )
    return lay_out(boundary, found.places, found.shares, scale)


def end_far_from(boundary: Boundary, given: End, scale: Scale) -> End:
    """Propose the end of an area that is farthest from a given one."""
    corner = given.place if given.share < HALF else (given.place + 1) % boundary.order.size
    places, shares = proposed(boundary, scale, int(boundary.order[corner]))
    return End(int(places[1, 0]), int(places[1, 1]), float(shares[1]))


def proposed(boundary: Boundary, scale: Scale, source: int) -> tuple[Ints, Floats]:
    """Return the places of two ends on the shell; the mesh vertex ``source``, if any, is one."""
    return propose_ends(boundary.mesh, boundary.order, source, not boundary.has_holes, *scale)


def lay_out_ends(
    boundary: Boundary, start: End, stop: End, scale: Scale, main: Main = "longer"
) -> Layout:
    """Divide an area at two ends; see ``layout.lay_out``.

    Raises
    ------
    InvalidAreaError
        If the ends are one point.
    """
    if start == stop:  # inside a segment they would be told apart by rounding
        mesh, order = boundary.mesh, boundary.order
        a, b = order[start.place], order[(start.place + 1) % order.size]
        point = np.array([c[a] + start.share * (c[b] - c[a]) for c in (mesh.x, mesh.y)])
        msg = f"start and end are the same point of the boundary, {place_text(point)}"
        raise InvalidAreaError(msg)
    places = np.array([[start.place, start.other], [stop.place, stop.other]])
    return lay_out(boundary, places, np.array([start.share, stop.share]), scale, main)


def end_at(boundary: Boundary, point: Floats, scale: Scale, near: float = 0.0) -> End:
    """Return the place of the shell nearest to a point (in the area's units).

    A vertex that is not farther than ``near`` from the point is that place.
    """
    x, y = (c[boundary.order] * s for c, s in zip(boundary.mesh[:2], scale, strict=True))
    px, py = point[0] * scale[0], point[1] * scale[1]
    from_vertices = (x - px) ** 2 + (y - py) ** 2
    k = int(np.argmin(from_vertices))
    if from_vertices[k] <= near * near:
        return End(k, k)
    dx, dy = np.roll(x, -1) - x, np.roll(y, -1) - y
    share = ((px - x) * dx + (py - y) * dy) / (dx * dx + dy * dy)
    share = np.clip(share, 0.0, 1.0)
    squared = (x + share * dx - px) ** 2 + (y + share * dy - py) ** 2
    k = int(np.argmin(squared))
    if share[k] == 1.0:
        return End((k + 1) % x.size, (k + 1) % x.size)
    return End(k, k, float(share[k]))
