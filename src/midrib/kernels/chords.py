r"""Chords of a slope: straight lines inside it from top to toe, through points of its middle.

        top  (main curve)              C      pivot, a point of the middle line
    <---.------o--------.----          theta  direction of the chord at C, towards the toe
               :  chord                n      direction normal to the middle line
   .  .  .  .  C  .  .  middle         s, t   stations of the chord's ends on top and toe
               :
    <---.------o--------.----          The top runs with the area on its left; the toe runs
        toe  (auxiliary curve)         beside it, and so does the middle line.

A chord is found by walking from C through the triangles both ways, with exact signs, until a
boundary side is in the way: so it lies inside, and touches both edges.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.chain import Chain
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh, contains, is_beyond
from midrib.kernels.paths import walk
from midrib.kernels.predicates import orient
from midrib.kernels.triangulation import next_side
from midrib.types import Floats, Ints

__all__ = ["NOWHERE", "ON_TOE", "ON_TOP", "Chord", "Ground", "ground_of", "locate", "shoot"]

NOWHERE, ON_TOP, ON_TOE = 0, 1, 2
ROUNDING, STEPS_BACK = 2.0**-53, 12


class Ground(NamedTuple):
    """A slope to hatch: its mesh, and for each boundary side which edge it lies on, and where."""

    mesh: Mesh
    edge: Ints  # for each half-edge NOWHERE, ON_TOP or ON_TOE
    start: Floats  # for each half-edge the station of its start
    stop: Floats  # and of its end
    reach: float  # a ray of this length leaves the area


class Chord(NamedTuple):
    """A chord, its ends and what they lie on."""

    top_on: int
    toe_on: int
    s: float
    t: float
    top_x: float
    top_y: float
    toe_x: float
    toe_y: float
    width: float


@njit()
def ground_of(mesh: Mesh, top: Chain, toe: Chain) -> Ground:
    """Lay out a slope whose top runs with its sides; O(n)."""
    m = mesh.tri.size
    edge, start, stop = np.zeros(m, np.intp), np.empty(m), np.empty(m)
    for i in range(top.side.size):
        e = top.side[i]
        edge[e], start[e], stop[e] = ON_TOP, top.arc[i], top.arc[i + 1]
    for i in range(toe.side.size):
        e = toe.side[i]
        edge[e], start[e], stop[e] = ON_TOE, toe.arc[i + 1], toe.arc[i]
    x_low, x_high, y_low, y_high = np.inf, -np.inf, np.inf, -np.inf
    for v in range(mesh.x.size):
        x_low, x_high = min(x_low, mesh.x[v]), max(x_high, mesh.x[v])
        y_low, y_high = min(y_low, mesh.y[v]), max(y_high, mesh.y[v])
    return Ground(mesh, edge, start, stop, 2.0 * ((x_high - x_low) + (y_high - y_low)))


@njit(borrows=True)
def locate(mesh: Mesh, px: float, py: float) -> int:
    """Return a triangle that holds p, or the one that p, outside by rounding, is next to; O(n)."""
    best, least = 0, np.inf
    for t in range(mesh.tri.size // 3):
        if contains(mesh, t, px, py):
            return t
        off = 0.0
        for e in range(3 * t, 3 * t + 3):
            a, b = mesh.tri[e], mesh.tri[next_side(e)]
            dx, dy = mesh.x[b] - mesh.x[a], mesh.y[b] - mesh.y[a]
            off = max(off, (dy * (px - mesh.x[a]) - dx * (py - mesh.y[a])) / length(dx, dy))
        if off < least:
            best, least = t, off
    return best


@njit(borrows=True)
def ray(
    ground: Ground, t: int, px: float, py: float, ux: float, uy: float
) -> tuple[int, float, float, float]:
    """Return where the ray from p, in triangle t, along the unit vector u leaves the area.

    The edge, the station on it, and the point, which is inside.
    """
    mesh = ground.mesh
    qx, qy = px + ground.reach * ux, py + ground.reach * uy
    _, e = walk(mesh, t, -1, px, py, qx, qy)
    if e < 0:
        return NOWHERE, np.nan, px, py
    a, b = mesh.tri[e], mesh.tri[next_side(e)]
    at_a = orient(px, py, qx, qy, mesh.x[a], mesh.y[a])
    at_b = orient(px, py, qx, qy, mesh.x[b], mesh.y[b])
    share = min(max(at_a / (at_a - at_b), 0.0), 1.0) if at_a != at_b else 0.5
    x = mesh.x[a] + share * (mesh.x[b] - mesh.x[a])
    y = mesh.y[a] + share * (mesh.y[b] - mesh.y[a])
    # Rounding may have put the end beyond its side: back towards p by rounding's width.
    back = ROUNDING * (abs(x) + abs(y)) / max(length(px - x, py - y), ROUNDING * (abs(x) + abs(y)))
    for _ in range(STEPS_BACK):
        if not is_beyond(mesh, e, x, y):
            break
        x, y = x + back * (px - x), y + back * (py - y)
        back *= 2.0
    return ground.edge[e], ground.start[e] + share * (ground.stop[e] - ground.start[e]), x, y


@njit(borrows=True)
def shoot(ground: Ground, t: int, px: float, py: float, theta: float) -> Chord:
    """Return the chord through p, in triangle t, in a direction."""
    ux, uy = np.cos(theta), np.sin(theta)
    toe_on, toe_at, toe_x, toe_y = ray(ground, t, px, py, ux, uy)
    top_on, top_at, top_x, top_y = ray(ground, t, px, py, -ux, -uy)
    width = length(toe_x - top_x, toe_y - top_y)
    return Chord(top_on, toe_on, top_at, toe_at, top_x, top_y, toe_x, toe_y, width)
