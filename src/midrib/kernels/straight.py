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
from midrib.kernels.mesh import Mesh
from midrib.kernels.tables import with_rows
from midrib.kernels.traces import (
    ARCS,
    NODES,
    Traces,
    add_arc,
    add_node,
    add_vertex,
    end_vertex,
    wavefront_of,
)
from midrib.kernels.triangulation import flip, next_side, previous_side
from midrib.kernels.wavefront import (
    APART,
    BACK,
    EDGE,
    FACING,
    FLIP,
    NEAR,
    NO,
    ON,
    SPLIT,
    Wavefront,
    descent,
    edge_length,
    longest_side,
    place,
    requeue,
    schedule,
)
from midrib.types import Floats, Ints

__all__ = ["Roof", "straight_skeleton"]

LATE = 2.0**-24  # of the extent: about how long vertices of edges that nearly face each other take
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
def rush_end(w: Wavefront, a: int, fast: int, k: int, now: float) -> float:
    """When vertex a meets the line of edge k, which ``fast`` goes along to a.

    If it rushes along an edge that k faces, but for an angle, they meet here that much later than
    where it set out. If it is only as fast as that, or has turned too far where two fast ones met,
    ``now`` is as uncertain as its speed: by little, or else other lines meet here.
    """
    if w.rush[a] != NO or w.turn[fast] < np.pi - APART:
        return now
    height, rate = descent(w, a, k, now)
    late = height / rate if rate > 0.0 else 0.0
    is_facing = w.rush[fast] != NO and abs(w.turn[fast] - np.pi) <= FACING
    return now + late if is_facing or abs(late) <= LATE else now


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
    slow, fast, k = (a, b, w.after[b]) if is_slow else (b, a, w.before[a])
    t = rush_end(w, slow, fast, k, now)
    px, py = place(w, slow, t)
    node = add_node(s, px, py, t)
    end_vertex(w, s, a, node)
    end_vertex(w, s, b, node)
    if beyond < 0 and onward < 0:
        cx, cy = place(w, c, now)
        other = node
        if (
            w.rush[c] != NO and length(cx - px, cy - py) > NEAR
        ):  # two edges that face each other: a ridge
            other = add_node(s, cx, cy, w.birth[c])
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
    node, arc = with_rows(s.node[: s.used[NODES]], s.used[NODES]), s.arc[: s.used[ARCS]]
    return Roof(node, with_rows(arc, s.used[ARCS]), rings, flips, left == 0)
