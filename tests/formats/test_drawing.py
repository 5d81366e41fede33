"""Drawings in every format: read back, opened by the libraries of the formats, measured."""

import re
import sqlite3
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pyarrow as pa
import pyogrio
import pytest
import shapely
from ezdxf.document import Drawing as Document
from ezdxf.filemanagement import readfile
from shapely import LineString
from shapely.affinity import translate

from midrib import standard
from midrib.errors import ParameterError
from midrib.formats.contents import layer_names
from midrib.formats.crs import system_of
from midrib.formats.drawing.content import LINES, PROBLEMS, Drawing, Trouble, layers_of
from midrib.formats.drawing.heights import relief_of
from midrib.formats.drawing.qgis import style_of
from midrib.formats.drawing.sheet import AROUND, MARGIN, pages_of
from midrib.formats.drawing.write import check_places, write_drawing
from midrib.formats.reading import open_layer
from tests.formats.drawings import EAST, NORTH, drawing
from tests.hatching.standin import mound, rectangle

system = system_of("EPSG:2177")
assert system is not None
POLAND = system.crs
SVG = {"svg": "http://www.w3.org/2000/svg"}
GML = {
    "bt": "urn:gugik:specyfikacje:gmlas:modelPodstawowy:1.0",
    "gml": "http://www.opengis.net/gml/3.2",
}
ENDINGS = ("gpkg", "parquet", "fgb", "geojson", "shp", "dxf", "svg", "pdf")


def only(drawing: Drawing, *names: str) -> Drawing:
    """Some of the objects."""
    drawing.objects = [drawn for drawn in drawing.objects if drawn.id in names]
    return drawing


def written(folder: Path, ending: str, content: Drawing | None = None) -> Path:
    """Drawing in a file."""
    path = folder / f"map.{ending}"
    write_drawing(path, drawing(POLAND) if content is None else content)
    return path


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "fgb", "geojson", "shp"])
def test_strokes_are_read_back_with_their_attributes(ending: str, tmp_path: Path) -> None:
    path = written(tmp_path, ending)
    content = drawing(POLAND)
    with open_layer(path, LINES if ending == "gpkg" else next(iter(layer_names(path)))) as source:
        batches = list(source.batches())
    table = pa.concat_tables([batch.attributes for batch in batches])
    lines = np.concatenate([batch.geometries for batch in batches])
    expected = np.concatenate([drawn.symbols.flat().lines for drawn in content.objects])
    assert shapely.equals_exact(lines, expected, tolerance=1e-6).all()
    assert set(table["area"].to_pylist()) == {"s1", "m1", "c1"}  # wedges have no line
    rows = [row for row in table.to_pylist() if row["area"] == "s1"]
    assert [row["stroke"] for row in rows] == list(range(9))
    assert [bool(row["is_long"]) for row in rows] == [True, False] * 4 + [True]
    assert [row["width"] for row in rows] == pytest.approx([6.0] * 9)
    assert [row["length"] for row in rows] == pytest.approx([6.0, 3.0] * 4 + [6.0])
    assert {row["standard"] for row in rows} == {"pl-2015-slope-unreinforced"}


@pytest.mark.parametrize("ending", ENDINGS)
def test_nothing_is_left_over_and_nothing_is_stale(ending: str, tmp_path: Path) -> None:
    written(tmp_path, ending)
    before = {path.stem for path in tmp_path.iterdir()}
    has_layers = ending in {"gpkg", "dxf", "svg", "pdf"}
    others = set() if has_layers else {"map_symbols", "map_outlines", "map_problems"}
    assert before == {"map"} | others
    empty = Drawing(500.0, POLAND)
    write_drawing(tmp_path / f"map.{ending}", empty)
    kept = set() if ending in {"svg", "pdf"} else {"map"}  # a sheet would be blank
    assert {path.stem for path in tmp_path.iterdir()} == kept


