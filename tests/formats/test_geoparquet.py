"""GeoParquet of others: what is odd but right is read, what is broken is refused in a sentence."""

import json
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import shapely

from midrib.errors import ParameterError
from midrib.formats.contents import choose_layer
from midrib.formats.geoparquet import CRS84
from tests.formats.layers import RD_NEW, read_all

AREA = shapely.box(0.0, 0.0, 90.0, 9.0)
WKB = pa.array([AREA.wkb, None], type=pa.binary())
VIEWS = {
    "text": pa.array(["é", None], type=pa.string_view()),
    "bytes": pa.array([b"a", None], type=pa.binary_view()),
    "list": pa.array([["a"], None], type=pa.list_(pa.string_view())),
    "structure": pa.array([{"a": "b"}, None], type=pa.struct({"a": pa.string_view()})),
}


def write_parquet(path: Path, geo: object, **columns: pa.Array) -> Path:
    """Write a file with metadata of one's own."""
    text = geo if isinstance(geo, str) else json.dumps(geo)
    table = pa.table({"number": pa.array([7, 8]), **columns, "geom": WKB})
    pq.write_table(table.replace_schema_metadata({"geo": text}), path)
    return path


def described(**column: object) -> dict[str, Any]:
    """Metadata of a column of geometries."""
    about = {"encoding": "WKB", "geometry_types": ["Polygon"], **column}
    return {"version": "1.1.0", "primary_column": "geom", "columns": {"geom": about}}


BROKEN: dict[str, object] = {
    "it is no JSON": "{broken",
    "'primary_column' is missing, expected a text": [],
    "'columns' is missing, expected an object": {"primary_column": "geom"},
    "'geom' is missing, expected an object": {"primary_column": "geom", "columns": {"a": {}}},
    "'encoding' is missing, expected a text": described(encoding=None),
    "'encoding' is 7, expected a text": described(encoding=7),
    "'primary_column' is 'shape', which is no column of the file": {
        "primary_column": "shape",
        "columns": {"shape": {"encoding": "WKB"}},
    },
    "'crs' is 'EPSG:2180', expected PROJJSON": described(crs="EPSG:2180"),
    "'crs' is {'foo': 1}, expected PROJJSON": described(crs={"foo": 1}),
    "'crs' is [1], expected PROJJSON": described(crs=[1]),
}


@pytest.mark.parametrize("what", BROKEN)
def test_broken_metadata_are_refused_in_a_sentence(what: str, tmp_path: Path) -> None:
    path = write_parquet(tmp_path / "in.parquet", BROKEN[what])
    with pytest.raises(ParameterError) as error:
        choose_layer(path, None)
    assert str(error.value) == f"IN {str(path)!r} has broken GeoParquet metadata (geo): {what}"


@pytest.mark.parametrize(
    ("column", "crs"),
    [
        ({}, CRS84),
        ({"crs": None}, None),
        ({"crs": json.loads(RD_NEW)}, json.loads(RD_NEW)),
        ({"crs": RD_NEW}, json.loads(RD_NEW)),  # text in the text
        ({"covering": None, "geometry_types": None}, CRS84),
        ({"covering": {"bbox": {}}}, CRS84),
    ],
)
def test_metadata_that_are_odd_are_read(
    column: dict[str, Any], crs: object, tmp_path: Path
) -> None:
    source, _, geometries = read_all(write_parquet(tmp_path / "in.parquet", described(**column)))
    assert json.loads(source.crs or "null") == crs
    assert geometries.tolist() == [AREA, None]


@pytest.mark.parametrize("name", VIEWS)
def test_columns_of_views_are_columns_of_values(name: str, tmp_path: Path) -> None:
    path = write_parquet(tmp_path / "in.parquet", described(), **{name: VIEWS[name]})
    source, found, _ = read_all(path)
    assert source.attributes.equals(found.schema)
    assert "view" not in str(found.schema)
    turned = found.take([1, 0])  # what Arrow cannot do with views
    assert turned[name].to_pylist() == VIEWS[name].to_pylist()[::-1]
    assert turned["number"].to_pylist() == [8, 7]
