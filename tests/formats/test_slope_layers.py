"""Slopes of any layer: whatever tells the tops, the slopes are the same."""

from collections.abc import Sequence
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pyarrow as pa
import pytest
import shapely
from shapely import LineString, MultiPolygon, Point, Polygon

from midrib.errors import ParameterError
from midrib.formats.slopes import read_slopes
from midrib.formats.writing import Features, write_layer
from tests.formats.layers import RD_NEW

LOW = Polygon([(0, 0), (9, 0), (9, 2), (0, 2)])
HIGH = Polygon([(0, 5), (9, 5), (9, 7), (0, 7)])
TOPS = {"low": LineString([(9, 0), (9, 2), (0, 2)]), "high": LineString([(0, 7), (0, 5)])}
AREAS = {"low": LOW, "high": HIGH}


def save(path: Path, layer: str, geometries: Sequence[object], **columns: Sequence[object]) -> Path:
    """Write a layer and return the path."""
    rows = np.empty(len(geometries), dtype=object)
    rows[:] = geometries
    kind = getattr(next((g for g in geometries if g is not None), None), "geom_type", "Polygon")
    write_layer(path, Features(layer, pa.table(columns), rows, "geom", kind, RD_NEW))
    return path


def corners(which: int) -> dict[str, tuple[float, ...]]:
    """Start (0) or end (-1) of each top."""
    return {name: top.coords[which] for name, top in TOPS.items()}


def by_fields(path: Path) -> dict[str, str]:
    start, end = corners(0), corners(-1)
    columns: dict[str, Sequence[object]] = {"id": [*AREAS]}
    for name, points in (("gora_start", start), ("gora_koniec", end)):
        for axis, letter in enumerate("xy"):
            columns[f"{name}_{letter}"] = [point[axis] for point in points.values()]
    save(path, "some areas", [*AREAS.values()], **columns)
    return {}


def by_named_fields(path: Path) -> dict[str, str]:
    columns: dict[str, Sequence[object]] = {"id": [*AREAS]}
    for letter, points in (("a", corners(0)), ("b", corners(-1))):
        columns[f"{letter}x"] = [point[0] for point in points.values()]
        columns[f"{letter}y"] = [point[1] for point in points.values()]
    save(path, "areas", [*AREAS.values()], **columns)
    return {"start": "ax, ay", "end": "bx,by"}


def by_layers_of_points(path: Path) -> dict[str, str]:
    save(path, "areas", [*AREAS.values()], id=[*AREAS])
    for layer, points in (("starts", corners(0)), ("ends", corners(-1))):
        save(path, layer, [Point(p) for p in points.values()][::-1], id=[*points][::-1])
    return {"start": "starts:id", "end": "ends:id"}


def by_a_layer_of_lines(path: Path) -> dict[str, str]:
    save(path, "areas", [*AREAS.values()], id=[*AREAS])
    save(path, "crest", [*TOPS.values()], name=[*TOPS])
    return {"top": "crest"}


def by_a_common_field(path: Path) -> dict[str, str]:
    save(path, "talud", [*AREAS.values()], gml_id=[*AREAS])
    save(path, "other areas", [LOW], gml_id=["?"])
    save(path, "kruinlijn", [*TOPS.values()][::-1], gml_id=[*TOPS][::-1])
    return {}


def by_a_field_of_text(path: Path) -> dict[str, str]:
    save(path, "areas", [*AREAS.values()], id=[*AREAS], edge=[top.wkt for top in TOPS.values()])
    return {"top": "edge"}


WAYS = [
    by_fields,
    by_named_fields,
    by_layers_of_points,
    by_a_layer_of_lines,
    by_a_common_field,
    by_a_field_of_text,
]


