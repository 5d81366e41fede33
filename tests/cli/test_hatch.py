"""``midrib hatch``: registers in, drawings out, exit codes, what is said."""

from pathlib import Path

import geopandas as gpd
import pyarrow as pa
import pyogrio
import pytest
import shapely

from midrib.formats.contents import layer_names
from midrib.formats.writing import Features, write_layer
from tests.cli.commands import Runner
from tests.formats.gml_files import BDOT_2015, collection, earthwork, ring
from tests.formats.layers import RD_NEW, write

AREAS = [
    "POLYGON ((0 0, 60 0, 60 8, 0 8, 0 0))",
    "POLYGON ((0 20, 40 20, 55 35, 45 45, 20 32, 0 30, 0 20))",
]
TOPS = ["LINESTRING (60 8, 0 8)", "LINESTRING (0 20, 40 20, 55 35)"]
BOW_TIE = "POLYGON ((0 60, 9 69, 9 60, 0 69, 0 60))"
OUTS = ("gpkg", "parquet", "geojson", "dxf", "svg", "pdf")


def register(folder: Path, areas: list[str], tops: list[str]) -> Path:
    """Layer of slopes with their tops as a field."""
    path = folder / "in.gpkg"
    columns = {"name": [f"s{i}" for i in range(len(areas))], "crest": tops}
    table = pa.table({name: pa.array(texts, pa.string()) for name, texts in columns.items()})
    write_layer(path, Features("slopes", table, shapely.from_wkt(areas), "geom", "Polygon", RD_NEW))
    return path


@pytest.fixture
def slopes(tmp_path: Path) -> Path:
    """Two slopes."""
    return register(tmp_path, AREAS, TOPS)


@pytest.mark.parametrize("ending", OUTS)
def test_every_format_is_written_whole(
    ending: str, slopes: Path, tmp_path: Path, midrib: Runner
) -> None:
    out = tmp_path / f"out.{ending}"
    outcome = midrib("hatch", slopes, out, "--top", "crest", "--quiet")
    assert (outcome.code, outcome.out, outcome.err) == (0, "", "")
    assert out.stat().st_size > 1000
    assert not list(tmp_path.glob(".midrib-*"))
    again = midrib("hatch", slopes, out, "--top", "crest", "--quiet")
    assert again.code == 2
    assert "exists, give --overwrite" in again.err
    assert midrib("hatch", slopes, out, "--top", "crest", "--quiet", "--overwrite").code == 0


def test_layers_and_summary(slopes: Path, tmp_path: Path, midrib: Runner) -> None:
    out = tmp_path / "out.gpkg"
    outcome = midrib("hatch", slopes, out, "--top", "crest", "--scale", "1000")
    assert outcome.code == 0
    assert set(layer_names(out)) >= {"strokes", "outlines", "layer_styles"}
    found = pyogrio.read_dataframe(out, layer="strokes")
    assert f"{len(found)} strokes of 2 objects at 1:1000, 0 refused" in outcome.err
    assert f"written to {out}" in outcome.err.replace("\n", "")
    assert set(found["standard"]) == {"pl-2021-slope-unreinforced"}


def test_options_reach_the_strokes(slopes: Path, tmp_path: Path, midrib: Runner) -> None:
    out = tmp_path / "out.gpkg"
    options = ["--spacing", 4, "--pattern", "LSS", "--short-ratio", 0.25, "--first", "short"]
    options += ["--symbol", "wedge", "--symbol-width", 0.8, "--standard", "pl-2015"]
    assert midrib("hatch", slopes, out, "--top", "crest", *options).code == 0
    found = pyogrio.read_dataframe(out, layer="symbols")
    first = found[found["area"] == found["area"].iloc[0]]
    assert len(first) == pytest.approx(60 / 2.0, abs=1)
    assert first["is_long"].tolist()[:4] in (
        [False, True, False, False],
        [False, False, True, False],
    )


def test_no_stroke_enters_an_excluded_area(slopes: Path, tmp_path: Path, midrib: Runner) -> None:
    house = shapely.box(20, 2, 30, 6)
    zones = tmp_path / "houses.gpkg"
    write(zones, [house.wkt], kind="Polygon")
    outs = [tmp_path / "all.gpkg", tmp_path / "some.gpkg"]
    assert midrib("hatch", slopes, outs[0], "--top", "crest").code == 0
    assert midrib("hatch", slopes, outs[1], "--top", "crest", "--exclude", zones).code == 0
    both = [pyogrio.read_dataframe(out, layer="strokes").geometry for out in outs]
    crossing = [strokes.intersection(house.buffer(-1e-9)).length.gt(0).sum() for strokes in both]
    assert crossing[0] >= 2
    assert crossing[1] == 0
    assert len(both[1]) < len(both[0])


