"""Graphs of points and edges: the branches they are made of, and the shortest way through them.

A vertex with two edges is on its way; one with one edge is a tip, one with more a junction. A
*branch* leads from a tip or junction to the next one, or round.
"""

import numpy as np

from midrib.kernels.heap import pop, push
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.tables import with_places
from midrib.types import Bools, Floats, Ints

__all__ = ["branches_of", "shortest_way"]


@njit()
def edges_around(n: int, edges: Ints) -> tuple[Ints, Ints]:
    """Where the half-edges of each vertex start, and they: 2 k + i leaves vertex edges[k, i]."""
    start = np.zeros(n + 1, np.intp)
    for k in range(edges.shape[0]):
        start[edges[k, 0] + 1] += 1
        start[edges[k, 1] + 1] += 1
    for v in range(n):
        start[v + 1] += start[v]
    around, filled = np.empty(2 * edges.shape[0], np.intp), start.copy()
    for k in range(edges.shape[0]):
        for end in range(2):
            v = edges[k, end]
            around[filled[v]] = 2 * k + end
            filled[v] += 1
    return start, around


@njit(borrows=True)
def write_branch(
    edges: Ints, start: Ints, around: Ints, is_used: Bools, h: int, rows: Ints, count: int
) -> int:
    """Write the vertices of the branch that leaves by half-edge h; return how many there are."""
    first = edges[h // 2, h % 2]
    rows[count] = first
    count += 1
    for _ in range(edges.shape[0]):
        is_used[h // 2] = True
        v = edges[h // 2, 1 - h % 2]
        rows[count] = v
        count += 1
        if v == first or start[v + 1] - start[v] != 2:
            break
        other = around[start[v]]
        h = other if other // 2 != h // 2 else around[start[v] + 1]
    return count


@njit(entry=True)
def branches_of(n: int, edges: Ints) -> tuple[Ints, Ints]:
    """Branches of a graph of n vertices.

    Parameters
    ----------
    n : int
    edges : (m, 2) vertices

    Returns
    -------
    rows : vertices of the branches, one after the other
    offsets : (k + 1,) where the vertices of each branch start

    Notes
    -----
    Branches come in the order of their first vertices; those that go round without a junction
    come last. O(n + m).
    """
    m = edges.shape[0]
    start, around = edges_around(n, edges)
    is_used = np.zeros(m, np.bool_)
    rows, offsets = np.empty(2 * m, np.intp), np.zeros(m + 1, np.intp)
    count, branches = 0, 0
    for is_round in (False, True):
        for v in range(n):
            if (start[v + 1] - start[v] == 2) != is_round:
                continue
            for i in range(start[v], start[v + 1]):
                if not is_used[around[i] // 2]:
                    count = write_branch(edges, start, around, is_used, around[i], rows, count)
                    branches += 1
                    offsets[branches] = count
    return with_places(rows[:count], count), with_places(offsets[: branches + 1], branches + 1)


@njit(entry=True)
def shortest_way(
    points: Floats, edges: Ints, source: int, target: int, scale_x: float, scale_y: float
) -> Ints:
    """Shortest way through a graph.

    Parameters
    ----------
    points : (n, 2)
    edges : (m, 2) vertices
    source, target : the vertices to go from and to
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    ints
        Vertices from source to target; none if no way leads there. O(m log m), by Dijkstra.
    """
    n, m = points.shape[0], edges.shape[0]
    start, around = edges_around(n, edges)
    came_by, so_far = np.full(n, -1, np.intp), np.full(n, np.inf)
    key, heap, size = np.empty(2 * m), np.empty(2 * m, np.intp), 0
    v, so_far[source] = source, 0.0
    while v != target:
        for i in range(start[v], start[v + 1]):
            h = around[i]
            w = edges[h // 2, 1 - h % 2]
            step = length(
                (points[w, 0] - points[v, 0]) * scale_x, (points[w, 1] - points[v, 1]) * scale_y
            )
            if so_far[v] + step < so_far[w]:
                so_far[w], came_by[w], key[h] = so_far[v] + step, h, so_far[v] + step
                size = push(heap, key, size, h)
        if size == 0:
            return np.empty(0, np.intp)
        h = pop(heap, key, size)
        size -= 1
        v = edges[h // 2, 1 - h % 2]
    count = 1
    while v != source:
        v = edges[came_by[v] // 2, came_by[v] % 2]
        count += 1
    way, v = np.empty(count, np.intp), target
    for i in range(count - 1, -1, -1):
        way[i] = v
        if i > 0:
            v = edges[came_by[v] // 2, came_by[v] % 2]
    return way
