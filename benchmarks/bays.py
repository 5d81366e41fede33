"""What leaving out stations in bays does to lines on real areas: docs/bays.md.

python benchmarks/bays.py    some minutes; needs the folder of real layers
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from shapely import Polygon

from real_areas import FOLDER, layers
from ribbons import NEAR, real_run
from scoreboard import number
from tables import ROOT, machine_text, markdown, versions

COMMAND = "python benchmarks/bays.py"
PAGE = ROOT / "docs" / "bays.md"
SAMPLE = 30  # areas of each layer, evenly spread over it
LAYERS = (
    "road parts, verges, water, banks",
    "slopes, Poland",
    "trees and bushes",
    "water and streets, Heidelberg",
    "water and streets, Helsinki",
    "rivers and lakes, simplified",
    "rivers and lakes",
)
WAYS: dict[str, dict[str, Any]] = {
    "none": {"centring": "none", "skip": None},
    "none, bays left out": {"centring": "none", "skip": "bays"},
    "symmetric": {"centring": "symmetric", "skip": None},
    "symmetric, bays left out": {"centring": "symmetric", "skip": "bays"},
    "centred": {"centring": "centred", "skip": None},
    "centred, bays left out": {"centring": "centred", "skip": "bays"},
}
INTRODUCTION = """\
# Bays

Made by `{command}` on {machine}.
{versions}.

A station is in a **bay** if its radius is lopsided: Q sees the main curve nearer than P, by a
factor of 1.5. P is then so far back, in a bay or a side arm, that the middle of PQ is not between
the banks. The factor is a ratio of lengths, so the rule does not depend on scale, unit or place.
`skip="bays"` leaves such stations out, `curve.bays` and a row of `collapse(…, on_error="report")`
say which and how many.

What it does to lines: of each layer {sample} areas five times as long as wide or longer, spread
evenly over it, collapsed with and without, and held against the trunk of the medial axis between
the line's own ends as in [ribbons](ribbons.md). Distances in widths of the place, farther from the
ends than a width. *with bays*: areas of which stations were left out. *stations*: how many of
these areas' stations.

"""
CONCLUSION = """\
The paper's curve follows the trunk better without bays, most of all on rivers and lakes: its median
p95 is a quarter to two fifths smaller there. So `collapse` leaves them out by default with
`centring="none"`. The symmetric curve gains nothing that lasts: the curve from the other bank makes
good what one bank's bays do, and radii are missing where one is left out. The centred line comes
from radii whose Q never travel back and from probes in between, so that radii from bays are not
among them anyway; fewer radii only leave it to find more by itself. There the default is to draw
them all.
"""


@dataclass(frozen=True)
class Found:
    """One layer collapsed in one way."""

    p95: NDArray[np.float64]  # of each area, NaN where there is nothing to compare
    bays: NDArray[np.intp]  # stations left out of each area
    stations: NDArray[np.intp]  # and all of them, where some were left out


def found_on(name: str, areas: Sequence[Polygon], options: dict[str, Any]) -> Found:
    """Collapse areas and measure their lines."""
    import midrib

    lines, problems = midrib.collapse(areas, on_error="report", **options)
    reasons = {p.index: p.reason for p in problems if p.status == "refused"}
    counts = {p.index: p.reason.split() for p in problems if p.status == "bays left out"}
    runs = [
        real_run(name, area, line, reasons.get(i))
        for i, (area, line) in enumerate(zip(areas, lines, strict=True))
    ]
    return Found(
        np.array([np.nan if run.offsets is None else run.offsets.p95 for run in runs]),
        np.array([int(counts[i][0]) if i in counts else 0 for i in range(len(runs))]),
        np.array([int(counts[i][2]) if i in counts else 0 for i in range(len(runs))]),
    )


def table(rows: Sequence[tuple[str, dict[str, Found]]]) -> str:
    """One row for each layer and way, and for all layers together."""
    lines = []
    everything = {
        way: Found(
            *(np.concatenate([getattr(found[way], key) for _, found in rows]) for key in COLUMNS)
        )
        for way in WAYS
    }
    for name, found in [*rows, ("**all**", everything)]:
        known = np.logical_and.reduce([np.isfinite(f.p95) for f in found.values()])
        for way, one in found.items():
            p95, has_bays = one.p95[known], one.bays > 0
            share = one.bays.sum() / max(one.stations.sum(), 1)
            lines.append(
                [
                    name,
                    way,
                    str(int(known.sum())),
                    f"{int(has_bays.sum())}" if has_bays.any() else "",
                    f"{100 * share:.0f} %" if has_bays.any() else "",
                    f"{100 * float(np.mean(p95 <= NEAR)):.0f} %",
                    *(number(float(np.percentile(p95, percent)), 3) for percent in (50, 75, 90)),
                ]
            )
    head = ["", "centring", "areas", "with bays", "stations", f"p95 ≤ {number(NEAR, 1)}"]
    return markdown([*head, "p95: median", "75 %", "90 %"], lines)


COLUMNS = ("p95", "bays", "stations")


def main() -> None:
    """Measure and write the page."""
    rows = []
    for name, areas in layers():
        if name not in LAYERS:
            continue
        some = areas[np.unique(np.linspace(0, len(areas) - 1, SAMPLE).astype(int))]
        rows.append((name, {way: found_on(name, some, o) for way, o in WAYS.items()}))
        print(f"{name}: {len(some)} areas", flush=True)
    if not rows:
        print(f"no real layers in {FOLDER.name}")
        return
    about = ", ".join(f"{k} {v}" for k, v in versions().items())
    text = INTRODUCTION.format(
        command=COMMAND, machine=machine_text(), versions=about, sample=SAMPLE
    )
    PAGE.write_text(f"{text}{table(rows)}\n{CONCLUSION}", encoding="utf-8")
    print(table(rows))


if __name__ == "__main__":
    main()
