"""Clearance: the distance from points to the boundary of the area each belongs to.

The rings of an area, one after the other, are one chain for the tree of boxes; the links from one
ring to the next widen some boxes, but are no part of the boundary.
"""

import numpy as np

from midrib.kernels.boxtree import DEPTH, LEAF, box_tree, nearest_share, squared_distance_to_box
from midrib.kernels.jit import njit
from midrib.kernels.places import place
from midrib.types import Bools, Floats, Ints

__all__ = ["clearances", "nearest_in_run", "nearest_of"]


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
        near = 0
        for k in range(point_offsets[i], point_offsets[i + 1]):
            near, _, squared = nearest_of(x[k], y[k], bx, by, goes, boxes, near, stack)
            result[k] = np.sqrt(squared)
    return result


@njit(inline=True, borrows=True)
def nearest_of(
    px: float,
    py: float,
    bx: Floats,
    by: Floats,
    goes_on: Bools,
    boxes: Floats,
    hint: int,
    stack: Ints,
) -> tuple[int, float, float]:
    """Nearest point of a chain's segments: segment, share of it, squared distance.

    Up the tree of boxes from the segment ``hint``, and down where something nearer can be: next
    to the answer that looks at half as many boxes as a descent from the root does. Only segments
    that ``goes_on`` names count.
    """
    leaves = boxes.shape[0] // 2
    nearest, segment, along, depth = np.inf, hint, 0.0, 1
    top = leaves + hint // LEAF
    stack[0] = top
    while depth > 0 or top > 1:
        if depth == 0:
            stack[0], depth = top ^ 1, 1
            top //= 2
        depth -= 1
        node = place(stack[place(depth)])
        if squared_distance_to_box(px, py, boxes, node) >= nearest:
            continue
        if node < leaves:
            left = squared_distance_to_box(px, py, boxes, 2 * node)
            right = squared_distance_to_box(px, py, boxes, 2 * node + 1)
            nearer = 2 * node if left <= right else 2 * node + 1
            stack[place(depth)], stack[place(depth + 1)] = 4 * node + 1 - nearer, nearer
            depth += 2
            continue
        first = (node - leaves) * LEAF
        for i in range(first, min(first + LEAF, bx.size - 1)):
            j = place(i)
            if not goes_on[j]:
                continue
            share, squared = nearest_on_segment(px, py, bx[j], by[j], bx[j + 1], by[j + 1])
            if squared < nearest:
                nearest, segment, along = squared, j, share
    return segment, along, nearest


@njit(inline=True, borrows=True)
def nearest_in_run(
    px: float, py: float, bx: Floats, by: Floats, first: int, stop: int
) -> tuple[int, float, float]:
    """Return ``nearest_of`` the segments first .. stop - 1 of a chain, all of which go on; O(n)."""
    nearest, segment, along = np.inf, first, 0.0
    ax, ay = bx[place(first)], by[place(first)]
    for i in range(first, stop):
        j = place(i)
        end_x, end_y = bx[j + 1], by[j + 1]
        share, squared = nearest_on_segment(px, py, ax, ay, end_x, end_y)
        ax, ay = end_x, end_y
        if squared < nearest:
            nearest, segment, along = squared, j, share
    return segment, along, nearest


@njit(inline=True, borrows=True)
def nearest_on_segment(
    px: float, py: float, ax: float, ay: float, bx: float, by: float
) -> tuple[float, float]:
    """Nearest point to p on the segment a b: share of it, squared distance."""
    share, _ = nearest_share(px, py, ax, ay, bx, by, 0.0, 1.0, 0, 0)
    dx, dy = ax + share * (bx - ax) - px, ay + share * (by - ay) - py
    return share, dx * dx + dy * dy
