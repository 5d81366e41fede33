"""What probes and searches leave out because it cannot matter, against all of it."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import LineString, Point

from midrib.kernels.banks import MANY, Bank, Banks, look_beside
from midrib.kernels.boxtree import DEPTH, box_tree
from midrib.kernels.glide import Ends
from midrib.kernels.probes import is_between_lines, worst_probe
from tests.kernels.calling import callable_from_python

Floats = NDArray[np.float64]
TOLERANCE = 1e-3
boxes_of, beside = callable_from_python(box_tree), callable_from_python(look_beside)
between_lines = callable_from_python(is_between_lines)
worst = callable_from_python(worst_probe)
line_of = st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), min_size=4, max_size=12)


def bank_of(points: Floats) -> Bank:
    """Bank along a polyline."""
    x, y = points[:, 0].copy(), points[:, 1].copy()
    goes_on = np.ones(len(x), np.bool_)
    goes_on[-1] = False
    return Bank(x, y, goes_on, boxes_of(x, y))


def banks_of(main: Floats, auxiliary: Floats) -> Banks:
    """Banks along two polylines."""
    window = np.array([[0, MANY], [0, MANY]])
    last, stack = np.zeros(2, np.intp), np.empty(DEPTH, np.intp)
    return Banks(bank_of(main), bank_of(auxiliary), 1e-12, last, window, True, stack)


def wedge() -> Banks:
    """Two straight banks, one beside the other, each of three segments."""
    steps = np.array([0.0, 2.0, 8.0, 10.0])
    main = np.column_stack([steps, -1.0 - 0.1 * steps])
    return banks_of(main, main * [1.0, -1.0])


def test_way_between_the_same_lines_is_good() -> None:
    at = np.array([1, 1])
    assert between_lines(wedge(), at, at, 3.0, 0.0, 7.0, 0.0, TOLERANCE)


@pytest.mark.parametrize(
    ("first", "last", "p", "q"),
    [
        ([1, 1], [1, 2], (3.0, 0.0), (7.0, 0.0)),  # feet in different segments of the auxiliary
        ([0, 1], [1, 1], (3.0, 0.0), (7.0, 0.0)),  # of main
        ([1, 1], [1, 1], (1.0, 0.0), (7.0, 0.0)),  # p's foot is before the segment
        ([1, 1], [1, 1], (3.0, 0.0), (9.5, 0.0)),  # q's behind it
        ([1, 1], [1, 1], (3.0, 0.1), (7.0, 0.0)),  # p is not level
        ([1, 1], [1, 1], (3.0, 0.0), (7.0, -0.1)),  # q is not
    ],
)
def test_any_other_way_is_probed(
    first: list[int], last: list[int], p: tuple[float, float], q: tuple[float, float]
) -> None:
    assert not between_lines(wedge(), np.array(first), np.array(last), *p, *q, TOLERANCE)
    assert not between_lines(wedge(), np.array(first), np.array(last), *q, *p, TOLERANCE)


def test_exact_lines_are_probed_everywhere() -> None:
    at = np.array([1, 1])
    assert not between_lines(wedge(), at, at, 3.0, 0.0, 7.0, 0.0, 0.0)


@pytest.mark.parametrize("bump", [1.0, 3.5, 6.0, 8.0, 10.0, 12.5, 15.0])
def test_worst_probe_is_at_the_bump_wherever_it_is(bump: float) -> None:
    main = np.array([(0.0, -1.0), (16.0, -1.0)])
    auxiliary = np.array([(0.0, 1.0), (bump - 1, 1.0), (bump, 0.4), (bump + 1, 1.0), (17.0, 1.0)])
    nowhere = Ends(False, *[0.0] * 8)
    at, lean = worst(banks_of(main, auxiliary), nowhere, 0.0, 0.0, 16.0, 0.0, TOLERANCE)
    assert 16.0 * at == pytest.approx(bump, abs=0.5)
    assert lean.value > 0.0
    flat = banks_of(main, main * [1.0, -1.0])
    assert worst(flat, nowhere, 0.0, 0.0, 16.0, 0.0, TOLERANCE)[0] == -1.0


@given(points=line_of, px=st.floats(-3.0, 12.0), py=st.floats(-3.0, 12.0))
@settings(max_examples=200)
def test_segments_beside_the_nearest_point_hold_all_nearest_ones(
    points: list[tuple[int, int]], px: float, py: float
) -> None:
    line = np.array([p for i, p in enumerate(points) if i == 0 or p != points[i - 1]], float)
    assume(len(line) > 2)
    sides = [LineString(line[j : j + 2]) for j in range(len(line) - 1)]
    away = [side.distance(Point(px, py)) for side in sides]
    banks = banks_of(line, line)
    for j, radius in enumerate(away):
        beside(banks, j, px, py, radius)
        if radius > min(away) * (1.0 + 1e-9):
            assert banks.window.tolist() == [[0, MANY], [0, MANY]]
            continue
        low, high = banks.window[1]
        assert banks.window[0].tolist() == [0, MANY]
        q = sides[j].interpolate(sides[j].project(Point(px, py)))
        for share in (0.1, 0.5, 0.9):
            x = Point(px + share * (q.x - px), py + share * (q.y - py))
            least = min(side.distance(x) for side in sides[low:high])
            assert least <= min(side.distance(x) for side in sides) + 1e-9
        if len(sides) > 3 and 0.0 < radius == min(away):
            assert high - low <= 3
