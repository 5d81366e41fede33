"""Directional polylines: the line follows the side that is named."""

from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
import shapely
from shapely import LineString

from midrib.formats.guides import PlacedGuides, lines_of_text
from midrib.formats.reading import Batch
from midrib.formats.writing import Features, write_layer
from tests.cli.commands import Runner
from tests.formats.layers import RD_NEW, read_all

LOW, HIGH = shapely.box(0, 0, 90, 20), shapely.box(0, 20, 90, 40)
SHARED = LineString([(90, 20), (0, 20)])
BELOW = LineString([(0, 0), (90, 0)])


def write_areas(path: Path, main: list[str | None]) -> Path:
    """Two areas that touch, with a field for their directional polylines."""
    attributes = pa.table({"id": ["low", "high"], "main": pa.array(main, type=pa.string())})
    areas = np.array([LOW, HIGH], dtype=object)
    write_layer(path, Features("areas", attributes, areas, "geom", "Polygon", RD_NEW))
    return path


def write_lines(path: Path, lines: list[LineString], names: list[str]) -> None:
    """Directional polylines as a layer of their own."""
    geometries = np.array(lines, dtype=object)
    attributes = pa.table({"id": names})
    write_layer(path, Features("crest", attributes, geometries, "geom", "LineString", RD_NEW))


def directions(path: Path) -> list[bool]:
    """Whether each line runs towards larger x."""
    return [line.coords[-1][0] > line.coords[0][0] for line in read_all(path)[2]]


def test_a_line_between_two_areas_is_along_both() -> None:
    guides = PlacedGuides(np.array([LOW, HIGH, None], dtype=object), [SHARED])
    assert guides.lines == [[SHARED], [SHARED], []]


def test_a_line_beside_an_area_is_matched_to_the_nearest() -> None:
    beside = LineString([(0, -1), (90, -1)])
    guides = PlacedGuides(np.array([LOW, HIGH], dtype=object), [beside])
    assert guides.lines == [[beside], []]


def test_a_line_far_from_all_areas_is_left_out() -> None:
    far = LineString([(0, -500), (90, -500)])
    assert PlacedGuides(np.array([LOW, HIGH], dtype=object), [far]).lines == [[], []]
    assert PlacedGuides(np.array([None], dtype=object), [far]).lines == [[]]


def test_of_several_lines_the_longest_comes_first() -> None:
    short = LineString([(0, 0), (9, 0)])
    guides = PlacedGuides(np.array([LOW], dtype=object), [short, BELOW])
    assert guides.lines == [[BELOW, short]]
    batch = Batch(0, np.array([LOW], dtype=object), pa.table({"id": [1]}), {})
    assert guides.of(batch)[0].tolist() == [BELOW]


@pytest.mark.parametrize(
    "text", [SHARED.wkt, SHARED.wkb_hex, shapely.multilinestrings([SHARED]).wkt]
)
def test_wkt_and_wkb_are_read(text: str) -> None:
    assert lines_of_text(text) == [SHARED]


@pytest.mark.parametrize("text", ["", "abc", "0102", "POINT (1 1)", "LINESTRING EMPTY"])
def test_what_is_no_line_gives_none(text: str) -> None:
    assert lines_of_text(text) == []


def test_a_field_gives_the_direction(midrib: Runner, tmp_path: Path) -> None:
    source = write_areas(tmp_path / "in.gpkg", [SHARED.wkt, SHARED.reverse().wkb_hex])
    assert midrib("collapse", source, tmp_path / "out.gpkg", "--main", "main").code == 0
    assert directions(tmp_path / "out.gpkg") == [False, True]


def test_a_field_without_a_line_refuses_the_area(midrib: Runner, tmp_path: Path) -> None:
    source = write_areas(tmp_path / "in.gpkg", ["somewhere", None])
    assert midrib("collapse", source, tmp_path / "out.gpkg", "--main", "main").code == 1
    _, attributes, _ = read_all(tmp_path / "out.gpkg", "areas_refused")
    assert attributes["reason"].to_pylist() == [
        "the field 'main' is 'somewhere', expected a line in WKT"
    ]


def test_a_field_with_next_to_no_line_refuses_the_area(midrib: Runner, tmp_path: Path) -> None:
    source = write_areas(tmp_path / "in.gpkg", ["LINESTRING (0 0, 0 0.0001)", None])
    assert midrib("collapse", source, tmp_path / "out.gpkg", "--main", "main").code == 1
    (reason,) = read_all(tmp_path / "out.gpkg", "areas_refused")[1]["reason"].to_pylist()
    assert "along leads from (0, 0) to (0, " in reason


def test_a_layer_gives_the_direction_by_place(midrib: Runner, tmp_path: Path) -> None:
    source = write_areas(tmp_path / "in.gpkg", [None, None])
    write_lines(source, [SHARED], ["other"])
    assert midrib("collapse", source, tmp_path / "out.gpkg", "--main", "crest").code == 0
    assert directions(tmp_path / "out.gpkg") == [False, False]


def test_a_layer_gives_the_direction_by_a_common_field(midrib: Runner, tmp_path: Path) -> None:
    source = write_areas(tmp_path / "in.gpkg", [None, None])
    halves = [LineString([(90, 20), (40, 20)]), LineString([(40, 20), (0, 20)])]
    write_lines(source, [*halves, SHARED.reverse()], ["low", "low", "high"])
    assert midrib("collapse", source, tmp_path / "out.gpkg", "--main", "crest:id").code == 0
    assert directions(tmp_path / "out.gpkg") == [False, True]


@pytest.mark.shared
def test_crests_of_a_real_base_map(midrib: Runner, tmp_path: Path) -> None:
    data = Path(__file__).parents[2] / "../shared/data/nl_bgt_gooi.gpkg"
    if not data.exists():
        pytest.skip("the shared data are not there")
    out = tmp_path / "out.parquet"
    for main in ("kruinlijn", "kruinlijn:gml_id"):
        outcome = midrib("collapse", data, out, "--layer", "talud", "--main", main, "--overwrite")
        assert outcome.code == 0
        source, attributes, lines = read_all(out)
        assert len(lines) == 121
        assert (shapely.length(lines) > 0.0).all()
        assert source.kind == "LineString"
        assert "gml_id" in attributes.column_names
