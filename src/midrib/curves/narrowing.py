"""Where a skeleton is narrower than a width: its edges divided there, and which parts count.

    wide                 radius >= half the width
    narrow               less
    change               a point where it is just that, between a wide and a narrow edge

A part, of edges that hang together, counts if it is long, and a wide one also if it stands out from
what leads to it; else it goes with what is beside it, the narrow parts first. So nothing flickers
where an area is about as wide as asked for, ponds stay, and the places where roads meet are no
areas of their own: their discs add nothing to the length of a wide part.

As the width grows wide parts only lose: the narrow edges of a smaller width are narrow, narrow
parts only grow, a wide part is within one that is as long, and what stands out is told by the
skeleton as it was before it was divided.
"""

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from midrib.curves.contrast import (
    length_outside_junctions,
    lengths_of,
    peaks_of,
    stands_out,
)
from midrib.curves.graphs import Graph
from midrib.layout import Scale
from midrib.types import Bools, Floats, Ints

__all__ = ["Parts", "Radii", "divided_at", "parts_of"]

SHARE = 0.25  # of the radius asked for, between places where an edge is looked at
MOST_PLACES = 64  # on an edge
ROUNDS = 40  # of halving the interval that a change is in

Radii: TypeAlias = Callable[[Floats], Floats]  # of points (n, 2): distances to the boundary


class Parts(NamedTuple):
    """A skeleton whose edges are either wide or narrow."""

    graph: Graph
    is_narrow: Bools  # (m,) of each edge
    middle: Floats  # (m,) radius in the middle of each edge
    undivided: Graph  # the skeleton before changes were put on it; its points come first


def divided_at(graph: Graph, radius: float, radii: Radii, scale: Scale) -> Parts:
    """Divide the edges of a graph where they change between narrow and wide.

    Between corners the radius has a least value within an edge, so that edges are looked at inside;
    it changes by at most a unit for each unit of the way, which says where that is not needed.
    """
    edge, low, high = changes(graph, radius, radii, scale)
    start, along = (
        graph.points[graph.edges[edge, 0]],
        np.diff(graph.points[graph.edges[edge]], axis=1),
    )

    def places(share: Floats) -> Floats:
        found: Floats = start + share[:, None] * along[:, 0]
        return found

    for _ in range(ROUNDS if edge.size else 0):
        middle = (low + high) / 2.0
        is_low = radii(places(middle)) < radius
        low[is_low], high[~is_low] = middle[is_low], middle[~is_low]
    # A point whose radius is just that is the change itself: one beside it had no way to it.
    is_inside = (high > 0.0) & (high < 1.0)
    edge, high, start, along = edge[is_inside], high[is_inside], start[is_inside], along[is_inside]
    order = np.lexsort([high, edge])
    new = len(graph.points) + np.arange(edge.size)
    first = np.insert(graph.edges[:, 0], edge[order] + 1, new)
    last = np.insert(graph.edges[:, 1], edge[order], new)
    points = np.concatenate([graph.points, places(high)[order]])
    edges = np.column_stack([first, last])
    whole = Graph(points, edges, np.append(graph.radius, np.full(edge.size, radius)))
    middle_radius = radii(points[edges].mean(axis=1))
    return Parts(whole, middle_radius < radius, middle_radius, graph)


def changes(graph: Graph, radius: float, radii: Radii, scale: Scale) -> tuple[Ints, Floats, Floats]:
    """Edges with changes, and shares of each between which one is: narrow there, and wide there."""
    ends = graph.points[graph.edges]
    length = np.hypot(*((ends[:, 1] - ends[:, 0]) * scale).T)
    both = graph.radius[graph.edges].sum(axis=1)
    may_change = (both - length < 2.0 * radius) & (both + length > 2.0 * radius)
    count = np.where(may_change, np.clip(np.ceil(length / (SHARE * radius)), 1, MOST_PLACES), 1)
    count = count.astype(np.intp)
    edge = np.repeat(np.arange(count.size), count)
    number = np.arange(edge.size) - np.repeat(np.cumsum(count) - count, count)
    low, high = number / count[edge], (number + 1) / count[edge]
    inside = number > 0
    share = low[inside, None]
    places = ends[edge[inside], 0] * (1.0 - share) + ends[edge[inside], 1] * share
    is_wide = graph.radius[graph.edges] >= radius  # at both ends of each edge
    before, behind = is_wide[edge, 0], is_wide[edge, 1]
    if places.size:
        before[inside] = radii(places) >= radius
        behind[:-1][inside[1:]] = before[inside]
    found = np.flatnonzero(before != behind)
    swap = before[found]
    one, other = low[found], high[found]
    return edge[found], np.where(swap, other, one), np.where(swap, one, other)


def parts_of(parts: Parts, least: float, scale: Scale) -> Parts:
    """Let parts that do not count go with what is beside them.

    Parameters
    ----------
    parts : Parts
    least : length from which on a part counts
    scale : lengths of one unit of x and of y
    """
    graph, is_narrow = parts.graph, parts.is_narrow.copy()
    length = lengths_of(graph, scale)
    for narrow in (True, False):
        own = np.flatnonzero(is_narrow == narrow)
        if own.size in (0, is_narrow.size):
            continue
        label = components(len(graph.points), graph.edges[own])
        part = label[graph.edges[own, 0]]
        counted = length if narrow else length_outside_junctions(graph, length, scale)
        counts = np.bincount(part, counted[own], len(label)) >= least
        if not narrow:
            at = np.intersect1d(graph.edges[own], np.flatnonzero(peaks_of(parts.undivided)))
            at = at[~counts[label[at]]]
            counts[label[at[stands_out(parts.undivided, scale, at)]]] = True
        is_narrow[own[~counts[part]]] = not narrow
    return parts._replace(is_narrow=is_narrow)


def components(n: int, edges: Ints) -> Ints:
    """Return the least point that each of n points hangs together with by edges."""
    label = np.arange(n)
    while True:
        least = np.minimum(*label[edges.T])
        new = label.copy()
        np.minimum.at(new, edges[:, 0], least)
        np.minimum.at(new, edges[:, 1], least)
        np.minimum.at(new, label[edges[:, 0]], least)
        np.minimum.at(new, label[edges[:, 1]], least)
        new = new[new]
        if (new == label).all():
            return label
        label = new
