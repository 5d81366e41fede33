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

from midrib.kernels.clearance import nearest_on_segment
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.walls import Walls

__all__ = ["BETWEEN_CORNERS", "BETWEEN_WALLS", "PARABOLA", "Bisector", "bisector", "centre",
           "contact", "leaves", "meets_point", "meets_wall"]  # fmt: skip

BETWEEN_WALLS, BETWEEN_CORNERS, PARABOLA = 0, 1, 2
ALMOST_FLAT = 1e-7  # normals that differ less say nothing about the direction of their bisector
ROOT_STEPS = 100


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
def contact(w: Walls, site: int, x: float, y: float, radius: float) -> tuple[float, float]:
    """Vector from the centre of a disc to where it touches a site."""
    n = w.x.size
    if site < n:
        return w.uy[site] * radius, -w.ux[site] * radius
    return w.x[site - n] - x, w.y[site - n] - y


@njit(borrows=True)
def bisector(w: Walls, left: int, right: int, x: float, y: float, radius: float) -> Bisector:
    """Bisector of two sites, from the disc about (x, y) on."""
    n = w.x.size
    if left < n and right < n:
        return between_walls(w, left, right, x, y, radius)
    if left >= n and right >= n:
        p, q = left - n, right - n
        dx, dy = w.x[q] - w.x[p], w.y[q] - w.y[p]
        apart = length(dx, dy)
        ax, ay, dx, dy = (w.x[p] + w.x[q]) / 2.0, (w.y[p] + w.y[q]) / 2.0, -dy / apart, dx / apart
        t = (x - ax) * dx + (y - ay) * dy
        return Bisector(BETWEEN_CORNERS, ax, ay, dx, dy, apart / 2.0, 0.0, t)
    wall, point, g = (left, right - n, -1.0) if left < n else (right, left - n, 1.0)
    ux, uy = w.ux[wall], w.uy[wall]
    px, py = w.x[point] - w.x[wall], w.y[point] - w.y[wall]
    foot, c = px * ux + py * uy, py * ux - px * uy
    ax, ay, dx, dy = w.x[wall] + foot * ux, w.y[wall] + foot * uy, g * ux, g * uy
    return Bisector(PARABOLA, ax, ay, dx, dy, c, g, (x - ax) * dx + (y - ay) * dy)


@njit(borrows=True)
def between_walls(w: Walls, left: int, right: int, x: float, y: float, radius: float) -> Bisector:
    """Bisector of two walls; into a convex corner it leads to that very point."""
    if w.following[right] == left:
        dx, dy = w.x[left] - x, w.y[left] - y
        way = length(dx, dy)
        if way == 0.0:
            return Bisector(BETWEEN_WALLS, x, y, 0.0, 0.0, 0.0, 0.0, 0.0)
        return Bisector(BETWEEN_WALLS, x, y, dx / way, dy / way, radius, -radius / way, 0.0)
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
def leaves(w: Walls, b: Bisector, site: int, is_left: bool, farthest: float) -> float:
    """Return the t at which the contact runs off a site of the bisector."""
    n = w.x.size
    if site < n:
        end = site if is_left else site + 1
        t = (w.x[end] - b.ax) * b.dx + (w.y[end] - b.ay) * b.dy
        if b.kind == BETWEEN_WALLS:
            along = w.ux[site] * b.dx + w.uy[site] * b.dy
            t = (w.x[end] - b.ax) * w.ux[site] + (w.y[end] - b.ay) * w.uy[site]
            t = farthest if along == 0.0 else t / along
        return max(t, b.t)
    # The contact leaves a corner when the centre is on the normal of the wall beyond.
    beyond = w.preceding[site - n] if is_left else site - n
    nx, ny = -w.uy[beyond], w.ux[beyond]
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
def meets_point(b: Bisector, x: float, y: float, stop: float, depth: float) -> float:
    """Return the t before stop at which a disc is deepest over a point, inf if none is so deep."""
    px, py = x - b.ax, y - b.ay
    along = px * b.dx + py * b.dy
    if b.kind == BETWEEN_CORNERS:  # the discs of a pencil: what is in one is in the last one
        return np.inf
    if b.kind == BETWEEN_WALLS:
        lead, t = 1.0 - b.g * b.g, along + b.c * b.g
    else:
        lead, t = 1.0 - (b.dx * py - b.dy * px) * b.g / b.c, along
    if lead <= 0.0:
        return np.inf
    t /= lead
    if not b.t < t < stop:
        return np.inf
    cx, cy, radius = centre(b, t)
    return t if length(cx - x, cy - y) < radius - depth else np.inf


@njit(borrows=True)
def overlap(w: Walls, b: Bisector, wall: int, t: float) -> float:
    """How far a wall is outside the disc at t."""
    x, y, radius = centre(b, t)
    _, squared = nearest_on_segment(x, y, w.x[wall], w.y[wall], w.x[wall + 1], w.y[wall + 1])
    return np.sqrt(squared) - radius


@njit(borrows=True)
def meets_wall(w: Walls, b: Bisector, wall: int, stop: float, close: float) -> float:
    """Return the t at which the disc touches a wall that the disc at stop reaches over.

    Regula falsi, with the value of an end halved that stays (Illinois), and bisection where that
    is slow.
    """
    low, high = b.t, stop
    at_low, at_high = overlap(w, b, wall, low), overlap(w, b, wall, high)
    if at_low <= 0.0:
        return low
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
