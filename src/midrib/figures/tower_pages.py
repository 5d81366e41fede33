"""Pages of a tower's report: figures on A4, the same for the screen and for print."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.checks import check_library
from midrib.figures.paper import FONT, INCH, TEXT
from midrib.figures.tower_plots import (
    plot_deviation,
    plot_plan,
    plot_radius,
    plot_section,
    plot_shell,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from midrib.towers.records import TowerAxis
    from midrib.towers.tolerance import Tolerance

__all__ = [
    "HEIGHTS",
    "WIDTH",
    "Sheet",
    "draw_deviation",
    "draw_plan",
    "draw_sections",
    "draw_shell",
    "sheet_of",
]

# Sizes on paper in millimetres.
WIDTH = 180.0
DEVIATION_HEIGHT, PLAN_HEIGHT, SHELL_HEIGHT, SECTIONS_HEIGHT = 114.0, 76.0, 130.0, 115.0
SIDE, GUTTER, FOOT, HEAD = 14.0, 16.0, 12.0, 11.0
LEGEND_COLUMNS = 5  # of at most nine entries: two rows
N_SECTIONS, SECTION_COLUMNS = 6, 3
HEIGHTS = DEVIATION_HEIGHT, PLAN_HEIGHT, SHELL_HEIGHT, SECTIONS_HEIGHT


class Sheet(NamedTuple):
    """A figure, and where on it to draw: millimetres from its lower left corner."""

    figure: "Figure"
    left: float = 0.0
    low: float = 0.0

    def place(self, left: float, low: float, width: float, height: float) -> "Axes":
        """Add axes at a place in millimetres."""
        across, up = self.figure.get_size_inches() * INCH
        bounds = (self.left + left) / across, (self.low + low) / up, width / across, height / up
        return self.figure.add_axes(bounds)


def sheet_of(width: float, height: float) -> Sheet:
    """Return an empty figure of a size in millimetres."""
    check_library("matplotlib", "a figure", "figures")
    from matplotlib.figure import Figure

    return Sheet(Figure(figsize=(width / INCH, height / INCH), facecolor="white"))


def draw_deviation(
    axis: "TowerAxis", tolerance: "Tolerance | None" = None, sheet: Sheet | None = None
) -> "Figure":
    """Draw deviations in x and y by height."""
    sheet = sheet or sheet_of(WIDTH, DEVIATION_HEIGHT)
    half, tall = (WIDTH - SIDE - GUTTER - 4.0) / 2.0, DEVIATION_HEIGHT - HEAD - FOOT
    first = sheet.place(SIDE, FOOT, half, tall)
    plot_deviation(first, axis, "x", tolerance)
    plot_deviation(sheet.place(SIDE + half + GUTTER, FOOT, half, tall), axis, "y", tolerance)
    handles, names = first.get_legend_handles_labels()
    first.legend(handles, names, loc="lower left", bbox_to_anchor=(0.0, 1.0),
                 ncols=LEGEND_COLUMNS, frameon=False, fontsize=FONT, labelcolor=TEXT,
                 borderaxespad=0.0, columnspacing=1.4, handlelength=1.6)  # fmt: skip
    return sheet.figure


def draw_plan(
    axis: "TowerAxis", tolerance: "Tolerance | None" = None, sheet: Sheet | None = None
) -> "Figure":
    """Draw the plan of the axis, and radius and what is seen by height."""
    sheet = sheet or sheet_of(WIDTH, PLAN_HEIGHT)
    half, tall = (WIDTH - SIDE - GUTTER - 4.0) / 2.0, PLAN_HEIGHT - FOOT - 10.0
    plot_plan(sheet.place(SIDE, FOOT, half, tall), axis, tolerance)
    plot_radius(sheet.place(SIDE + half + GUTTER, FOOT, half, tall), axis)
    return sheet.figure


def draw_shell(axis: "TowerAxis", sheet: Sheet | None = None) -> "Figure":
    """Draw the unrolled shell with the residuals of its cells."""
    sheet = sheet or sheet_of(WIDTH, SHELL_HEIGHT)
    tall = SHELL_HEIGHT - FOOT - 4.0
    image = plot_shell(sheet.place(SIDE, FOOT, WIDTH - SIDE - 26.0, tall), axis)
    bar = sheet.place(WIDTH - 22.0, FOOT, 4.0, tall)
    sheet.figure.colorbar(image, cax=bar)
    bar.tick_params(labelsize=FONT - 0.5, colors=TEXT, length=2.0, width=0.5)
    bar.set_ylabel("beyond the model, mm; grey: not seen", fontsize=FONT, color=TEXT)
    return sheet.figure


def draw_sections(axis: "TowerAxis", sheet: Sheet | None = None) -> "Figure":
    """Draw some sections from the base to the top."""
    sheet = sheet or sheet_of(WIDTH, SECTIONS_HEIGHT)
    known = np.flatnonzero(axis.is_answered)
    chosen = known[np.linspace(0, len(known) - 1, min(N_SECTIONS, len(known))).astype(np.intp)]
    width = WIDTH / SECTION_COLUMNS
    height = SECTIONS_HEIGHT / -(-N_SECTIONS // SECTION_COLUMNS)
    for i, index in enumerate(chosen):
        row, column = divmod(i, SECTION_COLUMNS)
        low = SECTIONS_HEIGHT - (row + 1) * height
        plot_section(sheet.place(column * width, low + 4.0, width, height - 9.0), axis, int(index))
    return sheet.figure
