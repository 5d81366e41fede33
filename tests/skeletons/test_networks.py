"""Networks: crossings, junctions, loops and dead ends, in closed form and as relations."""

import itertools
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from shapely import LineString, MultiLineString, MultiPoint, Point, Polygon, affinity, box

import midrib
from midrib import collapse, network, skeleton
from midrib.curves.arms import Stretch
from midrib.curves.dead_ends import middle_of_end, site_of
from midrib.curves.networks import Change, Ending, blamed, is_straight, wrong
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError
from tests.shapes import NAMED, VALID
from tests.strategies import areas

Place = tuple[float, float]


def road(*points: Place, width: float = 2.0) -> Polygon:
    """A road along a chain, with flat ends."""
    return LineString(points).buffer(width / 2.0, cap_style="flat", join_style="mitre")


def star(*degrees: float, length: float = 20.0, width: float = 2.0) -> Polygon:
    """Roads that leave the origin."""
    turns = np.radians(degrees)
    arms = [road((0, 0), (length * np.cos(t), length * np.sin(t)), width=width) for t in turns]
    ends = np.column_stack([np.cos(turns), np.sin(turns)]) * 0.4 * width
    return shapely.union_all([*arms, Polygon(ends).convex_hull])


def nodes_of(found: MultiLineString) -> Counter[Place]:
    """How many lines end in each node."""
    return Counter(p for line in found.geoms for p in (line.coords[0][:2], line.coords[-1][:2]))


def ways_of(found: MultiLineString) -> dict[int, int]:
    """How many nodes have each number of ways."""
    return dict(Counter(nodes_of(found).values()))


def meets_at_nodes_only(found: MultiLineString) -> bool:
    """Whether lines are simple and share nothing but common ends."""
    lines = np.array(found.geoms)
    one, other = shapely.STRtree(lines).query(lines, predicate="intersects")
    for i, j in zip(one, other, strict=True):
        ends = [{line.coords[0][:2], line.coords[-1][:2]} for line in (lines[i], lines[j])]
        met = shapely.get_coordinates(lines[i].intersection(lines[j]))
        if i < j and not {tuple(p) for p in met.tolist()} <= ends[0] & ends[1]:
            return False
    return bool(shapely.is_simple(lines).all())


def cycles(lines: Sequence[Any]) -> int:
    """How many independent ways round lines from node to node have, if they are in one piece."""
    return len(lines) - len(nodes_of(MultiLineString(lines))) + 1


def off(found: MultiLineString, wanted: Any) -> float:
    """How far lines and wanted ones are apart at most."""
    return float(shapely.hausdorff_distance(found.segmentize(0.5), wanted.segmentize(0.5)))


# -- closed forms ----------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [90, 75, 60, 45, 30])
def test_two_roads_cross_in_one_node(angle: float) -> None:
    turn = np.radians(angle)
    other = LineString(np.outer([-20, 20], [np.cos(turn), np.sin(turn)]))
    area = shapely.union_all([road((-20, 0), (20, 0)), other.buffer(1, cap_style="flat")])
    found = network(area)
    assert ways_of(found) == {4: 1, 1: 4}
    assert off(found, MultiLineString([LineString([(-20, 0), (20, 0)]), other])) < 1e-9
    assert [len(line.coords) for line in found.geoms] == [2] * 4


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("apart", [1e-15, 1e-14, 1e-13])
def test_vertices_next_to_each_other_are_no_crossing_without_a_radius(apart: float) -> None:
    """Between them straight skeletons have junctions on the boundary, and branches of no length."""
    arms = [LineString([(0, 0), (50, 0)]), LineString([(25, 0), (25, 40)])]
    bent = [LineString([(0, 0), (50, 0), (80, 40)]), LineString([(10, -30), (30, 40)])]
    plans = [
        shapely.union_all(shapely.buffer(arms, 3, quad_segs=4)),
        shapely.union_all(shapely.buffer(bent, [5, 3], quad_segs=2)),
    ]
    found = 0
    for plan, seed in itertools.product(plans, range(45)):
        rng = np.random.default_rng(seed)
        ring = shapely.get_coordinates(plan.exterior)[:-1]
        at, turn = rng.integers(0, len(ring), 5), rng.uniform(0.0, 2.0 * np.pi, 5)
        off = 50.0 * apart * np.column_stack([np.cos(turn), np.sin(turn)])
        area = Polygon(np.insert(ring, at, ring[at] + off, axis=0))
        if area.is_valid:
            # A skeleton may still be refused; that is a reason, and no batch ends for it.
            lines, _ = network([area], "straight-skeleton", on_error="report")
            assert lines[0] is None or meets_at_nodes_only(lines[0])
            found += lines[0] is not None
    assert found > 10


