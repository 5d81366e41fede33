"""Traces: the nodes and arcs that the vertices of a wavefront leave, from its start on."""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh, next_boundary_side
from midrib.kernels.triangulation import FREE, next_side, previous_side
from midrib.kernels.wavefront import Wavefront, set_motion
from midrib.types import Floats, Ints

__all__ = [
    "ARCS",
    "NODES",
    "Traces",
    "add_arc",
    "add_node",
    "add_vertex",
    "end_vertex",
    "wavefront_of",
]

VERTICES, NODES, ARCS = 0, 1, 2


class Traces(NamedTuple):
    """Nodes and arcs so far, and how many there are of vertices, nodes and arcs."""

    node: Floats
    arc: Ints
    used: Ints
    out: Ints  # what flips of a triangulation at rest want to remember


@njit(borrows=True)
def add_node(s: Traces, x: float, y: float, t: float) -> int:
    """Add a node."""
    k = s.used[NODES]
    s.node[k, 0], s.node[k, 1], s.node[k, 2] = x, y, t
    s.used[NODES] += 1
    return k


@njit(borrows=True)
def add_arc(s: Traces, start: int, end: int, left: int, right: int) -> None:
    """Add an arc."""
    k = s.used[ARCS]
    s.arc[k, 0], s.arc[k, 1], s.arc[k, 2], s.arc[k, 3] = start, end, left, right
    s.used[ARCS] += 1


@njit(borrows=True)
def end_vertex(w: Wavefront, s: Traces, a: int, node: int) -> None:
    """End the path of a vertex in a node."""
    add_arc(s, w.node[a], node, w.before[a], w.after[a])


@njit(borrows=True)
def add_vertex(w: Wavefront, s: Traces, node: int, before: int, after: int, about: float) -> int:
    """Add a vertex of the wavefront that is born in a node and turns by about so much."""
    a = s.used[VERTICES]
    s.used[VERTICES] += 1
    w.x[a], w.y[a], w.birth[a], w.node[a] = s.node[node, 0], s.node[node, 1], s.node[node, 2], node
    w.before[a], w.after[a] = before, after
    set_motion(w, a, about)
    return a


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
