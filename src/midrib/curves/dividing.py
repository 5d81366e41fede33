"""An area divided at a width: pieces that are wide, and the lines of those that are narrow."""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import LineString, MultiPolygon, Polygon

from midrib.curves.cuts import Cut, Edge, cut_across, pieces_of
from midrib.curves.graphs import Graph
from midrib.curves.narrowing import Parts, components
from midrib.curves.networks import network_lines
from midrib.kernels.graph import branches_of
from midrib.layout import Scale
from midrib.types import Floats, Ints

__all__ = ["Divided", "divide_area"]


class Divided(NamedTuple):
    """What is wide, lines of what is narrow, and where a narrow part could not be cut off."""

    wide: list[Polygon]
    lines: list[Floats]
    uncut: Floats  # (k, 2) a point of each such part


class Way(NamedTuple):
    """A branch of the narrow part of a skeleton, and the cuts at its ends, if it has any there."""

    rows: Ints
    cuts: tuple[Cut | None, Cut | None]

    @property
    def span(self) -> tuple[int, int]:
        """Of the rows those between the cuts."""
        first, last = self.cuts
        low = 0 if first is None else len(self.rows) - first.kept
        return low, len(self.rows) if last is None else last.kept

    @property
    def inner(self) -> Ints:
        """Rows between the cuts."""
        low, high = self.span
        return self.rows[low:high]

    @property
    def is_gone(self) -> bool:
        """Whether nothing is between the cuts: they are one, or each is beyond the other."""
        low, high = self.span
        there = [cut for cut in self.cuts if cut is not None]
        places = {frozenset(tuple(contact.point) for contact in cut.contacts) for cut in there}
        return low > high or len(there) > len(places)


def divide_area(parts: Parts, edge: Edge, radius: float, least: float, merge: float) -> Divided:
    """Cut an area where its skeleton changes between narrow and wide.

    Where that is not possible, or where cuts leave less than the least length of it, the narrow
    part stays with what is beside it.

    Parameters
    ----------
    parts : Parts
        With narrow and wide edges both.
    edge : boundary of the area
    radius : half the width asked for
    least : length from which on a narrow part counts
    merge : see ``network_lines``
    """
    uncut = np.empty((0, 2))
    while parts.is_narrow.any():
        narrow, ends = narrow_graph(parts)
        label = components(len(narrow.points), narrow.edges)
        ways, failed = cut_ways(narrow, ends, edge, radius)
        short = short_parts(narrow, label, ways, edge, least)
        failed = np.setdiff1d(label[failed], short)
        if failed.size == short.size == 0:
            chains = [chain_of(narrow, way) for way in ways]
            wide, rest, mixed = sorted_pieces(parts, chains, pieces_of(edge, cuts_of(ways)))
            if mixed.size == 0:
                graph, fixed = graph_between(narrow, ways)
                lines = network_lines(graph, MultiPolygon(rest), scale_of(edge), merge, fixed)
                return Divided(wide, lines, uncut)
            failed = np.unique([label[ways[k].rows[0]] for k in mixed])
        uncut = np.concatenate([uncut, narrow.points[failed]])
        parts = without(parts, label[narrow.edges[:, 0]], np.append(failed, short))
    return Divided([edge.area], [], uncut)


def scale_of(edge: Edge) -> Scale:
    """Lengths of one unit of x and of y."""
    return float(edge.scale[0]), float(edge.scale[1])


def narrow_graph(parts: Parts) -> tuple[Graph, Ints]:
    """Graph of the narrow edges, and its points at which it changes: each a tip of its own."""
    graph = parts.graph
    n = len(graph.points)
    is_change = np.zeros(n, dtype=np.bool_)
    is_change[graph.edges[~parts.is_narrow]] = True
    edges = graph.edges[parts.is_narrow].copy()
    here = is_change[edges]
    fixed = n + np.arange(np.count_nonzero(here))
    origin = edges[here]
    edges[here] = fixed
    points = np.concatenate([graph.points, graph.points[origin]])
    return Graph(points, edges, np.concatenate([graph.radius, graph.radius[origin]])), fixed


