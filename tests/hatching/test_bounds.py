"""Bounds are kept, or a problem names the place; and the same strokes come of the same slope."""

import sys
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point
from shapely.affinity import translate

from midrib import Hatching, Strip, hatch
from midrib.errors import MidribError
from midrib.hatching.measures import measure, measure_strokes, untold
from tests.hatching.slopes import annulus, bands, lens, rectangle, rings, trapezium

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from hatch_slopes import KINDS, one_random, real_polish

FOLDER = Path(__file__).parents[2].parent / "shared" / "data"
SHIFT = (5e5, 5e6)


def with_island(strip: Strip) -> Strip:
    """Return a slope with a round island in its middle, a quarter of its width across."""
    whole = hatch(strip)
    row = len(whole.strokes) // 2
    middle = (whole.on_top[row] + whole.on_toe[row]) / 2.0
    island = Point(middle).buffer(0.12 * float(whole.width[row]))
    return Strip(strip.main, strip.auxiliary, strip.area.difference(island))


def some(kind: str) -> list[Strip]:
    """Random slopes of a kind, each second one with an island if it has room."""
    made = []
    for seed in range(3000, 3008):
        strip = one_random(kind, seed).strip
        try:
            made.append(with_island(strip) if seed % 2 else strip)
        except (MidribError, IndexError):
            made.append(strip)
    return made


def moved_by(one: Hatching, other: Hatching, shift: tuple[float, float] = (0.0, 0.0)) -> float:
    """How far strokes are from those of another hatching, over the size of the slope."""
    assert len(one.strokes) == len(other.strokes)
    x_low, y_low, x_high, y_high = one.strip.area.bounds
    first, second = (np.column_stack([h.on_top, h.on_toe]) for h in (one, other))
    off = abs(first[:, None] - (second - np.tile(shift, 2))[None]).max(axis=2)
    nearest = off.argmin(axis=1)
    assert sorted(nearest.tolist()) == list(range(len(nearest)))
    assert (one.is_long == other.is_long[nearest]).all()
    return float(off.min(axis=1).max(initial=0.0) / np.hypot(x_high - x_low, y_high - y_low))


def from_elsewhere(strip: Strip) -> Strip:
    """Return the same slope, its closed edges or its area from another vertex on."""

    def later(ring: LineString) -> LineString:
        points = shapely.get_coordinates(ring)[:-1]
        points = np.roll(points, 3, axis=0)
        return LineString(np.vstack([points, points[:1]]))

    if strip.is_closed:
        return Strip(later(strip.main), later(strip.auxiliary), strip.area)
    ring = later(LineString(strip.area.exterior.coords))
    return Strip(strip.main, strip.auxiliary, shapely.Polygon(ring, strip.area.interiors))


@given(strip=st.one_of(bands(), rings()), factor=st.sampled_from([0.2, 0.5, 1.0]))
@settings(max_examples=60)
def test_what_is_beyond_a_bound_is_told(strip: Strip, factor: float) -> None:
    hatching = hatch(strip, min_spacing=0.2, factor=factor)
    assert not untold(hatching, measure(hatching))


@pytest.mark.parametrize("kind", KINDS)
def test_random_slopes_keep_all_bounds_and_do_not_depend_on_how_they_are_told(kind: str) -> None:
    for strip in some(kind):
        hatching = hatch(strip, min_spacing=0.1)
        found = measure(hatching)
        assert not untold(hatching, found)
        if not strip.area.interiors:
            assert all("end is" in one.reason for one in found.beyond)
        turned = Strip(shapely.reverse(strip.main), shapely.reverse(strip.auxiliary), strip.area)
        assert moved_by(hatching, hatch(turned, min_spacing=0.1)) <= 1e-6
        assert moved_by(hatching, hatch(from_elsewhere(strip), min_spacing=0.1)) <= 1e-6
        curves = (strip.main, strip.auxiliary, strip.area)
        far = hatch(Strip(*(translate(curve, *SHIFT) for curve in curves)), min_spacing=0.1)
        assert moved_by(hatching, far, SHIFT) <= 1e-6


