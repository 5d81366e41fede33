"""Clearance: the distance from points to the boundary of the area each belongs to.

The rings of an area, one after the other, are one chain for the tree of boxes; the links from one
ring to the next widen some boxes, but are no part of the boundary.
"""

import numpy as np

from midrib.kernels.boxtree import DEPTH, LEAF, box_tree, nearest_share, squared_distance_to_box
from midrib.kernels.jit import njit
from midrib.types import Bools, Floats, Ints

__all__ = ["clearances"]


@njit(entry=True)
def clearances(
    x: Floats,
    y: Floats,
    point_offsets: Ints,
    ring_x: Floats,
    ring_y: Floats,
    goes_on: Bools,
    area_offsets: Ints,
) -> Floats:
    """Distance of each point to its area's boundary; inf where the area has none.

    Points of area i are those from ``point_offsets[i]`` on, its vertices those from
    ``area_offsets[i]`` on; ``goes_on`` says whether a segment leads from a vertex to the next.
    O((n + m) log m) for n points near the middle of m segments.
    """
    result = np.full(x.size, np.inf)
    stack = np.empty(DEPTH, np.intp)
    for i in range(area_offsets.size - 1):
        start, stop = area_offsets[i], area_offsets[i + 1]
        if start == stop:
            continue
        bx, by, goes = ring_x[start:stop], ring_y[start:stop], goes_on[start:stop]
        boxes = box_tree(bx, by)
        for k in range(point_offsets[i], point_offsets[i + 1]):
            result[k] = clearance(x[k], y[k], bx, by, goes, boxes, stack)
    return result


@njit()
def clearance(
    px: float, py: float, bx: Floats, by: Floats, goes_on: Bools, boxes: Floats, stack: Ints
) -> float:
    """Distance of one point to the nearest segment of a chain, by descent into its tree."""
    leaves = boxes.shape[0] // 2
    nearest, depth = np.inf, 1
    stack[0] = 1
    while depth > 0:
        depth -= 1
        node = stack[depth]
        if squared_distance_to_box(px, py, boxes, node) >= nearest:
            continue
        if node < leaves:
            left = squared_distance_to_box(px, py, boxes, 2 * node)
            right = squared_distance_to_box(px, py, boxes, 2 * node + 1)
            nearer = 2 * node if left <= right else 2 * node + 1
            stack[depth], stack[depth + 1] = 4 * node + 1 - nearer, nearer
            depth += 2
            continue
        first = (node - leaves) * LEAF
        for j in range(first, min(first + LEAF, bx.size - 1)):
            if not goes_on[j]:
                continue
            share, _ = nearest_share(px, py, bx[j], by[j], bx[j + 1], by[j + 1], 0.0, 1.0, 0, 0)
            dx = bx[j] + share * (bx[j + 1] - bx[j]) - px
            dy = by[j] + share * (by[j + 1] - by[j]) - py
            nearest = min(nearest, dx * dx + dy * dy)
    return float(np.sqrt(nearest))
