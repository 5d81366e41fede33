"""Parts of a result: one GeoParquet file for each partition, there whole or not at all.

    OUT/part-00000.parquet ...           lines
    OUT/_refused/part-00000.parquet ...  areas that were refused, where there are some

The footer of a part says which job it is of and what is in it, so that nothing else has to be kept
in step with the files. Readers of folders pass over names that begin with an underscore.
"""

import json
import os
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import pyarrow as pa
import pyarrow.parquet as pq

from midrib import interrupts
from midrib.engines.batches import Collapsed, Counts, collapse_batch
from midrib.engines.overlap import ahead, behind
from midrib.engines.partitions import BATCH_ROWS, Partition, batches_of
from midrib.engines.recipe import Recipe
from midrib.formats.failures import failures_named
from midrib.formats.geoparquet import GeoParquetWriter, Kind
from midrib.formats.reading import BUFFER, parquet_batches

__all__ = ["REFUSED", "Done", "Work", "kinds_in", "make_part", "remove_unfinished", "tables_of"]

REFUSED = "_refused"
FOOTER = "midrib"
UNFINISHED = ".part-"


@dataclass(frozen=True)
class Work:
    """What every machine that makes parts of a job has to know.

    Attributes
    ----------
    folder : Path
        Where parts go; all machines see it under this name.
    key : str
        Of the job, see ``midrib.engines.jobs``.
    recipe : Recipe
    """

    folder: Path
    key: str
    recipe: Recipe

    def lines(self, number: int) -> Path:
        """File for the lines of a partition."""
        return self.folder / f"part-{number:05}.parquet"

    def refused(self, number: int) -> Path:
        """File for the refused areas of a partition."""
        return self.folder / REFUSED / f"part-{number:05}.parquet"

    def finished(self, number: int) -> Counts | None:
        """Return counts of a part that is there and of this job, else None."""
        footer = read_footer(self.lines(number))
        if footer.get("job") != self.key:
            return None
        return Counts(**{name: footer[name] for name in vars(Counts())})


class Done(NamedTuple):
    """A part that is there."""

    number: int
    counts: Counts
    seconds: float | None  # that it took, where that is known


def make_part(
    work: Work,
    partition: Partition,
    said: Callable[[int], None] = lambda _: None,
    threads: int | None = 1,
) -> Done:
    """Collapse the areas of a partition and write its part, whole or not at all.

    Reading and writing go on in threads of their own; a few batches are in memory at a time.
    ``said`` hears the number of features of each batch that is done; so many threads make it.
    """
    started = time.perf_counter()
    counts = Counts()
    with PartWriter(work, partition.number) as part, behind(part.write) as write:
        batches = ahead(batches_of(partition))
        for first, batch in batches:
            interrupts.check()
            collapsed = collapse_batch(batch, work.recipe, first, threads)
            counts.add(collapsed.counts)
            write(collapsed)
            said(batch.num_rows)
        part.counts = counts
    return Done(partition.number, counts, time.perf_counter() - started)


class PartWriter:
    """Writes a part under other names; these become its own when all is well."""

    def __init__(self, work: Work, number: int) -> None:
        self.work, self.number = work, number
        self.counts = Counts()
        self.files: dict[Path, tuple[Path, GeoParquetWriter]] = {}

    def __enter__(self) -> "PartWriter":
        """Begin the file of lines: it is there even if there are none."""
        schema = self.work.recipe.lines
        self.add(self.work.lines(self.number), schema, schema.empty_table())
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        """Put the files into their places, refused areas first; after an error remove them."""
        try:
            if kind is None:
                self.finish()
        finally:
            for path, writer in self.files.values():
                writer.abandon()
                path.unlink(missing_ok=True)

    def finish(self) -> None:
        """Write what is still held and the footers, then put the files into their places."""
        footer = {"job": self.work.key, "part": self.number, **vars(self.counts)}
        for place in reversed([*self.files]):
            path, writer = self.files[place]
            kinds = sorted(writer.kinds)
            with failures_named(repr(str(place))):
                writer.close(**{FOOTER: json.dumps({**footer, "kinds": kinds})})
                path.replace(place)
            del self.files[place]

    def write(self, collapsed: Collapsed) -> None:
        """Add a batch."""
        recipe = self.work.recipe
        lines, refused = (
            pa.Table.from_batches([some]) for some in (collapsed.lines, collapsed.refused)
        )
        self.add(self.work.lines(self.number), recipe.lines, lines)
        if refused.num_rows:
            self.add(self.work.refused(self.number), recipe.refused, refused)

    def add(self, place: Path, schema: pa.Schema, table: pa.Table) -> None:
        """Add rows to the file that is to be in some place."""
        with failures_named(repr(str(place))):
            self.writer(place, schema).write(table)

    def writer(self, place: Path, schema: pa.Schema) -> GeoParquetWriter:
        """File that is to be in some place."""
        if place not in self.files:
            place.parent.mkdir(exist_ok=True)
            # Two machines that make the same part, one of them by mistake, do not meet.
            path = place.with_name(f"{UNFINISHED}{self.number:05}-{os.getpid()}-{time.time_ns()}")
            recipe = self.work.recipe
            writer = GeoParquetWriter(path, schema, recipe.geometry, recipe.crs, recipe.more)
            self.files[place] = path, writer
        return self.files[place][1]


def remove_unfinished(folder: Path) -> None:
    """Remove what was being written when a run ended."""
    for place in (folder, folder / REFUSED):
        for path in place.glob(f"{UNFINISHED}*"):
            path.unlink(missing_ok=True)


def read_footer(path: Path) -> dict[str, Any]:
    """Read what a part says of itself; nothing if it is none, or not there."""
    try:
        metadata = pq.read_metadata(path).metadata or {}
    except (OSError, pa.ArrowException):
        return {}
    found: dict[str, Any] = json.loads(metadata.get(FOOTER.encode(), b"{}"))
    return found


def kinds_in(paths: Iterable[Path]) -> frozenset[Kind]:
    """Kinds of geometry that there are in parts."""
    kinds = (kind for path in paths for kind in read_footer(path)["kinds"])
    return frozenset((name, has_z, has_m) for name, has_z, has_m in kinds)


def tables_of(paths: Iterable[Path]) -> Iterator[pa.Table]:
    """Features of parts, some at a time: attributes, WKB."""
    for path in paths:
        with pq.ParquetFile(path, buffer_size=BUFFER) as file:
            names = file.schema_arrow.names[:-1]  # the last column has the boxes
            for batch in parquet_batches(file, BATCH_ROWS, names):
                yield pa.Table.from_batches([batch])
