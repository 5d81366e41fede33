"""A curve on the boundary of an area, and the nearest of its points to a point anywhere."""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import box_tree
from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh
from midrib.types import Floats, Ints

__all__ = ["Chain", "Goal", "goal_of"]

# Two radii are a tie if they differ by less than rounding can explain: this share of the radius,
# or this share of the largest coordinate, whichever is more.
TIE_OF_RADIUS = 2.0**-40
TIE_OF_COORDINATE = 2.0**-50


class Chain(NamedTuple):
    """One curve: m + 1 mesh vertices, the m boundary sides between them, and arc lengths.

    A side of -1 is a bridge to another loop of the boundary, without length; see ``channels``.
    """

    vertex: Ints
    side: Ints
    arc: Floats

    @property
    def length(self) -> float:
        """Length of the whole curve."""
        return float(self.arc[-1])


class Goal(NamedTuple):
    """A curve to look for: where it lies on the mesh, and a tree of boxes over it."""

    segment: Ints  # for each half-edge the curve's segment on it, or -1
    place: Ints  # for each mesh vertex its place on the curve, or -1
    chain: Chain
    x: Floats  # in lengths, as y and boxes
    y: Floats
    boxes: Floats
    scale_x: float
    scale_y: float
    tie: float  # radii that differ by less than rounding of coordinates explains are equal


@njit()
def goal_of(mesh: Mesh, chain: Chain, scale_x: float, scale_y: float) -> Goal:
    """Prepare to look for a curve; O(n)."""
    segment, place = np.full(mesh.tri.size, -1, np.intp), np.full(mesh.x.size, -1, np.intp)
    n = chain.vertex.size
    x, y = np.empty(n), np.empty(n)
    for i in range(n):
        v = chain.vertex[i]
        place[v] = i
        x[i], y[i] = mesh.x[v] * scale_x, mesh.y[v] * scale_y
    for i in range(n - 1):
        if chain.side[i] >= 0:
            segment[chain.side[i]] = i
    largest = 0.0
    for v in range(mesh.x.size):
        largest = max(largest, abs(mesh.x[v]) * scale_x, abs(mesh.y[v]) * scale_y)
    tie = TIE_OF_COORDINATE * largest
    return Goal(segment, place, chain, x, y, box_tree(x, y), scale_x, scale_y, tie)


@njit(borrows=True)
def slack_of(tie: float, radius: float) -> float:
    """By how much radii of about this size may differ and still be a tie."""
    return max(tie, TIE_OF_RADIUS * radius)