def test_a_layer_is_there_only_if_it_has_something() -> None:
    assert [layer.layer for layer in layers_of(Drawing(500.0))] == [LINES]
    assert [layer.layer for layer in layers_of(drawing())] == [
        LINES,
        "symbols",
        "outlines",
        PROBLEMS,
    ]


def test_a_failure_leaves_everything_as_it_was(tmp_path: Path) -> None:
    path = written(tmp_path, "svg")
    old = path.read_bytes()
    with pytest.raises(ParameterError, match=r"takes 3 pages of A4, expected OUT .pdf"):
        write_drawing(path, drawing(scale=100.0), paper="A4")
    assert path.read_bytes() == old
    assert list(tmp_path.iterdir()) == [path]


# QGIS


def test_a_geopackage_has_a_default_style_for_each_layer(tmp_path: Path) -> None:
    path = written(tmp_path, "gpkg")
    with sqlite3.connect(path) as file:
        styles = file.execute(
            "SELECT f_table_name, f_geometry_column, useAsDefault, styleQML FROM layer_styles"
        ).fetchall()
        tables = dict(file.execute("SELECT table_name, data_type FROM gpkg_contents").fetchall())
        (check,) = file.execute("PRAGMA integrity_check").fetchone()
    file.close()
    assert check == "ok"
    assert tables.pop("layer_styles") == "attributes"
    assert [(name, column, is_default) for name, column, is_default, _ in styles] == [
        (name, "geom", 1) for name in tables
    ]
    for *_, text in styles:
        ElementTree.fromstring(text)


def test_styles_have_the_widths_of_the_standards_in_millimetres() -> None:
    content = drawing()
    outline = ElementTree.fromstring(style_of("outlines", content))
    values = [category.get("value") for category in outline.iter("category")]
    assert values == ["iof-104", "pl-2015-conveyor", "pl-2015-slope-unreinforced", "tadpole"]
    symbols = [
        {o.get("name"): o.get("value") for o in s.iter("Option")} for s in outline.iter("symbol")
    ]
    assert [symbol["line_width"] for symbol in symbols] == ["0.18"] * 4
    assert {symbol["line_width_unit"] for symbol in symbols} == {"MM"}
    assert [symbol["use_custom_dash"] for symbol in symbols] == ["0", "0", "1", "0"]
    assert symbols[2]["customdash"] == "2.5;1"
    assert symbols[0]["line_color"] == "209,92,0,255"
    strokes = ElementTree.fromstring(style_of("strokes", content))
    widths = [o.get("value") for o in strokes.iter("Option") if o.get("name") == "line_width"]
    assert widths == ["0.14", "0.18", "0.18", "0.18"]
    assert ElementTree.fromstring(style_of("symbols", content)).findtext("layerGeometryType") == "2"


# DXF


@pytest.fixture(scope="module")
def document(tmp_path_factory: pytest.TempPathFactory) -> Document:
    """Drawing as DXF, opened again."""
    return readfile(written(tmp_path_factory.mktemp("dxf"), "dxf"))


def test_dxf_is_without_errors_and_in_metres(document: Document) -> None:
    auditor = document.audit()
    assert (auditor.errors, auditor.fixes) == ([], [])
    assert document.header["$INSUNITS"] == 6


def test_dxf_has_what_is_drawn_in_map_coordinates(document: Document) -> None:
    lines = document.modelspace().query("LWPOLYLINE[layer=='PL-2015-SLOPE-UNREINFORCED_STROKES']")
    assert len(lines) == 9
    first = [(x, y) for x, y, *_ in lines[0].get_points()]
    assert first == [(EAST, NORTH + 6.0), (EAST, NORTH)]
    tags = [tag.value for tag in lines[3].get_xdata("MIDRIB")]
    assert tags == ["s1", "slope-unreinforced", 3]
    outline: Any
    (outline,) = document.modelspace().query(
        "LWPOLYLINE[layer=='PL-2015-SLOPE-UNREINFORCED_OUTLINE']"
    )
    assert outline.closed
    assert len(outline) == 4


