"""Nearest points of chains against trying every segment."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from midrib.kernels import boxtree as kernels
from midrib.kernels.boxtree import FOOT, LIMIT, VERTEX
from tests.kernels.calling import callable_from_python

box_tree = callable_from_python(kernels.box_tree)
nearest_on_chain = callable_from_python(kernels.nearest_on_chain)
nearest_share = callable_from_python(kernels.nearest_share)

Floats = NDArray[np.float64]
pairs = st.tuples(st.integers(-20, 20), st.integers(-20, 20))


def chain_of(points: list[tuple[int, int]]) -> tuple[Floats, Floats, Floats]:
    """Coordinates and arc lengths of a chain without repeats in a row."""
    kept = [p for i, p in enumerate(points) if i == 0 or p != points[i - 1]]
    x, y = np.array(kept, dtype=np.float64).T.copy()
    return x, y, np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])


def plain_share(
    p: tuple[float, float], a: tuple[float, float], b: tuple[float, float],
    first: float, last: float,
) -> tuple[float, int]:  # fmt: skip
    """Share of the segment a b, case by case, and its kind: VERTEX at first, LIMIT at last."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    squared = dx * dx + dy * dy
    foot = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / squared if squared > 0.0 else 0.0
    if foot <= first:
        return first, VERTEX
    return (last, LIMIT) if foot >= last else (foot, FOOT)


@given(
    p=pairs, a=pairs, b=pairs, shares=st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)),
    is_cut=st.booleans(),
)  # fmt: skip
@settings(max_examples=400)
def test_shares_are_bit_by_bit_those_of_the_plain_cases(
    p: tuple[int, int],
    a: tuple[int, int],
    b: tuple[int, int],
    shares: tuple[float, float],
    is_cut: bool,
) -> None:
    first, last = sorted(shares) if is_cut else (0.0, 1.0)
    at, start, stop = ((x / 3.0, y / 3.0) for x, y in (p, a, b))
    share, kind = nearest_share(*at, *start, *stop, first, last, VERTEX, LIMIT)
    expected, expected_kind = plain_share(at, start, stop, first, last)
    assert (share.hex(), int(kind)) == (expected.hex(), expected_kind)


def test_a_repeated_vertex_is_its_own_foot() -> None:
    assert nearest_share(5.0, 3.0, 1.0, 1.0, 1.0, 1.0, 0.0, 1.0, VERTEX, LIMIT) == (0.0, VERTEX)


def by_tree(
    p: tuple[float, float], chain: tuple[Floats, Floats, Floats], low: float, high: float,
    reach: float = np.inf,
) -> tuple[float, int, bool] | None:  # fmt: skip
    """Arc length and kind of the nearest point, and whether others are as near."""
    x, y, arc = chain
    stack = np.empty(128, dtype=np.intp)
    j, share, kind, squared, is_tie = nearest_on_chain(
        *p, x, y, arc, box_tree(x, y), low, high, reach, 1e-9, stack
    )
    if j < 0:
        return None
    place = x[j] + share * (x[j + 1] - x[j]) - p[0], y[j] + share * (y[j + 1] - y[j]) - p[1]
    assert squared == pytest.approx(place[0] ** 2 + place[1] ** 2)
    return float(arc[j] + share * np.diff(arc)[j]), int(kind), bool(is_tie)


def by_force(
    p: tuple[float, float], chain: tuple[Floats, Floats, Floats], low: float, high: float
) -> list[float]:
    """Arc lengths of the nearest points."""
    x, y, arc = chain
    found = []
    for j in range(x.size - 1):
        first, last = max(low, arc[j]), min(high, arc[j + 1])
        if first > last:
            continue
        length = arc[j + 1] - arc[j]
        ux, uy = (x[j + 1] - x[j]) / length, (y[j + 1] - y[j]) / length
        along = (p[0] - x[j]) * ux + (p[1] - y[j]) * uy
        at = min(max(arc[j] + along, first), last)
        qx, qy = x[j] + (at - arc[j]) * ux, y[j] + (at - arc[j]) * uy
        found.append((np.hypot(qx - p[0], qy - p[1]), at))
    best = min((d for d, _ in found), default=np.inf)
    ordered = np.sort([at for d, at in found if d <= best + 1e-9])
    return [float(at) for i, at in enumerate(ordered) if i == 0 or at > ordered[i - 1] + 1e-9]


@given(points=st.lists(pairs, min_size=2, max_size=60), p=pairs)
@settings(max_examples=400)
def test_the_nearest_point_is_that_of_all_segments(
    points: list[tuple[int, int]], p: tuple[int, int]
) -> None:
    chain = chain_of([*points, (99, 99)])
    found = by_tree((float(p[0]), float(p[1])), chain, -np.inf, np.inf)
    expected = by_force(p, chain, -np.inf, np.inf)
    assert found is not None
    assert min(abs(found[0] - at) for at in expected) < 1e-9
    assert found[2] == (len(expected) > 1)


@given(
    points=st.lists(pairs, min_size=2, max_size=40),
    p=pairs,
    shares=st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)),
)
@settings(max_examples=400)
def test_points_outside_the_limits_do_not_count(
    points: list[tuple[int, int]], p: tuple[int, int], shares: tuple[float, float]
) -> None:
    chain = chain_of([*points, (99, 99)])
    low, high = (share * chain[2][-1] for share in sorted(shares))
    found = by_tree((float(p[0]), float(p[1])), chain, low, high)
    expected = by_force(p, chain, low, high)
    assert (found is None) == (not expected)
    if found is not None:
        assert min(abs(found[0] - at) for at in expected) < 1e-6
        assert low - 1e-9 <= found[0] <= high + 1e-9
        assert found[1] in (FOOT, VERTEX, LIMIT)


def test_kinds_are_named() -> None:
    chain = chain_of([(0, 0), (10, 0)])
    assert by_tree((3.0, 2.0), chain, -np.inf, np.inf) == (3.0, FOOT, False)
    assert by_tree((-3.0, 2.0), chain, -np.inf, np.inf) == (0.0, VERTEX, False)
    assert by_tree((13.0, 2.0), chain, -np.inf, np.inf) == (10.0, VERTEX, False)
    assert by_tree((3.0, 2.0), chain, 4.0, np.inf) == (4.0, LIMIT, False)
    assert by_tree((9.0, 2.0), chain, 4.0, 5.0) == (5.0, LIMIT, False)


def test_nothing_is_found_beyond_reach() -> None:
    chain = chain_of([(0, 0), (10, 0)])
    assert by_tree((3.0, 2.0), chain, -np.inf, np.inf, reach=1.9) is None
    assert by_tree((3.0, 2.0), chain, -np.inf, np.inf, reach=2.0) == (3.0, FOOT, False)


@given(points=st.lists(pairs, min_size=2, max_size=70))
@settings(max_examples=100)
def test_boxes_hold_their_segments(points: list[tuple[int, int]]) -> None:
    x, y, _ = chain_of([*points, (99, 99)])
    boxes = box_tree(x, y)
    leaves = len(boxes) // 2
    for j in range(x.size - 1):
        node = leaves + j // 4
        while node >= 1:
            low_x, low_y, high_x, high_y = boxes[node]
            assert low_x <= min(x[j], x[j + 1])
            assert low_y <= min(y[j], y[j + 1])
            assert high_x >= max(x[j], x[j + 1])
            assert high_y >= max(y[j], y[j + 1])
            node //= 2
