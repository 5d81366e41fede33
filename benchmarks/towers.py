"""How near axes of towers are to the truth, on simulated scans; circle fits beside them.

python benchmarks/towers.py            table and results, seeds that development did not use
python benchmarks/towers.py --seeds 1  so many of them
python benchmarks/towers.py --processes 2  scans side by side: CPU time is each one's own
python benchmarks/towers.py --speed    20 million points from a file: points per second, memory
"""

import argparse
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from midrib.errors import MidribError
from midrib.formats.clouds import open_cloud
from midrib.scans import tower_axis
from midrib.towers.cloud import ArrayCloud
from midrib.towers.fan import fan
from midrib.towers.levels import levels_of
from midrib.towers.paper import paper
from midrib.towers.pipeline import Options, Shell, shell_of, untracked
from midrib.towers.simulate import Scan, Tower
from midrib.towers.tolerance import BEYOND, UNDECIDED, WITHIN, tolerance_from, verdicts
from tables import ROOT, machine, machine_text, markdown, write_json
from tower_bound import bound_text
from tower_cases import CASES, PATCHES, Case, circle_fits

Floats = NDArray[np.float64]
PAGE = ROOT / "docs" / "towers.md"
RESULTS = ROOT / "benchmarks" / "results" / "towers.json"
BEGIN, END = "<!-- figures -->", "<!-- end of figures -->"
FIRST_SEED, SEEDS = 3001, 5
MODES = ("joint", "fan", "paper")
FAR = 5.0  # mm: no level without a flag may be farther off
TOLERANCE = tolerance_from("30mm + h/1000")  # half of most of the towers is beyond it
SPEED_COUNT, MILLION = 20_000_000, 1e6
COMMAND = "python benchmarks/towers.py"


class Outcome(NamedTuple):
    """One way on one scan."""

    case: str
    seed: int
    way: str
    shape: str
    off: Floats  # mm, NaN where there is no answer
    is_flagged: NDArray[np.bool_]
    is_covered: NDArray[np.bool_]  # coordinates within their 95 % intervals
    verdicts: NDArray[np.str_]  # of the levels, on the tolerance
    is_allowed: NDArray[np.bool_]  # levels whose true deviation is within the tolerance
    refusal: str
    cpu: float


# -- runs ------------------------------------------------------------------------------------------


def runs_of(case: Case, seed: int) -> list[Outcome]:
    """Every mode, and the rival, on one scan."""
    scan = case.make(seed)
    points = scan.points()
    cloud = ArrayCloud(points, scan.stations if case.tells_stations else None)
    began = time.process_time()
    options = Options(registration=0.0 if case.tells_stations else scan.registration)
    try:
        shell = shell_of(cloud, options, untracked)
    except MidribError as error:
        return [refused(case, seed, way, str(error)) for way in MODES] + [
            rival(case, seed, scan, points)
        ]
    shared = time.process_time() - began
    found = []
    for mode in MODES:
        began = time.process_time()
        try:
            levels = levels_in(mode, shell, options)
        except MidribError as error:
            found.append(refused(case, seed, mode, str(error)))
            continue
        cpu = shared + time.process_time() - began
        found.append(outcome(case, seed, mode, scan, shell, levels, cpu))
    return [*found, rival(case, seed, scan, points)]


def runs_of_place(place: tuple[int, int]) -> list[Outcome]:
    """Run one scan, by number of the case and seed."""
    return runs_of(CASES[place[0]], place[1])


def all_runs(seeds: range, processes: int) -> list[Outcome]:
    """Run every scan, in order of cases and seeds however many processes there are."""
    places = [(k, seed) for k in range(len(CASES)) for seed in seeds]
    with ProcessPoolExecutor(processes) as pool:
        found = []
        for place, runs in zip(places, pool.map(runs_of_place, places), strict=True):
            found += runs
            print(CASES[place[0]].name, place[1], file=sys.stderr, flush=True)
    return found


