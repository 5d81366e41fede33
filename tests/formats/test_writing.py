"""Files are whole or not there."""

import datetime
from pathlib import Path

import pyarrow as pa
import pytest

from midrib.errors import ParameterError
from midrib.formats.writing import check_free, staged, write_layer
from tests.formats.layers import features_of, read_all, write

LINES: list[str | None] = ["LINESTRING (0 0, 1 1)", "LINESTRING (2 0, 3 1)"]


def break_off(folder: Path, name: str, error: type[BaseException]) -> None:
    """Write a file and stop before all is done."""
    with staged(folder, stale=[folder / name]) as stage:
        write(stage / name, LINES[:1])
        raise error


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
@pytest.mark.parametrize("ending", ["gpkg", "shp", "parquet", "gdb"])
def test_interrupted_writes_leave_nothing(
    ending: str, error: type[BaseException], tmp_path: Path
) -> None:
    with pytest.raises(error):
        break_off(tmp_path, f"lines.{ending}", error)
    assert list(tmp_path.iterdir()) == []


def test_interrupted_writes_leave_the_old_file(tmp_path: Path) -> None:
    path = write(tmp_path / "lines.gpkg", LINES)
    before = path.read_bytes()
    with pytest.raises(ValueError):  # noqa: PT011  # our own
        break_off(tmp_path, "lines.gpkg", ValueError)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_only_geodatabases_are_moved_out_of_the_way(tmp_path: Path) -> None:
    (tmp_path / "lines.gpkg").mkdir()
    (tmp_path / "lines.gpkg" / "file").write_text("of the user's own")
    with pytest.raises(OSError), staged(tmp_path) as stage:  # noqa: PT011  # it depends
        write(stage / "lines.gpkg", LINES)
    assert (tmp_path / "lines.gpkg" / "file").read_text() == "of the user's own"


@pytest.mark.parametrize("ending", ["gpkg", "shp", "parquet", "gdb", "gml"])
def test_replaced_files_are_whole(ending: str, tmp_path: Path) -> None:
    path = write(tmp_path / f"lines.{ending}", LINES)
    with staged(tmp_path) as stage:
        write(stage / path.name, LINES[:1])
    assert len(read_all(path)[2]) == 1
    assert not [file for file in tmp_path.iterdir() if file.name.startswith(".")]


def test_side_files_of_a_replaced_shapefile_go(tmp_path: Path) -> None:
    path = write(tmp_path / "lines.shp", LINES)
    (tmp_path / "lines.qix").write_bytes(b"an index of other features")
    with staged(tmp_path) as stage:
        write(stage / "lines.shp", LINES[:1])
    assert not (tmp_path / "lines.qix").exists()
    assert path.exists()


def test_stale_files_go_unless_they_are_replaced(tmp_path: Path) -> None:
    stale, other = (write(tmp_path / f"{name}.shp", LINES) for name in ("stale", "other"))
    with staged(tmp_path, stale=[stale, tmp_path / "never_there.shp"]) as stage:
        write(stage / "new.gpkg", LINES)
    assert not list(tmp_path.glob("stale.*"))
    assert other.exists()
    assert (tmp_path / "new.gpkg").exists()


def test_existing_files_are_kept_unless_told_otherwise(tmp_path: Path) -> None:
    path = write(tmp_path / "lines.gpkg", LINES)
    with pytest.raises(ParameterError, match=r"OUT '.*' exists, give --overwrite"):
        check_free([path], "OUT", overwrite=False)
    check_free([path], "OUT", overwrite=True)
    check_free([write(tmp_path / "lines.gdb", LINES)], "OUT", overwrite=True)


def test_missing_folders_are_named(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="lies in a folder that does not exist"):
        check_free([tmp_path / "nowhere" / "lines.gpkg"], "OUT", overwrite=False)


def test_folders_that_take_no_files_are_named(tmp_path: Path) -> None:
    folder = tmp_path / "absent"
    with pytest.raises(ParameterError, match=r"absent.*No such file"), staged(folder):
        pass


@pytest.mark.parametrize("unit", ["s", "ms", "us", "ns"])
@pytest.mark.parametrize("ending", ["gpkg", "geojson", "fgb"])
def test_columns_that_no_driver_takes_become_numbers_and_texts(
    ending: str, unit: str, tmp_path: Path
) -> None:
    features = features_of(LINES)
    ages = pa.array([datetime.timedelta(hours=1, seconds=2), None], pa.duration(unit))
    table = features.attributes.append_column("age", ages).append_column("empty", pa.nulls(2))
    path = tmp_path / f"lines.{ending}"
    notes = write_layer(path, features._replace(attributes=table))
    assert "the field 'age' is written in seconds" in notes
    _, found, _ = read_all(path)
    assert found["age"].to_pylist() == [3602.0, None]
    assert found["empty"].to_pylist() == [None, None]
    # GeoParquet keeps what they are.
    path = tmp_path / "lines.parquet"
    assert write_layer(path, features._replace(attributes=table)) == []
    assert pa.types.is_duration(read_all(path)[1]["age"].type)
