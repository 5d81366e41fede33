"""What each option does, and how wrong ones are refused."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon, box
from shapely.ops import nearest_points

from midrib import hatch, split, standard
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError
from midrib.hatching import Rule, add_stroke, delete_stroke, move_stroke
from midrib.hatching.rule import with_mean_gap
from midrib.strip import Strip
from tests.hatching.slopes import annulus, bend, lens, rectangle, ring, trapezium

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from hatch_slopes import one_random


def letters(**options: Any) -> str:
    """Pattern along the top of a rectangle, from left to right."""
    options = {"start": "first"} | options
    return "".join("L" if is_long else "S" for is_long in hatch(rectangle(), **options).is_long)


def test_patterns_repeat_from_the_start() -> None:
    assert letters() == ("LS" * 10)[:19]
    assert letters(pattern="LSS") == ("LSS" * 7)[:19]
    assert letters(pattern="LSSL") == ("LSSL" * 5)[:19]
    assert letters(pattern="L") == "L" * 19
    assert letters(first="short") == ("SL" * 10)[:19]
    assert letters(first="short", pattern="LSS") == ("SSL" * 7)[:19]


def test_the_pattern_may_start_on_either_side() -> None:
    """Seen down from a top that runs to the right above its toe, left is where x is largest."""
    pattern = ("LSS" * 7)[:19]
    assert (
        letters(pattern="LSS", start="left")
        == pattern[::-1]
        == letters(pattern="LSS", start="last")
    )
    assert letters(pattern="LSS", start="right") == pattern == letters(pattern="LSS", start="first")


def test_offset_and_ends() -> None:
    assert hatch(rectangle(), offset=0.5).on_top[[0, -1], 0] == pytest.approx([2.5, 97.5])
    assert hatch(rectangle(), end_strokes=True).on_top[[0, -1], 0] == pytest.approx([0.0, 100.0])
    assert letters(end_strokes=True) == ("LS" * 11)[:21]


@pytest.mark.parametrize("is_turned", [False, True])
def test_sides_that_the_toe_holds_have_strokes_too(is_turned: bool) -> None:
    top = LineString([(0, 10), (100, 10)])
    toe = LineString([(0, 10), (-2, 0), (104, 0), (100, 10)])
    edges = (shapely.reverse(edge) if is_turned else edge for edge in (top, toe))
    hatching = hatch(Strip(*edges), end_strokes=True)
    ends = sorted(
        zip(hatching.on_top[[0, -1]].tolist(), hatching.on_toe[[0, -1]].tolist(), strict=True)
    )
    assert ends == [([0, 10], [-2, 0]), ([100, 10], [104, 0])]
    assert hatching.on_toe[1:-1, 1] == pytest.approx(0.0)


def test_a_side_that_is_bent_has_no_stroke() -> None:
    toe = LineString([(0, 10), (1, 5), (0, 0), (100, 0), (100, 10)])
    hatching = hatch(Strip(LineString([(0, 10), (100, 10)]), toe), end_strokes=True)
    assert hatching.on_top[:, 0].min() > 1.0
    assert hatching.on_top[:, 0].max() == 100.0


@pytest.mark.parametrize("offset", [0.01, 0.2, 0.29])
def test_strokes_give_way_to_those_on_the_ends(offset: float) -> None:
    plain = hatch(rectangle(), end_strokes=True, offset=1.0)
    hatching = hatch(rectangle(), end_strokes=True, offset=offset)
    assert hatching.on_top[[0, -1], 0] == pytest.approx([0.0, 100.0])
    steps = np.diff(hatching.on_top[:, 0])
    assert steps.min() > 0.9 * np.diff(plain.on_top[:, 0]).min()
    told = sum("neighbours are" in problem.reason for problem in hatching.problems)
    assert told == len(hatching.problems) == np.count_nonzero(steps > 1.25 * 5.0)


def test_nothing_that_is_drawn_is_shorter_than_the_shortest_stroke() -> None:
    for least in (0.1, 0.18, 0.5):
        drawn = shapely.length(hatch(lens(), min_length=least, scale=500).strokes)
        assert drawn.min() >= 0.5 * least * (1.0 - 1e-9)


def test_necks_are_told() -> None:
    x = np.linspace(0.0, 60.0, 61)
    half = 3.0 * abs(np.cos(np.pi * x / 60.0)) + 0.02
    strip = Strip(LineString(np.column_stack([x, half])), LineString(np.column_stack([x, -half])))
    hatching = hatch(strip)
    assert any("narrower than the shortest stroke" in p.reason for p in hatching.problems)
    assert all(p.where.x == pytest.approx(30.0, abs=2.0) for p in hatching.problems)


def test_strokes_may_be_at_right_angles_to_the_top_alone() -> None:
    across = [
        np.diff(np.stack([h.on_top, h.on_toe]), axis=0)[0]
        for h in (hatch(trapezium(), top_share=share) for share in (0.0, 0.5, 1.0))
    ]
    tilts = [abs(np.degrees(np.arctan2(x, -y))) for x, y in (a.T for a in across)]
    slant = np.degrees(np.arctan(0.06))
    for tilt, share in zip(tilts, (0.0, 0.5, 1.0), strict=True):
        assert tilt == pytest.approx(np.full(tilt.size, slant / 2.0 * abs(1.0 - share)), abs=0.15)


def test_spacing_and_its_bounds() -> None:
    assert hatch(rectangle(), scale=1000, spacing=4.0).spacing == pytest.approx(np.full(23, 4.0))
    assert hatch(rectangle(), factor=1.0).spacing == pytest.approx(np.full(8, 10.0))
    assert hatch(rectangle(), scale=1000, min_spacing=10.0).spacing == pytest.approx(
        np.full(8, 10.0)
    )
    assert hatch(rectangle(), scale=1000, max_spacing=2.5).spacing == pytest.approx(
        np.full(38, 2.5)
    )
    feet = hatch(rectangle(), scale=1000, spacing=4.0, metres_per_unit=0.5)
    assert feet.spacing == pytest.approx(np.full(len(feet.spacing), 8.0), rel=0.05)


@pytest.mark.parametrize("least", [0.0, 0.7])
def test_a_standard_is_a_name_or_one_of_the_callers(least: float) -> None:
    mine = standard("pl-2021-slope-reinforced").with_values(
        spacing=5.0, min_spacing=least, pattern="LSS", short_ratio=0.3
    )
    hatching = hatch(rectangle(), mine, 1000)
    assert hatching.spacing == pytest.approx(np.full(18, 5.0))
    assert shapely.length(hatching.strokes[-3:]) == pytest.approx([3.0, 3.0, 10.0])


def test_figures_of_a_standard_for_other_scales_hold_there() -> None:
    apart = [hatch(rectangle(), "pl-2021-stairs", scale).spacing for scale in (500, 1000)]
    assert apart[0] == pytest.approx(np.full(len(apart[0]), 0.5))
    assert apart[1] == pytest.approx(np.full(len(apart[1]), 0.75), rel=0.005)


@pytest.mark.parametrize("ratio", [0.05, 0.33, 0.95])
def test_short_strokes_have_their_share(ratio: float) -> None:
    hatching = hatch(trapezium(), short_ratio=ratio)
    share = shapely.length(hatching.strokes) / hatching.width
    assert share == pytest.approx(np.where(hatching.is_long, 1.0, ratio))


def test_zones_hide_strokes_and_move_none() -> None:
    plain, zone = hatch(rectangle()), box(33, -1, 48, 4)
    hatching = hatch(rectangle(), exclude=zone)
    visible = ~shapely.intersects(plain.strokes, zone)
    assert 0 < np.count_nonzero(~visible) < 4  # short ones end above it
    assert (hatching.on_top == plain.on_top[visible]).all()
    assert (hatching.is_long == plain.is_long[visible]).all()
    assert plain.n_excluded == 0
    assert hatching.n_excluded == np.count_nonzero(~visible)
    assert len(hatch(rectangle(), exclude=[zone, box(80, 0, 85, 9)]).strokes) < len(
        hatching.strokes
    )


def test_stiffness_trades_turn_against_tilt() -> None:
    corner = Strip(
        LineString([(0, 10), (0, 70), (60, 70)]), LineString([(10, 10), (10, 60), (60, 60)])
    )
    turns = []
    for stiffness in (0.3, 0.9, 2.0):
        hatching = hatch(corner, stiffness=stiffness)
        angle = np.unwrap(np.arctan2(*(hatching.on_toe - hatching.on_top).T))
        turns.append(np.hypot.reduce(np.diff(angle)))  # the worst is within its bound anyway
    assert turns[0] > turns[1] > turns[2]


def test_closed_tops_start_at_a_vertex() -> None:
    strip = annulus(10.0, 16.0, 24)
    first = hatch(strip, start="first", offset=1e-6)
    assert first.on_top[np.flatnonzero(first.is_long)] == pytest.approx(
        np.roll(first.on_top[first.is_long], 0, axis=0)
    )
    near = np.hypot(*(first.on_top - strip.main.coords[0]).T)
    assert near.min() < 0.05
    assert first.is_long[np.argmin(near)]


# -- editing ---------------------------------------------------------------------------------------


def test_an_added_stroke_goes_through_its_point() -> None:
    hatching = hatch(bend())
    at = Point(0.0, 27.0)
    more = add_stroke(hatching, at, is_long=False)
    row = int(np.argmin(abs(np.degrees(np.arctan2(*more.on_top.T)))))
    whole = LineString([more.on_top[row], more.on_toe[row]])
    assert whole.distance(at) < 1e-9
    assert len(more.strokes) == len(hatching.strokes) + 1
    assert not more.is_long[row]
    assert (np.diff(np.arctan2(*more.on_top.T)) < 0.0).all()
    assert more.spacing.sum() == pytest.approx(hatching.spacing.sum())
    less = delete_stroke(more, row)
    assert (less.on_top == hatching.on_top).all()
    assert less.spacing == pytest.approx(hatching.spacing)


@pytest.mark.parametrize("seed", [3002, 3005])
def test_added_strokes_go_between_their_neighbours(seed: int) -> None:
    """Where strokes are placed anew, in other directions than calm ones, too."""
    hatching = hatch(one_random("deep", seed).strip)
    whole = hatching.on_toe - hatching.on_top
    way = np.degrees(np.unwrap(np.arctan2(whole[:, 1], whole[:, 0])))
    middle = (hatching.on_top + hatching.on_toe) / 2.0
    for i, at in enumerate((middle[1:] + middle[:-1]) / 2.0):
        if not hatching.strip.area.covers(Point(at)):
            continue  # beyond the wall of a bay
        more = add_stroke(hatching, tuple(at))
        assert (np.delete(more.on_top, i + 1, axis=0) == hatching.on_top).all()
        x, y = (more.on_toe - more.on_top)[i + 1]
        off = (np.degrees(np.arctan2(y, x)) - way[i : i + 2] + 180.0) % 360.0 - 180.0
        assert off.min() <= 0.5
        assert off.max() >= -0.5


@pytest.mark.parametrize("ratio", [0.3, 0.5])
def test_an_added_stroke_is_as_long_as_its_kind(ratio: float) -> None:
    hatching = hatch(rectangle(), short_ratio=ratio)
    for is_long in (True, False):
        more = add_stroke(hatching, (21.5, 10.0), is_long=is_long)
        (row,) = np.flatnonzero(abs(more.on_top[:, 0] - 21.5) < 1e-9)
        share = shapely.length(more.strokes[row]) / more.width[row]
        assert share == pytest.approx(1.0 if is_long else ratio)


def test_strokes_that_would_end_on_a_side_are_refused() -> None:
    """Beside the slanted ends of a slope."""
    strip = Strip(LineString([(0, 10), (100, 10)]), LineString([(40, 0), (140, 0)]))
    hatching = hatch(strip)
    for at in ((2.0, 9.0), (138.0, 1.0)):
        with pytest.raises(ParameterError, match="no stroke of the slope leads through"):
            add_stroke(hatching, at)
    assert len(add_stroke(hatching, (71.3, 5.0)).strokes) == len(hatching.strokes) + 1


def test_a_moved_stroke_stays_what_it_is() -> None:
    moved = move_stroke(hatch(rectangle()), 3, (21.5, 10.0))
    assert moved.on_top[3] == pytest.approx([21.5, 10.0])
    assert not moved.is_long[3]
    assert len(moved.strokes) == 19


@pytest.mark.parametrize("shape", [rectangle, bend, annulus])
def test_points_past_an_edge_are_on_no_stroke(shape: Callable[[], Strip]) -> None:
    """However near to the line of a stroke, but for what clicks and decimals are off by."""
    hatching = hatch(shape())
    start, end = (  # between two strokes
        np.array(nearest_points(edge, Point((ends[4] + ends[5]) / 2.0))[0].coords[0])
        for edge, ends in (
            (hatching.strip.main, hatching.on_top),
            (hatching.strip.auxiliary, hatching.on_toe),
        )
    )
    for share in (-0.009, 0.0, 0.5, 1.0, 1.009):
        more = add_stroke(hatching, tuple(start + share * (end - start)))
        assert len(more.strokes) == len(hatching.strokes) + 1
    for share in (-0.9, -0.03, 1.03, 1.5):
        with pytest.raises(ParameterError, match="no stroke of the slope leads through"):
            add_stroke(hatching, tuple(start + share * (end - start)))


def test_editing_a_closed_slope() -> None:
    hatching = hatch(annulus())
    n = len(hatching.strokes)
    for k in (0, n - 1, n // 2):
        middle = (hatching.on_top[k] + hatching.on_top[(k + 1) % n]) / 2.0 * 1.2
        more = add_stroke(hatching, tuple(middle))
        assert len(more.strokes) == n + 1
        assert more.spacing.sum() == pytest.approx(hatching.spacing.sum())
        assert more.spacing.min() == pytest.approx(hatching.spacing.min() / 2.0, rel=0.1)


def test_editing_refuses_what_cannot_be() -> None:
    hatching = hatch(rectangle())
    with pytest.raises(ParameterError, match=r"would meet the one from \(5, 10\)"):
        add_stroke(hatching, (5.0, 3.0))
    with pytest.raises(ParameterError, match=r"no stroke of the slope leads through \(-7, 5\)"):
        add_stroke(hatching, (-7.0, 5.0))
    with pytest.raises(ParameterError, match="index is 19, expected one of 19 strokes"):
        delete_stroke(hatching, 19)
    with pytest.raises(ParameterError, match="rule='paper'"):
        add_stroke(hatch(rectangle(), rule="paper"), (6.0, 3.0))


def test_a_spacing_of_the_callers_has_no_bounds_of_the_standard() -> None:
    hatching = hatch(rectangle(), spacing=0.3, scale=1000)
    assert hatching.spacing == pytest.approx(np.full(len(hatching.spacing), 0.3), rel=0.01)


def test_zones_that_are_not_valid_are_refused() -> None:
    bow_tie = Polygon([(0, 0), (9, 9), (9, 0), (0, 9)])
    with pytest.raises(InvalidAreaError, match=r"exclude\[1\] is not valid: Self-intersection"):
        hatch(rectangle(), exclude=[box(0, 0, 1, 1), bow_tie])


def test_a_slope_that_is_shorter_than_a_gap_has_a_problem() -> None:
    hatching = hatch(rectangle(), spacing=1e6, min_length=0.0)
    assert hatching.strokes.size == 0
    assert [problem.reason for problem in hatching.problems] == [
        "the slope is shorter than a gap, 5e+05 at least; none is drawn"
    ]


def test_a_slope_that_is_shorter_than_its_offsets_says_so() -> None:
    hatching = hatch(rectangle(), offset=1e6)
    assert hatching.strokes.size == 0
    assert [problem.reason for problem in hatching.problems] == [
        "offset is 1e+06 gaps from either end, the slope is shorter; none is drawn"
    ]


def test_zones_that_hide_all_are_told_and_others_are_not() -> None:
    area = rectangle().area
    hidden = hatch(rectangle(), exclude=area)
    assert hidden.strokes.size == 0
    assert hidden.n_excluded == hatch(rectangle()).strokes.size
    assert [problem.reason for problem in hidden.problems] == [
        "zones of exclude hide every stroke; none is drawn"
    ]
    x_low, y_low, x_high, y_high = area.bounds
    assert not hatch(rectangle(), exclude=box(x_low, y_low, x_high - 20.0, y_high)).problems


def test_a_ring_without_its_closed_top_is_told_what_is_missing() -> None:
    ground = Point(0, 0).buffer(20)
    around = ground.difference(Point(3, 0).buffer(10))
    told = [
        [problem for problem in hatch(strip).problems if "its top is closed" in problem.reason]
        for strip in (
            split(around),
            Strip(LineString(around.interiors[0]), LineString(around.exterior), around),
            split(box(0, 0, 60, 10).difference(box(28, 4, 31, 6))),  # the others pass the island
            split(box(0, 0, 60, 10)),
        )
    ]
    assert [len(problems) for problems in told] == [1, 0, 0, 0]
    assert "midrib.Strip(top, toe, area)" in told[0][0].reason
    assert told[0][0].where.within(ground.difference(around))


@given(scale=st.floats(1e-3, 1e3), factor=st.floats(0.3, 1.0))
def test_the_mean_of_a_triangle_is_half_its_height(scale: float, factor: float) -> None:
    """A top of vertices at 0, h, 0, made six: 0, h/3, 2h/3 (to the middle) and so on."""
    top = LineString([(0.0, 0.0), (3.0, 1.0), (6.0, 0.0)])
    toe = LineString([(0.0, 0.0), (6.0, 0.0)])
    strip = Strip(*(LineString(scale * np.array(line.coords)) for line in (top, toe)))
    rule = with_mean_gap(Rule(factor=factor), strip.main, strip.auxiliary)
    heights = scale * np.array([0, 1 / 3, 2 / 3, 1, 2 / 3, 1 / 3, 0])
    assert rule.least_gap == pytest.approx(factor * heights.mean())
    assert rule.largest_gap == rule.least_gap


def test_the_rule_of_the_mean_has_one_gap_and_the_standards_bounds() -> None:
    wedge = Strip(LineString([(0, 0), (40, 0)]), LineString([(0, -2), (40, -8)]))
    by_mean = hatch(wedge, scale=500, rule="mean")
    assert by_mean.spacing == pytest.approx(np.full(by_mean.spacing.size, 2.5), rel=0.05)
    assert np.ptp(hatch(wedge, scale=500).spacing) > 2.0
    turned = abs((by_mean.on_toe - by_mean.on_top)[:, 0])
    assert turned.max() < 0.1  # at right angles to the top
    assert abs((h := hatch(wedge, rule="mean", top_share=0.0)).on_toe - h.on_top)[:, 0].max() > 0.3
    assert hatch(wedge, rule="mean", min_spacing=8.0).rule.least_gap == 4.0
    assert hatch(wedge, rule="mean", max_spacing=2.0).rule.least_gap == 1.0


def test_a_standard_may_have_the_rule_of_the_mean() -> None:
    wedge = Strip(LineString([(0, 0), (40, 0)]), LineString([(0, -2), (40, -8)]))
    mine = standard("pl-2021-slope-reinforced", rule="mean")
    several: list[dict[str, Any]] = [{}, {"factor": 0.8}, {"top_share": 0.5}]
    for options in several:
        ours, asked = hatch(wedge, mine, **options), hatch(wedge, rule="mean", **options)
        assert (ours.on_top == asked.on_top).all()
        assert (ours.on_toe == asked.on_toe).all()
    plain = hatch(wedge, mine, rule="matching")
    assert (plain.on_top == hatch(wedge).on_top).all()
    # A gap of one's own holds, and strokes are at right angles to the top all the same.
    fixed = hatch(wedge, mine, spacing=4.0)
    assert fixed.rule.least_gap == 2.0
    assert abs((fixed.on_toe - fixed.on_top)[:, 0]).max() < 0.1


# -- refusals --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"standard": "no such"}, "standard"),
        ({"standard": 5}, "standard is 5, expected one of"),
        ({"scale": 0}, "scale is 0, expected a number above 0"),
        ({"metres_per_unit": -1}, "metres_per_unit is -1"),
        ({"factor": float("nan")}, "factor is nan"),
        ({"min_spacing": 0}, "min_spacing is 0"),
        ({"factor": 1.0, "spacing": 1.0}, "factor is 1.0 and spacing 1.0"),
        ({"min_length": -1}, "min_length is -1"),
        ({"spacing": 4.0, "max_spacing": 1.0}, "spacing is 4.0, expected it between min_spacing"),
        ({"spacing": 1.0, "min_spacing": 2.0}, "spacing is 1.0, expected it between min_spacing"),
        ({"stiffness": 1e200}, "stiffness is 1e[+]200, expected a number above 0, 100 at most"),
        ({"max_spacing": 0.5}, "max_spacing is 0.5, expected min_spacing, 0.72, or more"),
        ({"standard": "pl-2015-conveyor"}, "'pl-2015-conveyor', which draws circles, expected one"),
        ({"pattern": "SS"}, "pattern is 'SS'"),
        ({"pattern": "LX"}, "pattern is 'LX'"),
        ({"short_ratio": 0.01}, r"short_ratio is 0.01, expected 0.05 to 0.95"),
        ({"rule": "other"}, "rule is 'other', expected 'matching' or 'mean' or 'paper'"),
        ({"rule": "mean", "spacing": 2.0}, "rule is 'mean' with a fixed spacing, 1, expected a"),
        ({"start": "top"}, "start is 'top'"),
        ({"first": "long one"}, "first is 'long one'"),
        ({"first": "short", "pattern": "L"}, "first is 'short', but pattern 'L' has no short"),
        ({"top_share": 1.5}, "top_share is 1.5, expected a number from 0 to 1"),
        ({"rule": "paper", "top_share": 0.5}, "rule='paper' has no start, offset"),
        ({"offset": 0}, "offset is 0"),
        ({"stiffness": None}, "stiffness is None"),
        ({"rule": "paper", "offset": 0.5}, "rule='paper' has no start, offset"),
        ({"end_strokes": 1}, "end_strokes is 1, expected True or False"),
        ({"scale": 1e-9}, "more than 1000000 strokes"),
    ],
)
def test_wrong_options_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        hatch(rectangle(100.0, 1e-7 if "scale" in options else 10.0), **options)


def test_wrong_geometries_are_refused() -> None:
    with pytest.raises(GeometryTypeError, match="strip is a Polygon, expected a Strip"):
        hatch(box(0, 0, 9, 2))
    with pytest.raises(GeometryTypeError, match=r"exclude\[1\] is a Point"):
        hatch(rectangle(), exclude=[box(0, 0, 1, 1), Point(0, 0)])
    with pytest.raises(InvalidAreaError, match="neither is around the other"):
        Strip(ring(3.0, 8), LineString([(9, 0), (12, 0), (12, 3), (9, 0)]))
    with pytest.raises(InvalidAreaError, match="closed"):
        annulus().layout  # noqa: B018


def test_touching_rings_are_refused() -> None:
    inner = LineString([(0, 0), (4, 0), (4, 4), (0, 0)])
    outer = LineString([(0, 0), (9, -3), (9, 9), (-3, 9), (0, 0)])
    with pytest.raises(InvalidAreaError, match=r"touch at \(0, 0\)"):
        hatch(Strip(inner, outer))


def test_no_stroke_is_added_through_islands_and_zones() -> None:
    island, zone = box(5, 1, 7, 3), box(9, 1, 10, 3)
    area = Polygon(box(0, 0, 12, 4).exterior, [island.exterior])
    strip = Strip(LineString([(0, 4), (12, 4)]), LineString([(0, 0), (12, 0)]), area)
    hatching = hatch(strip, scale=500, exclude=zone)
    for x in (6.1, 9.6):
        with pytest.raises(ParameterError, match="would enter an island or an excluded zone"):
            add_stroke(hatching, (x, 4.0))
    assert len(add_stroke(hatching, (3.1, 4.0)).strokes) == len(hatching.strokes) + 1
