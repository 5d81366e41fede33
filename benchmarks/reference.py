r"""The line that others are held against: the trunk of a densely sampled medial axis.

    o-----------------------------o
    | \                         / |
    e0--+----------------------+--e1     the trunk leads from one expected end to the other
    | /                         \ |     along the medial axis; all its branches are left out
    o-----------------------------o

The Voronoi diagram of points on the boundary keeps, inside the area, near the medial axis. Where a
wall is thinner than the points are apart it may cross the wall: it does so between points that are
no farther from each other than that, and such steps are left out if they leave the area. From
an expected end the trunk starts straight to the axis point that has this end nearest; from a tip
that is narrower than the samples are apart, to the nearest axis point.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import Voronoi
from shapely import LineString
from shapely.geometry.base import BaseGeometry

from families import Case, Floats

__all__ = ["Axis", "axis_of"]

SAMPLES_PER_WIDTH = 60
STRAIGHT = 1e-4  # deviation up to which the trunk's points are left out, in widths
ROUNDING = 1e-9
MOST_TRIED = 100  # nodes near a sharp end
ON_WALL = 1e-6  # of the way from an end: so much of it may be outside by rounding
NEAR = 1e-3  # what a step along the trunk costs beside a line that it lies on, in widths


@dataclass(frozen=True, eq=False)
class Axis:
    """The medial axis of an area as a graph, with the two nodes at the expected ends."""

    case: Case
    nodes: Floats  # (k, 2)
    links: NDArray[np.intp]  # (m, 2)
    tips: tuple[int, int]

    def trunk(self, line: BaseGeometry | None = None) -> LineString:
        """Way from end to end: past islands on the side where ``line`` runs, or the shorter."""
        a, b = self.nodes[self.links[:, 0]], self.nodes[self.links[:, 1]]
        cost = np.hypot(*(a - b).T)
        if line is not None and self.case.area.interiors:
            coarse = line.simplify(STRAIGHT * self.case.width)  # exact lines have 10^5 vertices
            off = shapely.distance(shapely.points((a + b) / 2), coarse)
            cost *= NEAR + off / self.case.width
        size = len(self.nodes)
        graph = csr_array((cost, (self.links[:, 0], self.links[:, 1])), shape=(size, size))
        start, stop = self.tips
        if min(start, stop) < 0:
            msg = f"the sampled medial axis of {self.case.name} does not reach its ends"
            raise RuntimeError(msg)
        distance, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)
        if not np.isfinite(distance[stop]):
            msg = f"the sampled medial axis of {self.case.name} is in pieces"
            raise RuntimeError(msg)
        path = [stop]
        while path[-1] != start:
            path.append(int(before[path[-1]]))
        first, last = self.case.ends
        trunk = LineString(np.vstack([first, self.nodes[path[::-1]], last]))
        return trunk.simplify(STRAIGHT * self.case.width)


def axis_of(case: Case, samples_per_width: int = SAMPLES_PER_WIDTH) -> Axis:
    """Sample the boundary of an area and keep what of the Voronoi diagram is inside."""
    spacing = case.width / samples_per_width
    dense = shapely.segmentize(case.area, spacing)
    rings = [np.asarray(ring.coords)[:-1] for ring in (dense.exterior, *dense.interiors)]
    points = np.concatenate(rings)
    origin = points.mean(axis=0)  # far from it, the diagram would lose digits
    diagram = Voronoi(points - origin)
    nodes = diagram.vertices + origin
    shapely.prepare(case.area)
    inside = shapely.contains_xy(case.area, nodes)
    links = np.asarray(diagram.ridge_vertices, dtype=np.intp)
    is_inner = (links >= 0).all(axis=1) & inside[links].all(axis=1)
    links, pairs = links[is_inner], diagram.ridge_points[is_inner]
    apart = np.hypot(*(diagram.points[pairs[:, 0]] - diagram.points[pairs[:, 1]]).T)
    is_doubtful = apart <= spacing * (1.0 + ROUNDING)
    crosses = ~shapely.covers(case.area, shapely.linestrings(nodes[links[is_doubtful]]))
    links = np.delete(links, np.flatnonzero(is_doubtful)[crosses], axis=0)
    piece = pieces(links, len(nodes))
    whole = np.bincount(piece[links[:, 0]]).argmax()
    tips = []
    for end in case.ends:
        tip = tip_of(diagram, inside, end - origin, case, origin)
        if tip < 0 or piece[tip] != whole:
            tip = tip_beyond(nodes, piece == whole, end, case)
        tips.append(tip)
    return Axis(case, nodes, links, (tips[0], tips[1]))


def pieces(links: NDArray[np.intp], size: int) -> NDArray[np.intp]:
    """Return the number of the connected piece that each node is in."""
    graph = csr_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(size, size))
    found: NDArray[np.intp] = connected_components(graph, directed=False)[1]
    return found


def tip_beyond(nodes: Floats, is_whole: NDArray[np.bool_], end: Floats, case: Case) -> int:
    """Node nearest to an end that is too sharp for its samples, or -1 if none is a width near.

    Of the nearest ones the first to which the straight way is free: others are across a wall.
    """
    off = np.hypot(*(nodes - end).T)
    near = np.flatnonzero(is_whole & (off <= case.width))
    near = near[np.argsort(off[near])][:MOST_TRIED]
    return int(next((k for k in near if is_free(case, end, nodes[k])), -1))


def is_free(case: Case, end: Floats, node: Floats) -> bool:
    """Whether the straight way from an end to a node is inside; an end may be a little outside."""
    start = end + ON_WALL * (node - end)
    return bool(case.area.covers(LineString([start, node])))


def tip_of(
    diagram: Voronoi, inside: NDArray[np.bool_], end: Floats, case: Case, origin: Floats
) -> int:
    """Node nearest to an end, of the cell of the boundary point nearest to it, or -1.

    On the end's side of a wall, if the end is not on the wall itself.
    """
    sample = np.argmin(((diagram.points - end) ** 2).sum(axis=1))
    cell = np.array(diagram.regions[diagram.point_region[sample]])
    cell = cell[(cell >= 0) & inside[cell]]
    if cell.size == 0:
        return -1
    cell = cell[np.argsort(((diagram.vertices[cell] - end) ** 2).sum(axis=1))]
    free = (k for k in cell if is_free(case, end + origin, diagram.vertices[k] + origin))
    return int(next(free, cell[0]))
