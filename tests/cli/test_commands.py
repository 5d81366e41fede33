"""Every command on every kind of input: exit codes, and files that are whole or not there."""

from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.compute
import pytest
import shapely
from pyarrow import csv

from midrib import measures
from midrib.cli.app import app
from midrib.cli.job import with_columns
from midrib.formats.contents import layer_names
from midrib.formats.writing import Features, write_layer
from tests.cli.commands import Runner
from tests.formats.layers import RD_NEW, crs_name, read_all, write

STRIP = "POLYGON ((0 0, 90 0, 90 20, 0 20, 0 0))"
BENT = "POLYGON ((0 0, 90 0, 90 90, 80 90, 80 10, 0 10, 0 0))"
BOW_TIE = "POLYGON ((0 0, 8 8, 8 0, 0 8, 0 0))"  # two readings: refused
NOTHING = "POLYGON ((0 0, 5 5, 9 9, 0 0))"
TWO = "MULTIPOLYGON (((0 0, 90 0, 90 20, 0 20, 0 0)), ((0 50, 90 50, 90 60, 0 60, 0 50)))"


def random_areas() -> list[str | None]:
    """Ribbons along random walks, some of which cross themselves."""
    random = np.random.default_rng(7)
    walks = [np.cumsum(random.normal(size=(12, 2)), axis=0) * 30.0 for _ in range(40)]
    return [shapely.LineString(walk).buffer(2.0).wkt for walk in walks]


# Input: areas, how many of them have a line, how many are refused.
INPUTS: dict[str, tuple[list[str | None], int, int]] = {
    "empty": ([], 0, 0),
    "single": ([STRIP], 1, 0),
    "several": ([STRIP, BENT, TWO], 3, 0),
    "missing": ([None, STRIP, "POLYGON EMPTY"], 1, 0),
    "degenerate": ([STRIP, NOTHING, BOW_TIE, BENT], 2, 2),
    "mixed": ([STRIP, "POINT (1 1)", "LINESTRING (0 0, 1 1)"], 1, 2),
    "random": (random_areas(), 40, 0),
}
TWICE: list[list[str | None]] = [[BOW_TIE], []]  # a run that refuses one, and one that does not
COMMANDS = {
    "check": ["check", "IN", "-o", "OUT", "--top", "name", "--quiet"],
    "collapse": ["collapse", "IN", "OUT", "--quiet"],
    "methods": ["methods"],
    "profile": ["profile", "IN", "OUT", "--quiet"],
    "standards": ["standards"],
}
OTHERS = {"compare", "label", "network", "partial", "points", "skeleton"}  # have tests of their own
OF_SLOPES = {"hatch"}  # commands that take slopes: see test_hatch.py
OF_POINTS = {"tower"}  # commands that take clouds: see test_tower.py


def test_the_table_has_every_command() -> None:
    names = {command.name or command.callback.__name__ for command in app.registered_commands}  # type: ignore[union-attr]
    assert names == set(COMMANDS) | OF_SLOPES | OF_POINTS | OTHERS


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "geojson"])
@pytest.mark.parametrize("case", INPUTS)
@pytest.mark.parametrize("command", COMMANDS)
def test_commands_write_whole_files(
    command: str, case: str, ending: str, midrib: Runner, tmp_path: Path
) -> None:
    areas, n_lines, n_refused = INPUTS[case]
    source = write(tmp_path / f"in.{ending}", areas, kind="Polygon")
    out = tmp_path / f"out.{ending}"
    places = {"IN": source, "OUT": out}
    outcome = midrib(*(places.get(word, word) for word in COMMANDS[command]))
    if "OUT" not in COMMANDS[command]:
        assert outcome.code == 0
        return
    if case == "empty" and ending == "geojson":
        assert outcome.code in {0, 2}  # a GeoJSON file of nothing does not say what it is of
        return
    if command == "check":  # a field that has no tops in it
        assert outcome.code == (1 if areas else 0), outcome.err
        assert read_all(out)[1]["check"].to_pylist() == ["refused"] * len(areas)
        return
    assert outcome.code == (1 if n_refused else 0), outcome.err
    assert (outcome.out, outcome.err) == ("", "")
    if command == "profile":
        check_table(out, n_lines)
        return
    layer, attributes, lines = read_all(out)
    assert np.count_nonzero(~shapely.is_missing(lines)) == n_lines
    assert len(lines) == len(areas) - n_refused
    assert crs_name(layer.crs) == "Amersfoort / RD New"
    assert attributes.column_names[-4:] == ["length", "width_mean", "width_max", "status"]
    assert attributes["number"].to_pylist() == sorted(attributes["number"].to_pylist())
    for area, line in zip(areas, lines, strict=False):
        if n_refused == 0 and line is not None:
            assert shapely.from_wkt(area).buffer(1e-6).covers(line)


