"""Paths without their loops."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import LineString

from midrib.kernels.loops import cut_loops

Floats = NDArray[np.float64]
ROUNDS = 20


def path_of(points: list[tuple[int, int]]) -> Floats:
    """A path without repeats in a row."""
    kept = [p for i, p in enumerate(points) if i == 0 or p != points[i - 1]]
    return np.array(kept, dtype=np.float64)


def cut(path: Floats) -> tuple[Floats, list[int], int]:
    """Cut once."""
    points, row, loops = cut_loops(path)
    return np.asarray(points), [int(r) for r in row], int(loops)


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        ([(0, 0), (4, 0), (4, 2), (2, 2), (2, -2)], [(0, 0), (2, 0), (2, -2)]),
        ([(0, 0), (2, 0), (1, 1), (1, -1)], [(0, 0), (1, 0), (1, -1)]),
        ([(0, 0), (2, 0), (2, 2), (0, 2), (0, 0), (-1, 0)], [(0, 0), (-1, 0)]),
        ([(0, 0), (4, 0), (4, 4), (2, 0), (2, -3)], [(0, 0), (2, 0), (2, -3)]),
        ([(0, 0), (5, 0), (3, 0)], [(0, 0), (3, 0)]),
    ],
)
def test_known_loops_are_cut(
    points: list[tuple[int, int]], expected: list[tuple[int, int]]
) -> None:
    path = path_of(points)
    for _ in range(ROUNDS):
        path, _, loops = cut(path)
        if not loops:
            break
    found = LineString(path)
    assert found.is_simple
    assert found.normalize().simplify(0.0).equals(LineString(expected).simplify(0.0))


@given(points=st.lists(st.tuples(st.integers(0, 12), st.integers(0, 12)), min_size=2, max_size=30))
@settings(max_examples=500)
def test_what_is_left_is_simple(points: list[tuple[int, int]]) -> None:
    path = path_of(points)
    if len(path) < 2 or (path[0] == path[-1]).all():
        return
    line, start, stop = LineString(path), path[0].copy(), path[-1].copy()
    for _ in range(ROUNDS):
        before = path
        path, row, loops = cut(path)
        kept = [r for r in row if r >= 0]
        assert kept == sorted(set(kept))
        for point, r in zip(path, row, strict=True):
            assert r < 0 or np.array_equal(point, before[r])
        if not loops:
            break
    assert loops == 0
    assert np.array_equal(path[0], start)
    assert np.array_equal(path[-1], stop)
    assert LineString(path).is_simple
    assert shapely.distance(shapely.points(path), line).max() <= 1e-12
    assert LineString(path).length <= line.length * (1.0 + 1e-12)


@given(points=st.lists(st.tuples(st.integers(0, 30), st.integers(0, 30)), min_size=2, max_size=12))
@settings(max_examples=300)
def test_simple_paths_stay_as_they_are(points: list[tuple[int, int]]) -> None:
    path = path_of(points)
    if len(path) < 2 or not LineString(path).is_simple or (path[0] == path[-1]).all():
        return
    found, row, loops = cut(path)
    assert loops == 0
    assert np.array_equal(found, path)
    assert row == list(range(len(path)))


def test_a_long_zigzag_has_no_loops() -> None:
    x = np.arange(20_000.0)
    path = np.column_stack([x, x % 2.0])
    found, _, loops = cut(path)
    assert loops == 0
    assert np.array_equal(found, path)


def test_a_path_up_and_down_has_its_loops_cut_too() -> None:
    """The longer axis of the path decides how pairs are sorted; here it is y."""
    path = path_of([(0, 0), (0, 9), (1, 9), (1, 4), (-1, 4), (-1, 20)])
    found, _, loops = cut(path)
    assert loops == 1
    assert found.tolist() == [[0, 0], [0, 4], [-1, 4], [-1, 20]]
