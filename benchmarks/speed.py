"""CPU time of midrib and of its rivals: docs/speed.md.

python benchmarks/speed.py            everything, some ten minutes; table and results are kept
python benchmarks/speed.py --quick    up to 1,000 vertices, under a minute; written to out/ only

All ways take turns in one run, so that whatever else the machine does slows all of them: compare
ratios. Midrib's answers are hashed; the run says which of them are not those of the last one.
"""

import argparse
import gc
import hashlib
import json
import math
import multiprocessing
import time
import warnings
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import shapely

import speed_plot
from families import FAMILIES, GROWING, Case, make, mixed
from rivals import MIDRIB, RIVALS, YARDSTICKS, Way
from tables import ROOT, machine, machine_text, markdown, milliseconds, versions, write_json

COMMAND = "python benchmarks/speed.py"
RESULTS = ROOT / "benchmarks" / "results" / "speed.json"
PAGE = ROOT / "docs" / "speed.md"
OUT = ROOT / "out"
WAYS = (MIDRIB, *RIVALS, *YARDSTICKS)
MISSING, TIMES = "\N{EN DASH}", "\N{MULTIPLICATION SIGN}"

ROUNDS = 7
BUDGET = 2.0  # seconds after which a way takes no further turn at a size
SHORTEST = 0.05  # seconds; faster calls are repeated until they last so long
LONGEST = 30.0  # seconds; what a smaller size predicts to last longer is left out
FIRST_GUESS = 1.5  # growth of a way that has been measured at one size only
BATCH, SAMPLE, BATCH_VERTICES = 10_000, 200, 100
BATCH_ROUNDS, ALL_AT_ONCE = 3, "midrib, one array call"
MANY_HOLES = 100_000  # vertices of an area with more holes than small ones have
DIGITS = 6  # of coordinates in a checksum, in coordinate units


class Plan(NamedTuple):
    """How much to measure."""

    cells: tuple[tuple[str, int], ...]  # family and size, sizes in order
    rounds: int
    budget: float
    batch: int
    memory_size: int  # 0: leave memory out


FULL = Plan(
    tuple((family, n) for family in GROWING for n in (100, 1000, 10_000, 100_000, 1_000_000))
    + tuple((family, n) for family in ("rect", "ushape") for n in (100, 1000, 10_000)),
    ROUNDS,
    BUDGET,
    BATCH,
    100_000,
)
QUICK = Plan(tuple(cell for cell in FULL.cells if cell[1] <= 1000), 3, 0.3, 1000, 0)


class Cell(NamedTuple):
    """One area's times in seconds: None for what failed, a prediction for what was left out."""

    family: str
    n: int
    seconds: dict[str, float | None]
    left_out: dict[str, float]
    checksum: str


def measure(cells: Sequence[tuple[str, int]], rounds: int, budget: float) -> list[Cell]:
    """Time every way at every size, as far as smaller sizes let it hope to end."""
    measured: list[Cell] = []
    for family, n in cells:
        case = make(family, n)
        smaller = [cell for cell in measured if cell.family == family]
        expected = {way.name: predicted(smaller, way.name, n) for way in WAYS}
        left_out = {name: t for name, t in expected.items() if t > LONGEST}
        ways = [way for way in WAYS if way.name not in left_out]
        seconds = take_turns(case, ways, rounds, budget)
        measured.append(Cell(family, n, seconds, left_out, checksum(MIDRIB.run(case.area, 0.0))))
        print(
            f"{family} {n:,}: midrib {milliseconds(seconds.get(MIDRIB.name) or math.nan)} ms",
            flush=True,
        )
    return measured


def predicted(smaller: Sequence[Cell], name: str, n: int) -> float:
    """Seconds that a way should need for ``n`` vertices, going on as it has grown so far."""
    times = [(cell.n, cell.seconds.get(name, cell.left_out.get(name))) for cell in smaller]
    known = [(size, t) for size, t in times if t is not None]
    if not known:
        return 0.0
    size, seconds = known[-1]
    exponent = growth(known[-2:]) if len(known) > 1 else FIRST_GUESS
    return float(seconds * (n / size) ** max(exponent, 1.0))


def growth(known: Sequence[tuple[int, float]]) -> float:
    """Exponent k of a time that grows like n to the k, from the first to the last size."""
    (first, before), (last, after) = known[0], known[-1]
    return math.log(after / before) / math.log(last / first)


def take_turns(
    case: Case, ways: Sequence[Way], rounds: int, budget: float
) -> dict[str, float | None]:
    """Best CPU time of every way, one after another in every round; None if it raises."""
    best: dict[str, float | None] = {way.name: math.inf for way in ways}
    repeats = dict.fromkeys(best, 1)
    spent = dict.fromkeys(best, 0.0)
    for turn in range(rounds):
        for way in ways:
            name, so_far = way.name, best[way.name]
            if so_far is None or (turn and spent[name] + so_far > budget):
                continue
            try:
                seconds = cpu_time(case, way, repeats[name])
            except Exception:  # rivals raise what they like
                best[name] = None
                continue
            spent[name] += seconds * repeats[name]
            best[name] = min(so_far, seconds)
            repeats[name] = max(1, math.ceil(SHORTEST / max(seconds, 1e-9)))
    return best


