"""``midrib check``: exit codes, a table for people, one for files, a picture."""

import json
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
import shapely
from pyarrow import csv
from shapely import LineString, Point

from midrib.formats.writing import Features, write_layer
from tests.cli.commands import Runner
from tests.formats.gml_files import BDOT_2015, ZONE_6, collection, earthwork, position, ring
from tests.formats.layers import RD_NEW, crs_name, projjson, read_all, write

E0, N0 = 6_481_000.0, 5_616_000.0
CORNERS = [(E0, N0), (E0 + 9, N0), (E0 + 10, N0 + 2), (E0, N0 + 2)]
GOOD = earthwork("good", ring(CORNERS), CORNERS[0], CORNERS[1])
TOPLESS = earthwork("topless", ring(CORNERS))
DOUBTFUL = earthwork("doubtful", ring(CORNERS), (E0 + 4, N0), CORNERS[2])


@pytest.fixture
def faulty(tmp_path: Path) -> Path:
    """A register with one good slope, a doubtful one and one that is none."""
    return collection(tmp_path / "in.gml", BDOT_2015, GOOD, TOPLESS, DOUBTFUL)


def test_nothing_found_is_code_0(midrib: Runner, tmp_path: Path) -> None:
    outcome = midrib("check", collection(tmp_path / "in.gml", BDOT_2015, GOOD))
    assert (outcome.code, outcome.out) == (0, "")
    assert "slopes: 1; findings: 0" in outcome.err


def test_findings_are_a_table_and_code_1(midrib: Runner, faulty: Path) -> None:
    outcome = midrib("check", faulty, "--quiet")
    assert (outcome.code, outcome.err) == (1, "")
    lines = [line.split() for line in outcome.out.splitlines() if line.strip()]
    assert lines[0] == ["slope", "check", "x", "y", "reason"]
    assert lines[2][:2] == ["topless", "refused"]
    assert lines[3][:4] == ["doubtful", "orientation", "6481004.000", "5616000.000"]
    assert "start is no vertex of the boundary" in outcome.out
    assert lines[4][:2] == ["doubtful", "unmatched"]  # as midrib hatch draws it
    assert lines[5][:2] == ["doubtful", "beyond"]
    counts = "findings: 4, 1 refused, 1 orientation, 1 unmatched, 1 beyond"
    assert counts in midrib("check", faulty).err


@pytest.mark.parametrize("ending", ["csv", "geojson", "gpkg", "parquet", "shp"])
def test_findings_go_to_a_file_with_their_places(
    ending: str, midrib: Runner, faulty: Path, tmp_path: Path
) -> None:
    out = tmp_path / f"out.{ending}"
    assert midrib("check", faulty, "-o", out).code == 1
    if ending == "csv":
        table = csv.read_csv(out)
    else:
        layer, table, places = read_all(out)
        assert ending == "geojson" or "CS2000/18" in str(crs_name(layer.crs))
        assert places[1] == Point(E0 + 4, N0)
    assert table.column_names == ["slope", "check", "x", "y", "reason"]
    assert table["slope"].to_pylist() == ["topless", *["doubtful"] * 3]
    assert table["x"].to_pylist()[1] == E0 + 4
    assert midrib("check", faulty, "-o", out).code == 2
    assert midrib("check", faulty, "-o", out, "--overwrite").code == 1


def test_geojson_is_json(midrib: Runner, faulty: Path, tmp_path: Path) -> None:
    midrib("check", faulty, "-o", tmp_path / "out.json")
    features = json.loads((tmp_path / "out.json").read_text())["features"]
    checks = [feature["properties"]["check"] for feature in features]
    assert checks == ["refused", "orientation", "unmatched", "beyond"]


def test_history_is_checked_when_asked_for(midrib: Runner, tmp_path: Path) -> None:
    ended = earthwork("old", ring(CORNERS), extra="<bdz:koniecObiekt>2022</bdz:koniecObiekt>")
    path = collection(tmp_path / "in.gml", BDOT_2015, ended)
    outcome = midrib("check", path)
    assert outcome.code == 0
    assert midrib("check", path, "--history").code == 1


def test_slopes_that_have_ended_are_told(midrib: Runner, tmp_path: Path) -> None:
    ended = GOOD.replace("</bdz:BDZ", "<bdz:koniecObiekt>2022</bdz:koniecObiekt></bdz:BDZ", 1)
    outcome = midrib("check", collection(tmp_path / "in.gml", BDOT_2015, ended))
    assert outcome.code == 0
    assert "note: slopes that have ended: 1; --history checks them" in outcome.err


@pytest.mark.parametrize("place", ["layer", "file", "layer of a file", "drawing"])
def test_what_is_wrong_with_strokes_is_found(place: str, midrib: Runner, tmp_path: Path) -> None:
    path = tmp_path / "in.gpkg"
    area, top = shapely.box(0, 0, 9, 2), LineString([(0, 2), (9, 2)])
    attributes = pa.table({"id": ["a"], "top": [top.wkt]})
    rows = np.array([area], dtype=object)
    write_layer(path, Features("slopes", attributes, rows, "geom", "Polygon", RD_NEW))
    lines: list[str | None] = ["LINESTRING (1 2, 3 0)", "LINESTRING (3 2, 1 0)"]
    lines += ["LINESTRING (8 2, 8 -2)"]
    name = "strokes.dxf" if place == "drawing" else "strokes.gpkg"
    told = path if place == "layer" else tmp_path / name
    write(told, lines, layer="strokes")
    if place == "layer of a file":
        write(told, lines, layer="others")
    written = {"layer": "strokes", "layer of a file": f"{told}:strokes", "drawing": f"{told}:*"}
    strokes = written.get(place, told)
    options = ["--layer", "slopes", "--top", "top"]
    assert midrib("check", path, *options).code == 0
    outcome = midrib("check", path, *options, "--strokes", strokes)
    assert outcome.code == 1
    assert "strokes 1 and 2 cross" in outcome.out
    assert "findings: 2, 1 crossing, 1 outside" in outcome.err
    row = next(line.split() for line in outcome.out.splitlines() if "outside" in line)
    assert row[:4] == ["a", "outside", "8.000", "-1.000"]
    assert "2 of stroke 3 is outside of the slope" in outcome.out
    wrong = midrib("check", path, *options, "--strokes", "nothing")
    assert wrong.code == 2
    assert "--strokes is 'nothing', expected a layer of '" in wrong.err


