"""The medial axis: closed forms, radii, tips and cycles."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from shapely import LinearRing, Point, Polygon, box
from shapely.affinity import rotate, translate

import midrib
from midrib import Skeleton, skeleton
from midrib.curves import axes
from midrib.curves.turning import turned, turned_back
from midrib.errors import InvariantError
from midrib.kernels.medial import Fault, medial_axis
from midrib.layout import boundary_of
from midrib.ragged import rings_of_area
from tests.shapes import NAMED, VALID, rectangle, wavy_ribbon, wedge
from tests.strategies import crowded, simple_areas, turn, with_holes

GAPS = [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3]  # by which what would tie or touch is moved


def checked(area: Polygon, **options: Any) -> Skeleton:
    """Medial axis of an area, and whatever holds for every one.

    Radii are distances to the boundary; it is inside, and in one piece; it goes round every ring
    or group of rings that touch but one; it ends in convex vertices, each of them once.
    """
    found: midrib.Skeleton = skeleton(area, "medial-axis", **options)
    size = np.hypot(area.bounds[2] - area.bounds[0], area.bounds[3] - area.bounds[1])
    distance = shapely.distance(shapely.points(found.points), area.boundary)
    assert found.radius == pytest.approx(distance, abs=1e-9 * size)
    middles = shapely.points(found.points[found.edges].mean(axis=1))
    grown = area.buffer(1e-9 * size + 1e-13 * np.abs(area.bounds).max())
    assert shapely.covers(grown, middles).all()
    assert parts_of(found.edges, len(found.points)) == 1
    rings = [area.exterior, *area.interiors]
    touching = shapely.STRtree(rings).query(rings, predicate="intersects").T
    loops = parts_of(touching, len(rings))
    assert len(found.edges) - len(found.points) + 1 == loops - 1
    degree = np.bincount(found.edges.ravel(), minlength=len(found.points))
    assert (found.radius[degree == 1] == 0.0).all()
    if loops == len(rings):
        convex = [corner for k, ring in enumerate(rings) for corner in convex_in(ring, k == 0)]
        tips = map(tuple, found.points[degree == 1].tolist())
        assert sorted(tips) == sorted(convex)
    return found


def parts_of(edges: Any, count: int) -> int:
    """Of how many pieces a graph is."""
    links = coo_matrix((np.ones(len(edges)), np.asarray(edges).T), shape=(count, count))
    return int(connected_components(links, directed=False)[0])


def convex_in(ring: LinearRing, is_shell: bool) -> list[tuple[float, float]]:
    """Vertices at which an area has less than half a turn, exactly."""
    corners = list(ring.coords)[:-1]
    if ring.is_ccw != is_shell:
        corners.reverse()
    exact = [(Fraction(x), Fraction(y)) for x, y in corners]
    trios = zip(exact[-1:] + exact[:-1], exact, exact[1:] + exact[:1], strict=True)
    return [corner for corner, trio in zip(corners, trios, strict=True) if turn(*trio) > 0]


def squares(n: int, gap: float = 0.0) -> Polygon:
    """A square with n times n equal holes, each moved by something of a size."""
    moved = np.random.default_rng(n).uniform(-gap, gap, (n, n, 2))
    holes = [
        translate(box(2 * i + 1, 2 * j + 1, 2 * i + 2, 2 * j + 2), *moved[i, j]).exterior
        for i in range(n)
        for j in range(n)
    ]
    return Polygon(box(0, 0, 2 * n + 1, 2 * n + 1).exterior, holes)


def regular(n: int, radius: float, at: tuple[float, float] = (0.0, 0.0), by: float = 0.0) -> Any:
    """Corners of a regular polygon."""
    angle = 2.0 * np.pi * np.arange(n) / n + by
    return np.column_stack([np.cos(angle), np.sin(angle)]) * radius + at


@pytest.mark.parametrize("gap", GAPS)
@pytest.mark.parametrize("n", [2, 3, 5])
def test_lattices_of_equal_holes_have_an_axis(n: int, gap: float) -> None:
    """Four discs of a lattice meet in every crossing, and four walls touch each at once."""
    found = checked(squares(n, gap))
    if gap == 0.0:
        degree = np.bincount(found.edges.ravel())
        assert np.count_nonzero(degree == 4) >= (n - 1) ** 2


@pytest.mark.parametrize("corners", [3, 4, 5, 6, 12])
@pytest.mark.parametrize("holes", [3, 4, 6, 7])
def test_circles_of_equal_holes_have_an_axis(holes: int, corners: int) -> None:
    at = regular(holes, 3.0)
    turns = 2.0 * np.pi * np.arange(holes) / holes
    rings = [regular(corners, 0.7, tuple(p), by) for p, by in zip(at, turns, strict=True)]
    checked(Polygon(regular(48, 5.0), rings))
    checked(Polygon(regular(48, 5.0), [*rings, regular(holes, 0.5)]))


@pytest.mark.parametrize("gap", GAPS)
def test_holes_that_touch_or_nearly_do_have_an_axis(gap: float) -> None:
    diamonds = [
        Point(2 * i, 2 * j).buffer(1.0 - gap, quad_segs=1).exterior
        for i in range(1, 4)
        for j in range(1, 4)
        if (i, j) != (2, 2)
    ]
    area = Polygon(box(0, 0, 8, 8).exterior, diamonds[:3] + diamonds[4:])
    assert area.is_valid
    checked(area)
    checked(rotate(area, 30.0, origin=(0, 0)))


HARD = {
    "a_wall_that_is_come_back_to_past_a_hole": (
        "POLYGON ((-5.401487596303488 -1.4724606995627234, 1.771932597536889 5.725933484007575, "
        "2.252176970067347 -2.0508627238492507, -5.401487596303488 -1.4724606995627234), "
        "(-3.7539465998907566 0.1558782220764319, -3.7559760540932867 0.1369656676610491, "
        "-3.744471942261368 0.1393847608968959, -3.7539465998907566 0.1558782220764319))"
    ),
    "half_a_turn_at_a_vertex_of_two_rings": (
        "POLYGON ((0 4, 0 6, 4 6, 2 2, 0 3, 1 4, 0 4), (1 3, 2 4, 1 4, 1 3), (2 5, 3 5, 3 6, 2 5))"
    ),
    "a_gap_that_rounding_closes": (
        "POLYGON ((8 0, 8 6, 0 6, 0 0, 8 0), (1.9999999999999996 0.9999999999999994, "
        "3 1.9999999999999998, 2.0000000000000004 3, 1.9999999999999996 0.9999999999999994), "
        "(3 2, 4 1, 4 3, 3 2))"
    ),
    "a_gap_of_one_unit_in_the_last_place": (
        "POLYGON ((8 0, 8 8, 0 8, 0 0, 8 0), (2.0000000000000004 0.9999999999999996, "
        "2.999999999999999 2.0000000000000004, 2.0000000000000004 3, "
        "2.0000000000000004 0.9999999999999996), (3.999999999999999 5.000000000000001, "
        "5 5.999999999999999, 4 7.000000000000001, 3.999999999999999 5.000000000000001), "
        "(6 1, 7 2, 6 3, 6 1), (6.000000000000001 2.9999999999999996, 7 4.000000000000001, "
        "6.000000000000001 5, 6.000000000000001 2.9999999999999996))"
    ),
}


@pytest.mark.parametrize("name", sorted(HARD))
def test_areas_that_random_search_found_have_an_axis(name: str) -> None:
    checked(shapely.from_wkt(HARD[name]))


COURTS = (
    "POLYGON ((4 0, 5 0, 6 0, 7 0, 8 0, 8 -1, 8 -2, 7.5 -2.5, 8 -3, 8 -4, 8 -5, 8 -6, 7.5 -5.5, "
    "7 -6, 7 -7, 6.5 -7.5, 7 -8, 6 -8, 5 -8, 4.5 -7.5, 4 -8, 3 -8, 2 -8, 2.5 -7.5, 2 -7, 3 -7, "
    "3.5 -6.5, 3 -6, 3.5 -5.5, 3 -5, 2 -5, 1 -5, 1 -4, 2 -4, 2 -3, 1.5 -2.5, 1 -3, 1 -2, "
    "1.5 -1.5, 1 -1, 1.5 -0.5, 1 0, 2 0, 3 0, 4 0), (4 -4, 4.5 -3.5, 5 -3, 4 -3, 4 -4), "
    "(5.5 -2.5, 6 -2, 5 -2, 5 -3, 5.5 -2.5), (3.5 -4.5, 3 -4, 3 -5, 3.5 -4.5), "
    "(6 -3, 6.5 -3.5, 7 -3, 6 -3), (6.5 -4.5, 7 -5, 7 -4, 6.5 -4.5), "
    "(6 -5, 6.5 -5.5, 7 -5, 6 -5), (5.5 -4.5, 5 -4, 5 -5, 5.5 -4.5))"
)


@pytest.mark.parametrize("angle", range(0, 90, 3))
def test_where_rings_touch_a_disc_meets_the_corner_that_it_is_in(angle: int) -> None:
    """Turned by 0.2 to 12 and by 60 to 88 degrees, half a turn at a touch is a bit less."""
    straight = shapely.from_wkt(COURTS)
    for tenth in range(0, 30, 2):
        area = rotate(straight, angle + tenth / 10.0, origin=(0, 0))
        mesh = boundary_of(*rings_of_area(area)).mesh
        assert medial_axis(mesh, 1.0, 1.0, 1e-3, 0.0)[0], angle + tenth / 10.0
    checked(area)


NARROW = {
    "a_step": (
        33.75,
        "POLYGON ((1 9, 2 9, 3 9, 4 9, 4 8, 3 8, 3 7, 2 7, 1 7, 0 7, 0.5 7.5, 0 8, 1 8, 1 9), "
        "(1.9999999999983127 7.999999999994474, 2.499999999998313 7.499999999994474, "
        "2.999999999998313 7.999999999994474, 1.9999999999983127 7.999999999994474))",
    ),
    "two_holes": (
        0.0,
        "POLYGON ((0 3, 0 4, 0.5 3.5, 1 4, 1 3, 1.5 2.5, 2 3, 2.5 2.5, 3 3, 3 2, 3 1, 2.5 1.5, "
        "2 1, 1.5 0.5, 2 0, 1 0, 0 0, 0 1, 0 2, 0 3), (0.9999999999961652 1.9999999999981828, "
        "0.9999999999961652 0.9999999999981828, 1.4999999999961653 1.4999999999981828, "
        "0.9999999999961652 1.9999999999981828), (1.4255425330476384e-12 2.0000000000019256, "
        "1.0000000000014255 2.0000000000019256, 0.5000000000014255 2.5000000000019256, "
        "1.4255425330476384e-12 2.0000000000019256))",
    ),
}


@pytest.mark.parametrize("name", sorted(NARROW))
def test_a_cut_of_a_gap_of_billionths_stays_inside(name: str) -> None:
    """What reaches into a disc as far as this gap is wide is no rounding."""
    angle, text = NARROW[name]
    area = rotate(shapely.from_wkt(text), angle, origin=(0, 0))
    mesh = boundary_of(*rings_of_area(area)).mesh
    assert medial_axis(mesh, 1.0, 1.0, 1e-3, 0.0)[0]
    checked(area)


def test_a_turned_mesh_is_turned_back_with_its_vertices_bit_by_bit() -> None:
    mesh = boundary_of(*rings_of_area(VALID["comb"])).mesh
    for angle, scale in ((1.0, np.array([1.0, 1.0])), (5.0, np.array([0.5, 2.0]))):
        there = turned(mesh, angle, scale)
        assert np.hypot(np.diff(there.x), np.diff(there.y)) == pytest.approx(
            np.hypot(np.diff(mesh.x) * scale[0], np.diff(mesh.y) * scale[1])
        )
        points = np.column_stack([there.x, there.y])
        is_vertex = np.arange(len(points)) % 2 == 0
        back = turned_back(points, is_vertex, mesh, angle, scale)
        vertices = np.column_stack([mesh.x, mesh.y])
        assert (back[is_vertex] == vertices[is_vertex]).all()
        assert back == pytest.approx(vertices, abs=1e-12)


SAMPLES = 400
DISCS = {
    **{name: VALID[name] for name in ("L", "comb", "three_islands")},
    "courts": rotate(shapely.from_wkt(COURTS), 0.2, origin=(0, 0)),
    "ribbon": wavy_ribbon(12, 1.0),
    "with_hole": box(0, 0, 9, 7).difference(rotate(box(3, 2, 5, 4), 20)),
}


@pytest.mark.parametrize("name", sorted(DISCS))
def test_discs_that_grow_from_the_boundary_end_on_the_axis(name: str) -> None:
    """Each is held by its foot and grows until it touches something else: brute force."""
    area = DISCS[name]
    tolerance = 1e-5
    axis = skeleton(area, "medial-axis", tolerance=tolerance).lines
    low_x, low_y, high_x, high_y = area.bounds
    rng = np.random.default_rng(0)
    places = rng.uniform([low_x, low_y], [high_x, high_y], (SAMPLES, 2))
    places = places[shapely.covers(area, shapely.points(places))]
    nearest = shapely.shortest_line(shapely.points(places), area.boundary)
    feet = shapely.get_coordinates(nearest)[1::2]
    inwards = places - feet
    far = np.hypot(*inwards.T)
    inwards /= far[:, None]
    low, high = far * (1 - 1e-9), np.full(len(far), high_x - low_x + high_y - low_y)
    for _ in range(60):
        radius = (low + high) / 2.0
        centres = shapely.points(feet + radius[:, None] * inwards)
        is_free = shapely.distance(centres, area.boundary) >= radius * (1 - 1e-12)
        low, high = np.where(is_free, radius, low), np.where(is_free, high, radius)
    centres = shapely.points(feet + low[:, None] * inwards)
    assert shapely.distance(centres, axis).max() < 10.0 * tolerance


@given(area=crowded())
@settings(max_examples=150)
def test_crowds_of_holes_have_an_axis(area: Polygon) -> None:
    checked(area)


@given(area=with_holes())
@settings(max_examples=100)
def test_areas_with_holes_have_an_axis(area: Polygon) -> None:
    checked(area)


@pytest.mark.parametrize("name", sorted(VALID))
def test_radii_are_distances(name: str) -> None:
    checked(VALID[name])


@pytest.mark.parametrize("name", sorted(NAMED))
def test_every_hole_is_gone_round_once(name: str) -> None:
    found = checked(NAMED[name])
    assert len(found.edges) - len(found.points) + 1 == len(NAMED[name].interiors)


@given(area=simple_areas)
@settings(max_examples=80)
def test_areas_without_holes_have_trees(area: Polygon) -> None:
    found = checked(area)
    assert len(found.edges) == len(found.points) - 1


def test_a_rectangle_has_a_middle_and_four_bisectors() -> None:
    lines = checked(box(0, 0, 9, 2)).lines
    middle = shapely.from_wkt("LINESTRING (1 1, 8 1)")
    corners = ["(0 0, 1 1)", "(0 2, 1 1)", "(9 0, 8 1)", "(9 2, 8 1)"]
    wanted = shapely.union_all([middle, *(shapely.from_wkt(f"LINESTRING {c}") for c in corners)])
    assert lines.hausdorff_distance(wanted) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("n", [3, 4, 5, 6, 7, 12, 64])
def test_a_regular_polygon_has_spokes(n: int) -> None:
    turn = 2.0 * np.pi * np.arange(n) / n
    found = checked(Polygon(np.column_stack([np.cos(turn), np.sin(turn)])))
    assert len(found.branches) == n
    assert found.lines.length == pytest.approx(n)
    assert found.radius.max() == pytest.approx(np.cos(np.pi / n))


def test_an_arc_is_as_near_as_stated() -> None:
    area = NAMED["L"]
    fine = skeleton(area, "medial-axis", tolerance=1e-6).lines
    coarse = skeleton(area, "medial-axis", tolerance=1e-2).lines
    assert len(shapely.get_coordinates(coarse)) < len(shapely.get_coordinates(fine))
    assert coarse.hausdorff_distance(fine) <= 1e-2 + 1e-6


@pytest.mark.parametrize("name", ["L", "comb", "river_with_island", "ring_road"])
def test_the_axis_moves_with_its_area(name: str) -> None:
    one = checked(NAMED[name]).lines
    moved = checked(translate(rotate(NAMED[name], 33.0, origin=(0, 0)), 5e5, 5e6)).lines
    there = translate(rotate(one, 33.0, origin=(0, 0)), 5e5, 5e6)
    assert moved.hausdorff_distance(there) < 1e-3
    assert moved.length == pytest.approx(one.length, abs=1e-3)


# -- closed forms ----------------------------------------------------------------------------------


@pytest.mark.parametrize("beta", [0.01, 0.5, 2.0, 3.1])
def test_a_wedge_meets_in_its_incentre(beta: float) -> None:
    area = wedge(beta, 5.0)
    found = checked(area)
    assert len(found.points) == 4
    deepest = found.radius.argmax()
    assert found.radius[deepest] == pytest.approx(2.0 * area.area / area.length)
    x, y = found.points[deepest]
    assert np.arctan2(y, x) == pytest.approx(beta / 2)


@pytest.mark.parametrize(("long", "wide"), [(10.0, 2.0), (7.0, 3.0)])
def test_a_corner_of_two_arms_is_an_arc(long: float, wide: float) -> None:
    """Beyond the inner corner the outer walls run with it at the focus: two halves of parabolas."""
    corners = [(0, 0), (long, 0), (long, wide), (wide, wide), (wide, long), (0, long)]
    found = checked(Polygon(corners), tolerance=1e-4)
    degree = np.bincount(found.edges.ravel())
    half, diagonal = wide / 2.0, wide * (2.0 - np.sqrt(2.0))
    junctions = found.points[degree == 3]
    expected = [(diagonal, diagonal), (long - half, half), (half, long - half)]
    assert junctions[junctions[:, 0].argsort()] == pytest.approx(np.array(sorted(expected)))
    x, y = found.points.T
    is_low = (x > y + 1e-9) & (x <= wide)  # below the diagonal: as far from y = 0 as from (w, w)
    assert np.count_nonzero(is_low) > 2
    assert y[is_low] == pytest.approx(np.hypot(x[is_low] - wide, y[is_low] - wide))
    is_flat = (x >= wide) & (found.radius > 0.0)
    assert y[is_flat] == pytest.approx(half)


@pytest.mark.parametrize(("size", "inner"), [(10.0, 4.0), (6.0, 1.0)])
def test_a_square_ring_goes_halfway_and_round_its_corners(size: float, inner: float) -> None:
    low, high = (size - inner) / 2.0, (size + inner) / 2.0
    found = checked(Polygon(box(0, 0, size, size).exterior, [box(low, low, high, high).exterior]))
    half, corner = low / 2.0, low * (2.0 - np.sqrt(2.0))
    assert found.radius.max() == pytest.approx(corner)
    x, y = found.points.T
    beside = (x >= low) & (x <= high)
    assert np.minimum(y, size - y)[beside] == pytest.approx(half)
    focus = np.hypot(x - low, y - low)
    bent = (x < low) & (y < low) & (found.radius > 0.0)
    assert np.minimum(x, y)[bent] == pytest.approx(focus[bent])
    straight = 4.0 * inner + 4.0 * np.hypot(corner, corner)
    # An arc of the parabola of focal length low / 2, from its vertex to where it is at 45 degrees.
    s = (low - corner) / low
    arc = low / 2.0 * (s * np.sqrt(1.0 + s * s) + np.arcsinh(s))
    assert skeleton(found.area, tolerance=1e-7).lines.length == pytest.approx(
        straight + 8.0 * arc, rel=1e-6
    )


# -- trunk -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "area", [rectangle(20, 2), wavy_ribbon(60, 0.8), NAMED["chevron"], NAMED["river_with_island"]]
)
def test_the_centred_line_is_the_trunk(area: Polygon) -> None:
    """Where every disc touches both sides, which it does away from the ends."""
    trunk = midrib.collapse(area, "medial-axis")
    line = midrib.collapse(area, centring="centred")
    strip = midrib.split(area)
    width = area.area / (area.length / 2.0)
    ends = shapely.union_all([Point(trunk.coords[0]), Point(trunk.coords[-1])]).buffer(1.5 * width)
    assert strip.area.covers(line)
    apart = shapely.hausdorff_distance(line.difference(ends), trunk.difference(ends), 0.01)
    assert apart < 0.05 * width


def test_an_axis_that_was_not_found_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    nothing = np.empty((0, 2)), np.empty(0), np.empty((0, 2), np.intp)
    lost = (False, *nothing, Fault(np.inf, 1.5, 0.5))
    monkeypatch.setattr(axes, "medial_axis", lambda *_: lost)
    with pytest.raises(InvariantError, match="the medial axis was not found"):
        skeleton(box(0, 0, 3, 1))