def cpu_time(case: Case, way: Way, repeats: int) -> float:
    """CPU seconds of one call, on areas that nobody has prepared or looked at before."""
    written = shapely.to_wkb(case.area)
    fresh = [shapely.from_wkb(written) for _ in range(repeats)]
    return timed(lambda: [way.run(area, case.width) for area in fresh]) / repeats


def timed(work: Callable[[], Any]) -> float:
    """CPU seconds of all threads, without garbage collection."""
    gc.collect()
    gc.disable()
    try:
        start = time.process_time()
        work()
        return time.process_time() - start
    finally:
        gc.enable()


def checksum(lines: Any) -> str:
    """Hash of the coordinates of one or more lines, rounded and from the lower left on."""
    points = shapely.get_coordinates(lines)
    origin = points.min(axis=0) if len(points) else 0.0
    rounded = np.round(points - origin, DIGITS) + 0.0
    return hashlib.sha256(rounded.astype("<f8").tobytes()).hexdigest()[:12]


def measure_batch(count: int) -> dict[str, Any]:
    """Many small areas of all families: one array call, and others on a sample."""
    import midrib

    areas = np.empty(count, dtype=object)
    areas[:] = mixed(count, BATCH_VERTICES)
    sample = areas[:SAMPLE]
    result: list[Any] = []

    def all_at_once() -> None:
        result[:] = midrib.collapse(areas, on_error="report")

    def by_pygeoops(**settings: Any) -> None:
        import pygeoops

        pygeoops.centerline(sample, **settings)

    tuned = {"densify_distance": -0.5, "min_branch_length": -3, "simplifytolerance": -0.02}
    work: dict[str, tuple[Callable[[], Any], int]] = {
        ALL_AT_ONCE: (all_at_once, count),
        "midrib, one call each": (
            lambda: [midrib.collapse(area, on_error="report") for area in sample],
            len(sample),
        ),
        "pygeoops, tuned": (lambda: by_pygeoops(**tuned, extend=True), len(sample)),
        "pygeoops, default": (by_pygeoops, len(sample)),
        "triangle script": (lambda: [RIVALS[-1].run(area, 0.0) for area in sample], len(sample)),
    }
    best = dict.fromkeys(work, math.inf)
    for _ in range(BATCH_ROUNDS):
        for name, (task, size) in work.items():
            with suppress(ImportError):
                best[name] = min(best[name], timed(task) / size)
    lines, problems = result
    return {
        "count": count,
        "sample": len(sample),
        "vertices": BATCH_VERTICES,
        "seconds_per_area": {name: t for name, t in best.items() if math.isfinite(t)},
        "refused": sum(problem.status == "refused" for problem in problems),
        "checksum": checksum(lines),
    }


def measure_memory(n: int) -> dict[str, float]:
    """Peak memory in MB that each way adds for one river, each in a process of its own.

    Only where Linux tells it.
    """
    if not Path("/proc/self/status").exists():
        return {}
    context = multiprocessing.get_context("spawn")
    peaks = {}
    for way in (MIDRIB, *RIVALS):
        if way.name == "centerline":  # minutes
            continue
        with ProcessPoolExecutor(1, mp_context=context) as pool:
            peaks[way.name] = pool.submit(peak_memory, way.name, n).result()
    return peaks


def peak_memory(name: str, n: int) -> float:
    """MB by which the peak of this process grows when a river is collapsed."""
    way = next(way for way in WAYS if way.name == name)
    small, case = make("river", 100), make("river", n)
    way.run(small.area, small.width)
    before = peak_so_far()
    way.run(case.area, case.width)
    return peak_so_far() - before


def peak_so_far() -> float:
    """MB of memory that this process has held at most.

    Not from ``getrusage``: there a new process starts with the peak of its parent.
    """
    for line in Path("/proc/self/status").read_text(encoding="utf-8").splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) / 1024.0
    msg = "the system does not tell the peak of a process's memory"
    raise OSError(msg)


def family_table(cells: Sequence[Cell]) -> str:
    """CPU milliseconds of one family, and in brackets how many times midrib's they are."""
    rows = []
    for way in WAYS:
        known = [(c.n, t) for c in cells if (t := c.seconds.get(way.name)) is not None]
        known = [(n, t) for n, t in known if n >= 1000]
        exponent = f"{growth(known):.2f}" if len(known) > 1 else MISSING
        rows.append([way.name, *(time_text(cell, way.name) for cell in cells), exponent])
    return markdown(["CPU ms", *(f"{cell.n:,}" for cell in cells), "growth"], rows)


def time_text(cell: Cell, name: str) -> str:
    """One time and its ratio to midrib's, or why there is none."""
    if name in cell.left_out:
        return f"left out (some {cell.left_out[name]:,.0f} s)"
    seconds, own = cell.seconds[name], cell.seconds.get(MIDRIB.name)
    if seconds is None:
        return "fails"
    if name == MIDRIB.name or own is None:
        return f"**{milliseconds(seconds)}**"
    return f"{milliseconds(seconds)} ({ratio_text(seconds / own)})"