def levels_in(mode: str, shell: Shell, options: Options) -> Any:
    """Levels of one mode."""
    if mode == "fan":
        return levels_of(shell, options, fan(shell, options)[0])
    if mode == "paper":
        return levels_of(shell, options, paper(shell, options, untracked)[0])
    return levels_of(shell, options)


def outcome(
    case: Case, seed: int, way: str, scan: Scan, shell: Shell, levels: Any, cpu: float
) -> Outcome:
    """Compare levels with the truth."""
    off = np.column_stack([levels["x"], levels["y"]]) - scan.axis(levels["z"])
    half = 1.96 * np.column_stack([levels["sigma_x"], levels["sigma_y"]])
    known = np.isfinite(off)
    covered = (np.abs(off) <= half)[known]
    mm = 1e3 * np.hypot(*off.T)
    judged, allowed = verdicts(levels, TOLERANCE, 1.0), is_allowed(scan, levels)
    name, flagged = shell.shape.name, levels["flag"] != ""
    return Outcome(case.name, seed, way, name, mm, flagged, covered, judged, allowed, "", cpu)


def is_allowed(scan: Scan, levels: Any) -> NDArray[np.bool_]:
    """Whether the true axis is within the tolerance at levels, from the base that was found."""
    known = np.flatnonzero(np.isfinite(levels["x"]))
    if not known.size:
        return np.zeros(len(levels), dtype=np.bool_)
    base = levels["z"][known[:1]]
    away = np.hypot(*(scan.axis(levels["z"]) - scan.axis(base)).T)
    found: NDArray[np.bool_] = away <= TOLERANCE.at(levels["z"] - base, 1.0)
    return found


def refused(case: Case, seed: int, way: str, why: str) -> Outcome:
    """Nothing, and the reason."""
    none, no_text = np.zeros(0, dtype=np.bool_), np.zeros(0, dtype="U9")
    return Outcome(case.name, seed, way, "", np.zeros(0), none, none, no_text, none, why, 0.0)


def rival(case: Case, seed: int, scan: Scan, points: Floats) -> Outcome:
    """Fit circles level by level: they flag nothing and know no uncertainty."""
    heights = np.arange(0.5, scan.tower.height, 1.0)
    began = time.process_time()
    centres = circle_fits(scan, points, heights)
    cpu = time.process_time() - began
    off = 1e3 * np.hypot(*(centres - scan.axis(heights)).T)
    flags = np.isnan(off)
    none, no_text = np.zeros(0, dtype=np.bool_), np.zeros(0, dtype="U9")
    return Outcome(case.name, seed, "circles", "", off, flags, none, no_text, none, "", cpu)


# -- tables ----------------------------------------------------------------------------------------


def cell(outcomes: list[Outcome]) -> str:
    """RMS of one way in one case: median and worst of the seeds; 95th percentile of all levels."""
    found = rms_of(outcomes)
    if not found:
        return "no answer"
    off = np.concatenate([o.off for o in outcomes])
    p95 = np.nanpercentile(off, 95.0)
    return f"{np.median(found):.2f} / {max(found):.2f} / {p95:.2f}"


def rms_of(outcomes: list[Outcome]) -> list[float]:
    """RMS of each scan that is answered."""
    return [float(np.sqrt(np.nanmean(o.off**2))) for o in outcomes if np.isfinite(o.off).any()]


def table(outcomes: list[Outcome]) -> str:
    """RMS and 95th percentile in mm by case and way."""
    rows = []
    for case in CASES:
        of_case = [o for o in outcomes if o.case == case.name]
        ways = [cell([o for o in of_case if o.way == way]) for way in (*MODES, "circles")]
        rows.append([case.name, *ways, verdict(case, of_case)])
    head = ["scan", *MODES, "circles by level", "goal (joint)"]
    return markdown(head, rows)


