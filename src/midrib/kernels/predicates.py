"""Signs that can be trusted: on which side of a line a point lies.

a, b, c   points; ``orient`` is positive when a, b, c turn left
          c
         .
        .      orient(a, b, c) > 0
    a-----b

The determinant is computed in plain floating point first. Only where its error bound exceeds it
is it computed again, exactly, as a sum of products without rounding error.
Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
Predicates, Discrete & Computational Geometry 18, 1997 (bounds: section 4.1; sums: section 2).
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.types import Floats

__all__ = ["in_circle", "orient"]

ROUNDING = 2.0**-53
ORIENT_BOUND = (3.0 + 16.0 * ROUNDING) * ROUNDING
CIRCLE_BOUND = (10.0 + 96.0 * ROUNDING) * ROUNDING
QUICK_BOUND = (1.0 + 2.0**-40) * CIRCLE_BOUND  # its own sums are rounded too
SPLITTER = 2.0**27 + 1.0


@njit(borrows=True)
def orient(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> float:
    """Twice the signed area of the triangle a b c; the sign is exact, the size is not."""
    left = (ax - cx) * (by - cy)
    right = (ay - cy) * (bx - cx)
    det = left - right
    if abs(det) >= ORIENT_BOUND * (abs(left) + abs(right)) and det != 0.0:
        return det
    return orient_exactly(ax, ay, bx, by, cx, cy)


@njit()
def orient_exactly(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> float:
    """Sign of the triangle a b c, exact in every case short of overflow."""
    if (ax == bx and ay == by) or (bx == cx and by == cy) or (cx == ax and cy == ay):
        return 0.0
    left_1, left_2 = ax - cx, by - cy
    right_1, right_2 = ay - cy, bx - cx
    # Neighbouring coordinates mostly subtract without error; then two exact products decide.
    exact = difference_is_exact(ax, cx, left_1) and difference_is_exact(by, cy, left_2)
    exact = exact and difference_is_exact(ay, cy, right_1) and difference_is_exact(bx, cx, right_2)
    if exact:
        left, left_tail = exact_product(left_1, left_2)
        right, right_tail = exact_product(right_1, right_2)
        return left - right if left != right else left_tail - right_tail
    terms = np.empty(12)
    terms[0], terms[1] = exact_product(ax, by)
    terms[2], terms[3] = exact_product(-ay, bx)
    terms[4], terms[5] = exact_product(bx, cy)
    terms[6], terms[7] = exact_product(-by, cx)
    terms[8], terms[9] = exact_product(cx, ay)
    terms[10], terms[11] = exact_product(-cy, ax)
    return exact_sum_sign(terms)


@njit(borrows=True)
def difference_is_exact(a: float, b: float, difference: float) -> bool:
    """Whether ``difference``, the rounded a - b, is a - b itself."""
    b_virtual = a - difference
    return (a - (difference + b_virtual)) + (b_virtual - b) == 0.0


@njit(borrows=True)
def exact_product(a: float, b: float) -> tuple[float, float]:
    """Return a b as a rounded product and its rounding error."""
    product = a * b
    carry = SPLITTER * a
    a_high = carry - (carry - a)
    a_low = a - a_high
    carry = SPLITTER * b
    b_high = carry - (carry - b)
    b_low = b - b_high
    error = product - a_high * b_high - a_low * b_high - a_high * b_low
    return product, a_low * b_low - error


@njit()
def exact_sum_sign(terms: Floats) -> float:
    """Sign of a sum of numbers, by growing an expansion whose parts do not overlap."""
    expansion = np.zeros(terms.size)
    for count in range(terms.size):
        carry = terms[count]
        for i in range(count):
            part = expansion[i]
            total = carry + part
            virtual = total - carry
            expansion[i] = (carry - (total - virtual)) + (part - virtual)
            carry = total
        expansion[count] = carry
    for i in range(terms.size - 1, -1, -1):
        if expansion[i] != 0.0:
            return expansion[i]
    return 0.0


@njit(borrows=True)
def in_circle(
    ax: float, ay: float, bx: float, by: float, cx: float, cy: float, px: float, py: float
) -> float:
    """Positive if p is inside the circle through a, b, c (a left turn), negative if outside.

    0 where p is too near to the circle to tell in plain floating point: the answer only affects
    the quality of a triangulation. A flip that a positive answer asks for is always possible.
    """
    ax, ay, bx, by, cx, cy = ax - px, ay - py, bx - px, by - py, cx - px, cy - py
    bc_1, bc_2 = bx * cy, cx * by
    ca_1, ca_2 = cx * ay, ax * cy
    ab_1, ab_2 = ax * by, bx * ay
    aa, bb, cc = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    det = aa * (bc_1 - bc_2) + bb * (ca_1 - ca_2) + cc * (ab_1 - ab_2)
    # As |bx cy| + |cx by| <= (bb + cc) / 2, this is at least what is asked below, and mostly does.
    if abs(det) > QUICK_BOUND * (aa * bb + bb * cc + cc * aa):
        return det
    size = (
        aa * (abs(bc_1) + abs(bc_2)) + bb * (abs(ca_1) + abs(ca_2)) + cc * (abs(ab_1) + abs(ab_2))
    )
    return det if abs(det) > CIRCLE_BOUND * size else 0.0