def ratio_text(ratio: float) -> str:
    """How many times as long, with two digits or more."""
    return f"{ratio:,.0f}{TIMES}" if ratio >= 10 else f"{ratio:.2g}{TIMES}"


INTRODUCTION = """\
# Speed

Made by `{command}` on {machine}.
{versions}.

CPU time of one call on one area (`benchmarks/families.py`) of so many vertices, in milliseconds;
in brackets, how many times midrib's time that is. Best of up to {rounds} rounds in which all ways
take turns; calls longer than {budget:g} s are timed once. Compilation is not in it: midrib's
kernels are compiled once and cached. *growth* is the exponent k if time grows like n^k from 1,000
vertices to the last size. What its smaller sizes predict to last longer than {longest:.0f} s is
left out.

![Time against size for each family](pictures/speed.svg)

"""


def page(
    plan: Plan,
    command: str,
    cells: Sequence[Cell],
    batch: dict[str, Any],
    memory: dict[str, float],
) -> str:
    """Page of the documentation."""
    parts = [
        INTRODUCTION.format(
            command=command,
            machine=machine_text(),
            versions=", ".join(f"{k} {v}" for k, v in versions().items()),
            rounds=plan.rounds,
            budget=plan.budget,
            longest=LONGEST,
        )
    ]
    parts += [f"- {way.name}: {way.about}\n" for way in WAYS]
    for family in dict.fromkeys(cell.family for cell in cells):
        mine = [cell for cell in cells if cell.family == family]
        parts.append(f"\n## {family}\n\n{family_table(mine)}")
    parts.append(batch_text(batch))
    if memory:
        rows = [[name, f"{peak:,.0f}"] for name, peak in memory.items()]
        parts.append(f"\n## Memory\n\nPeak for a river of {plan.memory_size:,} vertices.\n\n")
        parts.append(markdown(["", "MB"], rows))
    return "".join(parts)


def batch_text(batch: dict[str, Any]) -> str:
    """Section on many small areas."""
    times = batch["seconds_per_area"]
    own, count = times[ALL_AT_ONCE], batch["count"]
    rows = [
        [name, f"{seconds * 1e6:,.0f}", f"{seconds * count:.3g}", ratio_text(seconds / own)]
        for name, seconds in times.items()
    ]
    table = markdown(["", "µs per area", f"s for {count:,}", "times midrib"], rows)
    return (
        f"\n## {count:,} areas of {batch['vertices']} vertices\n\n"
        f"All ten families in turn, each with a seed of its own; {batch['refused']} refused. "
        f"All but the array call are timed on the first {batch['sample']} and scaled up.\n\n{table}"
    )


def answers_of(results: dict[str, Any]) -> dict[str, str]:
    """Checksums of midrib's lines by area."""
    found = {f"{cell['family']} {cell['n']}": str(cell["checksum"]) for cell in results["cells"]}
    batch = results["batch"]
    return found | {f"batch of {batch['count']}": str(batch["checksum"])}


def changed_answers(old: Path, new: dict[str, Any]) -> list[str]:
    """Areas whose lines are not those of the last run that was kept."""
    if not old.exists():
        return []
    before = answers_of(json.loads(old.read_text(encoding="utf-8")))
    return [name for name, key in answers_of(new).items() if before.get(name, key) != key]


def warm_up() -> None:
    """Compile and import whatever is compiled or imported at the first call."""
    for family in FAMILIES:
        case = make(family, 100)
        for way in WAYS:
            try:
                way.run(case.area, case.width)
            except Exception:  # measured and reported later
                continue
    case = make("holes", MANY_HOLES)  # which take another way to tell that they are valid
    MIDRIB.run(case.area, case.width)


def run(plan: Plan, command: str) -> tuple[dict[str, Any], str]:
    """Measure all of a plan: results and page."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # whatever rivals warn of
        warm_up()
        cells = measure(plan.cells, plan.rounds, plan.budget)
        batch = measure_batch(plan.batch)
    memory = measure_memory(plan.memory_size) if plan.memory_size else {}
    results = {
        "command": command,
        "machine": machine(),
        "versions": versions(),
        "cells": [cell._asdict() for cell in cells],
        "batch": batch,
        "memory": memory,
    }
    return results, page(plan, command, cells, batch, memory)


def main() -> None:
    """Measure, compare the answers with the last ones, write results and table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--quick", action="store_true", help="only up to 1,000 vertices")
    options = parser.parse_args()
    command = f"{COMMAND} --quick" if options.quick else COMMAND
    results, text = run(QUICK if options.quick else FULL, command)
    changed = changed_answers(RESULTS, results)
    print(text)
    print(f"Answers that changed: {', '.join(changed)}" if changed else "No answer has changed.")
    target, table = (OUT / RESULTS.name, OUT / PAGE.name) if options.quick else (RESULTS, PAGE)
    write_json(target, results)
    table.parent.mkdir(parents=True, exist_ok=True)
    table.write_text(text, encoding="utf-8")
    if not options.quick:
        speed_plot.draw(results["cells"], speed_plot.PICTURE)


if __name__ == "__main__":
    main()
