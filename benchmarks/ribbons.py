"""Quality of midrib and of its rivals where the axis is known, and on real areas: docs/ribbons.md.

python benchmarks/ribbons.py               table, results and contact sheets, some minutes
python benchmarks/ribbons.py --generated   without the real areas; written to out/ only
"""

import argparse
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from itertools import chain
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString
from shapely.geometry.base import BaseGeometry

from families import Case
from offsets import MEASURES, P95, STEPS_PER_WIDTH, Known, Offsets, offsets_of
from real_areas import FOLDER, layers
from reference import axis_of
from ribbon_shapes import KINDS, Ribbon, make_ribbon
from rivals import MIDRIB, RIVALS, VARIANTS, Way, available, line_by
from scoreboard import MISSING, number, rounded
from sheets import Panel, draw_sheet
from tables import ROOT, machine, machine_text, markdown, versions, write_json

COMMAND = "python benchmarks/ribbons.py"
RESULTS = ROOT / "benchmarks" / "results" / "ribbons.json"
PAGE = ROOT / "docs" / "ribbons.md"
OUT = ROOT / "out"

SEEDS, FEW = 12, 3  # ribbons of each kind; those held against their own medial axes
SAMPLES = 20  # of a real area's boundary for each width
MORE, MOST_SAMPLES = 5, 100_000  # times as many where the trunk is in pieces; all in all
NEAR = 0.1  # p95 that is still near the trunk, in local widths
STEP = 1e-3  # of the width: where a line is seen to have left its end
SHEET, ZOOM = 24, 2.5  # areas of a contact sheet; widths around the worst place, shown again


@dataclass(frozen=True, eq=False)
class Run:
    """One area collapsed in one way."""

    case: Case
    way: Way
    line: BaseGeometry | None
    known: Known | None  # None where the reference is in pieces
    offsets: Offsets | None  # None where there is nothing to compare
    error: str | None

    @property
    def is_good(self) -> bool:
        """Whether there is one line, nowhere meeting itself, inside."""
        return self.offsets is not None and self.offsets.is_one_line and self.offsets.is_inside

    def as_record(self) -> dict[str, Any]:
        """Everything measured, for the results file."""
        numbers = {} if self.offsets is None else asdict(self.offsets)
        for name in ("place", "end_place"):  # for pictures only
            numbers.pop(name, None)
        return {
            "area": self.case.family,
            "way": self.way.name,
            **{key: rounded(value) for key, value in numbers.items()},
            "error": self.error,
        }


def ribbon_runs(ways: Sequence[Way]) -> list[Run]:
    """Every ribbon collapsed in every way."""
    runs = []
    for kind in KINDS:
        for seed in range(SEEDS):
            ribbon = make_ribbon(kind, seed)
            axis_for = known_axis(ribbon)
            runs += [one_run(ribbon.case, way, axis_for) for way in ways]
        print(f"{kind}: {SEEDS} ribbons", flush=True)
    return runs


def known_axis(ribbon: Ribbon) -> Callable[[BaseGeometry], Known]:
    """Give a ribbon's axis; past islands, its trunk on the side where the line is."""
    if not ribbon.case.area.interiors:
        known = Known(ribbon.axis, ribbon.width)
        return lambda _: known
    axis = axis_of(ribbon.case)
    return lambda line: with_width(ribbon.case, axis.trunk(line))


def with_width(case: Case, trunk: LineString) -> Known:
    """Measure the width of an area along its trunk, holes included."""
    from midrib import measures

    points = shapely.get_coordinates(trunk.segmentize(case.width / SAMPLES))
    return Known(points, measures.width(LineString(points), case.area))


def one_run(case: Case, way: Way, axis_for: Callable[[BaseGeometry], Known]) -> Run:
    """Collapse one area in one way and measure the line."""
    line, error = line_by(way, case)
    if line is None or line.is_empty:
        return Run(case, way, None, None, None, error or "no line")
    known = axis_for(line)
    is_exact = "midrib" in way.packages
    return Run(case, way, line, known, offsets_of(case, known, line, is_exact=is_exact), None)


def real_runs() -> Iterator[tuple[str, list[Run]]]:
    """Midrib's lines on real areas against the trunks between the same ends, layer by layer."""
    import midrib

    for name, areas in layers():
        lines, problems = midrib.collapse(areas, on_error="report")
        reasons = {problem.index: problem.reason for problem in problems}
        pairs = enumerate(zip(areas, lines, strict=True))
        yield name, [real_run(name, area, line, reasons.get(i)) for i, (area, line) in pairs]
        print(f"{name}: {len(areas)} areas", flush=True)


