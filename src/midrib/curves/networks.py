"""Lines of a network from the skeleton of its area: crossings repaired, dead ends led to the edge.

Every change is proven before it is kept: what it draws is covered by the area, and lines meet in
equal points at their ends only. Where that fails all stays as the skeleton has it.
"""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import MultiPolygon, Polygon

from midrib.curves.arms import Crossing, Net, arms_of, net_of, passed
from midrib.curves.dead_ends import SIGNIFICANT, STRAIGHT, Site, edge_beyond, middle_of_end, site_of
from midrib.curves.graphs import Graph
from midrib.curves.hubs import hub_of
from midrib.curves.junctions import crossings_of
from midrib.curves.narrowing import components
from midrib.layout import Scale
from midrib.types import Bools, Floats, Ints

__all__ = ["network_lines"]

NONE = np.empty(0, dtype=np.intp)
TIP = 1  # ways of a point that is one
SAMPLES = 65  # of half a dead end


class Ending(NamedTuple):
    """How a branch ends instead: at a hub, or at the edge of the area."""

    points: Floats  # (m, 2) from there inwards, in coordinate units
    kept: int  # points of the branch, seen from its far end, that stay


class Change(NamedTuple):
    """A crossing or a dead end: how branches end there, and which ones go."""

    endings: dict[tuple[int, int], Ending]  # by branch, and 0 or 1 for its first or last point
    inner: Ints


def network_lines(
    graph: Graph,
    area: Polygon | MultiPolygon,
    scale: Scale,
    overlap: float,
    fixed: Ints = NONE,
) -> list[Floats]:
    """Lines between the nodes of a network.

    Parameters
    ----------
    graph : Graph
        A skeleton of the area, without the branches that lead into corners.
    area : Polygon or MultiPolygon
        A valid one.
    scale : lengths of one unit of x and of y
    overlap : junctions are one crossing up to so many times the sum of their radii
    fixed : rows of points that are no dead ends, though one edge leads there

    Returns
    -------
    list of (n, 2) arrays
        Points of each line; lines that meet do so in equal points at their ends.
    """
    chief = chiefs_of(graph)
    graph, fixed = contracted(graph, chief), chief[fixed]
    site, net = site_of(area, scale), net_of(graph, scale)
    ends = net.ends()
    changes = [crossing_change(net, c, ends, site) for c in crossings_of(net, overlap)]
    is_dead = net.degree[ends] == TIP
    is_line = np.array(
        [bool(np.ptp(graph.points[rows], axis=0).any()) for rows in net.branches], bool
    )
    loops = ways_round(graph.points[ends[is_line]], is_dead[is_line])
    is_tip = is_dead & ~np.isin(ends, fixed)
    changes += [tip_change(net, int(b), int(end), site) for b, end in np.argwhere(is_tip)]
    changes = [change for change in changes if change.endings]
    while True:
        gone = {int(b) for change in changes for b in change.inner}
        there = [b for b in range(len(net.branches)) if b not in gone]
        endings = {at: ending for change in changes for at, ending in change.endings.items()}
        lines = [
            drawn(graph.points, net.branches[b], endings.get((b, 0)), endings.get((b, 1)), site)
            for b in there
        ]
        # Two points of a skeleton may be in one place: what joins them there is no line.
        own = [k for k, line in enumerate(lines) if is_line[there[k]] or len(line) > 1]
        there, lines = [there[k] for k in own], [lines[k] for k in own]
        bad = {there[k] for k in wrong(lines, site.area, is_dead[there], loops)}
        if not (found := blamed(changes, bad)):
            return lines
        changes = [change for k, change in enumerate(changes) if k not in found]


def chiefs_of(graph: Graph) -> Ints:
    """For each point (n,) the first one of those that edges without length join it with."""
    is_short = (graph.points[graph.edges[:, 0]] == graph.points[graph.edges[:, 1]]).all(axis=1)
    return components(len(graph.points), graph.edges[is_short])


def contracted(graph: Graph, chief: Ints) -> Graph:
    """Graph without edges of no length: they have no direction, and are no lines."""
    edges = chief[graph.edges]
    return graph._replace(edges=edges[edges[:, 0] != edges[:, 1]])


def blamed(changes: list[Change], bad: set[int]) -> set[int]:
    """Places of the changes that are taken back for bad branches.

    Crossings first: a dead end is to blame if nothing else has changed its branch.
    """
    touched = [bad & {branch for branch, _ in change.endings} for change in changes]
    is_tip = [len(change.endings) == 1 and change.inner.size == 0 for change in changes]
    crossings = {k for k, at in enumerate(touched) if at and not is_tip[k]}
    explained = set().union(*(touched[k] for k in crossings))
    return crossings | {k for k, at in enumerate(touched) if at - explained}


