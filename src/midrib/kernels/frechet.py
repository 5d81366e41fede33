r"""Fréchet distance of two chains: the shortest leash for two walkers who never step back.

    j+1 +--------+        cell (i, j): a point of segment i of the first chain beside one of
        |   __   |        segment j of the second; free where they are within the leash. Free
   left |  /  \  |        space in a cell is convex, so what can be reached is told by its sides.
        | /    \ |
      j +--------+
        i below  i+1

A leash is long enough if free space leads from corner (0, 0) to (n, m) without a step back
(Alt and Godau 1995, International Journal of Computational Geometry & Applications 5, section 3).
Only cells that can be reached are looked at: about as many as there are vertices where one chain
runs along the other.
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.types import Floats, Ints

__all__ = ["frechet_distances"]

HALVINGS = 44  # of the interval the leash lies in: 13 digits of it
DOUBLINGS = 64
SHORTEST = 2.0**-44  # of the extent: where the search begins if nothing bounds it below
NOTHING = (1.0, 0.0)  # an interval without a point


@njit(entry=True)
def frechet_distances(
    p: Floats, p_offsets: Ints, q: Floats, q_offsets: Ints, at_least: Floats
) -> Floats:
    """Fréchet distance of chains p[i] and q[i], each without a break; at_least bounds it below.

    O(n m log) at worst for n and m vertices, O(n + m) where one runs along the other.
    """
    result = np.empty(at_least.size)
    for i in range(at_least.size):
        a = p[p_offsets[i] : p_offsets[i + 1]]
        b = q[q_offsets[i] : q_offsets[i + 1]]
        result[i] = frechet_distance(a, b, at_least[i])
    return result


@njit()
def frechet_distance(p: Floats, q: Floats, at_least: float) -> float:
    """Shortest leash of two chains, by doubling a bound from below and halving what is left."""
    n, m = p.shape[0] - 1, q.shape[0] - 1
    low = max(at_least, length(p[0, 0] - q[0, 0], p[0, 1] - q[0, 1]))
    low = max(low, length(p[n, 0] - q[m, 0], p[n, 1] - q[m, 1]))
    if is_long_enough(p, q, low):
        return low
    across = max(p[:, 0].max(), q[:, 0].max()) - min(p[:, 0].min(), q[:, 0].min())
    upward = max(p[:, 1].max(), q[:, 1].max()) - min(p[:, 1].min(), q[:, 1].min())
    high = max(low, SHORTEST * length(across, upward))
    for _ in range(DOUBLINGS):
        low, high = high, 2.0 * high
        if is_long_enough(p, q, high):
            break
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        if is_long_enough(p, q, middle):
            high = middle
        else:
            low = middle
    return high


@njit()
def is_long_enough(p: Floats, q: Floats, leash: float) -> bool:
    """Whether free space leads from the starts of two chains to their ends, row by row of p."""
    n, m = p.shape[0] - 1, q.shape[0] - 1
    if not (is_free(p, 0, q, 0, leash) and is_free(p, n, q, m, leash)):
        return False
    # Left sides of row i that can be reached, from segment `first` of q up to below `stop`.
    low, high = np.ones(m), np.zeros(m)
    next_low, next_high = np.ones(m), np.zeros(m)
    first, stop = 0, 0
    while stop < m:
        start, end = free_part(p[0], q[stop], q[stop + 1], leash)
        if start > 0.0 or start > end:
            break
        low[stop], high[stop] = start, end
        stop += 1
        if end < 1.0:
            break
    along_bottom = True
    for i in range(n):
        below_low, below_high = NOTHING
        if along_bottom:
            below_low, below_high = free_part(q[0], p[i], p[i + 1], leash)
            if below_low > 0.0:
                below_low, below_high = NOTHING
            along_bottom = below_low <= below_high and below_high >= 1.0
        j, next_first, next_stop = (0 if below_low <= below_high else first), m, 0
        while j < m:
            left_low, left_high = (low[j], high[j]) if first <= j < stop else NOTHING
            from_left, from_below = left_low <= left_high, below_low <= below_high
            if not from_left and not from_below:
                if j >= stop:
                    break
                j += 1
                continue
            right_low, right_high = free_part(p[i + 1], q[j], q[j + 1], leash)
            above_low, above_high = free_part(q[j + 1], p[i], p[i + 1], leash)
            if not from_below:
                right_low = max(right_low, left_low)
            if not from_left:
                above_low = max(above_low, below_low)
            next_low[j], next_high[j] = right_low, right_high
            if right_low <= right_high:
                next_first, next_stop = min(next_first, j), j + 1
            below_low, below_high = above_low, above_high
            j += 1
        if next_stop == 0 and not along_bottom:
            return False
        low, next_low = next_low, low
        high, next_high = next_high, high
        next_low[first:stop], next_high[first:stop] = NOTHING  # the next row may pass them by
        first, stop = next_first, next_stop
    return stop == m and high[m - 1] >= 1.0


@njit(borrows=True)
def is_free(p: Floats, i: int, q: Floats, j: int, leash: float) -> bool:
    """Whether two vertices are within the leash."""
    return length(p[i, 0] - q[j, 0], p[i, 1] - q[j, 1]) <= leash


@njit(borrows=True)
def free_part(p: Floats, a: Floats, b: Floats, leash: float) -> tuple[float, float]:
    """From where to where on the segment a b (0 at a, 1 at b) p is within the leash.

    Both ends are asked for themselves, so that rounding parts no two segments that meet there.
    """
    ux, uy, vx, vy = b[0] - a[0], b[1] - a[1], p[0] - a[0], p[1] - a[1]
    starts = length(vx, vy) <= leash
    ends = length(p[0] - b[0], p[1] - b[1]) <= leash
    if starts and ends:
        return 0.0, 1.0
    squared = ux * ux + uy * uy
    if squared == 0.0:
        return NOTHING
    foot = (ux * vx + uy * vy) / squared
    off = (ux * vy - uy * vx) / np.sqrt(squared)
    if abs(off) > leash:
        return (0.0, 0.0) if starts else ((1.0, 1.0) if ends else NOTHING)
    half = np.sqrt((leash - off) * (leash + off) / squared)
    if not starts and not ends and not 0.0 < foot < 1.0:
        return NOTHING
    low = 0.0 if starts else min(max(foot - half, 0.0), 1.0)
    high = 1.0 if ends else max(min(foot + half, 1.0), low)
    return low, high
