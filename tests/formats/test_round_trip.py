"""What is written is read again, in every format."""

import json
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import shapely

from midrib.errors import ParameterError
from midrib.formats.contents import layer_names
from midrib.formats.endings import FORMATS, format_of
from midrib.formats.writing import Features, write_layer
from tests.formats.layers import RD_NEW, crs_name, features_of, projjson, read_all, write

LINES: list[str | None] = [f"LINESTRING (140000 46{i}000, 140100 46{i}100)" for i in range(5)]
WGS84 = projjson("EPSG:4326")
# What formats are known to change: they count in other units, name the CRS their own way, or none.
REPROJECTS = {"kml", "geojsonl"}
ROUNDS = {"tab", "gdb"}
WITHOUT_CRS = {"mif", "dxf", "csv"}
ADDS_COLUMNS = {"kml", "gml", "jml", "dxf"}


@pytest.mark.parametrize("ending", FORMATS)
def test_geometries_come_back_in_order(ending: str, tmp_path: Path) -> None:
    source, attributes, geometries = read_all(write(tmp_path / f"lines.{ending}", LINES))
    assert len(geometries) == len(LINES)
    if ending not in REPROJECTS:
        near = 0.02 if ending in ROUNDS else 0.0
        distance = shapely.hausdorff_distance(geometries, shapely.from_wkt(LINES))
        assert distance.max() <= near
    if ending not in {*WITHOUT_CRS, *REPROJECTS, "tab"}:
        assert crs_name(source.crs) == "Amersfoort / RD New"
    if ending not in {"dxf", "kml"}:
        assert [int(number) for number in attributes["number"].to_pylist()] == [0, 1, 2, 3, 4]
        assert attributes["name"].to_pylist()[2:] == ["é 2", "é 3", "é 4"]
    if ending not in {*ADDS_COLUMNS, "sqlite"}:
        assert attributes.column_names == ["number", "name", "share"]


def digits(low: tuple[float, float], size: float) -> list[str | None]:
    """Lines whose coordinates need every digit."""
    random = np.random.default_rng(3)
    return [
        shapely.to_wkt(
            shapely.LineString(low + size * random.random((9, 2))), rounding_precision=18
        )
        for _ in range(20)
    ]


@pytest.mark.parametrize("ending", FORMATS)
@pytest.mark.parametrize(
    ("low", "size", "crs"), [((140e3, 460e3), 100.0, RD_NEW), ((5.0, -0.01), 0.01, WGS84)]
)
def test_coordinates_come_back_bit_by_bit_or_a_note_says_so(
    ending: str, low: tuple[float, float], size: float, crs: str, tmp_path: Path
) -> None:
    path, features = tmp_path / f"lines.{ending}", features_of(digits(low, size), crs)
    said = " ".join(write_layer(path, features))
    found, given = (
        shapely.get_coordinates(lines) for lines in (read_all(path)[2], features.geometries)
    )
    if ending in REPROJECTS and crs == RD_NEW:
        assert "turns coordinates into longitude and latitude" in said
    else:
        assert ("rounds coordinates" not in said) == np.array_equal(found, given)
        assert "turns" not in said


def named(**columns: list[object]) -> Features:
    """Two lines with attributes of the given names."""
    return features_of(LINES[:2])._replace(attributes=pa.table(columns))


@pytest.mark.parametrize("ending", [e for e in FORMATS if e != "dxf"])
def test_names_that_differ_by_case_are_told_apart(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"lines.{ending}"
    features = named(
        status=["a", "b"], STATUS=["c", "d"], Status_2=["e", "f"], Geom=["g", "h"], fid=["i", None]
    )
    notes = write_layer(path, features)
    columns = {name.lower(): values for name, values in read_all(path)[1].to_pydict().items()}
    if "parquet" in ending:
        assert notes == []
        return
    assert "the field 'STATUS' is written as 'STATUS_3'" in notes
    assert "the field 'Geom' is written as 'Geom_2'" in notes
    numbered: dict[str, list[str | None]] = {
        "status": ["a", "b"],
        "status_3": ["c", "d"],
        "status_2": ["e", "f"],
    }
    numbered |= {"geom_2": ["g", "h"], "fid_2" if ending == "gpkg" else "fid": ["i", None]}
    for name, values in numbered.items():
        assert [value or None for value in columns[name]] == values


def test_numbers_of_features_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "lines.gpkg"
    assert write_layer(path, named(fid=[7, 9], name=["a", "b"])) == []
    assert read_all(path)[1].to_pydict() == {"name": ["a", "b"]}
    assert write_layer(tmp_path / "twice.gpkg", named(fid=[7, 7])) == [
        "the field 'fid' is written as 'fid_2'"
    ]


@pytest.mark.parametrize("ending", [e for e in FORMATS if e != "dxf"])
def test_missing_geometries_stay_features(ending: str, tmp_path: Path) -> None:
    wkts = [LINES[0], None, *LINES[2:]]
    _, attributes, geometries = read_all(write(tmp_path / f"lines.{ending}", wkts))
    assert shapely.is_missing(geometries).tolist() == [False, True, False, False, False]
    assert len(attributes) == 5


@pytest.mark.parametrize("ending", [e for e in FORMATS if e not in {"geojsonl", "tab"}])
def test_no_features_are_a_layer_too(ending: str, tmp_path: Path) -> None:
    _, attributes, geometries = read_all(write(tmp_path / f"lines.{ending}", []))
    assert len(attributes) == len(geometries) == 0


def test_drawings_say_what_they_lose(tmp_path: Path) -> None:
    notes = write_layer(tmp_path / "lines.dxf", features_of([LINES[0], None]))
    assert notes == [
        "DXF rounds coordinates, so that lines may leave their areas",
        "DXF has no place for attributes",
        "DXF has no place for a CRS",
    ]
    assert len(read_all(tmp_path / "lines.dxf")[2]) == 1


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "fgb"])
def test_heights_are_kept(ending: str, tmp_path: Path) -> None:
    _, _, geometries = read_all(write(tmp_path / f"z.{ending}", ["LINESTRING Z (0 0 1, 1 1 2)"]))
    assert shapely.get_coordinates(geometries, include_z=True)[:, 2].tolist() == [1.0, 2.0]


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "fgb", "geojson", "shp"])
def test_single_and_multiple_lines_share_a_layer(ending: str, tmp_path: Path) -> None:
    wkts: list[str | None] = [LINES[0], "MULTILINESTRING ((0 0, 1 1), (2 2, 3 3))", None]
    _, _, geometries = read_all(write(tmp_path / f"mixed.{ending}", wkts))
    assert shapely.length(geometries[:2]) == pytest.approx(
        shapely.length(shapely.from_wkt(wkts[:2]))
    )


