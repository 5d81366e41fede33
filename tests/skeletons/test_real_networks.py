"""Networks of real roads, rivers and lakes."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from midrib import collapse, network, partial_collapse, skeleton
from midrib.measures import mean_width
from tests.skeletons.test_networks import cycles, meets_at_nodes_only, nodes_of
from tests.skeletons.test_partial import check as check_partial

geopandas = pytest.importorskip("geopandas")

FOLDER = Path(__file__).parents[3] / "shared" / "data"
ROADS = "rijbaan|fietspad|inrit"
MOST_VERTICES = 3_000  # of one river or lake

pytestmark = [
    pytest.mark.shared,
    pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent"),
]


def joined(shapes: Any, gap: float) -> Any:
    """Pieces that areas cover together, where gaps as narrow as that are closed."""
    grown = shapely.buffer(shapes[shapely.is_valid(shapes)], gap, join_style="mitre")
    return shapely.get_parts(shapely.buffer(shapely.union_all(grown), -gap, join_style="mitre"))


def roads(place: str) -> Any:
    """Areas of roads in metres, as they touch."""
    if place == "gooi":
        frame = geopandas.read_file(FOLDER / "nl_bgt_gooi.gpkg", layer="vlak")
        return joined(frame[frame.function.str.match(ROADS, na=False)].geometry.to_numpy(), 0.02)
    frame = geopandas.read_parquet(FOLDER / "osm2streets_road_polygons.parquet")
    frame = frame[frame.place == place]
    return joined(frame.to_crs(frame.estimate_utm_crs()).geometry.to_numpy(), 0.1)


def check(areas: Any, *, geographic: bool = False) -> tuple[int, int, int]:
    """Hold networks against their areas; count crossings, those of skeletons, dead ends inside."""
    crossings, junctions, inside = 0, 0, 0
    for area in areas:
        found = network(area, geographic=geographic)
        whole = skeleton(area, min_significance=3.0, geographic=geographic)
        assert area.covers(found)
        assert meets_at_nodes_only(found)
        if area.boundary.is_simple:
            assert cycles(list(found.geoms)) == len(whole.edges) - len(whole.points) + 1
        ways = nodes_of(found)
        crossings += sum(count > 2 for count in ways.values())
        junctions += int((np.bincount(whole.edges.ravel()) > 2).sum())
        tips = shapely.points(np.array([p for p, n in ways.items() if n == 1]).reshape(-1, 2))
        inside += int((shapely.distance(tips, area.boundary) > 1e-6).sum())
    return crossings, junctions, inside


@pytest.mark.parametrize(
    "place",
    ["gooi", "montlake_roundabout", "tempe_split", "quad_intersection", "seattle_slip_lane"],
)
def test_roads_have_fewer_crossings_than_their_skeletons(place: str) -> None:
    areas = roads(place)
    crossings, junctions, inside = check(areas)
    assert crossings <= 0.85 * junctions
    assert inside <= (0 if place == "gooi" else 0.02 * crossings + 1)  # dead ends reach the edge


def small_areas(name: str, layer: str | None = None) -> Any:
    """Valid areas of a layer of at most 800 vertices, part by part."""
    read = geopandas.read_parquet if name.endswith("parquet") else geopandas.read_file
    shapes = shapely.get_parts(
        read(FOLDER / name, **({"layer": layer} if layer else {})).geometry.dropna().to_numpy()
    )
    few = shapely.get_num_coordinates(shapes) <= 800
    return shapes[(shapely.get_type_id(shapes) == 3) & shapely.is_valid(shapes) & few]


@pytest.mark.parametrize("merge", [0.0, 1.0])
@pytest.mark.parametrize(
    ("name", "layer", "row"),
    [
        ("nl_bgt_gooi.gpkg", "vlak", 1516),
        ("nl_plots.parquet", None, 161),
        ("osm_fi_helsinki.gpkg", "areas", 3),
    ],
)
def test_a_way_back_to_its_crossing_stays(
    name: str, layer: str | None, row: int, merge: float
) -> None:
    """Cut from both ends nothing was left of it but a line without length."""
    geographic = name.startswith("osm")
    if layer == "vlak":
        area = geopandas.read_file(FOLDER / name, layer=layer).geometry[row]
    else:
        area = small_areas(name, layer)[row]
    found = network(area, merge=merge, geographic=geographic)
    assert len(area.interiors) == cycles(list(found.geoms)) == 2
    assert shapely.polygonize(list(found.geoms)).geoms[1:]
    assert found.is_valid
    assert shapely.length(list(found.geoms)).min() > 0.0
    check([area], geographic=geographic)


@pytest.mark.parametrize("name", ["gshhg_rivers_lakes_americas", "geomaps_rivers_americas_poland"])
def test_rivers_and_lakes_have_networks(name: str) -> None:
    shapes = geopandas.read_parquet(FOLDER / f"{name}.parquet").geometry.to_numpy()
    few = shapely.get_num_coordinates(shapes) <= MOST_VERTICES
    check(shapes[shapely.is_valid(shapes) & few][::6], geographic=True)


@pytest.mark.parametrize("name", ["gshhg_rivers_lakes_americas", "geomaps_rivers_americas_poland"])
@pytest.mark.parametrize("share", [0.5, 1.0, 2.0])
def test_rivers_and_lakes_are_divided_at_any_width(name: str, share: float) -> None:
    shapes = geopandas.read_parquet(FOLDER / f"{name}.parquet").geometry.to_numpy()
    few = shapely.get_num_coordinates(shapes) <= MOST_VERTICES
    both = 0
    for area in shapes[shapely.is_valid(shapes) & few][::12]:
        width = share * mean_width(collapse(area, geographic=True), area, geographic=True)
        found = check_partial(area, width, geographic=True)
        both += not (found.areas.is_empty or found.lines.is_empty)
        if share < 2.0:  # parts that are long enough at both widths
            less = partial_collapse(
                area, 1.3 * width, min_length=width, tolerance=width / 1e3, geographic=True
            )
            assert less.areas.difference(found.areas).area <= 1e-6 * area.area
    assert both >= (3 if share == 2.0 else 20)


@pytest.mark.parametrize("row", [203, 294, 392, 567, 672, 721, 728, 735])
def test_what_is_collapsed_at_a_width_stays_so_at_larger_ones(row: int) -> None:
    """A junction before the cut: there was a dent to the middle of the disc, another at each."""
    shapes = geopandas.read_parquet(FOLDER / "geomaps_rivers_americas_poland.parquet").geometry
    shapes = shapes[shapes.is_valid & (shapely.get_num_coordinates(shapes) <= 1_000)]
    area = shapes.iloc[row]
    mean = mean_width(collapse(area, geographic=True), area, geographic=True)
    last = area
    for share in (0.5, 0.65, 0.8, 1.0, 1.2, 1.3, 1.6, 1.9):
        kept = partial_collapse(
            area, share * mean, min_length=mean / 2.0, tolerance=mean / 1e3, geographic=True
        ).areas
        assert kept.difference(last).area <= 1e-6 * area.area
        last = kept


@pytest.mark.parametrize("width", [1_720.0, 2_000.0, 2_255.0])
def test_a_cut_through_a_vertex_of_the_skeleton_leaves_a_line(width: float) -> None:
    """The vertex was beyond the cut by the last place of its degrees: a way without length."""
    frame = geopandas.read_parquet(FOLDER / "geomaps_rivers_americas_poland.parquet")
    area = frame.geometry[796]
    parts, problems = partial_collapse(area, width, geographic=True, on_error="report")
    assert [problem.status for problem in problems] == ["repaired"]
    assert shapely.area(parts.areas) < area.area


def test_a_width_that_a_point_of_the_skeleton_has_is_as_good_as_any() -> None:
    """A change right beside the point, at its own place, had no way to cut across."""
    slopes = geopandas.read_file(FOLDER / "nl_bgt_gooi.gpkg", layer="talud").geometry
    both = 0
    for area in slopes[:25]:
        radius = np.sort(skeleton(area).radius)
        width = 2.0 * float(radius[radius.size * 6 // 10])
        found, problems = partial_collapse(area, width, on_error="report")
        assert not any(problem.status == "uncut" for problem in problems)
        assert found.areas.is_valid
        both += not (found.areas.is_empty or found.lines.is_empty)
        less, more = (
            partial_collapse(area, factor * width, min_length=width, tolerance=width / 1e3).areas
            for factor in (1.001, 0.999)
        )
        assert less.difference(found.areas).area <= 1e-3 * area.area
        assert found.areas.difference(more).area <= 1e-3 * area.area
    assert both >= 3
