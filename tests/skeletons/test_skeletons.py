"""Skeletons: what they are made of, how they are pruned, and their trunks."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from shapely import LineString, MultiLineString, MultiPolygon, Point, Polygon, affinity, box

import midrib
from midrib import skeleton
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError, TooManyStationsError
from tests.strategies import areas

BRANCHED = [method.name for method in midrib.methods() if method.has_branches]
EVERY = pytest.mark.parametrize("method", BRANCHED)
L_SHAPE = Polygon([(0, 0), (10, 0), (10, 3), (3, 3), (3, 12), (0, 12)])
RING = Polygon(Point(0, 0).buffer(10).exterior, [Point(2, 0).buffer(5).exterior])


def extent(area: Polygon) -> float:
    """Longer side of an area's bounds."""
    x_low, y_low, x_high, y_high = area.bounds
    return float(max(x_high - x_low, y_high - y_low))


def cycles(found: midrib.Skeleton) -> int:
    """How many independent ways round there are, if it is in one piece."""
    assert shapely.line_merge(shapely.union_all(found.lines)).geom_type in {
        "LineString",
        "MultiLineString",
    }
    return len(found.edges) - len(found.points) + 1


# -- relations -------------------------------------------------------------------------------------


@EVERY
@given(areas)
def test_radii_are_distances_to_the_boundary(method: str, area: Polygon) -> None:
    found = skeleton(area, method)
    distance = shapely.distance(shapely.points(found.points), area.boundary)
    np.testing.assert_allclose(found.radius, distance, atol=1e-9 * extent(area))


@EVERY
@given(areas)
def test_skeletons_are_inside(method: str, area: Polygon) -> None:
    found = skeleton(area, method)
    grown = area.buffer(1e-9 * extent(area))
    assert grown.covers(found.lines)


@given(areas)
def test_a_chordal_axis_goes_round_every_hole_once(area: Polygon) -> None:
    rings = [ring.buffer(1e-9) for ring in (area.exterior, *area.interiors)]  # some touch
    assert (
        cycles(skeleton(area, "chordal-axis"))
        == len(shapely.get_parts(shapely.union_all(rings))) - 1
    )


@given(areas)
def test_a_chordal_axis_leads_through_the_middles_of_chords(area: Polygon) -> None:
    found = skeleton(area, "chordal-axis")
    corners = np.column_stack([found.parts[0][1].mesh.x, found.parts[0][1].mesh.y])
    middles = (corners[:, None] + corners[None]) / 2.0
    known = np.concatenate([corners, middles.reshape(-1, 2)])
    degree = np.bincount(found.edges.ravel(), minlength=len(found.points))
    for at in found.points[degree < 3]:
        assert np.abs(known - at).max(axis=1).min() <= 1e-9 * extent(area)


@EVERY
@given(areas)
def test_trunks_are_lines_inside_from_end_to_end(method: str, area: Polygon) -> None:
    line, problems = midrib.collapse(area, method, on_error="report")
    if line is None:
        assert method == "point-voronoi"
        assert "in pieces" in problems[0].reason
        return
    assert area.covers(line)
    assert line.is_simple
    usual = midrib.collapse(area)
    ends = shapely.get_coordinates(usual)[[0, -1]]
    found = shapely.get_coordinates(line)[[0, -1]]
    np.testing.assert_allclose(found, ends, atol=1e-9 * extent(area))


@EVERY
def test_skeletons_turn_and_move_with_their_area(method: str) -> None:
    def moved(geometry: Any) -> Any:
        return affinity.translate(affinity.rotate(geometry, 30, origin=(0, 0)), 6e5, 5e6)

    found, other = skeleton(L_SHAPE, method), skeleton(moved(L_SHAPE), method)
    assert shapely.hausdorff_distance(moved(found.trunk), other.trunk) < 1e-6
    assert len(found.branches) == len(other.branches)


@EVERY
def test_ring_start_and_direction_make_no_difference(method: str) -> None:
    corners = list(L_SHAPE.exterior.coords)[:-1]
    found = skeleton(L_SHAPE, method)
    for other in (Polygon(corners[3:] + corners[:3]), Polygon(corners[::-1])):
        assert shapely.hausdorff_distance(skeleton(other, method).trunk, found.trunk) < 1e-12