@pytest.mark.parametrize("width", [1.0, 2.0, 3.5])
def test_a_road_goes_straight_on_past_one_that_joins_it(width: float) -> None:
    area = shapely.union_all([road((-20, 0), (20, 0)), road((3, 0), (3, 15), width=width)])
    found = network(area)
    assert ways_of(found) == {3: 1, 1: 3}
    (hub,) = (p for p, ways in nodes_of(found).items() if ways == 3)
    assert hub == pytest.approx((3, 0), abs=1e-9)
    assert off(found, shapely.from_wkt("MULTILINESTRING ((-20 0, 20 0), (3 0, 3 15))")) < 1e-9


@pytest.mark.parametrize(
    "degrees", [(90, 210, 330), (0, 100, 200), (0, 72, 144, 216, 288), (10, 55, 190, 250)]
)
def test_arms_meet_where_their_middles_do(degrees: tuple[float, ...]) -> None:
    found = network(star(*degrees))
    turns = np.radians(degrees)
    tips = 20.0 * np.column_stack([np.cos(turns), np.sin(turns)])
    assert ways_of(found) == {len(degrees): 1, 1: len(degrees)}
    assert off(found, MultiLineString([[(0, 0), tip] for tip in tips])) < 0.02


def test_a_rounded_corner_does_not_bend_a_road() -> None:
    """Fillets widen the main road long before the side road begins."""
    sharp = shapely.union_all([road((-20, 0), (20, 0)), road((0, 0), (0, 20))])
    area = sharp.buffer(2, join_style="mitre").buffer(-4).buffer(2)
    area = sharp.union(area.intersection(box(-5, 0, 5, 5)))
    found = network(area)
    assert ways_of(found) == {3: 1, 1: 3}
    assert off(found, shapely.from_wkt("MULTILINESTRING ((-20 0, 20 0), (0 0, 0 20))")) < 0.02


@pytest.mark.parametrize(("stagger", "junctions"), [(1.0, {4: 1}), (4.0, {3: 2})])
def test_staggered_roads_are_one_crossing_only_within_the_width(
    stagger: float, junctions: dict[int, int]
) -> None:
    arms = [road((-stagger / 2, 0), (-stagger / 2, -15)), road((stagger / 2, 0), (stagger / 2, 15))]
    found = network(shapely.union_all([road((-20, 0), (20, 0)), *arms]))
    assert ways_of(found) == junctions | {1: 4}


def test_a_row_of_side_roads_is_no_single_crossing() -> None:
    """Each is near the next one, but not all are near each other."""
    places = [(2.3 * k, 9.0 if k % 2 else -9.0) for k in range(8)]
    area = shapely.union_all([road((-9, 0), (26, 0)), *(road((x, 0), (x, y)) for x, y in places)])
    crossings = sum(n for ways, n in ways_of(network(area)).items() if ways > 2)
    assert 4 <= crossings <= 8


def test_crossings_are_to_blame_before_dead_ends_are() -> None:
    def change(*branches: int, inner: tuple[int, ...] = ()) -> Change:
        ending = Ending(np.zeros((1, 2)), 1)
        return Change({(b, 0): ending for b in branches}, np.array(inner, dtype=np.intp))

    changes = [change(0, 1, 2), change(0), change(3), change(4, inner=(5,))]
    assert blamed(changes, {0}) == {0}
    assert blamed(changes, {3}) == {2}
    assert blamed(changes, {1, 3}) == {0, 2}
    assert blamed(changes, {4}) == {3}
    assert blamed(changes, {9}) == set()


