"""Nearest points of a chain in space, by a tree of boxes over its segments in order.

The tree is that of ``boxtree`` with a third dimension: leaf i holds the segments i LEAF to
(i + 1) LEAF - 1, the children of node k are 2 k and 2 k + 1, and node 1 is the root.

P         a point
Q         a point of the chain that is nearest to P; several where they tie
slack     by how much distances may differ and still tie: what rounding explains
"""

import numpy as np

from midrib.kernels.boxtree import DEPTH, LEAF
from midrib.kernels.chain import TIE_OF_COORDINATE, slack_of
from midrib.kernels.jit import njit
from midrib.types import Floats, Ints

__all__ = ["nearest_in_space"]

SPACE = 3


@njit(entry=True)
def nearest_in_space(points: Floats, chain: Floats, arc: Floats) -> tuple[Floats, Ints]:
    """Nearest points of a chain to each of some points, all of them where several are as near.

    Parameters
    ----------
    points : (n, 3) points P
    chain : (m + 1, 3) vertices of the chain, m > 0, no two in a row the same
    arc : (m + 1,) their arc lengths

    Returns
    -------
    found, index
        (k, 5) coordinates of Q, arc length of Q, distance, in order of P and then along the chain;
        (k,) which of the points each row is of.

    Notes
    -----
    O(m) for the tree, then O(log m) for a P near the chain, more where many segments tie.
    """
    boxes = space_tree(chain)
    stack = np.empty(DEPTH, np.intp)
    tie = TIE_OF_COORDINATE * max(np.abs(points).max(), np.abs(chain).max())
    n = points.shape[0]
    found, index, total = np.empty((n + 8, 5)), np.empty(n + 8, np.intp), 0
    for i in range(n):
        nearest = np.sqrt(nearest_squared(points[i], chain, boxes, stack))
        slack = slack_of(tie, nearest)
        rows = within(points[i], chain, arc, boxes, nearest + slack, stack)
        rows = one_of_each(rows[np.argsort(rows[:, 3])], slack)
        while total + rows.shape[0] > index.size:
            found = np.concatenate((found, np.empty_like(found)))
            index = np.concatenate((index, np.empty_like(index)))
        for k in range(rows.shape[0]):
            found[total], index[total] = rows[k], i
            total += 1
    return found[:total], index[:total]