def test_dxf_tells_how_far_it_reaches(document: Document) -> None:
    low, high = (np.array(document.header[name])[:2] for name in ("$EXTMIN", "$EXTMAX"))
    bounds = drawing(POLAND).bounds
    assert (low <= bounds[0] + 1e-9).all()
    assert (high >= bounds[1] - 1e-9).all()
    assert (high - low <= 20.0 * (bounds[1] - bounds[0])).all()  # notes are long


def test_a_plotter_puts_the_drawing_on_the_sheet(document: Document) -> None:
    """The map's lower left corner, at scale, is a margin off that of the sheet."""
    low, _ = drawing(POLAND).bounds
    base = np.array(document.header["$PINSBASE"])[:2]
    assert base + low * document.header["$PSVPSCALE"] == pytest.approx(10.0 / 1000.0, abs=1e-6)


def test_dxf_strokes_have_the_heights_of_the_edges(tmp_path: Path) -> None:
    """From 172 to 173 along the top, 170 to 171 along the toe; a short stroke ends halfway."""
    content = only(drawing(POLAND), "s1")
    (one,) = content.objects
    top, toe = (
        LineString([(EAST + x, NORTH + y, z + x / 40.0) for x in (0.0, 40.0)])
        for y, z in ((6.0, 172.0), (0.0, 170.0))
    )
    content.objects = [replace(one, relief=relief_of(top, toe))]
    document = readfile(written(tmp_path, "dxf", content))
    strokes = document.modelspace().query('LINE[layer=="PL-2015-SLOPE-UNREINFORCED_STROKES"]')
    assert len(strokes) == len(one.symbols.lines)
    assert one.is_long is not None
    for stroke, is_long in zip(strokes, one.is_long, strict=True):
        start, end = np.array(stroke.dxf.start), np.array(stroke.dxf.end)
        assert start[2] == pytest.approx(172.0 + (start[0] - EAST) / 40.0)
        assert start[2] - end[2] == pytest.approx(2.0 if is_long else 1.0)
    assert document.header["$EXTMAX"][2] == pytest.approx(172.5)


def in_space() -> Drawing:
    """Slope, wedges and mound that rise by a tenth to the east and 3 in 10 up the slope."""
    content = drawing(POLAND)
    for k, shape in enumerate((rectangle("iof-104"), rectangle("iof-104"), mound("tadpole"))):
        base = (EAST, NORTH), (EAST, NORTH + 9.0), (EAST + 40.0, NORTH + 8.0)
        edges = [shapely.force_3d(translate(edge, *base[k])) for edge in shape.strip[:2]]
        edges = [shapely.transform(edge, on_plane, include_z=True) for edge in edges]
        content.objects[k] = replace(content.objects[k], relief=relief_of(*edges))
    return content


def on_plane(points: Any) -> Any:
    """Points put on a plane."""
    x, y = points[:, 0] - EAST, points[:, 1] - NORTH
    return np.column_stack([points[:, :2], 170.0 + 0.1 * x + 0.3 * y])


@pytest.mark.parametrize("ending", ["gpkg", "fgb", "geojson", "parquet", "shp"])
def test_layers_have_the_heights_of_the_slopes(ending: str, tmp_path: Path) -> None:
    """Those of the conveyor are unknown: 0, so that all of a layer is of one kind."""
    path = tmp_path / f"map.{ending}"
    content = in_space()
    notes = write_drawing(path, content)
    assert "heights of 1 of 4 objects are unknown: 0" in notes
    for layer in layers_of(content)[:3]:
        apart = path.with_name(f"map_{layer.layer}.{ending}")
        place = path if layer.layer == LINES or ending == "gpkg" else apart
        name = layer.layer if ending == "gpkg" else next(iter(layer_names(place)))
        with open_layer(place, name) as source:
            batches = [*source.batches()]
        rows = [row for batch in batches for row in batch.attributes["area"].to_pylist()]
        read = [geometry for batch in batches for geometry in batch.geometries]
        assert len(rows) == len(layer.geometries)
        for area, geometry in zip(rows, read, strict=True):
            points = shapely.get_coordinates(geometry, include_z=True)
            expected = on_plane(points)[:, 2] if area in {"s1", "s2"} else np.zeros(len(points))
            if area != "m1":  # no plane, but between its edges
                assert points[:, 2] == pytest.approx(expected, abs=1e-6)
            assert area == "c1" or points[:, 2].min() > 160.0


