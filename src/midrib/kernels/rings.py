"""Rings in one form: shell turning left, holes turning right, each from its lowest-left vertex.

Whatever follows then does not depend on where a ring starts and how it is wound.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.heap import pop, push
from midrib.kernels.jit import njit
from midrib.kernels.tables import width_of
from midrib.types import Floats, Ints

__all__ = [
    "LARGEST",
    "SMALLEST",
    "Rings",
    "count_rings",
    "find_rings",
    "normalise_rings",
    "sizes",
]

# Products of coordinates and their rounding errors neither overflow nor vanish up to here: the
# outer triangle of a triangulation is 2^17 extents large, and errors are 2^-106 of a product.
LARGEST, SMALLEST = 2.0**400, 2.0**-400


class Rings(NamedTuple):
    """Vertices of all rings; vertex k is followed by vertex ring_next[k].

    The first n_shell are the shell's; origin[k] is the row of the input that vertex k came
    from.
    """

    x: Floats
    y: Floats
    ring_next: Ints
    origin: Ints
    n_shell: int


@njit(entry=True, borrows=True)
def find_rings(coordinates: Floats, starts: Ints) -> bool:
    """Fill in where each ring of a valid polygon starts, and where the last one ends.

    A ring ends where its first point comes back. False if it is not to be told in this way: the
    first point stands there four times in a row.
    """
    row, n = 0, coordinates.shape[0]
    for k in range(starts.size - 1):
        last = row + 3
        while last < n and not (
            coordinates[last, 0] == coordinates[row, 0]
            and coordinates[last, 1] == coordinates[row, 1]
        ):
            last += 1
        starts[k], row = row, last + 1
    starts[-1] = row
    return row == n


@njit(borrows=True)
def signed_area(x: Floats, y: Floats, rows: Ints) -> float:
    """Area of a ring, positive if it turns left; taken about its first vertex."""
    total = 0.0
    x0, y0 = x[rows[0]], y[rows[0]]
    for i in range(1, rows.size - 1):
        a, b = rows[i], rows[i + 1]
        total += (x[a] - x0) * (y[b] - y0) - (x[b] - x0) * (y[a] - y0)
    return total / 2.0


@njit()
def distinct_rows(x: Floats, y: Floats, start: int, stop: int) -> Ints:
    """Rows of a closed ring without its repeated last vertex and without repeats in a row."""
    rows = np.empty(stop - start, np.intp)
    count = 0
    for k in range(start, stop):
        if count == 0 or x[k] != x[rows[count - 1]] or y[k] != y[rows[count - 1]]:
            rows[count] = k
            count += 1
    while count > 1 and x[rows[count - 1]] == x[rows[0]] and y[rows[count - 1]] == y[rows[0]]:
        count -= 1
    return rows[:count]


@njit()
def first_rows(x: Floats, y: Floats, offsets: Ints) -> Ints:
    """Row of the leftmost vertex of each ring, of several the lowest one."""
    first = offsets[:-1].copy()
    for ring in range(first.size):
        for k in range(offsets[ring], offsets[ring + 1]):
            b = first[ring]
            if x[k] < x[b] or (x[k] == x[b] and y[k] < y[b]):
                first[ring] = k
    return first


@njit()
def shell_then_holes(x: Floats, y: Floats, first: Ints) -> Ints:
    """Order of the rings: the shell, then the holes, along it by their leftmost vertices."""
    n = first.size
    order, heap, key = np.zeros(n, np.intp), np.empty(n, np.intp), np.empty(n)
    if n == 1:
        return order
    along, across = (x, y) if width_of(x) >= width_of(y) else (y, x)
    size = 0
    for ring in range(1, n):
        key[ring] = along[first[ring]]
        size = push(heap, key, size, ring)
    for place in range(1, n):
        ring = pop(heap, key, size)
        size -= 1
        # Of holes that start at the same place the lowest comes first, or the leftmost.
        at = place
        while (
            at > 1
            and key[order[at - 1]] == key[ring]
            and across[first[order[at - 1]]] > across[first[ring]]
        ):
            order[at] = order[at - 1]
            at -= 1
        order[at] = ring
    return order


@njit(borrows=True)
def count_rings(rings: Rings) -> int:
    """How many rings are left."""
    count = 0
    for k in range(rings.ring_next.size):
        if rings.ring_next[k] <= k:
            count += 1
    return count


@njit(entry=True)
def sizes(coordinates: Floats) -> tuple[float, float]:
    """Largest coordinate and larger extent of rows (x, y, ...); NaN if one is NaN."""
    largest, extent = 0.0, 0.0
    for axis in range(2):
        low, high = np.inf, -np.inf
        for i in range(coordinates.shape[0]):
            low, high = min(low, coordinates[i, axis]), max(high, coordinates[i, axis])
        largest = max(largest, abs(low), abs(high))
        extent = max(extent, high - low)
    return largest, extent


@njit(entry=True)
def normalise_rings(coordinates: Floats, offsets: Ints) -> Rings:
    """Rings of one area in the form above.

    Parameters
    ----------
    coordinates : (n, 2 or 3) closed rings one after the other, the shell first
    offsets : (rings + 1,) where each ring starts

    Returns
    -------
    Rings
        Rings with fewer than three distinct vertices are left out.
    """
    x, y = coordinates[:, 0].copy(), coordinates[:, 1].copy()
    n = x.size
    origin, ring_next = np.empty(n, np.intp), np.empty(n, np.intp)
    count, n_shell = 0, 0
    first = first_rows(x, y, offsets)
    for ring in shell_then_holes(x, y, first):
        rows = distinct_rows(x, y, offsets[ring], offsets[ring + 1])
        size = rows.size
        if size < 3:
            continue
        if (signed_area(x, y, rows) > 0.0) != (ring == 0):
            rows = rows[::-1].copy()
        low, leftmost = 0, first[ring]
        while x[rows[low]] != x[leftmost] or y[rows[low]] != y[leftmost]:
            low += 1
        for i in range(size):  # remainders would take as long as all the rest
            origin[count + i] = rows[low]
            ring_next[count + i] = count + i + 1
            low = low + 1 if low + 1 < size else 0
        count += size
        ring_next[count - 1] = count - size
        if ring == 0:
            n_shell = size
    origin = origin[:count].copy()
    return Rings(x[origin], y[origin], ring_next[:count].copy(), origin, n_shell)