@pytest.mark.parametrize("ending", ["gpkg", "shp", "geojson"])
def test_single_and_multiple_points_share_a_layer(ending: str, tmp_path: Path) -> None:
    wkts: list[str | None] = ["POINT (0 0)", "MULTIPOINT ((1 1), (2 2))"]
    geometries = read_all(write(tmp_path / f"mixed.{ending}", wkts))[2]
    assert shapely.get_num_coordinates(geometries).tolist() == [1, 2]


@pytest.mark.parametrize("ending", ["shp", "gdb"])
def test_heights_of_some_are_heights_of_all_where_a_format_asks_for_it(
    ending: str, tmp_path: Path
) -> None:
    wkts: list[str | None] = ["LINESTRING (0 0, 1 1)", None, "LINESTRING Z (0 0 5, 1 1 5)"]
    path = tmp_path / f"z.{ending}"
    note = write_layer(path, features_of(wkts))[0]
    assert note.endswith("has a Z for all or for none, it is 0 where there was none")
    z = shapely.get_coordinates(read_all(path)[2], include_z=True)[:, 2]
    assert z.tolist() == [0.0, 0.0, 5.0, 5.0]


def test_layers_of_one_file_stand_side_by_side(tmp_path: Path) -> None:
    path = tmp_path / "two.gpkg"
    write(path, LINES, layer="one")
    write(path, LINES[:2], layer="other")
    assert layer_names(path) == {"one": "LineString", "other": "LineString"}
    assert len(read_all(path, "other")[2]) == 2


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "fgb", "shp"])
def test_a_layer_without_crs_has_none_afterwards(ending: str, tmp_path: Path) -> None:
    assert read_all(write(tmp_path / f"lines.{ending}", LINES, crs=None))[0].crs is None


def test_geoparquet_follows_its_specification(tmp_path: Path) -> None:
    path = write(tmp_path / "lines.parquet", [LINES[0], None, "LINESTRING EMPTY"])
    geo = json.loads(pq.read_schema(path).metadata[b"geo"])
    column = geo["columns"][geo["primary_column"]]
    assert geo["version"] == "1.1.0"
    assert column["encoding"] == "WKB"
    assert column["geometry_types"] == ["LineString"]
    assert column["bbox"] == [140000.0, 460000.0, 140100.0, 460100.0]
    assert column["crs"] == json.loads(RD_NEW)


def test_geoparquet_without_crs_means_longitude_and_latitude(tmp_path: Path) -> None:
    path = write(tmp_path / "lines.parquet", LINES)
    table = pq.read_table(path)
    geo = json.loads(table.schema.metadata[b"geo"])
    del geo["columns"]["geom"]["crs"]
    pq.write_table(table.replace_schema_metadata({"geo": json.dumps(geo)}), path)
    assert crs_name(read_all(path)[0].crs) == "WGS 84 (CRS84)"


def test_geoparquet_leaves_out_boxes_of_the_areas(tmp_path: Path) -> None:
    path = write(tmp_path / "lines.parquet", LINES)
    table = pq.read_table(path)
    boxes = pa.array([{"xmin": 0.0, "ymin": 0.0, "xmax": 1.0, "ymax": 1.0}] * 5)
    geo = json.loads(table.schema.metadata[b"geo"])
    corners = {corner: ["bbox", corner] for corner in ("xmin", "ymin", "xmax", "ymax")}
    geo["columns"]["geom"]["covering"] = {"bbox": corners}
    table = table.append_column("bbox", boxes)
    pq.write_table(table.replace_schema_metadata({"geo": json.dumps(geo)}), path)
    assert read_all(path)[1].column_names == ["number", "name", "share"]


def test_geopandas_reads_our_geoparquet_and_we_its(tmp_path: Path) -> None:
    geopandas = pytest.importorskip("geopandas")
    ours, theirs = write(tmp_path / "ours.parquet", LINES), tmp_path / "theirs.parquet"
    frame = geopandas.read_parquet(ours)
    assert frame.crs.to_epsg() == 28992
    frame.to_parquet(theirs, write_covering_bbox=True)
    source, attributes, geometries = read_all(theirs)
    assert attributes.column_names == ["number", "name", "share"]
    assert crs_name(source.crs) == "Amersfoort / RD New"
    assert np.array_equal(geometries, shapely.from_wkt(LINES))


@pytest.mark.parametrize("name", ["lines", "lines.", "lines.png", "lines.gpkg.bak", "lines.xlsx"])
def test_unknown_endings_are_refused(name: str) -> None:
    with pytest.raises(ParameterError, match=r"OUT '.*' (ends in|has no ending).*expected one of"):
        format_of(Path(name))