def test_without_heights_layers_are_flat(tmp_path: Path) -> None:
    path = tmp_path / "map.gpkg"
    assert write_drawing(path, drawing(POLAND)) == []
    assert pyogrio.read_info(path, layer=LINES)["geometry_type"] == "LineString"


def test_dxf_fills_and_figures_have_heights(tmp_path: Path) -> None:
    document = readfile(written(tmp_path, "dxf", in_space()))
    assert document.audit().errors == []
    space = document.modelspace()
    hatches = space.query('HATCH[layer=="IOF-104_SYMBOLS"]')
    outlines = space.query('POLYLINE[layer=="IOF-104_SYMBOLS"]')
    assert len(hatches) == len(outlines) == 9
    for hatch, outline in zip(hatches, outlines, strict=True):
        points = np.array([vertex.dxf.location.xyz for vertex in outline.vertices])
        assert points[:, 2] == pytest.approx(on_plane(points)[:, 2], abs=1e-6)
        assert outline.is_closed
        assert outline.dxf.lineweight == 0
        assert points[:, :2] == pytest.approx(np.array(hatch.paths[0].vertices)[:, :2])
        assert hatch.dxf.elevation.z == pytest.approx(points[:, 2].mean())
    heads = space.query("INSERT[name=='MIDRIB_HEAD']")
    assert len(heads) == 40
    assert min(head.dxf.insert.z for head in heads) > 160.0
    circles = space.query("INSERT[name=='MIDRIB_CIRCLE']")
    assert {circle.dxf.insert.z for circle in circles} == {0.0}


def test_unknown_heights_leave_a_drawing_flat() -> None:
    top, toe = LineString([(0, 2, 172.0), (9, 2, 0.0)]), LineString([(0, 0, 170.0), (9, 0, 170.0)])
    assert relief_of(top, toe) is None
    assert relief_of(shapely.force_2d(top), toe) is None


def test_dxf_layers_have_weights_colours_and_dashes(document: Document) -> None:
    bank, slope = (
        document.layers.get(name)
        for name in ("IOF-104_STROKES", "PL-2015-SLOPE-UNREINFORCED_OUTLINE")
    )
    assert (bank.dxf.lineweight, slope.dxf.lineweight) == (15, 18)
    assert bank.rgb == (209, 92, 0)
    assert slope.color == 7
    dash = document.linetypes.get(slope.dxf.linetype)
    assert list(dash.simplified_line_pattern()) == [1.25, 0.5]  # 2.5 and 1 mm at 1:500


def test_dxf_dashes_go_on_round_vertices(document: Document) -> None:
    chains = document.modelspace().query("LWPOLYLINE")
    assert len(chains) > 10
    assert all(chain.dxf.flags & 128 for chain in chains)
    assert {chain.dxf.flags & 1 for chain in chains} == {0, 1}  # open and closed


def test_dxf_figures_are_blocks(document: Document) -> None:
    circles = document.modelspace().query("INSERT[name=='MIDRIB_CIRCLE']")
    sizes = [circle.dxf.xscale for circle in circles]
    assert sizes == pytest.approx([2.0, 1.0] * 7 + [2.0], rel=1e-5)
    (entity,) = document.blocks["MIDRIB_CIRCLE"]
    assert (entity.dxftype(), entity.dxf.radius) == ("CIRCLE", 0.5)
    assert len(document.modelspace().query("INSERT[name=='MIDRIB_HEAD']")) == 40
    hatches = document.modelspace().query("HATCH[layer=='IOF-104_SYMBOLS']")
    assert len(hatches) == 9


