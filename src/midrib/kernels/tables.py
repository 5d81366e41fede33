"""Copies of tables with room for more, and ranges: as of NumPy, but much quicker to compile.

What can go wrong with ``a[:n] = b`` is put into words, and words are compiled along.
"""

from typing import TypeVar

import numpy as np

from midrib.kernels.jit import njit
from midrib.types import Floats, Ints

__all__ = ["longer", "longer_ints", "range_of", "width_of", "with_places", "with_rows"]

Array = TypeVar("Array", Floats, Ints)


@njit(borrows=True)
def range_of(values: Floats) -> tuple[float, float]:
    """Least and greatest of some numbers: a fifth of the time of NumPy's, which look for NaN."""
    low, high = np.inf, -np.inf
    for i in range(values.size):
        low, high = min(low, values[i]), max(high, values[i])
    return low, high


@njit(borrows=True)
def width_of(values: Floats) -> float:
    """How far the greatest of some values is from the least."""
    least, greatest = range_of(values)
    return greatest - least


@njit()
def with_rows(table: Array, rows: int) -> Array:
    """Copy of a table of so many rows, those of the table first."""
    larger = np.empty((rows, table.shape[1]), table.dtype)
    for i in range(table.shape[0]):
        for k in range(table.shape[1]):
            larger[i, k] = table[i, k]
    return larger


@njit()
def with_places(array: Array, places: int) -> Array:
    """Copy of an array of so many places, those of the array first."""
    larger = np.empty(places, array.dtype)
    for i in range(array.size):
        larger[i] = array[i]
    return larger


@njit()
def longer(array: Floats, value: float) -> Floats:
    """Copy of an array of floats with one more at its end."""
    n = array.size
    copy = np.empty(n + 1)
    for i in range(n):
        copy[i] = array[i]
    copy[n] = value
    return copy


@njit()
def longer_ints(array: Ints, at: int, values: tuple[int, ...]) -> Ints:
    """Copy of an array of integers with some more before place ``at``."""
    n, m = array.size, len(values)
    copy = np.empty(n + m, np.intp)
    for i in range(n):
        copy[i if i < at else i + m] = array[i]
    for i in range(m):
        copy[at + i] = values[i]
    return copy