def check_table(path: Path, n_features: int) -> None:
    """A table of stations in order, of so many features, with the stations as points."""
    layer, rows, points = read_all(path)
    assert crs_name(layer.crs) == "Amersfoort / RD New"
    assert rows.column_names == [
        *("feature", "part", "station", "x", "y", "width", "to_left", "to_right")
    ]
    assert len(np.unique(rows["feature"].to_numpy())) == n_features
    assert shapely.get_coordinates(points)[:, 0] == pytest.approx(rows["x"].to_numpy(), abs=1e-6)
    feature, part, station = (rows[name].to_numpy() for name in ("feature", "part", "station"))
    goes_on = (np.diff(feature) == 0) & (np.diff(part) == 0)
    assert (np.diff(station)[goes_on] > 0.0).all()
    assert (station[1:][~goes_on] == 0.0).all()


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "fgb", "shp"])
def test_refused_areas_are_written_as_they_were(
    ending: str, midrib: Runner, tmp_path: Path
) -> None:
    source, out = write(tmp_path / "in.gpkg", INPUTS["degenerate"][0]), tmp_path / f"out.{ending}"
    outcome = midrib("collapse", source, out, "--out-layer", "lines")
    assert outcome.code == 1
    assert "2 lines of 4 features, 2 refused" in outcome.err
    place = out if ending == "gpkg" else tmp_path / f"out_refused.{ending}"
    layer = "lines_refused" if ending in {"gpkg", "fgb"} else "out_refused"
    _, attributes, areas = read_all(place, layer)
    assert attributes["number"].to_pylist() == [1, 2]
    assert all(attributes["reason"].to_pylist())
    assert shapely.equals(areas[1], shapely.from_wkt(BOW_TIE)) or ending == "shp"


@pytest.mark.parametrize("ending", ["shp", "gdb"])
def test_refused_features_of_several_kinds_leave_the_lines(
    ending: str, midrib: Runner, tmp_path: Path
) -> None:
    wkts: list[str | None] = [STRIP, "POINT (1 1)", BOW_TIE, "LINESTRING (0 0, 1 1)"]
    wkts += ["MULTIPOINT ((1 1), (2 2))", "GEOMETRYCOLLECTION (POINT (1 1))"]
    source, out = write(tmp_path / "in.geojson", wkts), tmp_path / f"out.{ending}"
    outcome = midrib("collapse", source, out)
    assert outcome.code == 1, outcome.err
    assert "has no place for a GeometryCollection" in outcome.err
    assert len(read_all(out, "some" if ending == "gdb" else None)[2]) == 1
    for kind, numbers in {"": [2, 5], "_lines": [3], "_points": [1, 4]}.items():
        layer = f"some_refused{kind}" if ending == "gdb" else f"out_refused{kind}"
        place = out if ending == "gdb" else tmp_path / f"{layer}.shp"
        assert f"{layer}" in outcome.err
        _, attributes, geometries = read_all(place, layer)
        assert attributes["number"].to_pylist() == numbers
        assert all(attributes["reason"].to_pylist())
        assert shapely.is_missing(geometries).sum() == (1 if kind == "" else 0)


def test_nothing_refused_leaves_no_file_of_refusals(midrib: Runner, tmp_path: Path) -> None:
    bad, good = (write(tmp_path / f"{i}.gpkg", [STRIP, *wkts]) for i, wkts in enumerate(TWICE))
    out, stale = tmp_path / "out.parquet", tmp_path / "out_refused.parquet"
    assert midrib("collapse", bad, out).code == 1
    assert stale.exists()
    assert midrib("collapse", good, out).code == 2
    assert midrib("collapse", good, out, "--overwrite").code == 0
    assert out.exists()
    assert not stale.exists()


