"""Measures of strokes that are drawn by hand: closed forms, one fault at a time."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import LineString, Point, box

from midrib import Strip, hatch
from midrib.hatching import Rule
from midrib.hatching.finishing import Problem
from midrib.hatching.measures import (
    Measures,
    crossings,
    measure,
    measure_strokes,
    outside_of,
    untold,
)
from midrib.types import Floats
from tests.hatching.slopes import annulus, elbow, lens, rectangle, trapezium

WIDTH, GAP = 10.0, 5.0
TOP, TOE = LineString([(0, WIDTH), (100, WIDTH)]), LineString([(0, 0), (100, 0)])
MIDDLE = LineString([(0, WIDTH / 2.0), (100, WIDTH / 2.0)])
EVEN = np.arange(GAP, 100.0, GAP)


def measured(
    at_top: Floats = EVEN,
    at_toe: Floats | None = None,
    *,
    ends: dict[int, float] | None = None,
    is_turned: bool = False,
    **values: Any,
) -> Measures:
    """Measures of strokes between places on two level edges; ``ends`` are heights of some ends."""
    at_toe = at_top if at_toe is None else at_toe
    on_top = np.column_stack([at_top, np.full(len(at_top), WIDTH)])
    on_toe = np.column_stack([at_toe, np.zeros(len(at_toe))])
    stops = on_toe.copy()
    for row, y in (ends or {}).items():
        stops[row, 1] = y
    strokes = shapely.linestrings(np.stack([on_top, stops], axis=1))
    is_long = np.ones(len(strokes), dtype=bool)
    is_long[values.pop("short", [])] = False
    lines = (TOP, TOE, MIDDLE)
    top, toe, middle = (line.reverse() for line in lines) if is_turned else lines
    rule = Rule(**{"factor": 0.5} | values)
    return measure_strokes(Strip(top, toe), rule, middle, strokes, is_long, on_top, on_toe)


def test_even_strokes_have_no_fault() -> None:
    found = measured()
    assert (found.strokes, found.crossings, found.outside, found.short_of_edge) == (19, 0, 0.0, 0)
    assert found.spacing == pytest.approx(np.ones(18))
    assert found.stretch == pytest.approx(1.0)
    assert (found.top_gap, found.toe_gap, found.end_gap) == pytest.approx((1.0, 1.0, 1.0))
    assert found.least_foot == pytest.approx(1.0)
    assert found.turns == pytest.approx(np.zeros(18), abs=1e-9)
    assert found.tilts == pytest.approx(np.zeros(len(found.tilts)), abs=1e-9)
    assert len(found.tilts) > 10
    assert found.beyond == []


def test_gaps_are_counted_in_those_of_the_rule() -> None:
    found = measured(factor=0.4)  # asks for 4
    assert found.stretch == pytest.approx(1.25)
    assert found.spacing == pytest.approx(np.ones(18))
    assert (found.top_gap, found.end_gap, found.least_foot) == pytest.approx((1.25, 1.25, 1.25))


@pytest.mark.parametrize("is_turned", [False, True])
def test_a_stroke_that_is_moved_tells_where(is_turned: bool) -> None:
    places = EVEN.copy()
    places[7] += 2.0
    found = measured(places, is_turned=is_turned)
    steps = np.diff(places) / GAP
    assert found.spacing == pytest.approx(steps / steps.mean())
    assert found.top_gap == found.toe_gap == pytest.approx(1.4)
    assert found.least_foot == pytest.approx(0.6)
    assert sorted(round(excess.where.x, 6) for excess in found.beyond) == pytest.approx(
        sorted([(places[6] + places[7]) / 2.0, (places[7] + places[8]) / 2.0])
    )


@pytest.mark.parametrize("is_turned", [False, True])
def test_edges_have_gaps_of_their_own(is_turned: bool) -> None:
    at_toe = EVEN.copy()
    at_toe[7:] += 4.0
    found = measured(EVEN, at_toe, is_turned=is_turned)
    length = np.hypot(4.0, WIDTH)
    asked = 0.25 * (WIDTH + length)  # beside the change: the mean of both neighbours' gaps
    assert found.toe_gap == pytest.approx(9.0 / asked)
    assert found.top_gap == pytest.approx(1.0)
    turned = np.degrees(np.arctan(0.4))
    assert found.turns.max() == pytest.approx(turned)
    assert np.count_nonzero(found.turns > 1e-6) == 1
    assert found.tilts.max() == pytest.approx(turned)


def test_ends_of_the_slope_are_measured_to_the_next_stroke() -> None:
    assert measured(EVEN[2:]).end_gap == pytest.approx(3.0)
    assert measured(EVEN[:-1]).end_gap == pytest.approx(2.0)
    assert [excess.where.x for excess in measured(EVEN[2:]).beyond] == pytest.approx([0.0], abs=15)


def test_strokes_that_meet_are_counted() -> None:
    at_toe = EVEN.copy()
    at_toe[[7, 8]] = at_toe[[8, 7]]
    assert measured(EVEN, at_toe).crossings == 1
    at_toe[8] = at_toe[7]
    assert measured(EVEN, at_toe).crossings == 1
    fan = [LineString([(0, 0), (x, 9)]) for x in range(4)]
    assert crossings(np.array(fan)) == 6


def test_what_sticks_out_is_counted_in_strokes() -> None:
    assert measured(ends={3: -2.0}).outside == pytest.approx(0.2)
    assert measured(ends={3: -2.0, 8: -1.0}).outside == pytest.approx(0.3)
    assert measured(ends={3: -1e-9}).outside == 0.0


def test_whole_strokes_that_end_before_the_toe_are_counted() -> None:
    assert measured(ends={3: 1.0, 5: -1.0}).short_of_edge == 2
    assert measured(ends={3: 1.0, 5: 5.0}, short=[5]).short_of_edge == 1


def test_on_a_closed_slope_there_are_no_ends() -> None:
    found = measure(hatch(annulus()))
    assert found.end_gap == 0.0
    assert len(found.spacing) == found.strokes


def test_long_strokes_in_a_bay_ask_for_gaps_of_the_width_beside_it() -> None:
    """1.5 local widths at most: on 10 by 10 with a bay of 30, gaps of 7.5, not of 20."""
    toe = LineString([(0, 0), (45, 0), (45, -30), (55, -30), (55, 0), (100, 0)])
    on_top = np.array([[48.0, WIDTH], [52.0, WIDTH]])
    on_toe = np.array([[48.0, -30.0], [52.0, -30.0]])
    strokes = shapely.linestrings(np.stack([on_top, on_toe], axis=1))
    both = np.ones(2, dtype=bool)
    found = measure_strokes(Strip(TOP, toe), Rule(), MIDDLE, strokes, both, on_top, on_toe)
    local = 2.0 * np.hypot(3.0, 5.0)  # to the corners of the bay, which are farther than the top
    assert found.stretch == pytest.approx(4.0 / (0.5 * 1.5 * local))


def test_parts_outside_are_those_beyond_a_reach() -> None:
    area = box(0, 0, 10, 10)
    lines = [
        LineString([(1, 5), (1, 9)]),
        LineString([(2, -0.05), (2, 5)]),
        LineString([(3, -2), (3, 13)]),
        LineString([(0, 10), (10, 10)]),
        LineString([(-0.05, 5), (12, 5)]),
    ]
    parts, rows = outside_of(np.array(lines), area, 0.1)
    assert rows.tolist() == [2, 2, 4]
    assert sorted(shapely.length(parts)) == pytest.approx([2.0, 2.0, 3.0])
    parts, rows = outside_of(np.array(lines[:1]), area, 0.1)
    assert parts.size == rows.size == 0


def test_an_excess_is_told_by_a_problem_between_its_strokes_alone() -> None:
    hatching = hatch(rectangle(100.0, 10.0))
    places = hatching.on_top[:, 0].copy()
    places[7] += 2.0
    on_top = np.column_stack([places, hatching.on_top[:, 1]])
    on_toe = np.column_stack([places, hatching.on_toe[:, 1]])
    strokes = shapely.linestrings(np.stack([on_top, on_toe], axis=1))
    bad = replace(hatching, on_top=on_top, on_toe=on_toe, strokes=strokes, problems=[], ground=None)
    found = measure(bad)
    assert len(untold(bad, found)) == len(found.beyond) == 2
    for x, left in ((places[6] + 1.0, 1), (places[7], 0), (places[8] + 0.3, 1), (places[4], 2)):
        told = [Problem(where=Point(x, 5.0), reason="odd", kind="beyond")]
        assert len(untold(replace(bad, problems=told), found)) == left


def test_only_what_the_top_is_straight_beside_has_a_tilt() -> None:
    """On a bend every stroke is at right angles, and the top is nowhere straight for two widths."""
    angles = np.linspace(0.0, np.pi, 181)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    strip = Strip(LineString(20.0 * circle), LineString(30.0 * circle))
    assert measure(hatch(strip)).tilts.size == 0


@pytest.mark.parametrize("shape", [elbow, trapezium, lens])
def test_it_does_not_matter_which_way_the_edges_run(shape: Callable[[], Strip]) -> None:
    hatching = hatch(shape())
    assert hatching.ground is not None
    lines = [hatching.strip.main, hatching.strip.auxiliary, LineString(hatching.ground.middle.line)]
    strokes = hatching.strokes, hatching.is_long, hatching.on_top, hatching.on_toe
    forth = measure_strokes(Strip(*lines[:2]), hatching.rule, lines[2], *strokes)
    top, toe, middle = (line.reverse() for line in lines)
    back = measure_strokes(Strip(top, toe), hatching.rule, middle, *strokes)
    for name in ("spacing", "turns", "allowed", "tilts", "top_gap", "toe_gap", "least_foot"):
        one, other = (np.sort(np.atleast_1d(getattr(m, name))) for m in (forth, back))
        assert one == pytest.approx(other, abs=1e-9), name
    assert len(forth.beyond) == len(back.beyond)