# -- closed forms ----------------------------------------------------------------------------------


def test_the_chordal_axis_of_a_rectangle() -> None:
    found = skeleton(box(0, 0, 9, 2), "chordal-axis")
    assert found.lines.equals(MultiLineString([[(0, 2), (4.5, 1), (9, 0)]]))
    assert found.trunk.wkt == "LINESTRING (0 1, 4.5 1, 9 1)"


def test_the_chordal_axis_of_a_triangle_is_a_star() -> None:
    found = skeleton(Polygon([(0, 0), (6, 0), (0, 3)]), "chordal-axis")
    assert [len(rows) for rows in found.branches] == [2, 2, 2]
    assert (found.points[found.edges[:, 0]] == [2, 1]).all()


def test_a_junction_with_a_wide_angle_is_on_its_longest_side() -> None:
    """A T whose arms are wide: the middle triangle is obtuse."""
    area = Polygon([(0, 0), (20, 0), (20, 2), (11, 2), (11, 9), (9, 9), (9, 2), (0, 2)])
    found = skeleton(area, "chordal-axis")
    degree = np.bincount(found.edges.ravel())
    assert np.count_nonzero(degree == 3) == 1
    junction = found.points[degree == 3][0]
    corners = shapely.get_coordinates(area)
    middles = ((corners[:, None] + corners[None]) / 2.0).reshape(-1, 2)
    assert (middles == junction).all(axis=1).any()


def test_voronoi_skeletons_come_near_to_the_medial_axis() -> None:
    found = skeleton(box(0, 0, 9, 2), "point-voronoi", spacing=0.01, min_significance=1.5)
    (branch,) = found.lines.geoms
    assert branch.distance(LineString([(1, 1), (8, 1)])) < 1e-9
    assert shapely.hausdorff_distance(branch, LineString([(1, 1), (8, 1)])) < 0.02
    assert skeleton(box(0, 0, 9, 2), "point-voronoi", spacing=0.01).lines.length == pytest.approx(
        7.0 + 4.0 * 2.0**0.5, rel=0.01
    )


# -- pruning ---------------------------------------------------------------------------------------


def test_branches_are_pruned_by_length() -> None:
    whole = skeleton(box(0, 0, 9, 2), "point-voronoi")
    assert len(whole.branches) == 5
    assert len(skeleton(box(0, 0, 9, 2), "point-voronoi", min_branch_length=2).branches) == 1
    assert len(skeleton(box(0, 0, 9, 2), "point-voronoi", min_branch_length=0.5).branches) == 5


def test_arms_stay_where_corners_are_pruned() -> None:
    cross = shapely.union_all([box(0, 4, 10, 6), box(4, 0, 6, 10)])
    found = skeleton(cross, "point-voronoi", spacing=0.1, min_significance=1.6)
    assert len(tips(found)) == 4
    assert {round(float(Point(p).distance(Point(5, 5)))) for p in tips(found)} == {4}


def tips(found: midrib.Skeleton) -> Any:
    """Points of the tips of a skeleton."""
    return found.points[np.bincount(found.edges.ravel()) == 1]


@EVERY
def test_ways_round_holes_are_never_pruned(method: str) -> None:
    found = skeleton(RING, method, min_branch_length=1e9, min_significance=1e9)
    assert cycles(found) == 1
    assert len(tips(found)) == 0


# -- what else areas may be ------------------------------------------------------------------------


@EVERY
def test_heights_are_carried_along(method: str) -> None:
    area = shapely.transform(
        shapely.force_3d(L_SHAPE),
        lambda p: np.column_stack([p[:, :2], 2.0 * p[:, 0] + p[:, 1]]),
        include_z=True,
    )
    points = shapely.get_coordinates(midrib.collapse(area, method), include_z=True)
    np.testing.assert_allclose(points[:, 2], 2.0 * points[:, 0] + points[:, 1], atol=1e-9)