@pytest.mark.parametrize("command", ["collapse", "profile"])
def test_a_file_of_others_in_the_place_for_refusals_is_kept(
    command: str, midrib: Runner, tmp_path: Path
) -> None:
    source = write(tmp_path / "in.gpkg", [STRIP])
    other = write(tmp_path / "out_refused.parquet", [STRIP])
    before = other.read_bytes()
    outcome = midrib(command, source, tmp_path / "out.parquet", "--overwrite")
    assert outcome.code == 2
    assert "has no column 'reason' and so is no output of an earlier run" in outcome.err
    assert other.read_bytes() == before


def test_a_drawing_in_the_place_for_refusals_is_kept(midrib: Runner, tmp_path: Path) -> None:
    bad, good = (write(tmp_path / f"{i}.gpkg", [STRIP, *wkts]) for i, wkts in enumerate(TWICE))
    out = tmp_path / "out.dxf"
    assert midrib("collapse", bad, out).code == 1
    outcome = midrib("collapse", good, out, "--overwrite")
    assert outcome.code == 0
    assert "out_refused.dxf was there before, it is left as it was" in outcome.err
    assert (tmp_path / "out_refused.dxf").exists()


def test_columns_measure_the_line(midrib: Runner, tmp_path: Path) -> None:
    out = tmp_path / "out.gpkg"
    assert midrib("collapse", write(tmp_path / "in.gpkg", [STRIP, None]), out).code == 0
    row, missing = read_all(out)[1].to_pylist()
    assert row["length"] == 90.0
    assert row["width_max"] == 20.0
    assert 10.0 < row["width_mean"] < 20.0
    assert row["status"] == "ok"
    assert missing["status"] == "no geometry"
    assert missing["length"] is None


@pytest.mark.parametrize("options", [[], ["--connect"]])
def test_columns_of_simplified_lines_are_those_of_full_ones(
    options: list[str], midrib: Runner, tmp_path: Path
) -> None:
    onwards = "POLYGON ((90 0, 150 0, 150 20, 90 20, 90 0))"
    source, rows = write(tmp_path / "in.gpkg", [STRIP, onwards]), []
    for name, given in {"full": [], "simple": ["--simplify", "5%"]}.items():
        out = tmp_path / f"{name}.gpkg"
        assert midrib("collapse", source, out, "--quiet", *options, *given).code == 0
        _, attributes, lines = read_all(out)
        rows.append(attributes.to_pylist())
    assert shapely.get_num_coordinates(lines[0]) == 2
    for full, simple in zip(*rows, strict=True):
        for column in ("width_mean", "width_max"):
            assert simple[column] == pytest.approx(full[column], rel=0.03)
        assert simple["width_max"] == pytest.approx(20.0)


def test_columns_that_are_taken_are_numbered_on() -> None:
    taken = pa.table({"length": [1], "Length_2": [2]})
    table = with_columns(taken, {"length": pa.array([3]), "status": pa.array(["ok"])})
    assert table.column_names == ["length", "Length_2", "length_3", "status"]


@pytest.mark.parametrize("ending", ["gpkg", "csv", "parquet"])
def test_fields_that_differ_by_case_are_kept(ending: str, midrib: Runner, tmp_path: Path) -> None:
    areas = shapely.from_wkt([STRIP, BOW_TIE])
    both = pa.table({"status": ["a", "b"], "Status": ["c", "d"]})
    source, out = tmp_path / "in.parquet", tmp_path / f"out.{ending}"
    write_layer(source, Features("both", both, areas, "geom", "Polygon", RD_NEW))
    outcome = midrib("collapse", source, out)
    assert outcome.code == 1
    (row,) = read_all(out)[1].to_pylist()
    new = "Status" if ending == "parquet" else "Status_3"
    assert (new == "Status") == ("is written as" not in outcome.err)
    assert (row["status"], row[new]) == ("a", "c")
    assert row["status_2"] == "ok"


