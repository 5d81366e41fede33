"""Layers are found, and what is wrong with a file is said in one sentence."""

from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from midrib.errors import ParameterError
from midrib.formats.contents import choose_layer
from midrib.formats.reading import decoded, open_layer
from tests.formats.layers import write

AREA = "POLYGON ((0 0, 9 0, 9 2, 0 2, 0 0))"
LINE = "LINESTRING (0 0, 1 1)"


def test_the_only_layer_with_areas_is_chosen(tmp_path: Path) -> None:
    path = write(tmp_path / "map.gpkg", [LINE], layer="lines")
    write(path, [AREA], layer="areas")
    assert choose_layer(path, None) == "areas"


def test_a_choice_of_layers_is_asked_for(tmp_path: Path) -> None:
    path = write(tmp_path / "map.gpkg", [AREA], layer="one")
    write(path, [AREA], layer="other")
    assert choose_layer(path, "other") == "other"
    with pytest.raises(ParameterError, match="several layers, choose one with --layer: 'one', 'o"):
        choose_layer(path, None)


@pytest.mark.parametrize("ending", ["gpkg", "parquet", "shp"])
def test_files_without_areas_are_refused(ending: str, tmp_path: Path) -> None:
    path = write(tmp_path / f"map.{ending}", [LINE], layer="map")
    with pytest.raises(ParameterError, match="holds LineString, expected areas"):
        choose_layer(path, None)
    with pytest.raises(ParameterError, match="--layer 'map' holds LineString, expected areas"):
        choose_layer(path, "map")


def test_missing_layers_are_named(tmp_path: Path) -> None:
    path = write(tmp_path / "map.gpkg", [AREA], layer="areas")
    with pytest.raises(
        ParameterError, match=r"--layer is 'other', expected a layer of IN .* 'areas'"
    ):
        choose_layer(path, "other")


@pytest.mark.parametrize("name", ["map.gpkg", "map.parquet", "map.shp", "map.geojson", "map"])
def test_missing_and_broken_files_are_named(name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    with pytest.raises(ParameterError, match=r"IN '.*' does not exist"):
        choose_layer(path, None)
    path.write_bytes(b"not a vector file")
    with pytest.raises(ParameterError, match=r"IN '.*' cannot be read"):
        choose_layer(path, None)


def test_parquet_without_geometries_is_refused(tmp_path: Path) -> None:
    pq.write_table(pa.table({"a": [1]}), tmp_path / "table.parquet")
    with pytest.raises(ParameterError, match="Parquet without geometries, expected GeoParquet"):
        choose_layer(tmp_path / "table.parquet", None)


def test_errors_of_those_who_read_are_not_the_files(tmp_path: Path) -> None:
    path = write(tmp_path / "map.gpkg", [AREA], layer="areas")
    with pytest.raises(pa.ArrowInvalid), open_layer(path, "areas"):
        raise pa.ArrowInvalid


def test_unreadable_geometries_do_not_spoil_the_others() -> None:
    good = bytes.fromhex("0101000000" + 32 * "0")
    geometries, unreadable = decoded(pa.array([good, b"\x01\x07", None], type=pa.binary()))
    assert [geometry is None for geometry in geometries] == [False, True, True]
    assert list(unreadable) == [1]