@EVERY
def test_degrees_are_lengths_of_a_plane(method: str) -> None:
    area = affinity.translate(affinity.scale(L_SHAPE, 2e-4, 1e-4, origin=(0, 0)), 18, 60)
    found = skeleton(area, method, geographic=True)
    assert 15.0 < found.radius.max() < 20.0
    line = midrib.collapse(area, method, geographic=True)
    assert area.covers(line)
    assert shapely.hausdorff_distance(line, found.trunk) < 1e-12


@EVERY
def test_a_touching_hole_is_no_way_round(method: str) -> None:
    touching = Polygon(box(0, 0, 9, 9).exterior, [[(0, 4), (5, 2), (5, 7)]])
    assert cycles(skeleton(touching, method)) == 0


# -- refusals --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"method": "minimal-radii"}, "method is 'minimal-radii', expected 'medial-axis' or"),
        ({"method": 5}, "method is 5, expected"),
        ({"min_branch_length": -1}, "min_branch_length is -1, expected a number of 0 or more"),
        ({"min_significance": "much"}, "min_significance is 'much'"),
        ({"geographic": 1}, "geographic is 1, expected True or False"),
        ({"spacing": 1}, "method 'medial-axis' has no option 'spacing'"),
        ({"method": "point-voronoi", "spacing": 0}, "spacing is 0, expected a number above 0"),
    ],
)
def test_wrong_options_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        skeleton(box(0, 0, 9, 2), **options)


def test_absurd_spacings_are_refused() -> None:
    with pytest.raises(TooManyStationsError, match=r"makes 2\.2e"):
        skeleton(box(0, 0, 9, 2), "point-voronoi", spacing=1e-9)


def test_what_is_no_area_is_refused() -> None:
    with pytest.raises(GeometryTypeError, match=r"areas\[0\]: is a Point"):
        skeleton(Point(0, 0))
    with pytest.raises(InvalidAreaError, match="more than one way"):
        skeleton(Polygon([(0, 0), (1, 1), (1, 0), (0, 1)]))


def test_arrays_of_skeletons_are_like_each_alone() -> None:
    both = MultiPolygon([box(20, 0, 30, 4), L_SHAPE])
    given = np.array([[L_SHAPE, None], [Polygon(), both]], dtype=object)
    found, problems = skeleton(given, min_significance=1.5, on_error="report")
    assert (found.shape, problems) == ((2, 2), [])
    assert found[0, 1] is found[1, 0] is None
    alone = [skeleton(a, min_significance=1.5) for a in (both.geoms[0], L_SHAPE)]
    assert found[0, 0].lines.equals_exact(alone[1].lines, 0.0)
    assert found[1, 1].lines.equals(shapely.union_all([one.lines for one in alone]))
    assert found[1, 1].radius.tolist() == [r for one in alone for r in one.radius]
    assert list(found[1, 1].trunk.geoms) == [one.trunk for one in alone]
    bow_tie = Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])
    (one, none), (problem,) = skeleton([L_SHAPE, bow_tie], on_error="report")
    assert (one.area, none, problem.index) == (L_SHAPE, None, 1)


def test_necks_narrower_than_the_spacing_are_named() -> None:
    narrow = Polygon([(5, 2.5), (9, 2.5), (9, 2.51), (6.2, 2.51), (5, 2.51)])
    neck = shapely.union_all([box(0, 0, 5, 5), narrow, box(9, 0, 14, 5)])
    with pytest.raises(InvalidAreaError, match="in pieces"):
        midrib.collapse(neck, "point-voronoi")
    assert midrib.collapse(neck, "point-voronoi", spacing=0.005).length > 13.0


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("centring", "method 'mean-curve' has no option 'centring'"),
        ("tolerance", "method 'mean-curve' has no option 'tolerance'"),
        ("mean", "mean is 'radii', expected 'proportional' or 'kinks' for method 'mean-curve'"),
    ],
)
def test_the_mean_curve_has_no_other_mean(name: str, message: str) -> None:
    options: dict[str, Any] = {name: "radii"}
    with pytest.raises(ParameterError, match=message):
        midrib.collapse(box(0, 0, 9, 2), "mean-curve", **options)


def test_the_mean_curve_is_the_proportional_mean() -> None:
    expected = midrib.collapse(L_SHAPE, centring="symmetric", mean="proportional")
    assert midrib.collapse(L_SHAPE, "mean-curve").equals(expected)