def test_zones_are_taken_out_of_collections(slopes: Path, tmp_path: Path, midrib: Runner) -> None:
    house, others = shapely.box(20, 2, 30, 6), shapely.box(40, 2, 44, 6)
    nested = shapely.GeometryCollection([shapely.GeometryCollection([house]), others])
    found = []
    for name, wkts in (("plain", [house.wkt, others.wkt]), ("nested", [nested.wkt, None])):
        zones, out = tmp_path / f"zones-{name}.gpkg", tmp_path / f"{name}.gpkg"
        write(zones, wkts)
        assert midrib("hatch", slopes, out, "--top", "crest", "--exclude", zones).code == 0
        found.append(pyogrio.read_dataframe(out, layer="strokes").geometry.to_numpy())
    assert shapely.equals_exact(*found, tolerance=0.0).all()
    ink = shapely.union_all(found[1])
    assert not ink.intersects(house)
    assert not ink.intersects(others)


@pytest.mark.parametrize(
    ("things", "told"),
    [
        (["LINESTRING (30 -9, 30 20)", "POLYGON ((20 2, 30 2, 30 6, 20 2))"], "1 LineString"),
        (
            ["GEOMETRYCOLLECTION (POLYGON ((20 2, 30 2, 30 6, 20 2)), POINT (9 9))", "POINT (1 1)"],
            "2 Point",
        ),
        (["LINESTRING (30 -9, 30 20)", "POINT (1 1)"], "1 LineString, 1 Point"),
    ],
)
def test_zones_that_are_no_areas_are_refused(
    things: list[str | None], told: str, slopes: Path, tmp_path: Path, midrib: Runner
) -> None:
    zones, out = tmp_path / "zones.gpkg", tmp_path / "out.gpkg"
    write(zones, things)
    outcome = midrib("hatch", slopes, out, "--top", "crest", "--exclude", zones)
    assert outcome.code == 2
    sentence = f"holds {told}, expected Polygons and MultiPolygons only"
    assert sentence in " ".join(outcome.err.split())
    assert not out.exists()


def test_excluded_areas_in_another_crs_are_refused(tmp_path: Path, midrib: Runner) -> None:
    source, zones = tmp_path / "in.gpkg", tmp_path / "houses.gpkg"
    gpd.GeoDataFrame(geometry=[shapely.box(20, 2, 30, 6)], crs="EPSG:2177").to_file(zones)
    areas = gpd.GeoSeries.from_wkt(AREAS, crs="EPSG:2178")
    gpd.GeoDataFrame({"top": TOPS}, geometry=areas).to_file(source)
    outcome = midrib("hatch", source, tmp_path / "a.gpkg", "--top", "top", "--exclude", zones)
    assert outcome.code == 2
    assert "is in another CRS than IN" in outcome.err


def test_strokes_that_zones_have_taken_are_counted(
    slopes: Path, tmp_path: Path, midrib: Runner
) -> None:
    told = []
    for name, zone in (("some", shapely.box(20, 2, 30, 6)), ("none", shapely.box(200, 2, 210, 6))):
        zones, out = tmp_path / f"zones-{name}.gpkg", tmp_path / f"{name}.gpkg"
        write(zones, [zone.wkt])
        outcome = midrib("hatch", slopes, out, "--top", "crest", "--exclude", zones)
        told.append((len(pyogrio.read_dataframe(out, layer="strokes")), outcome.err))
    (left, some), (whole, none) = told
    assert f"note: strokes left out in zones of --exclude: {whole - left}\n" in some
    assert "in zones" not in none