def test_of_a_layer_of_anything_the_lines_are_strokes(midrib: Runner, tmp_path: Path) -> None:
    path, told = tmp_path / "in.gpkg", tmp_path / "any.geojson"
    attributes = pa.table({"id": ["a"], "top": ["LINESTRING (0 2, 9 2)"]})
    rows = np.array([shapely.box(0, 0, 9, 2)], dtype=object)
    write_layer(path, Features("slopes", attributes, rows, "geom", "Polygon", None))
    things = [Point(50, 50), shapely.box(50, 0, 60, 9), LineString([(8, 2), (8, -2)])]
    features = [
        {"type": "Feature", "properties": {}, "geometry": shapely.geometry.mapping(thing)}
        for thing in [shapely.GeometryCollection(things), *things]
    ]
    told.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    outcome = midrib("check", path, "--top", "top", "--strokes", told)
    assert outcome.code == 1, outcome.err
    assert "findings: 3, 1 crossing, 2 outside" in outcome.err  # the line is there twice


def test_crossings_of_cartographic_objects_are_found(midrib: Runner, tmp_path: Path) -> None:
    ways = [[(E0 + 1, N0), (E0 + 3, N0 + 2)], [(E0 + 3, N0), (E0 + 1, N0 + 2)]]
    drawn = [
        f"<bt:KR_ObiektKarto><bt:kodKarto>BUBZ02</bt:kodKarto><bt:geometriaKarto><gml:LineString "
        f"{ZONE_6}><gml:posList>{' '.join(map(position, way))}</gml:posList></gml:LineString>"
        "</bt:geometriaKarto></bt:KR_ObiektKarto>"
        for way in ways
    ]
    path = collection(tmp_path / "in.gml", BDOT_2015, GOOD, *drawn)
    outcome = midrib("check", path, "--strokes", "BUBZ*")
    assert outcome.code == 1
    row = next(line.split() for line in outcome.out.splitlines() if "cross" in line)
    assert row[:4] == ["good", "crossing", "6481002.000", "5616001.000"]
    wrong = midrib("check", path, "--strokes", f"{path}:OB*")
    assert wrong.code == 2
    assert "has no cartographic object with lines and the code OB*" in wrong.err


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_slopes_and_findings_are_drawn(
    ending: str, midrib: Runner, faulty: Path, tmp_path: Path
) -> None:
    figure = tmp_path / f"out.{ending}"
    assert midrib("check", faulty, "--figure", figure).code == 1
    assert figure.stat().st_size > 1000
    if ending == "svg":
        text = figure.read_text()
        for word in ("slope", "toe", "top", "refused", "orientation"):
            assert f"<!-- {word} -->" in text
        assert "<!-- swapped -->" not in text
    assert midrib("check", faulty, "--figure", figure).code == 2


def test_of_a_register_without_slopes_there_is_a_table_and_no_figure(
    midrib: Runner, tmp_path: Path
) -> None:
    path, figure = collection(tmp_path / "in.gml", BDOT_2015), tmp_path / "out.svg"
    figure.write_text("old")
    outcome = midrib("check", path, "--figure", figure, "-o", tmp_path / "out.gpkg", "--overwrite")
    assert outcome.code == 0, outcome.err
    assert "note: there is nothing to draw, no figure is written\n" in outcome.err
    assert not figure.exists()
    assert "out.svg" not in outcome.err
    assert len(read_all(tmp_path / "out.gpkg")[2]) == 0


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (["-o", "out.dxf"], "which holds no table"),
        (["-o", "out.xyz"], "expected one of"),
        (["--figure", "out.gif"], "expected .svg, .png, .pdf"),
        (["--top", "nothing"], "top is 'nothing', expected a layer of IN"),
    ],
)
def test_wrong_usage_is_code_2(
    options: list[str], reason: str, midrib: Runner, faulty: Path
) -> None:
    outcome = midrib("check", faulty, *options)
    assert outcome.code == 2
    assert reason in outcome.err


def test_degrees_are_refused(midrib: Runner, tmp_path: Path) -> None:
    attributes = pa.table({"top": ["LINESTRING (0 2, 9 2)"]})
    rows = np.array([shapely.box(0, 0, 9, 2)], dtype=object)
    wgs84 = projjson("EPSG:4326")
    write_layer(
        tmp_path / "in.gpkg", Features("slopes", attributes, rows, "geom", "Polygon", wgs84)
    )
    outcome = midrib("check", tmp_path / "in.gpkg", "--top", "top")
    assert outcome.code == 2
    assert "IN is in degrees, expected a projected CRS" in outcome.err
