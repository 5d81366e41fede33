"""Lines of areas that share an edge meet there, in the same vertex, or the report says why not."""

import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from shapely import LineString, MultiPolygon, Polygon, box
from shapely.affinity import scale

from midrib import Joint, collapse, interrupts, split
from midrib.curves.connecting import agreed_pairs, make_joints, plan_joints, straightened
from midrib.curves.meeting import Chain, nearest_on
from midrib.errors import ParameterError
from midrib.geodesy import lengths_at
from midrib.shared_edges import find_shared_edges, rounding_of

Areas = NDArray[np.object_]
FOLDER = Path(__file__).parents[2] / "shared" / "data"
EXAMPLES = Path(__file__).parents[1] / "examples" / "areas.gpkg"


def connected(areas: Any, **options: Any) -> tuple[Areas, list[Joint]]:
    """Lines and the rows about shared edges."""
    lines, problems = collapse(areas, connect=True, on_error="report", **options)
    return lines, [problem for problem in problems if isinstance(problem, Joint)]


def river(bends: int, width: float, across: int, per_piece: int) -> list[Polygon]:
    """A winding river cut across into pieces, whose banks have vertices between the cuts."""
    t = np.linspace(0.0, 1.0, across * per_piece + 1)
    x, y = 2000.0 * t, 90.0 * np.sin(2.0 * np.pi * bends * t)
    way = np.gradient(np.column_stack([x, y]), axis=0)
    way /= np.hypot(*way.T)[:, None]
    half = width * (0.5 + 0.1 * np.sin(37.0 * t))[:, None]
    normal = np.column_stack([-way[:, 1], way[:, 0]])
    left = np.column_stack([x, y]) + half * normal
    right = np.column_stack([x, y]) - half * normal
    cuts = range(0, t.size - 1, per_piece)
    return [
        Polygon([*right[k : k + per_piece + 1], *left[k : k + per_piece + 1][::-1]]) for k in cuts
    ]


def one_line(lines: Areas) -> LineString:
    """The single line that lines with the same end vertices are."""
    return shapely.line_merge(shapely.multilinestrings(lines))


def ends_of(line: LineString) -> set[tuple[float, ...]]:
    """Its two end vertices."""
    return {tuple(line.coords[0]), tuple(line.coords[-1])}


def assert_inside(lines: Areas, areas: Any) -> None:
    """Lines are simple and covered by all areas together."""
    together = shapely.union_all(np.array(areas, dtype=object))
    assert together.is_valid
    for line in lines:
        assert line.is_simple
        assert together.covers(line)


@pytest.mark.parametrize("width", [8.0, 60.0], ids=["long pieces", "pieces wider than long"])
def test_a_river_cut_into_100_pieces_is_one_line(width: float) -> None:
    pieces = river(4, width, 100, 5)
    lines, joints = connected(pieces)
    assert [joint.kind for joint in joints] == ["end to end"] * 99
    whole = one_line(lines)
    assert whole.geom_type == "LineString"
    assert whole.is_simple
    assert shapely.union_all(pieces).covers(whole)
    for one, two in itertools.pairwise(lines):
        assert len(ends_of(one) & ends_of(two)) == 1


def test_a_real_river_cut_into_100_pieces_is_one_line() -> None:
    pyogrio = pytest.importorskip("pyogrio")
    pytest.importorskip("geopandas")
    area = pyogrio.read_dataframe(EXAMPLES, layer="river").geometry.iloc[0]
    pieces = cut_along(area, 103)
    assert len(pieces) >= 100
    assert shapely.is_valid(pieces).all()
    lines, joints = connected(pieces, geographic=True)
    assert len([j for j in joints if j.kind == "end to end"]) == len(pieces) - 1
    whole = one_line(lines)
    assert whole.geom_type == "LineString"
    assert whole.is_simple


def cut_along(area: Polygon, count: int) -> list[Polygon]:
    """Pieces of a river, cut across from bank to bank where it is narrowest about every station."""
    strip = split(area)
    main, auxiliary = (shapely.get_coordinates(c) for c in (strip.main, strip.auxiliary))
    shapely.prepare(area)
    tree = shapely.STRtree(shapely.points(auxiliary))
    beside, width = tree.query_nearest(
        shapely.points(main), return_distance=True, all_matches=False
    )
    pieces, a, b = [], 0, 0
    for k in np.linspace(0, len(main) - 1, count + 1)[1:-1].astype(int):
        for i in k + np.argsort(width[k : k + 80]):
            j = int(beside[1, i])
            is_free = area.covers(LineString([main[i], auxiliary[j]]))
            if is_free and i > a + 2 and b + 2 < j < len(auxiliary) - 3:
                pieces.append(Polygon([*main[a : i + 1], *auxiliary[b : j + 1][::-1]]))
                a, b = i, j
                break
    pieces.append(Polygon([*main[a:], *auxiliary[b:][::-1]]))
    return pieces


