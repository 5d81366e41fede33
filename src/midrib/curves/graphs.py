"""Skeletons as graphs: their radii, and branches that are pruned.

Every method that finds a skeleton makes a ``Graph`` of an area; what is done with it is here.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.clearance import clearances
from midrib.kernels.graph import branches_of
from midrib.layout import Scale
from midrib.types import Floats, Ints

__all__ = ["Branches", "Graph", "pruned", "radii_of"]

STAY = 1  # ways that a junction keeps when its branches are pruned: it may become a tip


class Graph(NamedTuple):
    """A skeleton: points and the edges between them."""

    points: Floats  # (n, 2)
    edges: Ints  # (m, 2) rows of points
    radius: Floats  # (n,) lengths to the nearest point of the boundary


class Branches(NamedTuple):
    """The branches of a graph: from a tip or junction to the next one, or round."""

    rows: Ints  # of the points of each branch in turn
    offsets: Ints  # (k + 1,) where each starts

    def edges(self, kept: Ints) -> Ints:
        """Return the edges of some of the branches."""
        steps = np.column_stack([self.rows[:-1], self.rows[1:]])
        of_branch = np.repeat(np.arange(self.offsets.size - 1), np.diff(self.offsets))
        is_kept = np.isin(of_branch, kept)
        inside = (of_branch[:-1] == of_branch[1:]) & is_kept[:-1]
        edges: Ints = steps[inside]
        return edges


def radii_of(coordinates: Floats, offsets: Ints, points: Floats, scale: Scale) -> Floats:
    """Lengths from points to the nearest point of closed rings; O((n + m) log m)."""
    ring = coordinates[:, :2] * scale
    at = points * scale
    goes_on = np.ones(len(ring), dtype=np.bool_)
    goes_on[offsets[1:] - 1] = False
    whole = np.array([0, len(at)]), np.array([0, len(ring)])
    return clearances(
        at[:, 0].copy(), at[:, 1].copy(), whole[0], ring[:, 0].copy(), ring[:, 1].copy(),
        goes_on, whole[1],
    )  # fmt: skip


def pruned(graph: Graph, scale: Scale, length: float, significance: float) -> Graph:
    """Return a graph without the branches to tips that explain little.

    Parameters
    ----------
    graph : Graph
    scale : lengths of one unit of x and of y
    length : shorter branches go
    significance : branches go that reach less than so many radii from their junction: how far the
        disc of the tip reaches, over the radius of the disc around the junction. That is 1.41 for
        the corner of a rectangle.

    Notes
    -----
    The least of a junction go first; one of its ways stays, so that it may become a tip. What is
    one branch then may go in its turn. O(n log n) in a round.
    """
    edges = graph.edges
    while True:
        branches = Branches(*branches_of(len(graph.points), edges))
        doomed = doomed_of(graph, edges, branches, scale, length, significance)
        if doomed.size == 0:
            break
        edges = branches.edges(np.setdiff1d(np.arange(branches.offsets.size - 1), doomed))
    used, edges = np.unique(edges, return_inverse=True)
    return Graph(graph.points[used], edges.reshape(-1, 2), graph.radius[used])


def doomed_of(
    graph: Graph, edges: Ints, branches: Branches, scale: Scale, length: float, significance: float
) -> Ints:
    """Branches to tips that are to go now."""
    degree = np.bincount(edges.ravel(), minlength=len(graph.points))
    ends = branches.rows[np.column_stack([branches.offsets[:-1], branches.offsets[1:] - 1])]
    steps = np.hypot(*(np.diff(graph.points[branches.rows], axis=0) * scale).T)
    steps[branches.offsets[1:-1] - 1] = 0.0  # from one branch to the next
    run = np.add.reduceat(np.append(steps, 0.0), branches.offsets[:-1])
    is_tip = degree[ends] == 1
    is_spur = is_tip.sum(axis=1) == 1
    tip = np.where(is_tip[:, 0], ends[:, 0], ends[:, 1])
    junction = np.where(is_tip[:, 0], ends[:, 1], ends[:, 0])
    reach = run + graph.radius[tip]
    is_weak = is_spur & ((run < length) | (reach < significance * graph.radius[junction]))
    weak = np.flatnonzero(is_weak)
    weak = weak[np.lexsort([weak, reach[weak], junction[weak]])]
    first = np.searchsorted(junction[weak], junction[weak])  # of the weak ones of the junction
    turn = np.arange(weak.size) - first
    doomed: Ints = weak[turn < degree[junction[weak]] - STAY]
    return doomed
