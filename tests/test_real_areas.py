"""Real layers: every valid area has its line, every other one a reason.

The layers are not part of the project; without the folder beside it these tests are skipped.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from shapely import LineString

from midrib import collapse, profile

geopandas = pytest.importorskip("geopandas")
pyogrio = pytest.importorskip("pyogrio")

FOLDER = Path(__file__).parents[2] / "shared" / "data"
MOST_VERTICES = 20_000  # of one area: coasts of whole islands take minutes to check

pytestmark = [
    pytest.mark.shared,
    pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent"),
]

LAYERS = [
    ("nl_bgt_gooi.gpkg", "vlak"),
    ("nl_bgt_gooi.gpkg", "talud"),
    ("osm_at_krems.gpkg", "areas"),
    ("osm_de_heidelberg.gpkg", "areas"),
    ("osm_fi_helsinki.gpkg", "areas"),
    ("pl_bdot500_opole_west.gpkg", "skarpa"),
    ("pl_bdot500_opole_west.gpkg", "BDZ_Jezdnia"),
    ("pl_bdot500_opole_west.gpkg", "BDZ_CiagRuchuPieszegoIRowerowego"),
    ("pl_bdot500_opole_west.gpkg", "BDZ_Plac"),
    ("pl_bdot500_opole_west.gpkg", "BDZ_Row"),
    ("pl_bdot500_opole_west.gpkg", "BDZ_InnaBudowla"),
    ("pl_bdot500_opole_west.gpkg", "BDZ_TerenLesnyZadrzewionyLubZakrzewiony"),
    ("pl_szkoleniowy_skarpa_kreski.gpkg", "skarpa"),
    ("us_river_louisiana.gpkg", "polygon"),
    ("geomaps_rivers_americas_poland.parquet", None),
    ("gshhg_rivers_lakes_americas.parquet", None),
    ("nl_plots.parquet", None),
    ("osm2streets_road_polygons.parquet", None),
]


def areas_of(file: str, layer: str | None) -> Any:
    """The polygons of a layer that are not too large to be checked here."""
    path = FOLDER / file
    frame = (
        geopandas.read_parquet(path) if layer is None else geopandas.read_file(path, layer=layer)
    )
    shapes = frame.geometry
    is_area = shapes.geom_type.isin(["Polygon", "MultiPolygon"])
    return shapes[is_area & (shapely.get_num_coordinates(shapes.to_numpy()) <= MOST_VERTICES)]


LEAST_ELONGATION = 3.0


def outside(lines: NDArray[np.object_], areas: NDArray[np.object_]) -> list[int]:
    """Positions of lines that their areas do not cover."""
    shapely.prepare(areas)
    return [int(i) for i in np.flatnonzero(~shapely.covers(areas, lines))]


@pytest.mark.parametrize(("file", "layer"), LAYERS)
def test_every_valid_area_has_a_line_inside_it(file: str, layer: str | None) -> None:
    areas = areas_of(file, layer)
    assert len(areas) > 0
    shapes, geographic = areas.to_numpy(), areas.crs.is_geographic
    found, problems = collapse(shapes, on_error="report", geographic=geographic)
    is_valid = shapely.is_valid(shapes)
    assert all(p.reason for p in problems)
    refused = [p for p in problems if p.status == "refused"]
    assert not [p for p in refused if is_valid[p.index]]
    assert (~shapely.is_missing(found) | ~is_valid).all()
    assert outside(found[is_valid], shapes[is_valid]) == []
    assert list(np.flatnonzero(~shapely.is_simple(found[is_valid]))) == []
    parts = shapely.get_num_geometries(found[is_valid])
    assert (parts == shapely.get_num_geometries(shapes[is_valid])).all()


@pytest.mark.parametrize(
    "options",
    [
        {"count": 50},
        {"skip": None, "end_clearance": None},
        {"ends": "main"},
        {"end_clearance": "station"},
    ],
)
def test_slopes_have_lines_by_every_rule(options: dict[str, Any]) -> None:
    areas = areas_of("pl_bdot500_opole_west.gpkg", "skarpa").to_numpy()
    areas = areas[shapely.is_valid(areas)]
    lines = collapse(areas, **options)
    assert outside(lines, areas) == []
    assert shapely.is_simple(lines).all()


def test_the_stress_set_ends_in_lines_or_reasons() -> None:
    areas = geopandas.read_parquet(FOLDER / "stress_invalid_polygons.parquet").geometry.to_numpy()
    lines, problems = collapse(areas, on_error="report")
    reasons = {p.index: p.reason for p in problems if p.status == "refused"}
    for i, (area, line) in enumerate(zip(areas, lines, strict=True)):
        assert (line is None) == (i in reasons or area is None), i
        if line is None or line.is_empty:
            continue
        assert line.is_simple, i
        if area.is_valid:
            assert area.covers(line), i
    assert not [i for i in reasons if areas[i].is_valid]


@pytest.mark.parametrize("feature", [1, 8])
def test_lines_of_courts_are_in_the_middle_of_their_channels(feature: int) -> None:
    """A building nearly fills the court; the lines ran along its wall for a fifth of their way."""
    frame = geopandas.read_file(FOLDER / "osm_fi_helsinki.gpkg", layer="areas")
    (area,) = frame.geometry.iloc[[feature]].to_crs(frame.estimate_utm_crs())
    (area,) = shapely.get_parts(area)
    rows = profile(collapse(area), area)
    away = np.minimum(rows.stations, rows.stations[-1] - rows.stations)
    building = shapely.get_interior_ring(area, 0)
    channel = shapely.distance(area.exterior, building)
    assert rows.width[away > channel].min() > 0.9 * channel
    assert (away > channel).sum() > 4


def test_a_ring_closed_by_a_touch_has_a_line_round_it() -> None:
    """A hole touches the shell in one vertex: there were 2.7 m of line where 20 m are possible."""
    frame = geopandas.read_file(FOLDER / "nl_bgt_gooi.gpkg", layer="vlak")
    (area,) = shapely.get_parts(frame.geometry.iloc[706])
    line = collapse(area)
    assert area.covers(line)
    assert line.length > 20.0
    ends = shapely.points(line.coords[:: len(line.coords) - 1])
    touch = area.exterior.intersection(area.interiors[1])
    assert shapely.distance(ends, touch).max() < 2.5  # half the mean width


def test_rivers_pass_islands_by_every_rule() -> None:
    areas = areas_of("geomaps_rivers_americas_poland.parquet", None).to_numpy()
    areas = areas[shapely.is_valid(areas)]
    areas = areas[shapely.get_num_interior_rings(areas) > 1][::4]
    assert len(areas) > 0
    ways: list[dict[str, Any]] = [
        {"holes": "auxiliary"},
        {"holes": "auxiliary", "centring": "none"},
        {"channel": "wider"},
    ]
    for options in ways:
        lines = collapse(areas, **options)
        assert outside(lines, areas) == []
        assert shapely.is_simple(lines).all()


def test_slopes_end_where_the_register_says() -> None:
    """Within a mean width (area over length) of the recorded ends of the top, nine times of ten."""
    frame = geopandas.read_file(FOLDER / "pl_bdot500_opole_west.gpkg", layer="skarpa")
    frame = frame[frame.is_valid & (elongation(frame.geometry.to_numpy()) >= LEAST_ELONGATION)]
    assert len(frame) >= 120
    areas = frame.geometry.to_numpy()
    lines = collapse(areas)
    recorded = [frame[[f"gora_{end}_x", f"gora_{end}_y"]] for end in ("start", "koniec")]
    tops = shapely.linestrings(np.stack(recorded, axis=1))
    off = np.stack(ends_apart(lines, tops))
    width = shapely.area(areas) / shapely.length(lines)
    assert np.mean(off <= width) >= 0.9


def test_a_river_ends_in_its_two_mouths() -> None:
    """Within a width of both ends of its banks, digitised one by one."""
    file = FOLDER / "us_river_louisiana.gpkg"
    (area,) = shapely.get_parts(geopandas.read_file(file, layer="polygon").geometry.to_numpy())
    left, right = geopandas.read_file(file, layer="banks").geometry
    mouths = LineString([np.mean([left.coords[i], right.coords[i]], axis=0) for i in (0, -1)])
    width = [math.dist(left.coords[i], right.coords[i]) for i in (0, -1)]
    assert (
        np.concatenate(ends_apart(np.array([collapse(area)]), np.array([mouths]))) <= width
    ).all()


def elongation(areas: NDArray[np.object_]) -> NDArray[np.float64]:
    """Length over width of the rectangles with the areas' perimeters and areas."""
    quarter = shapely.length(areas) / 4.0
    root = np.sqrt(np.maximum(quarter**2 - shapely.area(areas), 0.0))
    return np.asarray((quarter + root) / (quarter - root))


def ends_apart(
    lines: NDArray[np.object_], others: NDArray[np.object_]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """How far starts and stops of others are from ends of lines, turned around if nearer."""
    first, last = shapely.get_point(lines, 0), shapely.get_point(lines, -1)
    start, stop = shapely.get_point(others, 0), shapely.get_point(others, -1)
    along = shapely.distance(first, start), shapely.distance(last, stop)
    against = shapely.distance(last, start), shapely.distance(first, stop)
    is_along = sum(along) <= sum(against)
    return np.where(is_along, along[0], against[0]), np.where(is_along, along[1], against[1])