def test_a_side_street_ends_on_the_main_one() -> None:
    street, side = box(0, 0, 100, 8), box(40, 8, 45, 50)
    lines, joints = connected([street, side])
    (joint,) = joints
    assert (joint.index, joint.other, joint.kind, joint.status) == (1, 0, "side", "joint")
    assert joint.point.coords[0] == (42.5, 4.0)
    assert (42.5, 4.0) in lines[0].coords
    assert (42.5, 4.0) in ends_of(lines[1])
    assert (42.5, 8.0) in lines[1].coords
    assert ends_of(lines[0]) == {(0.0, 4.0), (100.0, 4.0)}
    assert_inside(lines, [street, side])


def test_at_a_confluence_the_narrow_arm_ends_on_the_wide_ones() -> None:
    stem = Polygon([(0, 0), (100, 0), (100, 10), (100, 20), (0, 20)])
    arm = Polygon([(100, 0), (180, -60), (190, -50), (100, 14)])
    narrow = Polygon([(100, 14), (190, 60), (185, 66), (100, 20)])
    lines, joints = connected([stem, arm, narrow])
    assert [(j.index, j.other) for j in joints if j.kind == "end to end"] == [(0, 1)]
    assert [(j.index, j.other) for j in joints if j.kind == "side"] == [(2, 0)]
    assert (100.0, 7.0) in ends_of(lines[0]) & ends_of(lines[1])
    assert_inside(lines, [stem, arm, narrow])
    side = next(joint for joint in joints if joint.kind == "side")
    assert side.point.coords[0] in lines[0].coords
    assert side.point.coords[0] in ends_of(lines[2])


def crossing() -> list[Polygon]:
    """A square with two wide arms and two narrow ones."""
    wide = [box(-50, 300, 0, 310), box(10, 300, 60, 310)]
    return [box(0, 300, 10, 310), *wide, box(3, 310, 7, 400), box(3, 250, 7, 300)]


def test_a_crossing_takes_the_straight_way() -> None:
    lines, joints = connected(crossing())
    assert sorted(joint.kind for joint in joints) == ["end to end"] * 2 + ["side"] * 2
    assert ends_of(lines[0]) == {(0.0, 305.0), (10.0, 305.0)}
    assert lines[0].length == 10.0
    assert (5.0, 305.0) in lines[0].coords
    assert {(5.0, 305.0)} == ends_of(lines[3]) & ends_of(lines[4])


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_line_does_not_turn_off_into_a_neighbour_that_ends_on_its_bank(side: float) -> None:
    """As a path does that ends on all of the long side of a short strip."""
    strip, path, onwards = box(0, 0, 2, 10), box(2, 1, 40, 10), box(0, 10, 2, 60)
    areas = [scale(area, side, 1.0, origin=(0, 0)) for area in (strip, path, onwards)]
    lines, joints = connected(areas)
    made = {(joint.index, joint.other): joint.kind for joint in joints if joint.kind != "none"}
    assert made == {(0, 2): "end to end", (1, 0): "side"}
    assert ends_of(lines[0]) == {(side, 0.0), (side, 10.0)}
    assert (side, 5.5) in ends_of(lines[1]) & set(lines[0].coords)
    assert_inside(lines, areas)


def test_there_is_no_joint_along_a_road_and_its_verge() -> None:
    road, verge = box(0, 0, 100, 8), box(0, 8, 100, 12)
    lines, joints = connected([road, verge])
    (joint,) = joints
    assert (joint.kind, joint.status) == ("none", "no joint")
    assert "at an end of neither area" in joint.reason
    assert joint.point.coords[0] == (50.0, 8.0)
    for line, area in zip(lines, [road, verge], strict=True):
        assert line.equals(collapse(area))


