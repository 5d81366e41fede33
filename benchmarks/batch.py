"""What many areas cost in one call, from WKB to WKB: docs/batch.md.

python benchmarks/batch.py            100,000 areas of 100 vertices; results and page are kept
python benchmarks/batch.py --quick    a tenth of them; written to out/ only

Run it while the machine has nothing else to do: two threads are measured by the clock.
"""

import argparse
import hashlib
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import shapely

import midrib
from families import mixed
from speed import peak_so_far
from tables import ROOT, machine, machine_text, markdown, versions, write_json

COMMAND = "python benchmarks/batch.py"
RESULTS = ROOT / "benchmarks" / "results" / "batch.json"
PAGE = ROOT / "docs" / "batch.md"
OUT = ROOT / "out"
COUNT, VERTICES, ROUNDS, THREADS = 100_000, 100, 3, (1, 2)
SAMPLE = 10_000  # areas that are made; the others repeat them


class Cost(NamedTuple):
    """Seconds of all processors, seconds by the clock."""

    cpu: float
    wall: float


def cost(work: Callable[[], Any]) -> Cost:
    """Return what a call takes."""
    cpu, wall = time.process_time(), time.perf_counter()
    work()
    return Cost(time.process_time() - cpu, time.perf_counter() - wall)


def yardstick(wkb: Any) -> None:
    """Load, validate and write with shapely."""
    areas = shapely.from_wkb(wkb)
    shapely.is_valid(areas)
    shapely.to_wkb(areas)


def lines_of(wkb: Any, threads: int) -> Any:
    """Lines of areas, as WKB; None for areas that are refused."""
    lines, _ = midrib.collapse(shapely.from_wkb(wkb), on_error="report", threads=threads)
    return shapely.to_wkb(lines)


def digest(lines: Any) -> str:
    """Hash of lines, bit by bit."""
    found = hashlib.sha256()
    for line in lines:
        found.update(b"-" if line is None else line)
    return found.hexdigest()[:12]


def measure(count: int) -> dict[str, Any]:
    """Everything, in turns; the best of each."""
    sample = shapely.to_wkb(np.array(mixed(min(count, SAMPLE), VERTICES), dtype=object))
    wkb = np.resize(sample, count)
    lines_of(wkb[:10], 1)  # compiles, or loads what is compiled
    before = peak_so_far()
    digests = {threads: digest(lines_of(wkb, threads)) for threads in THREADS}
    memory = peak_so_far() - before
    rounds = [
        [cost(lambda: yardstick(wkb)), *(cost(lambda t=t: lines_of(wkb, t)) for t in THREADS)]  # type: ignore[misc]
        for _ in range(ROUNDS)
    ]
    names = ["yardstick", *(f"threads {threads}" for threads in THREADS)]
    best = {
        name: {
            "cpu": min(row[k].cpu for row in rounds) / count,
            "wall": min(row[k].wall for row in rounds) / count,
        }
        for k, name in enumerate(names)
    }
    return {
        "count": count,
        "vertices": VERTICES,
        "seconds_per_area": best,
        "memory": memory,
        "digests": digests,
        "machine": machine(),
        "versions": versions(),
    }


def page(results: dict[str, Any]) -> str:
    """Page of the documentation."""
    times, count = results["seconds_per_area"], results["count"]
    own = times["yardstick"]
    labels = {"yardstick": "shapely: load, validate, write", "threads 1": "midrib, one thread"}
    rows = [
        [
            labels.get(name, f"midrib, {name[-1]} threads"),
            *(f"{row[clock] * 1e6:.1f}" for clock in ("cpu", "wall")),
            f"{row['cpu'] / own['cpu']:.1f}",
        ]
        for name, row in times.items()
    ]
    table = markdown(
        ["from WKB to WKB", "CPU µs an area", "µs by the clock", "times shapely"], rows
    )
    gain = times["threads 1"]["wall"] / times["threads 2"]["wall"]
    same = "the same" if len(set(results["digests"].values())) == 1 else "NOT the same"
    return (
        "# Many areas in one call\n\n"
        "`midrib.collapse` takes arrays: their rings go to one compiled kernel as plain numbers,\n"
        "in runs of some 30,000 vertices, and lines come back alike. The kernel lets other\n"
        "threads go on, so runs are shared among `threads=`: by default one for each core.\n\n"
        f"Made by `{COMMAND}` on {machine_text()}\n\n"
        f"{count:,} areas of {results['vertices']} vertices, of ten families; "
        f"best of {ROUNDS} rounds in turn.\n\n"
        f"{table}\n"
        f"Two threads are {gain:.2f} times as fast as one, and lines are {same} bit by bit. "
        f"The process holds {results['memory']:,.0f} MB more at its peak.\n"
    )


def main() -> None:
    """Measure and write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help="a tenth of the areas, into out/")
    is_quick = parser.parse_args().quick
    results = measure(COUNT // 10 if is_quick else COUNT)
    text = page(results)
    if is_quick:
        OUT.mkdir(exist_ok=True)
    write_json(OUT / "batch.json" if is_quick else RESULTS, results)
    (OUT / "batch.md" if is_quick else PAGE).write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
