r"""Bisectors: where the centre of a disc goes that rolls on between two sites of a boundary.

A *site* is a wall, or the reflex corner where a wall starts: site n + k for wall k of n. Seen in
the direction of rolling, one site is on the left and one on the right. The disc touches both; its
contact runs backwards along the walls on the left, forwards along those on the right:

    left    ---------<--.     two walls     straight; the radius grows evenly
                 (    )  \    two corners   straight; the radius is a hyperbola's
    right   --------->-       wall, corner  a parabola

    straight     a + t d                          radius  c + t g        (two walls)
                                                  radius  sqrt(c^2 + t^2)  (two corners)
    parabola     a + t d + h n, h = (c^2 + t^2) / 2 c    radius  h

a is the foot of the corner on the wall, n the normal of the wall, c the corner's distance to it.
Each point is as far from either site as rounding allows, whatever t is.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.clearance import nearest_of, nearest_on_segment
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.walls import Walls

__all__ = [
    "BETWEEN_CORNERS",
    "BETWEEN_WALLS",
    "DEPTH",
    "MET_NOTHING",
    "PARABOLA",
    "Bisector",
    "bisector",
    "centre",
    "first_met",
    "leaves",
]

BETWEEN_WALLS, BETWEEN_CORNERS, PARABOLA = 0, 1, 2
ALMOST_FLAT = 1e-7  # normals that differ less say nothing about the direction of their bisector
ROOT_STEPS = 240  # a fourth of them halve: that comes to the last bit, however flat the root is
PROBES = 24  # for a disc that is off a wall which it touches before and after
DEPTH = 2.0**-48  # of the extent: what reaches less far into a disc only touches it
GAP = 2.0**-53  # of the extent: what rounding closes is taken to be as wide as this
CLOSE = 2.0**-50  # of the extent: discs this near to a wall touch it
TURNS = 64  # of the question what a disc meets
MET_NOTHING = -1


class Bisector(NamedTuple):
    """What the drawing shows, and the t of the disc that it was made for."""

    kind: int
    ax: float
    ay: float
    dx: float
    dy: float
    c: float
    g: float  # growth of the radius; for a parabola 1 or -1, so that n is (-g dy, g dx)
    t: float


@njit(inline=True, borrows=True)
def centre(b: Bisector, t: float) -> tuple[float, float, float]:
    """Centre and radius of the disc at t."""
    x, y = b.ax + t * b.dx, b.ay + t * b.dy
    if b.kind == BETWEEN_WALLS:
        return x, y, b.c + t * b.g
    if b.kind == BETWEEN_CORNERS:
        return x, y, np.sqrt(b.c * b.c + t * t)
    h = (b.c * b.c + t * t) / (2.0 * b.c)
    return x - b.g * b.dy * h, y + b.g * b.dx * h, h


@njit(borrows=True)
def bisector(w: Walls, left: int, right: int, x: float, y: float) -> Bisector:
    """Bisector of two sites, from the disc about (x, y) on."""
    n = w.x.size
    if left < n and right < n:
        return between_walls(w, left, right, x, y)
    if left >= n and right >= n:
        p, q = left - n, right - n
        dx, dy = w.x[q] - w.x[p], w.y[q] - w.y[p]
        apart = max(length(dx, dy), GAP * w.extent)
        ax, ay, dx, dy = (w.x[p] + w.x[q]) / 2.0, (w.y[p] + w.y[q]) / 2.0, -dy / apart, dx / apart
        t = (x - ax) * dx + (y - ay) * dy
        return Bisector(BETWEEN_CORNERS, ax, ay, dx, dy, apart / 2.0, 0.0, t)
    wall, point, g = (left, right - n, -1.0) if left < n else (right, left - n, 1.0)
    ux, uy = w.ux[wall], w.uy[wall]
    px, py = w.x[point] - w.x[wall], w.y[point] - w.y[wall]
    foot, c = px * ux + py * uy, max(py * ux - px * uy, GAP * w.extent)
    ax, ay, dx, dy = w.x[wall] + foot * ux, w.y[wall] + foot * uy, g * ux, g * uy
    return Bisector(PARABOLA, ax, ay, dx, dy, c, g, (x - ax) * dx + (y - ay) * dy)


@njit(borrows=True)
def between_walls(w: Walls, left: int, right: int, x: float, y: float) -> Bisector:
    """Bisector of two walls."""
    nx, ny, mx, my = -w.uy[left], w.ux[left], -w.uy[right], w.ux[right]
    sx, sy, dx, dy = nx + mx, ny + my, my - ny, nx - mx  # both along the bisector
    if nx * mx + ny * my > 0.0:  # the sum is the longer of the two, the difference has the sign
        ahead = sx * dx + sy * dy
        if dx * dx + dy * dy < ALMOST_FLAT * ALMOST_FLAT:
            ahead = 1.0 if w.following[left] == right else -1.0
        dx, dy = (sx, sy) if ahead > 0.0 else (-sx, -sy)
    size = length(dx, dy)
    dx, dy = dx / size, dy / size
    apart = (x - w.x[left]) * nx + (y - w.y[left]) * ny
    if nx * mx + ny * my < 0.0:  # put what rounding has moved back onto the bisector
        lean = apart - ((x - w.x[right]) * mx + (y - w.y[right]) * my)
        share = lean / ((nx - mx) * (nx - mx) + (ny - my) * (ny - my))
        x, y = x - share * (nx - mx), y - share * (ny - my)
        apart = (x - w.x[left]) * nx + (y - w.y[left]) * ny
    return Bisector(BETWEEN_WALLS, x, y, dx, dy, apart, nx * dx + ny * dy, 0.0)


@njit(borrows=True)
def leaves(w: Walls, b: Bisector, site: int, is_left: bool, limit: tuple[float, float],
           farthest: float) -> float:  # fmt: skip
    """Return the t at which the contact runs off a site.

    The limit of a wall is a point, that of a corner the normal that the centre is on then.
    """
    n = w.x.size
    if site < n:
        t = (limit[0] - b.ax) * b.dx + (limit[1] - b.ay) * b.dy
        if b.kind == BETWEEN_WALLS:
            along = w.ux[site] * b.dx + w.uy[site] * b.dy
            t = (limit[0] - b.ax) * w.ux[site] + (limit[1] - b.ay) * w.uy[site]
            t = farthest if along == 0.0 else t / along
        return max(t, b.t)
    nx, ny = limit
    if b.kind == BETWEEN_CORNERS:
        across = nx * b.dy - ny * b.dx  # a unit towards the right
        if not is_left:
            across = -across
        if across <= 0.0:
            return farthest
        return max(b.c / across * (nx * b.dx + ny * b.dy), b.t)
    fx, fy = nx + b.g * b.dy, ny - b.g * b.dx
    squared = fx * fx + fy * fy
    if squared == 0.0:
        return farthest
    t = 2.0 * b.c / squared * (nx * b.dx + ny * b.dy)
    if t < b.t:
        x, y, radius = centre(b, b.t)
        x, y = x - w.x[site - n], y - w.y[site - n]
        turned = (x * ny - y * nx) * (1.0 if is_left else -1.0)
        is_there = x * nx + y * ny > 0.0 and abs(turned) <= ALMOST_FLAT * radius
        return b.t if is_there else farthest
    return t


@njit(borrows=True)
def overlap(w: Walls, b: Bisector, wall: int, t: float) -> float:
    """How far a wall is outside the disc at t."""
    x, y, radius = centre(b, t)
    _, squared = nearest_on_segment(x, y, w.x[wall], w.y[wall], w.x[wall + 1], w.y[wall + 1])
    return np.sqrt(squared) - radius


@njit(borrows=True)
def off_wall(w: Walls, b: Bisector, wall: int, stop: float, close: float) -> float:
    """Return a t before stop at which the disc is off a wall, or that of the first disc."""
    share = 1.0
    for _ in range(PROBES):
        share /= 2.0
        t = b.t + share * (stop - b.t)
        if overlap(w, b, wall, t) > close:
            return t
    return b.t


@njit(borrows=True)
def meets_wall(w: Walls, b: Bisector, wall: int, stop: float, close: float) -> float:
    """Return the t at which the disc touches a wall that the disc at stop reaches over.

    The first disc may touch the wall as well, and get off it before it comes back to it. Regula
    falsi, with the value of an end halved that stays (Illinois), and bisection where that is slow.
    """
    low, high = b.t, stop
    at_low, at_high = overlap(w, b, wall, low), overlap(w, b, wall, high)
    if at_low <= close:
        low = off_wall(w, b, wall, stop, close)
        if low == b.t:
            return low
        at_low = overlap(w, b, wall, low)
    last = 0
    for step in range(ROOT_STEPS):
        t = (low * at_high - high * at_low) / (at_high - at_low)
        if step % 4 == 3 or not low < t < high:
            t = (low + high) / 2.0
        if not low < t < high:
            break
        value = overlap(w, b, wall, t)
        if abs(value) <= close:
            return t
        if value > 0.0:
            low, at_low = t, value
            at_high = at_high / 2.0 if last == 1 else at_high
            last = 1
        else:
            high, at_high = t, value
            at_low = at_low / 2.0 if last == -1 else at_low
            last = -1
    return low


@njit(borrows=True)
def first_met(w: Walls, b: Bisector, hint: int, stop: float) -> tuple[float, int]:
    """Return where the disc meets a third wall, and that wall; ``stop`` if it meets nothing.

    How far it can roll is asked of the disc at the end of its way: what reaches over that is met
    before, at the place where the disc touches it, and the question is asked again there.
    """
    met = MET_NOTHING
    for _ in range(TURNS):
        x, y, radius = centre(b, stop)
        wall, _, squared = nearest_of(x, y, w.x, w.y, w.is_wall, w.boxes, hint, w.stack)
        if np.sqrt(squared) >= radius - DEPTH * w.extent:
            break
        met, hint = wall, wall
        stop = meets_wall(w, b, wall, stop, CLOSE * w.extent)
        if stop <= b.t:
            break
    return stop, met
