r"""Straight skeleton: the paths of the vertices of a wavefront, by its collapsing triangles.

What happens when a triangle collapses:

EDGE    one of its edges has no length: its ends, and their neighbours, become one vertex
SPLIT   its vertex c meets its edge a-b: the wavefront falls into two, each with a vertex there
FLIP    a vertex meets a spoke: nothing happens to the wavefront; the spoke is swapped for another

      a-------e------->b          SPLIT: c, between f and g, becomes a vertex between f and e, on
        \     ^      /            b's side, and one between e and g, on a's side
          \   |    /
       <-g----c<-f--
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh, next_boundary_side
from midrib.kernels.tables import with_rows
from midrib.kernels.triangulation import FREE, flip, next_side, previous_side
from midrib.kernels.wavefront import (
    BACK,
    EDGE,
    FLIP,
    NEAR,
    NO,
    ON,
    SPLIT,
    Wavefront,
    edge_length,
    longest_side,
    place,
    requeue,
    schedule,
    set_motion,
)
from midrib.types import Floats, Ints

__all__ = ["Roof", "straight_skeleton"]

FLIPS = 64  # for each triangle; a handful is usual


class Roof(NamedTuple):
    """The straight skeleton as a roof: nodes as high as their time, and the arcs between faces.

    node   (n, 3) x, y and time; those of the boundary come first
    arc    (m, 4) its nodes, and the edges whose faces are on its left and right
    rings  number of rings of the boundary, as the inside sees them
    flips  how many spokes were swapped
    is_done  whether the wavefront is gone
    """

    node: Floats
    arc: Ints
    rings: int
    flips: int
    is_done: bool


class Traces(NamedTuple):
    """Nodes and arcs so far, and how many there are of vertices, nodes and arcs."""

    node: Floats
    arc: Ints
    count: Ints
    out: Ints  # what flips of a triangulation at rest want to remember


VERTICES, NODES, ARCS = 0, 1, 2


@njit(borrows=True)
def add_node(s: Traces, x: float, y: float, t: float) -> int:
    """Add a node."""
    k = s.count[NODES]
    s.node[k, 0], s.node[k, 1], s.node[k, 2] = x, y, t
    s.count[NODES] += 1
    return k


@njit(borrows=True)
def add_arc(s: Traces, start: int, end: int, left: int, right: int) -> None:
    """Add an arc."""
    k = s.count[ARCS]
    s.arc[k, 0], s.arc[k, 1], s.arc[k, 2], s.arc[k, 3] = start, end, left, right
    s.count[ARCS] += 1


@njit(borrows=True)
def end_vertex(w: Wavefront, s: Traces, a: int, node: int) -> None:
    """End the path of a vertex in a node."""
    add_arc(s, w.node[a], node, w.before[a], w.after[a])


@njit(borrows=True)
def add_vertex(
    w: Wavefront, s: Traces, node: int, before: int, after: int, about: float
) -> int:
    """Add a vertex of the wavefront that is born in a node and turns by about so much."""
    a = s.count[VERTICES]
    s.count[VERTICES] += 1
    w.x[a], w.y[a], w.birth[a], w.node[a] = s.node[node, 0], s.node[node, 1], s.node[node, 2], node
    w.before[a], w.after[a] = before, after
    set_motion(w, a, about)
    return a


@njit(borrows=True)
def settle(w: Wavefront, e: int, a: int, now: float) -> None:
    """Give all half-edges around the one end of e to vertex a, and schedule their triangles."""
    while w.twin[e] >= 0:
        e = next_side(w.twin[e])
    first = e
    while True:
        w.tri[e] = a
        last = previous_side(e)
        if w.twin[last] < 0:
            break
        e = w.twin[last]
    if w.rush[a] != NO:
        is_back = edge_length(w, last, now) < edge_length(w, first, now)
        w.rush[a] = BACK if is_back else ON
    e = first
    while True:
        schedule(w, e // 3, now)
        if w.twin[previous_side(e)] < 0:
            break
        e = w.twin[previous_side(e)]


@njit(borrows=True)
def close_edge(w: Wavefront, s: Traces, e: int, now: float) -> int:
    """Make one vertex of the two ends of an edge without length; return how many triangles go."""
    before, after = previous_side(e), next_side(e)
    a, b, c = w.tri[e], w.tri[after], w.tri[before]
    beyond, onward = w.twin[before], w.twin[after]
    w.key[e // 3] = np.inf
    requeue(w, e // 3)
    # Of a fast vertex time says little about where it is, of one that rushes nothing.
    is_slow = w.rush[a] == NO and (w.rush[b] != NO or abs(w.tau[a]) < abs(w.tau[b]))
    px, py = place(w, a if is_slow else b, now)
    node = add_node(s, px, py, now)
    end_vertex(w, s, a, node)
    end_vertex(w, s, b, node)
    if beyond < 0 and onward < 0:
        cx, cy = place(w, c, now)
        other = node
        if w.rush[c] != NO and length(cx - px, cy - py) > NEAR:  # two edges that face each other: a ridge
            other = add_node(s, cx, cy, now)
            add_arc(s, node, other, w.edge[before], w.edge[after])
        end_vertex(w, s, c, other)
        return 1
    v = add_vertex(w, s, node, w.before[a], w.after[b], w.turn[a] + w.turn[b])
    s.node[node, 0], s.node[node, 1] = w.x[v], w.y[v]
    if beyond < 0:
        w.twin[onward], w.edge[onward] = -1, w.edge[before]
    elif onward < 0:
        w.twin[beyond], w.edge[beyond] = -1, w.edge[after]
    else:
        w.twin[beyond], w.twin[onward] = onward, beyond
    settle(w, beyond if beyond >= 0 else next_side(onward), v, now)
    return 1


@njit(borrows=True)
def split_edge(w: Wavefront, s: Traces, e: int, now: float) -> int:
    """Let the vertex across from an edge split it; return how many triangles go."""
    c, k = w.tri[previous_side(e)], w.edge[e]
    to_a, to_b = w.twin[previous_side(e)], w.twin[next_side(e)]
    w.key[e // 3] = np.inf
    requeue(w, e // 3)
    cx, cy = place(w, c, now)
    node = add_node(s, cx, cy, now)
    end_vertex(w, s, c, node)
    w.twin[to_a] = w.twin[to_b] = -1
    w.edge[to_a] = w.edge[to_b] = k
    about = np.pi + w.turn[c] / 2.0  # the edge itself turns back: half a turn for either
    one = add_vertex(w, s, node, w.before[c], k, about)
    other = add_vertex(w, s, node, k, w.after[c], about)
    settle(w, to_b, one, now)
    settle(w, next_side(to_a), other, now)
    return 1


@njit(borrows=True)
def swap_spoke(w: Wavefront, s: Traces, e: int, now: float) -> None:
    """Swap the spoke on half-edge e, or a longer one of a neighbour that is flat as well.

    Of vertices that come to lie on one line the longest spoke goes first, and always for a shorter
    one: so swaps come to an end. A neighbour may have been flat all along.
    """
    _, longest, _ = longest_side(w, e // 3, now)
    for _ in range(w.tri.size):
        side, size, height = longest_side(w, w.twin[e] // 3, now)
        if size <= longest or height > NEAR or w.twin[side] < 0:
            break
        e, longest = side, size
    t, u = e // 3, w.twin[e] // 3
    flip(e, w.tri, w.twin, w.edge, s.out)
    schedule(w, t, now)
    schedule(w, u, now)


@njit()
def wavefront_of(mesh: Mesh) -> tuple[Wavefront, Traces, int]:
    """Wavefront at rest, its nodes, and how many rings it has.

    The edges are the boundary sides of the mesh, in order; each starts a vertex of its own, so a
    point that rings share is as many vertices as there are fans of triangles around it.
    """
    size = mesh.tri.size
    triangles = size // 3
    edge, count = np.full(size, FREE, np.intp), 0
    for e in range(size):
        if mesh.twin[e] < 0:
            edge[e] = count
            count += 1
    vertices, leaves = count + 2 * triangles, 1
    while leaves < triangles:
        leaves *= 2
    key, winner = np.full(leaves, np.inf), np.empty(2 * leaves, np.intp)
    winner[0] = 0
    for i in range(2 * leaves - 1, 0, -1):
        winner[i] = i - leaves if i >= leaves else winner[2 * i]
    w = Wavefront(
        np.empty(count), np.empty(count), np.empty(count),
        np.empty(vertices), np.empty(vertices), np.empty(vertices), np.empty(vertices, np.intp),
        np.empty(vertices), np.empty(vertices), np.empty(vertices), np.empty(vertices, np.intp),
        np.empty(vertices, np.intp), np.empty(vertices), np.empty(vertices, np.intp),
        np.empty(size, np.intp), mesh.twin.copy(), edge,
        key, np.zeros(leaves, np.intp), np.zeros(leaves, np.intp), winner,
    )  # fmt: skip
    s = Traces(
        np.empty((vertices, 3)), np.empty((vertices + triangles, 4), np.intp),
        np.zeros(3, np.intp), np.empty(vertices, np.intp),
    )  # fmt: skip
    for e in range(size):
        k = edge[e]
        if k >= 0:
            a, b = mesh.tri[e], mesh.tri[next_side(e)]
            dx, dy = mesh.x[b] - mesh.x[a], mesh.y[b] - mesh.y[a]
            run = length(dx, dy)
            w.nx[k], w.ny[k] = -dy / run, dx / run
            w.reach[k] = w.nx[k] * mesh.x[a] + w.ny[k] * mesh.y[a]
            add_node(s, mesh.x[a], mesh.y[a], 0.0)
    is_walked, rings = np.zeros(count, np.bool_), 0
    for first in range(size):
        if edge[first] < 0 or is_walked[edge[first]]:
            continue
        rings += 1
        e = first
        while not is_walked[edge[e]]:
            is_walked[edge[e]] = True
            after = next_boundary_side(mesh, e)
            w.before[edge[after]], w.after[edge[after]] = edge[e], edge[after]
            e = after
    for e in range(size):
        if edge[e] >= 0:
            add_vertex(w, s, edge[e], w.before[edge[e]], edge[e], 0.0)
    for first in range(size):
        e = first
        while edge[first] >= 0:
            w.tri[e] = edge[first]
            e = w.twin[previous_side(e)]
            if e < 0:
                break
    return w, s, rings


@njit(entry=True)
def straight_skeleton(mesh: Mesh) -> Roof:
    """Straight skeleton of a meshed area whose extent is 1 or so.

    Parameters
    ----------
    mesh : of the area, about the origin

    Returns
    -------
    Roof
        Arcs of no length are among its arcs where several things happen at once.

    Notes
    -----
    O(n log n) and O(log n) a swap. What rounding decides is the order of things that happen within
    rounding of each other; the result is to be checked: see ``roof``.
    """
    w, s, rings = wavefront_of(mesh)
    triangles = w.tri.size // 3
    now, left, flips = 0.0, triangles, 0
    for t in range(triangles):
        schedule(w, t, now)
    while left > 0 and flips < FLIPS * (triangles + 16):
        t = w.winner[1]
        if w.key[t] == np.inf:
            break
        now, e = max(now, w.key[t] - (NEAR if w.kind[t] == FLIP else 0.0)), w.side[t]
        if w.kind[t] == EDGE:
            left -= close_edge(w, s, e, now)
        elif w.kind[t] == SPLIT:
            left -= split_edge(w, s, e, now)
        else:
            swap_spoke(w, s, e, now)
            flips += 1
    node, arc = with_rows(s.node[: s.count[NODES]], s.count[NODES]), s.arc[: s.count[ARCS]]
    return Roof(node, with_rows(arc, s.count[ARCS]), rings, flips, left == 0)
