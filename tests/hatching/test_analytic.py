"""Slopes whose strokes can be written down."""

import numpy as np
import pytest
import shapely
from shapely import LineString, Point, Polygon, box

from midrib import Strip, hatch, split
from midrib.errors import InvalidAreaError
from midrib.hatching.measures import measure
from tests.hatching.slopes import annulus, bend, elbow, lens, rectangle, ring, trapezium


def test_rectangle_has_strokes_half_as_far_apart_as_they_are_long() -> None:
    hatching = hatch(rectangle(100.0, 10.0))
    x = np.arange(5.0, 100.0, 5.0)
    assert hatching.on_top == pytest.approx(np.column_stack([x, np.full(19, 10.0)]), abs=1e-9)
    assert hatching.on_toe == pytest.approx(np.column_stack([x, np.zeros(19)]), abs=1e-9)
    assert (hatching.is_long == (np.arange(19) % 2 == 0)).all()
    assert shapely.length(hatching.strokes) == pytest.approx(np.where(hatching.is_long, 10.0, 5.0))
    assert hatching.spacing == pytest.approx(np.full(18, 5.0))


@pytest.mark.parametrize("length", [93.0, 97.4, 98.0, 102.5, 111.0])
def test_gaps_of_a_rectangle_are_stretched_to_a_whole_count(length: float) -> None:
    hatching = hatch(rectangle(length, 10.0))
    count = round(length / 5.0)
    assert hatching.spacing == pytest.approx(np.full(count - 2, length / count))


def test_trapezium_keeps_equation_2_between_neighbours() -> None:
    """Eq. 2: b = (a + c) / 4, times one factor that makes the count whole."""
    hatching = hatch(trapezium())
    a, c = hatching.width[:-1], hatching.width[1:]
    stretch = hatching.spacing / ((a + c) / 4.0)
    assert stretch == pytest.approx(np.full(len(stretch), stretch.mean()), rel=2e-3)
    assert stretch.mean() == pytest.approx(1.0, abs=0.5 / len(stretch))
    across = hatching.on_top - hatching.on_toe
    tilt = -np.degrees(np.arctan2(*across.T))
    assert tilt == pytest.approx(np.full(len(tilt), np.degrees(np.arctan(0.06)) / 2.0), abs=0.1)


def test_bend_has_radial_strokes_at_equal_angles() -> None:
    """A bend turns steadily, which no smoothing may straighten, at its ends neither."""
    hatching = hatch(bend(20.0, 30.0, 2.4))
    top = np.arctan2(hatching.on_top[:, 1], hatching.on_top[:, 0])
    toe = np.arctan2(hatching.on_toe[:, 1], hatching.on_toe[:, 0])
    assert top == pytest.approx(toe, abs=0.004)
    step = 2.4 / 12
    assert np.diff(top) == pytest.approx(np.full(len(top) - 1, step), rel=0.01)


def test_corner_is_turned_in_small_steps() -> None:
    found = measure(hatch(elbow()))
    assert found.turns.max() <= 20.0
    assert found.top_gap <= 1.75
    assert found.least_foot >= 0.25
    assert found.tilts.max() <= 10.0


def test_strokes_go_on_to_the_tips_of_a_lens() -> None:
    hatching = hatch(lens(12.0), scale=500)
    least = 0.72 * 0.5
    assert hatching.ground is not None
    total = LineString(hatching.ground.middle.line).length
    assert hatching.station.min() <= 1.5 * least
    assert hatching.station.max() >= total - 1.5 * least
    assert hatching.width.min() >= least / 4.0
    assert not hatching.problems


def test_annulus_has_radial_strokes_in_whole_patterns() -> None:
    strip = annulus(10.0, 16.0)
    for pattern in ("LS", "LSS"):
        hatching = hatch(strip, pattern=pattern)
        n = len(hatching.strokes)
        assert n % len(pattern) == 0
        assert hatching.spacing.shape == (n,)
        assert hatching.spacing == pytest.approx(np.full(n, 26.0 * np.pi / n), rel=0.01)
        assert hatching.width == pytest.approx(np.full(n, 6.0), rel=1e-3)
        long = np.flatnonzero(hatching.is_long)
        assert (np.diff(long) == len(pattern)).all()
        assert not hatching.problems


