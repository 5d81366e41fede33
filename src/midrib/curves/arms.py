"""Arms of crossings: the branches that leave them, each cut back to where it is narrow.

Near a junction a skeleton leaves the middles of the roads: it dips towards the road that joins, by
so much farther out as the two part at a sharper angle.
"""

from typing import NamedTuple

import numpy as np

from midrib.curves.graphs import Branches, Graph
from midrib.kernels.graph import branches_of
from midrib.layout import Scale
from midrib.types import Bools, Floats, Ints

__all__ = ["Arm", "Crossing", "Net", "Stretch", "arms_of", "net_of", "passed"]

LOOK = 2.5  # radii within which an arm is looked at for where it is narrow
FARTHEST = 12.0  # radii of the crossing within which an arm comes to be steady, if ever
SAMPLES = 129
STEADY = 0.95  # an arm is steady that does not lose more of its radius within LOOK
NARROW = 1.001  # times the least radius of an arm: 0.01 off already turns it by some 5 degrees
ALONG = 2.0  # radii of an arm over which its direction is taken
WEAK = 0.02  # of its radius is what an arm says that is in the discs all along


class Stretch(NamedTuple):
    """A branch seen from one of its ends, in lengths."""

    arc: Floats  # (n,) from that end
    points: Floats  # (n, 2)
    radius: Floats  # (n,)

    @property
    def length(self) -> float:
        """Length of the branch."""
        return float(self.arc[-1])

    def at(self, arc: Floats) -> tuple[Floats, Floats]:
        """Points and radii at arc lengths; radii are taken to grow evenly between vertices."""
        x, y, radius = (np.interp(arc, self.arc, c) for c in (*self.points.T, self.radius))
        return np.column_stack([x, y]), radius


class Net(NamedTuple):
    """A graph in lengths, and its branches."""

    points: Floats  # (n, 2)
    radius: Floats  # (n,)
    degree: Ints  # (n,)
    branches: list[Ints]  # rows of the points of each

    def ends(self) -> Ints:
        """First and last point (k, 2) of each branch."""
        rows = [(branch[0], branch[-1]) for branch in self.branches]
        return np.array(rows, dtype=np.intp).reshape(-1, 2)

    def stretch(self, branch: int, end: int) -> Stretch:
        """Return a branch seen from its first (0) or last (1) point."""
        rows = self.branches[branch][:: 1 - 2 * end]
        points = self.points[rows]
        arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        return Stretch(arc, points, self.radius[rows])


class Crossing(NamedTuple):
    """Junctions that are one."""

    members: Ints  # rows of points
    inner: Ints  # branches that join them

    def with_other(self, other: "Crossing", branch: int) -> "Crossing":
        """Return what both and the branch between them are together."""
        inner = np.concatenate([self.inner, other.inner, [branch]])
        return Crossing(np.concatenate([self.members, other.members]), inner)


class Arm(NamedTuple):
    """A branch that leaves a crossing; where it comes from is told from where it is narrow."""

    branch: int
    end: int  # 0 if it is its first point that is there, 1 if its last
    at: float  # arc length of the cut
    cut: Floats  # (2,) where it is narrow, from there on it is kept
    kept: int  # points of the branch, seen from its far end, that are kept
    direction: Floats  # (2,) of unit length, inwards
    bend: Floats  # (2,) how it changes with a unit of length
    radius: float
    weight: float  # how much it says of where the crossing is
    spare: tuple[Floats, int]  # cut and kept of the next best choice
    reach: tuple[Floats, Floats]  # discs (n, 2) (n,) before the cut and one radius on


def net_of(graph: Graph, scale: Scale) -> Net:
    """Branches of a graph, in lengths."""
    branches = Branches(*branches_of(len(graph.points), graph.edges))
    rows = np.split(branches.rows, branches.offsets[1:-1]) if branches.rows.size else []
    degree = np.bincount(graph.edges.ravel(), minlength=len(graph.points))
    return Net(graph.points * scale, graph.radius, degree, rows)


def arms_of(net: Net, crossing: Crossing, ends: Ints) -> list[Arm]:
    """Arms of a crossing, each cut back to where it is narrow."""
    is_end = np.isin(ends, crossing.members)
    is_end[crossing.inner] = False
    return [arm_of(net, crossing, int(b), int(end)) for b, end in np.argwhere(is_end)]


