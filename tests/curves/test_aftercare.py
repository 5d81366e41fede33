"""After-care: lines stay in their areas, keep their ends and do not meet themselves."""

import threading
from typing import Any

import geopandas as gpd
import numpy as np
import pytest
import shapely
from hypothesis import given, note, settings
from hypothesis import strategies as st
from shapely import LineString, Polygon, box
from shapely.affinity import rotate, scale, translate

from midrib import collapse
from midrib.curves.aftercare import aftercare, tend
from midrib.errors import ParameterError
from tests.shapes import NAMED, VALID, wavy_ribbon
from tests.strategies import areas

CARES: list[dict[str, Any]] = [
    {"simplify": "10%"},
    {"simplify": "200%"},
    {"smooth": True},
    {"simplify": "10%", "smooth": True},
]
DEVIATIONS = (0.0, 0.01, 0.1, 1.0, 1e9)


def tended(line: LineString, area: Polygon, **options: Any) -> LineString:
    """One line after its after-care."""
    (done,) = tend([line], [area], aftercare(**options))
    assert isinstance(done, LineString)
    return done


def check_tended(line: LineString, full: LineString, area: Polygon) -> None:
    """Covered, simple, from the same start to the same end, without repeated points."""
    points = shapely.get_coordinates(line)
    assert area.covers(line)
    assert line.is_simple
    assert points[[0, -1]].tolist() == shapely.get_coordinates(full)[[0, -1]].tolist()
    assert (points[1:] != points[:-1]).any(axis=1).all()


def deviation(line: LineString, full: LineString) -> float:
    """Hausdorff distance with many points on each segment."""
    return float(shapely.hausdorff_distance(line, full, densify=0.02))


@pytest.mark.parametrize("care", CARES)
@pytest.mark.parametrize("name", VALID)
@pytest.mark.parametrize("degrees", [0.0, 17.0])
def test_named_areas_hold_tended_lines(name: str, degrees: float, care: dict[str, Any]) -> None:
    area = rotate(VALID[name], degrees)
    if area.is_valid:
        check_tended(collapse(area, **care), collapse(area), area)


@given(area=areas, care=st.sampled_from(CARES))
@settings(max_examples=200)
def test_areas_hold_tended_lines(area: Polygon, care: dict[str, Any]) -> None:
    note(area.wkt)
    check_tended(collapse(area, **care), collapse(area), area)


@given(area=areas, max_deviation=st.sampled_from(DEVIATIONS))
@settings(max_examples=100)
def test_simplified_lines_keep_to_the_deviation(area: Polygon, max_deviation: float) -> None:
    note(area.wkt)
    full = collapse(area)
    line = tended(full, area, simplify=max_deviation)
    size = np.ptp(shapely.get_coordinates(area), axis=0).max()
    assert deviation(line, full) <= max_deviation + 1e-12 * size
    assert set(line.coords) <= set(full.coords)


@given(area=areas, max_deviation=st.sampled_from(DEVIATIONS))
@settings(max_examples=100)
def test_simplifying_twice_is_simplifying_once(area: Polygon, max_deviation: float) -> None:
    note(area.wkt)
    once = tended(collapse(area), area, simplify=max_deviation)
    assert list(tended(once, area, simplify=max_deviation).coords) == list(once.coords)


def test_a_straight_line_becomes_a_segment() -> None:
    assert collapse(box(0, 0, 90, 2), simplify=0).wkt == "LINESTRING (0 1, 90 1)"
    assert len(collapse(box(0, 0, 90, 2), count=5, smooth=True).coords) == 6


def test_a_corner_is_kept_where_the_short_way_leaves_the_area() -> None:
    area = NAMED["U"]
    assert deviation(collapse(area, simplify=1e9), collapse(area)) < 2.0
    assert len(collapse(area, simplify=1e9).coords) >= 4


def test_lines_that_would_cross_keep_their_vertices() -> None:
    # The way back has a spike in the tooth of the way there: without the tooth it would cross.
    tooth = [(0, 0), (4, 0), (5, 3), (6, 0), (10, 0)]
    spike = [(10, -9), (5.5, -9), (5, 2), (4.5, -9), (0, -9)]
    full, area = LineString(tooth + spike), box(-1, -10, 11, 9)
    line = tended(full, area, simplify=3.5)
    check_tended(line, full, area)
    assert {(5, 3), (5, 2)} < set(line.coords)
    assert len(line.coords) < len(full.coords)
    assert len(tended(LineString(tooth), area, simplify=3.5).coords) == 2
    assert list(tended(line, area, simplify=3.5).coords) == list(line.coords)
    for options in ({"simplify": 0.5}, {"simplify": 5.0}, {"smooth": True}):
        check_tended(tended(full, area, **options), full, area)


def test_corners_whose_cut_would_cross_the_line_stay() -> None:
    # A finger reaches into the valley, below the cut of its corner.
    valley, finger = [(-10, 10), (0, 0), (10, 10)], [(0.1, 20), (0.1, 1), (-0.1, 1), (-0.1, 20)]
    full, area = LineString([*valley, (10, 20), *finger, (-9, 20)]), box(-99, -99, 99, 99)
    line = tended(full, area, smooth=True)
    check_tended(line, full, area)
    assert (0, 0) in line.coords
    assert len(line.coords) > len(full.coords)
    assert (0, 0) not in tended(LineString(valley), area, smooth=True).coords


def test_corners_at_the_boundary_stay() -> None:
    for gap in (0.0, 0.01):
        line = LineString([(0, 5), (5, gap), (10, 5)])
        assert list(tended(line, box(-9, 0, 19, 10), smooth=True).coords) == list(line.coords)