def test_a_road_goes_on_beside_the_verge_that_goes_on() -> None:
    areas = [box(x, y, x + 50, y + w) for x in (0, 50) for y, w in ((0, 8), (8, 3))]
    lines, joints = connected(areas)
    made = {(joint.index, joint.other) for joint in joints if joint.kind == "end to end"}
    assert made == {(0, 2), (1, 3)}
    assert {joint.kind for joint in joints} == {"end to end", "none"}
    assert_inside(lines, areas)


def test_a_vertex_of_only_one_area_does_not_part_an_edge() -> None:
    a, b = (
        Polygon([(0, 0), (30, 0), (30, 7), (0, 7)]),
        Polygon([(30, 0), (60, 0), (60, 7), (30, 7)]),
    )
    turn = np.array([[0.8, -0.6], [0.6, 0.8]])
    a, b = (shapely.transform(g, lambda p: p @ turn + 1000.0 / 3.0) for g in (a, b))
    ring = shapely.get_coordinates(b)
    halved = Polygon(np.insert(ring, 4, ring[3] + 0.37 * (ring[4] - ring[3]), axis=0))
    (edge,) = find_shared_edges(np.array([a, halved])).edges
    assert len(edge.points) == 3
    lines, joints = connected([a, halved])
    assert [joint.kind for joint in joints] == ["end to end"]
    assert len(ends_of(lines[0]) & ends_of(lines[1])) == 1


def test_a_side_edge_between_vertices_of_the_main_area_is_found() -> None:
    main = Polygon([(0, 0), (90, 30), (87, 39), (-3, 9)])
    foot = np.array([[30.0, 10.0], [36.0, 12.0]])
    side = Polygon([*foot, foot[1] + (10, -30), foot[0] + (10, -30)])
    lines, joints = connected([main, side])
    assert [joint.kind for joint in joints] == ["side"]
    assert len(set(lines[0].coords) & ends_of(lines[1])) == 1


def test_order_of_areas_does_not_matter() -> None:
    areas = np.array([*river(2, 15.0, 12, 4), *crossing(), box(0, 400, 200, 408)])
    lines, joints = connected(areas)
    order = np.random.default_rng(5).permutation(areas.size)
    shuffled, again = connected(areas[order])
    for line, position in zip(shuffled, order, strict=True):
        assert shapely.normalize(line) == shapely.normalize(lines[position])
    assert {j.point.coords[0] for j in again} == {j.point.coords[0] for j in joints}


@pytest.mark.parametrize("power", [-200, -31, 1, 60, 200])
def test_doubling_is_exact(power: int) -> None:
    areas = np.array([*river(2, 15.0, 8, 4), box(0, 300, 100, 308), box(40, 308, 45, 350)])
    factor = 2.0**power
    larger = [scale(area, factor, factor, origin=(0, 0)) for area in areas]
    lines, _ = connected(areas)
    expected = [scale(line, factor, factor, origin=(0, 0)) for line in lines]
    assert all(a == b for a, b in zip(connected(larger)[0], expected, strict=True))


def test_a_neighbour_that_is_refused_is_listed() -> None:
    bow_tie = Polygon([(20, 0), (40, 8), (40, 0), (20, 8), (20, 0)])
    lines, problems = collapse([box(0, 0, 20, 8), bow_tie], connect=True, on_error="report")
    (joint,) = [problem for problem in problems if isinstance(problem, Joint)]
    assert (joint.index, joint.other, joint.kind) == (0, 1, "none")
    assert "has no line" in joint.reason
    assert lines[1] is None
    assert lines[0].length == 20.0


def test_parts_of_multipolygons_are_told_apart() -> None:
    two = shapely.MultiPolygon([box(0, 0, 20, 4), box(0, 50, 20, 54)])
    lines, joints = connected([two, box(20, 50, 60, 54)])
    (joint,) = joints
    assert (joint.index, joint.part, joint.other, joint.other_part) == (0, 1, 1, 0)
    assert one_line(shapely.get_parts([lines[0].geoms[1], lines[1]])).length == 60.0


def test_degrees_meet_too() -> None:
    areas = [box(5.0, 52.0, 5.01, 52.001), box(5.01, 52.0, 5.02, 52.001)]
    areas.append(box(5.004, 52.001, 5.005, 52.01))
    lines, joints = connected(areas, geographic=True)
    assert sorted(joint.kind for joint in joints) == ["end to end", "side"]
    assert len(ends_of(lines[0]) & ends_of(lines[1])) == 1
    assert len(ends_of(lines[2]) & set(lines[0].coords)) == 1


