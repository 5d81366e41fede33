"""Quality of midrib and of its rivals on ten families of areas: docs/quality.md.

python benchmarks/scoreboard.py            table and results
python benchmarks/scoreboard.py --sheet    also out/contact_sheet.png: all areas, to look at
"""

import argparse
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from families import FAMILIES, Case, make
from reference import Axis, axis_of
from rivals import MIDRIB, RIVALS, Way, line_by
from score import COLUMNS, NOTHING, Score, score_of
from sheets import Panel, draw_sheet
from tables import ROOT, machine, machine_text, markdown, versions, write_json

SIZES = (100, 1000)
RESULTS = ROOT / "benchmarks" / "results" / "quality.json"
PAGE = ROOT / "docs" / "quality.md"
SHEET = ROOT / "out" / "contact_sheet.png"
MISSING = "\N{EN DASH}"
COMMAND = "python benchmarks/scoreboard.py"


@dataclass(frozen=True, eq=False)
class Run:
    """One area collapsed in one way."""

    case: Case
    axis: Axis
    way: Way
    line: BaseGeometry | None
    score: Score
    error: str | None

    def as_record(self) -> dict[str, Any]:
        """Everything measured, for the results file."""
        about = {"family": self.case.family, "n": self.case.n, "way": self.way.name}
        answers = dict(zip(COLUMNS, self.score.answers, strict=True))
        numbers = asdict(self.score)
        return {
            **about,
            "answers": answers,
            "numbers": {k: rounded(v) for k, v in numbers.items()},
            "error": self.error,
        }


def rounded(value: Any) -> Any:
    """Numbers with the digits that mean something; what is infinite is None."""
    if isinstance(value, tuple):
        return [rounded(v) for v in value]
    if isinstance(value, bool):
        return value
    return float(f"{value:.4g}") if np.isfinite(value) else None


def all_runs(families: tuple[str, ...], sizes: tuple[int, ...], ways: tuple[Way, ...]) -> list[Run]:
    """Collapse every area in every way."""
    runs = []
    for family in families:
        for n in sizes:
            case = make(family, n)
            axis = axis_of(case)
            runs += [one_run(case, axis, way) for way in ways]
    return runs


def one_run(case: Case, axis: Axis, way: Way) -> Run:
    """Collapse one area; a way that fails has no line."""
    line, error = line_by(way, case)
    score = score_of(case, axis, line, is_exact=way is MIDRIB)
    return Run(case, axis, way, line, score, error)


def summary(runs: list[Run], ways: tuple[Way, ...]) -> str:
    """How many runs of each way are clean, column by column."""
    rows = []
    for way in ways:
        scores = [run.score for run in runs if run.way is way]
        counts = [str(sum(column)) for column in zip(*(s.answers for s in scores), strict=True)]
        offset = float(np.median([s.offset for s in scores]))
        five = sum(all(s.answers[:-1]) for s in scores)
        clean = sum(s.is_clean for s in scores)
        rows.append([way.name, *counts, str(five), f"**{clean}**", number(offset, 3)])
    return markdown(["", *COLUMNS, "first five", "all six", "median offset, w"], rows)


def details(runs: list[Run]) -> str:
    """Numbers behind the answers, one row for each area."""
    head = ["area", "offset: mean", "p95", "max", "covered", "ends from boundary"]
    head += ["from expected ends", "length / trunk", "fails"]
    rows = []
    for run in runs:
        s = run.score
        if s is NOTHING:
            rows.append([run.case.name, *[""] * 7, run.error or "no line"])
            continue
        fails = [name for name, yes in zip(COLUMNS, s.answers, strict=True) if not yes]
        rows.append(
            [
                run.case.name,
                *(number(v, 3) for v in (s.offset, s.offset_p95, s.offset_max, s.covered)),
                " / ".join(number(v, 2) for v in s.from_boundary),
                " / ".join(number(v, 2) for v in s.from_ends),
                number(s.stretch, 2),
                ", ".join(fails),
            ]
        )
    return markdown(head, rows)


def number(value: float, digits: int) -> str:
    """Write a number without its leading zero."""
    if not np.isfinite(value):
        return MISSING
    text = f"{value:.{digits}f}"
    return text[1:] if text.startswith("0.") else text


INTRODUCTION = """\
# Quality

Made by `{command}` on {machine}.
{versions}.

Ten families of areas (`benchmarks/families.py`) with {sizes} vertices. w is the average
width of an area: that of the rectangle with its area and perimeter. The *trunk* is the part of the
medial axis between the two ends a person would expect, from the Voronoi diagram of boundary points
w / 60 apart; past an island it runs on the side where the line does.

- **one line**: a LineString that nowhere meets itself.
- **inside**: midrib's line is covered by the area, by exact predicates; a rival's is outside for at
  most 1e-9 of length.
- **within .1 w**: the mean *offset*, the distance from line to trunk and from trunk to line, is at
  most .1 w. What is nearer than w to an end of the trunk does not count (of a short trunk, its
  outer quarters).
  Below are mean, 95th percentile and maximum, of both directions the larger.
- **whole trunk**: the line is within w / 2 of at least 95 % of the trunk, not counting w / 2 at
  both ends (*covered*).
- **ends on boundary**: both ends are at most .02 w from the boundary.
- **ends in the middle**: both ends are at most .25 w from the expected ends.

*length / trunk* is the line's length over the trunk's: far above 1, the line zigzags.

"""


def page(runs: list[Run], ways: tuple[Way, ...]) -> str:
    """Page of the documentation."""
    solid = [run for run in runs if not run.case.area.interiors]
    holed = [run for run in runs if run.case.area.interiors]
    sizes = " and ".join(f"{n:,}" for n in sorted({run.case.n for run in runs}))
    parts = [
        INTRODUCTION.format(
            command=COMMAND,
            machine=machine_text(),
            versions=", ".join(f"{k} {v}" for k, v in versions().items()),
            sizes=sizes,
        )
    ]
    for title, some in (("Areas without holes", solid), ("Areas with holes", holed)):
        if some:
            count = len(some) // len(ways)
            parts.append(f"## {title}: {count} runs\n\n{summary(some, ways)}\n")
    for way in ways:
        parts.append(f"## {way.name}\n\n{way.about}\n\n")
        parts.append(details([run for run in runs if run.way is way]) + "\n")
    return "".join(parts).rstrip() + "\n"


def panel(run: Run) -> Panel:
    """One area with its trunk and the line."""
    title = run.case.name if run.score.is_clean else f"{run.case.name}: fails"
    trunk = shapely.get_coordinates(run.axis.trunk(run.line))
    return Panel(title, run.case.area, trunk, run.line, run.case.ends)


def main() -> None:
    """Measure, print the summary, write table, results and sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--sheet", action="store_true", help=f"draw {SHEET.name}, too")
    options = parser.parse_args()
    ways = (MIDRIB, *RIVALS)
    runs = all_runs(FAMILIES, SIZES, ways)
    PAGE.parent.mkdir(exist_ok=True)
    PAGE.write_text(page(runs, ways), encoding="utf-8")
    about = {"command": COMMAND, "machine": machine(), "versions": versions()}
    write_json(RESULTS, {**about, "runs": [run.as_record() for run in runs]})
    print(summary(runs, ways))
    print(details([run for run in runs if run.way is MIDRIB]))
    if options.sheet:
        panels = [panel(run) for run in runs if run.way is MIDRIB]
        draw_sheet(panels, SHEET)


if __name__ == "__main__":
    main()
