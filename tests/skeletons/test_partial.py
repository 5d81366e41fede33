"""Partial collapse: closed forms, and what holds of every area at every width."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiPolygon, Point, Polygon, affinity, box

import midrib
from midrib import network, partial_collapse
from midrib.curves.graphs import Graph
from midrib.curves.narrowing import Parts, parts_of
from midrib.errors import GeometryTypeError, ParameterError
from tests.shapes import NAMED, VALID
from tests.strategies import areas

SQUARES = [box(0, 0, 4, 4), box(9, 0, 13, 4)]
DUMBBELL = shapely.union_all([*SQUARES, box(4, 1, 9, 3)])


def vertices(geometry: Any) -> set[tuple[float, float]]:
    """Vertices of a geometry."""
    return {(x, y) for x, y in shapely.get_coordinates(geometry).tolist()}


def check(area: Polygon, width: float, **options: Any) -> midrib.Partial:
    """Hold a partial collapse against its area."""
    found = partial_collapse(area, width, **options)
    kept, lines = found.areas, found.lines
    assert kept.is_valid
    assert not (kept.is_empty and lines.is_empty)
    assert kept.is_empty or area.covers(kept)
    assert lines.is_empty or area.covers(lines)
    if not kept.is_empty and not lines.is_empty:
        met = kept.intersection(lines)
        assert shapely.length(met) == 0.0
        tips = {p for line in lines.geoms for p in (line.coords[0], line.coords[-1])}
        on_edge = vertices(met)
        assert on_edge
        assert on_edge <= tips & vertices(kept)  # a line ends in a vertex of the area, bit by bit
    assert isinstance(found, midrib.Partial)
    return found


# -- closed forms ----------------------------------------------------------------------------------


@pytest.mark.parametrize("width", [2.1, 2.5, 3.0, 3.2])
def test_a_dumbbell_is_two_squares_and_a_line(width: float) -> None:
    found = check(DUMBBELL, width, min_length=1.0)
    assert found.areas.equals(MultiPolygon(SQUARES))
    assert found.lines.equals(shapely.from_wkt("MULTILINESTRING ((4 2, 9 2))"))


def test_what_is_nowhere_narrow_stays_as_it_is() -> None:
    found = partial_collapse(DUMBBELL, 1.9)
    assert found.areas is DUMBBELL
    assert found.lines.is_empty


def test_what_is_nowhere_wide_is_a_network() -> None:
    found = check(DUMBBELL, 9.0)
    assert found.areas.wkt == "POLYGON EMPTY"
    assert found.lines.equals(network(DUMBBELL, tolerance=0.009))


@pytest.mark.parametrize("degrees", [3.0, 10.0, 20.0])
def test_a_wedge_is_cut_between_the_feet_of_the_disc(degrees: float) -> None:
    turn = np.radians(degrees)
    length, width = 60.0, 4.0
    side = length * np.array([np.cos(turn), np.sin(turn)])
    area = Polygon([(0, 0), side * [1, -1], side])
    found = check(area, width, min_length=1.0)
    foot = width / 2.0 / np.tan(turn) * np.array([np.cos(turn), np.sin(turn)])
    wanted = Polygon([foot * [1, -1], side * [1, -1], side, foot])
    assert shapely.hausdorff_distance(found.areas, wanted) < 1e-6
    (line,) = found.lines.geoms
    assert shapely.hausdorff_distance(line, LineString([(0, 0), (foot[0], 0)])) < 1e-6


def test_a_pond_in_a_road_is_kept() -> None:
    area = shapely.union_all([box(-20, -1, 20, 1), Point(0, 0).buffer(4, quad_segs=64)])
    found = check(area, 3.0)
    mouth = (4.0**2 - 1.0) ** 0.5
    assert found.areas.area == pytest.approx(Point(0, 0).buffer(4, quad_segs=64).area, rel=0.02)
    ends = sorted(x for line in found.lines.geoms for x in shapely.get_coordinates(line)[:, 0])
    assert [ends[0], ends[-1]] == pytest.approx([-20, 20], abs=1e-9)
    assert [x for x in ends if abs(x) < 19] == pytest.approx([-mouth, mouth], abs=0.01)


@pytest.mark.parametrize("width", [13.9, 14.5, 15.5])
def test_a_cut_behind_a_fork_is_straight_and_ends_a_line_in_each_arm(width: float) -> None:
    """The skeleton forks around an island between the change in the pond and its mouth."""
    pond = box(-40, -10, 8, 10)
    island = Polygon([(11.6, 0), (14, 1), (36, 1), (36, -1), (14, -1)])
    area = pond.union(box(0, -6, 40, 6)).difference(island)
    found = check(area, width)
    assert found.areas.area == pytest.approx(pond.area, rel=1e-9)
    ends = shapely.get_coordinates(found.lines.intersection(found.areas))
    np.testing.assert_allclose(ends[:, 0], 8.0, rtol=1e-9)
    assert sorted(np.sign(ends[:, 1])) == [-1.0, 1.0]


def pond_on_canal(pond: Polygon) -> Polygon:
    """Pond about the origin on a canal 2 wide."""
    return shapely.union_all([box(-40, -1, 40, 1), pond])


@pytest.mark.parametrize("share", [0.3, 0.7, 0.79, 0.81, 0.9, 0.99])
@pytest.mark.parametrize("pond", [box(-5, -5, 5, 5), Point(0, 0).buffer(5, quad_segs=64)])
def test_a_pond_is_kept_up_to_its_own_width(pond: Polygon, share: float) -> None:
    found = check(pond_on_canal(pond), share * 10.0)
    assert found.areas.area == pytest.approx(pond.area, rel=0.25)
    assert len(found.lines.geoms) == (2 if share > 0.2 else 0)
    assert check(pond_on_canal(pond), 10.1).areas.is_empty


@pytest.mark.parametrize("pond", [box(-5, -5, 5, 5), Point(0, 0).buffer(5, quad_segs=64)])
def test_a_pond_that_ends_a_canal_or_has_a_brook_is_kept(pond: Polygon) -> None:
    end = shapely.union_all([box(0, -1, 40, 1), pond])
    assert not check(end, 9.5).areas.is_empty
    assert not check(pond_on_canal(pond).union(box(-0.1, -30, 0.1, 0)), 9.5).areas.is_empty


def test_a_brook_makes_no_crossing_of_a_pond() -> None:
    brooks = [box(x - 0.1, -30, x + 0.1, 0) for x in (-0.7, 0.6)]
    pond = pond_on_canal(box(-1.6, -1.6, 1.6, 1.6))
    assert not check(pond, 3.1).areas.is_empty
    assert not check(shapely.union_all([pond, *brooks]), 3.1).areas.is_empty


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("away", [2.2, 2.8, 3.3])
def test_a_path_that_leaves_a_road_does_not_narrow_it(away: float, side: float) -> None:
    paths = [box(x - 0.05, 0, x + 0.05, 30 * side) for x in (-away, away) if side > 0]
    paths += [box(x - 0.05, -30, x + 0.05, 0) for x in (-away, away) if side < 0]
    paths += [box(0, y - 0.05, 30, y + 0.05) for y in (-away,)]
    tee = shapely.union_all([box(-20, -1, 20, 1), box(-1, -20, 1, 0), *paths])
    assert check(tee, 2.2).areas.is_empty


def test_what_is_little_wider_is_kept_if_it_is_long() -> None:
    for length, is_kept in ((1.0, False), (4.0, True)):
        river = pond_on_canal(box(-length, -1.2, length, 1.2))
        assert check(river, 2.3).areas.is_empty != is_kept


@pytest.mark.parametrize("width", [2.01, 2.2, 2.4, 2.6, 2.9, 4.0])
def test_where_roads_meet_there_is_no_area(width: float) -> None:
    """Discs at the junctions of roads are 1.25 and 1.41 times as wide as the roads."""
    sides = [box(-9, 0, -7, 15), box(7, -15, 9, 15)]
    slant = affinity.rotate(box(-50, -1, 50, 1), 35, origin=(30, 0))
    roads = shapely.union_all([box(-20, -1, 60, 1), *sides, slant])
    assert check(roads, width).areas.is_empty
    square = shapely.union_all([box(-20, -1, 60, 1), *sides, box(20, -15, 22, 15)])
    rounded = square.buffer(1.2, join_style="mitre").buffer(-1.2)
    assert check(rounded, width).areas.is_empty
    path = roads.union(box(0, 0, 0.4, 20))  # a narrow one makes no pond of a broad one
    assert check(path, width).areas.is_empty


def test_an_island_is_gone_round_by_what_is_narrow() -> None:
    area = Polygon(box(0, 0, 30, 10).exterior, [box(10, 3, 20, 7).exterior])
    found = check(area, 5.0)
    assert len(found.areas.geoms) == 2
    assert len(found.lines.geoms) == 2
    wide = check(area, 2.5)
    assert wide.areas is area
    ringed = check(Polygon(box(0, 0, 40, 20).exterior, [box(15, 8, 25, 12).exterior]), 2.0).areas
    assert len(ringed.interiors) == 1


def test_short_parts_go_with_what_is_beside_them() -> None:
    assert partial_collapse(DUMBBELL, 3.0, min_length=7.5).areas.equals(DUMBBELL)
    river = shapely.union_all([box(-30, -1, 30, 1), box(-1, -1.2, 1, 1.2)])
    assert check(river, 2.2, min_length=3.0).areas.is_empty
    assert check(river, 2.2, min_length=0.5).areas.area == pytest.approx(4.8, rel=0.2)


@pytest.mark.parametrize("width", [3.0, 3.3])
def test_no_line_between_two_cuts_is_too_short(width: float) -> None:
    """The neck is as narrow for longer than it is between the cuts."""
    lakes = [Point(x, 0).buffer(10, quad_segs=64) for x in (-10.4, 10.4)]
    area = shapely.union_all([*lakes, box(-5, -1, 5, 1)])
    whole = check(area, width, min_length=0.05).lines.length
    assert 0.05 < whole < 6.0
    assert check(area, width, min_length=0.99 * whole).lines.length == pytest.approx(whole)
    assert check(area, width, min_length=1.01 * whole).lines.is_empty


@pytest.mark.parametrize("width", [2.05, 2.2])
def test_nothing_is_between_two_cuts_from_corner_to_corner(width: float) -> None:
    """Discs on both sides of the waist touch the same two corners; a node may be on the cut."""
    waist = Polygon([(-9, -6), (0, -1), (9, -6), (9, 6), (0, 1), (-9, 6)])
    found, problems = partial_collapse(waist, width, min_length=0.1, on_error="report")
    assert found.areas.equals(waist)
    assert found.lines.is_empty
    assert problems == []


def test_a_cut_that_fails_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("midrib.curves.dividing.cut_across", lambda *_: None)
    areas = MultiPolygon([box(20, 0, 30, 9), affinity.translate(DUMBBELL, 0, 50)])
    found, (problem,) = partial_collapse(areas, 3.0, on_error="report")
    assert found.areas.equals(areas)
    assert (problem.index, problem.part, problem.status) == (0, 1, "uncut")
    x, y = map(float, problem.reason.split("(")[1].split(")")[0].split(", "))
    assert areas.covers(Point(x, y))
    assert partial_collapse(areas, 3.0).lines.is_empty


def test_of_short_parts_the_narrow_ones_go_first() -> None:
    """A way that is wide and narrow by turns, every half unit, is wide as a whole."""
    x = np.arange(41) / 2.0
    edges = np.column_stack([np.arange(40), np.arange(1, 41)])
    middle = np.where(np.arange(40) % 2, 0.95, 1.05)
    graph = Graph(np.column_stack([x, 0.0 * x]), edges, np.full(41, 1.0))
    parts = Parts(graph, middle < 1.0, middle, graph)
    assert not parts_of(parts, 3.0, (1.0, 1.0)).is_narrow.any()
    assert parts_of(parts, 0.4, (1.0, 1.0)).is_narrow.tolist() == (middle < 1.0).tolist()


def test_what_stands_out_is_told_without_the_changes_at_a_width() -> None:
    whole = Graph(
        np.array([[-20, 0], [0, 0], [20, 0.0]]), np.array([[0, 1], [1, 2]]), np.array([4, 5, 4.0])
    )
    points = np.concatenate([whole.points, [[-3, 0], [3, 0]]])
    edges = np.array([[0, 3], [3, 1], [1, 4], [4, 2]])
    divided = Graph(points, edges, np.append(whole.radius, [1.0, 1.0]))
    narrow = np.array([True, False, False, True])
    parts = Parts(divided, narrow, np.where(narrow, 0.9, 3.0), whole)
    assert parts_of(parts, 10.0, (1.0, 1.0)).is_narrow.all()
    assert not parts_of(parts._replace(undivided=divided), 10.0, (1.0, 1.0)).is_narrow.all()


def test_a_door_in_a_wall_without_thickness_is_no_part() -> None:
    wall = [(5, 0), (5, 2), (5.0, 0)]
    shell = [(0, 0), wall[0], wall[1], (5 + 1e-9, 0), (10, 0), (10, 5), (5 + 1e-9, 5), (5, 3)]
    area = Polygon([*shell, (5 - 1e-9, 5), (0, 5)])
    found = check(area, 2.0, min_length=0.1)
    assert found.areas.area == pytest.approx(area.area)


# -- relations -------------------------------------------------------------------------------------

shares = st.sampled_from([0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.5])


def thickness(area: Polygon) -> float:
    """Twice the largest radius."""
    return 2.0 * float(midrib.skeleton(area).radius.max())


@given(area=areas, share=shares)
@settings(max_examples=80)
def test_areas_and_lines_are_inside_and_meet_in_vertices(area: Polygon, share: float) -> None:
    width = share * thickness(area)
    check(area, width)
    check(area, width, min_length=0.1 * width, min_significance=1.5)


@given(area=areas, one=shares, other=shares)
@settings(max_examples=80)
def test_areas_lose_as_the_width_grows(area: Polygon, one: float, other: float) -> None:
    size, most = min(one, other) * thickness(area), max(one, other) * thickness(area)
    options: dict[str, Any] = {
        "min_length": 0.3 * thickness(area),
        "tolerance": 1e-4 * thickness(area),
    }
    wide = partial_collapse(area, size, **options).areas
    narrow = partial_collapse(area, most, **options).areas
    assert narrow.difference(wide).area <= 1e-6 * area.area


@pytest.mark.parametrize("name", sorted(VALID))
def test_awkward_areas_are_divided(name: str) -> None:
    area = VALID[name]
    for share in (0.2, 0.6, 0.9, 1.1):
        check(area, share * thickness(area), min_length=0.1)


@pytest.mark.parametrize("method", ["chordal-axis", "straight-skeleton", "point-voronoi"])
@pytest.mark.parametrize("areas", [[], DUMBBELL])
def test_skeletons_whose_discs_do_not_touch_both_banks_are_refused(areas: Any, method: str) -> None:
    with pytest.raises(ParameterError, match=f"method is '{method}', expected 'medial-axis': cuts"):
        partial_collapse(areas, 2.2, method=method, on_error="report")


def test_doubling_moves_nothing_else() -> None:
    for power in (-30, 7, 50):
        factor = 2.0**power

        def larger(geometry: Any, factor: float = factor) -> Any:
            return affinity.scale(geometry, factor, factor, origin=(0, 0))

        found = partial_collapse(larger(NAMED["river_with_island"]), 2.0 * factor)
        expected = partial_collapse(NAMED["river_with_island"], 2.0)
        assert found.lines.equals_exact(larger(expected.lines), 1e-9 * factor)
        assert found.areas.normalize().equals_exact(
            larger(expected.areas).normalize(), 1e-9 * factor
        )


def test_far_from_the_origin_it_is_the_same() -> None:
    def moved(geometry: Any) -> Any:
        return affinity.translate(affinity.rotate(geometry, 33, origin=(0, 0)), 6e5, 5e6)

    found = check(moved(DUMBBELL), 3.0)
    assert shapely.hausdorff_distance(found.areas, moved(MultiPolygon(SQUARES))) < 1e-6


def test_degrees_are_lengths_of_a_plane() -> None:
    area = affinity.translate(affinity.scale(DUMBBELL, 2e-5, 1e-5, origin=(0, 0)), 18, 60)
    found = check(area, 3.3, geographic=True)
    assert len(found.areas.geoms) == 2


def test_heights_are_carried_along() -> None:
    area = shapely.transform(
        shapely.force_3d(DUMBBELL),
        lambda p: np.column_stack([p[:, :2], 2.0 * p[:, 0] + p[:, 1]]),
        include_z=True,
    )
    found = partial_collapse(area, 3.0)
    for part in found:
        points = shapely.get_coordinates(part, include_z=True)
        np.testing.assert_allclose(points[:, 2], 2.0 * points[:, 0] + points[:, 1], atol=1e-9)


# -- arrays, and what is refused -------------------------------------------------------------------


def test_arrays_are_like_each_alone() -> None:
    shapes = np.array([DUMBBELL, None, Polygon(), MultiPolygon([box(20, 0, 21, 9), *SQUARES])])
    found = partial_collapse(shapes, 3.0)
    assert found.areas[0].equals_exact(partial_collapse(DUMBBELL, 3.0).areas, 0.0)
    assert [found.areas[1], found.lines[1]] == [None, None]
    assert [found.areas[2].wkt, found.lines[2].wkt] == ["POLYGON EMPTY", "MULTILINESTRING EMPTY"]
    assert found.areas[3].equals(MultiPolygon(SQUARES))
    assert found.lines[3].equals(shapely.from_wkt("MULTILINESTRING ((20.5 0, 20.5 9))"))


def test_a_series_keeps_index_and_crs() -> None:
    geopandas = pytest.importorskip("geopandas")
    bow_tie = Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])
    series = geopandas.GeoSeries([DUMBBELL, bow_tie], index=["a", "b"], crs="EPSG:28992")
    found, (problem,) = partial_collapse(series, 3.0, on_error="report")
    assert (problem.index, problem.status) == ("b", "refused")
    for part in found:
        assert list(part.index) == ["a", "b"]
        assert part.crs == series.crs
        assert part["b"] is None


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"narrower_than": 0}, "narrower_than is 0, expected a number above 0"),
        ({"narrower_than": "2m"}, "narrower_than is '2m', expected a number above 0"),
        ({"narrower_than": 2, "min_length": -1}, "min_length is -1, expected a number above 0"),
        ({"narrower_than": 2, "merge": -1}, "merge is -1"),
        ({"narrower_than": 2, "method": "mean-curve"}, "method is 'mean-curve', expected"),
    ],
)
def test_wrong_options_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        partial_collapse(box(0, 0, 9, 2), **options)


def test_what_is_no_area_is_refused() -> None:
    with pytest.raises(GeometryTypeError, match=r"areas\[0\]: is a Point"):
        partial_collapse(Point(0, 0), 2.0)