@pytest.mark.parametrize("turn", [0.0, 40.0, 90.0])
def test_joints_at_60_degrees_are_those_in_the_plane(turn: float) -> None:
    """There a degree of longitude is half as long as one of latitude."""
    street = [box(100, 500, 300, 508), box(140, 508, 146, 560), box(200, 460, 212, 500)]
    narrower = [box(0, 600, 60, 612), box(60, 604, 100, 613)]
    areas = np.array([*river(4, 60.0, 40, 5), *crossing(), *street, *narrower])
    areas = shapely.transform(areas, lambda p: p @ turned(turn))
    unit = np.array(lengths_at(np.array(60.0)))
    degrees = shapely.transform(areas, lambda p: p / unit + (20.0, 60.0))
    expected, in_plane = connected(areas)
    lines, joints = connected(degrees, geographic=True)
    back = shapely.transform(lines, lambda p: (p - (20.0, 60.0)) * unit)
    assert [(j.index, j.other, j.kind) for j in joints] == [
        (j.index, j.other, j.kind) for j in in_plane
    ]
    for one, two in zip(joints, in_plane, strict=True):
        place = (np.array(one.point.coords[0]) - (20.0, 60.0)) * unit
        assert place == pytest.approx(two.point.coords[0], abs=0.1)
    assert shapely.hausdorff_distance(back, expected, densify=0.1).max() < 0.5


def turned(degrees: float) -> NDArray[np.float64]:
    """Matrix of a turn."""
    x, y = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([(x, y), (-y, x)])


def test_heights_meet_in_the_same_height() -> None:
    a = Polygon([(0, 0, 1), (30, 0, 4), (30, 6, 4), (0, 6, 1)])
    b = Polygon([(30, 0, 6), (60, 0, 9), (60, 6, 9), (30, 6, 6)])
    side = Polygon([(10, 6, 2), (12, 6, 2), (12, 40, 2), (10, 40, 2)])
    lines, _ = connected([a, b, side])
    assert ends_of(lines[0]) & ends_of(lines[1]) == {(30.0, 3.0, 5.0)}
    (end,) = ends_of(lines[2]) & set(lines[0].coords)
    assert 1.0 < end[2] < 4.0


def test_index_labels_are_in_the_report() -> None:
    geopandas = pytest.importorskip("geopandas")
    series = geopandas.GeoSeries([box(0, 0, 9, 2), box(9, 0, 20, 2)], index=["west", "east"])
    lines, problems = collapse(series, connect=True, on_error="report")
    assert [(p.index, p.other, p.status) for p in problems] == [("west", "east", "joint")]
    assert list(lines.index) == ["west", "east"]


@pytest.mark.parametrize("areas", [[], [None], [box(0, 0, 9, 2)], [Polygon(), None]])
def test_areas_without_neighbours_are_as_without(areas: list[Polygon | None]) -> None:
    lines, joints = connected(areas)
    assert joints == []
    assert list(lines) == list(collapse(areas))


@pytest.mark.parametrize(
    "options",
    [{"simplify": "10%"}, {"simplify": 2.0}, {"smooth": True}, {"simplify": "5%", "smooth": True}],
)
def test_aftercare_keeps_joints(options: dict[str, Any]) -> None:
    areas = [*river(2, 15.0, 12, 6), *crossing(), box(10, 290, 60, 300)]
    _, plain = connected(areas)
    lines, joints = connected(areas, **options)
    assert [(j.index, j.other, j.kind) for j in joints] == [
        (j.index, j.other, j.kind) for j in plain
    ]
    for joint in joints:
        if joint.kind != "none":
            place = joint.point.coords[0]
            assert place in ends_of(lines[joint.index])
            assert place in lines[joint.other].coords
    assert_inside(lines, areas)


def test_simplified_lines_have_fewer_vertices_and_the_same_joints() -> None:
    street, side = box(0, 0, 100, 8), Polygon([(40, 8), (45, 8), (45, 50), (90, 95), (40, 50)])
    full, _ = connected([street, side])
    lines, (joint,) = connected([street, side], simplify="10%")
    assert (shapely.get_num_coordinates(lines) < shapely.get_num_coordinates(full)).all()
    assert list(lines[0].coords) == [(0.0, 4.0), (42.5, 4.0), (100.0, 4.0)]
    assert joint.point.coords[0] == (42.5, 4.0)