@pytest.mark.parametrize(
    ("command", "option"),
    [(("hatch", "a.gpkg"), "--top"), (("check",), "--top"), (("check",), "--strokes")],
)
def test_lines_in_another_crs_are_refused(
    command: tuple[str, ...], option: str, tmp_path: Path, midrib: Runner
) -> None:
    source = tmp_path / "in.gpkg"
    areas = gpd.GeoSeries.from_wkt(AREAS, crs="EPSG:2178")
    gpd.GeoDataFrame({"top": TOPS}, geometry=areas).to_file(source, layer="slopes")
    lines = gpd.GeoSeries.from_wkt(TOPS, crs="EPSG:2180")
    gpd.GeoDataFrame(geometry=lines).to_file(source, layer="lines")
    places = [tmp_path / name for name in command[1:]]
    top = ["--top", "lines" if option == "--top" else "top"]
    strokes = ["--strokes", "lines"] if option == "--strokes" else []
    outcome = midrib(command[0], source, *places, "--layer", "slopes", *top, *strokes)
    assert outcome.code == 2
    sentence = "is in another CRS than IN, ETRF2000-PL / CS92, expected the same: ETRF2000-PL"
    assert sentence in " ".join(outcome.err.split())


def test_a_spacing_of_ones_own_is_not_bounded_by_the_standard(
    slopes: Path, tmp_path: Path, midrib: Runner
) -> None:
    out = tmp_path / "out.gpkg"
    assert midrib("hatch", slopes, out, "--top", "crest", "--spacing", "0.3").code == 0
    dense = len(pyogrio.read_dataframe(out, layer="strokes"))
    assert (
        midrib("hatch", slopes, out, "--top", "crest", "--spacing", "0.6", "--overwrite").code == 0
    )
    assert dense == pytest.approx(2 * len(pyogrio.read_dataframe(out, layer="strokes")), rel=0.1)


@pytest.mark.parametrize("scale", ["0", "nan"])
def test_no_scale_is_refused(scale: str, slopes: Path, tmp_path: Path, midrib: Runner) -> None:
    outcome = midrib("hatch", slopes, tmp_path / "a.gpkg", "--top", "crest", "--scale", scale)
    assert outcome.code == 2
    assert f"scale is {float(scale)}, expected a number above 0" in outcome.err


def test_refused_slopes_are_listed_and_the_rest_is_written(tmp_path: Path, midrib: Runner) -> None:
    source = register(tmp_path, [*AREAS, BOW_TIE], [*TOPS, "LINESTRING (0 60, 9 69)"])
    out = tmp_path / "out.gpkg"
    outcome = midrib("hatch", source, out, "--top", "crest")
    assert outcome.code == 1
    assert "1 refused" in outcome.err
    assert "refused: " in outcome.err
    problems = pyogrio.read_dataframe(out, layer="problems")
    assert problems["problem"].tolist() == ["refused"]
    assert problems["reason"].str.len().min() > 10
    assert len(pyogrio.read_dataframe(out, layer="strokes")) > 20


def test_slopes_that_rise_from_top_to_toe_are_told_and_drawn_all_the_same(
    tmp_path: Path, midrib: Runner
) -> None:
    """Heights are those of the vertices; the note names the first three."""
    starts = (0, 30, 60, 90)
    tops = [f"LINESTRING ({x} 8, {x + 20} 8)" for x in starts]
    note = "note: tops lower than their toes: 4 (0, 1, 2 and 1 more)"
    drawn = []
    for toe, top in ((1, 2), (2, 1)):
        rings = [
            f"{x} 0 {toe}, {x + 20} 0 {toe}, {x + 20} 8 {top}, {x} 8 {top}, {x} 0 {toe}"
            for x in starts
        ]
        folder = tmp_path / f"{toe}"
        folder.mkdir()
        source = register(folder, [f"POLYGON Z (({ring}))" for ring in rings], tops)
        outcome = midrib("hatch", source, folder / "out.gpkg", "--top", "crest")
        assert outcome.code == 0
        assert (note in outcome.err) == (top < toe)
        strokes = pyogrio.read_dataframe(folder / "out.gpkg", layer="strokes").geometry
        drawn.append(shapely.force_2d(strokes.to_numpy()))
    assert shapely.equals_exact(*drawn, tolerance=0.0).all()
    problems = pyogrio.read_dataframe(tmp_path / "2" / "out.gpkg", layer="problems")
    assert problems["problem"].tolist() == ["swapped"] * 4