def verdict(case: Case, outcomes: list[Outcome]) -> str:
    """Whether the joint mode meets its goal, and by how much not."""
    if case.goal == 0.0:
        return "none: stations decide"
    found = rms_of([o for o in outcomes if o.way == "joint"])
    if not found:
        return "no answer"
    over, worst = float(np.median(found)) - case.goal, max(found) - case.goal
    if over > 0.0:
        return f"{case.goal:g}: missed by {over:.2f}"
    return f"{case.goal:g}: met" + (f", worst not by {worst:.2f}" if worst > 0.0 else "")


def honesty(outcomes: list[Outcome]) -> str:
    """Table of what the joint mode says about itself, by case."""
    rows = []
    for case in CASES:
        some = [o for o in outcomes if o.case == case.name]
        joint = [o for o in some if o.way == "joint"]
        covered = np.concatenate([o.is_covered for o in joint])
        shapes = ", ".join(dict.fromkeys(o.shape or "refused" for o in joint))
        far = [
            sum(int((~o.is_flagged & (o.off > FAR)).sum()) for o in some if o.way == way)
            for way in (*MODES, "circles")
        ]
        flagged = np.concatenate([o.is_flagged for o in joint])
        rows.append(
            [
                case.name,
                shapes,
                f"{100.0 * covered.mean():.0f} %" if covered.size else "",
                f"{100.0 * flagged.mean():.0f} %" if flagged.size else "",
                judged_text(joint),
                ", ".join(map(str, far)),
                f"{np.mean([o.cpu for o in joint]):.0f}",
            ]
        )
    head = ["scan", "sections", "95 % intervals hold", "levels flagged"]
    head += [f"within / undecided / beyond {TOLERANCE.text}; wrong"]
    head += ["without a flag off by more than 5 mm: " + ", ".join((*MODES, "circles")), "CPU, s"]
    return markdown(head, rows)


def judged_text(outcomes: list[Outcome]) -> str:
    """Shares of the levels that are within the tolerance, undecided, beyond it; wrong verdicts."""
    judged = np.concatenate([o.verdicts for o in outcomes])
    allowed = np.concatenate([o.is_allowed for o in outcomes])
    known = judged != ""
    if not known.any():
        return ""
    shares = [100.0 * (judged[known] == name).mean() for name in (WITHIN, UNDECIDED, BEYOND)]
    wrong = ((judged == WITHIN) & ~allowed) | ((judged == BEYOND) & allowed)
    parts = " / ".join(f"{share:.0f}" for share in shares)
    return f"{parts} %; {100.0 * wrong[known].mean():.1f} %"


def figures(outcomes: list[Outcome], seeds: int, speed: str) -> str:
    """Part of the page that is generated."""
    count = CASES[0].make(0).count
    return (
        f"Made by `{COMMAND} --seeds {seeds}` on {machine_text()}; {count:,} points a scan, "
        f"{seeds} scans a row with the seeds {FIRST_SEED} to {FIRST_SEED + seeds - 1}, which "
        f"development did not use.\n\n"
        f"Distance to the true axis, mm: RMS of the median scan / RMS of the worst scan / 95th "
        f"percentile of all levels:\n\n{table(outcomes)}\n{bound_text(PATCHES)}\n"
        f"What the joint mode says about itself, and levels that are wrong in silence:\n\n"
        f"{honesty(outcomes)}\n{speed}"
    )


# -- speed -----------------------------------------------------------------------------------------


def speed_text(count: int) -> str:
    """Points per second and memory for one large file of each kind."""
    kinds = (("npy", 1), ("las", 1), ("laz", 1), ("laz", 3))
    rows = [speed_row(ending, stations, count) for ending, stations in kinds]
    head = ["file", "points", "CPU, s", "million points/s", "most memory, MB"]
    return f"Speed, from the file to the levels, one process:\n\n{markdown(head, rows)}"


