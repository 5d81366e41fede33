"""Which kinks and offsets of a tower are found, and how many are found that are not there.

python benchmarks/tower_kinks.py            tables, into docs/towers.md
python benchmarks/tower_kinks.py --seeds 2  so many scans a cell
"""

import argparse
import sys
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from midrib.scans import tower_axis
from midrib.towers.simulate import Scan, Tower
from tables import ROOT, machine, machine_text, markdown, write_json

PAGE = ROOT / "docs" / "towers.md"
RESULTS = ROOT / "benchmarks" / "results" / "tower_kinks.json"
BEGIN, END = "<!-- kinks -->", "<!-- end of kinks -->"
COMMAND = "python benchmarks/tower_kinks.py"
FIRST_SEED, SEEDS, COUNT = 5001, 3, 150_000
NEAR = 2.0  # metres: a kink that is found so far from a true one is that
TOWER = Tower(height=60.0, base_radius=2.5, top_radius=1.5, lean=0.1)
TURNS = (0.5, 1.0, 2.0)  # mm per m
STEPS = (3.0, 8.0, 20.0)  # mm
FAR = 5.0  # mm: no level without a flag may be farther off


class Wall(NamedTuple):
    """What hides kinks and offsets; mm, but for the length."""

    noise: float
    form: float = 0.0
    bend: float = 0.0  # amplitude of an S-bend
    length: float = 0.1  # correlation length of the form error, m


WALLS = {
    "noise 2 mm": Wall(2.0),
    "noise 4 mm": Wall(4.0),
    "noise 4 mm, S-bend of 20 mm": Wall(4.0, bend=20.0),
    "noise 4 mm, form error 5 mm": Wall(4.0, form=5.0),
    "the same in patches of 1 m": Wall(4.0, form=5.0, length=1.0),
}


class Count(NamedTuple):
    """What came out of the scans of one kind."""

    wall: str
    turn: float  # mm per m; 0 if there are no kinks
    true: int
    found: int
    false: int
    off: float  # m, median of those found
    scans: int


class Step(NamedTuple):
    """What came out of the scans with one offset each."""

    wall: str
    size: float  # mm
    scans: int
    found: int
    false: int  # kinks, and offsets elsewhere
    off: float  # mm: median error of the sizes that were found
    far: int  # levels without a flag that are off by more than 5 mm


def tower_with(wall: str, turn: float, seed: int) -> Tower:
    """Make a tower with one kink of a given size at half of its height, in any direction."""
    kind = WALLS[wall]
    tower = replace(TOWER, bend=1e-3 * kind.bend, seed=seed)
    tower = replace(tower, form_error=1e-3 * kind.form, form_length=kind.length)
    if turn == 0.0:
        return tower
    unit = replace(tower, kink=1.0, kink_spacing=TOWER.height / 2.0)
    return replace(unit, kink=turn / (1e3 * float(np.hypot(*unit.kinks[1][0]))))


def scan_of(wall: str, tower: Tower, seed: int) -> Scan:
    """Scan a tower."""
    noise = 1e-3 * WALLS[wall].noise
    return Scan(tower, count=COUNT, noise=(noise, noise), outliers=0.01, seed=seed)


def is_near(heights: list[float]) -> NDArray[np.bool_]:
    """Which heights are near the middle of the tower."""
    found: NDArray[np.bool_] = np.abs(np.array(heights) - TOWER.height / 2.0) <= NEAR
    return found


def count_of(wall: str, turn: float, seeds: range) -> Count:
    """Scan towers, find their kinks and compare them with the true ones; offsets are false."""
    found, false, off = 0, 0, []
    for seed in seeds:
        axis = tower_axis(scan_of(wall, tower_with(wall, turn, seed), seed).points())
        at = [kink.z for kink in axis.kinks]
        near = is_near(at) & (turn > 0.0)
        found += bool(near.any())
        false += int((~near).sum()) + len(axis.offsets)
        off += list(np.abs(np.array(at)[near] - TOWER.height / 2.0))
    true = len(seeds) if turn else 0
    middle = float(np.median(off)) if off else float("nan")
    return Count(wall, turn, true, found, false, middle, len(seeds))