@pytest.mark.parametrize("command", ["collapse", "profile"])
@pytest.mark.parametrize("ending", ["gpkg", "fgb", "geojson", "parquet"])
def test_layers_without_attributes_are_layers_too(
    ending: str, command: str, midrib: Runner, tmp_path: Path
) -> None:
    areas = shapely.from_wkt([STRIP, BOW_TIE, BENT])
    bare = Features("bare", pa.table({}), areas, "geom", "Polygon", RD_NEW)
    source, out = tmp_path / f"in.{ending}", tmp_path / f"out.{ending}"
    write_layer(source, bare)
    assert midrib(command, source, out, "--quiet") == (1, "", "")
    _, attributes, geometries = read_all(out)
    if command == "collapse":
        assert len(geometries) == 2
        assert attributes.column_names == ["length", "width_mean", "width_max", "status"]


def test_spacing_is_the_same_length_in_any_unit(midrib: Runner, tmp_path: Path) -> None:
    source = write(tmp_path / "in.gpkg", [BENT])
    lines = []
    for i, spacing in enumerate(["3", "3m", "300cm", "0.003 km"]):
        assert midrib("collapse", source, tmp_path / f"{i}.fgb", "--spacing", spacing).code == 0
        lines.append(read_all(tmp_path / f"{i}.fgb")[2][0])
    assert all(line.equals_exact(lines[0], 1e-9) for line in lines)


def test_geographic_lengths_are_metres(midrib: Runner, tmp_path: Path) -> None:
    area = shapely.box(5.0, 52.0, 5.01, 52.0005).wkt
    source = write(tmp_path / "in.gpkg", [area], crs="EPSG:4326")
    assert midrib("collapse", source, tmp_path / "out.gpkg", "--spacing", "10m").code == 0
    row = read_all(tmp_path / "out.gpkg")[1].to_pylist()[0]
    assert row["length"] == pytest.approx(686.8, abs=1.0)
    assert row["width_max"] == pytest.approx(55.6, abs=0.1)


@pytest.mark.parametrize("ends", ["main", "caps", "radii", "none"])
@pytest.mark.parametrize("clearance", ["station", "proportional", "none", "5m"])
def test_every_rule_for_ends_runs(
    ends: str, clearance: str, midrib: Runner, tmp_path: Path
) -> None:
    source, out = write(tmp_path / "in.gpkg", [STRIP, BENT]), tmp_path / "out.fgb"
    outcome = midrib(
        "collapse", source, out, "--ends", ends, "--end-clearance", clearance, "--no-vertices"
    )
    assert outcome.code == 0


def test_methods_are_listed(midrib: Runner) -> None:
    outcome = midrib("methods")
    assert outcome.code == 0
    assert outcome.out.splitlines()[0].split() == [
        "name",
        "source",
        "branches",
        "holes",
        "exact",
        "cost",
    ]
    assert ["minimal-radii", "Buczek", "2017"] in [
        line.split()[:3] for line in outcome.out.splitlines()
    ]


@pytest.mark.parametrize("options", [[], ["--connect"]])
@pytest.mark.parametrize("case", ["degenerate", "mixed"])
def test_figures_are_drawn(case: str, options: list[str], midrib: Runner, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    source = write(tmp_path / "in.gpkg", INPUTS[case][0])
    figure = tmp_path / "picture.svg"
    told = ["--figure", figure, *options]
    assert midrib("collapse", source, tmp_path / "out.gpkg", *told).code == 1
    assert "<svg" in figure.read_text()


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "shp"])
def test_joints_are_written_beside_the_lines(ending: str, midrib: Runner, tmp_path: Path) -> None:
    onwards = "POLYGON ((90 0, 150 0, 150 20, 90 20, 90 0))"
    aside = "POLYGON ((40 0, 50 0, 50 -70, 40 -70, 40 0))"
    source = write(tmp_path / "in.gpkg", [STRIP, None, onwards, aside])
    out = tmp_path / f"out.{ending}"
    outcome = midrib("collapse", source, out, "--connect", "--out-layer", "lines")
    assert outcome.code == 0, outcome.err
    assert "1 joints end to end, 1 on the side, 0 shared edges without" in outcome.err
    place, layer = (
        (out, "lines_joints")
        if ending == "gpkg"
        else (tmp_path / f"out_joints.{ending}", "out_joints")
    )
    _, rows, points = read_all(place, layer)
    assert rows["area"].to_pylist() == [0, 3]
    assert rows["other"].to_pylist() == [2, 0]
    assert rows["kind"].to_pylist() == ["end to end", "side"]
    assert [(p.x, p.y) for p in points] == [(90.0, 10.0), (45.0, 10.0)]
    _, attributes, lines = read_all(out, "lines" if ending == "gpkg" else "out")
    assert attributes["status"].to_pylist() == ["ok", "no geometry", "ok", "ok"]
    assert lines[0].coords[-1] in {lines[2].coords[0], lines[2].coords[-1]}