def real_run(name: str, area: Any, line: LineString | None, reason: str | None) -> Run:
    """Hold one line against the trunk between its own ends.

    An end may be where two places of the area meet across a thin wall, and even a step along the
    line tells which of the two it is.
    """
    ends = np.zeros((2, 2))
    case = Case(name, shapely.get_num_coordinates(area), area, ends, ends, ends)
    if line is None:
        return Run(case, MIDRIB, None, None, None, reason)
    step = STEP * min(case.width, line.length)
    ends = shapely.get_coordinates(line.interpolate([step, line.length - step]))
    case = replace(case, ends=ends, left=ends, right=ends)
    most = max(1, int(MOST_SAMPLES * case.width / case.area.length))
    for samples in sorted({min(SAMPLES, most), min(MORE * SAMPLES, most)}):
        try:
            known = with_width(case, axis_of(case, samples).trunk(line))
        except RuntimeError:  # in pieces where it is narrower than the distance of the samples
            continue
        return Run(case, MIDRIB, line, known, offsets_of(case, known, line, is_exact=True), None)
    return Run(case, MIDRIB, line, None, None, "trunk in pieces")


HEAD = ["", "median", "p95", "worst p95", "ends p95", "end from end", "failures"]


def kind_table(runs: Sequence[Run], ways: Sequence[Way]) -> str:
    """One row for each way; figures of the ribbon in the middle, and of the worst."""
    rows = []
    for way in ways:
        mine = [run for run in runs if run.way is way]
        found = [run.offsets for run in mine if run.offsets is not None]
        cells = [MISSING] * 5
        if found:
            middle = [float(np.median([getattr(o, name) for o in found])) for name in MEASURES]
            worst = max(o.p95 for o in found)
            ends = float(np.median([o.from_ends for o in found]))
            cells = [number(v, 3) for v in (middle[0], middle[1], worst, middle[2], ends)]
        failures = sum(not run.is_good for run in mine)
        rows.append([way.name, *cells, f"{failures} of {len(mine)}" if failures else "0"])
    return markdown(HEAD, rows)


def overview(runs: Sequence[Run], ways: Sequence[Way], measure: str) -> str:
    """One measure, kind by kind: of each the ribbon in the middle."""
    rows = []
    for kind in KINDS:
        cells = []
        for way in ways:
            found = [
                getattr(run.offsets, measure)
                for run in runs
                if run.way is way and run.case.family == kind and run.offsets is not None
            ]
            cells.append(number(float(np.median(found)), 3) if found else MISSING)
        rows.append([kind, *cells])
    return markdown(["", *(way.name for way in ways)], rows)


CENTRED = (MIDRIB.name, "midrib, tolerance 0")


def centred_table(runs: Sequence[Run]) -> str:
    """One row for each kind without islands: how far off the middle and off the trunk lines are."""
    rows = []
    for kind in KINDS:
        mine = [run for run in runs if run.case.family == kind and run.way.name in CENTRED]
        if any(run.case.area.interiors for run in mine):
            continue
        cells = []
        for name in CENTRED:
            named = [run for run in mine if run.way.name == name]
            found = [off_middle(run.case, run.line) for run in named[:FEW] if run.line is not None]
            if not found:
                cells += [MISSING] * 4
                continue
            for column in np.array(found).T:
                cells += [number(float(figure), 4) for figure in (np.median(column), column.max())]
        rows.append([kind, *cells])
    head = ["centredness p95", "worst", "off the trunk p95", "worst"]
    return markdown(["", *head, *(f"{text}, tolerance 0" for text in head)], rows)


def off_middle(case: Case, line: BaseGeometry) -> tuple[float, float]:
    """P95 of the centredness of a line, and of its distance from the trunk in widths.

    Both away from the ends, in equal steps.
    """
    from midrib import measures, split

    w = case.width
    count = max(2, int(np.ceil(STEPS_PER_WIDTH * line.length / w)))
    at = np.linspace(w, line.length - w, count)
    points = line.interpolate(at)
    inner = LineString(shapely.get_coordinates(points))
    lean = measures.centredness(inner, split(case.area))
    off = shapely.distance(points, trunk_of(case)) / w
    return float(np.percentile(lean, P95)), float(np.percentile(off, P95))


@lru_cache
def trunk_of(case: Case) -> LineString:
    """Trunk of the sampled medial axis of an area without holes."""
    return axis_of(case).trunk()


def left_over(layers_of_runs: Sequence[tuple[str, Sequence[Run]]]) -> str:
    """One row for each real area whose line is not near its trunk, with the cause."""
    rows = [
        [name, str(i), number(run.offsets.p95, 2), CAUSES.get((name, i), "not looked into")]
        for name, runs in layers_of_runs
        for i, run in enumerate(runs)
        if run.offsets is not None and run.offsets.p95 > NEAR
    ]
    return markdown(["", "position", "p95", "cause"], rows)


