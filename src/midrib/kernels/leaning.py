r"""Level points: how much nearer a point is to the one bank than to the other, and the way to none.

x       point inside the area
m, a    nearest points to x of the main and of the auxiliary bank
lean    |xm| - |xa|: negative nearer to the main bank, zero in the middle

    auxiliary  -----a-----------
                    |
                    x               lean < 0: x moves towards a, at most as far as m is, and so
                    m\              neither leaves the area nor passes through a wall
    main       -------\---------
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.banks import Bank, Banks
from midrib.kernels.clearance import nearest_in_run, nearest_of
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.types import Ints

__all__ = [
    "LEVEL",
    "Lean",
    "is_level",
    "is_straight",
    "lean_at",
    "level_between",
    "level_from",
    "level_where_straight",
    "way_from_nearer",
    "way_to_level",
]

LEVEL = 2.0**-42  # of the width: less lean than this is rounding
ROUNDS = 64  # bisection alone needs 53
STEPS = 24
SAFE = 0.875  # of the distance to the nearer bank
AT_WALL = 2.0**-20  # of the distance to the farther one: a point that is as near is on a wall
FEW = 24  # segments are looked through one by one; more are searched by their boxes
PARALLEL = 2.0**-26  # sine of an angle: level lines that meet at less go on straight


class Lean(NamedTuple):
    """How far a point is from both banks, and the nearest points."""

    value: float  # to_main - to_auxiliary
    to_main: float
    to_auxiliary: float
    main_x: float
    main_y: float
    auxiliary_x: float
    auxiliary_y: float


@njit(inline=True, borrows=True)
def nearest_on_bank(
    bank: Bank, x: float, y: float, hint: int, first: int, stop: int, stack: Ints
) -> tuple[int, float, float, float]:
    """Nearest point of a bank: segment, distance, x and y."""
    if stop - first <= FEW:
        j, share, squared = nearest_in_run(x, y, bank.x, bank.y, first, stop)
    else:
        j, share, squared = nearest_of(x, y, bank.x, bank.y, bank.goes_on, bank.boxes, hint, stack)
    qx = bank.x[j] + share * (bank.x[j + 1] - bank.x[j])
    qy = bank.y[j] + share * (bank.y[j + 1] - bank.y[j])
    return j, np.sqrt(squared), qx, qy


@njit(inline=True, borrows=True)
def lean_at(banks: Banks, x: float, y: float) -> Lean:
    """Lean of a point; O(log n) near the banks."""
    last, stack, window = banks.last, banks.stack, banks.window
    last[0], to_main, mx, my = nearest_on_bank(
        banks.main, x, y, last[0], window[0, 0], window[0, 1], stack
    )
    last[1], to_auxiliary, ax, ay = nearest_on_bank(
        banks.auxiliary, x, y, last[1], window[1, 0], window[1, 1], stack
    )
    return Lean(to_main - to_auxiliary, to_main, to_auxiliary, mx, my, ax, ay)


@njit(borrows=True)
def is_level(lean: Lean, slack: float) -> bool:
    """Whether both banks are equally far, but for rounding or for as much as is allowed."""
    return abs(lean.value) <= max(LEVEL * (lean.to_main + lean.to_auxiliary), slack)


@njit(borrows=True)
def is_straight(banks: Banks, lean: Lean) -> bool:
    """Whether the points about the last one looked at that are level lie on a straight line.

    They do where the nearest points of both banks are inside segments or both are vertices; of a
    vertex and a segment it is a parabola.
    """
    at_main = is_vertex(banks.main, banks.last[0], lean.main_x, lean.main_y, lean.to_main)
    at_auxiliary = is_vertex(
        banks.auxiliary, banks.last[1], lean.auxiliary_x, lean.auxiliary_y, lean.to_auxiliary
    )
    return at_main == at_auxiliary


@njit(borrows=True)
def is_vertex(bank: Bank, j: int, x: float, y: float, far: float) -> bool:
    """Whether a point of segment j, looked at from so far, is an end of it."""
    first = length(x - bank.x[j], y - bank.y[j])
    return min(first, length(x - bank.x[j + 1], y - bank.y[j + 1])) <= LEVEL * far


@njit(borrows=True)
def slope_along(lean: Lean, x: float, y: float, ux: float, uy: float) -> float:
    """How fast lean grows from x along the vector u; between -2 |u| and 2 |u|."""
    slope = 0.0
    if lean.to_main > 0.0:
        slope += (ux * (x - lean.main_x) + uy * (y - lean.main_y)) / lean.to_main
    if lean.to_auxiliary > 0.0:
        slope -= (ux * (x - lean.auxiliary_x) + uy * (y - lean.auxiliary_y)) / lean.to_auxiliary
    return slope


@njit(borrows=True)
def level_between(
    banks: Banks, px: float, py: float, qx: float, qy: float, t: float
) -> tuple[float, float, float]:
    """Return a level point on the segment from p, nearer to main, to q, nearer to the auxiliary.

    And the width there: how far the banks are, together.

    Newton's steps from the share t, halving where they leave what is known to hold the point:
    one step is exact between two straight banks.
    """
    ux, uy = qx - px, qy - py
    low, high = 0.0, 1.0
    x, y, width = px, py, 0.0
    for _ in range(ROUNDS):
        x, y = px + t * ux, py + t * uy
        lean = lean_at(banks, x, y)
        width = lean.to_main + lean.to_auxiliary
        if is_level(lean, banks.slack):
            break
        if lean.value < 0.0:
            low = t
        else:
            high = t
        slope = slope_along(lean, x, y, ux, uy)
        new = t - lean.value / slope if slope > 0.0 else low
        t = new if low < new < high else (low + high) / 2.0
    return x, y, width


@njit(borrows=True)
def way_to_level(lean: Lean, x: float, y: float) -> tuple[float, float, float]:
    """Return the unit vector to the farther bank and how far along it x is level, about."""
    fx, fy, far = lean.main_x, lean.main_y, lean.to_main
    if lean.value < 0.0:
        fx, fy, far = lean.auxiliary_x, lean.auxiliary_y, lean.to_auxiliary
    ux, uy = (fx - x) / far, (fy - y) / far
    return ux, uy, step_to_level(lean, x, y, ux, uy)


@njit(borrows=True)
def way_from_nearer(lean: Lean, x: float, y: float) -> tuple[float, float]:
    """Return the unit vector straight away from the nearer bank; none on the bank itself."""
    nx, ny, near = lean.main_x, lean.main_y, lean.to_main
    if lean.value > 0.0:
        nx, ny, near = lean.auxiliary_x, lean.auxiliary_y, lean.to_auxiliary
    return ((x - nx) / near, (y - ny) / near) if near > 0.0 else (0.0, 0.0)


@njit(borrows=True)
def step_to_level(lean: Lean, x: float, y: float, ux: float, uy: float) -> float:
    """How far along the unit vector u the lean is none, about."""
    slope = slope_along(lean, x, y, ux, uy)
    slope = slope if lean.value < 0.0 else -slope
    return abs(lean.value) / slope if slope > 0.0 else np.inf


@njit(borrows=True)
def level_where_straight(
    banks: Banks, px: float, py: float, qx: float, qy: float
) -> tuple[bool, float, float]:
    """Return where the level lines at p and at q meet, if that is level; whether it is.

    It is the kink of a level line that has one between p and q and is straight before and after.
    """
    lean = lean_at(banks, px, py)
    ax, ay = level_normal(lean, px, py)
    lean = lean_at(banks, qx, qy)
    bx, by = level_normal(lean, qx, qy)
    across = ax * by - ay * bx
    if abs(across) <= PARALLEL * length(ax, ay) * length(bx, by):
        return False, 0.0, 0.0
    at_q = bx * (qx - px) + by * (qy - py)
    x, y = px - ay * at_q / across, py + ax * at_q / across
    return is_level(lean_at(banks, x, y), banks.slack), x, y


@njit(borrows=True)
def level_normal(lean: Lean, x: float, y: float) -> tuple[float, float]:
    """Vector at right angles to the line of level points through a level point x."""
    if lean.to_main <= 0.0 or lean.to_auxiliary <= 0.0:
        return 0.0, 0.0
    mx, my = (x - lean.main_x) / lean.to_main, (y - lean.main_y) / lean.to_main
    ax, ay = (x - lean.auxiliary_x) / lean.to_auxiliary, (y - lean.auxiliary_y) / lean.to_auxiliary
    return mx - ax, my - ay


@njit(borrows=True)
def level_from(
    banks: Banks, lean: Lean, x: float, y: float, ux: float, uy: float
) -> tuple[bool, float, float]:
    """Move a point along the unit vector u until it is level; whether it came to be, and where.

    Never farther at once than the nearer bank is: so it stays on its side of every wall.
    """
    for _ in range(STEPS):
        if is_level(lean, banks.slack):
            return True, x, y
        near, far = min(lean.to_main, lean.to_auxiliary), max(lean.to_main, lean.to_auxiliary)
        # From a wall itself there is no safe step; whether the way leaves the area, walks tell.
        step = SAFE * near if near > AT_WALL * far else far / 2.0
        step = min(step, step_to_level(lean, x, y, ux, uy))
        px, py, was = x, y, lean.value
        x, y = x + step * ux, y + step * uy
        lean = lean_at(banks, x, y)
        if (lean.value < 0.0) != (was < 0.0) and not is_level(lean, banks.slack):
            if was > 0.0:
                px, py, x, y = x, y, px, py
            x, y, _ = level_between(banks, px, py, x, y, 0.5)
            return True, x, y
    return False, x, y
