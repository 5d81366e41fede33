r"""Roots of a polynomial in Bernstein form: signs of its coefficients bound their number.

      c0 .            c0 .. cd   values of the control polygon, evenly spaced from a to b
          .  c2       The polynomial has at most as many roots inside as the polygon changes its
    --a----.-.--b--   sign, and as many up to an even number; halves of the polygon bound the
            c1   c3   halves of the polynomial.

Source: G. Farin, Curves and Surfaces for CAGD, 5th edition, 2002, chapters 5 and 6.
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.types import Floats

__all__ = ["DEGREE", "HALVINGS", "new_halves", "roots_inside"]

DEGREE = 6
HALVINGS = 60  # more than the bits of a number from 0 to 1


@njit()
def new_halves() -> Floats:
    """Table for the parts of a polynomial that wait: from, to, coefficients."""
    return np.empty((HALVINGS + 2, DEGREE + 3))


@njit()
def roots_inside(
    coefficients: Floats,
    degree: int,
    start: float,
    stop: float,
    halves: Floats,
    roots: Floats,
    count: int,
) -> int:
    """Append the roots between start and stop in ascending order, each to the last bit; new count.

    A double root may be missed or found twice, next to itself: there the sign does not change.
    """
    halves[0, 0], halves[0, 1] = start, stop
    for k in range(degree + 1):
        halves[0, 2 + k] = coefficients[k]
    depth = 1
    while depth > 0:
        depth -= 1
        row = halves[depth]
        # 1. Parts whose coefficients have one sign have no root, but at an end.
        low, high = row[2], row[2]
        for k in range(1, degree + 1):
            low, high = min(low, row[2 + k]), max(high, row[2 + k])
        a, b = row[0], row[1]
        middle = (a + b) / 2.0
        is_root = not a < middle < b or depth >= HALVINGS
        if low >= 0.0 or high <= 0.0:
            is_root = row[2 + degree] == 0.0
            middle = b
        if is_root and b < stop and count < roots.size:
            roots[count] = b
            count += 1
        if is_root or middle == b:
            continue
        # 2. Halve: in place what remains is the right half, its first entries are the left one.
        right, left = row, halves[depth + 1]
        left[0], left[1] = a, middle
        right[0] = middle
        for k in range(degree + 1):
            left[2 + k] = right[2]
            for i in range(degree - k):
                right[2 + i] = (right[2 + i] + right[3 + i]) / 2.0
        depth += 2
    return count
