r"""Junctions of a network: which ones of a skeleton are one crossing, and where its arms meet.

The skeleton of a crossing of two roads has two junctions unless the roads are alike, and near
every junction it leaves the middles of the roads: it dips towards the road that joins.

    ---------------------        A *crossing* is a junction, or several whose discs overlap. Its
     . . . .     . . . .         arms count from where they have left these discs and are as narrow
             . .                 as they are beyond: from there they go straight on to the *hub*,
    -------.  .  .-------        the point that is nearest to all of these straight lines.
           |  .  |
           |  .  |

Source: Haunert and Sester, Area collapse and road centerlines based on straight skeletons,
GeoInformatica 12, 2008: junctions near each other are one, and roads keep their directions.
"""

from typing import NamedTuple

import numpy as np

from midrib.curves.graphs import Branches, Graph
from midrib.kernels.graph import branches_of
from midrib.layout import Scale
from midrib.types import Bools, Floats, Ints

__all__ = ["Arm", "Crossing", "Net", "Stretch", "arms_of", "crossings_of", "hub_of", "net_of"]

JUNCTION = 3  # ways of a point that is one
LOOK = 2.5  # radii of the crossing that an arm is looked at for where it is narrow
SAMPLES = 97
NARROW = 1.01  # times the least radius of an arm
ALONG = 2.0  # radii of an arm over which its direction is taken
WEAK = 0.02  # of the larger eigenvalue: arms within 8 degrees do not say how far their lines meet
FARTHER = 2.0  # times as far, junctions are one if their arms meet within a part of their radius
MEETING = 0.25
MOST_TURN = np.radians(45.0)  # of an arm that is led on
LED_ON = 4  # times, each to the hub of the last one
HOLDS = (0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)  # what the middle weighs, of the weight of arms
NONE = np.empty(0, dtype=np.intp)


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
    cut: Floats  # (2,) where it is narrow, from there on it is kept
    kept: int  # points of the branch, seen from its far end, that are kept
    direction: Floats  # (2,) of unit length, inwards
    bend: Floats  # (2,) how it changes with a unit of length
    radius: float
    weight: float  # how much it says of where the crossing is
    spare: tuple[Floats, int]  # cut and kept of the next best choice

    def led_on(self, length: float) -> tuple[Floats, Floats]:
        """Point and direction so far inwards, bent as the arm is; by half a right angle at most."""
        turn = np.hypot(*self.bend) * length
        bend = self.bend * min(1.0, MOST_TURN / turn) if turn > 0.0 else self.bend
        direction = self.direction + bend * length
        point: Floats = self.cut + (self.direction + bend * length / 2.0) * length
        return point, direction / np.hypot(*direction)


def net_of(graph: Graph, scale: Scale) -> Net:
    """Branches of a graph, in lengths."""
    branches = Branches(*branches_of(len(graph.points), graph.edges))
    rows = np.split(branches.rows, branches.offsets[1:-1]) if branches.rows.size else []
    degree = np.bincount(graph.edges.ravel(), minlength=len(graph.points))
    return Net(graph.points * scale, graph.radius, degree, rows)


def crossings_of(net: Net, overlap: float) -> list[Crossing]:
    """Junctions that are one crossing, because their discs overlap or their arms meet in a point.

    The nearest ones are joined first; a branch back to a junction of the same crossing stays.

    Parameters
    ----------
    net : Net
    overlap : any two junctions of a crossing are at most so many times the sum of their radii
        apart; twice as much where all arms lead to one point
    """
    ends = net.ends()
    found = {int(v): Crossing(np.array([v]), NONE) for v in np.flatnonzero(net.degree >= JUNCTION)}
    is_between = (net.degree[ends] >= JUNCTION).all(axis=1) & (ends[:, 0] != ends[:, 1])
    between = np.flatnonzero(is_between)
    share = np.array([net.stretch(int(b), 0).length / net.radius[ends[b]].sum() for b in between])
    for k in np.argsort(share, kind="stable"):
        if share[k] > FARTHER * overlap:
            break
        one, other = (found[int(v)] for v in ends[between[k]])
        if one is other:
            continue
        both = one.with_other(other, int(between[k]))
        apart = farthest_apart(net, one, other)
        if apart <= overlap or (apart <= FARTHER * overlap and meets_in_point(net, both, ends)):
            found |= dict.fromkeys(both.members.tolist(), both)
    return list({id(crossing): crossing for crossing in found.values()}.values())