def real_table(layers_of_runs: Sequence[tuple[str, Sequence[Run]]]) -> str:
    """One row for each layer, and one for all of them."""
    everything = list(chain.from_iterable(runs for _, runs in layers_of_runs))
    rows = []
    for name, runs in [*layers_of_runs, ("**all**", everything)]:
        p95 = p95_of(runs)
        if not p95.size:
            continue
        missing = [run for run in runs if run.offsets is None]
        rows.append(
            [
                name,
                f"{len(runs):,}",
                f"{100 * float(np.mean(p95 <= NEAR)):.1f} %",
                number(float(np.median([o.median for o in found_in(runs)])), 3),
                *(number(float(np.percentile(p95, percent)), 3) for percent in (50, 90, 95)),
                number(float(p95.max()), 2),
                str(sum(not run.is_good for run in runs) - len(missing)),
                str(len(missing)),
            ]
        )
    head = ["", "areas", f"p95 ≤ {number(NEAR, 1)}", "median", "p95: median", "90 %", "95 %"]
    return markdown([*head, "largest", "not one line inside", "not compared"], rows)


def found_in(runs: Sequence[Run]) -> list[Offsets]:
    """Offsets of the runs that have some away from the ends."""
    return [run.offsets for run in runs if run.offsets is not None and np.isfinite(run.offsets.p95)]


def p95_of(runs: Sequence[Run]) -> NDArray[np.float64]:
    """List the p95 of each run that has one."""
    return np.array([offsets.p95 for offsets in found_in(runs)])


INTRODUCTION = """\
# Ribbons

Made by `{command}` on {machine}.
{versions}.

How far lines are from where they should be, in widths of the place: areas drawn about a known axis
(`benchmarks/ribbon_shapes.py`), and real ones. Distances are taken from places on the line to the
axis and from places on the axis to the line; the larger figure counts.

- **median**, **p95**: distance to the axis, farther from its ends than the average width w; of
  {seeds} ribbons of the kind the one in the middle. **worst p95**: the largest of the {seeds}.
- **ends p95**: the same nearer to the ends than w, in w.
- **end from end**: how far the line's farther end is from the axis' end, in w.
- **failures**: no line; several, or one that meets itself; or one that is not inside (midrib's by
  exact predicates, a rival's but for 1e-9 w).

Ribbons are 40 w long; banks have vertices at random, w / 10 apart on average, uneven ones w / 20
and w / 2. Roughness moves each vertex of both banks across by up to so much. Where there are
islands the axis is the trunk of the medial axis, on the side where the line passes. Lines with
branches are measured as they are.

"""
MIDDLE = """\
## In the middle

How far lines are off the middle, farther from the ends than w, at w / 25: *centredness*, the
difference of the distances to the two banks over their sum (`midrib.measures.centredness`), and the
distance from the trunk of the medial axis (from boundary points w / 60 apart) in w. Of the
first {few} ribbons of the kind the one in the middle, and the worst. By default lines may be off by
.01 of the mean width, which is a centredness of .02.

"""
REST = """\
What is left, by position in its layer:

"""
SQUARE = "a wide flat end: the line leads to its middle, the medial axis into its corners"
LAKE = "a lake with 25 islands"
FIELD = "a square field with 14 buildings, no strip"
TOUCH = "a hole that touches a flat end: half of it goes with either bank"
OPEN = "straight across open water beside an island, where probes lead back to points it has"
NARROW = "much narrower there than on average: the tolerance is .01 of the mean width"
THREAD = "the area goes on as a thread of next to no width, in which the distance is measured"
ROADS, JUNCTIONS = "road parts, verges, water, banks", "roads and junctions"
CAUSES = {
    (ROADS, 140): SQUARE,
    (ROADS, 192): NARROW,
    (ROADS, 225): SQUARE,
    (ROADS, 255): NARROW,
    (ROADS, 429): SQUARE,
    (ROADS, 447): FIELD,
    (ROADS, 836): TOUCH,
    ("water and streets, Heidelberg", 31): SQUARE,
    (JUNCTIONS, 209): THREAD,
    (JUNCTIONS, 211): THREAD,
    (JUNCTIONS, 400): THREAD,
    (JUNCTIONS, 494): SQUARE,
    ("rivers and lakes, simplified", 351): OPEN,
    ("rivers and lakes, simplified", 560): LAKE,
}
REAL = """\
## Real areas

`midrib.collapse(area)` on every area whose rectangle of the same area and perimeter is at least
five times as long as wide, against the trunk of the medial axis between the line's own ends (from
the Voronoi diagram of boundary points w / {samples} apart, of at most {most}), in widths of the
place, farther from the ends than w. Degrees are made metres at the area's middle latitude.
*not compared*: refused, or the sampled trunk is in pieces.

Without islands there is one trunk between two ends, and that is it. With islands the medial axis
is a net; there the trunk is the way through it that stays nearest to the line: of all ways from end
to end the one with the least integral of the distance to the line. So it says how far the line is
from the middle of the channels that it takes, not whether others would have been better: for that
there is `channel="wider"`. It starts from where the line has left its end by w / 1000, on the same
side of every wall.

"""


