"""The inside of rings whose segments all are edges already, as those of most areas are.

Banks are drawn with vertices that are nearer to each other than to the other bank: then each of
their segments is Delaunay by itself, and no table of segments is needed to tell the inside.

Where constraints kept edges from being flipped, it is seen to that those inside are Delaunay.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.places import place
from midrib.kernels.stars import FACE, across, before, should_flip
from midrib.types import Floats, Ints, Places

__all__ = ["Inside", "gather_inside"]

ROW = 3  # place in a triangle of its row among those kept
UNKNOWN, SEED = -1, -2  # rows of those that have none yet, and of those on a segment


class Inside(NamedTuple):
    """Half-edges of the triangles inside, see ``triangulate_rings``."""

    is_done: bool
    tri: Ints
    twin: Ints
    side_of_segment: Ints


@njit()
def gather_inside(
    count: int,
    ring_next: Ints,
    same: Ints,
    xy: Floats,
    is_constrained: bool,
    face: Places,
    by_rings: bool,
) -> Inside:
    """Keep the triangles that can be reached from the left of a segment without crossing one.

    They are numbered in order along the rings, or else as they came.
    Not done where a segment is no edge, where rings touch, or where they are not nested as those
    of a valid area: where the right of a segment or the rim would be kept. Nor, where constraints
    were used, if an edge should be flipped.
    """
    n, nothing = ring_next.size, np.empty(0, np.intp)
    no = Inside(False, nothing, nothing, nothing)
    follows, rings = np.full(n + 3, -1, np.int32), 0
    for k in range(n):
        if same[k] != k:
            return no
        follows[k] = ring_next[k]
        rings += ring_next[k] <= k
    most, stack = n + 2 * rings - 4, np.empty(count, np.int32)
    side_of_segment = np.empty(n, np.intp)
    if find_segments(count, follows, face, side_of_segment) != n or most < 1:
        return no
    seeds = seed_inside(count, most, face, stack, side_of_segment, by_rings)
    tri, twin = np.empty(3 * most, np.intp), np.empty(3 * most, np.intp)
    if seeds < 0 or not spread_inside(
        seeds, most, follows, xy, is_constrained, face, stack, tri, twin, n
    ):
        return no
    return Inside(True, tri, twin, side_of_segment)


@njit(borrows=True)
def find_segments(count: int, follows: Places, face: Places, side_of_segment: Ints) -> int:
    """Find the half-edges on segments, return how many there are; no triangle has a row yet."""
    size = 0
    for t in range(count):
        e = FACE * place(t)
        face[e + ROW] = UNKNOWN
        for side in range(3):
            a, b = place(face[e + side]), place(face[e + (side + 1 if side < 2 else 0)])
            if follows[a] == b:
                side_of_segment[a] = e + side
                size += 1
    return size


@njit(borrows=True)
def seed_inside(
    count: int, most: int, face: Places, stack: Places, side_of_segment: Ints, by_rings: bool
) -> int:
    """Put the triangles on the left of segments on the stack; how many, -1 if too many.

    In order along the rings whoever goes along them finds them side by side.
    """
    size = 0
    if not by_rings:
        for k in range(side_of_segment.size):
            face[(place(side_of_segment[k]) & -FACE) + ROW] = SEED
        for t in range(count):
            if face[FACE * place(t) + ROW] == SEED and size < most:
                face[FACE * place(t) + ROW] = size
                stack[place(size)] = t
                size += 1
    for k in range(side_of_segment.size):
        e = place(side_of_segment[k])
        first = e & -FACE
        if face[first + ROW] < 0:
            if size == most:
                return -1
            face[first + ROW] = size
            stack[place(size)] = first // FACE
            size += 1
        side_of_segment[k] = 3 * face[first + ROW] + (e & 3)
    return size


@njit(borrows=True)
def spread_inside(
    size: int,
    most: int,
    follows: Places,
    xy: Floats,
    is_constrained: bool,
    face: Places,
    stack: Places,
    tri: Ints,
    twin: Ints,
    n: int,
) -> bool:
    """Go on from the triangles on the stack; whether there are as many as there should be.

    By Euler's formula, of n vertices of a shell and h holes: n + 2 h - 2.
    """
    done = 0
    while done < size:
        e, new = FACE * place(stack[place(done)]), 3 * place(done)
        done += 1
        for side in range(3):
            a, b = place(face[e + side]), place(face[e + (side + 1 if side < 2 else 0)])
            f = across(e + side, face)
            tri[new + side] = a
            if follows[a] == b:
                twin[new + side] = -1
                continue
            if follows[b] == a or a >= n:
                return False
            if is_constrained and e < f:
                c, d = place(face[before(e + side)]), place(face[before(f)])
                if should_flip(
                    xy[2 * a], xy[2 * a + 1], xy[2 * b], xy[2 * b + 1],
                    xy[2 * c], xy[2 * c + 1], xy[2 * d], xy[2 * d + 1],
                ):  # fmt: skip
                    return False
            first = f & -FACE
            row = face[first + ROW]
            if row < 0:
                if size == most:
                    return False
                row = face[first + ROW] = size
                stack[place(size)] = first // FACE
                size += 1
            twin[new + side] = 3 * row + (f & 3)
    return size == most