def test_dxf_has_a_layout_at_scale(document: Document) -> None:
    viewports = [v for v in document.paperspace().query("VIEWPORT") if v.dxf.id != 1]
    assert [1000.0 * v.dxf.view_height / v.dxf.height for v in viewports] == pytest.approx([500.0])
    assert document.header["$PSVPSCALE"] == pytest.approx(1.0 / 500.0)


def test_dxf_says_where_something_is_missing(document: Document) -> None:
    (note,) = document.modelspace().query("TEXT")
    (mark,) = document.modelspace().query("CIRCLE")
    assert note.dxf.text == "refused 1"
    assert mark.dxf.radius == pytest.approx(0.5)  # 1 mm at 1:500
    assert not document.layers.get(mark.dxf.layer).dxf.plot
    assert (shapely.Point(note.dxf.insert).distance(shapely.Point(mark.dxf.center))) > 0.5
    for entity in (note, mark):
        told = [value for code, value in entity.get_xdata("MIDRIB") if code == 1000]
        assert told == ["s3", "refused", "no way through"]


def test_long_sentences_are_whole_in_dxf(tmp_path: Path) -> None:
    content, reason = drawing(), " ".join(["because"] * 90)
    content.problems = [Trouble("s3", reason, shapely.Point(EAST, NORTH))]
    (mark,) = readfile(written(tmp_path, "dxf", content)).modelspace().query("CIRCLE")
    lines = [value for code, value in mark.get_xdata("MIDRIB") if code == 1000][2:]
    assert len(lines) == 3
    assert " ".join(lines) == reason


@pytest.mark.parametrize("ending", ["dxf", "svg", "pdf", "gpkg"])
def test_marks_of_problems_can_be_left_out_of_drawings(ending: str, tmp_path: Path) -> None:
    path, content = tmp_path / f"map.{ending}", drawing(POLAND)
    write_drawing(path, content, marks=False)
    without = replace(content, problems=[])
    other, written_with = tmp_path / f"other.{ending}", tmp_path / f"with.{ending}"
    write_drawing(written_with, content)
    write_drawing(other, without)
    if ending == "dxf":
        assert "MIDRIB_PROBLEMS" not in readfile(path).layers
    elif ending == "gpkg":
        assert PROBLEMS in layer_names(path)
        assert PROBLEMS not in layer_names(other)
    else:
        assert path.read_bytes() == other.read_bytes()
        assert path.read_bytes() != written_with.read_bytes()


def test_dxf_takes_any_name_of_a_standard(tmp_path: Path) -> None:
    content = drawing()
    own = tmp_path / "my: own|style.toml"
    own.write_text(
        'title = "t"\nsource = "s"\nconfidence = "read"\nbase = "iof-104"\n', encoding="utf-8"
    )
    content.objects = [
        replace(drawn, symbols=replace(drawn.symbols, standard=standard(own)))
        for drawn in content.objects
    ]
    document = readfile(written(tmp_path, "dxf", content))
    assert not document.audit().errors
    assert "MY- OWN-STYLE_STROKES" in document.layers


# Sheets


def svg_size(path: Path) -> list[float]:
    """Width and height of a picture in millimetres."""
    root = ElementTree.parse(path).getroot()
    return [
        float(root.attrib[side].removesuffix("pt")) * 25.4 / 72.0 for side in ("width", "height")
    ]


def segments(path: Path, style: str) -> list[LineString]:
    """Open paths of an SVG with some style, in millimetres."""
    root = ElementTree.parse(path).getroot()
    found = []
    for element in root.iterfind(".//svg:path", SVG):
        if style in element.get("style", ""):
            numbers = np.array(re.findall(r"-?\d+\.?\d*", element.get("d", "")), dtype=np.float64)
            found.append(LineString(numbers.reshape(-1, 2) * 25.4 / 72.0))
    return found


