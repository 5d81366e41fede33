"""A layer of many small areas, some of them refused, repaired or missing, and jobs on it."""

import resource
import subprocess
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pyarrow as pa
import shapely

from midrib.engines.jobs import Job, plan
from midrib.engines.parts import Done
from midrib.engines.recipe import Recipe
from midrib.formats.contents import choose_layer
from midrib.formats.geoparquet import GeoParquetWriter
from midrib.formats.reading import open_layer
from midrib.formats.writing import Features, write_layer
from tests.formats.layers import RD_NEW

__all__ = ["areas", "batch_of", "contents", "files_up_to", "job_on", "recipe_of", "write_areas"]

ROWS = 20  # of a partition


def areas(count: int = 110, seed: int = 1) -> "np.ndarray[tuple[int], np.dtype[np.object_]]":
    """Ribbons along random walks; every tenth row is refused, repaired, of two parts or nothing."""
    random = np.random.default_rng(seed)
    found = np.empty(count, dtype=object)
    for i in range(count):
        walk = np.cumsum(random.normal([2.0, 0.0], 1.0, (6, 2)), axis=0) * 30.0
        found[i] = shapely.LineString(walk).buffer(2.0, quad_segs=4)
    found[3::50] = shapely.from_wkt("POLYGON ((0 0, 8 8, 8 0, 0 8, 0 0))")  # refused
    found[13::50] = shapely.from_wkt("POLYGON ((0 0, 90 0, 90 20, 0 20, 0 9, 0 20, 0 0))")
    found[23::50] = shapely.MultiPolygon([shapely.box(0, 0, 90, 9), shapely.box(0, 20, 90, 40)])
    found[33::50] = None
    return found


def write_areas(path: Path, count: int = 110, seed: int = 1) -> Path:
    """Write such a layer."""
    attributes = pa.table(
        {
            "number": pa.array(range(count), type=pa.int32()),
            "name": pa.array([None if i % 7 == 1 else f"é {i}" for i in range(count)]),
            "length": pa.array(np.arange(count) / 4.0),
        }
    )
    found = areas(count, seed)
    if path.suffix != ".parquet":
        write_layer(path, Features("some", attributes, found, "geom", "Polygon", RD_NEW))
        return path
    wkb = pa.array(shapely.to_wkb(found), type=pa.binary())  # of both kinds, as it comes
    table = attributes.append_column("geom", wkb)
    writer = GeoParquetWriter(path, table.schema, "geom", RD_NEW)
    writer.write(table)
    writer.close()
    return path


def recipe_of(path: Path, **options: object) -> Recipe:
    """Recipe for a file."""
    with open_layer(path, choose_layer(path, None)) as source:
        return Recipe(source.attributes, source.geometry, source.crs, options=options)


def batch_of(path: Path) -> pa.RecordBatch:
    """All areas of a file in one batch."""
    with open_layer(path, choose_layer(path, None), batch_size=1_000_000) as source:
        table = pa.Table.from_batches(source.stream)
    (batch,) = table.combine_chunks().to_batches()
    return batch


def job_on(path: Path, folder: Path, **options: object) -> Job:
    """Job that makes parts of a file."""
    layer = choose_layer(path, None)
    return plan(folder, [path], layer, recipe_of(path, **options), ROWS, None)


def contents(folder: Path) -> dict[str, bytes]:
    """Parts in a folder, and their bytes."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("part-*.parquet")}


@contextmanager
def files_up_to(size: int) -> Iterator[None]:
    """Let no file of this process grow past so many bytes, as on a disk that is full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def made(done: Iterable[Done]) -> list[int]:
    """Numbers of parts as they were made."""
    return [part.number for part in done]


def start(*arguments: object) -> "subprocess.Popen[str]":
    """Start a command in a process of its own."""
    command = [sys.executable, "-m", "midrib", *map(str, arguments)]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