@pytest.mark.parametrize("name", ["L", "U", "comb", "hook", "river_with_island"])
def test_smoothing_turns_less_and_stays_off_the_boundary(name: str) -> None:
    full, area = collapse(NAMED[name]), NAMED[name]
    line = collapse(NAMED[name], smooth=True)
    assert sharpest(line) <= sharpest(full)
    assert line.length < full.length
    cut = shapely.points(shapely.get_coordinates(line)[1:-1])
    corners = shapely.points(shapely.get_coordinates(full)[1:-1])
    least = shapely.distance(corners, area.boundary).min()
    assert shapely.distance(cut, area.boundary).min() >= least / 2.0**3 - 1e-12


def sharpest(line: LineString) -> float:
    """Largest turn in degrees."""
    step = np.diff(shapely.get_coordinates(line), axis=0)
    angle = np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
    return float(np.degrees(np.abs(np.diff(angle)).max()))


def test_a_right_angle_becomes_a_bow() -> None:
    line = LineString([(1, 1), (11, 1), (11, 11)])
    area = Polygon([(0, 0), (12, 0), (12, 12), (10, 12), (10, 2), (0, 2)])
    bow = tended(line, area, smooth=True)
    assert sharpest(bow) < 25.0
    assert 0.0 < deviation(bow, line) <= 0.5  # half the distance of the corner to the boundary


@pytest.mark.parametrize("care", CARES)
@pytest.mark.parametrize("power", [-200, -30, 7, 200])
@pytest.mark.parametrize("name", ["hook", "comb", "river_with_island", "chevron"])
def test_doubling_is_exact(name: str, power: int, care: dict[str, Any]) -> None:
    factor = 2.0**power
    larger = scale(NAMED[name], factor, factor, origin=(0, 0))
    expected = scale(collapse(NAMED[name], **care), factor, factor, origin=(0, 0))
    assert list(collapse(larger, **care).coords) == list(expected.coords)


def test_lengths_double_too() -> None:
    area, larger = NAMED["hook"], scale(NAMED["hook"], 8, 8, origin=(0, 0))
    expected = scale(collapse(area, simplify=0.25), 8, 8, origin=(0, 0))
    assert collapse(larger, simplify=2.0).equals_exact(expected)


@pytest.mark.parametrize("care", CARES)
def test_far_from_the_origin_lines_are_the_same(care: dict[str, Any]) -> None:
    area = wavy_ribbon(80, 0.7)
    far = translate(area, 5e5, 5e6)
    line = translate(collapse(far, **care), -5e5, -5e6)
    assert deviation(line, collapse(area, **care)) < 1e-3


@pytest.mark.parametrize("care", CARES)
def test_arrays_are_tended_as_each_alone(care: dict[str, Any]) -> None:
    all_areas = [*VALID.values(), None, Polygon()]
    for line, area in zip(collapse(all_areas, **care), all_areas, strict=True):
        alone = collapse(area, **care)
        assert line == alone or list(line.coords) == list(alone.coords)


def test_heights_are_carried_along() -> None:
    area = Polygon([(x, y, 2.0 * x - y) for x, y in NAMED["hook"].exterior.coords])
    full = collapse(area)
    kept = collapse(area, simplify=0.1)
    heights = {point[:2]: point[2] for point in full.coords}
    assert kept.has_z
    assert all(heights[point[:2]] == point[2] for point in kept.coords)
    low, high = min(heights.values()), max(heights.values())
    smooth = collapse(area, smooth=True)
    assert smooth.has_z
    assert all(low <= point[2] <= high for point in smooth.coords)


def test_geographic_deviations_are_metres() -> None:
    area = translate(scale(wavy_ribbon(80, 0.7), 1e-3, 1e-3, origin=(0, 0)), 5.0, 60.0)
    series = gpd.GeoSeries([area], crs=4326)
    counts = [
        len(collapse(series, simplify=metres).iloc[0].coords) for metres in (0.0, 0.1, 10.0, 1000.0)
    ]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > counts[2] > counts[3]
    assert len(collapse(series, simplify=10.0).iloc[0].coords) > 2


def test_parts_are_tended_each() -> None:
    both = shapely.MultiPolygon([NAMED["L"], translate(NAMED["hook"], 20, 0)])
    line = collapse(both, simplify="5%")
    assert all(
        part.equals_exact(collapse(area, simplify="5%"))
        for part, area in zip(line.geoms, both.geoms, strict=True)
    )


@pytest.mark.parametrize("simplify", [-1.0, np.nan, np.inf, "5", "five%", "-5%", True, [1]])
def test_what_is_no_deviation_is_refused(simplify: Any) -> None:
    with pytest.raises(ParameterError, match=r"simplify is .* expected a length"):
        collapse(box(0, 0, 9, 2), simplify=simplify)


def test_smooth_is_yes_or_no() -> None:
    with pytest.raises(ParameterError, match="smooth is 3, expected True or False"):
        collapse(box(0, 0, 9, 2), smooth=3)  # type: ignore[arg-type]


def test_threads_may_share_areas() -> None:
    """Both prepared the same geometries, and each freed what the other was using."""
    areas = [wavy_ribbon(400, 0.5) for _ in range(5)]
    expected = collapse(areas, simplify="5%")
    found: list[object] = []
    threads = [
        threading.Thread(target=lambda: found.append(collapse(areas, simplify="5%")))
        for _ in range(8)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all((lines == expected).all() for lines in found)
    assert len(found) == 8
    assert not shapely.is_prepared(areas).any()