def test_marks_of_problems_can_be_left_out(tmp_path: Path, midrib: Runner) -> None:
    source = register(tmp_path, [*AREAS, BOW_TIE], [*TOPS, "LINESTRING (0 60, 9 69)"])
    marked, plain = tmp_path / "marked.dxf", tmp_path / "plain.dxf"
    assert midrib("hatch", source, marked, "--top", "crest").code == 1
    outcome = midrib("hatch", source, plain, "--top", "crest", "--no-problems")
    assert outcome.code == 1
    assert "refused: " in outcome.err
    assert "MIDRIB_PROBLEMS" in marked.read_text()
    assert "MIDRIB_PROBLEMS" not in plain.read_text()


def test_a_standard_of_ones_own_is_given_by_its_file(
    slopes: Path, tmp_path: Path, midrib: Runner
) -> None:
    own = tmp_path / "house.toml"
    text = 'title = "House"\nsource = "us"\nconfidence = "read"\nbase = "pl-2015-dyke"\n'
    own.write_text(
        text + 'kinds = ["other", "slope-unreinforced"]\nspacing = 6.0\n', encoding="utf-8"
    )
    out = tmp_path / "out.gpkg"
    assert (
        midrib("hatch", slopes, out, "--top", "crest", "--standard", own, "--rule", "paper").code
        == 0
    )
    found = pyogrio.read_dataframe(out, layer="strokes")
    assert set(found["standard"]) == {"house"}
    own.write_text(text + "spacing = -1\n", encoding="utf-8")
    outcome = midrib("hatch", slopes, out, "--top", "crest", "--standard", own, "--overwrite")
    assert outcome.code == 2
    assert "house.toml': key 'spacing' is -1, expected a length above 0" in outcome.err


def test_objects_of_other_kinds_are_left_out_with_a_note(
    slopes: Path, tmp_path: Path, midrib: Runner
) -> None:
    outcome = midrib(
        "hatch", slopes, tmp_path / "out.svg", "--top", "crest", "--standard", "pl-2021-wall"
    )
    assert outcome.code == 1
    assert "note: objects left out: 2" in outcome.err
    reason = "standard 'pl-2021-wall' is made for wall, and IN has nothing of these; --kind says"
    assert f"nothing is drawn: {reason}" in outcome.err


def test_kinds_of_ones_own_reach_every_symbol_that_is_no_stroke(
    slopes: Path, tmp_path: Path, midrib: Runner
) -> None:
    found = {}
    for kind in ("gantry", "water-gate", "conveyor", "wall", "stairs"):
        year = "2021" if kind in {"wall", "stairs"} else "2015"
        out = tmp_path / f"{kind}.gpkg"
        options = ["--top", "crest", "--kind", kind, "--standard", f"pl-{year}"]
        assert midrib("hatch", slopes, out, *options).code == 0
        table = pyogrio.read_dataframe(out, layer="strokes")
        assert set(table["standard"]) == {f"pl-{year}-{kind}"}
        found[kind] = len(table)
    assert found["gantry"] == 2 * 3  # frame and diagonals of each
    assert found["water-gate"] == 2
    assert min(found["conveyor"], found["wall"], found["stairs"]) >= 10


def test_a_field_tells_kinds(slopes: Path, tmp_path: Path, midrib: Runner) -> None:
    table = gpd.read_file(slopes).assign(what=["gantry", "dyke"])
    table.to_file(tmp_path / "told.gpkg")
    out = tmp_path / "out.gpkg"
    options = ["--top", "crest", "--standard", "pl-2015", "--kind"]
    assert midrib("hatch", tmp_path / "told.gpkg", out, *options, "what").code == 0
    drawn = pyogrio.read_dataframe(out, layer="strokes")
    assert set(drawn["kind"]) == {"gantry", "dyke"}
    again = midrib("hatch", tmp_path / "told.gpkg", out, *options, "what", "--overwrite")
    assert f"{len(drawn) - 3} strokes and 1 symbols of 2 objects" in again.err
    table.assign(what=["gantry", "bridge"]).to_file(tmp_path / "told.gpkg")
    for name, sentence in (
        ("what", "field 'what' of object"),
        ("bridge", "kind is 'bridge', expected one of slope-unreinforced"),
    ):
        wrong = midrib("hatch", tmp_path / "told.gpkg", out, *options, name, "--overwrite")
        assert wrong.code == 2
        assert sentence in wrong.err
        assert "conveyor, gantry, water-gate" in wrong.err


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--offset", "1e6"], "offset is 1e+06 gaps from either end"),
        (["--exclude", "all.gpkg"], "zones of exclude hide every stroke"),
    ],
)
def test_when_nothing_is_drawn_the_reason_is_said(
    options: list[str], sentence: str, slopes: Path, tmp_path: Path, midrib: Runner
) -> None:
    write(tmp_path / "all.gpkg", [shapely.box(-9, -9, 99, 99).wkt], kind="Polygon")
    told = [tmp_path / option if option.endswith(".gpkg") else option for option in options]
    outcome = midrib("hatch", slopes, tmp_path / "out.gpkg", "--top", "crest", *told)
    assert outcome.code == 1
    assert f": {sentence}" in outcome.err.partition("nothing is drawn: ")[2]
    assert set(layer_names(tmp_path / "out.gpkg")) >= {"outlines", "problems"}


