"""Centred and symmetric curves: equally far from both banks, by definition and by closed forms."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import LineString, Polygon, box
from shapely.affinity import rotate

from midrib import Strip, collapse, measures, minimal_radii, split
from midrib.types import Floats
from tests.shapes import NAMED
from tests.strategies import ribbons, simple_areas, with_holes

strips = ribbons().map(split)


def wedge(degrees: float, length: float = 10.0) -> Strip:
    """Two banks of equal length from one tip, the main one along the x axis."""
    angle = np.radians(degrees)
    tip, along = (0.0, 0.0), (length * np.cos(angle), length * np.sin(angle))
    return Strip(LineString([tip, (length, 0.0)]), LineString([tip, along]))


def off_bisector(points: Floats, degrees: float) -> Floats:
    """Distances of points from the bisector of a wedge."""
    half = np.radians(degrees) / 2.0
    off: Floats = np.abs(points[:, 0] * np.sin(half) - points[:, 1] * np.cos(half))
    return off


def away_from_ends(line: LineString, points: Floats, margin: float) -> NDArray[np.bool_]:
    """Which points of a line are farther along it than a margin from both ends."""
    at = shapely.line_locate_point(line, shapely.points(points))
    inner: NDArray[np.bool_] = (at > margin) & (at < line.length - margin)
    return inner


@pytest.mark.parametrize("centring", ["symmetric", "centred"])
@pytest.mark.parametrize("degrees", [5.0, 30.0, 60.0])
def test_a_wedge_has_its_bisector(centring: str, degrees: float) -> None:
    curve = minimal_radii(wedge(degrees), ends="caps", centring=centring, count=16)  # type: ignore[arg-type]
    assert off_bisector(shapely.get_coordinates(curve.line), degrees) == pytest.approx(0, abs=1e-9)


@given(strip=strips)
@settings(max_examples=100)
def test_vertices_are_equally_far_from_both_banks(strip: Strip) -> None:
    curve = minimal_radii(strip, ends="caps", centring="centred")
    assume(curve.loops_cut == 0)  # where a loop is cut there is a point that is on no radius
    points = shapely.get_coordinates(curve.line)
    width = 2.0 * strip.area.area / (strip.main.length + strip.auxiliary.length)
    lean = measures.centredness(curve.line, strip)
    # The line glides from an end that is off the trunk onto it.
    ends = [LineString([line_end, line_end]) for line_end in curve.line.coords[:: len(points) - 1]]
    glide = max(strip.main.distance(end) + strip.auxiliary.distance(end) for end in ends)
    inner = away_from_ends(curve.line, points, 2.0 * max(glide, width))
    assert lean[inner] == pytest.approx(0, abs=1e-3)


@given(strip=strips)
@settings(max_examples=60)
def test_the_line_between_vertices_is_within_the_tolerance(strip: Strip) -> None:
    width = 2.0 * strip.area.area / (strip.main.length + strip.auxiliary.length)
    tolerance = width / 50.0
    curve = minimal_radii(strip, ends="caps", centring="centred", tolerance=tolerance)
    exact = minimal_radii(strip, ends="caps", centring="centred", tolerance=tolerance / 64.0)
    between = shapely.get_coordinates(shapely.segmentize(curve.line, width / 16.0))
    inner = shapely.points(between[away_from_ends(curve.line, between, 3.0 * width)])
    assert (shapely.distance(inner, exact.line) <= 1.5 * tolerance).all()


@given(
    area=st.one_of(simple_areas, with_holes()), centring=st.sampled_from(["centred", "symmetric"])
)
@settings(max_examples=150)
def test_centred_lines_stay_inside_and_simple(centring: str, area: Polygon) -> None:
    line = collapse(area, centring=centring)
    assert area.covers(line)
    assert line.is_simple


def test_an_island_belongs_to_the_bank_it_lies_towards() -> None:
    """Past an island in mid-stream the line keeps to the middle of one channel."""
    island = box(40, 3.5, 60, 6.5)
    line = collapse(Polygon(box(0, 0, 100, 10).exterior, [island.exterior]), tolerance=10 / 200)
    beside = shapely.get_coordinates(line.intersection(box(42, 0, 58, 10)))
    assert len(beside) > 0
    assert np.abs(beside[:, 1] - 5.0) == pytest.approx(3.25, abs=10 / 200)


def test_touching_holes_belong_to_the_bank_they_touch() -> None:
    tooth = [(45, 0), (50, 4), (55, 2)]  # touches the lower bank at one vertex
    area = Polygon([(0, 0), (45, 0), (100, 0), (100, 10), (0, 10)], [tooth])
    line = collapse(area)
    above = line.intersection(LineString([(50, 0), (50, 10)]))
    assert above.y == pytest.approx(7.0, abs=0.3)


@pytest.mark.parametrize("mean", ["radii", "proportional", "same-height", (1.0, 0.0)])
def test_every_mean_of_parallel_banks_is_the_middle(mean: str) -> None:
    strip = Strip(LineString([(0, 0), (9, 0)]), LineString([(0, 2), (9, 2)]))
    curve = minimal_radii(strip, ends="caps", centring="symmetric", mean=mean)  # type: ignore[arg-type]
    assert shapely.get_coordinates(curve.line)[:, 1] == pytest.approx(1.0)
    assert curve.line.coords[0] == (0.0, 1.0)
    assert curve.line.coords[-1] == (9.0, 1.0)


@given(strip=strips)
@settings(max_examples=60)
def test_symmetric_curves_do_not_know_which_bank_is_main(strip: Strip) -> None:
    swapped = Strip(strip.auxiliary, strip.main, strip.area)
    one, other = (
        minimal_radii(s, ends="caps", centring="symmetric").line for s in (strip, swapped)
    )
    assert one.hausdorff_distance(other) <= 1e-9 * one.length


@pytest.mark.parametrize("name", ["L", "hook", "river_with_island"])
def test_the_usual_call_is_the_construction_step_by_step(name: str) -> None:
    area = NAMED[name]
    curve = minimal_radii(split(area), ends="caps", centring="centred", end_clearance=None)
    assert np.array_equal(
        shapely.get_coordinates(collapse(area)), shapely.get_coordinates(curve.line)
    )
    assert curve.points.shape == curve.on_main.shape


@pytest.mark.parametrize("degrees", range(0, 360, 15))
def test_a_court_has_a_line_whatever_vertices_its_end_has(degrees: int) -> None:
    """A vertex in the very middle of the side that the building faces is its middle, not a half."""
    side, building = [(0, 0), (7, 0), (7, 2), (7, 4), (0, 4)], [(5, 1.5), (5, 2.5), (6, 2)]
    area = rotate(Polygon(side, [building]), degrees, origin=(3, 1))
    line = collapse(area)
    assert np.isfinite(line.coords).all()
    assert area.covers(line)
    assert line.is_simple


@pytest.mark.parametrize(
    "area",
    [
        Polygon([(8, 8), (-6, 8), (-18, 5), (-15, 2), (-14, -4), (12, -6)]),
        *(shape for name, shape in sorted(NAMED.items())),
    ],
)
def test_lines_do_not_turn_back(area: Polygon) -> None:
    """They had gone into a corner by an end and come back to 1e-8 of where they were."""
    steps = np.diff(collapse(area).coords, axis=0)
    angles = np.degrees(np.arctan2(steps[:, 1], steps[:, 0]))
    turns = np.abs((np.diff(angles) + 180.0) % 360.0 - 180.0)
    assert (turns < 170.0).all()
    assert np.hypot(*steps.T).min() > 1e-6


MOUTHS = {
    "T": "POLYGON ((0 0, 100 0, 100 10, 60 10, 60 60, 40 60, 40 10, 0 10, 0 0))",
    "funnel": "POLYGON ((0 0, 100 0, 100 10, 70 10, 52 40, 48 40, 45 10, 0 10, 0 0))",
    "elbow": "POLYGON ((0 0, 40 0, 60 -30, 80 -30, 58 2, 100 4, 100 14, 50 9, 0 10, 0 0))",
    "both": "POLYGON ((0 0, 45 0, 40 -25, 50 -25, 58 0, 100 0, 100 9, 56 9, 70 35, 60 35, 40 9, "
    "0 9, 0 0))",
}


@pytest.mark.parametrize("tolerance", ["1%", "0.1%"])
@pytest.mark.parametrize("name", sorted(MOUTHS))
def test_the_line_turns_into_the_mouths_of_bays_as_the_trunk_does(
    name: str, tolerance: str
) -> None:
    """There the farther bank has two nearest points; the line had gone straight across."""
    area = shapely.from_wkt(MOUTHS[name])
    line = collapse(area, tolerance=tolerance)
    lean = measures.centredness(line, split(area), spacing=0.25)
    inner = lean[40:-40]
    assert inner.max() <= 4.0 * float(tolerance.removesuffix("%")) / 100.0


def test_the_line_passes_an_island_on_its_banks_other_side() -> None:
    """The short way past an island leads round the side where there is no bank of it to face."""
    islands = [box(12, 1, 13, 2), box(40, 1, 41, 2), box(68, 1, 69, 2)]
    area = Polygon(box(0, 0, 100, 20).exterior, [island.exterior for island in islands])
    banks = LineString([(0, 0), (100, 0)]), LineString([(0, 20), (100, 20)])
    curve = minimal_radii(
        Strip(*banks, area), ends="caps", holes="auxiliary", centring="centred", end_clearance=None
    )
    for island in islands:
        beside = curve.line.intersection(LineString([(island.centroid.x, 0), island.centroid]))
        assert beside.y == pytest.approx(0.5, abs=0.2)


def cut_off_wedge(degrees: float, near: float, far: float) -> Polygon:
    """A wedge between two distances from its tip, which is the origin; one bank on the x axis."""
    angle = np.radians(degrees)
    inner, outer = (r * np.array([np.cos(angle), np.sin(angle)]) for r in (near, far))
    return Polygon([(near, 0.0), (far, 0.0), outer, inner])


@pytest.mark.parametrize("options", [{}, {"tolerance": 0.0}, {"centring": "symmetric"}], ids=str)
@pytest.mark.parametrize(
    ("degrees", "ratio"),
    [(10.0, 2.0), (10.0, 10.0), (10.0, 40.0), (30.0, 5.0), (30.0, 10.0), (30.0, 400.0)],
)
def test_a_wedge_cut_off_has_its_bisector(
    degrees: float, ratio: float, options: dict[str, Any]
) -> None:
    """However narrow the narrow end is: its middle had given way to a corner at 1 to 10."""
    near, far = 0.75, 0.75 * ratio
    points = shapely.get_coordinates(collapse(cut_off_wedge(degrees, near, far), **options))
    inner = np.hypot(*points.T) * np.cos(np.radians(degrees) / 2.0) < 0.95 * far
    assert off_bisector(points[inner], degrees) == pytest.approx(0.0, abs=1e-9)
    assert inner.any()


def test_without_tolerance_kinks_are_vertices() -> None:
    area = Polygon([(0, 0), (10, 0), (10, 2), (5, 4), (0, 4)])
    line = collapse(area, tolerance=0.0)
    kink = 5.0 - (2.0 * np.sqrt(29.0) - 10.0) / 2.0  # 2 from all three banks
    points = shapely.get_coordinates(line)
    assert np.hypot(*(points - (kink, 2.0)).T).min() == pytest.approx(0.0, abs=1e-12)
    assert len(points) < 32


@given(
    heights=st.lists(st.floats(1.0, 3.0), min_size=2, max_size=6),
    degrees=st.floats(0.0, 360.0),
)
@settings(max_examples=80)
def test_without_tolerance_straight_stretches_are_exact(
    heights: list[float], degrees: float
) -> None:
    """The trunk of a convex area has no arcs."""
    upper = [(4.0 * k, height) for k, height in enumerate(heights)]
    last = 4.0 * (len(heights) - 1)
    hull = shapely.convex_hull(LineString([(0.0, 0.0), *upper, (last, 0.0)]))
    area = rotate(hull, degrees, origin=(0, 0))
    line = collapse(area, tolerance=0.0)
    assert len(line.coords) < 100
    at = np.linspace(0.0, line.length, 401)
    points = shapely.get_coordinates(line.interpolate(at))
    strip = split(area)
    lean = [
        abs(strip.main.distance(p) - strip.auxiliary.distance(p)) for p in shapely.points(points)
    ]
    margin = 3.5  # the line glides from ends that are off the trunk
    inner = (at > margin) & (at < line.length - margin)
    assert np.array(lean)[inner] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", sorted(NAMED))
def test_without_tolerance_arcs_are_not_divided_for_ever(name: str) -> None:
    area = NAMED[name]
    exact, usual = collapse(area, tolerance=0.0), collapse(area)
    assert area.covers(exact)
    assert exact.is_simple
    assert len(exact.coords) < 60 * len(usual.coords)
    assert exact.hausdorff_distance(usual) < 0.5 * area.area / usual.length


@given(area=ribbons())
@settings(max_examples=40, deadline=None)
def test_without_tolerance_both_banks_are_equally_far_all_along(area: Polygon) -> None:
    """On arcs within a 10,000th of the width; kinks next to points of the line had been missed."""
    line, strip = collapse(area, tolerance=0.0), split(area)
    width = 2.0 * area.area / (strip.main.length + strip.auxiliary.length)
    lean = measures.centredness(line, strip, spacing=width / 10.0)[31:-31]
    assume(lean.size > 0)
    assert np.nanpercentile(lean, 95) <= 0.001
