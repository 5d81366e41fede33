"""Points in one ring: each edge is looked at once, with the points that are as high as it is."""

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.predicates import orient
from midrib.types import Bools, Floats

__all__ = ["enclosed"]


@njit(entry=True)
def enclosed(ring: Floats, points: Floats) -> Bools:
    """Whether points lie inside of a closed ring; none may lie on it.

    A ray from each point to the right crosses the ring an odd number of times. Takes n log m for n
    rows of the ring and m points, and m for each edge that all of them are as high as.

    Parameters
    ----------
    ring : (n, 2), the last row as the first one
    points : (m, 2)
    """
    order = np.argsort(points[:, 1])
    heights = points[order, 1]
    is_inside = np.zeros(order.size, np.bool_)
    for k in range(ring.shape[0] - 1):
        low, high = k, k + 1
        if ring[low, 1] > ring[high, 1]:
            low, high = high, low
        # The lower end belongs to an edge and the upper one does not, so that a ray through a
        # vertex crosses once where the ring goes on, and twice or never where it turns back.
        first = np.searchsorted(heights, ring[low, 1])
        last = np.searchsorted(heights, ring[high, 1])
        for j in range(first, last):
            i = order[j]
            side = orient(
                ring[low, 0], ring[low, 1], ring[high, 0], ring[high, 1], points[i, 0], points[i, 1]
            )
            if side > 0.0:
                is_inside[i] = not is_inside[i]
    return is_inside
