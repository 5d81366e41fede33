"""Partitions: every feature in one of them, none too large; batches that fit in memory."""

from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from midrib.engines import partitions
from midrib.engines.partitions import (
    Partition,
    batch_rows,
    batches_of,
    check_alike,
    files_of,
    partitions_of,
    small_groups,
)
from midrib.errors import ParameterError
from midrib.formats.contents import choose_layer
from midrib.formats.reading import parquet_batches
from tests.engines.layers import batch_of, write_areas


@given(
    groups=st.lists(st.tuples(st.integers(0, 300), st.integers(0, 10**9)), max_size=8),
    rows=st.integers(1, 200),
)
def test_large_groups_are_divided_evenly(groups: list[tuple[int, int]], rows: int) -> None:
    pieces = list(small_groups(groups, rows))
    assert sum(n for n, _ in pieces) == sum(n for n, _ in groups)
    assert all(n <= rows for n, _ in pieces)
    assert all(size <= partitions.PART_BYTES for _, size in pieces)


@pytest.mark.parametrize("ending", ["parquet", "gpkg", "geojson"])
@pytest.mark.parametrize("rows", [1, 7, 20, 109, 110, None])
def test_partitions_have_every_row_once(ending: str, rows: int | None, tmp_path: Path) -> None:
    path = write_areas(tmp_path / f"in.{ending}")
    if ending == "parquet":  # row groups that partitions do not end with
        table = pq.read_table(path)
        pq.write_table(table, path, row_group_size=13)
    found = partitions_of([path], choose_layer(path, None), rows)
    assert [part.number for part in found] == list(range(len(found)))
    batches = [pair for part in found for pair in batches_of(part)]
    table = pa.Table.from_batches([batch for _, batch in batches])
    assert table.equals(pa.Table.from_batches([batch_of(path)]))
    first = 0
    for start, batch in batches:
        assert start == first
        assert rows is None or batch.num_rows <= rows
        first += batch.num_rows


def test_row_groups_that_have_been_read_do_not_stay_in_memory(tmp_path: Path) -> None:
    n = 40_000
    random = np.random.default_rng(1)
    wkb = pa.array([random.bytes(256) for _ in range(n)], type=pa.binary())
    pq.write_table(pa.table({"geom": wkb}), tmp_path / "in", row_group_size=1_000)
    del wkb
    before = peak = pa.total_allocated_bytes()
    with pq.ParquetFile(tmp_path / "in") as file:
        for _ in parquet_batches(file, 100, ["geom"]):
            peak = max(peak, pa.total_allocated_bytes())
    assert peak - before < 0.2 * n * 256


def test_a_file_of_nothing_has_a_partition_of_nothing(tmp_path: Path) -> None:
    path = write_areas(tmp_path / "in.parquet", count=0)
    (part,) = partitions_of([path], "in", 20)
    assert (part.first, part.rows) == (0, 0)
    assert sum(batch.num_rows for _, batch in batches_of(part)) == 0


def test_batches_of_large_features_have_fewer_of_them() -> None:
    coasts = Partition(0, Path("in.parquet"), "in", 0, 100, 100 * 14_000_000)
    ponds = Partition(0, Path("in.parquet"), "in", 0, 100, 100 * 1_600)
    assert batch_rows(coasts) == 1
    assert batch_rows(ponds) == partitions.BATCH_ROWS


def test_folders_give_their_parquet_files_in_order(tmp_path: Path) -> None:
    for name in ("b.parquet", "a.parquet", "_x.parquet", ".y.parquet", "notes.txt"):
        (tmp_path / name).write_bytes(b"")
    assert [path.name for path in files_of(tmp_path)] == ["a.parquet", "b.parquet"]
    assert files_of(tmp_path / "a.parquet") == [tmp_path / "a.parquet"]


def test_files_in_subfolders_are_not_left_out_in_silence(tmp_path: Path) -> None:
    for name in ("_refused", "land=PL/year=2024", "more"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "_refused" / "a.parquet").touch()
    (tmp_path / "a.parquet").touch()
    assert files_of(tmp_path) == [tmp_path / "a.parquet"]
    (tmp_path / "more" / "b.parquet").touch()
    with pytest.raises(ParameterError, match=r"has .parquet files in the subfolder 'more', expect"):
        files_of(tmp_path)
    (tmp_path / "land=PL" / "year=2024" / "c.parquet").touch()
    with pytest.raises(ParameterError, match=r"in the subfolder 'land=PL/year=2024', expected"):
        files_of(tmp_path)


def test_folders_of_nothing_or_of_files_unlike_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=r"is a folder without .parquet files"):
        files_of(tmp_path)
    one = write_areas(tmp_path / "a.parquet", 5)
    table = pq.read_table(one)
    pq.write_table(table.drop_columns("name"), tmp_path / "b.parquet")
    with pytest.raises(ParameterError, match=r"b.parquet' has other columns .* than 'a.parquet'"):
        check_alike(files_of(tmp_path))
