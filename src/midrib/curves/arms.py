"""Arms of crossings: the branches that leave them, each cut back to where it is narrow.

Near a junction a skeleton leaves the middles of the roads: it dips towards the road that joins, by
so much farther out as the two part at a sharper angle.
"""

from typing import NamedTuple

import numpy as np

from midrib.curves.graphs import Branches, Graph
from midrib.kernels.arms import arm_from
from midrib.kernels.graph import branches_of
from midrib.layout import Scale
from midrib.types import Floats, Ints

__all__ = ["Arm", "Crossing", "Net", "Stretch", "arms_of", "net_of", "passed"]


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
    """One arm.

    It is narrow where it is as wide as it gets within 2.5 radii from where it is steady; roads that
    part at a sharp angle become so far from their junction. One that narrows all along, like a
    river, is looked at within that of the crossing only.

    Half of it at most: the other half is for what is at the other end. A vertex within half a
    radius is as good as the place itself.
    """
    said, kept, disc = arm_from(net.points, net.radius, net.branches[branch], end, crossing.members)
    at, radius, weight = float(said[0]), float(said[8]), float(said[9])
    bend = said[5:7] / said[7] ** 2
    return Arm(
        branch, end, at, said[1:3], int(kept[0]), said[3:5], bend, radius, weight,
        (said[10:12], int(kept[1])), (disc[:, :2], disc[:, 2]),
    )  # fmt: skip


def passed(net: Net, arm: Arm, hub: Floats) -> tuple[Floats, int]:
    """Cut and kept of an arm whose hub is behind its cut: half a radius past the hub."""
    stretch = net.stretch(arm.branch, arm.end)
    behind = float((arm.cut - hub) @ arm.direction)
    at = max(arm.at, min(arm.at + behind + arm.radius / 2.0, stretch.length / 2.0))
    (cut,), _ = stretch.at(np.array([at]))
    return cut, int(np.count_nonzero(stretch.arc > at))