@njit()
def space_tree(chain: Floats) -> Floats:
    """Boxes (x, y, z low, x, y, z high) of the nodes over the segments of a chain; O(m)."""
    m = chain.shape[0] - 1
    leaves = 1
    while leaves * LEAF < m:
        leaves *= 2
    boxes = np.empty((2 * leaves, 2 * SPACE))
    boxes[:, :SPACE] = np.inf
    boxes[:, SPACE:] = -np.inf
    for i in range(min(leaves, (m + LEAF - 1) // LEAF)):
        for v in range(i * LEAF, min((i + 1) * LEAF, m) + 1):
            for k in range(SPACE):
                boxes[leaves + i, k] = min(boxes[leaves + i, k], chain[v, k])
                boxes[leaves + i, k + SPACE] = max(boxes[leaves + i, k + SPACE], chain[v, k])
    for node in range(leaves - 1, 0, -1):
        for k in range(SPACE):
            boxes[node, k] = min(boxes[2 * node, k], boxes[2 * node + 1, k])
            boxes[node, k + SPACE] = max(boxes[2 * node, k + SPACE], boxes[2 * node + 1, k + SPACE])
    return boxes


@njit(inline=True, borrows=True)
def squared_distance_to_node(p: Floats, boxes: Floats, node: int) -> float:
    """Squared distance from p to a node's box, inf for an empty one."""
    total = 0.0
    for k in range(SPACE):
        d = max(boxes[node, k] - p[k], p[k] - boxes[node, k + SPACE], 0.0)
        total += d * d
    return total


@njit(inline=True, borrows=True)
def nearest_on_segment(p: Floats, chain: Floats, j: int) -> tuple[float, float]:
    """Share of segment j at which its nearest point to p lies, and its squared distance."""
    along, length_squared = 0.0, 0.0
    for k in range(SPACE):
        step = chain[j + 1, k] - chain[j, k]
        along += (p[k] - chain[j, k]) * step
        length_squared += step * step
    # So short a segment that its square is 0 has no direction; its nearest point is its start.
    share = min(max(along / length_squared, 0.0), 1.0) if length_squared > 0.0 else 0.0
    total = 0.0
    for k in range(SPACE):
        d = on_segment(chain, j, share, k) - p[k]
        total += d * d
    return share, total


@njit(inline=True, borrows=True)
def on_segment(chain: Floats, j: int, share: float, k: int) -> float:
    """Coordinate k of a point of segment j; exactly that of a vertex at its ends."""
    if share == 1.0:
        return chain[j + 1, k]
    return chain[j, k] + share * (chain[j + 1, k] - chain[j, k])


@njit(borrows=True)
def nearest_squared(p: Floats, chain: Floats, boxes: Floats, stack: Ints) -> float:
    """Squared distance from p to the nearest point of a chain, by descent into its tree."""
    m, leaves = chain.shape[0] - 1, boxes.shape[0] // 2
    nearest, depth = np.inf, 1
    stack[0] = 1
    while depth > 0:
        depth -= 1
        node = stack[depth]
        if squared_distance_to_node(p, boxes, node) >= nearest:
            continue
        if node < leaves:
            left = squared_distance_to_node(p, boxes, 2 * node)
            right = squared_distance_to_node(p, boxes, 2 * node + 1)
            nearer = 2 * node if left <= right else 2 * node + 1
            stack[depth], stack[depth + 1] = 4 * node + 1 - nearer, nearer
            depth += 2
            continue
        first = (node - leaves) * LEAF
        for j in range(first, min(first + LEAF, m)):
            _, squared = nearest_on_segment(p, chain, j)
            nearest = min(nearest, squared)
    return nearest


@njit()
def within(
    p: Floats, chain: Floats, arc: Floats, boxes: Floats, reach: float, stack: Ints
) -> Floats:
    """Nearest point of each segment that comes within reach of p; rows as in ``found``."""
    m, leaves = chain.shape[0] - 1, boxes.shape[0] // 2
    rows, count, depth = np.empty((4, 5)), 0, 1
    stack[0] = 1
    while depth > 0:
        depth -= 1
        node = stack[depth]
        if squared_distance_to_node(p, boxes, node) > reach * reach:
            continue
        if node < leaves:
            stack[depth], stack[depth + 1] = 2 * node, 2 * node + 1
            depth += 2
            continue
        first = (node - leaves) * LEAF
        for j in range(first, min(first + LEAF, m)):
            share, squared = nearest_on_segment(p, chain, j)
            if squared > reach * reach:
                continue
            if count == rows.shape[0]:
                rows = np.concatenate((rows, np.empty_like(rows)))
            for k in range(SPACE):
                rows[count, k] = on_segment(chain, j, share, k)
            rows[count, 3] = arc[j + 1] if share == 1.0 else arc[j] + share * (arc[j + 1] - arc[j])
            rows[count, 4] = np.sqrt(squared)
            count += 1
    return rows[:count]


@njit()
def one_of_each(rows: Floats, slack: float) -> Floats:
    """Rows without repeats: a vertex ends one segment and starts the next, but is one point.

    Of rows that follow each other by no more than slack along the chain the nearest one stays.
    """
    kept, count, last = np.empty_like(rows), 0, -np.inf
    for i in range(rows.shape[0]):
        if rows[i, 3] - last > slack:
            kept[count] = rows[i]
            count += 1
        elif rows[i, 4] < kept[count - 1, 4]:
            kept[count - 1] = rows[i]
        last = rows[i, 3]
    return kept[:count]
