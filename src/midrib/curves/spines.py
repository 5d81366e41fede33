r"""Spines: lines through the widest places of an area, along which its name may run.

    .-------.                A lake that is a bay of its river has its name in the lake, not in
.__/  o      \__.            the river: so there are ways of the medial axis through the largest
~~~~~~~~~~~~~~~~~            discs (o) from one arm to another, and a level chord through each.
"""

from itertools import combinations

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.curves.contrast import peaks_of
from midrib.curves.graphs import Graph
from midrib.kernels.graph import shortest_way
from midrib.layout import Scale
from midrib.types import Floats, Ints

__all__ = ["spines_of"]

PLACES = 3  # that have spines of their own
SECTORS = 8  # of directions, in each of which the farthest tip is led to
WAYS = 2  # through a place, from tip to tip


def spines_of(graph: Graph, area: Polygon, scale: Scale) -> list[LineString]:
    """Lines through the widest places of an area.

    Parameters
    ----------
    graph : medial axis of the area, without what leads into corners
    area : Polygon
    scale : lengths of one unit of x and of y

    Returns
    -------
    list of LineString
        For each place the level chord and the ways from tip to tip that lead farthest.
    """
    lines: list[LineString] = []
    for place in widest_places(graph, scale):
        lines += [*level_chord(graph.points[place], area), *ways_through(graph, place, scale)]
    return lines


def widest_places(graph: Graph, scale: Scale) -> list[int]:
    """Points with the largest discs, none in the disc of another."""
    at = graph.points * scale
    peaks = np.flatnonzero(peaks_of(graph))
    left = peaks[np.argsort(-graph.radius[peaks], kind="stable")]
    found: list[int] = []
    while left.size and len(found) < PLACES:
        place = int(left[0])
        found.append(place)
        left = left[np.hypot(*(at[left] - at[place]).T) > graph.radius[place]]
    return found


def level_chord(point: Floats, area: Polygon) -> list[LineString]:
    """Piece of the level line through a point that it is on; none if rounding leaves none."""
    low, _, high, _ = area.bounds
    level = LineString([(low, point[1]), (high, point[1])])
    pieces = shapely.get_parts(level.intersection(area))
    pieces = pieces[shapely.length(pieces) > 0.0]
    if pieces.size == 0:
        return []
    return [pieces[np.argmin(shapely.distance(pieces, shapely.Point(point)))]]


def ways_through(graph: Graph, place: int, scale: Scale) -> list[LineString]:
    """Ways from tip to tip through a point: the pairs with the tips farthest apart."""
    ways = [
        shortest_way(graph.points, graph.edges, place, int(tip), *scale)
        for tip in farthest_tips(graph, place, scale)
    ]
    ways = [way for way in ways if way.size > 1]
    apart = [
        (-np.hypot(*((graph.points[one[-1]] - graph.points[other[-1]]) * scale)), i, j)
        for (i, one), (j, other) in combinations(enumerate(ways), 2)
        if one[1] != other[1]
    ]
    pairs = [np.concatenate([ways[i][:0:-1], ways[j]]) for _, i, j in sorted(apart)[:WAYS]]
    # A place at a tip, or one that all ways leave along the same branch, has none through it.
    return [LineString(graph.points[way]) for way in pairs or ways[:1]]


def farthest_tips(graph: Graph, place: int, scale: Scale) -> Ints:
    """Farthest tip in each sector of directions, the farthest of all first."""
    tips = np.flatnonzero(np.bincount(graph.edges.ravel(), minlength=len(graph.points)) == 1)
    tips = tips[tips != place]
    off = (graph.points[tips] - graph.points[place]) * scale
    away = np.hypot(*off.T)
    order = np.argsort(-away, kind="stable")
    turn = np.arctan2(off[:, 1], off[:, 0]) / (2.0 * np.pi) * SECTORS
    _, first = np.unique(np.round(turn[order]) % SECTORS, return_index=True)
    farthest: Ints = tips[order[np.sort(first)]]
    return farthest