@pytest.mark.parametrize(
    ("kind", "seed"), [("sharp", 2132), ("sharp", 1532), ("spur", 1007), ("deep", 1258)]
)
def test_local_widths_are_twice_the_distance_to_the_farther_edge(kind: str, seed: int) -> None:
    """Chords at corners of a V run along the slope and end far away, or on the wrong edge."""
    hatching = hatch(one_random(kind, seed).strip, min_spacing=0.1)
    assert hatching.ground is not None
    rungs = hatching.ground.ladder.rungs[3:-3]  # chords at the ends are shorter than it
    points = shapely.points(rungs[:, 1:3])
    strip = hatching.strip
    off = [shapely.distance(points, edge) for edge in (strip.main, strip.auxiliary)]
    assert rungs[:, 7] == pytest.approx(2.0 * np.maximum(*off), rel=0.03)


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
def test_real_slopes_keep_bounds_or_say_so() -> None:
    pytest.importorskip("pyogrio")
    beyond = 0
    for slope in real_polish():
        hatching = hatch(slope.strip)
        found = measure(hatching)
        assert not untold(hatching, found), slope.name
        beyond += sum("end is" not in one.reason for one in found.beyond)
        turned = Strip(shapely.reverse(slope.strip.main), slope.strip.auxiliary, slope.strip.area)
        assert moved_by(hatching, hatch(turned)) <= 1e-6, slope.name
    assert beyond <= 6


@pytest.mark.parametrize(("strip", "gap"), [(rectangle(100.0, 10.0), 5.0), (trapezium(), None)])
def test_gaps_are_the_rule_s_within_a_hundredth(strip: Strip, gap: float | None) -> None:
    hatching = hatch(strip)
    asked = hatching.rule.gaps(hatching.width)
    ratio = hatching.spacing / ((asked[1:] + asked[:-1]) / 2.0)
    assert ratio == pytest.approx(np.full(ratio.size, ratio.mean()), rel=0.01)
    assert gap is None or hatching.spacing == pytest.approx(np.full(ratio.size, gap), rel=0.01)
    assert (hatching.is_long[1:] != hatching.is_long[:-1]).all()


