"""``midrib hatch`` and ``midrib check`` on files that are not what they should be."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from ezdxf.filemanagement import new
from shapely import GeometryCollection, LineString, Point, Polygon, box

from midrib.formats.writing import Features, write_layer
from tests.cli.commands import Runner
from tests.formats.layers import RD_NEW
from tests.formats.test_slope_layers import save

SLAB = box(0, 0, 20, 4)
FIELDS = ("gora_start_x", "gora_start_y", "gora_koniec_x", "gora_koniec_y")
KNOWN = dict(zip(FIELDS, ([0.0], [4.0], [20.0], [4.0]), strict=True))
GML = (
    '<gml:FeatureCollection xmlns:gml="http://www.opengis.net/gml/3.2"{}>{}</gml:FeatureCollection>'
)
OTHER = """<gml:featureMember><a xmlns="http://u/v"><geom><gml:Polygon srsName="EPSG:2177">
<gml:exterior><gml:LinearRing><gml:posList>0 0 20 0 20 4 0 4 0 0</gml:posList></gml:LinearRing>
</gml:exterior></gml:Polygon></geom></a></gml:featureMember>"""
POLISH = ' xmlns:bdz="urn:gugik:specyfikacje:gmlas:bazaDanychObiektowTopograficznych500:1.0"'


def slopes(path: Path) -> Path:
    """One slope that tells its top."""
    return save(path, "slopes", [SLAB], id=["a"], **KNOWN)


def text(content: str) -> Callable[[Path], Path]:
    """A file of text."""

    def write(path: Path) -> Path:
        path.write_text(content, encoding="utf-8")
        return path

    return write


def points(path: Path) -> Path:
    """A layer of points."""
    return save(path, "pts", [Point(0, 0)], id=[1])


def no_top(path: Path) -> Path:
    """A slope without anything that tells its top."""
    return save(path, "s", [SLAB], id=[1])


def two_layers(path: Path) -> Path:
    """Two layers that both tell their tops."""
    for name in ("north", "south"):
        save(path, name, [SLAB], id=["a"], **KNOWN)
    return path


def drawing(path: Path) -> Path:
    """A drawing of nothing."""
    new().saveas(path)
    return path


def row(*values: str) -> Callable[[Path], Path]:
    """One slope with texts where the top should be."""
    fields = {name: [value] for name, value in zip(FIELDS, values, strict=True)}
    return lambda path: save(path, "slopes", [SLAB], id=["a"], **fields)


CASES = [
    ("points.gpkg", points, [], "holds Point, expected areas"),
    ("no_top.gpkg", no_top, [], "layer 's' has the fields 'id', expected top, or"),
    ("a.gpkg", slopes, ["--layer", "nope"], "--layer is 'nope', expected a layer of IN"),
    ("two.gpkg", two_layers, [], "choose one with --layer: 'north', 'south'"),
    ("other.gml", text(GML.format("", OTHER)), [], "layer 'a' has the fields"),
    ("broken.gml", text(GML.format("", OTHER)[:120]), [], "cannot be read to its end: "),
    ("nothing.gml", text(""), [], "cannot be read to its end: "),
    ("fake.gpkg", text("hello"), [], "IN '{path}' cannot be read as a vector file"),
    ("fake.dxf", text("hello"), [], "cannot be read as a drawing"),
    ("empty.dxf", drawing, [], "has no lines, expected top to name a layer with some"),
    ("table.csv", text("id,x\n1,2\n"), [], "IN '{path}' holds no geometries, expected areas"),
    ("a.gpkg", slopes, ["--scale", "0"], "scale is 0.0, expected a number above 0"),
    ("a.gpkg", slopes, ["--standard", "pl-2022"], "standard is 'pl-2022', expected one of"),
    ("a.gpkg", slopes, ["--start", "x,y"], "start is 'x,y' and end is None, expected both"),
]  # fmt: skip


@pytest.mark.parametrize("command", ["hatch", "check"])
@pytest.mark.parametrize(
    ("name", "make", "options", "said"), CASES, ids=[f"{n} {' '.join(o)}" for n, _, o, _ in CASES]
)
def test_what_is_wrong_is_one_sentence(
    command: str,
    name: str,
    make: Callable[[Path], Path],
    options: list[str],
    said: str,
    tmp_path: Path,
    midrib: Runner,
) -> None:
    path = make(tmp_path / name)
    out = tmp_path / "out.gpkg"
    outcome = midrib(command, path, *([out] if command == "hatch" else []), *options)
    assert outcome.code == 2
    assert said.format(path=path) in outcome.err
    assert outcome.err.startswith("midrib: ")
    assert outcome.err.count("\n") == 1
    assert not out.exists()


def test_options_with_a_file_of_the_wrong_kind_are_named(tmp_path: Path, midrib: Runner) -> None:
    path, other = slopes(tmp_path / "a.gpkg"), points(tmp_path / "points.gpkg")
    out = tmp_path / "out.gpkg"
    excluded = midrib("hatch", path, out, "--exclude", other)
    assert f"--exclude '{other}' holds Point, expected areas" in excluded.err
    strokes = midrib("check", path, "--strokes", other)
    assert f"--strokes is '{other}', which holds Point, expected lines" in strokes.err
    table = midrib("check", path, "-o", tmp_path / "a.txt")
    assert f"--out '{tmp_path / 'a.txt'}' ends in '.txt'" in table.err
    sheet = midrib("hatch", path, tmp_path / "out.docx")
    assert "expected one of .dxf, .svg, .pdf, .gml, .gpkg" in sheet.err
    assert {run.code for run in (excluded, strokes, table, sheet)} == {2}


def test_areas_that_are_none_are_not_told_to_lack_a_top(tmp_path: Path, midrib: Runner) -> None:
    bow_tie = Polygon([(100, 0), (104, 4), (104, 0), (100, 4)])
    odd = {
        "its geometry is nothing, expected a Polygon": None,
        "its geometry is an empty Polygon, expected a Polygon": Polygon(),
        "its area is not valid: Self-intersection at (102, 2)": bow_tie,
        "its geometry is Point, expected a Polygon": Point(50, 0),
        "its geometry is an empty GeometryCollection, expected a Polygon": GeometryCollection(),
        "it has no top": box(200, 0, 220, 4),
    }
    path = save(tmp_path / "a.gpkg", "slopes", [SLAB, *odd.values()], id=[*"abcdefg"])
    save(path, "top", [LineString([(0, 4), (20, 4)])])
    out = tmp_path / "out.gpkg"
    outcome = midrib("hatch", path, out, "--layer", "slopes", "--top", "top")
    assert outcome.code == 1
    for name, reason in zip("bcdefg", odd, strict=True):
        assert f"refused: {name}: {reason}\n" in outcome.err


def test_rows_that_are_no_slopes_are_named_and_the_rest_is_drawn(
    tmp_path: Path, midrib: Runner
) -> None:
    odd = [Point(1, 1), LineString([(0, 4), (20, 4)]), None, GeometryCollection([SLAB, Point()])]
    fields = {name: value * 5 for name, value in KNOWN.items()}
    path = save(tmp_path / "a.gpkg", "slopes", [SLAB, *odd], id=[*"abcde"], **fields)
    outcome = midrib("hatch", path, tmp_path / "out.gpkg")
    assert outcome.code == 1
    for name, found in zip("bcde", ("Point", "LineString", "nothing", "GeometryColl"), strict=True):
        assert f"refused: {name}: its geometry is {found}" in outcome.err
    assert outcome.err.count("refused:") == 4


@pytest.mark.parametrize("values", [("zero", "4", "20", "4"), ("0", "4", "20", "")])
def test_texts_that_are_no_numbers_refuse_the_row(
    values: tuple[str, ...], tmp_path: Path, midrib: Runner
) -> None:
    outcome = midrib("hatch", row(*values)(tmp_path / "a.gpkg"), tmp_path / "out.gpkg")
    assert outcome.code == 1
    assert "expected two numbers" in outcome.err


def test_numbers_may_be_texts(tmp_path: Path, midrib: Runner) -> None:
    outcome = midrib("hatch", row("0", "4", "20", "4")(tmp_path / "a.gpkg"), tmp_path / "out.gpkg")
    assert outcome.code == 0


@pytest.mark.parametrize("source", ["empty.gpkg", "empty.gml"])
@pytest.mark.parametrize("ending", ["gml", "gpkg", "dxf", "svg", "pdf"])
def test_a_file_without_slopes_is_drawn_without_any(
    source: str, ending: str, tmp_path: Path, midrib: Runner
) -> None:
    path = tmp_path / source
    if source == "empty.gml":
        text(GML.format(POLISH, ""))(path)
    else:
        nothing = pa.table({name: pa.array([], pa.float64()) for name in FIELDS})
        rows = np.empty(0, dtype=object)
        write_layer(path, Features("slopes", nothing, rows, "geom", "Polygon", RD_NEW))
    out = tmp_path / f"out.{ending}"
    outcome = midrib("hatch", path, out)
    assert outcome.code == 0
    assert "note: IN has no slopes\n" in outcome.err
    assert out.exists() == (ending not in {"svg", "pdf"})  # a sheet would be blank
