r"""A slope that others have drawn, beside ours: by which rule, and how far are we from it.

The drawing was made with the QGIS plugin GML Explorer. Its code divides each segment of the top
into the fewest equal parts that are no longer than b. b is half the mean distance from the toe of
the vertices of the top, densified to a fifth of its length: both ends count, where it is 0.

    0 --- 2.0 -- 2.1 -- 2.1 -- 2.2 -- 2.3/ 0     b = (0 + 2.0 + … + 0) / 7 / 2

Writes the table of docs/registers.md.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pyogrio
import shapely
from numpy.typing import NDArray
from shapely import LineString

from midrib import Slope, read_slopes
from midrib.hatching import Hatching, Rule, hatch
from midrib.hatching.rule import with_mean_gap
from tables import ROOT, markdown

__all__ = ["gap_of", "off", "starts_along", "strokes_of"]

Floats = NDArray[np.float64]
SOURCE = ROOT.parent / "shared" / "data" / "pl_szkoleniowy_skarpa_kreski.gpkg"
PAGE = ROOT / "docs" / "registers.md"
BEGIN, END = "<!-- drawing -->", "<!-- end of drawing -->"
STANDARD, THEIRS = "pl-2021-slope-unreinforced", "gml-explorer-like"
HEAD = ("strokes", "count", "gap, m", "theirs within 5° of the nearest of ours", "worst")


def gap_of(slope: Slope) -> float:
    """Gap b of the plugin: half the mean distance of the top's vertices from the toe."""
    return with_mean_gap(Rule(factor=0.5), slope.top, slope.toe).least_gap


def starts_along(slope: Slope, gap: float) -> Floats:
    """Points of the top where the plugin's strokes start: but for its ends, all that divide it."""
    top: LineString = shapely.segmentize(shapely.force_2d(slope.top), gap)
    starts: Floats = shapely.get_coordinates(top)[1:-1]
    return starts


def strokes_of(path: Path) -> tuple[Floats, Floats]:
    """Read starts and stops of the strokes that are drawn; the longer line is the outline."""
    drawn = pyogrio.read_dataframe(path, layer="kreski_wzorcowe").geometry.to_numpy()
    drawn = drawn[shapely.get_num_coordinates(drawn) == 2]
    start, stop = (shapely.get_coordinates(shapely.get_point(drawn, k)) for k in (0, 1))
    return start, stop


def rows() -> list[list[str]]:
    """Rows of the table: theirs, then ours in several ways."""
    (slope,), _ = read_slopes(SOURCE)
    start, stop = strokes_of(SOURCE)
    step = float(np.median(np.hypot(*np.diff(start, axis=0).T)))
    table = [["theirs", str(len(start)), f"{step:.2f}", "", ""]]
    ways: dict[str, dict[str, Any]] = {
        f"ours by `{STANDARD}` at 1:500": {},
        "the same, at right angles to the top": {"top_share": 1.0},
        'ours with `rule="mean"`': {"rule": "mean"},
        "the same, at right angles to both edges alike": {"rule": "mean", "top_share": 0.0},
        f"ours by `{THEIRS}`": {"standard": THEIRS},
    }
    for name, options in ways.items():
        ours = hatch(slope.strip(), **{"standard": STANDARD} | options)
        turned = off(ours, start, stop)
        within = f"{np.count_nonzero(turned <= 5.0)} of {len(start)}"
        spacing = f"{np.median(ours.spacing):.2f}"
        table.append([name, str(len(ours.strokes)), spacing, within, f"{turned.max():.0f}°"])
    return table


def off(ours: Hatching, start: Floats, stop: Floats) -> Floats:
    """Degrees that each of their strokes is turned from the one of ours that starts nearest."""
    near = shapely.STRtree(shapely.points(ours.on_top)).nearest(shapely.points(start))
    turn = angle(ours.on_toe - ours.on_top)[near] - angle(stop - start)
    turned: Floats = abs((turn + 90.0) % 180.0 - 90.0)
    return turned


def angle(ways: Floats) -> Floats:
    """Degrees of directions."""
    degrees: Floats = np.degrees(np.arctan2(*ways.T[::-1]))
    return degrees


def main() -> None:
    """Write the table into the page, if the drawing is there."""
    if not SOURCE.exists():
        print(f"{SOURCE.name} is absent: the page stays as it is")
        return
    text = PAGE.read_text(encoding="utf-8")
    before, _, rest = text.partition(BEGIN)
    after = rest.partition(END)[2]
    told = f"{BEGIN}\n\n{markdown(HEAD, rows())}\nBy `python benchmarks/drawn_by_others.py`.\n{END}"
    PAGE.write_text(f"{before}{told}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
