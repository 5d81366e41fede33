r"""Trunks: the shortest way through a skeleton between the two ends of an area, and on to these.

______________E_________
| \            |       / |      A trunk leaves the skeleton in the middle of a disc that reaches
|  x...........o------x  |      nearest to the end E. Of the discs those at the bends are known;
| /                    \ |      the nearest of them, at x, may be far off. Where the way comes
back past E from there, it is joined at o, as near as it comes.
"""

import numpy as np

from midrib.curves.finding import Found
from midrib.curves.graphs import Graph
from midrib.curves.joining import heights_of
from midrib.errors import InvalidAreaError
from midrib.kernels.graph import shortest_way
from midrib.kernels.joining import join_beads
from midrib.kernels.paths import Beads
from midrib.layout import Layout, Scale
from midrib.types import Floats

__all__ = ["trunk_of"]

WAYS = 2  # of a point that is no tip


def trunk_of(graph: Graph, layout: Layout) -> Found:
    """Shortest way through a skeleton between the two ends of an area, and on to these ends.

    It leaves the skeleton at the end itself if that is a tip, else in the middle of a disc that
    reaches nearest to it: in a flat end, of the last disc that touches it. Where the way would
    come back past the end, it leaves the skeleton there.

    Raises
    ------
    InvalidAreaError
        If no way leads there.
    """
    scale, ends = layout.scale, layout.middle
    inner = way_between(graph, ends.point, scale)
    rows = np.array([0] * (len(inner) + 1) + [1])  # whose search each point's begins with
    beads = Beads(
        np.concatenate([ends.point[:1], inner, ends.point[1:]]),
        ends.origin[rows],
        ends.at[rows, 0],
        ends.at[rows, 1],
    )
    joined, source, loops, _ = join_beads(layout.mesh, beads, *scale)
    if len(joined) < 2:
        msg = "the trunk is one point; a line needs two"
        raise InvalidAreaError(msg)
    height = np.full(len(beads.point), np.nan)
    height[0], height[-1] = ends.height
    return Found(joined, heights_of(layout, joined, source, height), loops)


def way_between(graph: Graph, ends: Floats, scale: Scale) -> Floats:
    """Points of the shortest way through a skeleton that does not come back past either end.

    Raises
    ------
    InvalidAreaError
        If there is no skeleton, or no way leads from one end to the other.
    """
    points, edges = graph.points, graph.edges
    if len(points) == 0:
        msg = "nothing of the skeleton is inside the area; a smaller spacing may find it"
        raise InvalidAreaError(msg)
    leaves = [last_before(graph, end, scale) for end in ends]
    while True:  # each round leaves nearer to an end
        way = shortest_way(points, edges, leaves[0], leaves[1], *scale)
        if way.size == 0:
            msg = "the skeleton is in pieces between the two ends; a smaller spacing may join them"
            raise InvalidAreaError(msg)
        line = points[way]
        for k, ahead in enumerate((line, line[::-1])):
            nearer = nearest_ahead(ahead, ends[k], scale)
            if nearer is not None:
                break
        else:
            return line
        step, place = nearer
        onwards = way if k == 0 else way[::-1]
        leaves[k] = int(onwards[step])
        if (place != points[leaves[k]]).any():
            side = onwards[step : step + 2]
            is_cut = np.isin(edges, side).all(axis=1)
            edges = np.vstack([edges[~is_cut], np.column_stack([side, [len(points)] * 2])])
            leaves[k], points = len(points), np.vstack([points, place])


def last_before(graph: Graph, end: Floats, scale: Scale) -> int:
    """Row of the point at which the trunk leaves for an end: its disc reaches nearest to it.

    In a flat end that is the last disc that touches it, in a sharp one the tip itself. Other tips
    are in corners beside the end.
    """
    away = np.hypot(*((graph.points - end) * scale).T)
    degree = np.bincount(graph.edges.ravel(), minlength=len(graph.points))
    is_beside = (degree < WAYS) & (away > 0.0)
    return int(np.argmin(np.where(is_beside & ~is_beside.all(), np.inf, away - graph.radius)))


def nearest_ahead(way: Floats, end: Floats, scale: Scale) -> tuple[int, Floats] | None:
    """Where a way that leads away from an end first stops coming nearer to it.

    Returns
    -------
    step : int
    place : (2,) on that step; or None if the way comes no nearer at first
    """
    step, place = len(way) - 1, way[-1]
    for k in range(step):
        off, ahead = (way[k] - end) * scale, (way[k + 1] - way[k]) * scale
        towards, squared = -float(off @ ahead), float(ahead @ ahead)
        if k == 0 and towards <= 0.0:  # as most ways do
            return None
        if towards < squared:
            step, place = k, way[k] + max(towards, 0.0) / squared * (way[k + 1] - way[k])
            break
    before, after = np.hypot(*((np.stack([way[0], place]) - end) * scale).T)
    return (step, place) if after < before else None