def cut_ways(narrow: Graph, ends: Ints, edge: Edge, radius: float) -> tuple[list[Way], Ints]:
    """Cut the branches of the narrow part at their ends; also points of those that cannot be."""
    rows, offsets = branches_of(len(narrow.points), narrow.edges)
    ways: list[Way] = []
    failed: list[int] = []
    for branch in np.split(rows, offsets[1:-1]):
        cuts: list[Cut | None] = []
        for way in (branch, branch[::-1]):
            is_end = bool(np.isin(way[0], ends))
            cut = cut_across(edge, narrow.points[way], radius) if is_end else None
            cuts.append(cut)
            if is_end and cut is None:
                failed.append(int(way[0]))
        ways.append(Way(branch, (cuts[0], cuts[1])))
    return ways, np.array(failed, dtype=np.intp)


def short_parts(narrow: Graph, label: Ints, ways: list[Way], edge: Edge, least: float) -> Ints:
    """Labels of the narrow parts whose ways are together shorter between their cuts."""
    run = np.zeros(len(label))
    for way in ways:
        steps = np.diff(chain_of(narrow, way), axis=0) * edge.scale
        run[label[way.rows[0]]] += 0.0 if way.is_gone else np.hypot(*steps.T).sum()
    own = np.unique(label[narrow.edges])
    short: Ints = own[run[own] < least]
    return short


def cuts_of(ways: list[Way]) -> list[Cut]:
    """Return all cuts."""
    return [cut for way in ways for cut in way.cuts if cut is not None]


def without(parts: Parts, label: Ints, gone: Ints) -> Parts:
    """Parts without some of the narrow ones, by the labels of their edges."""
    is_narrow = parts.is_narrow.copy()
    is_narrow[np.flatnonzero(is_narrow)[np.isin(label, gone)]] = False
    return parts._replace(is_narrow=is_narrow)


def sorted_pieces(
    parts: Parts, chains: list[Floats], pieces: list[Polygon]
) -> tuple[list[Polygon], list[Polygon], Ints]:
    """Pieces that wide parts are in, the others, and narrow chains that are in one of the first.

    A wide part is where its widest edge is, a chain where its middle is.
    """
    graph, wide = parts.graph, np.flatnonzero(~parts.is_narrow)
    part = components(len(graph.points), graph.edges[wide])[graph.edges[wide, 0]]
    order = np.lexsort([parts.middle[wide], part])
    widest = wide[order[np.append(np.diff(part[order]) != 0, True)]]
    tree = shapely.STRtree(pieces)
    middles = shapely.points(graph.points[graph.edges[widest]].mean(axis=1))
    is_wide = np.zeros(len(pieces), dtype=np.bool_)
    is_wide[tree.query(middles, predicate="within")[1]] = True
    halfway = shapely.line_interpolate_point([LineString(c) for c in chains], 0.5, normalized=True)
    chain, piece = tree.query(halfway, predicate="within")
    rest = [pieces[k] for k in np.flatnonzero(~is_wide)]
    return [pieces[k] for k in np.flatnonzero(is_wide)], rest, chain[is_wide[piece]]


def chain_of(narrow: Graph, way: Way) -> Floats:
    """Points of a way between its cuts."""
    before, behind = (np.empty((0, 2)) if c is None else c.crossing[None] for c in way.cuts)
    return np.concatenate([before, narrow.points[way.inner], behind])


def graph_between(narrow: Graph, ways: list[Way]) -> tuple[Graph, Ints]:
    """Graph of the ways between their cuts, and its points that are on a cut."""
    points, radius = [narrow.points], [narrow.radius]
    edges, fixed, n = [], [], len(narrow.points)
    for way in ways:
        row = way.inner
        for cut, end in zip(way.cuts, (0, -1), strict=True):
            if cut is None:
                continue
            row = np.append(row, n) if end else np.append(n, row)
            points.append(cut.crossing[None])
            radius.append(narrow.radius[way.rows[[end]]])
            fixed.append(n)
            n += 1
        edges.append(np.column_stack([row[:-1], row[1:]]))
    found = Graph(np.concatenate(points), np.concatenate(edges), np.concatenate(radius))
    return found, np.array(fixed, dtype=np.intp)