def test_a_pit_is_hatched_from_outside_in() -> None:
    hatching = hatch(Strip(ring(16.0, 60), ring(10.0, 60)))
    assert np.hypot(*hatching.on_top.T).min() > 15.9
    assert np.hypot(*hatching.on_toe.T).max() < 10.1


def test_two_slopes_that_share_a_top_make_a_dyke() -> None:
    top = LineString([(0, 0), (40, 3), (80, 0)])
    slopes = [Strip(top, LineString([(0, y), (40, y + 3), (80, y)])) for y in (8.0, -8.0)]
    one, other = (hatch(strip) for strip in slopes)
    assert len(one.strokes) == len(other.strokes)
    met = shapely.intersection(shapely.union_all(one.strokes), shapely.union_all(other.strokes))
    assert met.length == 0.0


def test_strokes_end_before_an_island() -> None:
    area = Polygon(box(0, 0, 100, 10).exterior, [box(42, 4, 58, 6).exterior.coords])
    strip = split(area, start=(0, 10), end=(100, 10))
    strip = Strip(LineString([(0, 10), (100, 10)]), LineString([(0, 0), (100, 0)]), area)
    hatching = hatch(strip)
    assert shapely.covers(area, hatching.strokes).all()
    assert len(hatching.strokes) == 19
    cut = [0.0 < share < 1.0 and share != 0.5 for share in hatching.share]
    assert len(hatching.problems) == sum(cut) >= 3
    assert all("island" in problem.reason for problem in hatching.problems)
    ends = shapely.get_coordinates(hatching.strokes)[1::2][cut]
    assert ends[:, 1] == pytest.approx(6.0 + 0.25 * 5.0)


def test_strokes_of_a_mound_end_before_an_island() -> None:
    plain = annulus(10.0, 20.0)
    island = Point(15.0, 0.0).buffer(3.0)
    area = Polygon(plain.area.exterior, [*plain.area.interiors, island.exterior])
    hatching = hatch(Strip(plain.main, plain.auxiliary, area))
    assert shapely.covers(area, hatching.strokes).all()
    assert len(hatching.strokes) == len(hatch(plain).strokes)
    assert len(hatching.problems) >= 1
    assert all("island" in problem.reason for problem in hatching.problems)


def test_the_paper_rule_halves_every_second_radius() -> None:
    hatching = hatch(rectangle(100.0, 10.0), rule="paper")
    assert hatching.on_top[:3, 0] == pytest.approx([2.5, 7.5, 12.5])
    assert shapely.length(hatching.strokes[:2]) == pytest.approx([10.0, 5.0])
    with pytest.raises(InvalidAreaError, match="closed"):
        hatch(annulus(), rule="paper")


def test_a_slope_thinner_than_any_stroke_says_so() -> None:
    hatching = hatch(rectangle(50.0, 0.05), scale=500)
    assert not len(hatching.strokes)
    assert "nowhere as wide" in hatching.problems[0].reason
    assert hatching.strip.area.distance(hatching.problems[0].where) == 0.0


def test_what_cannot_be_matched_is_named() -> None:
    """An arm of the slope that leads away and back, from which none leads to the toe."""
    top = LineString([(0, 6), (20, 6), (20, 40), (60, 40), (60, 36), (24, 36), (24, 6), (44, 6)])
    strip = Strip(top, LineString([(0, 0), (44, 0)]))
    hatching = hatch(strip)
    found = measure(hatching)
    assert found.crossings == 0
    assert found.outside == 0.0
    assert found.short_of_edge == 0
    assert hatching.on_top[:, 0].max() <= 44.0