def speed_row(ending: str, stations: int, count: int) -> list[str]:
    """Write a file from so many stations, find its axis in a process of its own, tell the cost."""
    import json
    import subprocess

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"scan.{ending}"
        write_scan(path, stations, count)
        done = subprocess.run(
            [sys.executable, __file__, "--measure", str(path)],
            capture_output=True,
            check=True,
            text=True,
        )
    cpu, memory = json.loads(done.stdout.splitlines()[-1])
    rate = count / cpu / MILLION
    told = f", {stations} stations" if stations > 1 else ""
    return [f".{ending}{told}", f"{count:,}", f"{cpu:.1f}", f"{rate:.2f}", f"{memory:.0f}"]


def write_scan(path: Path, stations: int, count: int) -> None:
    """Write a simulated scan; a million points over and over, moved by less than their noise."""
    tower = Tower(lean=0.16, bend=0.03, form_error=0.005)
    scan = Scan(tower, count=min(count, 1_000_000), noise=(0.002, 0.005), outliers=0.01, seed=5)
    points, random = scan.points(), np.random.default_rng(6)
    parts = [len(points)] * (count // len(points))
    moved = (points + random.normal(0.0, 0.001, points.shape) for _ in parts)
    if path.suffix == ".npy":
        table = np.lib.format.open_memmap(path, "w+", np.float64, (count, 3))
        for k, part in enumerate(moved):
            table[k * len(part) : (k + 1) * len(part)] = part
        table.flush()
        return
    import laspy

    header = laspy.LasHeader(point_format=0, version="1.2")
    header.scales = np.full(3, 1e-4)
    with laspy.open(path, "w", header=header) as writer:
        for part in moved:
            record = laspy.ScaleAwarePointRecord.zeros(len(part), header=header)
            record.x, record.y, record.z = part.T
            record.point_source_id = scan.stations % stations
            writer.write_points(record)


def measure(path: Path) -> None:
    """Find the axis of a file and print CPU seconds and the process's largest memory."""
    import json

    tower_axis(Scan(count=20_000).points())  # compiled kernels are loaded
    before = time.process_time()
    tower_axis(path)
    cpu = time.process_time() - before
    open_cloud(path)
    peak = most_memory()
    print(json.dumps([cpu, peak]))


def most_memory() -> float:
    """Most memory of this process, MB: ``getrusage`` may tell that of its parent."""
    status = Path("/proc/self/status").read_text(encoding="ascii")
    line = next(line for line in status.splitlines() if line.startswith("VmHWM"))
    return float(line.split()[1]) / 1024.0


def main() -> None:
    """Measure, print the tables, write page and results."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seeds", type=int, default=SEEDS)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--speed", action="store_true", help="also 20 million points from files")
    parser.add_argument("--measure", type=Path, help=argparse.SUPPRESS)
    chosen = parser.parse_args()
    if chosen.measure:
        measure(chosen.measure)
        return
    outcomes = all_runs(range(FIRST_SEED, FIRST_SEED + chosen.seeds), chosen.processes)
    text = PAGE.read_text(encoding="utf-8")
    head, _, rest = text.partition(BEGIN)
    old, _, tail = rest.partition(END)
    kept = old[old.find("Speed, from") :].rstrip() + "\n" if "Speed, from" in old else ""
    speed = speed_text(SPEED_COUNT) if chosen.speed else kept
    made = figures(outcomes, chosen.seeds, speed)
    PAGE.write_text(f"{head}{BEGIN}\n\n{made}\n{END}{tail}", encoding="utf-8")
    rows = [
        {
            "case": o.case,
            "seed": o.seed,
            "way": o.way,
            "shape": o.shape,
            "rms": cell([o]),
            "refusal": o.refusal,
        }
        for o in outcomes
    ]
    write_json(RESULTS, {"command": COMMAND, "machine": machine(), "runs": rows})
    print(made)


if __name__ == "__main__":
    main()
