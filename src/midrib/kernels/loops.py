r"""Loops of a line: where it meets itself, and the line without them.

        ___
       /   \\        the path i .. j+1 meets itself at x; what lies between
       \\   /        is cut out: i, x, j+1
    i ---x--- j+1

Pairs of segments are found by sorting their ranges along the longer axis: near-linear for lines
that run along.
"""

import numpy as np

from midrib.kernels.heap import pop, push
from midrib.kernels.jit import njit
from midrib.kernels.predicates import orient
from midrib.kernels.tables import width_of
from midrib.types import Floats, Ints

__all__ = ["cut_loops"]


@njit(borrows=True)
def meet(path: Floats, i: int, j: int) -> bool:
    """Whether segments i < j have a point in common; if they are neighbours, more than one."""
    ax, ay, bx, by = path[i, 0], path[i, 1], path[i + 1, 0], path[i + 1, 1]
    cx, cy, dx, dy = path[j, 0], path[j, 1], path[j + 1, 0], path[j + 1, 1]
    if max(ay, by) < min(cy, dy) or max(cy, dy) < min(ay, by):
        return False
    if max(ax, bx) < min(cx, dx) or max(cx, dx) < min(ax, bx):
        return False
    side_c, side_d = orient(ax, ay, bx, by, cx, cy), orient(ax, ay, bx, by, dx, dy)
    if j == i + 1:
        # They share b = c; more only where the line turns straight back on itself.
        return side_d == 0.0 and (bx - ax) * (dx - cx) + (by - ay) * (dy - cy) < 0.0
    if (side_c > 0.0 and side_d > 0.0) or (side_c < 0.0 and side_d < 0.0):
        return False
    side_a, side_b = orient(cx, cy, dx, dy, ax, ay), orient(cx, cy, dx, dy, bx, by)
    if (side_a > 0.0 and side_b > 0.0) or (side_a < 0.0 and side_b < 0.0):
        return False
    if side_a == 0.0 and side_b == 0.0 and side_c == 0.0 and side_d == 0.0:
        overlap_x = max(ax, bx) >= min(cx, dx) and max(cx, dx) >= min(ax, bx)
        return overlap_x and max(ay, by) >= min(cy, dy) and max(cy, dy) >= min(ay, by)
    return True


@njit()
def last_meetings(path: Floats) -> Ints:
    """For each segment the last later segment that meets it, or -1."""
    n = path.shape[0] - 1
    along = 0 if width_of(path[:, 0]) >= width_of(path[:, 1]) else 1
    low, high = np.empty(n), np.empty(n)
    ascending, descending = 0, 0
    for i in range(n):
        a, b = path[i, along], path[i + 1, along]
        low[i], high[i] = min(a, b), max(a, b)
        ascending, descending = ascending + (a < b), descending + (a > b)
    last = np.full(n, -1, np.intp)
    if n in (ascending, descending):
        return last  # it never turns back, so nothing meets
    # Segments in the order of their lower ends, by a heap.
    waiting, n_waiting = np.empty(n, np.intp), 0
    for i in range(n):
        n_waiting = push(waiting, low, n_waiting, i)
    active = np.empty(n, np.intp)
    n_active = 0
    while n_waiting > 0:
        k = pop(waiting, low, n_waiting)
        n_waiting -= 1
        kept = 0
        for m in range(n_active):
            other = active[m]
            if high[other] < low[k]:
                continue
            active[kept] = other
            kept += 1
            i, j = min(other, k), max(other, k)
            if j > last[i] and meet(path, i, j):
                last[i] = j
        active[kept] = k
        n_active = kept + 1
    return last


@njit(borrows=True)
def meeting_point(path: Floats, i: int, j: int) -> tuple[float, float]:
    """Return a point that segments i and j have in common, up to rounding.

    An end of one where one is.
    """
    ax, ay, bx, by = path[i, 0], path[i, 1], path[i + 1, 0], path[i + 1, 1]
    cx, cy, dx, dy = path[j, 0], path[j, 1], path[j + 1, 0], path[j + 1, 1]
    at_a = (dx - cx) * (ay - cy) - (dy - cy) * (ax - cx)
    at_b = (dx - cx) * (by - cy) - (dy - cy) * (bx - cx)
    if at_a == at_b:
        # One line: leave segment i where it first touches j, on the way from a.
        if (bx - ax) * (dx - cx) + (by - ay) * (dy - cy) < 0.0:
            return (dx, dy) if j == i + 1 else (bx, by)
        return bx, by
    t = min(max(at_a / (at_a - at_b), 0.0), 1.0)
    return ax + t * (bx - ax), ay + t * (by - ay)


@njit(entry=True)
def cut_loops(path: Floats) -> tuple[Floats, Ints, int]:
    """Return the path without its loops.

    Parameters
    ----------
    path : (n, 2), no point equal to the one before

    Returns
    -------
    points : (k, 2); the row of ``path`` each one is, or -1 for a new point; the number of loops

    Notes
    -----
    Going along the path, every segment that is met again is left at the last meeting. O(n log n)
    and the number of pairs of segments whose ranges overlap.
    """
    n = path.shape[0]
    if n < 3:
        return path, np.arange(n), 0
    points, row = np.empty((2 * n, 2)), np.empty(2 * n, np.intp)
    last = last_meetings(path)
    count, loops, i = 0, 0, 0
    while i < n:
        points[count, 0], points[count, 1], row[count] = path[i, 0], path[i, 1], i
        count += 1
        # A segment entered in its middle (after a cut) is only followed from there on; a meeting
        # behind that point is found again when the result is tested.
        while i < n - 1 and last[i] >= 0:
            j = last[i]
            x, y = meeting_point(path, i, j)
            loops += 1
            if x != points[count - 1, 0] or y != points[count - 1, 1]:
                points[count, 0], points[count, 1], row[count] = x, y, -1
                count += 1
            i = j
        i += 1
    if (
        count > 1
        and points[count - 1, 0] == points[count - 2, 0]
        and (points[count - 1, 1] == points[count - 2, 1])
    ):
        count -= 1
    return points[:count], row[:count], loops