@pytest.mark.parametrize("centring", ["none", "symmetric", "centred"])
def test_lines_of_every_centring_meet(centring: str) -> None:
    areas = [*river(2, 15.0, 12, 6), *crossing()]
    lines, joints = connected(areas, centring=centring)
    made = [joint for joint in joints if joint.kind != "none"]
    assert len(made) == 11 + 4
    for joint in made:
        assert joint.point.coords[0] in ends_of(lines[joint.index])
        assert joint.point.coords[0] in lines[joint.other].coords
    assert_inside(lines, areas)


def test_an_end_without_an_edge_keeps_its_cap() -> None:
    areas = [box(0, 0, 20, 8), box(20, 0, 60, 8)]
    lines, _ = connected(areas)
    assert [line.length for line in lines] == [20.0, 40.0]
    assert ends_of(lines[0]) == {(0.0, 4.0), (20.0, 4.0)}


def test_a_hook_that_cannot_be_cut_stays() -> None:
    points = np.array([(0.0, 0.0), (0.0, 1.0), (3.0, 1.0), (3.0, -1.0), (1.0, -0.1), (1.0, 0.5)])
    chain = Chain(points.copy())
    edge = np.array([(-2.0, 2.0), (0.0, 0.0), (2.0, -2.0)])
    chain.unhook(0, box(-5, -5, 5, 5), edge, (1.0, 1.0))
    assert (chain.points == points).all()


def test_bends_beside_a_long_oblique_edge_are_no_hooks() -> None:
    points = np.array([(0.0, 0.0), (5.0, 0.0), (5.0, 0.8), (12.0, 0.8)])
    across, oblique = ([(-x, -10.0), (x, 10.0)] for x in (0.0, 100.0))
    for edge, count in ((across, 2), (oblique, 4)):
        chain = Chain(points.copy())
        chain.unhook(0, box(-20, -20, 20, 20), np.array(edge), (1.0, 1.0))
        assert len(chain.points) == count


def test_hooks_are_measured_in_lengths_of_degrees() -> None:
    points = np.array([(0.0, 0.0), (0.5, 0.0), (0.5, 0.8), (8.0, 0.8)])
    edge = np.array([(0.0, -2.0), (0.0, 2.0)])
    for unit in ((1.0, 1.0), (0.5, 1.0), (8.0, 1.0)):
        chain = Chain(points / unit)
        chain.unhook(0, box(-20, -20, 20, 20), edge / unit, unit)
        assert (chain.points * unit == points[[0, 3]]).all()


def test_ways_end_in_vertices_but_for_rounding() -> None:
    points = np.array([(1e5, 1e5), (1e5 + 30.0, 1e5 + 7.0)])
    for k in (0, 1):
        assert nearest_on(points, points[k] + 1e-11, np.ones(2)) == (0, float(k))
    assert nearest_on(points, points.mean(axis=0), np.ones(2))[1] == pytest.approx(0.5)


def test_parts_left_out_share_no_edges() -> None:
    twice = MultiPolygon([box(0, 0, 20, 8), box(0, 0, 20, 8)])
    lines, problems = collapse([twice, box(20, 0, 60, 8)], connect=True, on_error="report")
    assert [p.status for p in problems] == ["repaired", "joint"]
    assert (20.0, 4.0) in ends_of(lines[1]) & ends_of(lines[0].geoms[0])


def test_parts_refused_share_edges() -> None:
    overlapping = MultiPolygon([box(0, 0, 20, 8), box(10, 0, 20, 9)])
    _, problems = collapse([overlapping, box(20, 0, 60, 8)], connect=True, on_error="report")
    assert [p.status for p in problems[:2]] == ["refused"] * 2
    reasons = {p.reason.rpartition(": ")[2] for p in problems[2:]}
    assert "one of the areas has no line" in reasons


def test_interrupts_end_the_work_on_joints(monkeypatch: pytest.MonkeyPatch) -> None:
    areas = np.array([box(0, 0, 90, 20), box(90, 0, 150, 20), box(40, -70, 50, 0)], dtype=object)
    plan = plan_joints(areas, 3, geographic=False)
    lines = list(collapse(areas))
    contacts = {i: [c for c in plan.contacts if i in c.stretch] for i in plan.outlines}
    monkeypatch.setattr(interrupts.state, "is_asked", True)
    for work in (
        lambda: plan_joints(areas, 3, geographic=False),
        lambda: agreed_pairs(plan.outlines, contacts),
        lambda: straightened(plan, lines),
        lambda: make_joints(plan, lines),
    ):
        with pytest.raises(KeyboardInterrupt):
            work()


