"""What layers of any size cost: docs/scale.md, its table of figures and its plan for 10⁸ areas.

python benchmarks/scale.py            everything, under five minutes; results and page are kept
python benchmarks/scale.py --quick    a tenth of the areas; written to out/ only

Times are CPU seconds of all threads, memory is the peak of one process. Areas of a layer are a
thousand of all ten families, each shifted again and again to other places.
"""

import argparse
import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa
import shapely

from families import mixed
from midrib.engines.partitions import PART_ROWS, batches_of, partitions_of
from midrib.engines.parts import Work, make_part
from midrib.engines.recipe import Recipe
from midrib.formats.geoparquet import GeoParquetWriter
from midrib.formats.reading import open_layer
from tables import ROOT, machine, machine_text, markdown, versions, write_json

COMMAND = "python benchmarks/scale.py"
RESULTS = ROOT / "benchmarks" / "results" / "scale.json"
PAGE = ROOT / "docs" / "scale.md"
OUT = ROOT / "out"
BEGIN, END = "<!-- figures: benchmarks/scale.py -->", "<!-- end of figures -->"
COAST = ROOT.parent / "shared" / "data" / "gshhg_coast_big.parquet"

SAMPLE = 1000  # areas that a layer repeats
SIZES = {20: 20_000, 100: 10_000, 1_000: 1_000, 10_000: 100}  # vertices, areas
SMALL = 20  # vertices of the areas of large files
LARGE = (100_000, 1_000_000)  # areas of the files whose memory is measured
PLANNED = 100_000_000  # areas
CORES = (1, 10, 100, 1_000)
USE = 0.85  # share of the time that cores are busy: the last partitions, retries, slow disks
WORLD = 1e6  # extent of the places, in units of the coordinates
DIVIDED = 4  # pieces of each edge of the largest coast
MEGA, HOUR = 1e6, 3600.0

# Runs a command and tells what it took; what a process inherits of its parent's peak is not in it.
CHILD = """
import json, sys, time
from midrib.__main__ import main
try:
    main()
except SystemExit as left:
    code = left.code
status = dict(line.split(":", 1) for line in open("/proc/self/status"))
print(json.dumps({"code": code, "seconds": time.process_time(),
                  "peak": int(status["VmHWM"].split()[0]) * 1024}))
"""


class Cost(NamedTuple):
    """What a partition takes, one area on average."""

    vertices: int
    areas: int
    reading: float  # CPU seconds of an area
    all: float  # CPU seconds of an area: read, collapsed, written
    bytes_in: float
    bytes_out: float


def layer(path: Path, count: int, vertices: int) -> Path:
    """Write a layer of so many areas."""
    sample = np.array(mixed(min(count, SAMPLE), vertices), dtype=object)
    schema = pa.schema([("number", pa.int64()), ("name", pa.string()), ("geometry", pa.binary())])
    writer = GeoParquetWriter(path, schema, "geometry", None)
    random = np.random.default_rng(vertices)
    for first in range(0, count, len(sample)):
        n = min(len(sample), count - first)
        shifts = random.uniform(0.0, WORLD, (n, 2))
        by = np.repeat(shifts, shapely.get_num_coordinates(sample[:n]), axis=0)
        areas = shapely.transform(sample[:n], lambda points, by=by: points + by)
        numbers = range(first, first + n)
        names = [f"area {number}" for number in numbers]
        columns = [pa.array(numbers), pa.array(names), pa.array(shapely.to_wkb(areas))]
        writer.write(pa.table(columns, schema=schema))
    writer.close()
    return path


def recipe_of(path: Path) -> Recipe:
    """Recipe for a file, with the usual options."""
    with open_layer(path, path.stem) as source:
        return Recipe(source.attributes, source.geometry, source.crs)


def cpu(work: Callable[[], object]) -> float:
    """CPU seconds of a call."""
    started = time.process_time()
    work()
    return time.process_time() - started


