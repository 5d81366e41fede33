"""Trunks: where they leave the skeleton for the ends of the area, so that none folds back."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon, affinity, box

import midrib
from midrib.curves.trunks import way_between
from midrib.errors import InvalidAreaError
from midrib.types import Ints
from tests.strategies import areas
from tests.test_real_areas import FOLDER, areas_of

BRANCHED = [method.name for method in midrib.methods() if method.has_branches]
EVERY = pytest.mark.parametrize("method", BRANCHED)
SHARP = 120.0  # degrees
LEG = 0.3  # of the mean width
SQUARE_RING = box(0, 0, 10, 10).difference(box(1, 1, 9, 9))

sides = st.integers(min_value=6, max_value=30)
frames = st.builds(
    lambda wide, high, wall, angle: affinity.rotate(
        box(0, 0, wide, high).difference(box(wall, wall, wide - wall, high - wall)), angle
    ),
    sides,
    sides,
    st.sampled_from([0.5, 1.0, 2.0]),
    st.integers(min_value=0, max_value=359),
)


def folds_of(line: LineString, area: Polygon) -> Ints:
    """Steps after which a line turns sharply, and both legs are no shorter than jags."""
    steps = np.diff(shapely.get_coordinates(line), axis=0)
    length = np.hypot(*steps.T)
    ahead = steps / length[:, None]
    cosine = (ahead[:-1] * ahead[1:]).sum(axis=1)
    leg = LEG * 2.0 * area.area / area.length
    is_long = (length[:-1] > leg) & (length[1:] > leg)
    return np.flatnonzero(is_long & (cosine < np.cos(np.radians(SHARP))))


def tips_of(line: LineString, found: midrib.Skeleton) -> list[bool]:
    """Whether the start and the end of a line are points of a skeleton: it does not leave it."""
    near = 1e-9 * np.sqrt(found.area.area)
    ends = shapely.points([line.coords[0], line.coords[-1]])
    return list(shapely.distance(ends, shapely.MultiPoint(found.points)) <= near)


@EVERY
@given(areas)
def test_no_trunk_comes_back_past_its_end(method: str, area: Polygon) -> None:
    _, problems = midrib.collapse(area, method, on_error="report")
    if problems:
        return
    graph, layout = midrib.skeleton(area, method).parts[0]
    ends = layout.middle.point
    way = way_between(graph, ends, layout.scale)
    for end, onwards in zip(ends, (way, way[::-1]), strict=True):
        nearest = shapely.distance(
            Point(end), shapely.linestrings(onwards[[0, min(1, len(way) - 1)]])
        )
        assert np.hypot(*(onwards[0] - end)) <= nearest + 1e-9 * np.sqrt(area.area), area.wkt


@EVERY
@given(frames)
def test_trunks_of_frames_do_not_fold(method: str, frame: Polygon) -> None:
    half_wall = {"spacing": 0.25}  # of the narrowest
    options: dict[str, Any] = half_wall if method == "point-voronoi" else {}
    assert folds_of(midrib.collapse(frame, method, **options), frame).size == 0


def test_a_straight_skeleton_s_trunk_of_a_square_ring_is_as_long_as_the_medial_one() -> None:
    line = midrib.collapse(SQUARE_RING, "straight-skeleton")
    assert line.wkt == "LINESTRING (5 0, 0.5 0.5, 0.5 9.5, 5 9.5, 5 10)"
    assert line.length <= 1.05 * midrib.collapse(SQUARE_RING, "medial-axis").length


def test_a_skeleton_with_nothing_inside_is_refused() -> None:
    frame = affinity.rotate(box(0, 0, 8, 6).difference(box(0.5, 0.5, 7.5, 5.5)), 1)
    with pytest.raises(InvalidAreaError, match="a smaller spacing may find it"):
        midrib.collapse(frame, "point-voronoi")


@EVERY
def test_a_road_that_turns_back_keeps_its_turn(method: str) -> None:
    road = LineString([(0, 0), (40, 6), (0, 12)]).buffer(1, cap_style="flat", join_style="mitre")
    line = midrib.collapse(road, method)
    inner_corner = 33.3  # where both inner sides meet
    assert line.bounds[2] > inner_corner
    assert line.length > 2.0 * inner_corner
    assert folds_of(midrib.collapse(road, "straight-skeleton"), road).size == 1


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
@EVERY
@pytest.mark.parametrize("layer", ["vlak", "talud"])
def test_no_trunk_of_a_real_area_folds_at_its_ends(layer: str, method: str) -> None:
    parts = shapely.force_2d(areas_of("nl_bgt_gooi.gpkg", layer).to_numpy())
    lines, _ = midrib.collapse(parts, method, on_error="report")
    is_line = ~shapely.is_missing(lines)
    for line, area in zip(lines[is_line], parts[is_line], strict=True):
        folds = folds_of(line, area)
        if folds.size:
            at_start, at_end = tips_of(line, midrib.skeleton(area, method))
            assert at_start or 0 not in folds
            assert at_end or len(line.coords) - 3 not in folds


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
def test_trunks_of_rings_are_as_long_as_the_centred_line() -> None:
    areas = areas_of("nl_bgt_gooi.gpkg", "vlak").to_numpy()[[1000, 894, 795, 1323]]
    trunks, lines = midrib.collapse(areas, "medial-axis"), midrib.collapse(areas)
    assert (shapely.length(trunks) <= 1.05 * shapely.length(lines)).all()
