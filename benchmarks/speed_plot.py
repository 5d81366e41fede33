"""Picture of docs/speed.md: time against size, both logarithmic, a panel for each family.

python benchmarks/speed_plot.py    draws the results that are kept
"""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tables import ROOT

__all__ = ["PICTURE", "draw"]

RESULTS = ROOT / "benchmarks" / "results" / "speed.json"
PICTURE = ROOT / "docs" / "pictures" / "speed.svg"
# Colours that people who see few of them can tell apart; yardsticks, which find no line, are grey.
STYLES: dict[str, dict[str, Any]] = {
    "midrib": {"color": "#7b1fa2", "linewidth": 2.6, "marker": "o", "zorder": 5},
    "triangle script": {"color": "#009e73", "marker": "v"},
    "Voronoi script": {"color": "#56b4e9", "marker": "s"},
    "pygeoops, tuned": {"color": "#e69f00", "marker": "D"},
    "centerline": {"color": "#d55e00", "marker": "^"},
    "earcut": {"color": "0.35", "linestyle": "--"},
    "buffer": {"color": "0.5", "linestyle": "-."},
    "is_valid": {"color": "0.6", "linestyle": ":"},
}


def draw(cells: Sequence[dict[str, Any]], path: Path) -> None:
    """Draw the cells of the families that grow, as they stand in the results."""
    import matplotlib as mpl
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    mpl.rcParams["svg.hashsalt"] = "midrib"
    families = [
        name
        for name in dict.fromkeys(cell["family"] for cell in cells)
        if max(cell["n"] for cell in cells if cell["family"] == name) > 10_000
    ]
    figure = Figure(figsize=(9.0, 7.4), layout="constrained")
    FigureCanvasSVG(figure)
    panels = figure.subplots(2, 2, sharex=True, sharey=True, squeeze=False).ravel()
    for axes, family in zip(panels, families, strict=False):
        for way, style in STYLES.items():
            times = [
                (cell["n"], seconds * 1000.0)
                for cell in cells
                if cell["family"] == family and (seconds := cell["seconds"].get(way)) is not None
            ]
            axes.loglog(*zip(*times, strict=True), label=way, markersize=4.5, **style)
        axes.set_title(family, fontsize=11)
        axes.grid(which="major", color="0.9", linewidth=0.8)
        axes.set_axisbelow(True)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    for axes in panels[2:]:
        axes.set_xlabel("vertices of the area")
    for axes in panels[::2]:
        axes.set_ylabel("CPU time of one call, ms")
    handles, names = panels[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper center", ncols=4, frameon=False, fontsize=9)
    figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    draw(json.loads(RESULTS.read_text(encoding="utf-8"))["cells"], PICTURE)
