r"""The lower envelope of points that move on the auxiliary curve while P walks along one side.

t       where P is on its side a b of the main curve: 0 at a, 1 at b
u, v    ends of a side of the auxiliary curve, or of another boundary side with an end on it
n / m   where a moving point E is on it, at u + (n / m) (v - u); n and m are linear in t

    u ------E-----------F------- v     E   GRAZE: moves as a quotient of linear functions
             .          :              F   FOOT: moves linearly, as does LIMIT; VERTEX rests
              .  V      :
               .        :
    a -------- P -------P ------ b

So the squared distance |m (P - u) - n (v - u)|^2 / m^2 is a quotient of polynomials, and so is
the difference of two; where they tie is a root of a polynomial of degree six at most.
Everything is in lengths. A *motion* is one row of a table; its neighbours are handed over with it,
since rows of their own would be slower than what is done with them.
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.bernstein import DEGREE, roots_inside
from midrib.kernels.boxtree import FOOT, GRAZE, VERTEX
from midrib.kernels.jit import njit
from midrib.types import Floats, Ints

__all__ = [
    "SLIVER",
    "Motions",
    "Walk",
    "farthest_between",
    "has_room",
    "is_lower",
    "is_same_motion",
    "lower_by",
    "new_motions",
    "place_at",
    "squared_distance",
    "where_farther",
]

MOST_OFFERS = 64
SLIVER = 2.0**-40  # of a side, or of a whole curve: what is shorter is rounding
MOST_TIES = 24  # of two motions: six, and what rounding makes of double ones
FROM, TO, N, M, U, RUN, FARTHEST = 0, 1, 2, 4, 6, 8, 10
SIDE, KIND, GRAZED, FIRST_END, LAST_END = 0, 1, 2, 3, 4


class Walk(NamedTuple):
    """P walks from vertex a to vertex b, the ends of one side."""

    a: int
    b: int
    ax: float
    ay: float
    bx: float
    by: float


class Motions(NamedTuple):
    """Rows: the envelope in order of t, room for the next one of the same size, offers."""

    row: Floats  # from, to, n at 0 and 1, m at 0 and 1, u, v - u, square of the largest distance
    at: Ints  # side, kind, vertex (of a VERTEX itself, of a GRAZE the one that is grazed), u, v
    work: Floats  # vectors of two motions, coefficients, ties; then parts of a polynomial
    base: int  # where the next one begins


@njit()
def new_motions(base: int) -> Motions:
    """Empty tables for so many pieces."""
    rows = 2 * base + MOST_OFFERS
    return Motions(
        np.empty((rows, 11)), np.empty((rows, 5), np.intp), np.empty((72, MOST_TIES)), base
    )


@njit(borrows=True)
def has_room(base: int, count: int) -> bool:
    """Whether tables are large enough to lower so many pieces by another motion."""
    return (MOST_TIES + 4) * (count + 1) <= base


# -- one moving point ------------------------------------------------------------------------------


@njit(borrows=True)
def place_at(row: Floats, k: int, t: float) -> float:
    """Where a moving point is on its side: 0 at u, 1 at v."""
    n = row[k, 2] + t * (row[k, 3] - row[k, 2])
    m = row[k, 4] + t * (row[k, 5] - row[k, 4])
    return min(max(n / m, 0.0), 1.0)


@njit(borrows=True)
def vectors_of(walk: Walk, row: Floats, k: int, a: float, b: float, out: Floats, i: int) -> bool:
    """Write Bernstein coefficients of m (P - u) - n (v - u) from a to b, and of m, as row i.

    Three points and two numbers. Return whether m is one, so that it is linear: then the first two
    points are all there is.
    """
    from_x, from_y = walk.ax - row[k, 6], walk.ay - row[k, 7]
    run_x, run_y, dx, dy = walk.bx - walk.ax, walk.by - walk.ay, row[k, 8], row[k, 9]
    px, py, qx, qy = from_x + a * run_x, from_y + a * run_y, from_x + b * run_x, from_y + b * run_y
    n_a, n_b = row[k, 2] + a * (row[k, 3] - row[k, 2]), row[k, 2] + b * (row[k, 3] - row[k, 2])
    if row[k, 4] == 1.0 and row[k, 5] == 1.0:
        out[i, 0], out[i, 1] = px - n_a * dx, py - n_a * dy
        out[i, 2], out[i, 3] = qx - n_b * dx, qy - n_b * dy
        return True
    m_a, m_b = row[k, 4] + a * (row[k, 5] - row[k, 4]), row[k, 4] + b * (row[k, 5] - row[k, 4])
    n = (n_a + n_b) / 2.0
    out[i, 0], out[i, 1] = m_a * px - n_a * dx, m_a * py - n_a * dy
    out[i, 2], out[i, 3] = (
        (m_a * qx + m_b * px) / 2.0 - n * dx,
        (m_a * qy + m_b * py) / 2.0 - n * dy,
    )
    out[i, 4], out[i, 5] = m_b * qx - n_b * dx, m_b * qy - n_b * dy
    out[i, 6], out[i, 7] = m_a, m_b
    return False


@njit(borrows=True)
def as_quadratic(w: Floats, i: int) -> None:
    """Raise the vectors of a plain point to those of one with m = 1."""
    w[i, 4], w[i, 5] = w[i, 2], w[i, 3]
    w[i, 2], w[i, 3] = (w[i, 0] + w[i, 4]) / 2.0, (w[i, 1] + w[i, 5]) / 2.0
    w[i, 6] = w[i, 7] = 1.0


@njit(borrows=True)
def squared_distance(walk: Walk, row: Floats, k: int, t: float) -> float:
    """Squared distance from P to a moving point."""
    share = place_at(row, k, t)
    ex = row[k, 6] - walk.ax - t * (walk.bx - walk.ax) + share * row[k, 8]
    ey = row[k, 7] - walk.ay - t * (walk.by - walk.ay) + share * row[k, 9]
    return ex * ex + ey * ey


@njit(borrows=True)
def bound_distance(walk: Walk, row: Floats, k: int) -> float:
    """Bound of the squared distance over the whole piece; it is reached unless the point grazes."""
    if row[k, 4] == 1.0 and row[k, 5] == 1.0:  # convex in t
        return max(
            squared_distance(walk, row, k, row[k, 0]), squared_distance(walk, row, k, row[k, 1])
        )
    most = 0.0
    for i in range(4):
        t, share = row[k, i % 2], float(i // 2)
        ex = row[k, 6] - walk.ax - t * (walk.bx - walk.ax) + share * row[k, 8]
        ey = row[k, 7] - walk.ay - t * (walk.by - walk.ay) + share * row[k, 9]
        most = max(most, ex * ex + ey * ey)
    return most


@njit(borrows=True)
def is_lower(walk: Walk, row: Floats, work: Floats, count: int, k: int) -> bool:
    """Cut a motion to where it may be nearer than the envelope; whether something is left.

    Grazes are left whole.
    """
    if not vectors_of(walk, row, k, row[k, 0], row[k, 1], work, 0):
        return True
    x, y = work[0, 0], work[0, 1]
    dx, dy = work[0, 2] - x, work[0, 3] - y
    length_squared = dx * dx + dy * dy
    if length_squared > 0.0:
        share = min(max(-(x * dx + y * dy) / length_squared, 0.0), 1.0)
        x, y = x + share * dx, y + share * dy
    row[k, 0], row[k, 1] = where_farther(row, count, row[k, 0], row[k, 1], x * x + y * y)
    return row[k, 0] < row[k, 1]


# -- two of them -----------------------------------------------------------------------------------


@njit(borrows=True)
def is_same_motion(row: Floats, at: Ints, i: int, other: Floats, other_at: Ints, j: int) -> bool:
    """Whether two pieces are parts of one motion."""
    kind = at[i, KIND]
    if kind != other_at[j, KIND] or at[i, GRAZED] != other_at[j, GRAZED]:
        return False
    if kind == VERTEX:
        return True
    if at[i, SIDE] != other_at[j, SIDE]:
        return False
    return kind in (FOOT, GRAZE) or (row[i, 2] == other[j, 2] and row[i, 3] == other[j, 3])


@njit(borrows=True)
def always_nearer(at: Ints, i: int, j: int) -> bool:
    """Whether i is nearer than j without computing: a foot, and any point of the same side.

    They touch where the one becomes the other, and rounding would cut that to pieces.
    """
    if at[i, KIND] != FOOT:
        return False
    if at[j, KIND] == VERTEX:
        return at[i, FIRST_END] == at[j, GRAZED] or at[i, LAST_END] == at[j, GRAZED]
    return at[i, SIDE] == at[j, SIDE]


@njit(borrows=True)
def ties_between(walk: Walk, row: Floats, work: Floats, i: int, j: int, a: float, b: float) -> int:
    """Write the t from a to b at which two motions tie as row 3 of ``work``; their number."""
    is_plain = vectors_of(walk, row, i, a, b, work, 0)
    other_is_plain = vectors_of(walk, row, j, a, b, work, 1)
    degree = 2
    if is_plain and other_is_plain:
        for k in range(3):
            p, q = 2 * (k // 2), 2 * ((k + 1) // 2)
            work[2, k] = (
                work[0, p] * work[0, q]
                + work[0, p + 1] * work[0, q + 1]
                - work[1, p] * work[1, q]
                - work[1, p + 1] * work[1, q + 1]
            )
    else:
        degree = DEGREE
        if is_plain:
            as_quadratic(work, 0)
        if other_is_plain:
            as_quadratic(work, 1)
        for k in range(DEGREE + 1):
            work[2, k] = 0.0
        add_product(work, 0, work[1, 6], work[1, 7], 1.0)
        add_product(work, 1, work[0, 6], work[0, 7], -1.0)
    return roots_inside(work, 2, degree, a, b, 3, 0)


@njit(borrows=True)
def add_product(w: Floats, i: int, m_a: float, m_b: float, sign: float) -> None:
    """Add the square of a quadratic vector times the square of a linear m to the polynomial."""
    s0 = w[i, 0] * w[i, 0] + w[i, 1] * w[i, 1]
    s1 = w[i, 0] * w[i, 2] + w[i, 1] * w[i, 3]
    middle = w[i, 2] * w[i, 2] + w[i, 3] * w[i, 3]
    s2 = (w[i, 0] * w[i, 4] + w[i, 1] * w[i, 5] + 2.0 * middle) / 3.0
    s3 = w[i, 2] * w[i, 4] + w[i, 3] * w[i, 5]
    s4 = w[i, 4] * w[i, 4] + w[i, 5] * w[i, 5]
    q0, q1, q2 = sign * m_a * m_a, sign * m_a * m_b, sign * m_b * m_b
    w[2, 0] += s0 * q0
    w[2, 1] += (4.0 * s1 * q0 + 2.0 * s0 * q1) / 6.0
    w[2, 2] += (6.0 * s2 * q0 + 8.0 * s1 * q1 + s0 * q2) / 15.0
    w[2, 3] += (4.0 * s3 * q0 + 12.0 * s2 * q1 + 4.0 * s1 * q2) / 20.0
    w[2, 4] += (s4 * q0 + 8.0 * s3 * q1 + 6.0 * s2 * q2) / 15.0
    w[2, 5] += (2.0 * s4 * q1 + 4.0 * s3 * q2) / 6.0
    w[2, 6] += s4 * q2


# -- all of them -----------------------------------------------------------------------------------


@njit(borrows=True)
def farthest_between(row: Floats, count: int, a: float, b: float) -> float:
    """Bound of the envelope's squared distance from a to b, inf where it has no piece.

    Gaps of a sliver do not count: what is seen from there only is left out in the end, and nobody
    has to search the whole area for it.
    """
    reached, most = a + SLIVER, 0.0
    for k in range(first_piece(row, count, a), count):
        if row[k, 1] <= a:
            continue
        if row[k, 0] > reached or reached >= b:
            break
        most, reached = max(most, row[k, 10]), row[k, 1] + SLIVER
    return most if reached >= b else np.inf


@njit(borrows=True)
def where_farther(row: Floats, count: int, a: float, b: float, least: float) -> tuple[float, float]:
    """Return what is left of a to b without its ends in which the envelope is nearer than least.

    Nothing is left where no more than a sliver is.
    """
    k = first_piece(row, count, a)
    while k < count and row[k, 0] <= a + SLIVER and a < b and row[k, 10] < least:
        a, k = max(a, row[k, 1]), k + 1
    k = min(first_piece(row, count, b), count - 1)
    while k >= 0 and row[k, 1] >= b - SLIVER and a < b and row[k, 10] < least:
        b, k = min(b, row[k, 0]), k - 1
    return (a, b) if b - a > SLIVER else (b, b)


@njit(borrows=True)
def put(
    walk: Walk, row: Floats, at: Ints, base: int, count: int, a: float, b: float, k: int
) -> int:
    """Append a part of motion k to the next envelope, or lengthen its last piece; the new count."""
    if not a < b:
        return count
    last = count - 1
    if count > base and row[last, 1] == a and is_same_motion(row, at, last, row, at, k):
        row[last, 1] = b
        row[last, 10] = bound_distance(walk, row, last)
        return count
    row[count, 0], row[count, 1] = a, b
    for column in range(2, 10):
        row[count, column] = row[k, column]
    for column in range(5):
        at[count, column] = at[k, column]
    is_whole = k < base and a == row[k, 0] and b == row[k, 1]
    row[count, 10] = row[k, 10] if is_whole else bound_distance(walk, row, count)
    return count + 1


@njit(borrows=True)
def lower_by(walk: Walk, row: Floats, at: Ints, work: Floats, base: int, count: int, i: int) -> int:
    """Lower the envelope by motion i from where it begins to where it ends; the new count.

    Only the pieces that it meets are written anew; those behind them are moved.
    """
    low, high, total = row[i, 0], row[i, 1], base
    first = first_piece(row, count, low)
    if first < count and row[first, 1] == low and not is_same_motion(row, at, first, row, at, i):
        first += 1
    last = first
    while last < count and row[last, 0] < high:
        last += 1
    if last < count and row[last, 0] == high and is_same_motion(row, at, last, row, at, i):
        last += 1
    if first == last:
        for k in range(count - 1, first - 1, -1):
            copy_motion(row, at, k, k + 1)
        copy_motion(row, at, i, first)
        row[first, 10] = bound_distance(walk, row, first)
        return count + 1
    for k in range(first, last + 1):
        # 1. Pieces before and behind stay; what nothing covers is new.
        a, b = (row[k, 0], row[k, 1]) if k < last else (high, high)
        if b > low:
            total = put(walk, row, at, base, total, low, min(a, high), i)
        if k == last:
            break
        total = put(walk, row, at, base, total, a, min(b, max(a, low)), k)
        # 2. Where both are there, the nearer one stays, from tie to tie.
        start, stop = max(a, low), min(b, high)
        if start < stop:
            total = put_nearer(walk, row, at, work, base, total, start, stop, k, i)
        total = put(walk, row, at, base, total, max(a, min(b, stop)), b, k)
        low = max(low, stop)
    # 3. The new ones take the place of the old ones.
    more = first + total - base - last
    if more > 0:
        for k in range(count - 1, last - 1, -1):
            copy_motion(row, at, k, k + more)
    elif more < 0:
        for k in range(last, count):
            copy_motion(row, at, k, k + more)
    for k in range(total - base):
        copy_motion(row, at, base + k, first + k)
    return count + more


@njit(borrows=True)
def copy_motion(row: Floats, at: Ints, k: int, to: int) -> None:
    """Copy a row of the tables."""
    for column in range(11):
        row[to, column] = row[k, column]
    for column in range(5):
        at[to, column] = at[k, column]


@njit(borrows=True)
def first_piece(row: Floats, count: int, t: float) -> int:
    """Return the first piece that does not end before t; their number if there is none."""
    first, last = 0, count
    while first < last:
        middle = (first + last) // 2
        if row[middle, 1] < t:
            first = middle + 1
        else:
            last = middle
    return first


@njit(borrows=True)
def put_nearer(
    walk: Walk,
    row: Floats,
    at: Ints,
    work: Floats,
    base: int,
    total: int,
    start: float,
    stop: float,
    i: int,
    j: int,
) -> int:
    """Append the nearer of two motions, from tie to tie; the new count."""
    ties = 0
    is_first = is_same_motion(row, at, i, row, at, j) or always_nearer(at, i, j)
    is_decided = is_first or always_nearer(at, j, i)
    if not is_decided:
        ties = ties_between(walk, row, work, i, j, start, stop)
    a = start
    for k in range(ties + 1):
        b = work[3, k] if k < ties else stop
        if not a < b:
            continue
        if not is_decided:
            t = (a + b) / 2.0
            is_first = squared_distance(walk, row, i, t) <= squared_distance(walk, row, j, t)
        total = put(walk, row, at, base, total, a, b, i if is_first else j)
        a = b
    return total
