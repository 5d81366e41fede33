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

__all__ = ["DEGREE", "roots_inside"]

DEGREE = 6
HALVINGS = 60  # more than the bits of a number from 0 to 1
SAME_SHARE = 2.0**-50
PARTS = 4  # rows of a table for polynomials: before them whatever the caller keeps there


@njit(borrows=True)
def roots_inside(
    work: Floats, i: int, degree: int, start: float, stop: float, into: int, count: int
) -> int:
    """Append the roots of row i between start and stop to row ``into``; their new number.

    In ascending order, each to rounding. A double root may be missed or found twice, next to
    itself: there the sign does not change. Rows from PARTS on hold parts that wait: from, to and
    coefficients.
    """
    if degree == 2:
        return roots_of_quadratic(work, i, start, stop, into, count)
    work[PARTS, 0], work[PARTS, 1] = start, stop
    for k in range(degree + 1):
        work[PARTS, 2 + k] = work[i, k]
    depth = PARTS + 1
    while depth > PARTS:
        depth -= 1
        # 1. Parts whose coefficients have one sign have no root, but at an end.
        low, high, changes, before = work[depth, 2], work[depth, 2], 0, work[depth, 2]
        for k in range(1, degree + 1):
            c = work[depth, 2 + k]
            low, high = min(low, c), max(high, c)
            if c != 0.0:
                changes += (c > 0.0) != (before > 0.0)
                before = c
        a, b = work[depth, 0], work[depth, 1]
        middle = (a + b) / 2.0
        has_one_sign = low >= 0.0 or high <= 0.0
        if has_one_sign or not a < middle < b or depth >= PARTS + HALVINGS:
            is_root = not has_one_sign or work[depth, 2 + degree] == 0.0
            if is_root and b < stop and count < work.shape[1]:
                work[into, count] = b
                count += 1
            continue
        # 2. A part with one change has one root.
        if changes == 1 and work[depth, 2] != 0.0 and work[depth, 2 + degree] != 0.0:
            if count < work.shape[1]:
                work[into, count] = a + only_root(work, depth, degree) * (b - a)
                count += 1
            continue
        # 3. Halve: in place what remains is the right half, its first entries are the left one.
        work[depth, 0] = middle
        work[depth + 1, 0], work[depth + 1, 1] = a, middle
        for k in range(degree + 1):
            work[depth + 1, 2 + k] = work[depth, 2]
            for m in range(2, 2 + degree - k):
                work[depth, m] = (work[depth, m] + work[depth, m + 1]) / 2.0
        depth += 2
    return count


@njit(borrows=True)
def only_root(work: Floats, i: int, degree: int) -> float:
    """Share of the way from the start of part i to its end at which its only root is.

    By secants (Illinois); every third time by halving, should the curve be flat.
    """
    low, high, at_low, at_high, moved = 0.0, 1.0, work[i, 2], work[i, 2 + degree], 0
    for step in range(3 * HALVINGS):
        if high - low <= SAME_SHARE:
            break
        u = low + (high - low) * (at_low / (at_low - at_high))
        if step % 3 == 2 or not low < u < high:
            u = (low + high) / 2.0
        at_u = value_inside(work, i, degree, u)
        if at_u == 0.0:
            return u
        if (at_u > 0.0) == (at_low > 0.0):
            low, at_low = u, at_u
            at_high = at_high / 2.0 if moved == 1 else at_high
            moved = 1
        else:
            high, at_high = u, at_u
            at_low = at_low / 2.0 if moved == -1 else at_low
            moved = -1
    return (low + high) / 2.0


@njit(borrows=True)
def value_inside(work: Floats, i: int, degree: int, u: float) -> float:
    """Value of part i at a share of it: a Horner scheme."""
    value, power, ways = work[i, 2], 1.0, 1.0
    for k in range(1, degree + 1):
        power *= u
        ways *= (degree - k + 1.0) / k
        value = value * (1.0 - u) + ways * power * work[i, 2 + k]
    return value


@njit(borrows=True)
def roots_of_quadratic(
    work: Floats, i: int, start: float, stop: float, into: int, count: int
) -> int:
    """As ``roots_inside``, by the formula: of u / (1 - u) it is c2 r r + 2 c1 r + c0 = 0."""
    c0, c1, c2 = work[i, 0], work[i, 1], work[i, 2]
    square = c1 * c1 - c0 * c2
    if min(c0, c1, c2) >= 0.0 or max(c0, c1, c2) <= 0.0 or square < 0.0:
        return count
    root = np.sqrt(square)
    q = -(c1 + root) if c1 >= 0.0 else root - c1
    one = q / (q + c2) if q + c2 != 0.0 else -1.0
    two = c0 / (c0 + q) if c0 + q != 0.0 else -1.0
    for k in range(2):
        u = min(one, two) if k == 0 else max(one, two)
        t = start + u * (stop - start)
        if start < t < stop and count < work.shape[1]:
            work[into, count] = t
            count += 1
    return count