def farthest_apart(net: Net, one: Crossing, other: Crossing) -> float:
    """Greatest distance between junctions of two crossings, in sums of their radii."""
    away = net.points[one.members][:, None] - net.points[other.members][None]
    reach = net.radius[one.members][:, None] + net.radius[other.members][None]
    return float((np.hypot(away[..., 0], away[..., 1]) / reach).max())


def meets_in_point(net: Net, crossing: Crossing, ends: Ints) -> bool:
    """Whether the arms of a crossing lead to one point, but for a part of their width."""
    arms = arms_of(net, crossing, ends)
    hub = hub_of(net, crossing, arms)
    for arm in arms:
        point, direction = arm.led_on(float(np.hypot(*(hub - arm.cut))))
        off = hub - point
        if abs(direction[0] * off[1] - direction[1] * off[0]) > MEETING * arm.radius:
            return False
    return True


def arms_of(net: Net, crossing: Crossing, ends: Ints) -> list[Arm]:
    """Arms of a crossing, each cut back to where it is narrow."""
    is_end = np.isin(ends, crossing.members)
    is_end[crossing.inner] = False
    return [arm_of(net, crossing, int(b), int(end)) for b, end in np.argwhere(is_end)]


def arm_of(net: Net, crossing: Crossing, branch: int, end: int) -> Arm:
    """One arm."""
    stretch = net.stretch(branch, end)
    at, outside = narrow_from(net, crossing, stretch)
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
    unit, spare_cut = direction / length, (spare, rest)
    return Arm(branch, end, cut, kept, unit, bend, float(radius), float(weight), spare_cut)


def narrow_from(net: Net, crossing: Crossing, stretch: Stretch) -> tuple[float, float]:
    """Arc length at which an arm is narrow, and that at which it has left the crossing's discs.

    Half of it at most: the other half is for what is at the other end. A vertex within half a
    radius is as good as the place itself.
    """
    radii = net.radius[crossing.members]
    arc = np.linspace(0.0, min(stretch.length / 2.0, LOOK * float(radii.max())), SAMPLES)
    arc = np.union1d(arc, stretch.arc[stretch.arc < arc[-1]])
    points, radius = stretch.at(arc)
    away = points[:, None] - net.points[crossing.members][None]
    is_out: Bools = np.all(np.hypot(away[..., 0], away[..., 1]) >= radii, axis=1)
    if not is_out.any():
        return float(arc[-1]), float(arc[-1])
    first = int(np.argmax(is_out))
    at = int(np.argmax(is_out & (radius <= NARROW * radius[first:].min())))
    vertices = stretch.arc[(stretch.arc >= arc[at]) & (stretch.arc <= arc[at] + radius[at] / 2.0)]
    vertices = vertices[vertices <= arc[-1]]
    return float(vertices[0] if vertices.size else arc[at]), float(arc[first])


def hub_of(net: Net, crossing: Crossing, arms: list[Arm]) -> Floats:
    """Point that is nearest to where all arms lead, weighted by how wide they are.

    It is in a disc of the crossing or of a branch inside it: where these lead farther away it stays
    as near to the middle as that takes, and gives way along a road sooner than across it.
    """
    rows = np.concatenate([crossing.members, *(net.branches[b] for b in crossing.inner)])
    places, radius = net.points[rows], net.radius[rows]
    n = crossing.members.size
    middle = np.average(places[:n], axis=0, weights=radius[:n])
    for hold in HOLDS:
        hub = middle
        for _ in range(LED_ON):
            lines = [arm.led_on(float(np.hypot(*(hub - arm.cut)))) for arm in arms]
            hub = nearest_to(middle, lines, np.array([arm.weight for arm in arms]), hold)
        if (np.hypot(*(hub - places).T) <= radius).any():
            return hub
    largest: Floats = places[np.argmax(radius[:n])]
    return largest


def nearest_to(
    middle: Floats, lines: list[tuple[Floats, Floats]], weight: Floats, hold: float
) -> Floats:
    """Point with the least weighted squares of distances to lines, a point and a direction each.

    Where these hardly differ in direction they do not say how far along it is: there it stays in
    the middle, which holds it by so much of the weight across.
    """
    off = np.array([point for point, _ in lines]) - middle
    direction = np.array([along for _, along in lines])
    across = np.column_stack([-direction[:, 1], direction[:, 0]])
    normal = np.einsum("k,ki,kj->ij", weight, across, across)
    pull = np.einsum("k,ki,k->i", weight, across, (across * off).sum(axis=1))
    value, axis = np.linalg.eigh(normal)
    is_known = value > WEAK * value[-1]
    step = (axis.T @ pull)[is_known] / (value[is_known] + hold * value[-1])
    nearest: Floats = middle + axis[:, is_known] @ step
    return nearest