def step_of(wall: str, size: float, seeds: range) -> Step:
    """Scan towers with an offset near half of the height, and compare."""
    found, false, far, off = 0, 0, 0, []
    for seed in seeds:
        at = TOWER.height / 2.0 + 0.2
        tower = replace(tower_with(wall, 0.0, seed), offset=1e-3 * size, offset_height=at)
        scan = scan_of(wall, tower, seed)
        axis = tower_axis(scan.points())
        near = is_near([offset.z for offset in axis.offsets])
        found += bool(near.any())
        false += int((~near).sum()) + len(axis.kinks)
        sizes = 1e3 * np.array([offset.size for offset in axis.offsets])
        off += list(np.abs(sizes[near] - size))
        levels = axis.levels
        away = np.column_stack([levels["x"], levels["y"]]) - scan.axis(levels["z"])
        far += int(((levels["flag"] == "") & (1e3 * np.hypot(*away.T) > FAR)).sum())
    middle = float(np.median(off)) if off else float("nan")
    return Step(wall, size, len(seeds), found, false, middle, far)


def table(counts: list[Count]) -> str:
    """Show missed and false kinks by wall and size."""
    head = ["wall", "no kink: false", *(f"{turn:g} mm/m: missed, false, off" for turn in TURNS)]
    rows = []
    for wall in WALLS:
        cells = []
        for c in (c for c in counts if c.wall == wall):
            off = "" if np.isnan(c.off) else f", {c.off:.1f} m"
            missed = f"{c.true - c.found} of {c.true}, " if c.true else ""
            cells.append(f"{missed}{c.false}{off}" if c.true else f"{c.false} in {c.scans}")
        rows.append([wall, *cells])
    return markdown(head, rows)


def step_table(steps: list[Step]) -> str:
    """Show missed and false offsets by wall and size."""
    head = ["wall", *(f"{size:g} mm: missed, false, off; far" for size in STEPS)]
    rows = []
    for wall in WALLS:
        cells = []
        for c in (c for c in steps if c.wall == wall):
            off = "" if np.isnan(c.off) else f", {c.off:.1f} mm"
            cells.append(f"{c.scans - c.found} of {c.scans}, {c.false}{off}; {c.far}")
        rows.append([wall, *cells])
    return markdown(head, rows)


def main() -> None:
    """Count, print the table, write page and results."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seeds", type=int, default=SEEDS)
    chosen = parser.parse_args()
    seeds = range(FIRST_SEED, FIRST_SEED + chosen.seeds)
    counts = []
    for wall in WALLS:
        for turn in (0.0, *TURNS):
            counts.append(count_of(wall, turn, seeds))
            print(counts[-1], file=sys.stderr, flush=True)
    steps = [step_of(wall, size, seeds) for wall in WALLS for size in STEPS]
    made = (
        f"Made by `{COMMAND}` on {machine_text()}; towers of {TOWER.height:g} m with one kink or "
        f"offset, {COUNT:,} points a scan, {chosen.seeds} scans a cell, seeds {seeds[0]} to "
        f"{seeds[-1]}, which development did not use. Found is what is at most {NEAR:g} m off.\n\n"
        f"{table(counts)}\n"
        f"Offsets; far are levels without a flag that are off by more than {FAR:g} mm:\n\n"
        f"{step_table(steps)}"
    )
    text = PAGE.read_text(encoding="utf-8")
    head, _, rest = text.partition(BEGIN)
    _, _, tail = rest.partition(END)
    PAGE.write_text(f"{head}{BEGIN}\n\n{made}\n{END}{tail}", encoding="utf-8")
    rows = [
        [row._asdict() | {"off": None if np.isnan(row.off) else row.off} for row in found]
        for found in (counts, steps)
    ]
    write_json(
        RESULTS,
        {"command": COMMAND, "machine": machine(), "counts": rows[0], "offsets": rows[1]},
    )
    print(made)


if __name__ == "__main__":
    main()