def wrong_ones(lines: Sequence[Sequence[Place]], area: Polygon, loops: int = 0) -> list[int]:
    """Which lines are wrong, none of whose ends are dead."""
    chains = [np.array(line, dtype=float) for line in lines]
    found: list[int] = wrong(chains, area, np.zeros((len(lines), 2), bool), loops).tolist()
    return found


def test_lines_are_wrong_that_meet_elsewhere_than_at_their_ends() -> None:
    assert wrong_ones([[(0, 0), (2, 0)], [(1, 0), (1, 1)]], box(0, -1, 2, 2)) == [0, 1]
    joined: list[list[Place]] = [[(0, 0), (1, 0)], [(1, 0), (1, 1)]]
    assert wrong_ones(joined, box(0, -1, 2, 2)) == []
    assert wrong_ones(joined, box(0, -1, 2, 0.5)) == [1]


@pytest.mark.parametrize("point", [[(0, 0)], [(0, 0), (0, 0)], [(0, 0), (1, 1), (0, 0)]])
def test_lines_are_wrong_that_go_nowhere(point: list[Place]) -> None:
    """A branch that leads back to its crossing, cut from both ends, may have nothing left."""
    assert wrong_ones([[(0, 0), (2, 0)], point], box(-1, -1, 2, 2), loops=1) == [1]


def test_a_way_there_and_back_is_not_straight() -> None:
    chain, site = np.array([(0.0, 0.0), (1.0, 1.0), (0.0, 0.0)]), site_of(box(-1, -1, 2, 2), (1, 1))
    assert not is_straight(chain, 1, site)


def test_all_lines_are_wrong_that_do_not_go_round_as_often() -> None:
    ring: list[list[Place]] = [[(0, 0), (1, 1), (2, 0)], [(2, 0), (0, 0)]]
    assert wrong_ones(ring, box(-1, -1, 3, 2), loops=1) == []
    assert wrong_ones(ring, box(-1, -1, 3, 2), loops=2) == [0, 1]
    chains = [np.array(line, dtype=float) for line in ring]
    dead = np.array([[True, False], [False, True]])  # two that meet are no way round
    assert wrong(chains, box(-1, -1, 3, 2), dead, 0).size == 0


def test_a_grid_of_streets() -> None:
    streets = [road((-10, y), (70, y), width=3) for y in (0, 20, 40)]
    avenues = [road((x, -10), (x, 50), width=2 + x / 20) for x in (0, 20, 40, 60)]
    found = network(shapely.union_all(streets + avenues))
    assert ways_of(found) == {4: 12, 1: 14}
    crossings = sorted(p for p, ways in nodes_of(found).items() if ways == 4)
    wanted = sorted((x, y) for x in (0, 20, 40, 60) for y in (0, 20, 40))
    np.testing.assert_allclose(crossings, wanted, atol=1e-9)
    assert cycles(list(found.geoms)) == 6


def test_a_roundabout_keeps_its_loop() -> None:
    ring = Point(0, 0).buffer(10, quad_segs=32).difference(Point(0, 0).buffer(7, quad_segs=32))
    turns = np.radians([0, 80, 180, 270])
    arms = [road(*np.outer([8.5, 30], [np.cos(t), np.sin(t)])) for t in turns]
    found = network(shapely.union_all([ring, *arms]))
    assert ways_of(found) == {3: 4, 1: 4}
    assert cycles(list(found.geoms)) == 1
    hubs = np.array([p for p, ways in nodes_of(found).items() if ways == 3])
    assert np.hypot(*hubs.T) == pytest.approx(8.5, abs=0.05)
    on_ring = [line for line in found.geoms if Point(0, 0).distance(line) < 9 and line.length < 20]
    assert np.hypot(*shapely.get_coordinates(on_ring).T) == pytest.approx(8.5, abs=0.1)


def test_an_island_in_a_crossing_keeps_its_way_round() -> None:
    cross = shapely.union_all([road((-20, 0), (20, 0), width=4), road((0, -20), (0, 20), width=4)])
    found = network(cross.difference(Point(0.3, 0.2).buffer(0.2)))
    assert cycles(list(found.geoms)) == 1


