"""Nearest points of chains against trying every segment."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from midrib.kernels.boxtree import FOOT, LIMIT, VERTEX, box_tree, nearest_on_chain

Floats = NDArray[np.float64]
pairs = st.tuples(st.integers(-20, 20), st.integers(-20, 20))
ROOM = 256


def chain_of(points: list[tuple[int, int]]) -> tuple[Floats, Floats, Floats]:
    """Coordinates and arc lengths of a chain without repeats in a row."""
    kept = [p for i, p in enumerate(points) if i == 0 or p != points[i - 1]]
    x, y = np.array(kept, dtype=np.float64).T.copy()
    return x, y, np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])


def by_tree(
    p: tuple[float, float], chain: tuple[Floats, Floats, Floats], low: float, high: float,
    reach: float = np.inf,
) -> tuple[list[float], list[int]]:  # fmt: skip
    """Arc lengths and kinds of all points found that are as near as the nearest."""
    x, y, arc = chain
    segments, kinds = np.empty(ROOM, dtype=np.intp), np.empty(ROOM, dtype=np.intp)
    shares, squares = np.empty(ROOM), np.empty(ROOM)
    stack = np.empty(128, dtype=np.intp)
    count = nearest_on_chain(
        *p, x, y, arc, box_tree(x, y), low, high, reach, 1e-9,
        stack, segments, shares, kinds, squares,
    )  # fmt: skip
    assert count >= 0
    best = squares[:count].min(initial=np.inf)
    rows = [i for i in range(count) if squares[i] <= best + 1e-9]
    arcs = [arc[segments[i]] + shares[i] * np.diff(arc)[segments[i]] for i in rows]
    for i in rows:
        j, share = segments[i], shares[i]
        place = x[j] + share * (x[j + 1] - x[j]) - p[0], y[j] + share * (y[j + 1] - y[j]) - p[1]
        assert squares[i] == pytest.approx(place[0] ** 2 + place[1] ** 2)
    return [float(a) for a in arcs], [int(kinds[i]) for i in rows]


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
    return sorted(at for d, at in found if d <= best + 1e-9)


def distinct(arcs: list[float]) -> Floats:
    """Sorted arc lengths, equal ones once."""
    ordered = np.sort(np.array(arcs, dtype=np.float64))
    return ordered[np.concatenate([[True], np.diff(ordered) > 1e-9])] if ordered.size else ordered


@given(points=st.lists(pairs, min_size=2, max_size=60), p=pairs)
@settings(max_examples=400)
def test_nearest_points_are_those_of_all_segments(
    points: list[tuple[int, int]], p: tuple[int, int]
) -> None:
    chain = chain_of([*points, (99, 99)])
    arcs, _ = by_tree((float(p[0]), float(p[1])), chain, -np.inf, np.inf)
    assert distinct(arcs) == pytest.approx(distinct(by_force(p, chain, -np.inf, np.inf)))


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
    arcs, kinds = by_tree((float(p[0]), float(p[1])), chain, low, high)
    assert distinct(arcs) == pytest.approx(distinct(by_force(p, chain, low, high)), abs=1e-6)
    for at, kind in zip(arcs, kinds, strict=True):
        assert low - 1e-9 <= at <= high + 1e-9
        assert kind in (FOOT, VERTEX, LIMIT)


def test_kinds_are_named() -> None:
    chain = chain_of([(0, 0), (10, 0)])
    assert by_tree((3.0, 2.0), chain, -np.inf, np.inf) == ([3.0], [FOOT])
    assert by_tree((-3.0, 2.0), chain, -np.inf, np.inf) == ([0.0], [VERTEX])
    assert by_tree((13.0, 2.0), chain, -np.inf, np.inf) == ([10.0], [VERTEX])
    assert by_tree((3.0, 2.0), chain, 4.0, np.inf) == ([4.0], [LIMIT])
    assert by_tree((9.0, 2.0), chain, 4.0, 5.0) == ([5.0], [LIMIT])


def test_nothing_is_found_beyond_reach() -> None:
    chain = chain_of([(0, 0), (10, 0)])
    assert by_tree((3.0, 2.0), chain, -np.inf, np.inf, reach=1.9) == ([], [])
    assert by_tree((3.0, 2.0), chain, -np.inf, np.inf, reach=2.0) == ([3.0], [FOOT])


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
