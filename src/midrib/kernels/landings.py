r"""Landings: where a line that begins on a wall has come into the channel along it.

    main half ------m------------- auxiliary half of a cap, a wall where an island faces it
                    :
                    l....... trunk     m l is as long as l is far from the island
        ____________________
        |      island      |           here the island is main's

From the middle m of such a cap the line leads straight away to the landing l. There the trunk
begins, between the island and the other curve's half; the half behind it is no bank any more.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.banks import Banks, banks_of
from midrib.kernels.chain import Chain
from midrib.kernels.islands import Loops
from midrib.kernels.jit import njit
from midrib.kernels.leaning import lean_at
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.paths import Beads, walk
from midrib.types import Floats, Ints

__all__ = ["land", "take_off"]

HALVINGS = 48
ON_CAP = 2.0**-19  # of a piece of a cap: an end that is no farther from it than this is on it
ROUNDING = 2.0**-30  # of a radius
BEYOND = 2.0**-10  # of the way to a landing: as far on, the island is clearly nearer


class Landed(NamedTuple):
    """What is left to trace, and where the line begins and ends before that."""

    banks: Banks
    stop: Floats
    stop_at: Ints
    before: Floats  # (2, 2) the ends, NaN where the trunk leads to them


@njit()
def land(
    mesh: Mesh,
    main: Chain,
    auxiliary: Chain,
    banks: Banks,
    loops: Loops,
    beads: Beads,
    stop: Floats,
    stop_at: Ints,
    scale_x: float,
    scale_y: float,
) -> Landed:
    """Move the end beads on walls to their landings; the banks are those beyond them.

    Stops that are nearer to an end than its landing are left out.
    """
    before, last = np.full((2, 2), np.nan), beads.side.size - 1
    is_kept = np.ones(loops.wall_is_main.size, np.bool_)
    for k in range(loops.wall_is_main.size - 1):
        # The middle of a cap is where its pieces change sides.
        is_middle = loops.wall_cap[k] == loops.wall_cap[k + 1]
        if not is_middle or loops.wall_is_main[k] == loops.wall_is_main[k + 1]:
            continue
        x0, y0 = loops.wall[k, 2] * scale_x, loops.wall[k, 3] * scale_y
        ux, uy = x0 - loops.wall[k, 0] * scale_x, y0 - loops.wall[k, 1] * scale_y
        span = length(ux, uy)
        way = landing(banks, x0, y0, -uy / span, ux / span)
        x, y = x0 - way * uy / span, y0 + way * ux / span
        on = (1.0 + BEYOND) * way
        is_mains = lean_at(banks, x0 - on * uy / span, y0 + on * ux / span).value < 0.0
        for j in range(is_kept.size):
            if loops.wall_cap[j] == loops.wall_cap[k] and loops.wall_is_main[j] == is_mains:
                is_kept[j] = False
        for i in range(2):
            bead = i * last
            px, py = beads.point[bead, 0], beads.point[bead, 1]
            if length(px * scale_x - x0, py * scale_y - y0) > ON_CAP * span:
                continue
            x, y = x / scale_x, y / scale_y
            _, obstacle = walk(mesh, beads.side[bead] // 3, -1, px, py, x, y)
            if obstacle == -1:
                before[i, 0], before[i, 1] = px, py
                beads.point[bead, 0], beads.point[bead, 1] = x, y
                stop, stop_at = farther(stop, stop_at, i == 0, x, y, scale_x, scale_y)
            break
    walls = Loops(
        loops.side,
        loops.start,
        loops.is_main,
        loops.wall[is_kept],
        loops.wall_is_main[is_kept],
        loops.wall_cap[is_kept],
    )
    channel = banks_of(mesh, main, auxiliary, walls, banks.slack, scale_x, scale_y)
    return Landed(channel, stop, stop_at, before)


@njit(borrows=True)
def landing(banks: Banks, x: float, y: float, ux: float, uy: float) -> float:
    """How far along u from the middle of a cap something comes to be as near as the cap.

    That is the radius of the largest empty circle that touches the cap there.
    """
    low, high = 0.0, length(banks.main.x[0] - x, banks.main.y[0] - y)
    for _ in range(HALVINGS):
        if nearest(banks, x + high * ux, y + high * uy) < high * (1.0 - ROUNDING):
            break
        low, high = high, 2.0 * high
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        if nearest(banks, x + middle * ux, y + middle * uy) < middle * (1.0 - ROUNDING):
            high = middle
        else:
            low = middle
    return low


@njit(borrows=True)
def nearest(banks: Banks, x: float, y: float) -> float:
    """Distance to the nearer bank."""
    lean = lean_at(banks, x, y)
    return min(lean.to_main, lean.to_auxiliary)


@njit()
def farther(
    stop: Floats,
    stop_at: Ints,
    is_first: bool,
    x: float,
    y: float,
    scale_x: float,
    scale_y: float,
) -> tuple[Floats, Ints]:
    """Return stops with their first or last one moved to p, those nearer to where it was left out.

    At least the other end stays.
    """
    n = stop_at.size
    end, step = (0, 1) if is_first else (n - 1, -1)
    reach = length((x - stop[end, 0]) * scale_x, (y - stop[end, 1]) * scale_y)
    beyond = end + step
    for _ in range(n - 2):
        dx, dy = stop[beyond, 0] - stop[end, 0], stop[beyond, 1] - stop[end, 1]
        if length(dx * scale_x, dy * scale_y) >= reach:
            break
        beyond += step
    is_left = np.ones(n, np.bool_)
    for k in range(end + step, beyond, step):
        is_left[k] = False
    moved = stop.copy()
    moved[end, 0], moved[end, 1] = x, y
    return moved[is_left], stop_at[is_left]


@njit()
def take_off(path: Floats, source: Ints, beads: Beads, before: Floats) -> tuple[Floats, Ints]:
    """Return a path with the ends before its landings; its end beads are moved back there."""
    n, last = source.size, beads.side.size - 1
    is_before = ~np.isnan(before[:, 0])
    first = int(is_before[0])
    size = n + first + int(is_before[1])
    longer, longer_source = np.empty((size, 2)), np.empty(size, np.intp)
    for k in range(n):
        longer[first + k, 0], longer[first + k, 1] = path[k, 0], path[k, 1]
        longer_source[first + k] = source[k]
    for i in range(2):
        if is_before[i]:
            row, bead = i * (size - 1), i * last
            longer_source[row + (1 if i == 0 else -1)] = last + 1
            x, y = before[i, 0], before[i, 1]
            longer[row, 0], longer[row, 1], longer_source[row] = x, y, bead
            beads.point[bead, 0], beads.point[bead, 1] = x, y
    return longer, longer_source
