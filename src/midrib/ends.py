"""Where an area begins and ends: proposed, or given by the caller."""

from dataclasses import dataclass

import numpy as np

from midrib.kernels import ends as kernel
from midrib.layout import Boundary, Layout, Main, Scale, lay_out
from midrib.types import Floats

__all__ = ["End", "end_at", "lay_out_ends", "propose_ends"]


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


def propose_ends(boundary: Boundary, scale: Scale, source: int = -1) -> tuple[End, End]:
    """Return an area's two ends; the mesh vertex ``source``, if it is given, is the first one."""
    places, shares = kernel.propose_ends(
        boundary.mesh, boundary.order, boundary.n_shell, source, not boundary.has_holes, *scale
    )
    first, second = (
        End(int(pair[0]), int(pair[1]), float(share))
        for pair, share in zip(places, shares, strict=True)
    )
    return first, second


def lay_out_ends(
    boundary: Boundary, start: End, stop: End, scale: Scale, main: Main = "longer"
) -> Layout:
    """Divide an area at two ends; see ``layout.lay_out``."""
    places = np.array([[start.place, start.other], [stop.place, stop.other]])
    return lay_out(boundary, places, np.array([start.share, stop.share]), scale, main)


def end_at(boundary: Boundary, point: Floats, scale: Scale) -> End:
    """Return the place of the shell nearest to a point (in the area's units)."""
    x, y = (c[boundary.order] * s for c, s in zip(boundary.mesh[:2], scale, strict=True))
    px, py = point[0] * scale[0], point[1] * scale[1]
    dx, dy = np.roll(x, -1) - x, np.roll(y, -1) - y
    share = ((px - x) * dx + (py - y) * dy) / (dx * dx + dy * dy)
    share = np.clip(share, 0.0, 1.0)
    squared = (x + share * dx - px) ** 2 + (y + share * dy - py) ** 2
    k = int(np.argmin(squared))
    if share[k] == 1.0:
        return End((k + 1) % x.size, (k + 1) % x.size)
    return End(k, k, float(share[k]))
