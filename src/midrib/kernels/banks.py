"""Banks: the two sides of an area, each a curve and the islands that go with it.

Coordinates are in lengths: scale_x x, scale_y y of those of the mesh.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.boxtree import DEPTH, box_tree
from midrib.kernels.chain import TIE_OF_COORDINATE, Chain
from midrib.kernels.islands import Loops
from midrib.kernels.jit import njit
from midrib.kernels.mesh import Mesh
from midrib.kernels.triangulation import next_side
from midrib.types import Bools, Floats, Ints

__all__ = ["MANY", "Bank", "Banks", "banks_of"]

MANY = 2**62  # segments: no window


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
