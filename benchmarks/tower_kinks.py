"""Which kinks of a tower are found, and how many are found that are not there.

python benchmarks/tower_kinks.py            table, into docs/towers.md
python benchmarks/tower_kinks.py --seeds 2  so many scans a cell
"""

import argparse
import sys
from dataclasses import replace
from typing import NamedTuple

import numpy as np

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
WALLS = {  # noise of the points, form error, both in mm; amplitude of an S-bend in mm
    "noise 2 mm": (2.0, 0.0, 0.0),
    "noise 4 mm": (4.0, 0.0, 0.0),
    "noise 4 mm, S-bend of 20 mm": (4.0, 0.0, 20.0),
    "noise 4 mm, form error 5 mm": (4.0, 5.0, 0.0),
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


def tower_with(wall: str, turn: float, seed: int) -> Tower:
    """Make a tower with one kink of a given size at half of its height, in any direction."""
    _, form, bend = WALLS[wall]
    tower = replace(TOWER, bend=1e-3 * bend, form_error=1e-3 * form, seed=seed)
    if turn == 0.0:
        return tower
    unit = replace(tower, kink=1.0, kink_spacing=TOWER.height / 2.0)
    return replace(unit, kink=turn / (1e3 * float(np.hypot(*unit.kinks[1][0]))))


def count_of(wall: str, turn: float, seeds: range) -> Count:
    """Scan towers, find their kinks and compare them with the true ones."""
    found, false, off = 0, 0, []
    for seed in seeds:
        tower = tower_with(wall, turn, seed)
        noise = 1e-3 * WALLS[wall][0]
        scan = Scan(tower, count=COUNT, noise=(noise, noise), outliers=0.01, seed=seed)
        at = np.array([kink.z for kink in tower_axis(scan.points()).kinks])
        near = np.abs(at - TOWER.height / 2.0) <= NEAR if turn else np.zeros(at.size, np.bool_)
        found += bool(near.any())
        false += int((~near).sum())
        off += list(np.abs(at[near] - TOWER.height / 2.0))
    true = len(seeds) if turn else 0
    middle = float(np.median(off)) if off else float("nan")
    return Count(wall, turn, true, found, false, middle, len(seeds))


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
    made = (
        f"Made by `{COMMAND}` on {machine_text()}; towers of {TOWER.height:g} m with one kink, "
        f"{COUNT:,} points a scan, {chosen.seeds} scans a cell with the seeds {seeds[0]} to "
        f"{seeds[-1]}, which development did not use. Found is what is at most {NEAR:g} m off.\n\n"
        f"{table(counts)}"
    )
    text = PAGE.read_text(encoding="utf-8")
    head, _, rest = text.partition(BEGIN)
    _, _, tail = rest.partition(END)
    PAGE.write_text(f"{head}{BEGIN}\n\n{made}\n{END}{tail}", encoding="utf-8")
    rows = [
        count._asdict() | {"off": None if np.isnan(count.off) else count.off} for count in counts
    ]
    write_json(RESULTS, {"command": COMMAND, "machine": machine(), "counts": rows})
    print(made)


if __name__ == "__main__":
    main()
