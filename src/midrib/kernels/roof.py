r"""Roofs: the faces of a straight skeleton, and what makes one sound.

Every edge of an area carries one face, a plane that rises at 45 degrees; its nodes are as high as
they are far from the edge's line. The face runs from the edge's end b round to its start a:

        .---<---.          Seen along the edge it first goes on past b, if that is reflex, then
       /         \\         back to beyond a, and again to a: it turns round twice at most. Its
      /           \\        pieces are arcs with the face on their left.
     a------>------b

A skeleton is sound if every face is such a walk, every node lies as high over the lines of its
faces as its time says, and nodes and arcs are as many as Euler's formula asks for.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh
from midrib.kernels.straight import Roof
from midrib.kernels.tables import with_places, with_rows
from midrib.kernels.triangulation import next_side
from midrib.kernels.wavefront import NEAR
from midrib.types import Ints

__all__ = ["SLACK", "Faces", "faces_of", "ridges_of"]

SLACK = 1e-9  # of the extent, which is 1: by so much a sound skeleton may be off
ALONG = 1e-6  # along an edge: a node between faces that nearly meet flat is not known better
SAME = 16.0 * NEAR  # radians: edges that turn by no more are one
TURNS = 2


class Faces(NamedTuple):
    """The nodes round each face, from the end of its edge to its start.

    nodes, offsets  one walk a face
    miss            how far a node is off the plane of a face, at most
    is_sound        whether all of the above holds
    """

    nodes: Ints
    offsets: Ints
    miss: float
    is_sound: bool


@njit()
def half_arcs_of(roof: Roof, faces: int) -> tuple[Ints, Ints]:
    """Half-arcs by the face on their left; 2 k runs along arc k, 2 k + 1 against it."""
    start = np.zeros(faces + 1, np.intp)
    for k in range(roof.arc.shape[0]):
        start[roof.arc[k, 2] + 1] += 1
        start[roof.arc[k, 3] + 1] += 1
    for face in range(faces):
        start[face + 1] += start[face]
    place, half = start.copy(), np.empty(2 * roof.arc.shape[0], np.intp)
    for h in range(half.size):
        face = roof.arc[h // 2, 2 + h % 2]
        half[place[face]] = h
        place[face] += 1
    return start, half


@njit(entry=True)
def faces_of(mesh: Mesh, roof: Roof) -> Faces:
    """Walk round every face of a skeleton, and find out whether it is sound; O(n)."""
    node, arc = roof.node, roof.arc
    faces = int(np.count_nonzero(mesh.twin < 0))
    start, half = half_arcs_of(roof, faces)
    nodes, offsets, count = np.empty(half.size + faces, np.intp), np.zeros(faces + 1, np.intp), 0
    leaving, face, miss = np.full(node.shape[0], -1, np.intp), -1, 0.0
    is_sound = roof.is_done and node.shape[0] - arc.shape[0] == 2 - roof.rings
    for e in range(mesh.twin.size):
        if mesh.twin[e] >= 0:
            continue
        face += 1
        a, b = mesh.tri[e], mesh.tri[next_side(e)]
        dx, dy = mesh.x[b] - mesh.x[a], mesh.y[b] - mesh.y[a]
        run = np.sqrt(dx * dx + dy * dy)
        dx, dy = dx / run, dy / run
        at = -1
        for i in range(start[face], start[face + 1]):
            h = half[i]
            leaving[arc[h // 2, h % 2]] = h
            if h % 2 == 0 and arc[h // 2, 0] < faces:
                at = arc[h // 2, 0]
        turns, heading, along = 0, 1, 0.0
        for i in range(start[face], start[face + 1] + 1):
            if at < 0:
                break
            nodes[count] = at
            count += 1
            x, y, t = node[at, 0] - mesh.x[a], node[at, 1] - mesh.y[a], node[at, 2]
            miss = max(miss, abs(dx * y - dy * x - t))
            forth = dx * x + dy * y
            if i > start[face] and abs(forth - along) > ALONG:
                turn = 1 if forth > along else -1
                turns += 1 if turn != heading else 0
                heading = turn
            if i == start[face] or abs(forth - along) > ALONG:
                along = forth
            h, leaving[at] = leaving[at], -1
            at = arc[h // 2, 1 - h % 2] if h >= 0 else -1
        is_whole = count - offsets[face] == start[face + 1] - start[face] + 1
        is_sound = is_sound and is_whole and nodes[count - 1] == face and turns <= TURNS
        offsets[face + 1] = count
    return Faces(with_places(nodes[:count], count), offsets, miss, is_sound and miss <= SLACK)


@njit(borrows=True)
def first_of(chief: Ints, i: int) -> int:
    """Node that stands for node i."""
    while chief[i] != i:
        chief[i] = chief[chief[i]]
        i = chief[i]
    return i


@njit(entry=True)
def ridges_of(mesh: Mesh, roof: Roof) -> Ints:
    """Arcs that are seen, as rows of nodes: those of no length go, their nodes become one.

    Where edges turn by little, what happens at one time happens by rounding as far apart as that
    time is from certain; so no length is what is within the slack of a sound skeleton.

    So do arcs from vertices in the middle of straight edges: their two faces are one plane.
    """
    node, arc = roof.node, roof.arc
    faces = int(np.count_nonzero(mesh.twin < 0))
    nx, ny, face = np.empty(faces), np.empty(faces), 0
    for e in range(mesh.twin.size):
        if mesh.twin[e] < 0:
            a, b = mesh.tri[e], mesh.tri[next_side(e)]
            dx, dy = mesh.x[b] - mesh.x[a], mesh.y[b] - mesh.y[a]
            run = np.sqrt(dx * dx + dy * dy)
            nx[face], ny[face] = -dy / run, dx / run
            face += 1
    chief = np.arange(node.shape[0])
    for k in range(arc.shape[0]):
        i, j = arc[k, 0], arc[k, 1]
        if abs(node[i, 0] - node[j, 0]) + abs(node[i, 1] - node[j, 1]) <= SLACK and i >= faces:
            chief[first_of(chief, max(i, j))] = first_of(chief, min(i, j))
    ridges, count = np.empty((arc.shape[0], 2), np.intp), 0
    for k in range(arc.shape[0]):
        i, j, f, g = first_of(chief, arc[k, 0]), first_of(chief, arc[k, 1]), arc[k, 2], arc[k, 3]
        is_straight = (
            abs(nx[f] * ny[g] - ny[f] * nx[g]) <= SAME and nx[f] * nx[g] + ny[f] * ny[g] > 0.0
        )
        if i == j or (arc[k, 0] < faces and is_straight):
            continue
        ridges[count, 0], ridges[count, 1] = i, j
        count += 1
    return with_rows(ridges[:count], count)