@pytest.mark.parametrize("ending", ["gpkg", "pdf", "svg"])
def test_an_empty_layer_is_no_failure(ending: str, tmp_path: Path, midrib: Runner) -> None:
    out = tmp_path / f"out.{ending}"
    outcome = midrib("hatch", register(tmp_path, [], []), out, "--top", "crest")
    assert outcome.code == 0
    assert "note: IN has no slopes\n" in outcome.err
    is_sheet = ending != "gpkg"
    assert out.exists() != is_sheet
    assert ("note: there is nothing to draw, no sheet is written" in outcome.err) == is_sheet
    assert ("written to" in outcome.err) != is_sheet


def test_no_old_sheet_stays_where_nothing_is_drawn(tmp_path: Path, midrib: Runner) -> None:
    out = tmp_path / "out.svg"
    out.write_text("old")
    source = register(tmp_path, [], [])
    assert midrib("hatch", source, out, "--top", "crest", "--overwrite").code == 0
    assert not out.exists()


def test_a_register_whose_slopes_have_ended_is_told_from_one_without(
    tmp_path: Path, midrib: Runner
) -> None:
    x, y = 6_481_000.0, 5_616_000.0
    corners = [(x, y), (x + 90, y), (x + 90, y + 9), (x, y + 9)]
    slope = earthwork("old", ring(corners), corners[0], corners[1])
    ended = slope.replace("</bdz:BDZ", "<bdz:koniecObiekt>2022</bdz:koniecObiekt></bdz:BDZ", 1)
    out = tmp_path / "out.gpkg"
    told = {}
    for name, features in (("none", []), ("ended", [ended])):
        path = collection(tmp_path / f"{name}.gml", BDOT_2015, *features)
        told[name] = midrib("hatch", path, out, "--standard", "pl-2015", "--overwrite")
    assert (told["none"].code, told["ended"].code) == (0, 1)
    assert "--history" not in told["none"].err
    sentence = "nothing is drawn: slopes that have ended: 1; --history draws them"
    assert sentence in told["ended"].err
    options = ["--standard", "pl-2015", "--history", "--overwrite"]
    assert midrib("hatch", path, out, *options).code == 0
    assert len(pyogrio.read_dataframe(out, layer="strokes")) == 90 / 4.5 - 1


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--standard", "pl-2035"], "standard is 'pl-2035', expected one of arcgis-like"),
        (["--scale", "-5"], "scale is -5.0, expected a number above 0"),
        (["--short-ratio", "2"], "key 'short_ratio' is 2.0, expected a number from 0.05"),
        (["--factor", "1", "--spacing", "2"], "has both keys 'factor' and 'spacing'"),
        (["--offset", "0"], "offset is 0.0, expected a number above 0"),
        (["--paper", "A3"], "paper is 'A3', expected A4, A3, A2, A1, A0, with OUT .svg or .pdf"),
        (["--symbol", "zigzag"], "key 'symbol' is 'zigzag', expected 'line', 'wedge'"),
    ],
)
def test_wrong_usage_is_said_in_one_sentence(
    options: list[str], sentence: str, slopes: Path, tmp_path: Path, midrib: Runner
) -> None:
    outcome = midrib("hatch", slopes, tmp_path / "out.gpkg", "--top", "crest", *options)
    assert outcome.code == 2
    assert sentence in outcome.err
    assert outcome.err.count("\n") == 1
    assert not (tmp_path / "out.gpkg").exists()


def test_standards_are_listed(midrib: Runner) -> None:
    outcome = midrib("standards")
    assert outcome.code == 0
    first, *rows = outcome.out.splitlines()
    assert first.split() == ["name", "symbol", "confidence", "for", "source"]
    assert len(rows) == 17
    assert rows[4].startswith("iof-104")
