r"""Banks: the two sides of an area, and how much nearer a point is to the one than to the other.

x       point inside the area
m, a    nearest points to x of the main and of the auxiliary bank
lean    |xm| - |xa|: negative nearer to the main bank, zero in the middle

    auxiliary  -----a-----------
                    |
                    x               lean < 0: x moves towards a, at most as far as m is, and so
                    m\              neither leaves the area nor passes through a wall
    main       -------\---------

Coordinates are in lengths: scale_x x, scale_y y of those of the mesh.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import DEPTH, box_tree
from midrib.kernels.chain import TIE_OF_COORDINATE, TIE_OF_RADIUS, Chain
from midrib.kernels.clearance import nearest_in_run, nearest_of
from midrib.kernels.islands import Loops
from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.kernels.mesh import Mesh
from midrib.kernels.triangulation import next_side
from midrib.types import Bools, Floats, Ints

__all__ = [
    "LEVEL",
    "Banks",
    "banks_of",
    "is_level",
    "is_looking_between",
    "is_straight",
    "lean_at",
    "level_between",
    "level_from",
    "level_where_straight",
    "look_beside",
    "look_between",
    "look_everywhere",
    "way_from_nearer",
    "way_to_level",
]

LEVEL = 2.0**-42  # of the width: less lean than this is rounding
ROUNDS = 64  # bisection alone needs 53
STEPS = 24
SAFE = 0.875  # of the distance to the nearer bank
AT_WALL = 2.0**-20  # of the distance to the farther one: a point that is as near is on a wall
FEW = 24  # segments are looked through one by one; more are searched by their boxes
MANY = 2**62
PARALLEL = 2.0**-26  # sine of an angle: level lines that meet at less go on straight


class Bank(NamedTuple):
    """Segments of one side: those of its curve, then islands; whether each goes on to the next."""

    x: Floats
    y: Floats
    goes_on: Bools
    boxes: Floats
    curve: int  # how many segments are the curve's


class Banks(NamedTuple):
    """Both sides of an area, and tables to work in."""

    main: Bank
    auxiliary: Bank
    slack: float  # lean that counts as none: that of rounding, or as much as is asked for
    last: Ints  # (2,) the segments that were nearest last time: the next point is not far
    window: Ints  # (2, 2) of main and auxiliary: the segments from .. to that can be nearest
    is_windowed: bool  # whether windows hold; bridges and walls belong to no run of segments
    islands: Bank  # those of both banks
    open_water: Floats  # (3,) x, y and radius of a circle without islands: windows hold inside
    stack: Ints


class Lean(NamedTuple):
    """How far a point is from both banks, and the nearest points."""

    value: float  # to_main - to_auxiliary
    to_main: float
    to_auxiliary: float
    main_x: float
    main_y: float
    auxiliary_x: float
    auxiliary_y: float


@njit()
def bank_of(
    mesh: Mesh, chain: Chain, loops: Loops, is_main: bool, scale_x: float, scale_y: float
) -> Bank:
    """Bank of one curve, but for its bridges, and of what goes with it; O(n)."""
    n = chain.vertex.size
    size = n
    for k in range(loops.is_main.size):
        if loops.is_main[k] == is_main:
            size += loops.start[k + 1] - loops.start[k] + 1
    for k in range(loops.wall_is_main.size):
        if loops.wall_is_main[k] == is_main:
            size += 2
    x, y, goes_on = np.empty(size), np.empty(size), np.ones(size, np.bool_)
    for i in range(n):
        x[i], y[i] = mesh.x[chain.vertex[i]] * scale_x, mesh.y[chain.vertex[i]] * scale_y
    for i in range(n - 1):
        goes_on[i] = chain.side[i] >= 0
    goes_on[n - 1] = False
    for k in range(loops.is_main.size):
        if loops.is_main[k] == is_main:
            n = add_island(mesh, loops, k, x, y, goes_on, n, scale_x, scale_y)
    for k in range(loops.wall_is_main.size):
        if loops.wall_is_main[k] == is_main:
            x[n], y[n] = loops.wall[k, 0] * scale_x, loops.wall[k, 1] * scale_y
            x[n + 1], y[n + 1] = loops.wall[k, 2] * scale_x, loops.wall[k, 3] * scale_y
            goes_on[n + 1] = False
            n += 2
    return Bank(x, y, goes_on, box_tree(x, y), chain.vertex.size - 1)


@njit()
def all_islands(mesh: Mesh, loops: Loops, scale_x: float, scale_y: float) -> Bank:
    """Return the islands of both banks; O(n)."""
    count = loops.is_main.size
    size = loops.start[count] + count
    x, y, goes_on = np.empty(size), np.empty(size), np.ones(size, np.bool_)
    n = 0
    for k in range(count):
        n = add_island(mesh, loops, k, x, y, goes_on, n, scale_x, scale_y)
    return Bank(x, y, goes_on, box_tree(x, y), 0)


@njit(borrows=True)
def add_island(
    mesh: Mesh,
    loops: Loops,
    k: int,
    x: Floats,
    y: Floats,
    goes_on: Bools,
    n: int,
    scale_x: float,
    scale_y: float,
) -> int:
    """Write loop k from place n on; return the place after it."""
    for i in range(loops.start[k], loops.start[k + 1]):
        v = mesh.tri[loops.side[i]]
        x[n], y[n] = mesh.x[v] * scale_x, mesh.y[v] * scale_y
        n += 1
    v = mesh.tri[next_side(loops.side[loops.start[k + 1] - 1])]
    x[n], y[n], goes_on[n] = mesh.x[v] * scale_x, mesh.y[v] * scale_y, False
    return n + 1


@njit()
def banks_of(
    mesh: Mesh,
    main: Chain,
    auxiliary: Chain,
    loops: Loops,
    slack: float,
    scale_x: float,
    scale_y: float,
) -> Banks:
    """Both banks of an area; less lean than ``slack`` (a length) is none. O(n)."""
    largest = 0.0
    for v in range(mesh.x.size):
        largest = max(largest, abs(mesh.x[v]) * scale_x, abs(mesh.y[v]) * scale_y)
    is_windowed = loops.wall_is_main.size == 0
    for e in auxiliary.side:
        is_windowed = is_windowed and e >= 0
    has_islands = loops.is_main.size > 0
    on_main = bank_of(mesh, main, loops, True, scale_x, scale_y)
    return Banks(
        on_main,
        bank_of(mesh, auxiliary, loops, False, scale_x, scale_y),
        max(slack, TIE_OF_COORDINATE * largest),
        np.zeros(2, np.intp),
        np.array([[0, MANY], [0, MANY]]),
        is_windowed,
        all_islands(mesh, loops, scale_x, scale_y) if has_islands else on_main,
        np.array([0.0, 0.0, 0.0 if has_islands else np.inf]),
        np.empty(DEPTH, np.intp),
    )


@njit(borrows=True)
def look_between(
    banks: Banks, first: Ints, last: Ints, px: float, py: float, qx: float, qy: float
) -> None:
    """Let only the segments between two pairs (main, auxiliary) be nearest, those of p and of q.

    Where p and q have their nearest points, those of what lies between p and q come in between:
    the ways to them do not cross. Few segments are looked through in a tenth of the time that
    the tree takes. Near islands every segment may be nearest.
    """
    look_everywhere(banks)
    if not banks.is_windowed or (
        banks.open_water[2] < np.inf and not is_in_open_water(banks, first, last, px, py, qx, qy)
    ):
        return
    for k in range(2):
        banks.window[k, 0] = max(min(first[k], last[k]) - 1, 0)
        banks.window[k, 1] = max(first[k], last[k]) + 2
    banks.window[0, 1] = min(banks.window[0, 1], banks.main.curve)
    banks.window[1, 1] = min(banks.window[1, 1], banks.auxiliary.curve)


@njit(borrows=True)
def is_in_open_water(
    banks: Banks, first: Ints, last: Ints, px: float, py: float, qx: float, qy: float
) -> bool:
    """Whether the curves are nearer than any island to all that lies between p and q.

    Given the segments that are nearest to p and to q.
    """
    water, islands = banks.open_water, banks.islands
    span = length(qx - px, qy - py)
    reach = span  # farther than what lies between p and q is from its nearest points
    for k in range(2):
        bank = banks.main if k == 0 else banks.auxiliary
        i, j = first[k], last[k]
        if max(i, j) >= bank.curve:
            return False
        _, at_p = nearest_in_run(px, py, bank.x, bank.y, i, i + 1)[1:]
        _, at_q = nearest_in_run(qx, qy, bank.x, bank.y, j, j + 1)[1:]
        reach = max(reach, span + np.sqrt(at_p) + np.sqrt(at_q))
    x, y = (px + qx) / 2.0, (py + qy) / 2.0
    off = length(x - water[0], y - water[1])
    if off + reach < water[2] or off + water[2] <= reach:
        return off + reach < water[2]
    _, _, squared = nearest_of(
        x, y, islands.x, islands.y, islands.goes_on, islands.boxes, 0, banks.stack
    )
    water[0], water[1], water[2] = x, y, np.sqrt(squared)
    return reach < water[2]


@njit(borrows=True)
def look_beside(banks: Banks, j: int, px: float, py: float, radius: float) -> None:
    """Let only the auxiliary segment j and those beside it be nearest, if it is nearest to p.

    Then so it is to all points between p and its point so far away: circles around them that
    reach that point are inside the one around p.
    """
    bank = banks.auxiliary
    look_everywhere(banks)
    if not banks.is_windowed:
        return
    _, _, squared = nearest_of(px, py, bank.x, bank.y, bank.goes_on, bank.boxes, j, banks.stack)
    if j < bank.curve and squared >= radius * radius * (1.0 - TIE_OF_RADIUS):
        banks.window[1, 0], banks.window[1, 1] = max(j - 1, 0), min(j + 2, bank.curve)


@njit(borrows=True)
def is_looking_between(banks: Banks) -> bool:
    """Whether only segments between two pairs can be nearest."""
    return banks.window[0, 1] < MANY


@njit(borrows=True)
def look_everywhere(banks: Banks) -> None:
    """Let every segment be nearest."""
    for k in range(2):
        banks.window[k, 0], banks.window[k, 1] = 0, MANY


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
