"""Which shared edges are at an end of an area, and which of them its line should join.

          gap                     An *end* is the piece of the shell that the area's shape
    c---------+....p              proposes: a cap p q, or a point.
----'               |             An edge is *at* an end if it covers at least half of the cap,
                    | end         or is at least half on it; at a tip or round end, if it is
--------------------q             within half a width of it. The area must reach at least half
                                  as far from it as it is long, else it runs along the area.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from midrib.ends import End, proposed
from midrib.kernels.rings import Rings
from midrib.layout import Boundary, Scale, boundary_of
from midrib.types import Floats

__all__ = ["Outline", "Stretch"]

HALF = 0.5
# Widths from an end within which an edge may take it over if it is an end of the neighbour's.
NEAR, NEAR_IF_ACROSS = 1.0, 3.0
SAME_CORNER = 2.0**-4  # of the way across the area: so near, two edges meet at one corner
LEAST_TURN = np.pi / 2.0


@dataclass(frozen=True)
class Stretch:
    """A piece of a shell, in its direction: from ``place`` to ``other``."""

    place: int
    other: int
    start: float  # arc length
    length: float


class Outline:
    """The shell of an area by arc length, with the two ends its shape proposes."""

    def __init__(self, rings: Rings, scale: Scale) -> None:
        self.boundary: Boundary = boundary_of(rings)
        self.scale = scale
        mesh, order = self.boundary.mesh, self.boundary.order
        self.points = np.column_stack([mesh.x[order], mesh.y[order]])
        steps = np.roll(self.points, -1, axis=0) - self.points
        self.arc = np.append(0.0, np.cumsum(np.hypot(*(steps * scale).T)))
        self.places = {(float(x), float(y)): i for i, (x, y) in enumerate(self.points)}
        places, shares = proposed(self.boundary, scale, -1)
        self.ends = [
            End(int(place), int(other), float(share))
            for (place, other), share in zip(places, shares, strict=True)
        ]

    @property
    def perimeter(self) -> float:
        """Length of the shell."""
        return float(self.arc[-1])

    @cached_property
    def width(self) -> float:
        """Width of the rectangle with the shell's area and perimeter, or the square's side."""
        x, y = ((self.points - self.points[0]) * self.scale).T
        area = abs(float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())) * HALF
        quarter = self.perimeter / 4.0
        root = quarter * quarter - area
        return float(area / (quarter + np.sqrt(root)) if root > 0.0 else np.sqrt(area))

    def stretch(self, corners: Floats, length: float) -> Stretch | None:
        """Return the piece of the shell between two corners that is as long as told, if any."""
        a, b = (self.places.get((float(x), float(y))) for x, y in corners)
        if a is None or b is None or a == b:
            return None
        forth, back = self.between(a, b), self.between(b, a)
        if abs(forth - length) <= abs(back - length):
            return Stretch(a, b, float(self.arc[a]), forth)
        return Stretch(b, a, float(self.arc[b]), back)

    def between(self, a: int, b: int) -> float:
        """Length of the shell from place a on to place b."""
        return float((self.arc[b] - self.arc[a]) % self.perimeter)

    def is_at(self, edge: Stretch, end: End) -> bool:
        """Whether an edge is at an end."""
        cap = self.length(end)
        if cap:
            is_on = self.common(edge, end) >= HALF * min(cap, edge.length)
        else:
            is_on = self.gap(edge, end) <= HALF * self.width
        return is_on and not self.is_along(edge)

    def is_along(self, edge: Stretch) -> bool:
        """Whether the area reaches less than half as far from an edge as that is long."""
        return self.depth(edge) < HALF * edge.length

    def is_bank_up_to(self, edge: Stretch, other: Stretch) -> bool:
        """Whether an edge runs along the area up to a corner at which another, across it, begins.

        +---------------+
        |               | other      A line from the one to the other would turn off at once.
        +=====edge======+
        """
        if not self.is_along(edge) or self.is_along(other):
            return False
        between = self.gap(edge, End(other.place, other.other))
        return between <= SAME_CORNER * self.depth(edge)

    def depth(self, edge: Stretch) -> float:
        """How far the area reaches from the straight line between the two ends of an edge."""
        points = (self.points - self.points[edge.place]) * self.scale
        x, y = points[edge.other]
        return float(np.abs(points @ (-y, x)).max() / np.hypot(x, y))

    def is_near(self, edge: Stretch, end: End) -> bool:
        """Whether an edge is near an end: within a width, or three if it is across the area."""
        gap = self.gap(edge, end)
        if gap <= NEAR * max(self.length(end), self.width):
            return True
        return gap <= NEAR_IF_ACROSS * self.width and self.is_across(edge)

    def is_across(self, edge: Stretch) -> bool:
        """Whether the shell turns by 90 degrees or more at the two ends of an edge.

        By 180 at a cap, not at all at an edge in the middle of a bank. The banks' directions are
        taken over half the edge's length.
        """
        start, stop, arm = edge.start, edge.start + edge.length, edge.length * HALF
        at = [self.coordinates(self.at(s)) for s in (start - arm, start, stop, stop + arm)]
        x, y = (np.diff(at, axis=0) * self.scale).T
        cross, dot = x[:-1] * y[1:] - y[:-1] * x[1:], x[:-1] * x[1:] + y[:-1] * y[1:]
        return bool(np.arctan2(cross, dot).sum() >= LEAST_TURN)

    def common(self, edge: Stretch, end: End) -> float:
        """Length of the shell that an edge and an end have in common."""
        cap, start = self.length(end), self.position(end)
        ahead = (start - edge.start) % self.perimeter  # from the edge's start on to the end's
        behind = (edge.start - start) % self.perimeter
        return max(min(edge.length - ahead, cap), min(cap - behind, edge.length), 0.0)

    def gap(self, edge: Stretch, end: End) -> float:
        """Length of the shell between an edge and an end."""
        cap, start = self.length(end), self.position(end)
        ahead = (start - edge.start) % self.perimeter
        behind = (edge.start - start) % self.perimeter
        return max(min(ahead - edge.length, behind - cap), 0.0)

    def has(self, end: End, arc: float) -> bool:
        """Whether the shell at an arc length is in an end."""
        return (arc - self.position(end)) % self.perimeter <= self.length(end)

    def length(self, end: End) -> float:
        """Length of an end: of its cap, or 0."""
        return self.between(end.place, end.other) if end.other != end.place else 0.0

    def position(self, end: End) -> float:
        """Arc length at which an end begins."""
        following = self.arc[end.place + 1] - self.arc[end.place]
        return float(self.arc[end.place] + end.share * following)

    def middle(self, end: End) -> Floats:
        """Middle of an end."""
        point: Floats = self.coordinates(self.at(self.position(end) + self.length(end) * HALF))
        return point

    def at(self, arc: float) -> End:
        """Point of the shell at an arc length."""
        arc %= self.perimeter
        k = min(int(np.searchsorted(self.arc, arc, side="right")) - 1, len(self.points) - 1)
        return End(k, k, float((arc - self.arc[k]) / (self.arc[k + 1] - self.arc[k])))

    def coordinates(self, end: End) -> Floats:
        """Coordinates of the place of an end."""
        a, b = self.points[end.place], self.points[(end.place + 1) % len(self.points)]
        point: Floats = a + end.share * (b - a)
        return point

    def leaves_two_banks(self, first: End, second: End) -> bool:
        """Whether something of the shell is left on both sides between two ends."""
        n = len(self.points)
        banks = [(b.position - self.last(a)) % n for a, b in ((first, second), (second, first))]
        caps = (first.other - first.place) % n + (second.other - second.place) % n
        return min(banks) > 0.0 and abs(sum(banks) + caps - n) < HALF

    @staticmethod
    def last(end: End) -> float:
        """Place and share at which an end is over."""
        return end.position if end.other == end.place else float(end.other)