@pytest.mark.parametrize(
    "cut",
    [[(20, -1), (20, 1)], [(19, -1), (21, 1)], [(19.5, -1), (20, -0.6), (20, 0.6), (19.5, 1)]],
)
def test_dead_ends_reach_the_middle_of_the_end(cut: list[Place]) -> None:
    """A square end, a skew one, and one with its corners cut off."""
    area = Polygon([(-20, -1), *cut, (1, 1), (1, 15), (-1, 15), (-1, 1), (-20, 1)])
    tips = {p for p, ways in nodes_of(network(area)).items() if ways == 1}
    assert min(Point(20, 0).distance(Point(tip)) for tip in tips) < 1e-9


@pytest.mark.parametrize("method", ["medial-axis", "chordal-axis", "straight-skeleton"])
@pytest.mark.parametrize("degrees", [0, 25])
@pytest.mark.parametrize("skew", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("beside", [1.2, 2.0, 19.0])
def test_dead_ends_of_every_skeleton_are_in_the_middle(
    method: str, degrees: float, skew: float, beside: float
) -> None:
    """The last side of a triangulation leads into a corner, from however far away."""
    end = [(20 - skew, -1), (20 + skew, 1), (20 + skew - beside, 1)]
    flat = [(-20, -1), *end, (1, 1), (1, 15), (-1, 15), (-1, 1), (-20, 1)]
    area = affinity.rotate(Polygon(flat), degrees, origin=(0, 0))
    ways = nodes_of(network(area, method))
    found = affinity.rotate(MultiPoint([p for p, n in ways.items() if n == 1]), -degrees, (0, 0))
    assert found.hausdorff_distance(MultiPoint([(-20, 0), (20, 0), (0, 15)])) < 1e-9


@pytest.mark.parametrize("method", ["medial-axis", "chordal-axis", "straight-skeleton"])
@pytest.mark.parametrize("degrees", [0, 25])
@pytest.mark.parametrize("skew", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("pieces", [2, 3, 8])
@pytest.mark.parametrize("apart", [0.3, 0.5, 0.9, 50.0])
def test_vertices_within_walls_move_no_dead_end(
    method: str, degrees: float, skew: float, pieces: int, apart: float
) -> None:
    """A branch into a corner has points where walls begin, or is pruned up to one of these."""
    share = np.linspace(0.0, 1.0, pieces + 1)[:, None]
    end = np.array([20 - skew, -1.0]) + share * np.array([2.0 * skew, 2.0])
    flat = [(-20, -1), *map(tuple, end), (1, 1), (1, 15), (-1, 15), (-1, 1), (-20, 1)]
    area = affinity.rotate(Polygon(flat).segmentize(apart), degrees, origin=(0, 0))
    ways = nodes_of(network(area, method))
    found = affinity.rotate(MultiPoint([p for p, n in ways.items() if n == 1]), -degrees, (0, 0))
    assert found.hausdorff_distance(MultiPoint([(-20, 0), (20, 0), (0, 15)])) < 1e-9


@pytest.mark.parametrize("degrees", range(0, 360, 45))
def test_the_flat_end_is_the_wall_ahead_not_one_beside(degrees: float) -> None:
    turn = np.radians(degrees)
    rotation = np.array([(np.cos(turn), np.sin(turn)), (-np.sin(turn), np.cos(turn))])
    ring = np.array([(0, 1), (-2, 1), (-9, 1), (-9, -1), (0, -1)]) @ rotation
    points = np.array([(0, 1), (-1, 0), (-2, -0.1)]) @ rotation
    stretch = Stretch(np.array([0.0, 1.4, 2.4]), points, np.array([0.0, 1.0, 0.9]))
    found = middle_of_end(stretch, site_of(Polygon(ring), (1.0, 1.0)))
    assert found is not None
    assert found[0] == pytest.approx((0, 0))
    assert found[1] == 1


@pytest.mark.parametrize("method", ["medial-axis", "chordal-axis", "straight-skeleton"])
def test_pointed_ends_are_in_the_point(method: str) -> None:
    points = [(-20, 0), (-1, -1), (1, -1), (20, 0.3), (1, 1), (0.2, 15), (-1, 1)]
    ways = nodes_of(network(Polygon(points), method))
    found = sorted(p for p, n in ways.items() if n == 1)
    assert found == pytest.approx(np.array([(-20, 0), (0.2, 15), (20, 0.3)]), abs=1e-12)


def test_a_notch_in_a_corner_does_not_lead_there() -> None:
    area = star(0, 120, 240).difference(box(19.9, 0.9, 20.1, 1.1))
    tips = [p for p, ways in nodes_of(network(area)).items() if ways == 1]
    assert min(Point(20, 0).distance(Point(tip)) for tip in tips) < 0.02


# -- relations -------------------------------------------------------------------------------------


def check(area: Polygon, **options: Any) -> None:
    """Lines are inside, meet at nodes only, and go round what the skeleton goes round."""
    found = network(area, **options)
    whole = skeleton(area, options.get("method", "medial-axis"))
    assert area.covers(found)
    assert meets_at_nodes_only(found)
    if area.boundary.is_simple:  # where rings touch, two dead ends may be one point
        assert cycles(list(found.geoms)) == len(whole.edges) - len(whole.points) + 1


@given(area=areas)
@settings(max_examples=60)
def test_networks_are_inside_and_meet_at_nodes_only(area: Polygon) -> None:
    check(area)
    check(area, merge=3.0, min_significance=None)


@pytest.mark.parametrize("name", sorted(VALID))
def test_awkward_areas_have_networks(name: str) -> None:
    for merge in (0.0, 1.0, 10.0):
        check(VALID[name], merge=merge)


@pytest.mark.parametrize("method", ["chordal-axis", "straight-skeleton", "point-voronoi"])
def test_every_skeleton_makes_a_network(method: str) -> None:
    grid = shapely.union_all([road((-9, 0), (9, 0)), road((-4, -9), (-4, 9)), road((4, 0), (4, 9))])
    check(grid, method=method)
    check(grid, method=method, merge=0.0)  # points of a skeleton in one place stay apart
    found = network(grid, method)
    assert off(found, network(grid)) < 0.65
    assert ways_of(found) == {4: 1, 3: 1, 1: 5}
    for line in found.geoms:
        steps = np.diff(shapely.get_coordinates(line), axis=0)
        assert ((steps[:-1] * steps[1:]).sum(axis=1) > 0.0).all()  # none turns back


def test_without_merging_there_are_the_junctions_of_the_skeleton() -> None:
    area = shapely.union_all([road((-20, 0), (20, 0)), road((-15, -15), (15, 15))])
    assert ways_of(network(area, merge=0)) == {3: 2, 1: 4}
    assert ways_of(network(area)) == {4: 1, 1: 4}


def test_more_merging_never_makes_more_nodes() -> None:
    streets = [road((-20, 0), (20, 0)), road((-5, -9), (-5, 0)), road((-3.5, 0), (-3.5, 9))]
    area = shapely.union_all([*streets, road((4, -9), (4, 0)), road((8.5, 0), (8.5, 9))])
    counts = [len(nodes_of(network(area, merge=merge))) for merge in (0.0, 0.5, 1.0, 2.0, 4.0)]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > counts[-1]


@pytest.mark.parametrize("name", ["L", "nearly_flat", "chevron", "needle", "stadium"])
def test_areas_without_junctions_have_their_trunk(name: str) -> None:
    area = NAMED.get(name, Point(0, 0).buffer(1).union(box(0, -1, 9, 1)))
    assert list(network(area).geoms) == [collapse(area, "medial-axis")]


@pytest.mark.parametrize("power", [-40, -3, 5, 60])
def test_doubling_is_exact(power: int) -> None:
    area = star(0, 50, 170, 290)
    larger = affinity.scale(area, 2.0**power, 2.0**power, origin=(0, 0))
    expected = affinity.scale(network(area), 2.0**power, 2.0**power, origin=(0, 0))
    assert network(larger).equals(expected)


def test_networks_turn_and_move_with_their_area() -> None:
    def moved(geometry: Any) -> Any:
        return affinity.translate(affinity.rotate(geometry, 30, origin=(0, 0)), 6e5, 5e6)

    area = shapely.union_all(
        [star(0, 50, 170, 290), road((15, 0), (15, -9)), road((9, 3), (9, -8))]
    )
    assert off(moved(network(area)), network(moved(area))) < 1e-6


def test_degrees_are_lengths_of_a_plane() -> None:
    def squeezed(geometry: Any) -> Any:
        return affinity.translate(affinity.scale(geometry, 2e-5, 1e-5, origin=(0, 0)), 18, 60)

    found = network(squeezed(star(0, 50, 170, 290)), geographic=True)
    assert off(found, squeezed(network(star(0, 50, 170, 290)))) < 2e-7


def test_heights_are_carried_along() -> None:
    area = shapely.transform(
        shapely.force_3d(star(0, 120, 240)),
        lambda p: np.column_stack([p[:, :2], 2.0 * p[:, 0] + p[:, 1]]),
        include_z=True,
    )
    points = shapely.get_coordinates(network(area), include_z=True)
    np.testing.assert_allclose(points[:, 2], 2.0 * points[:, 0] + points[:, 1], atol=1e-9)


# -- arrays, and what is refused -------------------------------------------------------------------


def test_arrays_are_like_each_alone() -> None:
    shapes = np.array([[star(0, 120, 240), None], [box(0, 0, 9, 2), Polygon()]], dtype=object)
    found = network(shapes)
    assert found.shape == (2, 2)
    assert found[0, 0].equals_exact(network(shapes[0, 0]), 0.0)
    assert found[0, 1] is None
    assert found[1, 1].wkt == "MULTILINESTRING EMPTY"
    both = shapely.MultiPolygon([box(0, 0, 9, 2), box(0, 5, 9, 7)])
    assert network(both).wkt == "MULTILINESTRING ((0 1, 1 1, 8 1, 9 1), (0 6, 1 6, 8 6, 9 6))"


def test_a_series_keeps_index_and_crs() -> None:
    geopandas = pytest.importorskip("geopandas")
    series = geopandas.GeoSeries([star(0, 120, 240)], index=["a"], crs="EPSG:28992")
    found = network(series)
    assert list(found.index) == ["a"]
    assert found.crs == series.crs
    bow_tie = geopandas.GeoSeries([Polygon([(0, 0), (1, 1), (1, 0), (0, 1)])], index=["b"])
    lines, (problem,) = network(bow_tie, on_error="report")
    assert lines["b"] is None
    assert (problem.index, problem.status) == ("b", "refused")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"merge": -1}, "merge is -1, expected a number of 0 or more"),
        ({"merge": "all"}, "merge is 'all', expected a number of 0 or more"),
        ({"method": "minimal-radii"}, "method is 'minimal-radii', expected 'medial-axis' or"),
        ({"min_significance": -1}, "min_significance is -1"),
        ({"on_error": "ignore"}, "on_error is 'ignore', expected 'raise' or 'report'"),
        ({"spacing": 1}, "method 'medial-axis' has no option 'spacing'"),
    ],
)
def test_wrong_options_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        network(box(0, 0, 9, 2), **options)


def test_what_is_no_area_is_refused() -> None:
    with pytest.raises(GeometryTypeError, match=r"areas\[0\]: is a Point"):
        network(Point(0, 0))
    with pytest.raises(InvalidAreaError, match="more than one way"):
        network(Polygon([(0, 0), (1, 1), (1, 0), (0, 1)]))


def test_it_is_a_public_name() -> None:
    assert "network" in midrib.__all__


@pytest.mark.parametrize("method", ["medial-axis", "straight-skeleton", "chordal-axis"])
@pytest.mark.filterwarnings("error")
def test_a_vertex_that_is_there_twice_is_no_wall(method: Any) -> None:
    bar, stem = shapely.box(0.0, 0.0, 40.0, 4.0), shapely.box(18.0, -20.0, 22.0, 0.0)
    corners = shapely.get_coordinates(shapely.union_all([bar, stem]))
    whole = network(shapely.Polygon(corners), method)
    for k in range(len(corners) - 1):
        twice = np.insert(corners, k, corners[k], axis=0)
        assert network(shapely.Polygon(twice), method).equals_exact(whole, 1e-9, normalize=True)