@pytest.mark.parametrize(
    "options",
    [
        {"ends": "main"},
        {"ends": np.array([(0.0, 1.0), (9.0, 1.0)])},
        {"along": LineString([(0, 0), (9, 0)])},
    ],
)
def test_options_that_place_ends_exclude_it(options: dict[str, Any]) -> None:
    with pytest.raises(ParameterError, match="connect places the ends"):
        collapse(box(0, 0, 9, 2), connect=True, **options)


def test_rounding_is_the_step_of_rounded_coordinates() -> None:
    random = np.random.default_rng(3)
    rounded = np.round(random.uniform(4e5, 4.1e5, (60, 2)), 3)
    assert rounding_of(rounded, 50.0) == pytest.approx(0.00075, rel=1e-6)
    assert rounding_of(rounded * 2.0**80, 50.0 * 2.0**80) == rounding_of(rounded, 50.0) * 2.0**80
    assert rounding_of(random.uniform(4e5, 4.1e5, (60, 2)), 50.0) < 1e-7
    assert rounding_of(np.array([[0.0, 0.0], [10.0, 20.0]]), 10.0) < 1e-11


def real_roads() -> Areas:
    """The road areas of a layer of the Dutch base map."""
    geopandas = pytest.importorskip("geopandas")
    frame = geopandas.read_file(FOLDER / "nl_bgt_gooi.gpkg", layer="vlak")
    roads: Areas = frame.geometry[frame.file == "wegdeel"].to_numpy()
    return roads


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
def test_order_and_scale_of_real_roads_do_not_matter() -> None:
    areas = real_roads()
    lines, _ = connected(areas)
    order = np.random.default_rng(1).permutation(areas.size)
    shuffled, _ = connected(areas[order])
    for line, position in zip(shuffled, order, strict=True):
        assert shapely.normalize(line) == shapely.normalize(lines[position])
    larger, _ = connected(shapely.transform(areas, lambda p: p * 2.0**40))
    assert (larger == shapely.transform(lines, lambda p: p * 2.0**40)).all()


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
def test_shared_edges_of_real_roads_are_joints_or_listed() -> None:
    areas = real_roads()
    lines, joints = connected(areas)
    listed = {frozenset((joint.index, joint.other)) for joint in joints}
    for i, j in pairs_that_touch(areas):
        common = shapely.intersection(areas[i].boundary, areas[j].boundary)
        width = min(mean_width(areas[i]), mean_width(areas[j]))
        if common.length > width / 2.0:
            assert frozenset((i, j)) in listed, (i, j)
    for joint in joints:
        assert joint.reason
        if joint.kind == "end to end":
            meet = ends_of(lines[joint.index]) | set(lines[joint.index].coords)
            assert joint.point.coords[0] in meet & set(lines[joint.other].coords)
        elif joint.kind == "side":
            assert joint.point.coords[0] in ends_of(lines[joint.index])
            assert joint.point.coords[0] in lines[joint.other].coords
    assert shapely.is_simple(lines).all()
    together = shapely.union_all(areas)
    shapely.prepare(together)
    assert shapely.covers(together, lines).all()


def pairs_that_touch(areas: Areas) -> list[tuple[int, int]]:
    """Pairs of areas with a point of their boundaries in common."""
    one, two = shapely.STRtree(areas).query(areas, predicate="intersects")
    return [(int(i), int(j)) for i, j in zip(one, two, strict=True) if i < j]


def mean_width(area: Polygon) -> float:
    """Twice the area over the perimeter of its shell."""
    return float(2.0 * Polygon(area.exterior).area / area.exterior.length)


@pytest.mark.parametrize(("arm", "kind"), [(30.0, "side"), (150.0, "none")])
def test_a_line_does_not_go_on_all_along_an_arm_of_its_neighbour(arm: float, kind: str) -> None:
    """The neighbour's own line passes the arm."""
    fork = shapely.union(box(0, 0, 5, 400), box(5, 200, 5 + arm, 205))
    last = box(5 + arm, 200, 65 + arm, 205)
    lines, (joint,) = connected([fork, last])
    assert joint.kind == kind
    assert_inside(lines, [fork, last])
    if kind == "none":
        assert "away, and its area" in joint.reason
        assert last.covers(lines[1])
