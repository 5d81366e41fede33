"""The straight skeleton: closed forms, and relations that hold for every roof."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, MultiPoint, Point, Polygon, affinity, box

from midrib import collapse, skeleton
from midrib.curves.straight_skeleton import (
    StraightSkeleton,
    straight_skeleton_of,
    turned_roof,
    unit_mesh,
)
from midrib.errors import InvariantError
from midrib.kernels.roof import faces_of
from midrib.kernels.straight import straight_skeleton
from midrib.layout import boundary_of
from midrib.ragged import pack_areas, rings_of_area
from midrib.types import Floats
from tests.shapes import TOUCHING, VALID, rectangle, wedge
from tests.strategies import areas, polyominoes, with_holes
from tests.test_real_areas import FOLDER, LAYERS, areas_of

FAR = (5e5, 5.8e6)


def roof_of(area: Polygon) -> StraightSkeleton:
    """Find the straight skeleton of an area."""
    return straight_skeleton_of(*pack_areas(np.array([area], dtype=object)).rings(0))


def faces_in(found: StraightSkeleton) -> list[Polygon]:
    """The face of each edge."""
    return [Polygon(found.points[walk]) for walk in found.faces]


def lines_in(found: StraightSkeleton) -> Any:
    """Its ridges."""
    return shapely.unary_union(shapely.linestrings(found.points[found.ridges]))


def size_of(area: Polygon) -> float:
    """Larger extent."""
    west, south, east, north = area.bounds
    return float(max(east - west, north - south))


def offset_area(found: StraightSkeleton, time: float) -> float:
    """Area that the wavefront encloses: of every face what is higher."""
    total = 0.0
    for walk in found.faces:
        p, t = found.points[walk] - found.points[walk[0]], found.time[walk]
        higher = []
        for i in range(len(walk)):
            if (t[i - 1] > time) != (t[i] > time):
                share = (time - t[i - 1]) / (t[i] - t[i - 1])
                higher.append(p[i - 1] + share * (p[i] - p[i - 1]))
            if t[i] > time:
                higher.append(p[i])
        if higher:
            x, y = np.array(higher).T
            total += float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0
    return total


def nodes_of(found: StraightSkeleton) -> Floats:
    """Places and times of the nodes inside."""
    inner = np.unique(found.ridges[found.time[found.ridges] > 0.0])
    return np.column_stack([found.points[inner], found.time[inner]])


@pytest.mark.parametrize(("length", "width"), [(10, 2), (3, 3), (7, 1e-3)])
def test_rectangle_has_its_ridge(length: float, width: float) -> None:
    found = nodes_of(roof_of(rectangle(length, width)))
    half = width / 2
    expected = [(half, half, half), (length - half, half, half)]
    assert np.unique(found, axis=0) == pytest.approx(np.unique(expected, axis=0))


@pytest.mark.parametrize(
    "n", [3, 4, 5, 8, 17, 64, 360, 1000, 1150, 1175, 1200, 1500, 1900, 2048, 2500, 3000]
)
def test_regular_polygon_meets_in_its_centre(n: int) -> None:
    turn = 2.0 * np.pi * np.arange(n) / n + 0.3
    found = roof_of(Polygon(np.column_stack([np.cos(turn), np.sin(turn)])))
    assert nodes_of(found) == pytest.approx(np.array([[0.0, 0.0, np.cos(np.pi / n)]]), abs=1e-9)
    assert len(found.ridges) == n


@pytest.mark.parametrize("turn", [0.0, 33.7])
@pytest.mark.parametrize("origin", [(0.0, 0.0), FAR])
@pytest.mark.parametrize("segments", [16, 300, 401, 600])
@pytest.mark.parametrize(
    "middle",
    [LineString([(0, 0), (50, 0)]), box(0, 0, 60, 30), Polygon([(0, 0), (30, 0), (0, 40)])],
    ids=["capsule", "rounded_box", "rounded_triangle"],
)
def test_round_corners_meet_in_their_centres(
    middle: Any, segments: int, origin: tuple[float, float], turn: float
) -> None:
    """A quarter of a circle becomes one corner at one time; what is inside goes on from there."""
    moved = affinity.translate(affinity.rotate(middle, turn, origin=(0, 0)), *origin)
    found = roof_of(moved.buffer(10, quad_segs=segments))
    corners, slack = shapely.get_coordinates(moved), 10 * (np.pi / segments) ** 2 + 1e-6
    nodes = nodes_of(found)
    away = np.hypot(*(nodes[:, None, :2] - corners).T)
    assert away.min(axis=1).max() <= slack
    is_corner = away.min(axis=0) <= slack
    assert nodes[is_corner, 2] == pytest.approx(10, abs=slack)
    if middle.geom_type == "Polygon":
        inner = nodes_of(roof_of(moved))[:, 2].max()
        assert found.time.max() == pytest.approx(10 + inner, abs=slack)


def test_corner_of_two_arms_in_closed_form() -> None:
    found = nodes_of(roof_of(VALID["L"]))
    expected = [(1, 1, 1), (9, 1, 1), (1, 9, 1)]
    assert np.unique(found.round(9), axis=0).tolist() == sorted(map(list, expected))


def test_square_ring_meets_halfway() -> None:
    found = roof_of(box(0, 0, 10, 10).difference(box(2, 2, 8, 8)))
    ridge = lines_in(found)
    assert ridge.covers(box(1, 1, 9, 9).exterior)
    assert ridge.length == pytest.approx(32 + 8 * np.sqrt(2))


def streets(n: int, decimals: int, angle: float, origin: tuple[float, float]) -> Polygon:
    """Streets 12 wide round blocks, n each way every 50, turned and rounded as a file has them."""
    middles = 50.0 * np.arange(n)
    blocks = [box(x + 6, y + 6, x + 44, y + 44) for x in middles[:-1] for y in middles[:-1]]
    area = box(-6, -6, middles[-1] + 6, middles[-1] + 6).difference(shapely.union_all(blocks))
    turned = affinity.translate(affinity.rotate(area, angle, origin=(0, 0)), *origin)
    rounded: Polygon = shapely.transform(turned, lambda points: np.round(points, decimals))
    return rounded


@pytest.mark.parametrize("origin", [(0.0, 0.0), (650000.0, 480000.0), FAR])
@pytest.mark.parametrize(("n", "decimals"), [(3, 3), (4, 2), (4, 3), (6, 5), (6, 7)])
def test_streets_meet_in_their_middles(n: int, decimals: int, origin: tuple[float, float]) -> None:
    """Rounding turns edges that face each other by next to nothing, and no vertex shoots off."""
    corners = 4 + 4 * (n - 1) ** 2
    length = 2 * n * 50 * (n - 1) + corners * 6 * np.sqrt(2)
    slack = 10.0 * corners * 10.0**-decimals
    for angle in np.arange(2.37, 90.0, 3.0):
        found = roof_of(streets(n, decimals, angle, origin))
        ridges = shapely.linestrings(found.points[found.ridges])
        assert shapely.length(ridges).sum() == pytest.approx(length, abs=slack)
        assert found.time.max() == pytest.approx(6, abs=10.0**-decimals)


@pytest.mark.parametrize("angle", [1e-12, -1e-11, 1e-10, -1e-10, 4e-10, -4e-10])
def test_edges_that_face_each_other_may_meet_later_at_one_end(angle: float) -> None:
    corners = [(0, 0), (16, 0), (16, 2 - 8 * angle), (8, 2), (0, 2 + 8 * angle)]
    for area in (Polygon(corners[:3] + corners[4:]), Polygon(corners)):
        mesh, _, _ = unit_mesh(boundary_of(*rings_of_area(area)).mesh)
        found = faces_of(mesh, straight_skeleton(mesh))
        assert found.is_sound
        assert found.miss < 1e-14


@pytest.mark.parametrize("beta", [0.01, 0.5, 2.0, 3.1])
def test_wedge_meets_in_its_incentre(beta: float) -> None:
    area = wedge(beta, 5.0)
    (x, y, time), *others = nodes_of(roof_of(area))
    assert not others
    assert time == pytest.approx(2.0 * area.area / area.length)
    assert np.arctan2(y, x) == pytest.approx(beta / 2)


def test_collinear_vertices_change_nothing() -> None:
    few, many = (lines_in(roof_of(area)) for area in (VALID["L"], VALID["L"].segmentize(0.3)))
    assert many.hausdorff_distance(few) < 1e-9
    assert many.length == pytest.approx(few.length)


def check_roof(area: Polygon) -> StraightSkeleton:
    """Faces fill the area, each on its edge, and no node is anywhere but on its planes."""
    found = roof_of(area)
    size = size_of(area)
    faces = faces_in(found)
    assert sum(face.area for face in faces) == pytest.approx(area.area, abs=1e-9 * size**2)
    assert shapely.union_all(shapely.buffer(faces, 1e-9 * size)).area == pytest.approx(
        area.area, abs=1e-7 * size**2
    )
    for walk in found.faces:
        a, b = found.points[walk[-1]], found.points[walk[0]]
        (dx, dy), (x, y) = (b - a) / np.hypot(*(b - a)), (found.points[walk] - a).T
        assert np.abs(dx * y - dy * x - found.time[walk]).max() < 1e-9 * size
    return found


@pytest.mark.parametrize("name", sorted(VALID))
def test_every_named_area_has_a_roof(name: str) -> None:
    check_roof(VALID[name])


@pytest.mark.parametrize("name", sorted(TOUCHING))
def test_rings_that_touch_have_a_roof(name: str) -> None:
    check_roof(TOUCHING[name])


@settings(max_examples=60)
@given(area=st.one_of(areas, with_holes()))
def test_random_areas_have_a_roof(area: Polygon) -> None:
    check_roof(area)


@settings(max_examples=100)
@given(kept=st.lists(st.booleans(), min_size=50, max_size=50), angle=st.sampled_from([0.0, 30.0]))
def test_halves_of_squares_have_a_roof(kept: list[bool], angle: float) -> None:
    """On squared paper reflex vertices meet head-on, and several at a time."""
    halves = []
    for i, keep in enumerate(kept):
        x, y = divmod(i // 2, 5)
        corner = (x + 1, y) if i % 2 else (x, y + 1)
        if keep:
            halves.append(Polygon([(x, y), (x + 1, y + 1), corner]))
    for area in shapely.get_parts(shapely.union_all(halves)):
        check_roof(affinity.rotate(area, angle, origin=(0, 0)))


@settings(max_examples=60)
@given(area=polyominoes(), angle=st.sampled_from([0.0, 90.0, 30.0]))
def test_time_is_the_largest_coordinate_distance_among_right_angles(
    area: Polygon, angle: float
) -> None:
    """Between axis-parallel edges mitred offsets are erosions by squares."""
    found = roof_of(affinity.rotate(area, angle, origin=(0, 0)))
    back = MultiPoint(found.points)
    points = shapely.get_coordinates(affinity.rotate(back, -angle, origin=(0, 0)))
    ends = np.concatenate(
        [
            np.lib.stride_tricks.sliding_window_view(shapely.get_coordinates(ring), 2, axis=0)
            for ring in (area.exterior, *area.interiors)
        ]
    )
    low, high = ends.min(axis=2), ends.max(axis=2)
    away = np.maximum(np.maximum(low - points[:, None], points[:, None] - high), 0.0)
    assert away.max(axis=2).min(axis=1) == pytest.approx(found.time, abs=1e-9)


@settings(max_examples=25)
@given(area=st.one_of(areas, with_holes()), share=st.floats(0.1, 0.8))
def test_offsets_are_mitred_buffers_in_small_steps(area: Polygon, share: float) -> None:
    """Before anything happens one buffer is a step; after it, the limit of small steps is."""
    found = roof_of(area)
    time, steps = share * float(found.time.max()), 200
    rest: Any = area
    for _ in range(steps):
        rest = rest.buffer(-time / steps, join_style="mitre", mitre_limit=1e6)
    slack = area.length * time / steps / 4.0
    assert offset_area(found, time) == pytest.approx(rest.area, abs=slack)


@given(area=areas)
@settings(max_examples=25)
def test_first_offset_is_a_mitred_buffer(area: Polygon) -> None:
    found = roof_of(area)
    first = float(found.time[found.time > 0.0].min())
    for share in (0.3, 0.9):
        rest = area.buffer(-share * first, join_style="mitre", mitre_limit=1e6)
        expected = pytest.approx(rest.area, abs=1e-9 * size_of(area) ** 2)
        assert offset_area(found, share * first) == expected


@settings(max_examples=40)
@given(area=st.one_of(areas, with_holes()), turn=st.integers(0, 5), angle=st.floats(0.0, 360.0))
def test_rings_may_start_anywhere_and_areas_lie_anywhere(
    area: Polygon, turn: int, angle: float
) -> None:
    found = roof_of(area)
    ring = shapely.get_coordinates(area.exterior)[:-1]
    other = Polygon(np.roll(ring, turn, axis=0)[::-1], area.interiors)
    moved = affinity.translate(affinity.rotate(area, angle, origin=(0, 0)), *FAR)
    time = 0.4 * float(found.time.max())
    slack = size_of(area) * area.length
    assert offset_area(roof_of(other), time) == pytest.approx(
        offset_area(found, time), abs=1e-9 * slack
    )
    if moved.is_valid:
        assert offset_area(roof_of(moved), time) == pytest.approx(
            offset_area(found, time), abs=1e-6 * slack
        )


@pytest.mark.parametrize("power", [-150, 150])
def test_doubling_is_exact(power: int) -> None:
    area = VALID["comb"]
    found, larger = roof_of(area), roof_of(affinity.scale(area, *[2.0**power] * 2, origin=(0, 0)))
    assert (larger.points == found.points * 2.0**power).all()
    assert (larger.time == found.time * 2.0**power).all()


FALLS = {  # areas on squared paper, and by how many degrees they are turned
    "longest_spoke_first": (
        "POLYGON ((2 3, 2.5 3.5, 4.5 1.5, 2 1, 1.5 1.5, 1 1, 0 0, 0 3, 2 3),"
        " (0.5 2.5, 1 2, 1 3, 0.5 2.5), (2.5 2.5, 3 2, 3 3, 2.5 2.5))",
        (0, 90),
    ),
    "triangle_on_the_wrong_side": (
        "POLYGON ((4 5, 5 3, 5 0, 4 1, 4 0, 3 0, 3 1, 2 0, 4 5))",
        (30, 45, 30.000001, 77),
    ),
}
TANGLED = {  # in as many things at once as these rounding decides wrongly
    "court": (
        "POLYGON ((0 3, 0.5 3.5, 0 4, 6.5 6.5, 7 7, 6 7, 5 7, 5.5 7.5, 5 8, 6 8, 7 8, 8 8, 7.5 7.5,"
        " 8 7, 8 6, 8 5, 8 4, 7 4, 6 4, 5 4, 4.5 3.5, 5 3, 6 3, 6 2, 5.5 2.5, 5 2, 4.5 1.5, 5 1,"
        " 4 1, 3.5 1.5, 3 1, 3 0, 2 0, 1.5 0.5, 1 0, 0 0, 0 3), (3 3, 4 2, 4 3, 3 3),"
        " (2 2, 1.5 2.5, 1 2, 2 2))",
        0,
    ),
    "chain": (
        "POLYGON ((1 0, 0 0, 0 1, 1 2, 2 2, 2 3, 3 4, 4 4, 4 3, 3 3, 3 2, 4 2, 4 1, 3 1, 4 0, 3 0,"
        " 2 0, 1 0))",
        30,
    ),
}


BENT = {  # nearly straight walls that nearly face each other: fast vertices meet in no time
    "three_squares": (
        "POLYGON ((1 1, 1.0000000004435632 1.25, 1.000000006594116 1.5, 1.0000000006302534 "
        "1.75, 1 2, 2 2, 2 1, 2.301164307353219 1.0000000025444618, 2.414994633313437 "
        "0.9999999986115875, 2.886145079806367 1.0000000021469675, 3 1, 3.000000008175444 "
        "0.6666666666666667, 2.999999990286629 0.3333333333333334, 3 0, 2.6666666666666665 "
        "8.110491849821175e-9, 2.3333333333333335 3.4263966144242285e-9, 2 0, 1 0, "
        "0.7527941914010499 -1.5284175771379643e-8, 0.7034562717013213 1.2936589335911848e-9, "
        "0.4734176248666952 -2.2623151415077955e-9, 0 0, 0 1, 0.5 0.9999999847422721, 1 1))"
    ),
    "a_zigzag": (
        "POLYGON ((2.7388726618926116 5.787795482041265, 2.8157573637632174 5.463450212722629, "
        "2.892642070783528 5.139104944624707, 2.96952677454388 4.8147596757540265, "
        "1.9964909741931076 4.584105538059225, 1.0234551688187001 4.353451421557096, "
        "0.0504193560455378 4.1227973362673, -0.9226164506050732 3.892143225148953, 0 0, "
        "-0.9730358062872383 -0.2306541126512683, -1.8956522568923115 3.661489112497685, "
        "-2.4476205523276073 3.530647312167094, -2.470003072773108 3.5253416059234914, "
        "-2.8686880631795497 3.4308349998464167, -3.0993421758308184 4.403870806133655, "
        "-2.1263063695435798 4.634524918784924, -2.202549058377057 4.956161852895892, "
        "-2.3521211436180676 5.587145511316008, -2.818268707497385 7.553632337646638, "
        "-1.8452329012101465 7.784286450297906, -1.1532705632563416 4.865179031436192, "
        "-0.1802347572762116 5.0958331453830255, 0.7928010564775398 5.326487226536113, "
        "1.7658368558998276 5.557141368147814, 2.7388726618926116 5.787795482041265))"
    ),
}


@pytest.mark.parametrize("name", sorted(BENT))
def test_walls_bent_by_billionths_have_a_roof(name: str) -> None:
    check_roof(shapely.from_wkt(BENT[name]))


def is_sound(area: Polygon) -> bool:
    """Whether the skeleton that is found at the first attempt is."""
    mesh, _, _ = unit_mesh(boundary_of(*rings_of_area(area)).mesh)
    return bool(faces_of(mesh, straight_skeleton(mesh)).is_sound)


@pytest.mark.parametrize("name", sorted(FALLS))
def test_each_rule_of_swaps_is_needed(name: str) -> None:
    wkt, angles = FALLS[name]
    for angle in angles:
        assert is_sound(affinity.rotate(shapely.from_wkt(wkt), angle, origin=(0, 0)))


@pytest.mark.parametrize("name", sorted(TANGLED))
def test_what_rounding_decides_wrongly_is_found_of_the_turned_area(name: str) -> None:
    wkt, angle = TANGLED[name]
    area = affinity.rotate(shapely.from_wkt(wkt), angle, origin=(0, 0))
    found = check_roof(area)
    vertices = np.unique(shapely.get_coordinates(area), axis=0)
    there = np.unique(found.points[found.time == 0.0], axis=0)
    assert there == pytest.approx(vertices, abs=0.0 if angle == 0 else 1e-14)


@pytest.mark.parametrize("angle", [1.0, 5.0])
@pytest.mark.parametrize("name", ["comb", "L"])
def test_a_turned_area_has_the_same_roof(name: str, angle: float) -> None:
    mesh, _, _ = unit_mesh(boundary_of(*rings_of_area(VALID[name])).mesh)
    found, turned = turned_roof(mesh, 0.0), turned_roof(mesh, angle)
    assert faces_of(mesh, turned).is_sound
    at, other = (np.unique(roof.node.round(9) + 0.0, axis=0) for roof in (found, turned))
    assert other == pytest.approx(at, abs=1e-9)


@pytest.mark.parametrize("fault", ["node", "time", "arc", "lost", "crossed"])
def test_unsound_roofs_are_rejected(fault: str) -> None:
    mesh, _, _ = unit_mesh(boundary_of(*rings_of_area(VALID["comb"])).mesh)
    roof = straight_skeleton(mesh)
    assert faces_of(mesh, roof).is_sound
    n = np.count_nonzero(mesh.twin < 0)
    node, arc = roof.node.copy(), roof.arc.copy()
    if fault == "node":
        node[n, 0] += 1e-6
    elif fault == "time":
        node[n, 2] += 1e-6
    elif fault == "arc":
        arc[0, 1] = node.shape[0] - 1
    elif fault == "lost":
        arc = arc[:-1]
    else:
        arc[0, 2], arc[1, 2] = arc[1, 2], arc[0, 2]
    assert not faces_of(mesh, roof._replace(node=node, arc=arc)).is_sound


def test_folded_faces_are_rejected() -> None:
    """A node moved along a flat ridge past its neighbour is still on all of its planes."""
    area = Polygon([*((x, 0) for x in range(17)), (16, 2), (0, 2)])
    mesh, _, _ = unit_mesh(boundary_of(*rings_of_area(area)).mesh)
    roof = straight_skeleton(mesh)
    x, y = roof.node[:, 0] - mesh.x.min(), roof.node[:, 1] - mesh.y.min()
    folded = np.hypot(x - 8 / 16, y - 1 / 16) < 1e-9
    node = roof.node.copy()
    node[np.flatnonzero(folded)[0], 0] += 3.5 / 16
    found = faces_of(mesh, roof._replace(node=node))
    assert folded.any()
    assert found.miss < 1e-9
    assert not found.is_sound


def test_unsound_skeletons_raise(monkeypatch: pytest.MonkeyPatch) -> None:
    module = "midrib.curves.straight_skeleton"
    monkeypatch.setattr(
        f"{module}.faces_of", lambda mesh, roof: faces_of(mesh, roof)._replace(is_sound=False)
    )
    with pytest.raises(InvariantError, match="straight skeleton of 4 vertices"):
        roof_of(rectangle(3, 1))


def test_skeleton_and_trunk_come_from_it() -> None:
    area = rectangle(10, 2)
    found = skeleton(area, method="straight-skeleton")
    assert found.radius == pytest.approx(
        shapely.distance(shapely.points(found.points), area.boundary)
    )
    line = collapse(area, method="straight-skeleton")
    assert line.equals(found.trunk)
    assert [Point(p) for p in (line.coords[0], line.coords[-1])] == [Point(0, 1), Point(10, 1)]


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
@pytest.mark.parametrize(("file", "layer"), LAYERS)
def test_real_areas_have_a_roof(file: str, layer: str | None) -> None:
    """Those that are not sound raise."""
    parts = shapely.get_parts(areas_of(file, layer).to_numpy())
    for area in shapely.force_2d(parts[shapely.is_valid(parts)]):
        if shapely.get_num_coordinates(area) <= 5000:
            roof_of(area)