def test_joined_lines_are_tended_and_measured_in_their_own_areas(
    midrib: Runner, tmp_path: Path
) -> None:
    aside = "POLYGON ((40 0, 50 0, 50 -70, 40 -70, 40 0))"
    source, out = write(tmp_path / "in.gpkg", [STRIP, aside]), tmp_path / "out.gpkg"
    options = ["--connect", "--smooth", "--width", "m"]
    assert midrib("collapse", source, out, *options).code == 0
    _, attributes, lines = read_all(out)
    assert (45.0, 10.0) in {place[:2] for place in lines[0].coords}
    assert (45.0, 10.0) in {lines[1].coords[k][:2] for k in (0, -1)}
    assert attributes["length"].to_pylist() == [90.0, 80.0]
    assert attributes["width_max"].to_pylist() == [20.0, 10.0]
    m = shapely.get_coordinates(lines[1], include_m=True)[:, 2]
    assert m.max() == 10.0
    assert m[[0, -1]].tolist() == [0.0, 0.0]


@pytest.mark.parametrize("ending", ["shp", "gdb"])
def test_joints_stay_apart_from_refused_features_of_several_kinds(
    ending: str, midrib: Runner, tmp_path: Path
) -> None:
    onwards = "POLYGON ((90 0, 150 0, 150 20, 90 20, 90 0))"
    source = write(tmp_path / "in.geojson", [STRIP, "POINT (1 1)", onwards, BOW_TIE])
    out = tmp_path / f"out.{ending}"
    for again in ([], ["--overwrite"]):
        outcome = midrib("collapse", source, out, "--connect", *again)
        assert outcome.code == 1, outcome.err
        assert "1 joints end to end" in outcome.err
        for name, count in {"_refused": 1, "_refused_points": 1, "_joints": 2}.items():
            layer = f"some{name}" if ending == "gdb" else f"out{name}"
            place = out if ending == "gdb" else tmp_path / f"{layer}.shp"
            assert layer in outcome.err
            assert len(read_all(place, layer)[2]) == count


def test_a_file_of_others_in_the_place_for_joints_is_kept(midrib: Runner, tmp_path: Path) -> None:
    source = write(tmp_path / "in.gpkg", [STRIP])
    other = write(tmp_path / "out_joints.parquet", [STRIP])
    before = other.read_bytes()
    out = tmp_path / "out.parquet"
    outcome = midrib("collapse", source, out, "--connect", "--overwrite")
    assert outcome.code == 2
    assert "the place for joints, has no column 'reason'" in outcome.err
    assert midrib("collapse", source, out, "--overwrite").code == 0
    assert other.read_bytes() == before


@pytest.mark.parametrize("ending", ["parquet", "fgb", "shp", "geojson", "gpkg"])
def test_lines_that_do_not_meet_leave_no_joints_of_an_earlier_run(
    ending: str, midrib: Runner, tmp_path: Path
) -> None:
    onwards = "POLYGON ((90 0, 150 0, 150 20, 90 20, 90 0))"
    source, out = write(tmp_path / "in.gpkg", [STRIP, onwards]), tmp_path / f"out.{ending}"
    assert midrib("collapse", source, out).code == 0
    plain = {path.name for path in tmp_path.iterdir()}
    assert midrib("collapse", source, out, "--connect", "--overwrite").code == 0
    joined = {path.name for path in tmp_path.iterdir()}
    assert (plain == joined) == (ending == "gpkg")
    assert midrib("collapse", source, out, "--spacing", "0", "--overwrite").code == 2
    assert {path.name for path in tmp_path.iterdir()} == joined
    assert midrib("collapse", source, out, "--overwrite").code == 0
    assert {path.name for path in tmp_path.iterdir()} == plain
    assert ending != "gpkg" or "some_joints" not in layer_names(out)