def measure_costs(folder: Path, share: float) -> Iterator[Cost]:
    """Costs of areas by their size."""
    for vertices, count in SIZES.items():
        areas = max(int(count * share), 20)
        path = layer(folder / f"in_{vertices}.parquet", areas, vertices)
        (partition,) = partitions_of([path], None, None)
        work = Work(folder, "", recipe_of(path))
        reading = cpu(lambda p=partition: [*batches_of(p)])  # type: ignore[misc]
        all_ = min(cpu(lambda p=partition, w=work: make_part(w, p)) for _ in range(2))  # type: ignore[misc]
        sizes = (file.stat().st_size / areas for file in (path, work.lines(0)))
        yield Cost(vertices, areas, reading / areas, all_ / areas, *sizes)


def measure_memory(folder: Path, share: float) -> list[dict[str, float]]:
    """Peak memory of commands on files of several sizes; of one area, to subtract."""
    rows = []
    for count in (1, *(int(n * share) for n in LARGE)):
        path = layer(folder / f"areas_{count}.parquet", count, SMALL)
        took = peak_of(path, folder / f"lines_{count}.parquet")
        rows.append({"areas": count, "bytes": path.stat().st_size, **took})
        path.unlink()
    return rows


def peak_of(path: Path, out: Path) -> dict[str, float]:
    """CPU seconds and peak memory of ``midrib collapse``."""
    command = [sys.executable, "-c", CHILD, "collapse", str(path), str(out), "-q"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    took: dict[str, float] = json.loads(done.stdout)
    return took


def measure_coast(folder: Path) -> dict[str, float]:
    """Cost and memory of one coast of 900,000 vertices: the largest of GSHHG, edges divided."""
    if not COAST.exists():
        return {}
    with open_layer(COAST, COAST.stem) as source:
        areas = np.concatenate([batch.geometries for batch in source.batches()])
        crs = source.crs
    rings = shapely.get_coordinates(areas[np.argmax(shapely.get_num_coordinates(areas))])
    steps = np.arange(len(rings) * DIVIDED) / DIVIDED
    x, y = (np.interp(steps, np.arange(len(rings)), column) for column in rings.T)
    coast = shapely.Polygon(np.column_stack([x, y]))
    table = pa.table({"geometry": pa.array([coast.wkb], type=pa.binary())})
    path = folder / "coast.parquet"
    writer = GeoParquetWriter(path, table.schema, "geometry", crs)
    writer.write(table)
    writer.close()
    (partition,) = partitions_of([path], None, None)
    work = Work(folder, "", recipe_of(path))
    seconds = cpu(lambda: make_part(work, partition))
    peak = peak_of(path, folder / "coast_lines")["peak"]
    vertices = shapely.get_num_coordinates(coast)
    return {"vertices": int(vertices), "seconds": seconds, "bytes": partition.size, "peak": peak}


def measure_overhead() -> float | None:
    """Seconds that Dask takes for a task that does nothing, on one worker; None without Dask."""
    try:
        from midrib.engines.dask import client_of
    except ImportError:
        return None
    count = 500
    with client_of(None, 1) as client:
        client.gather(client.map(int, range(10)))
        started = time.perf_counter()
        client.gather(client.map(int, range(count), pure=False))
        return (time.perf_counter() - started) / count


def planned(cost: Cost) -> list[list[str]]:
    """Rows about a layer of many areas on clusters of several sizes."""
    total = cost.all * PLANNED
    rows = []
    for cores in CORES:
        seconds = total / cores / USE
        rate = (cost.bytes_in + cost.bytes_out) * PLANNED / seconds / MEGA
        rows.append([f"{cores:,}", duration(seconds), f"{rate:,.0f}"])
    return rows


def duration(seconds: float) -> str:
    """Write a time for people."""
    if seconds >= 2 * HOUR:
        return f"{seconds / HOUR:,.1f} h"
    return f"{seconds / 60:,.0f} min" if seconds >= 120 else f"{seconds:.0f} s"


def figures(results: dict[str, Any]) -> str:
    """Text of the page that is made of figures."""
    costs = [Cost(**row) for row in results["costs"]]
    usual = next(cost for cost in costs if cost.vertices == 100)
    table = markdown(
        ["vertices of an area", "µs an area", "of it reading", "areas/s", "bytes in", "bytes out"],
        [
            [
                f"{cost.vertices:,}",
                f"{cost.all * 1e6:,.0f}",
                f"{cost.reading / cost.all:.0%}",
                f"{1 / cost.all:,.0f}",
                f"{cost.bytes_in:,.0f}",
                f"{cost.bytes_out:,.0f}",
            ]
            for cost in costs
        ],
    )
    none, *files = results["memory"]
    memory = markdown(
        ["areas", "file, MB", "peak, MB", "above an empty run, MB"],
        [
            [
                f"{row['areas']:,}",
                f"{row['bytes'] / MEGA:,.0f}",
                f"{row['peak'] / MEGA:,.0f}",
                f"{(row['peak'] - none['peak']) / MEGA:,.0f}",
            ]
            for row in files
        ],
    )
    per_part = usual.all * PART_ROWS
    gigabytes = [size * PLANNED / 1e9 for size in (usual.bytes_in, usual.bytes_out)]
    clusters = markdown(["cores", "time", "MB/s read and written, all together"], planned(usual))
    text = (
        f"Made by `{results['command']}` on {machine_text()}.\n\n"
        f"### One area\n\n{table}\n"
        f"### One partition\n\n{PART_ROWS:,} areas of 100 vertices take {per_part:.1f} s of CPU, "
        f"{usual.bytes_in * PART_ROWS / MEGA:.0f} MB are read and "
        f"{usual.bytes_out * PART_ROWS / MEGA:.0f} MB written."
        f"{overhead_text(results, per_part)}\n\n"
        f"### Memory of one process\n\n{memory}\n"
        f"### 10⁸ areas of 100 vertices\n\n"
        f"{PLANNED // PART_ROWS:,} partitions; {gigabytes[0]:,.0f} GB in, {gigabytes[1]:,.0f} GB "
        f"out; {usual.all * PLANNED / HOUR:,.1f} hours of CPU. Cores are taken to be busy "
        f"{USE:.0%} of the time.\n\n{clusters}"
    )
    return text + coast_text(results["coast"], per_part, none["peak"])


def overhead_text(results: dict[str, Any], per_part: float) -> str:
    """Say what Dask adds to a partition."""
    seconds = results["overhead"]
    if seconds is None:
        return ""
    return f" Dask adds {seconds * 1000:.1f} ms to each, {seconds / per_part:.2%}."


def coast_text(coast: dict[str, float], per_part: float, none: float) -> str:
    """Say what a large area does among small ones."""
    if not coast:
        return ""
    return (
        f"\n### A coast among ponds\n\n"
        f"Greenland with its edges divided, {coast['vertices']:,} vertices, takes "
        f"{coast['seconds']:.1f} s of CPU, {coast['seconds'] / per_part:.1f} times a partition of "
        f"{PART_ROWS:,} areas of 100 vertices, and {(coast['peak'] - none) / MEGA:,.0f} MB above "
        f"an empty run. It is one feature, so one core works on it.\n"
    )


def main() -> None:
    """Measure, write results and page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--quick", action="store_true", help="a tenth of the areas")
    options = parser.parse_args()
    share = 0.1 if options.quick else 1.0
    with TemporaryDirectory() as name:
        folder = Path(name)
        warm = layer(folder / "warm.parquet", 100, 100)
        make_part(Work(folder, "", recipe_of(warm)), partitions_of([warm], None, None)[0])
        results: dict[str, Any] = {
            "command": COMMAND + " --quick" * options.quick,
            "machine": machine(),
            "versions": versions(),
            "costs": [cost._asdict() for cost in measure_costs(folder, share)],
            "memory": measure_memory(folder, share),
            "coast": measure_coast(folder),
            "overhead": measure_overhead(),
        }
    text = figures(results)
    print(text)
    if options.quick:
        write_json(OUT / RESULTS.name, results)
        return
    write_json(RESULTS, results)
    page = PAGE.read_text(encoding="utf-8")
    head, tail = page.partition(BEGIN)[0], page.partition(END)[2]
    PAGE.write_text(f"{head}{BEGIN}\n\n{text}\n{END}{tail}", encoding="utf-8")


if __name__ == "__main__":
    main()
