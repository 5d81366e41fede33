"""What probes and searches leave out because it cannot matter, against all of it."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import LineString, Point

from midrib.kernels.banks import MANY, Bank, Banks
from midrib.kernels.boxtree import DEPTH, box_tree
from midrib.kernels.glide import Ends
from midrib.kernels.looking import look_beside, look_between
from midrib.kernels.probes import is_between_lines, worst_probe
from tests.kernels.calling import callable_from_python

Floats = NDArray[np.float64]
TOLERANCE = 1e-3
boxes_of, beside = callable_from_python(box_tree), callable_from_python(look_beside)
between = callable_from_python(look_between)
between_lines = callable_from_python(is_between_lines)
worst = callable_from_python(worst_probe)
line_of = st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), min_size=4, max_size=12)


def bank_of(*lines: Floats) -> Bank:
    """Bank along a polyline, its curve, and others, its islands."""
    x, y = np.concatenate(lines).T.copy()
    goes_on = np.ones(len(x), np.bool_)
    goes_on[np.cumsum([len(line) for line in lines]) - 1] = False
    return Bank(x, y, goes_on, boxes_of(x, y), len(lines[0]) - 1)


def banks_of(main: Floats, auxiliary: Floats, *islands: Floats) -> Banks:
    """Banks along two polylines; islands are main's."""
    window = np.array([[0, MANY], [0, MANY]])
    last, stack = np.zeros(2, np.intp), np.empty(DEPTH, np.intp)
    open_water = np.array([0.0, 0.0, 0.0 if islands else np.inf])
    bank = bank_of(main, *islands)
    others = bank_of(*islands) if islands else bank
    return Banks(bank, bank_of(auxiliary), 1e-12, last, window, True, others, open_water, stack)


def wedge() -> Banks:
    """Two straight banks, one beside the other, each of three segments."""
    steps = np.array([0.0, 2.0, 8.0, 10.0])
    main = np.column_stack([steps, -1.0 - 0.1 * steps])
    return banks_of(main, main * [1.0, -1.0])


def is_good(banks: Banks, first: list[int], last: list[int], *way: float) -> bool:
    """Whether the way need not be probed, where it is looked at between these segments."""
    at_p, at_q = np.array(first), np.array(last)
    between(banks, at_p, at_q, *way[:4])
    return bool(between_lines(banks, at_p, at_q, *way))


def test_way_between_the_same_lines_is_good() -> None:
    assert is_good(wedge(), [1, 1], [1, 1], 3.0, 0.0, 7.0, 0.0, TOLERANCE)


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
    assert not is_good(wedge(), first, last, *p, *q, TOLERANCE)
    assert not is_good(wedge(), last, first, *q, *p, TOLERANCE)


def test_exact_lines_are_probed_everywhere() -> None:
    assert not is_good(wedge(), [1, 1], [1, 1], 3.0, 0.0, 7.0, 0.0, 0.0)


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


def channel(*places: tuple[float, float]) -> Banks:
    """Banks two wide with a vertex each half, and a square island at each of these places."""
    main = np.column_stack([np.arange(81) / 2.0, np.full(81, -1.0)])
    square = np.array([(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1)])
    return banks_of(main, main * [1.0, -1.0], *(np.array(place) + square for place in places))


def test_way_in_open_water_is_looked_at_between_its_ends() -> None:
    banks = channel((5.0, 0.3), (30.0, -0.3))
    between(banks, np.array([30, 30]), np.array([32, 32]), 15.2, 0.0, 16.2, 0.0)
    assert banks.window.tolist() == [[29, 34], [29, 34]]
    assert banks.open_water == pytest.approx([15.7, 0.0, np.hypot(10.6, 0.2)])
    # The same circle does for a way beside; near the island there is none.
    between(banks, np.array([34, 34]), np.array([33, 33]), 17.2, 0.0, 16.7, 0.0)
    assert banks.window.tolist() == [[32, 36], [32, 36]]
    assert banks.open_water[0] == 15.7
    # Nor need one be sought a little farther on.
    for x in (29.2, 29.6):
        between(banks, np.array([58, 58]), np.array([59, 59]), x, 0.3, x + 0.5, 0.3)
        assert banks.window.tolist() == [[0, MANY], [0, MANY]]
        assert banks.open_water[0] == 29.45


def test_way_to_an_island_is_looked_at_everywhere() -> None:
    banks = channel((5.0, 0.0))
    banks.open_water[:] = 20.0, 0.0, 20.0
    between(banks, np.array([82, 40]), np.array([40, 40]), 20.2, 0.0, 20.4, 0.0)
    assert banks.window.tolist() == [[0, MANY], [0, MANY]]


@given(
    places=st.lists(st.tuples(st.floats(0.5, 39.5), st.floats(-0.8, 0.8)), max_size=4),
    x=st.floats(1.0, 36.0),
    span=st.floats(0.01, 3.0),
    off=st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)),
)
@settings(max_examples=300)
def test_nearest_points_of_a_way_are_where_it_is_looked(
    places: list[tuple[float, float]], x: float, span: float, off: tuple[float, float]
) -> None:
    banks = channel(*places)
    sides = [
        [LineString(np.column_stack([b.x, b.y])[j : j + 2]) if b.goes_on[j] else None
         for j in range(len(b.x) - 1)]
        for b in (banks.main, banks.auxiliary)
    ]  # fmt: skip

    def away(k: int, point: Point) -> list[float]:
        return [side.distance(point) if side else np.inf for side in sides[k]]

    p, q = Point(x, off[0]), Point(x + span, off[1])
    first, last = (np.array([np.argmin(away(k, end)) for k in range(2)]) for end in (p, q))
    between(banks, first, last, p.x, p.y, q.x, q.y)
    for share in (0.0, 0.2, 0.5, 0.7, 1.0):
        spot = Point(p.x + share * (q.x - p.x), p.y + share * (q.y - p.y))
        for k in range(2):
            found = away(k, spot)
            low, high = banks.window[k]
            assert min(found[low:high]) == pytest.approx(min(found), abs=1e-12)