def crossing_change(net: Net, crossing: Crossing, ends: Ints, site: Site) -> Change:
    """Lead the arms of a crossing straight to its hub, from where they are narrow.

    An arm from which that is not inside leads there from where it leaves the discs, or else from
    its junction; if not even that is inside, nothing changes.
    """
    arms = arms_of(net, crossing, ends)
    hub = hub_of(net, crossing, arms)
    endings = {}
    for arm in arms:
        rows = net.branches[arm.branch][:: 1 - 2 * arm.end]
        junction = net.points[rows[0]]
        is_behind = (arm.cut - hub) @ arm.direction > 0.0
        best = passed(net, arm, hub) if is_behind else (arm.cut, arm.kept)
        for cut, kept in (best, arm.spare, (junction, len(rows) - 1)):
            points = np.stack([hub, cut][: 1 + (cut != hub).any()]) / site.scale
            if len(points) == 1 or site.covers(points):
                endings[arm.branch, arm.end] = Ending(points, kept)
                break
        else:
            return Change({}, crossing.inner)
    return Change(endings, crossing.inner)


def tip_change(net: Net, branch: int, end: int, site: Site) -> Change:
    """Lead a dead end straight on to the edge, from before it turns into a corner if it does so.

    What the disc of the tip reaches over from there is less than a corner's share.
    """
    stretch, nothing = net.stretch(branch, end), np.empty(0, np.intp)
    flat = middle_of_end(stretch, site)
    if flat is not None:
        middle, at = flat
        inside = min(float(stretch.arc[at]), stretch.length / 2.0)
        (start,), _ = stretch.at(np.array([inside]))
        points = np.stack([middle, start / site.scale])
        kept = int(np.count_nonzero(stretch.arc > inside))
        return Change({(branch, end): Ending(points, kept)}, nothing)
    arc = np.linspace(0.0, stretch.length / 2.0, SAMPLES)
    _, radius = stretch.at(arc)
    is_little = arc + radius[0] <= SIGNIFICANT * radius
    if not is_little.any():
        return Change({}, nothing)
    turn = int(np.flatnonzero(is_little)[-1])
    for inside in (float(arc[turn]), 0.0):
        (start,), _ = stretch.at(np.array([inside]))
        edge = edge_beyond(stretch, inside, float(radius[turn]), site)
        if edge is not None:
            points = np.stack([edge, start / site.scale])
            kept = int(np.count_nonzero(stretch.arc > inside))
            return Change({(branch, end): Ending(points, kept)}, nothing)
    return Change({}, nothing)


def drawn(
    points: Floats, rows: Ints, first: Ending | None, last: Ending | None, site: Site
) -> Floats:
    """Points of a branch between its new ends; a vertex on the straight way to one is left out."""
    low = 0 if first is None else len(rows) - first.kept
    high = len(rows) if last is None else last.kept
    line = [points[rows[low:high]]]
    if first is not None:
        line.insert(0, first.points)
    if last is not None:
        line.append(last.points[::-1])
    chain = np.concatenate(line)
    distinct = np.append(True, (chain[1:] != chain[:-1]).any(axis=1))
    chain = chain[distinct]
    for at in (1, -2):
        if len(chain) > 2 and is_straight(chain, at, site):
            chain = np.delete(chain, at, axis=0)
    return chain


def is_straight(chain: Floats, at: int, site: Site) -> bool:
    """Whether a vertex next to an end is on the straight way from there, but for rounding."""
    a, b, c = chain[[at - 1, at, at + 1]] * site.scale
    ahead, off = c - a, b - a
    length = np.hypot(*ahead)
    if length == 0.0:  # there and back: no straight way has a vertex
        return False
    is_between = 0.0 <= ahead @ off <= length**2
    return bool(
        is_between and abs(ahead[0] * off[1] - ahead[1] * off[0]) <= STRAIGHT * site.extent * length
    )


def wrong(lines: list[Floats], area: Polygon | MultiPolygon, is_dead: Bools, loops: int) -> Ints:
    """Lines that are points, not inside, cross themselves, or meet others but at common ends.

    All are if they do not go round as often as the skeleton does. Dead ends (n, 2) are no way
    round, though two of them may meet where rings touch.
    """
    shapes = np.array(
        [shapely.linestrings(np.resize(line, (max(len(line), 2), 2))) for line in lines]
    )
    is_point = np.array([bool((line == line[0]).all()) for line in lines])
    bad = is_point | ~shapely.covers(area, shapes) | ~shapely.is_simple(shapes)
    one, other = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    one, other = one[one < other], other[one < other]
    met, pair = shapely.get_coordinates(
        shapely.intersection(shapes[one], shapes[other]), return_index=True
    )
    tips = np.array([line[[0, -1]] for line in lines])
    is_end = [(tips[k[pair]] == met[:, None]).all(axis=2).any(axis=1) for k in (one, other)]
    astray = pair[~(is_end[0] & is_end[1])]
    bad[one[astray]] = bad[other[astray]] = True
    if not bad.any():
        bad[:] = ways_round(tips, is_dead) != loops
    return np.flatnonzero(bad)


def ways_round(tips: Floats, is_dead: Bools) -> int:
    """How many independent ways round lines have, from the two ends (n, 2, 2) of each."""
    _, node = np.unique(tips.reshape(-1, 2), axis=0, return_inverse=True)
    node = node.reshape(-1, 2)
    node[is_dead] = node.size + np.arange(np.count_nonzero(is_dead))
    nodes, edges = np.unique(node, return_inverse=True)
    pieces = np.unique(components(nodes.size, edges.reshape(-1, 2))).size
    return len(tips) - nodes.size + pieces
