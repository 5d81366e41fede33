"""What a job is divided into: runs of features of one file, that any machine can read by itself.

Of GeoParquet they are row groups, or parts of them where these are large; files of other formats
are divided by the number of features.
"""

import math
from collections.abc import Generator, Iterable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import pyarrow as pa
import pyarrow.parquet as pq

from midrib.engines.fingerprints import files_behind
from midrib.errors import ParameterError
from midrib.formats.contents import PARQUET_ENDINGS, choose_layer, count_features
from midrib.formats.endings import FOLDERS
from midrib.formats.reading import open_layer

__all__ = [
    "BATCH_ROWS",
    "Partition",
    "batches_of",
    "check_alike",
    "files_of",
    "partitions_of",
]

PART_ROWS = 50_000  # features of a partition: some seconds of work
PART_BYTES = 256_000_000
BATCH_ROWS, BATCH_BYTES = 1_000, 16_000_000  # of a batch, about


class Partition(NamedTuple):
    """Some features of a file.

    Attributes
    ----------
    number : int
        Of the partition in its job.
    path : Path
    layer : str
    first : int
        Row in the file.
    rows : int or None
        How many features, None for all that follow.
    size : int
        About how many bytes they take in memory.
    """

    number: int
    path: Path
    layer: str
    first: int
    rows: int | None
    size: int


def files_of(path: Path) -> list[Path]:
    """Files of an input: itself, or what is GeoParquet in a folder, in the order of their names.

    Raises
    ------
    ParameterError
        If a folder has no such file, or some in folders of its own: these would be left out.
    """
    if not path.is_dir() or path.suffix.lower() in FOLDERS:
        return [path]
    files = sorted(
        file
        for file in path.rglob("*")
        if file.suffix.lower() in PARQUET_ENDINGS
        and file.is_file()
        and not any(name.startswith(("_", ".")) for name in file.relative_to(path).parts)
    )
    inner = next((file.parent for file in files if file.parent != path), None)
    if inner is not None:
        msg = (
            f"IN {str(path)!r} has .parquet files in the subfolder "
            f"{inner.relative_to(path).as_posix()!r}, expected all of them in the folder itself"
        )
        raise ParameterError(msg)
    if not files:
        msg = f"IN {str(path)!r} is a folder without .parquet files, expected some"
        raise ParameterError(msg)
    return files


def check_alike(files: list[Path]) -> None:
    """Refuse files whose columns are not the same.

    Raises
    ------
    ParameterError
        If a file has other columns, or another CRS or epoch, than the first.
    """
    if len(files) == 1:
        return
    known = None
    for file in files:
        with open_layer(file, file.stem) as source:
            attributes = source.attributes.remove_metadata()
            found = (attributes, source.geometry, source.crs, source.more)
        known = known or found
        if found != known:
            msg = (
                f"IN {str(file)!r} has other columns or another CRS or epoch than "
                f"{files[0].name!r}, "
                "expected the same in all files"
            )
            raise ParameterError(msg)


def partitions_of(
    files: list[Path], layer: str | None, rows: int | None = PART_ROWS
) -> list[Partition]:
    """Divide files into partitions of so many features at most, or into one each without ``rows``.

    ``layer`` is that of the only file, if there is one; other files are Parquet.
    """
    found: list[Partition] = []
    for file in files:
        name = choose_layer(file, layer if len(files) == 1 else None)
        runs = [(0, None, bytes_of(file))] if rows is None else runs_of(file, name, rows)
        for first, count, size in runs:
            found.append(Partition(len(found), file, name, first, count, size))
    return found


def runs_of(file: Path, layer: str, rows: int) -> Iterator[tuple[int, int | None, int]]:
    """First row, number and bytes of runs of features of a file; one at least."""
    is_parquet = file.suffix.lower() in PARQUET_ENDINGS
    groups = groups_of(file) if is_parquet else [whole_of(file, layer)]
    first = count = size = 0
    for more, more_size in small_groups(groups, rows):
        if count and (count + more > rows or size + more_size > PART_BYTES):
            yield first, count, size
            first, count, size = first + count, 0, 0
        count, size = count + more, size + more_size
    yield first, count, size


def small_groups(groups: Iterable[tuple[int, int]], rows: int) -> Iterator[tuple[int, int]]:
    """Rows and bytes of groups, of which large ones are divided evenly."""
    for count, size in groups:
        n = max(math.ceil(count / rows), math.ceil(size / PART_BYTES), 1)
        stops = [count * k // n for k in range(n + 1)]
        yield from ((stop - start, size // n) for start, stop in pairwise(stops))


def groups_of(file: Path) -> Iterator[tuple[int, int]]:
    """Rows and bytes of the row groups of a Parquet file."""
    metadata = pq.read_metadata(file)
    for k in range(metadata.num_row_groups):
        group = metadata.row_group(k)
        yield group.num_rows, group.total_byte_size


def whole_of(file: Path, layer: str) -> tuple[int, int]:
    """Features and bytes of a file that is no Parquet."""
    return count_features(file, layer), bytes_of(file)


def bytes_of(file: Path) -> int:
    """Bytes of a layer's file and of those that belong to it."""
    return sum(some.stat().st_size for some in files_behind(file))


def batches_of(partition: Partition) -> Generator[tuple[int, pa.RecordBatch], None, None]:
    """Features of a partition in batches, each with the number of features of the file before it.

    Batches of large features have fewer of them.
    """
    first, rows = partition.first, (partition.first, partition.rows)
    n = batch_rows(partition)
    with open_layer(partition.path, partition.layer, batch_size=n, rows=rows) as source:
        for batch in source.stream:
            yield first, batch
            first += batch.num_rows


def batch_rows(partition: Partition) -> int:
    """Features of a batch: as many as usual, fewer where they are large on average."""
    if partition.rows == 0:
        return BATCH_ROWS
    rows = partition.rows or count_features(partition.path, partition.layer) or 1
    return int(min(max(BATCH_BYTES * rows / max(partition.size, 1), 1), BATCH_ROWS))