@pytest.mark.parametrize("scale", [200.0, 500.0, 1000.0])
def test_a_sheet_is_true_to_scale(scale: float, tmp_path: Path) -> None:
    content = only(drawing(scale=scale), "s1")
    content.problems = []
    path = written(tmp_path, "svg", content)
    map_size = np.array([20.0, 6.0]) * 1000.0 / scale
    assert svg_size(path) == pytest.approx(np.maximum(map_size + AROUND, [90.0, 50.0]))
    strokes = segments(path, "stroke-width: 0.510236")  # 0.18 mm in points
    lengths = [line.length for line in strokes if len(line.coords) == 2]
    assert sorted(lengths) == pytest.approx(
        sorted([6000.0 / scale, 3000.0 / scale] * 4 + [6000.0 / scale]), abs=1e-3
    )


def test_dashes_and_widths_of_a_sheet_are_millimetres(tmp_path: Path) -> None:
    path = written(tmp_path, "svg", only(drawing(), "s1"))
    text = path.read_text(encoding="utf-8")
    dash, gap = (length * 72.0 / 25.4 for length in (2.5, 1.0))
    assert re.search(rf"stroke-dasharray: {dash:.4f}\d*,{gap:.4f}", text)


def test_the_same_drawing_gives_the_same_bytes(tmp_path: Path) -> None:
    for ending in ("svg", "pdf"):
        first = written(tmp_path, ending).read_bytes()
        assert written(tmp_path, ending).read_bytes() == first


def test_pdf_pages_have_the_size_of_the_paper(tmp_path: Path) -> None:
    path = tmp_path / "map.pdf"
    notes = write_drawing(path, drawing(scale=100.0), paper="A4")
    assert notes == ["3 pages of A4"]
    boxes = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", path.read_bytes())
    sizes = np.array(boxes, dtype=np.float64) * 25.4 / 72.0
    assert len(sizes) == 3
    assert np.sort(sizes) == pytest.approx(np.tile([210.0, 297.0], (3, 1)))


def test_pages_cover_the_map_without_overlap() -> None:
    content = drawing(scale=50.0)
    pages = [shapely.box(*page.low, *page.high) for page in pages_of(content, "A3")]
    assert len(pages) > 4
    covered = shapely.union_all(pages)
    assert covered.area == pytest.approx(sum(page.area for page in pages))
    for drawn in content.objects:
        flat = drawn.symbols.flat()
        assert shapely.covers(covered.buffer(1e-6), [*flat.lines, *flat.areas, *flat.edges]).all()
    names = [page.name for page in pages_of(content, "A3")]
    assert names[0] == "row 1, column 1"
    assert len(set(names)) == len(names)


def test_a_lone_page_clips_nothing_and_pages_of_many_do(tmp_path: Path) -> None:
    text = written(tmp_path, "svg").read_text(encoding="utf-8")
    assert "clip-path" not in text.partition('<g id="axes_2">')[0]
    pages = pages_of(drawing(scale=100.0), "A4")
    assert [page.is_alone for page in pages] == [False] * 3


def test_a_page_with_a_problem_only_is_there() -> None:
    content = only(drawing(scale=20.0), "s1")
    number = len(pages_of(content, "A4"))
    far = shapely.Point(EAST + 90.0, NORTH + 90.0)
    content.problems.append(Trouble("far", "no way through", far))
    pages = pages_of(content, "A4")
    assert len(pages) >= number + 1
    assert any(shapely.box(*page.low, *page.high).covers(far) for page in pages)


def test_a_map_as_large_as_its_paper_takes_one_page() -> None:
    room = np.array([297.0, 210.0]) - AROUND
    content = only(drawing(), "s1")
    content.problems = [
        Trouble("a", "", shapely.Point(0.0, 0.0)),
        Trouble("b", "", shapely.Point(room / 2.0)),
    ]
    content.objects = []
    (page,) = pages_of(content, "A4")
    assert page.is_alone