def page(
    runs: Sequence[Run],
    ways: Sequence[Way],
    notes: Sequence[str],
    layers_of_runs: Sequence[tuple[str, Sequence[Run]]],
) -> str:
    """Page of the documentation."""
    parts = [
        INTRODUCTION.format(
            command=COMMAND,
            machine=machine_text(),
            versions=", ".join(f"{k} {v}" for k, v in versions().items()),
            seeds=SEEDS,
        ),
        "".join(f"- {way.name}: {way.about}\n" for way in ways) + "\n",
        "".join(f"{note}\n\n" for note in notes),
        f"## Median, all kinds\n\n{overview(runs, ways, 'median')}\n",
        f"## p95, all kinds\n\n{overview(runs, ways, 'p95')}\n",
    ]
    for kind in KINDS:
        some = [run for run in runs if run.case.family == kind]
        parts.append(f"## {kind[0].upper()}{kind[1:]}\n\n{kind_table(some, ways)}\n")
    parts.append(f"{MIDDLE.format(few=FEW)}{centred_table(runs)}\n")
    if layers_of_runs:
        parts.append(
            REAL.format(samples=SAMPLES, most=f"{MOST_SAMPLES:,}") + real_table(layers_of_runs)
        )
        parts.append(f"\n{REST}{left_over(layers_of_runs)}")
    return "".join(parts).rstrip() + "\n"


def real_record(runs: Sequence[Run]) -> dict[str, list[Any]]:
    """Figures of the areas of a layer, in its order; None where there are none."""
    return {
        name: [None if r.offsets is None else rounded(getattr(r.offsets, name)) for r in runs]
        for name in MEASURES
    }


def draw_sheets(runs: Sequence[Run], name: str) -> None:
    """Contact sheets of midrib's lines: some at random, and the worst by each measure."""
    drawn = [run for run in runs if run.offsets is not None and run.known is not None]
    some = np.random.default_rng(0).permutation(len(drawn))[:SHEET]
    panels = [panel(drawn[i], "p95") for i in sorted(some)]
    draw_sheet(panels, OUT / f"{name}_random.png")
    for measure in MEASURES:
        worst = sorted(drawn, key=lambda run: -np.nan_to_num(getattr(run.offsets, measure)))
        panels = [panel(run, measure) for run in worst[:SHEET]]
        draw_sheet(panels, OUT / f"{name}_worst_{measure}.png")


def panel(run: Run, measure: str) -> Panel:
    """One area with its axis and line, named with a figure."""
    if run.known is None or run.offsets is None:
        msg = "a run without an axis has no picture"
        raise ValueError(msg)
    title = f"{run.case.family}: {measure} {getattr(run.offsets, measure):.3f} w"
    points, half = run.known.points, ZOOM * run.case.width
    x, y = run.offsets.end_place if measure == "ends" else run.offsets.place
    return Panel(title, run.case.area, points, run.line, points[[0, -1]], (x, y, half))


def main() -> None:
    """Measure, print the summary, write table, results and sheets."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--generated", action="store_true", help="leave the real areas out")
    options = parser.parse_args()
    variants, notes = available(VARIANTS)
    ways = (MIDRIB, *variants, *RIVALS)
    runs = ribbon_runs(ways)
    real = [] if options.generated else list(real_runs())
    if not real and not options.generated:
        print(f"no real layers in {FOLDER.name}, only generated ribbons")
    text = page(runs, ways, notes, real)
    target = OUT / PAGE.name if options.generated else PAGE
    target.parent.mkdir(exist_ok=True)
    target.write_text(text, encoding="utf-8")
    everything = list(chain.from_iterable(some for _, some in real))
    if not options.generated:
        about = {"command": COMMAND, "machine": machine(), "versions": versions(), "notes": notes}
        records = {name: real_record(some) for name, some in real}
        write_json(RESULTS, {**about, "runs": [r.as_record() for r in runs], "real": records})
    print(overview(runs, ways, "median"), overview(runs, ways, "p95"), sep="\n")
    draw_sheets([run for run in runs if run.way is MIDRIB], "ribbons")
    if real:
        print(real_table(real))
        draw_sheets(everything, "areas")


if __name__ == "__main__":
    main()