def arm_of(net: Net, crossing: Crossing, branch: int, end: int) -> Arm:
    """One arm."""
    stretch = net.stretch(branch, end)
    at, outside, reach = narrow_from(net, crossing, stretch)
    _, (radius,) = stretch.at(np.array([at]))
    far = min(at + ALONG * radius, stretch.length)
    if far == at:  # the whole branch is in the discs
        at, far, weight = 0.0, at, WEAK * radius
    else:
        weight = (far - at) / ALONG
    (cut, middle, last), _ = stretch.at(np.array([at, (at + far) / 2.0, far]))
    # Of the parabola through three points: inwards the sign of its first derivative turns.
    half = (far - at) / 2.0
    direction = (3.0 * cut - 4.0 * middle + last) / (2.0 * half)
    bend = (cut - 2.0 * middle + last) / half**2
    length = max(np.hypot(*direction), np.finfo(float).tiny)
    (spare,), _ = stretch.at(np.array([outside]))
    kept, rest = (int(np.count_nonzero(stretch.arc > place)) for place in (at, outside))
    return Arm(
        branch, end, at, cut, kept, direction / length, bend, float(radius), float(weight),
        (spare, rest), reach,
    )  # fmt: skip


def passed(net: Net, arm: Arm, hub: Floats) -> tuple[Floats, int]:
    """Cut and kept of an arm whose hub is behind its cut: half a radius past the hub."""
    stretch = net.stretch(arm.branch, arm.end)
    behind = float((arm.cut - hub) @ arm.direction)
    at = max(arm.at, min(arm.at + behind + arm.radius / 2.0, stretch.length / 2.0))
    (cut,), _ = stretch.at(np.array([at]))
    return cut, int(np.count_nonzero(stretch.arc > at))


def narrow_from(
    net: Net, crossing: Crossing, stretch: Stretch
) -> tuple[float, float, tuple[Floats, Floats]]:
    """Where an arm is narrow, where it has left the crossing's discs, and where hubs may be.

    It is narrow where it is as wide as it gets within ``LOOK`` radii from where it is steady; roads
    that part at a sharp angle become so far from their junction. One that narrows all along, like
    a river, is looked at within that of the crossing only.

    Half of it at most: the other half is for what is at the other end. A vertex within half a
    radius is as good as the place itself.
    """
    radii = net.radius[crossing.members]
    look = LOOK * float(radii.max())
    arc = np.linspace(0.0, min(stretch.length / 2.0, FARTHEST * float(radii.max())), SAMPLES)
    arc = np.union1d(arc, stretch.arc[stretch.arc < arc[-1]])
    end = int(np.searchsorted(arc, look, side="right"))  # of what is near the crossing
    points, radius = stretch.at(arc)
    away = points[:, None] - net.points[crossing.members][None]
    is_out: Bools = np.all(np.hypot(away[..., 0], away[..., 1]) >= radii, axis=1)
    if not is_out.any():
        last = float(arc[end - 1])
        return last, last, (points, radius)
    first = int(np.argmax(is_out))
    ahead = least_ahead(arc, radius)
    is_steady = is_out & (ahead >= STEADY * radius) & (arc + LOOK * radius <= arc[-1])
    if is_steady.any():
        least = ahead[np.argmax(is_steady)]
    else:
        least = radius[first : max(end, first + 1)].min()
    at = first + int(np.argmax(radius[first:] <= NARROW * least))
    vertices = stretch.arc[(stretch.arc >= arc[at]) & (stretch.arc <= arc[at] + radius[at] / 2.0)]
    vertices = vertices[vertices <= arc[-1]]
    narrow = float(vertices[0] if vertices.size else arc[at])
    is_near = arc <= narrow + radius[at]
    return narrow, float(arc[first]), (points[is_near], radius[is_near])


def least_ahead(arc: Floats, radius: Floats) -> Floats:
    """Least radius from each place on over ``LOOK`` of its radii."""
    first = np.arange(arc.size)
    last = np.searchsorted(arc, arc + LOOK * radius, side="right")
    pairs = np.column_stack([first, np.minimum(last, arc.size - 1)]).ravel()
    least: Floats = np.minimum(np.minimum.reduceat(radius, pairs)[::2], radius)
    return least
