"""Signs against fractions."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from midrib.kernels import predicates as kernels
from tests.kernels.calling import callable_from_python

exact_product = callable_from_python(kernels.exact_product)
in_circle = callable_from_python(kernels.in_circle)
orient = callable_from_python(kernels.orient)

Pair = tuple[float, float]
coordinates = st.one_of(
    st.integers(-4, 4).map(float),
    st.integers(0, 40).map(lambda k: 0.5 + k * 2.0**-53),
    st.floats(-1e3, 1e3).map(lambda v: v if abs(v) > 1e-100 else 0.0),
    st.floats(5e6, 5e6 + 1e-6),
)
points = st.tuples(coordinates, coordinates)
powers = st.integers(-400, 400)


def sign(value: float | Fraction) -> int:
    """-1, 0 or 1."""
    return int(value > 0) - int(value < 0)


def clean(p: Pair) -> Pair:
    """The point without coordinates whose products are too small to be told from nothing."""
    return p[0] if abs(p[0]) > 1e-100 else 0.0, p[1] if abs(p[1]) > 1e-100 else 0.0


def exact_turn(a: Pair, b: Pair, c: Pair) -> int:
    """Side of c on the line a b."""
    (ax, ay), (bx, by), (cx, cy) = (tuple(Fraction(v) for v in p) for p in (a, b, c))
    return sign((ax - cx) * (by - cy) - (ay - cy) * (bx - cx))


def turn(a: Pair, b: Pair, c: Pair) -> int:
    """Side of c on the line a b, by the kernel."""
    return sign(float(orient(*a, *b, *c)))


@given(a=points, b=points, c=points)
@settings(max_examples=2000)
def test_orient_has_the_exact_sign(a: Pair, b: Pair, c: Pair) -> None:
    assert turn(a, b, c) == exact_turn(a, b, c)


@given(a=points, b=points, shares=st.tuples(st.integers(0, 64), st.integers(-3, 3)))
@settings(max_examples=2000)
def test_orient_has_the_exact_sign_beside_the_line(
    a: Pair, b: Pair, shares: tuple[int, int]
) -> None:
    """Points that rounding puts on the line, or some units in the last place off it."""
    share, off = shares[0] / 64.0, shares[1]
    a, b = clean(a), clean(b)
    x, y = a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
    c = x, y + off * float(np.spacing(abs(y) + 1e-9))
    assert turn(a, b, c) == exact_turn(a, b, c)


@given(i=st.integers(0, 255), j=st.integers(0, 255))
@settings(max_examples=1000)
def test_orient_on_the_grid_where_plain_arithmetic_fails(i: int, j: int) -> None:
    """L. Kettner et al., Classroom Examples of Robustness Problems, 2008, figure 2."""
    p = 0.5 + i * 2.0**-53, 0.5 + j * 2.0**-53
    assert turn(p, (12.0, 12.0), (24.0, 24.0)) == sign(j - i)  # above y = x is left of it


@given(a=points, b=points, c=points, power=powers)
@settings(max_examples=1000)
def test_orient_keeps_its_sign_when_scaled(a: Pair, b: Pair, c: Pair, power: int) -> None:
    small = [tuple(v if abs(v) > 1e-30 else 0.0 for v in p) for p in (a, b, c)]
    scaled = [(p[0] * 2.0**power, p[1] * 2.0**power) for p in small]
    assert turn(*scaled) == exact_turn(*small)  # type: ignore[arg-type]


@given(a=points, b=points, c=points)
@settings(max_examples=500)
def test_orient_changes_sign_when_two_points_swap(a: Pair, b: Pair, c: Pair) -> None:
    assert turn(a, b, c) == -turn(b, a, c) == -turn(a, c, b) == turn(b, c, a)


@given(a=st.floats(-1e100, 1e100), b=st.floats(-1e100, 1e100))
@settings(max_examples=500)
def test_a_product_and_its_error_are_exact(a: float, b: float) -> None:
    if 0.0 < abs(a) < 1e-100 or 0.0 < abs(b) < 1e-100:
        return
    product, error = exact_product(a, b)
    assert Fraction(product) + Fraction(error) == Fraction(a) * Fraction(b)


def exactly_inside(a: Pair, b: Pair, c: Pair, p: Pair) -> int:
    """1 if p is inside the circle through a, b, c, a left turn; 0 on it."""
    rows = []
    for q in (a, b, c):
        x, y = Fraction(q[0]) - Fraction(p[0]), Fraction(q[1]) - Fraction(p[1])
        rows.append((x, y, x * x + y * y))
    (ax, ay, aa), (bx, by, bb), (cx, cy, cc) = rows
    return sign(aa * (bx * cy - cx * by) + bb * (cx * ay - ax * cy) + cc * (ax * by - bx * ay))


@given(a=points, b=points, c=points, p=points)
@settings(max_examples=1000)
def test_in_circle_is_right_where_it_decides(a: Pair, b: Pair, c: Pair, p: Pair) -> None:
    if exact_turn(a, b, c) < 0:
        b, c = c, b
    answer = in_circle(*a, *b, *c, *p)
    assert answer == 0.0 or sign(Fraction(answer)) == exactly_inside(a, b, c, p)


@pytest.mark.parametrize(
    ("p", "expected"),
    [((1.0, 1.0), 1), ((0.0, 2.0), 0), ((2.0, 2.0), 0), ((3.0, 1.0), -1), ((1.999, 1.999), 1)],
)
def test_in_circle_of_a_right_triangle(p: Pair, expected: int) -> None:
    assert np.sign(in_circle(0.0, 0.0, 2.0, 0.0, 0.0, 2.0, *p)) == expected
