r"""The wavefront: the boundary of an area on its way inside, and when its triangles collapse.

Every edge moves inside at speed 1, so at time t the supporting lines of all edges have moved by t.
A vertex lies on the lines of the edge before it and of the edge after it; it moves on their
bisector. Triangles between the vertices move along; each has up to three sides that are edges of
the wavefront, the others are *spokes*.

n, reach    unit normal of an edge to the inside; the line n . p = reach + t
d           direction of an edge, the area on its left
tau         tan(turn / 2) where an edge turns into the next one; a vertex moves with n + tau d along
            the edge that it starts and with n - tau d along the one that it ends

       ^ n
       |          Of an edge from a to b the length changes by -(tau_a + tau_b) in a unit of time.
  a----+---> b
         d

A vertex between edges that face each other has no speed: it *rushes* along the shorter of the two
in no time. So does one that has turned too far, which happens where edges of no length go one
after the other. To rounding edges face each other that are parallel in a file: far from the origin
the last digits of coordinates turn an edge by 1e-12 and more, and a vertex that fast, 1e12, would
be anywhere.

Sources: O. Aichholzer, F. Aurenhammer, Straight Skeletons for General Polygonal Figures in the
Plane, 1996 (triangles); P. Palfrader, M. Held, S. Huber, On Computing Straight Skeletons by Means
of Kinetic Triangulations, 2012 (their events, and what becomes of them in plain arithmetic).
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.triangulation import next_side, previous_side
from midrib.types import Floats, Ints

__all__ = [
    "APART",
    "EDGE",
    "FLIP",
    "NEAR",
    "SPLIT",
    "Wavefront",
    "edge_length",
    "place",
    "schedule",
    "set_motion",
]

EDGE, SPLIT, FLIP = 0, 1, 2  # an edge has no length; a vertex meets an edge; or meets a spoke
NEAR = 2.0**-40  # of the extent, which is 1: what is as near as this is together
FACING = 2.0**-30  # radians; edges that face each other meet all along, but for rounding
POINT = 2.0**-26  # of the extent: what shrinks to a point is off by as much, a double root of 1e-16
ROUNDING = 2.0**-51  # of the product of two sides: so far rounding puts an area off
APART = 2.0**-20  # radians; edges turned by less say nothing about where they meet
NO, BACK, ON = 0, 1, 2  # which edge a vertex rushes along: none, the one before it, the one after
AT_ONCE = -1.0


class Wavefront(NamedTuple):
    """Edges, vertices, triangles and their queue; the extent of the area is 1."""

    nx: Floats  # of each edge
    ny: Floats
    reach: Floats
    x: Floats  # of each vertex: where it was born,
    y: Floats
    birth: Floats  # when,
    node: Ints  # as which node of the skeleton,
    u: Floats  # its speed,
    v: Floats
    tau: Floats
    before: Ints  # the edge that ends in it and the one that starts
    after: Ints
    turn: Floats  # how far it turns to the left
    rush: Ints
    tri: Ints  # of each half-edge: the vertex that it leaves,
    twin: Ints
    edge: Ints  # the edge that it is a piece of, or FREE
    key: Floats  # of each triangle: when it collapses,
    side: Ints  # the half-edge at fault,
    kind: Ints
    winner: Ints  # a tree of matches between triangles: the earlier one goes on


@njit(borrows=True)
def place(w: Wavefront, a: int, t: float) -> tuple[float, float]:
    """Where a vertex is at time t."""
    age = t - w.birth[a]
    return w.x[a] + age * w.u[a], w.y[a] + age * w.v[a]


@njit(borrows=True)
def set_motion(w: Wavefront, a: int, about: float) -> None:
    """Set the speed of a vertex between its two edges, and move it onto both lines exactly.

    It turns by what its edges say, and by as many whole turns as bring that next to ``about``.
    What their lines have in common is the sum of their normals along the bisector and the
    difference across; either is left alone where it is next to nothing.
    """
    f, g = w.before[a], w.after[a]
    sine = w.nx[f] * w.ny[g] - w.ny[f] * w.nx[g]
    cosine = w.nx[f] * w.nx[g] + w.ny[f] * w.ny[g]
    turn = np.arctan2(sine, cosine)
    w.turn[a] = turn + 2.0 * np.pi * np.rint((about - turn) / (2.0 * np.pi))
    w.rush[a] = NO
    w.u[a] = w.v[a] = w.tau[a] = 0.0
    if w.turn[a] >= np.pi - FACING:
        w.rush[a] = ON  # to be decided once its edges are there
        return
    w.tau[a] = sine / (1.0 + cosine) if cosine > 0.0 else (1.0 - cosine) / sine
    w.u[a], w.v[a] = w.nx[f] - w.tau[a] * w.ny[f], w.ny[f] + w.tau[a] * w.nx[f]
    reach_f, reach_g = w.reach[f] + w.birth[a], w.reach[g] + w.birth[a]
    for sign in (1.0, -1.0):
        mx, my = w.nx[f] + sign * w.nx[g], w.ny[f] + sign * w.ny[g]
        squared = mx * mx + my * my
        if squared > APART * APART:
            miss = (reach_f + sign * reach_g - mx * w.x[a] - my * w.y[a]) / squared
            w.x[a] += miss * mx
            w.y[a] += miss * my


@njit(borrows=True)
def edge_length(w: Wavefront, e: int, t: float) -> float:
    """Length of the piece of an edge on half-edge e at time t; negative if it is turned round."""
    k = w.edge[e]
    ax, ay = place(w, w.tri[e], t)
    bx, by = place(w, w.tri[next_side(e)], t)
    return (bx - ax) * w.ny[k] - (by - ay) * w.nx[k]


@njit(borrows=True)
def edge_collapse(w: Wavefront, e: int, now: float) -> float:
    """When the piece of an edge on half-edge e has no length; inf if it keeps some.

    Where reflex vertices meet head-on, an edge without length may come to lie between two edges on
    one line. It neither shrinks nor grows, and goes at once.
    """
    a, b = w.tri[e], w.tri[next_side(e)]
    if w.rush[a] == ON or w.rush[b] == BACK:
        return AT_ONCE
    rate, size = w.tau[a] + w.tau[b], edge_length(w, e, now)
    speeds = 1.0 + abs(w.tau[a]) + abs(w.tau[b])
    if abs(rate) <= NEAR * speeds and size <= NEAR * speeds:
        return now
    return now + max(size, 0.0) / rate if rate > 0.0 else np.inf


@njit(borrows=True)
def higher_spoke(w: Wavefront, e: int, now: float) -> int:
    """Side next to the edge on half-edge e beyond which the area reaches farther inside."""
    k, best, highest = w.edge[e], -1, -np.inf
    for side in (next_side(e), previous_side(e)):
        x, y = place(w, w.tri[previous_side(w.twin[side])], now)
        height = w.nx[k] * x + w.ny[k] * y
        if height > highest:
            best, highest = side, height
    return best


@njit(borrows=True)
def descent(w: Wavefront, a: int, k: int, now: float) -> tuple[float, float]:
    """How high a vertex is over the line of edge k, and by how much less in a unit of time."""
    x, y = place(w, a, now)
    height = w.nx[k] * x + w.ny[k] * y - w.reach[k] - now
    return height, 1.0 - w.nx[k] * w.u[a] - w.ny[k] * w.v[a]


@njit(borrows=True)
def meeting(w: Wavefront, e: int, now: float) -> tuple[float, int, int]:
    """When the vertex across from the edge on half-edge e meets its line, and what it meets.

    If the edge only begins to grow, its triangle may turn out to be on the wrong side: then a
    spoke is swapped at once.
    """
    k, c = w.edge[e], w.tri[previous_side(e)]
    height, rate = descent(w, c, k, now)
    tau = w.tau[w.tri[e]] + w.tau[w.tri[next_side(e)]]
    begins = tau < 0.0 and edge_length(w, e, now) <= NEAR * (1.0 - tau)
    if height < -NEAR and (begins or rate <= 0.0):
        return now, higher_spoke(w, e, now), FLIP
    if rate <= 0.0:
        return np.inf, e, SPLIT
    t = now + max(height, 0.0) / rate
    ax, ay = place(w, w.tri[e], t)
    bx, by = place(w, w.tri[next_side(e)], t)
    cx, cy = place(w, c, t)
    # A miss by rounding only is a hit: there is no wavefront beyond a corner to meet instead.
    if (cx - ax) * w.ny[k] - (cy - ay) * w.nx[k] < -NEAR:
        return t, next_side(e), FLIP
    if (bx - cx) * w.ny[k] - (by - cy) * w.nx[k] < -NEAR:
        return t, previous_side(e), FLIP
    return t, e, SPLIT


@njit(borrows=True)
def first_fall(a: float, b: float, c: float) -> float:
    """Smallest t >= 0 at which a t t + b t + c falls to 0, or is below and falls; inf if none."""
    if c <= 0.0 and b < 0.0:
        return 0.0
    root = b * b - 4.0 * a * c
    if root < 0.0:
        return np.inf
    q = -0.5 * (b - np.sqrt(root)) if b < 0.0 else -0.5 * (b + np.sqrt(root))
    # It falls where 2 a t + b = -sqrt(root): at q / a if b >= 0, else at c / q.
    if b < 0.0:
        return c / q
    return q / a if a < 0.0 else np.inf


@njit(borrows=True)
def longest_side(w: Wavefront, t: int, now: float) -> tuple[int, float, float]:
    """Longest side of triangle t, its length, and the height above it."""
    longest, side = -1.0, 3 * t
    ax, ay = place(w, w.tri[3 * t], now)
    bx, by = place(w, w.tri[3 * t + 1], now)
    cx, cy = place(w, w.tri[3 * t + 2], now)
    doubled = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    for e in range(3 * t, 3 * t + 3):
        size = length(bx - ax, by - ay)
        if size > longest:
            longest, side = size, e
        ax, ay, bx, by, cx, cy = bx, by, cx, cy, ax, ay
    return side, longest, doubled / longest if longest > 0.0 else 0.0


@njit(borrows=True)
def flattening(w: Wavefront, t: int, now: float) -> tuple[float, int, int]:
    """When a triangle of three spokes is flat, and its longest side then.

    One that shrinks to a point is flat at a double root only, before and after which it is not
    turned over: rounding tells neither when nor which side is longest, and swaps for its sake would
    not end. The edges around it go at that time, and it with them.
    """
    a, b, c = w.tri[3 * t], w.tri[3 * t + 1], w.tri[3 * t + 2]
    ax, ay = place(w, a, now)
    bx, by = place(w, b, now)
    cx, cy = place(w, c, now)
    px, py, qx, qy = bx - ax, by - ay, cx - ax, cy - ay
    pu, pv, qu, qv = w.u[b] - w.u[a], w.v[b] - w.v[a], w.u[c] - w.u[a], w.v[c] - w.v[a]
    slope = px * qv - py * qu + pu * qy - pv * qx
    curve, area = pu * qv - pv * qu, px * qy - py * qx
    at = first_fall(curve, slope, area)
    if at == np.inf:
        return at, 3 * t, FLIP
    side, longest, _ = longest_side(w, t, now + at)
    slack = NEAR * longest + ROUNDING * length(px, py) * length(qx, qy)
    if longest <= POINT and first_fall(curve, slope, area + slack) == np.inf:
        return np.inf, side, FLIP
    return now + at, side, FLIP


@njit(borrows=True)
def schedule(w: Wavefront, t: int, now: float) -> None:
    """Find out when triangle t collapses, and put it into the queue; O(log n)."""
    edges, w.key[t] = 0, np.inf
    for e in range(3 * t, 3 * t + 3):
        if w.twin[e] < 0:
            edges += 1
            at = edge_collapse(w, e, now)
            if at < w.key[t]:
                w.key[t], w.side[t], w.kind[t] = at, e, EDGE
    if edges < 2:
        at, side, kind = flattening(w, t, now)
        if edges == 1:
            e = 3 * t
            while w.twin[e] >= 0:
                e += 1
            at, side, kind = meeting(w, e, now)
        at += NEAR if kind == FLIP else 0.0  # what happens to the wavefront goes first
        if at < w.key[t]:
            w.key[t], w.side[t], w.kind[t] = at, side, kind
    requeue(w, t)


@njit(borrows=True)
def requeue(w: Wavefront, t: int) -> None:
    """Play the matches of triangle t again."""
    place_of = (w.winner.size // 2 + t) // 2
    while place_of > 0:
        one, other = w.winner[2 * place_of], w.winner[2 * place_of + 1]
        w.winner[place_of] = one if w.key[one] <= w.key[other] else other
        place_of //= 2
