r"""Places of a skeleton that stand out: clearly wider than the ways that lead away from them.

                      ___
      way            /   \           way         radius of the place, over that of the widest
    ================(  o  )===================   way out, each as narrow as it gets within reach
                     \___/

Where roads of equal width meet, the disc is wider than they are as well: 1.25 times at a T, 1.41
times where two cross, and more with rounded kerbs; so more is asked for where three ways or more
leave.
"""

from heapq import heappop, heappush

import numpy as np
import shapely

from midrib.curves.cuts import beside_of
from midrib.curves.graphs import Graph
from midrib.layout import Scale
from midrib.types import Bools, Floats, Ints

__all__ = ["length_outside_junctions", "lengths_of", "peaks_of", "stands_out"]

REACH = 3.0  # radii from a place to where the ways out are looked at
WIDER = 1.4  # times the widest way out, in passing; a right-angled bend has 1.17, one of 120° 1.33
WIDER_AT_CROSSING = 2.0  # where three ways or more leave
WAY = 0.5  # of the widest way out: the least radius of one that makes a crossing
JUNCTION = 3  # ways of a point that is one


def lengths_of(graph: Graph, scale: Scale) -> Floats:
    """Length of each edge (m,)."""
    steps = (graph.points[graph.edges[:, 1]] - graph.points[graph.edges[:, 0]]) * scale
    length: Floats = np.hypot(*steps.T)
    return length


def peaks_of(graph: Graph) -> Bools:
    """Return which points have no wider one beside them."""
    widest = graph.radius.copy()
    for here, there in (graph.edges.T, graph.edges.T[::-1]):
        np.maximum.at(widest, here, graph.radius[there])
    is_peak: Bools = graph.radius >= widest
    return is_peak


def stands_out(graph: Graph, scale: Scale, rows: Ints) -> Bools:
    """Return which of some points are clearly wider than the ways that lead away from them.

    Parameters
    ----------
    graph : Graph
    scale : lengths of one unit of x and of y
    rows : points to look at

    Notes
    -----
    That depends on the graph alone, which must be none that was divided at the width asked for: its
    changes would show ways out to be narrower at one width than at another. O(k log k) each for the
    k points within reach.
    """
    length = lengths_of(graph, scale).tolist()
    steps = [[(there, length[edge]) for edge, there in some] for some in beside_of(graph)]
    radius = graph.radius.tolist()
    return np.array([is_wider(steps, radius, int(row)) for row in rows], dtype=np.bool_)


def is_wider(steps: list[list[tuple[int, float]]], radius: list[float], place: int) -> bool:
    """Whether one point stands out."""
    ways = np.array(ways_out(steps, radius, place))
    if ways.size == 0:
        return True
    is_crossing = np.count_nonzero(ways >= WAY * ways.max()) >= JUNCTION
    return bool(radius[place] >= (WIDER_AT_CROSSING if is_crossing else WIDER) * ways.max())


def ways_out(steps: list[list[tuple[int, float]]], radius: list[float], place: int) -> list[float]:
    """Radius of each way out of the disc around a point, of its widest branch within reach.

    A branch that ends before is as narrow as it gets up to there.
    """
    own, reach = radius[place], REACH * radius[place]
    found: list[float] = []
    seen: set[int] = set()
    heap = [(0.0, place, own, -1)]  # distance, point, least radius on the way, number of the way
    while heap:
        away, here, least, way = heappop(heap)
        if here in seen:
            continue
        seen.add(here)
        if way >= 0 and len(steps[here]) == 1:
            found[way] = max(found[way], least)
        for there, length in steps[here]:
            if there in seen:
                continue
            far, narrow, on = away + length, min(least, radius[there]), way
            if on < 0 and far > own:
                on = len(found)
                found.append(0.0)
            if far < reach:
                heappush(heap, (far, there, narrow, on))
                continue
            share = (reach - away) / length
            met = radius[here] + share * (radius[there] - radius[here])
            found[on] = max(found[on], min(least, met))
    return found


def length_outside_junctions(graph: Graph, length: Floats, scale: Scale) -> Floats:
    """Length of each edge (m,) that is in no disc around a junction."""
    degree = np.bincount(graph.edges.ravel(), minlength=len(graph.points))
    at = np.flatnonzero(degree >= JUNCTION)
    discs = shapely.buffer(shapely.points(graph.points[at] * scale), graph.radius[at])
    discs = shapely.get_parts(shapely.union_all(discs))  # no two of them overlap
    lines = shapely.linestrings(graph.points[graph.edges] * scale)
    disc, edge = shapely.STRtree(lines).query(discs, predicate="intersects")
    inside = shapely.length(shapely.intersection(lines[edge], discs[disc]))
    outside: Floats = length - np.bincount(edge, inside, length.size)
    return np.maximum(outside, 0.0)