def test_joints_that_are_drawn_are_kept_with_a_note(midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [STRIP]), tmp_path / "out.dxf"
    assert midrib("collapse", source, out, "--connect").code == 0
    outcome = midrib("collapse", source, out, "--overwrite")
    assert "out_joints.dxf was there before, it is left as it was" in outcome.err
    assert (tmp_path / "out_joints.dxf").exists()


@pytest.mark.parametrize("option", [["--ends", "main"], ["--main", "x"]])
def test_connect_excludes_what_places_ends(
    option: list[str], midrib: Runner, tmp_path: Path
) -> None:
    source = write(tmp_path / "in.gpkg", [STRIP])
    outcome = midrib("collapse", source, tmp_path / "out.gpkg", "--connect", *option)
    assert outcome.code == 2
    assert f"--connect excludes {option[0]}" in outcome.err


@pytest.mark.parametrize("ending", ["gpkg", "fgb", "shp", "gdb", "sqlite", "csv"])
def test_width_can_be_the_m_of_vertices(ending: str, midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [STRIP, TWO, BENT]), tmp_path / f"out.{ending}"
    assert midrib("collapse", source, out, "--width", "m", "--quiet").code == 0
    _, attributes, lines = read_all(out)
    for wkt, line in zip([STRIP, TWO, BENT], lines, strict=True):
        m = shapely.get_coordinates(line, include_m=True)[:, 2]
        expected = measures.width(shapely.force_2d(line), shapely.from_wkt(wkt))
        stored = 1e-4 if ending == "gdb" else 1e-9  # a geodatabase keeps steps of a tenth of a mm
        assert m == pytest.approx(expected, abs=stored)
    assert float(attributes["width_max"].to_pylist()[0]) == 20.0


def test_m_goes_beside_z(midrib: Runner, tmp_path: Path) -> None:
    area = "POLYGON Z ((0 0 5, 90 0 5, 90 20 5, 0 20 5, 0 0 5))"
    out = tmp_path / "out.gpkg"
    source = write(tmp_path / "in.gpkg", [area], kind="Polygon Z")
    assert midrib("collapse", source, out, "--width", "m").code == 0
    z, m = shapely.get_coordinates(read_all(out)[2], include_z=True, include_m=True)[:, 2:].T
    assert (z == 5.0).all()
    assert m.max() == 20.0


@pytest.mark.parametrize("ending", ["geojson", "parquet", "kml"])
def test_formats_without_m_say_so(ending: str, midrib: Runner, tmp_path: Path) -> None:
    outcome = midrib(
        "collapse", write(tmp_path / "in.gpkg", [STRIP]), tmp_path / f"out.{ending}", "--width", "m"
    )
    assert outcome.code == 2
    assert "has no place for M values, expected one of .gpkg" in outcome.err


def test_plain_tables_have_equal_spacing_and_an_identifier(midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [STRIP, None, BENT]), tmp_path / "out.csv"
    outcome = midrib("profile", source, out, "--spacing", "2500cm", "--id", "name")
    assert outcome.code == 0, outcome.err
    rows = csv.read_csv(out)
    assert rows.column_names[:4] == ["feature", "name", "part", "station"]
    first = rows.filter(pa.compute.equal(rows["feature"], 0))
    assert first["name"].to_pylist() == ["é 0"] * 5
    assert first["station"].to_pylist() == [0.0, 25.0, 50.0, 75.0, 90.0]
    assert first["width"].to_pylist() == [0.0, 20.0, 20.0, 20.0, 0.0]
    assert first["to_left"].to_pylist() == first["to_right"].to_pylist() == [10.0] * 5
    assert set(rows["feature"].to_pylist()) == {0, 2}


@pytest.mark.parametrize("ending", ["csv", "gpkg", "parquet"])
def test_refused_areas_are_listed_beside_the_table(
    ending: str, midrib: Runner, tmp_path: Path
) -> None:
    source, out = write(tmp_path / "in.gpkg", INPUTS["degenerate"][0]), tmp_path / f"out.{ending}"
    outcome = midrib("profile", source, out, "--out-layer", "rows")
    assert outcome.code == 1
    assert "4 features, 2 refused" in outcome.err
    if ending == "gpkg":
        reasons = read_all(out, "rows_refused")[1]
    elif ending == "csv":
        reasons = csv.read_csv(tmp_path / "out_refused.csv")
    else:
        reasons = read_all(tmp_path / "out_refused.parquet")[1]
    assert reasons["feature"].to_pylist() == [1, 2]
    assert all(reasons["reason"].to_pylist())


