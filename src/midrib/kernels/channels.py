r"""Channels: the open water between islands and curves, and the trunk through those left open.

Between two loops of the boundary (the two curves, with half a cap each, and every island) lies a
channel, as wide as the nearest points of the two are apart. Closing it makes the two one bank.
Closed one after the other, the narrowest first, but none that would dam the area, the channels
leave two banks and the widest way between them: no other way has a wider narrowest place
(Kruskal's forest with two roots).

    auxiliary -----------------------
                  |  closed
                 ___
        ........ \_/ ......
       .                   .. trunk
    main -----------------------

*Bridges* are closed channels as steps from one loop to another and back, from vertex to vertex: a
curve that takes them goes round each island, and comes back, on its way.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.banks import banks_of
from midrib.kernels.boxtree import DEPTH, box_tree
from midrib.kernels.chain import Chain
from midrib.kernels.clearance import nearest_of
from midrib.kernels.glide import ends_of
from midrib.kernels.heap import pop, push
from midrib.kernels.islands import AUXILIARY, MAIN, Loops, distance_to_side, loops_of, side_length
from midrib.kernels.jit import njit
from midrib.kernels.joining import Joined, cut_all_loops, string_beads
from midrib.kernels.landings import land, take_off
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.probes import apart_of
from midrib.kernels.tracing import trace
from midrib.kernels.triangulation import next_side
from midrib.kernels.trunk import SHARE_OF_SLACK
from midrib.kernels.ways import Stops, level_beads, shores_outside, stops_on_way
from midrib.types import Floats, Ints

__all__ = ["trace_wider", "with_islands"]

HALF = 0.5


class Shores(NamedTuple):
    """Loops of the boundary: 0 the main curve's, 1 the auxiliary curve's, then the islands."""

    loop: Ints  # of each mesh vertex
    n_loops: int
    islands: Loops  # sides of the islands
    first_island: int  # loops before it touch a curve


class Forest(NamedTuple):
    """Loops joined by closed channels."""

    root: Ints  # of each loop: after all, MAIN or AUXILIARY, or that of an island by itself
    bridge: Ints  # (b, 2) mesh vertices


@njit(entry=True)
def trace_wider(
    mesh: Mesh,
    main: Chain,
    auxiliary: Chain,
    points: Floats,
    at: Ints,
    end: Floats,
    end_origin: Floats,
    end_at: Ints,
    is_trimmed: bool,
    every_bead: bool,
    tolerance: float,
    scale_x: float,
    scale_y: float,
) -> Joined:
    """Trunk of an area through its widest channels; loops are cut.

    Parameters
    ----------
    mesh : the area
    main, auxiliary : the two banks
    points, at : radii, as ``draw_radii`` returns them
    end, end_origin, end_at : end points, as in ``join_middles``
    is_trimmed : whether the ends may lie farther in than the ends of the two banks
    every_bead : whether all points of radii are wanted on the trunk
    tolerance : how far (in lengths) a probe may be from the trunk
    scale_x, scale_y : lengths of one unit of x and of y

    Returns
    -------
    Joined
        As from ``trace_trunk``. O(n log n).
    """
    beads = string_beads(points, at, end, end_origin, end_at)
    first, n = end.shape[0] // 2, beads.side.size
    slack = SHARE_OF_SLACK * tolerance
    shores = shores_of(mesh, main, auxiliary, scale_x, scale_y)
    root = close_channels(mesh, main, auxiliary, shores, False, scale_x, scale_y).root
    islands = shores.islands
    for k in range(shores.first_island, islands.is_main.size):
        islands.is_main[k] = root[shores.loop[mesh.tri[islands.side[islands.start[k]]]]] == MAIN
    banks = banks_of(mesh, main, auxiliary, islands, slack, scale_x, scale_y)
    apart = apart_of(banks, tolerance)
    is_main = root[shores.loop] == MAIN
    near = np.zeros((n, 2), np.intp)
    level_beads(banks, beads, near, points, at, first, every_bead, scale_x, scale_y)
    ends = ends_of(banks, beads, near, end.shape[0] > 0, apart, scale_x, scale_y)
    stops = stops_on_way(mesh, main, banks, beads, near, is_main, is_trimmed, scale_x, scale_y)
    before = np.full((2, 2), np.nan)
    if islands.wall_is_main.size > 0:
        banks, point, stop_at, before = land(
            mesh, main, auxiliary, banks, islands, beads, stops.point, stops.at, scale_x, scale_y
        )
        stops = Stops(point, stop_at, np.zeros((stop_at.size, 2), np.intp))  # no windows here
        ends = ends_of(banks, beads, near, end.shape[0] > 0, apart, scale_x, scale_y)
    path, source = trace(mesh, banks, beads, stops, ends, tolerance, apart, scale_x, scale_y)
    path, source = take_off(path, source, beads, before)
    return cut_all_loops(mesh, beads, path, source, scale_x, scale_y)


@njit(entry=True)
def with_islands(
    mesh: Mesh, main: Chain, auxiliary: Chain, scale_x: float, scale_y: float
) -> Chain:
    """Return the auxiliary curve with a turn round each island on its way.

    Bridges have no side (-1) and no length. An island that faces the main curve only is met from
    the nearest vertex of the auxiliary curve.
    """
    shores = shores_of(mesh, main, auxiliary, scale_x, scale_y)
    forest = close_channels(mesh, main, auxiliary, shores, True, scale_x, scale_y)
    side, start = shores.islands.side, shores.islands.start
    size, n_islands = auxiliary.vertex.size, shores.islands.is_main.size
    bridge = np.empty((forest.bridge.shape[0] + n_islands, 2), np.intp)
    count = forest.bridge.shape[0]
    bridge[:count] = forest.bridge
    for k in range(n_islands):
        size += start[k + 1] - start[k] + 2
        v = mesh.tri[side[start[k]]]
        is_touching = k < shores.first_island
        if is_touching and not shores.islands.is_main[k]:
            bridge[count, 0] = bridge[count, 1] = v
            count += 1
        elif not is_touching and forest.root[shores.loop[v]] == shores.loop[v]:
            u = nearest_vertex(mesh, auxiliary, v, scale_x, scale_y)
            bridge[count, 0], bridge[count, 1] = u, v
            count += 1
    return along_bridges(mesh, auxiliary, shores, bridge[:count], size, scale_x, scale_y)


# -- loops and channels ----------------------------------------------------------------------------


@njit()
def shores_of(mesh: Mesh, main: Chain, auxiliary: Chain, scale_x: float, scale_y: float) -> Shores:
    """Return the loops of the boundary, numbered."""
    nowhere = np.empty((2, 2))
    for i in range(2):
        nowhere[i, 0], nowhere[i, 1] = mesh.x[main.vertex[0]], mesh.y[main.vertex[0]]
    islands = loops_of(mesh, main, auxiliary, nowhere, scale_x, scale_y)
    loop = shores_outside(mesh, main, auxiliary, scale_x, scale_y)
    number, first_island = AUXILIARY + 1, islands.is_main.size
    for k in range(islands.is_main.size):
        if loop[mesh.tri[islands.side[islands.start[k]]]] >= 0:
            continue
        first_island = min(first_island, k)
        for i in range(islands.start[k], islands.start[k + 1]):
            loop[mesh.tri[islands.side[i]]] = number
        number += 1
    return Shores(loop, number, islands, first_island)


@njit()
def close_channels(
    mesh: Mesh,
    main: Chain,
    auxiliary: Chain,
    shores: Shores,
    is_main_apart: bool,
    scale_x: float,
    scale_y: float,
) -> Forest:
    """Close channels, the narrowest first, but none that would join the two curves.

    With ``is_main_apart`` none that would join anything to the main curve.
    """
    loop, m, n = shores.loop, mesh.tri.size, shores.n_loops
    after, before = np.full(mesh.x.size, -1, np.intp), np.full(mesh.x.size, -1, np.intp)
    for e in range(m):
        if mesh.twin[e] < 0:
            after[mesh.tri[e]], before[mesh.tri[next_side(e)]] = e, e
    # 1. Loops that face each other across the mesh: from its sides' ends to the sides there.
    width, heap, size = np.full(m + 2 * n, np.inf), np.empty(m + 2 * n, np.intp), 0
    ends = np.empty((m + 2 * n, 2), np.intp)
    for e in range(m):
        u, v = mesh.tri[e], mesh.tri[next_side(e)]
        if mesh.twin[e] <= e or loop[u] == loop[v]:
            continue
        if is_main_apart and (loop[u] == MAIN or loop[v] == MAIN):
            continue
        ends[e, 0], ends[e, 1] = u, v
        for p, q in ((u, v), (v, u)):
            for f in (after[q], before[q]):
                off = distance_to_side(mesh, mesh.x[p], mesh.y[p], f, scale_x, scale_y)
                width[e] = min(width[e], off)
        size = push(heap, width, size, e)
    # 2. Islands and the two curves, whose sides may be long: the mesh may have others in between.
    for curve in (MAIN, AUXILIARY):
        if curve == MAIN and is_main_apart:
            continue
        chain = main if curve == MAIN else auxiliary
        x, y = mesh.x[chain.vertex] * scale_x, mesh.y[chain.vertex] * scale_y
        boxes, stack = box_tree(x, y), np.empty(DEPTH, np.intp)
        goes_on, j = np.ones(x.size, np.bool_), 0
        for e in shores.islands.side:
            v = mesh.tri[e]
            if loop[v] <= AUXILIARY:
                continue
            px, py = mesh.x[v] * scale_x, mesh.y[v] * scale_y
            j, share, squared = nearest_of(px, py, x, y, goes_on, boxes, j, stack)
            k = m + 2 * loop[v] + curve
            if np.sqrt(squared) < width[k]:
                width[k], ends[k, 1] = np.sqrt(squared), v
                ends[k, 0] = chain.vertex[j if share <= HALF else j + 1]
        for k in range(m + curve, m + 2 * n, 2):
            if width[k] < np.inf:
                size = push(heap, width, size, k)
    # 3. Loops joined, as a forest whose roots are the curves wherever one is reached.
    root = np.arange(n)
    bridge, count = np.empty((n, 2), np.intp), 0
    while size > 0:
        k = pop(heap, width, size)
        size -= 1
        u, v = ends[k, 0], ends[k, 1]
        a, b = root_of(root, loop[u]), root_of(root, loop[v])
        if a == b or max(a, b) <= AUXILIARY:
            continue
        root[max(a, b)] = min(a, b)
        bridge[count, 0], bridge[count, 1] = u, v
        count += 1
    for k in range(n):
        root[k] = root_of(root, k)
    return Forest(root, bridge[:count])


@njit(borrows=True)
def root_of(root: Ints, k: int) -> int:
    """Root of the tree that loop k is in; the way there is halved."""
    while root[k] != k:
        root[k] = root[root[k]]
        k = root[k]
    return k


@njit(borrows=True)
def nearest_vertex(mesh: Mesh, chain: Chain, v: int, scale_x: float, scale_y: float) -> int:
    """Vertex of a curve nearest to a mesh vertex."""
    best, nearest = np.inf, chain.vertex[0]
    for u in chain.vertex:
        d = length((mesh.x[u] - mesh.x[v]) * scale_x, (mesh.y[u] - mesh.y[v]) * scale_y)
        if d < best:
            best, nearest = d, u
    return nearest


# -- bridges ---------------------------------------------------------------------------------------


@njit()
def along_bridges(
    mesh: Mesh,
    curve: Chain,
    shores: Shores,
    bridge: Ints,
    size: int,
    scale_x: float,
    scale_y: float,
) -> Chain:
    """Return a curve that crosses each bridge, goes round what is there, and comes back."""
    side, start = shores.islands.side, shores.islands.start
    is_forward = mesh.tri[curve.side[0]] == curve.vertex[0]
    place, island = np.full(mesh.x.size, -1, np.intp), np.full(mesh.x.size, -1, np.intp)
    for k in range(start.size - 1):
        for i in range(start[k], start[k + 1]):
            if island[mesh.tri[side[i]]] < 0:  # a hole may come by a vertex twice
                place[mesh.tri[side[i]]], island[mesh.tri[side[i]]] = i, k
    # Bridges from each vertex, as linked lists: bridge b is end 2 b and end 2 b + 1.
    head, beyond = np.full(mesh.x.size, -1, np.intp), np.full(2 * bridge.shape[0], -1, np.intp)
    is_used = np.zeros(bridge.shape[0], np.bool_)
    for end in range(2 * bridge.shape[0]):
        v = bridge[end // 2, end % 2]
        beyond[end], head[v] = head[v], end
    vertex, sides, arc = np.empty(size, np.intp), np.empty(size - 1, np.intp), np.zeros(size)
    home, at = np.empty(start.size, np.intp), np.empty((start.size, 3), np.intp)
    count = 0
    for i in range(curve.vertex.size):
        here, depth = curve.vertex[i], 0
        if i > 0:
            sides[count - 1] = curve.side[i - 1]
            arc[count] = arc[count - 1] + (curve.arc[i] - curve.arc[i - 1])
        vertex[count] = here
        count += 1
        while True:
            end = head[here]
            while end >= 0 and is_used[end // 2]:
                end = beyond[end]
            head[here] = end
            if end >= 0:
                # Across a bridge; at[depth]: place of the next side, sides done, sides there are.
                is_used[end // 2] = True
                home[depth], here = here, bridge[end // 2, 1 - end % 2]
                k = island[here]
                at[depth, 0], at[depth, 1], at[depth, 2] = place[here], 0, start[k + 1] - start[k]
                depth += 1
                step = -1
            elif depth == 0:
                break
            elif at[depth - 1, 1] < at[depth - 1, 2]:
                k, j = island[mesh.tri[side[at[depth - 1, 0]]]], at[depth - 1, 0]
                low, n = start[k], start[k + 1] - start[k]
                j = j if is_forward else low + (j - low - 1) % n
                step = side[j]
                here = mesh.tri[next_side(step)] if is_forward else mesh.tri[step]
                at[depth - 1, 0] = low + (j - low + 1) % n if is_forward else j
                at[depth - 1, 1] += 1
            else:
                depth -= 1
                here, step = home[depth], -1
            sides[count - 1], vertex[count] = step, here
            span = side_length(mesh, step, scale_x, scale_y) if step >= 0 else 0.0
            arc[count] = arc[count - 1] + span
            count += 1
    return Chain(vertex[:count], sides[: count - 1], arc[:count])
