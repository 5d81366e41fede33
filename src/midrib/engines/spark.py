"""Parts made by the executors of a Spark cluster, and lines of Spark's frames.

For files, every executor reads its partition and writes its part by itself, as the workers of the
other engines do: the same bytes, and nothing that Spark would have to shuffle. IN and OUT have to
be where all of them find them under the same name. For frames, WKB goes through Arrow to Python
and back.
"""

import os
import shutil
import sys
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pyarrow as pa

from midrib import interrupts
from midrib.checks import check_library
from midrib.engines.frames import collapse_rows, frame_recipe
from midrib.engines.local import largest_first
from midrib.engines.partitions import Partition
from midrib.engines.parts import Done, Work, make_part
from midrib.errors import MidribError, MissingDependencyError

if TYPE_CHECKING:
    from pyspark.sql import DataFrame, SparkSession

__all__ = ["check_spark", "collapse_frame", "run"]

HERE = "local[*,4]"  # all cores, and four attempts at each partition, as clusters have them
LOOPBACK = "127.0.0.1"
POLL = 1.0  # seconds between two looks at what is finished
NUMBER = pa.schema([("number", pa.int64())])


def run(
    work: Work,
    partitions: list[Partition],
    said: Callable[[int], None],
    *,
    master: str | None = None,
) -> Iterator[Done]:
    """Make the parts of partitions, in any order; ``said`` hears of features that are done.

    Parameters
    ----------
    work, partitions
        What to make of what.
    said : callable
        Takes a number of features.
    master : str, optional
        URL of the cluster; all cores of this machine unless given.

    Raises
    ------
    MissingDependencyError
        If Spark or Java is not installed.
    MidribError
        If a partition has failed again and again.
    """
    check_spark()
    if not partitions:
        return
    session = session_on(master)
    try:
        yield from run_on(session, work, partitions, said)
    finally:
        session.stop()


def run_on(
    session: "SparkSession",
    work: Work,
    partitions: list[Partition],
    said: Callable[[int], None],
) -> Iterator[Done]:
    """Make the parts of partitions in a session that goes on afterwards."""
    tasks = largest_first(partitions)

    def make_parts(batches: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
        for batch in batches:
            for row in batch.column(0).to_pylist():
                done = make_part(work, tasks[row])
                yield pa.RecordBatch.from_pydict({"number": [done.number]}, schema=NUMBER)

    rows = session.range(0, len(tasks), 1, len(tasks))  # a task for each partition
    made = rows.mapInArrow(make_parts, "number long")
    missing = {partition.number for partition in tasks}
    with ThreadPoolExecutor(1) as pool:
        running = pool.submit(made.collect)
        try:
            while missing:
                # Spark has no word for a finished task; the part itself has.
                is_over = running.done()
                for done in finished(work, missing):
                    said(done.counts.features)
                    yield done
                if is_over:
                    break
                interrupts.check()
                wait([running], POLL)
        except BaseException:
            session.sparkContext.cancelAllJobs()
            raise
        check_outcome(running, missing)


def finished(work: Work, missing: set[int]) -> Iterator[Done]:
    """Parts that have come, which are no longer missing then."""
    for number in sorted(missing):
        counts = work.finished(number)
        if counts is not None:
            missing.discard(number)
            yield Done(number, counts, None)


def check_outcome(running: "Future[Any]", missing: set[int]) -> None:
    """Refuse to go on when Spark has given up, with the last line of what it says.

    Raises
    ------
    MidribError
        If so.
    """
    error = running.exception()
    if error is not None or missing:
        said = [line for line in str(error).splitlines() if line.strip()]
        msg = f"Spark has not made {len(missing)} of the parts: {said[-1] if said else ''}"
        raise MidribError(msg) from error


def check_spark() -> None:
    """Refuse to go on without Spark or Java.

    Raises
    ------
    MissingDependencyError
        If one is not installed.
    """
    check_library("pyspark", "--engine spark", "spark")
    if shutil.which("java") is None and "JAVA_HOME" not in os.environ:
        msg = "--engine spark needs Java 17 or later, and no java is on the PATH"
        raise MissingDependencyError(msg)


def session_on(master: str | None) -> "SparkSession":
    """Start a session; on this machine it listens to nobody else."""
    from pyspark.sql import SparkSession

    os.environ.setdefault("PYSPARK_PYTHON", sys.executable)
    builder = SparkSession.builder.appName("midrib").config("spark.ui.enabled", "false")
    if master is None or master.startswith("local"):
        os.environ.setdefault("SPARK_LOCAL_IP", LOOPBACK)
        for name in ("spark.driver.host", "spark.driver.bindAddress"):
            builder = builder.config(name, LOOPBACK)
    return builder.master(master or HERE).getOrCreate()


def collapse_frame(frame: "DataFrame", geometry: str = "geometry", **options: Any) -> "DataFrame":
    """Collapse the areas of a Spark DataFrame.

    Parameters
    ----------
    frame : pyspark.sql.DataFrame
        With a column of WKB; the others are kept.
    geometry : str, default "geometry"
        That column.
    **options
        ``method``, ``geographic``, ``width`` and the options of ``midrib.collapse``: see
        ``midrib.engines.frames.frame_recipe``.

    Returns
    -------
    pyspark.sql.DataFrame
        The same rows: attributes, length, width_mean, width_max, status, WKB of the line. Where an
        area was refused the line is missing and the status says why.

    Notes
    -----
    Executors need midrib and pyarrow. The work is done where the rows are, a batch of
    ``spark.sql.execution.arrow.maxRecordsPerBatch`` rows at a time.
    """
    from pyspark.sql.types import BinaryType, DoubleType, StringType, StructField, StructType

    recipe = frame_recipe(frame.columns, geometry, **options)
    kept = [field for field in frame.schema.fields if field.name != geometry]
    kinds = [DoubleType()] * 3 + [StringType(), BinaryType()]
    added = zip(recipe.lines.names[len(kept) :], kinds, strict=True)
    fields = [*kept, *(StructField(name, kind) for name, kind in added)]

    def collapse_batches(batches: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
        for batch in batches:
            schema = pa.schema([field for field in batch.schema if field.name != geometry])
            yield collapse_rows(batch, replace(recipe, attributes=schema))

    return frame.mapInArrow(collapse_batches, StructType(fields))