def test_a_sheet_that_is_too_large_asks_for_pages() -> None:
    with pytest.raises(
        ParameterError, match=r"a sheet at 1:1 takes 50,010 by .* mm, expected pages"
    ):
        pages_of(drawing(scale=1.0), None)
    with pytest.raises(ParameterError, match="paper is 'B5', expected A4, A3"):
        pages_of(drawing(), "B5")


def test_the_map_is_clear_of_the_margins() -> None:
    (page,) = pages_of(drawing(), None)
    assert page.size - (page.high - page.low) / 0.5 == pytest.approx(AROUND)
    assert AROUND[0] == 2.0 * MARGIN
    low, high = drawing().bounds
    assert (page.low <= low + 1e-9).all()
    assert (page.high >= high - 1e-9).all()


# Cartographic objects


def test_gml_has_an_object_for_each_stroke_north_first(tmp_path: Path) -> None:
    path = written(tmp_path, "gml", only(drawing(POLAND), "s1"))
    found = list(ElementTree.parse(path).getroot().iterfind(".//bt:KR_ObiektKarto", GML))
    assert len(found) == 9
    one = found[1]
    order = [element.tag.partition("}")[2] for element in one]
    assert order == ["mianownikSkali", "kodKarto", "geometriaKarto", "obiektPrzedstawiany"]
    assert one.findtext("bt:mianownikSkali", namespaces=GML) == "500"
    assert one.findtext("bt:kodKarto", namespaces=GML) == "BUBZ02"
    assert one.findtext(".//bt:lokalnyId", namespaces=GML) == "c9b9"
    places = one.findtext(".//gml:posList", namespaces=GML)
    assert places is not None
    y, x, *_ = map(float, places.split())
    assert (x, y) == (EAST + 2.5, NORTH + 6.0)


def test_gml_is_read_back_in_the_right_place(tmp_path: Path) -> None:
    path = written(tmp_path, "gml", only(drawing(POLAND), "s1"))
    info = pyogrio.read_info(path)
    assert (info["features"], info["crs"]) == (9, "EPSG:2177")
    assert info["total_bounds"] == pytest.approx((EAST, NORTH, EAST + 20.0, NORTH + 6.0))


def test_gml_refuses_what_the_model_has_no_place_for(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="standard 'iof-104' has no cartographic code"):
        written(tmp_path, "gml", only(drawing(POLAND), "s2"))
    with pytest.raises(ParameterError, match="the CRS of IN has no code"):
        written(tmp_path, "gml", only(drawing(), "s1"))
    content = only(drawing(POLAND), "s1")
    content.objects = [replace(content.objects[0], attributes={})]
    with pytest.raises(ParameterError, match="object 's1' has no lokalnyId to refer to"):
        written(tmp_path, "gml", content)
    assert not list(tmp_path.iterdir())


# Places


def test_places_are_refused_before_any_work(tmp_path: Path) -> None:
    source = tmp_path / "in.gpkg"
    source.touch()
    with pytest.raises(ParameterError, match="is IN, expected another file"):
        check_places(source, [source], overwrite=True)
    with pytest.raises(ParameterError, match="exists, give --overwrite"):
        check_places(source)
    with pytest.raises(ParameterError, match=r"ends in '.docx', expected one of .dxf, .svg"):
        check_places(tmp_path / "map.docx")
    with pytest.raises(ParameterError, match="paper is 'A7', expected A4, A3"):
        check_places(tmp_path / "map.pdf", paper="A7")
    with pytest.raises(ParameterError, match=r"paper is 'A4', .* with OUT .svg or .pdf"):
        check_places(tmp_path / "map.gpkg", paper="A4")
    (tmp_path / "map_outlines.geojson").write_text('{"type": "FeatureCollection", "features": []}')
    with pytest.raises(ParameterError, match="has no column 'area' and so is no output"):
        check_places(tmp_path / "map.geojson", overwrite=True)
    written(tmp_path, "fgb")
    check_places(tmp_path / "map.fgb", overwrite=True)