@pytest.mark.parametrize("way", WAYS)
def test_whatever_tells_the_tops_slopes_are_the_same(way: object, tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    slopes, problems = read_slopes(path, **way(path))  # type: ignore[operator]
    assert not problems
    assert [slope.id for slope in slopes] == [*AREAS]
    for slope in slopes:
        assert shapely.equals(slope.area, AREAS[slope.id])
        assert slope.top == TOPS[slope.id]
        assert slope.toe.length == pytest.approx(slope.area.length - slope.top.length)
        assert slope.crs == RD_NEW


@pytest.mark.parametrize("ending", ["shp", "zip", "gdb"])
def test_formats_that_turn_rings_cast_doubt_on_starts_and_ends(ending: str, tmp_path: Path) -> None:
    """The area is stored counter-clockwise, its top the right-hand side and the upper one."""
    path = tmp_path / f"slopes.{'gdb' if ending == 'gdb' else 'shp'}"
    columns = {"x1": [9.0], "y1": [0.0], "x2": [0.0], "y2": [2.0], "crest": [TOPS["low"].wkt]}
    save(path, "slopes", [LOW], **columns)
    if ending == "zip":
        path = tmp_path / "slopes.zip"
        with ZipFile(path, "w") as packed:
            for side in tmp_path.glob("slopes.[!z]*"):
                packed.write(side, side.name)
    (slope,), (problem,) = read_slopes(path, start="x1,y1", end="x2,y2")
    assert not slope.top.equals(TOPS["low"])
    assert (problem.kind, problem.id) == ("orientation", slope.id)
    assert "turns every ring clockwise" in problem.reason
    (slope,), problems = read_slopes(path, top="crest")
    assert slope.top.equals(TOPS["low"])
    assert not problems


def test_kinds_and_fields_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    columns = {"rodzajBudZiemn": ["wykop", None], "edge": [top.wkt for top in TOPS.values()]}
    save(path, "areas", [*AREAS.values()], **columns)
    low, high = read_slopes(path, top="edge")[0]
    assert (low.id, low.kind) == ("0", "cutting")
    assert (high.id, high.kind) == ("1", "other")
    assert low.attributes["rodzajBudZiemn"] == "wykop"
    assert low.source == "layer areas"


def test_parts_have_a_top_each(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    save(path, "areas", [MultiPolygon([LOW, HIGH])], id=["both"])
    save(path, "starts", [Point(p) for p in corners(0).values()], id=["both", "both"])
    save(path, "ends", [Point(p) for p in corners(-1).values()], id=["both", "both"])
    slopes, problems = read_slopes(path, start="starts:id", end="ends:id")
    assert not problems
    assert [slope.id for slope in slopes] == ["both/1", "both/2"]
    assert [slope.top for slope in slopes] == [*TOPS.values()]


@pytest.mark.parametrize("hint", ["crest", "crest:id", "edge"])
def test_parts_have_a_crest_each(hint: str, tmp_path: Path) -> None:
    path, pieces = tmp_path / "a.gpkg", [*TOPS.values()]
    both = shapely.multilinestrings(pieces)
    save(path, "areas", [MultiPolygon([LOW, HIGH])], id=["both"], edge=[both.wkt])
    save(path, "crest", pieces[::-1], id=["both", "both"])
    slopes, problems = read_slopes(path, layer="areas", top=hint)
    assert not problems
    assert [slope.id for slope in slopes] == ["both/1", "both/2"]
    assert [slope.top for slope in slopes] == pieces  # the longest first
    assert [slope.area for slope in slopes] == [LOW, HIGH]


def test_a_second_crest_on_one_part_is_told(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    save(path, "areas", [LOW], id=["low"])
    save(
        path, "crest", [LineString([(0, 0), (9, 0)]), LineString([(9, 2), (0, 2)])], id=["low"] * 2
    )
    slopes, problems = read_slopes(path, layer="areas", top="crest:id")
    assert [slope.id for slope in slopes] == ["low/1"]
    assert [problem.id for problem in problems] == ["low/2"]
    assert "two tops are on the same part" in problems[0].reason


def test_areas_without_a_top_or_a_geometry_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    edges = [TOPS["low"].wkt, None, "nonsense", TOPS["low"].wkt]
    save(path, "areas", [LOW, HIGH, HIGH, None], id=["a", "b", "c", "d"], edge=edges)
    slopes, problems = read_slopes(path, top="edge")
    assert [slope.id for slope in slopes] == ["a"]
    assert [(problem.id, problem.kind) for problem in problems] == [(k, "refused") for k in "bcd"]
    reasons = [problem.reason for problem in problems]
    assert reasons[0] == "it has no top"
    assert "expected a line in WKT" in reasons[1]
    assert reasons[2] == "its geometry is nothing, expected a Polygon"


def test_two_layers_of_lines_are_tops_and_toes(tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    save(path, "tops", [LineString([(0, 2), (9, 2)]), LineString([(0, 7), (9, 7)])], id=[1, 2])
    save(path, "toes", [LineString([(9, 5), (0, 5)]), LineString([(0, 0), (9, 0)])], id=[1, 2])
    slopes, problems = read_slopes(path, top="tops", toe="toes")
    assert {problem.kind for problem in problems} == {"pairs"}  # either gap could be a slope
    assert [shapely.normalize(slope.area) for slope in slopes] == [
        shapely.normalize(area) for area in (LOW, HIGH)
    ]
    assert slopes[1].toe == LineString([(0, 5), (9, 5)])


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({}, "layer 'areas' has the fields 'ax', 'ay', expected top, or start and end"),
        ({"start": "ax,ay"}, "start is 'ax,ay' and end is None, expected both or neither"),
        ({"top": "edge", "start": "ax,ay", "end": "b"}, "top excludes start and end"),
        ({"start": "ax,ay", "end": "b"}, "end is 'b', expected two fields X,Y of layer 'areas'"),
        ({"start": "ax,ay", "end": "points:no"}, "end is 'points:no', expected two fields"),
        ({"start": "ax,ay", "end": "areas:ax"}, None),
        ({"start": "ax,ay", "end": "points:ax"}, "layer 'points' has no field 'ax', expected one"),
        ({"top": "nothing"}, "top is 'nothing', expected a layer of IN"),
        ({"top": "points", "toe": "nothing"}, "toe is 'nothing', expected a layer of IN"),
        ({"layer": "nothing", "top": "points"}, "--layer is 'nothing', expected a layer of IN"),
    ],
)
def test_wrong_hints_are_named(options: dict[str, str], reason: str | None, tmp_path: Path) -> None:
    path = tmp_path / "a.gpkg"
    save(path, "areas", [LOW], ax=[9.0], ay=[0.0])
    save(path, "points", [Point(0, 2)], id=["a"])
    if reason is None:
        slopes, problems = read_slopes(path, **options)  # type: ignore[arg-type]
        assert not slopes
        assert problems[0].reason.startswith("its top has 1 starts and 5 ends")
        return
    with pytest.raises(ParameterError, match=reason):
        read_slopes(path, **options)  # type: ignore[arg-type]


def test_a_top_at_no_place_is_refused_and_the_rest_is_read(tmp_path: Path) -> None:
    path = tmp_path / "slopes.csv"
    area = "POLYGON ((0 0, 9 0, 9 2, 0 2, 0 0))"
    tops = "LINESTRING (0 2, nan 2)", "LINESTRING (0 2, 9 2)"
    rows = "\n".join(f'"{area}","{top}"' for top in tops)
    path.write_text(f"WKT,crest\n{rows}")
    slopes, problems = read_slopes(path, top="crest")
    assert len(slopes) == 1
    expected = "the field 'crest' is 'LINESTRING (0 2, nan 2)', expected a line in WKT"
    assert problems[0].reason == expected
