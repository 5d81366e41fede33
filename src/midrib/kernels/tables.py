"""Copies of small tables with room for more: what NumPy does too, but quicker to compile."""

import numpy as np

from midrib.kernels.jit import njit
from midrib.types import Floats, Ints

__all__ = ["longer", "longer_ints", "taller", "taller_ints"]


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


@njit()
def taller(table: Floats) -> Floats:
    """Copy of a table of floats with twice as many rows."""
    n, m = table.shape
    copy = np.empty((2 * n, m))
    for i in range(n):
        for k in range(m):
            copy[i, k] = table[i, k]
    return copy


@njit()
def taller_ints(table: Ints) -> Ints:
    """Copy of a table of integers with twice as many rows."""
    n, m = table.shape
    copy = np.empty((2 * n, m), np.intp)
    for i in range(n):
        for k in range(m):
            copy[i, k] = table[i, k]
    return copy