def test_heights_are_a_column(midrib: Runner, tmp_path: Path) -> None:
    area = "POLYGON Z ((0 0 0, 90 0 9, 90 20 9, 0 20 0, 0 0 0))"
    source = write(tmp_path / "in.gpkg", [area], kind="Polygon Z")
    assert midrib("profile", source, tmp_path / "out.csv").code == 0
    rows = csv.read_csv(tmp_path / "out.csv")
    x, z = (rows[name].to_numpy() for name in "xz")
    assert z == pytest.approx(x / 10.0)


def test_profiles_are_plotted(midrib: Runner, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    source, figure = write(tmp_path / "in.gpkg", random_areas()), tmp_path / "picture.svg"
    outcome = midrib("profile", source, tmp_path / "out.csv", "--figure", figure)
    assert outcome.code == 0, outcome.err
    assert "<svg" in figure.read_text()


@pytest.mark.parametrize("simplify", ["2", "2m", "200cm", "20%"])
def test_lines_are_simplified_and_smoothed(simplify: str, midrib: Runner, tmp_path: Path) -> None:
    source, out = write(tmp_path / "in.gpkg", [BENT, STRIP]), tmp_path / "out.gpkg"
    assert midrib("collapse", source, out, "--simplify", simplify).code == 0
    plain = read_all(out)[2]
    assert shapely.get_num_coordinates(plain).tolist() == [3, 2]
    outcome = midrib("collapse", source, out, "--simplify", simplify, "--smooth", "--overwrite")
    assert outcome.code == 0
    _, attributes, lines = read_all(out)
    assert shapely.get_num_coordinates(lines).tolist() == [10, 2]
    assert shapely.from_wkt(BENT).covers(lines[0])
    assert attributes["length"].to_pylist() == shapely.length(lines).tolist()
    assert lines[0].length < plain[0].length


RIVER = "POLYGON ((0 0, 90 0, 90 20, 0 20, 0 0), (40 4, 50 4, 50 12, 40 12, 40 4))"
ARM = "POLYGON ((0 0, 40 0, 40 -30, 50 -30, 50 0, 90 0, 90 10, 0 10, 0 0))"


@pytest.mark.parametrize(
    ("options", "levels"),
    [
        (["--holes", "ignored"], [10.0]),
        (["--holes", "auxiliary"], [2.0, 16.0]),
        (["--channel", "wider"], [16.0]),
    ],
)
def test_lines_pass_holes_as_they_are_told(
    options: list[str], levels: list[float], midrib: Runner, tmp_path: Path
) -> None:
    """Main is the lower side: a directional polyline says so."""
    source = write(tmp_path / "in.gpkg", [RIVER])
    out, table = tmp_path / "out.gpkg", tmp_path / "out.csv"
    assert midrib("collapse", source, out, "--quiet", *options).code == 0
    _, attributes, (line,) = read_all(out)
    across = line.intersection(shapely.LineString([(45, 0), (45, 20)]))
    assert min(abs(across.y - level) for level in levels) < 0.25
    assert midrib("profile", source, table, "--quiet", *options).code == 0
    width = csv.read_csv(table)["width"].to_pylist()
    assert max(width) == pytest.approx(20.0, abs=0.3)
    if "ignored" in options:
        assert attributes["width_max"].to_pylist() == [20.0]
        assert min(width[1:-1]) == 20.0


def test_the_status_says_how_many_stations_in_bays_were_left_out(
    midrib: Runner, tmp_path: Path
) -> None:
    source, out = write(tmp_path / "in.gpkg", [STRIP, ARM]), tmp_path / "out.gpkg"
    assert midrib("collapse", source, out, "--quiet", "--centring", "none").code == 0
    plain, with_arm = read_all(out)[1]["status"].to_pylist()
    assert plain == "ok"
    assert with_arm.startswith("bays left out: ")
    assert with_arm.endswith(" stations")
