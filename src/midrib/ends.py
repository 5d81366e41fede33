"""Where an area begins and ends, and so which part of its boundary is the main curve."""

from dataclasses import dataclass

import numpy as np

from midrib.errors import InvalidAreaError
from midrib.kernels.ends import CAP, POINT, far_pair, shape_of_end
from midrib.layout import Boundary, Layout, Main, Scale, lay_out, place_point
from midrib.types import Floats

__all__ = ["End", "end_at", "lay_out_ends", "mean_width", "propose_ends", "shell_of"]


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
    def is_point(self) -> bool:
        """Whether the two curves meet here."""
        return self.place == self.other

    def moved(self, new: int) -> "End":
        """Return the end after a vertex has been inserted at place ``new``."""
        return End(self.place + (self.place >= new), self.other + (self.other >= new), self.share)


def shell_of(boundary: Boundary, scale: Scale) -> tuple[Floats, Floats]:
    """Shell vertices of an area in lengths."""
    mesh, order = boundary.mesh, boundary.order
    return mesh.x[order] * scale[0], mesh.y[order] * scale[1]


def mean_width(x: Floats, y: Floats) -> float:
    """Width of the rectangle with the shell's area and perimeter, or of the square with its area."""
    next_x, next_y = np.roll(x, -1), np.roll(y, -1)
    half = float(np.hypot(next_x - x, next_y - y).sum()) / 2.0
    area = abs(float(((x - x[0]) * (next_y - y[0]) - (next_x - x[0]) * (y - y[0])).sum())) / 2.0
    root = (half / 2.0) ** 2 - area
    return area / (half / 2.0 + float(np.sqrt(root))) if root > 0.0 else float(np.sqrt(area))


def propose_ends(boundary: Boundary, scale: Scale, source: int = -1) -> tuple[End, End]:
    """The two ends of an area, the far vertex ``source`` kept as the first one if it is given."""
    x, y = shell_of(boundary, scale)
    width = mean_width(x, y)
    pair = far_pair(boundary.mesh, boundary.n_shell, source, *scale, not boundary.has_holes)
    if source < 0:
        pair = sorted(pair, key=lambda v: (boundary.mesh.x[v], boundary.mesh.y[v]))
    ends = [End(int(v), int(v)) for v in pair]
    shapes = [end_of_shape(shape_of_end(x, y, v, width)) for v in pair]
    if source >= 0:
        shapes[0] = ends[0]
    for a, b in ((shapes[0], shapes[1]), (shapes[0], ends[1]), (ends[0], shapes[1])):
        if leaves_two_banks(a, b, x.size):
            return a, b
    return ends[0], ends[1]


def end_of_shape(shape: tuple[int, int, int, float]) -> End:
    """Name what the kernel found."""
    kind, i, j, share = shape
    if kind == CAP:
        return End(i, j)
    return End(i, i, share if kind == POINT else 0.0)


def leaves_two_banks(a: End, b: End, n: int) -> bool:
    """Whether something of the shell is left on both sides between two ends."""
    if a.place == a.other and b.place == b.other:
        return a.place != b.place or a.share != b.share
    first = (b.place + b.share - a.other - a.share) % n
    second = (a.place + a.share - b.other - b.share) % n
    cap_a, cap_b = (a.other - a.place) % n, (b.other - b.place) % n
    return first > 0.0 and second > 0.0 and abs(first + second + cap_a + cap_b - n) < 0.5


def end_at(boundary: Boundary, point: Floats, scale: Scale) -> End:
    """The place of the shell nearest to a point (in the area's units)."""
    x, y = shell_of(boundary, scale)
    px, py = point[0] * scale[0], point[1] * scale[1]
    dx, dy = np.roll(x, -1) - x, np.roll(y, -1) - y
    share = ((px - x) * dx + (py - y) * dy) / (dx * dx + dy * dy)
    share = np.clip(share, 0.0, 1.0)
    squared = (x + share * dx - px) ** 2 + (y + share * dy - py) ** 2
    k = int(np.argmin(squared))
    if share[k] == 1.0:
        return End((k + 1) % x.size, (k + 1) % x.size)
    return End(k, k, float(share[k]))


def lay_out_ends(
    boundary: Boundary, start: End, stop: End, scale: Scale, main: Main = "shorter"
) -> Layout:
    """Divide an area at two ends; see ``lay_out`` for ``main``.

    Points inside segments, the middles of caps too, become vertices first.

    Raises
    ------
    InvalidAreaError
        If the ends are one point.
    """
    ends, middles = [start, stop], [-1, -1]
    spots = [spot_of(boundary, end, scale) for end in ends]
    for i in sorted((0, 1), key=lambda i: spots[i], reverse=True):
        k, share = spots[i]
        place = k
        if share > 0.0:
            size = boundary.order.size
            boundary, place = place_point(boundary, k, share)
            if boundary.order.size > size:
                ends = [end.moved(place) for end in ends]
        if ends[i].is_point:
            ends[i] = End(place, place)
        middles[i] = int(boundary.order[place])
    if ends[0] == ends[1]:
        v = middles[0]
        msg = (
            "start and end are the same point of the boundary, "
            f"({boundary.mesh.x[v]:.12g}, {boundary.mesh.y[v]:.12g})"
        )
        raise InvalidAreaError(msg)
    first = (ends[0].place, ends[0].other)
    second = (ends[1].place, ends[1].other)
    return lay_out(boundary, first, second, (middles[0], middles[1]), scale, main)


def spot_of(boundary: Boundary, end: End, scale: Scale) -> tuple[int, float]:
    """Segment and share at which an end lies: of a cap, its middle."""
    if end.is_point:
        return end.place, end.share
    n = boundary.order.size
    places = np.arange(end.place, end.place + (end.other - end.place) % n + 1) % n
    x, y = shell_of(boundary, scale)
    arc = np.cumsum(np.hypot(np.diff(x[places]), np.diff(y[places])))
    i = int(np.searchsorted(arc, arc[-1] / 2.0))
    before = arc[i - 1] if i else 0.0
    share = float((arc[-1] / 2.0 - before) / (arc[i] - before))
    return (int(places[i]), share) if share < 1.0 else (int(places[i + 1]), 0.0)