@pytest.mark.parametrize("radius", [0.3, 0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("is_pit", [False, True])
def test_strokes_of_a_small_mound_are_apart_all_the_way_round(radius: float, is_pit: bool) -> None:
    plain = annulus(radius, 12.0)
    hatching = hatch(Strip(plain.auxiliary, plain.main) if is_pit else plain)
    found = measure(hatching)
    assert len(hatching.strokes) >= (4 if is_pit or radius >= 1.0 else 1)
    assert found.least_foot >= 0.25 * (1.0 - 1e-6)
    assert not untold(hatching, found)
    missing = [problem for problem in hatching.problems if problem.kind == "missing"]
    assert is_pit or len(hatching.strokes) % 2 == 0 or missing


@pytest.mark.parametrize("radius", [0.2, 0.3, 0.7, 1.0])
def test_thinned_out_strokes_are_even_and_as_many_as_fit(radius: float) -> None:
    """n even strokes begin 2 r sin(pi / n) apart, a quarter of half the width at least."""
    hatching = hatch(annulus(radius, 12.0))
    least = 0.25 * 0.5 * (12.0 - radius)
    fit = [n for n in range(2, 40, 2) if 2.0 * radius * np.sin(np.pi / n) >= least]
    count = max(fit, default=1)
    assert len(hatching.strokes) == count
    for ends in (hatching.on_top, hatching.on_toe):
        angle = np.sort(np.arctan2(*ends.T[::-1]) % (2.0 * np.pi))
        around = np.append(np.diff(angle), angle[0] + 2.0 * np.pi - angle[-1])
        assert around == pytest.approx(np.full(count, 2.0 * np.pi / count), abs=1e-3)
    assert (hatching.is_long != np.roll(hatching.is_long, 1)).all() or count == 1
    assert hatching.problems


@pytest.mark.parametrize(
    ("radius", "factor", "count", "ratio"),
    [(0.5, 0.2, 4, 1.3), (0.7, 0.3, 4, 1.01), (1.0, 0.3, 6, 1.01)],
)
def test_no_stroke_is_taken_where_the_one_before_allows_it_first(
    radius: float, factor: float, count: int, ratio: float
) -> None:
    """Of 18, each fourth one in turn would leave six between the last and the first."""
    hatching = hatch(annulus(radius, 12.0), factor=factor)
    assert len(hatching.strokes) == count
    assert hatching.spacing.max() <= ratio * hatching.spacing.min()


def test_only_a_tip_that_has_room_for_strokes_is_told() -> None:
    hatching = hatch(lens(1.0), scale=2000)
    found = measure(hatching)
    assert found.end_gap > 1.5
    assert not hatching.problems
    assert not found.beyond
    rows = slice(1, None)
    fewer = measure_strokes(
        hatching.strip, hatching.rule, LineString([(0, 0), (100, 0)]), hatching.strokes[rows],
        hatching.is_long[rows], hatching.on_top[rows], hatching.on_toe[rows],
    )  # fmt: skip
    assert ["the slope's end is" in one.reason for one in fewer.beyond] == [True]


@pytest.mark.parametrize("beyond", [-0.1, 0.1, 0.4, 1.0, 3.0])
def test_what_is_beyond_a_bound_by_little_is_told_too(beyond: float) -> None:
    """A stroke of a wide slope that leans by so many degrees more than it may."""
    strip = rectangle(400.0, 10.0)
    hatching = hatch(strip)
    on_top, on_toe = hatching.on_top.copy(), hatching.on_toe.copy()
    on_toe[40, 0] += 10.0 * np.tan(np.radians(10.0 + beyond))
    found = measure_strokes(
        strip, hatching.rule, LineString([(0, 5), (400, 5)]), hatching.strokes,
        hatching.is_long, on_top, on_toe,
    )  # fmt: skip
    leaning = [one for one in found.beyond if "off the normals" in one.reason]
    assert len(leaning) == (beyond > 0.0)


@pytest.mark.parametrize("degrees", [10.0, 25.0, 35.0])
@pytest.mark.parametrize("is_turned", [False, True])
def test_strokes_between_edges_that_converge_keep_to_the_normal_of_the_top(
    degrees: float, is_turned: bool
) -> None:
    """Half the angle between the edges is more than strokes may lean from it."""
    turn = np.radians(degrees)
    top = LineString([(0, 0), (80, 0)])
    toe = LineString([(0, 0), (80 * np.cos(turn), -80 * np.sin(turn))])
    hatching = hatch(Strip(toe, top) if is_turned else Strip(top, toe))
    found = measure(hatching)
    assert found.tilts.size > 0.5 * found.strokes
    assert found.tilts.max() <= 10.0
    assert found.spacing.min() >= 0.8
    assert found.spacing.max() <= 1.25
    assert not hatching.problems


@pytest.mark.parametrize(("outer", "inner"), [(25.0, 6.0), (25.0, 3.0), (12.0, 3.0)])
def test_half_a_ring_has_strokes_along_its_radii_and_no_problem(outer: float, inner: float) -> None:
    turned = np.linspace(np.pi, 0.0, 90)
    unit = np.column_stack([np.cos(turned), np.sin(turned)])
    hatching = hatch(Strip(LineString(outer * unit), LineString(inner * unit)), scale=500)
    assert not hatching.problems
    stroke, radius = hatching.on_toe - hatching.on_top, -hatching.on_top
    cosine = (stroke * radius).sum(axis=1) / np.hypot(*stroke.T) / np.hypot(*radius.T)
    assert np.degrees(np.arccos(cosine)).max() < 10.0
