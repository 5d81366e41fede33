"""Nearest points of a chain, by a tree of boxes over its segments in order.

Segments that follow each other lie near each other, so boxes over runs of them make a good tree
without any sorting: leaf i holds the segments i LEAF to (i + 1) LEAF - 1, the node above leaves
2 i and 2 i + 1 holds both, and so on; node 1 is the root.

                1
            2       3         children of node k: 2 k and 2 k + 1
          4   5   6   7       leaves: the last row

What the nearest point is does not depend on what can be seen: see ``visibility``.
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.places import place
from midrib.types import Floats, Ints

__all__ = ["FOOT", "GRAZE", "LIMIT", "VERTEX", "box_tree", "nearest_on_chain", "nearest_share"]

FOOT, VERTEX, GRAZE, LIMIT = 0, 1, 2, 3
LEAF = 4
DEPTH = 128  # more than twice the height of any tree that fits into memory


@njit(inline=True, borrows=True)
def nearest_share(
    px: float,
    py: float,
    ax: float,
    ay: float,
    bx: float,
    by: float,
    first: float,
    last: float,
    kind_first: int,
    kind_last: int,
) -> tuple[float, int]:
    """Where on the segment a b (0 at a, 1 at b) the nearest point to p lies, between two shares.

    NaN if they leave nothing. Also its kind: FOOT, or that of the share it stops at.
    """
    if first > last:
        return np.nan, FOOT
    dx, dy = bx - ax, by - ay
    length_squared = dx * dx + dy * dy
    # Nothing branches, as where feet fall is hard to predict: a tenth of the time of a line. A
    # repeated vertex has no direction; its foot is a itself.
    divisor = length_squared if length_squared > 0.0 else 1.0
    foot = ((px - ax) * dx + (py - ay) * dy) / divisor
    share = max(first, min(last, foot))
    kind = kind_last if foot >= last else FOOT
    return share, kind_first if foot <= first else kind


@njit()
def box_tree(x: Floats, y: Floats) -> Floats:
    """Boxes (x low, y low, x high, y high) of the nodes over the segments of a chain; O(n)."""
    m = x.size - 1
    leaves = 1
    while leaves * LEAF < m:
        leaves *= 2
    boxes = np.empty((2 * leaves, 4))
    for i in range(leaves):
        node = leaves + i
        boxes[node, 0] = boxes[node, 1] = np.inf
        boxes[node, 2] = boxes[node, 3] = -np.inf
        if i * LEAF >= m:
            continue
        for v in range(i * LEAF, min((i + 1) * LEAF, m) + 1):
            boxes[node, 0], boxes[node, 1] = min(boxes[node, 0], x[v]), min(boxes[node, 1], y[v])
            boxes[node, 2], boxes[node, 3] = max(boxes[node, 2], x[v]), max(boxes[node, 3], y[v])
    for node in range(leaves - 1, 0, -1):
        for k in range(2):
            boxes[node, k] = min(boxes[2 * node, k], boxes[2 * node + 1, k])
            boxes[node, k + 2] = max(boxes[2 * node, k + 2], boxes[2 * node + 1, k + 2])
    return boxes


@njit(inline=True, borrows=True)
def squared_distance_to_box(px: float, py: float, boxes: Floats, node: int) -> float:
    """Squared distance from p to a node's box, inf for an empty one."""
    dx = max(boxes[node, 0] - px, px - boxes[node, 2], 0.0)
    dy = max(boxes[node, 1] - py, py - boxes[node, 3], 0.0)
    return dx * dx + dy * dy


@njit(inline=True, borrows=True)
def nearest_on_chain(
    px: float,
    py: float,
    x: Floats,
    y: Floats,
    arc: Floats,
    boxes: Floats,
    low: float,
    high: float,
    reach: float,
    slack: float,
    stack: Ints,
) -> tuple[int, float, int, float, bool]:
    """Return the nearest point on the segments of a chain.

    Its segment (-1 if there is none within ``reach``), the share of it, its kind, its squared
    distance, and whether another point is nearly as near: by ``slack`` (a length) or less.
    Points outside the arc lengths low..high do not count. O(log n) near the chain.
    """
    m = x.size - 1
    leaves = boxes.shape[0] // 2
    bound, nearest, second = reach * reach, np.inf, np.inf
    at_nearest, segment, along, what = np.inf, -1, 0.0, FOOT
    depth = 1
    stack[0] = 1
    while depth > 0:
        depth -= 1
        node = place(stack[place(depth)])
        if squared_distance_to_box(px, py, boxes, node) > bound:
            continue
        if node < leaves:
            left = squared_distance_to_box(px, py, boxes, 2 * node)
            right = squared_distance_to_box(px, py, boxes, 2 * node + 1)
            nearer = 2 * node if left <= right else 2 * node + 1
            stack[place(depth)], stack[place(depth + 1)] = 4 * node + 1 - nearer, nearer
            depth += 2
            continue
        start = (node - leaves) * LEAF
        for i in range(start, min(start + LEAF, m)):
            j = place(i)
            first, last, kind_first, kind_last = 0.0, 1.0, VERTEX, VERTEX
            if low > arc[j]:
                first, kind_first = (low - arc[j]) / (arc[j + 1] - arc[j]), LIMIT
            if high < arc[j + 1]:
                last, kind_last = (high - arc[j]) / (arc[j + 1] - arc[j]), LIMIT
            share, kind = nearest_share(
                px, py, x[j], y[j], x[j + 1], y[j + 1], first, last, kind_first, kind_last
            )
            if np.isnan(share):
                continue
            dx = x[j] + share * (x[j + 1] - x[j]) - px
            dy = y[j] + share * (y[j + 1] - y[j]) - py
            d = dx * dx + dy * dy
            if d > bound:
                continue
            bound = min(bound, (np.sqrt(d) + slack) ** 2)
            # A vertex ends one segment and starts the next, but is one point, up to rounding.
            at = arc[j] + share * (arc[j + 1] - arc[j])
            is_same = abs(at - at_nearest) <= slack
            if d < nearest:
                second = second if is_same else min(second, nearest)
                nearest, at_nearest, segment, along, what = d, at, j, share, kind
            elif not is_same:
                second = min(second, d)
    return segment, along, what, nearest, second <= (np.sqrt(nearest) + slack) ** 2
