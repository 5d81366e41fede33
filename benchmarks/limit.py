"""What a tolerance costs beside samples, and how many stations it needs: docs/limit.md.

python benchmarks/limit.py            all families, under a minute; the page is written

Both ways get the same strip, divided once, and take turns; its preparation is timed too, since
nobody has radii without it. CPU time, best of several turns.
"""

import argparse
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from families import FAMILIES, make
from midrib import minimal_radii, split
from tables import ROOT, machine_text, markdown

PAGE = ROOT / "docs" / "limit.md"
TOLERANCE = "1%"
SIZES = (100, 1000)
TURNS = 5
PLAIN: dict[str, Any] = {"ends": "caps", "end_clearance": None}
HEADER = ("area", "stations", "sampled, ms", "stations", "tolerance, ms", "ratio")


class Row(NamedTuple):
    """One area: stations and milliseconds, with preparation, of either way."""

    name: str
    vertices: int
    sampled: float
    stations: int
    limit: float

    @property
    def ratio(self) -> float:
        """How many times longer a tolerance takes."""
        return self.limit / self.sampled


def measure(family: str, n: int) -> Row:
    """Time both ways on one area."""
    area = make(family, n).area
    strip = split(area)
    corners = np.array(strip.layout.main.arc)
    curve = minimal_radii(strip, tolerance=TOLERANCE, **PLAIN)
    preparation, sampled, limit = np.inf, np.inf, np.inf
    for _ in range(TURNS):
        preparation = min(preparation, cpu_time(lambda: split(area)))
        sampled = min(
            sampled,
            cpu_time(lambda: minimal_radii(strip, stations=corners, vertices=False, **PLAIN)),
        )
        limit = min(limit, cpu_time(lambda: minimal_radii(strip, tolerance=TOLERANCE, **PLAIN)))
    return Row(
        f"{family} {n:,}",
        corners.size,
        1e3 * (preparation + sampled),
        int(np.unique(curve.stations).size),
        1e3 * (preparation + limit),
    )


def cpu_time(work: Callable[[], Any]) -> float:
    """CPU seconds of one call."""
    start = time.process_time()
    work()
    return time.process_time() - start


def page(rows: list[Row]) -> str:
    """Text of the page."""
    table = markdown(
        HEADER,
        [
            (r.name, f"{r.vertices:,}", f"{r.sampled:.2f}", f"{r.stations:,}", f"{r.limit:.2f}",
             f"{r.ratio:.1f}")
            for r in rows
        ],
    )  # fmt: skip
    return f"""# What a tolerance costs

`minimal_radii(strip, tolerance="{TOLERANCE}")` beside sampling at every
vertex of the main curve: stations that each needs, CPU milliseconds for one area, division and
triangulation included, and the ratio of the two times. The aim is a ratio of 2.

Along most sides a glance is enough: a search of the boxes next to the last answer, and one sight.
Where that sight is blocked, P walks through every window that opens anywhere along the side: three
to four times as many as from one point. That costs more than one look from its ends only where most
sights are blocked: in the star of 1,000 vertices, behind whose spikes the curve has 3,025 pieces.

Written by `python benchmarks/limit.py` on {machine_text()}.

{table}
"""


def main() -> None:
    """Measure, and write the page."""
    parser = argparse.ArgumentParser(description="Cost of a tolerance beside samples.")
    parser.parse_args()
    rows = [
        measure(family, n) for n in SIZES for family in FAMILIES if family != "star" or n < 5000
    ]
    PAGE.write_text(page(rows), encoding="utf-8")
    print(page(rows))


if __name__ == "__main__":
    main()
