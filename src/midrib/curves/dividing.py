"""An area divided at a width: pieces that are wide, and the lines of those that are narrow."""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import LineString, MultiPolygon, Polygon

from midrib.curves.contrast import lengths_of
from midrib.curves.cuts import Cut, Edge, beside_of, cut_across, pieces_of
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
        cuts, failed = cuts_at(narrow, ends, edge, radius)
        graph, fixed, label_there = graph_between(narrow, cuts, label)
        short = short_parts(graph, label_there, np.unique(label[narrow.edges]), edge, least)
        failed = np.setdiff1d(label[failed], short)
        if failed.size == short.size == 0:
            wide, rest, mixed = sorted_pieces(parts, graph, pieces_of(edge, cuts))
            if mixed.size == 0:
                lines = network_lines(graph, MultiPolygon(rest), scale_of(edge), merge, fixed)
                return Divided(wide, lines, uncut)
            failed = np.unique(label_there[mixed])
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


def cuts_at(narrow: Graph, ends: Ints, edge: Edge, radius: float) -> tuple[list[Cut], Ints]:
    """Cut an area at ends of the narrow part; also those ends where that is not possible."""
    beside = beside_of(narrow)
    cuts = [cut_across(edge, narrow, beside, end, radius) for end in ends.tolist()]
    failed = ends[np.array([cut is None for cut in cuts], dtype=np.bool_)]
    return [cut for cut in cuts if cut is not None], failed


def short_parts(graph: Graph, label: Ints, own: Ints, edge: Edge, least: float) -> Ints:
    """Return which labels of narrow parts have less than a length between their cuts."""
    length = lengths_of(graph, scale_of(edge))
    run = np.bincount(label[graph.edges[:, 0]], length, own.max() + 1)
    short: Ints = own[run[own] < least]
    return short


def without(parts: Parts, label: Ints, gone: Ints) -> Parts:
    """Parts without some of the narrow ones, by the labels of their edges."""
    is_narrow = parts.is_narrow.copy()
    is_narrow[np.flatnonzero(is_narrow)[np.isin(label, gone)]] = False
    return parts._replace(is_narrow=is_narrow)


def sorted_pieces(
    parts: Parts, narrow: Graph, pieces: list[Polygon]
) -> tuple[list[Polygon], list[Polygon], Ints]:
    """Pieces that wide parts are in, the others, and a point of each narrow way in the former.

    A wide part is where its widest edge is, a way where its middle is.
    """
    graph, wide = parts.graph, np.flatnonzero(~parts.is_narrow)
    part = components(len(graph.points), graph.edges[wide])[graph.edges[wide, 0]]
    order = np.lexsort([parts.middle[wide], part])
    widest = wide[order[np.append(np.diff(part[order]) != 0, True)]]
    tree = shapely.STRtree(pieces)
    middles = shapely.points(graph.points[graph.edges[widest]].mean(axis=1))
    is_wide = np.zeros(len(pieces), dtype=np.bool_)
    is_wide[tree.query(middles, predicate="within")[1]] = True
    rows, offsets = branches_of(len(narrow.points), narrow.edges)
    ways = np.split(rows, offsets[1:-1])
    chains = [LineString(narrow.points[way]) for way in ways]
    halfway = shapely.line_interpolate_point(chains, 0.5, normalized=True)
    way, piece = tree.query(halfway, predicate="within")
    mixed = np.array([ways[k][0] for k in way[is_wide[piece]]], dtype=np.intp)
    rest = [pieces[k] for k in np.flatnonzero(~is_wide)]
    return [pieces[k] for k in np.flatnonzero(is_wide)], rest, mixed


def graph_between(narrow: Graph, cuts: list[Cut], label: Ints) -> tuple[Graph, Ints, Ints]:
    """Graph of the narrow part between cuts, its points that are on a cut, and all labels."""
    n = len(narrow.points)
    crossings = [crossing for cut in cuts for crossing in cut.crossings]
    is_before = np.zeros(n, dtype=np.bool_)
    for cut in cuts:
        is_before[cut.before] = True
    crossed: dict[int, list[int]] = {}
    for k, crossing in enumerate(crossings):
        crossed.setdefault(crossing.edge, []).append(k)
    edges = []
    for on_edge in crossed.values():
        one, other = crossings[on_edge[0]], crossings[on_edge[-1]]
        if len(on_edge) > 1 and one.share + other.share < 1.0:
            edges.append((n + on_edge[0], n + on_edge[-1]))
        elif len(on_edge) == 1 and not is_before[one.beyond]:
            edges.append((n + on_edge[0], one.beyond))
    is_kept = ~is_before[narrow.edges].any(axis=1)
    points = np.array([crossing.point for crossing in crossings]).reshape(-1, 2)
    beyond = np.array([crossing.beyond for crossing in crossings], dtype=np.intp)
    found = Graph(
        np.concatenate([narrow.points, points]),
        np.concatenate([narrow.edges[is_kept], np.array(edges, dtype=np.intp).reshape(-1, 2)]),
        np.append(narrow.radius, narrow.radius[beyond]),
    )
    return found, n + np.arange(len(crossings)), np.append(label, label[beyond])
