"""Plots of width against station, one panel a feature."""

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.checks import check_library
from midrib.figures.paper import FONT, INCH, POINT, TEXT, save

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from midrib.profiles import Profile

__all__ = ["MOST_PANELS", "Panel", "draw_profiles"]

MOST_PANELS = 12  # what a page holds and an eye takes in
LEFT, RIGHT, WIDTH, FILL, GRID = "#1f5fbf", "#d62728", "#000000", "#eef1ea", "#d8dcd2"
# Sizes on paper in millimetres.
PANEL = 42.0  # height of a panel with its title and axis
HEADER, FOOTER, SIDE, GUTTER, TITLE, AXIS = 10.0, 8.0, 17.0, 20.0, 6.5, 10.5
TWO_COLUMNS = 4  # from so many panels on


class Panel(NamedTuple):
    """A profile and what to call it."""

    title: str
    profile: "Profile"


def draw_profiles(
    panels: "Sequence[Panel]",
    path: str | Path | None = None,
    *,
    unit: str | None = None,
    count: int | None = None,
    width: float = 240.0,
) -> "Figure":
    """Plot width, and the distances to the two banks, against station.

    Parameters
    ----------
    panels : sequence of Panel
        The first twelve are drawn; a sentence says how many are left out.
    path : str or Path, optional
        File to write, .svg, .png or .pdf.
    unit : str, optional
        Name of the unit of lengths, for the axes.
    count : int, optional
        How many profiles there are, if they are not all in ``panels``.
    width : float, default 240
        Width of the sheet in millimetres.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    MissingDependencyError
        If matplotlib is not installed.
    """
    check_library("matplotlib", "a figure", "figures")
    from matplotlib.figure import Figure

    drawn = list(panels)[:MOST_PANELS]
    n_columns = 2 if len(drawn) >= TWO_COLUMNS else 1
    n_rows = max(1, -(-len(drawn) // n_columns))
    height = HEADER + n_rows * PANEL + FOOTER
    figure = Figure(figsize=(width / INCH, height / INCH), facecolor="white")
    across = (width - SIDE - GUTTER * (n_columns - 1) - TITLE) / n_columns
    for i, panel in enumerate(drawn):
        row, column = divmod(i, n_columns)
        left = SIDE + column * (across + GUTTER)
        low = height - HEADER - (row + 1) * PANEL + AXIS
        place = (left / width, low / height, across / width, (PANEL - AXIS - TITLE) / height)
        draw_panel(figure.add_axes(place), panel, unit)
    if drawn:
        handles, names = figure.axes[0].get_legend_handles_labels()
        figure.legend(
            handles,
            names,
            loc="upper left",
            bbox_to_anchor=((SIDE - 1.5) / width, 1.0 - 2.0 / height),
            ncols=len(names),
            frameon=False,
            fontsize=FONT,
            labelcolor=TEXT,
            borderpad=0.0,
            borderaxespad=0.0,
        )
    say(figure, left_out(len(drawn), len(panels) if count is None else count), width, height)
    if path is not None:
        save(figure, Path(path))
    return figure


def draw_panel(axes: "Axes", panel: Panel, unit: str | None) -> None:
    """Plot one profile."""
    profile = panel.profile
    stations = profile.stations
    axes.fill_between(stations, 0.0, profile.width, color=FILL, lw=0.0)
    axes.plot(stations, profile.to_left, color=LEFT, lw=0.2 / POINT, label="to the left bank")
    axes.plot(
        stations,
        profile.to_right,
        color=RIGHT,
        lw=0.2 / POINT,
        ls=(0, (4.0, 2.0)),
        label="to the right bank",
    )
    axes.plot(stations, profile.width, color=WIDTH, lw=0.3 / POINT, label="width")
    axes.set_title(panel.title, fontsize=FONT + 0.5, color=TEXT, loc="left", pad=3.0)
    label = "" if unit is None else f" ({unit})"
    axes.set_xlabel(f"station{label}", fontsize=FONT, color=TEXT, labelpad=1.5)
    axes.set_ylabel(f"width{label}", fontsize=FONT, color=TEXT, labelpad=2.0)
    axes.set_xlim(0.0, stations[-1])
    top = float(np.max([profile.width, profile.to_left, profile.to_right]))
    axes.set_ylim(0.0, 1.08 * top)
    axes.tick_params(labelsize=FONT - 0.5, colors=TEXT, length=2.0, width=0.5, pad=2.0)
    axes.locator_params(axis="y", nbins=4)
    axes.grid(color=GRID, lw=0.4)
    axes.set_axisbelow(True)
    for side, spine in axes.spines.items():
        spine.set_visible(side in {"left", "bottom"})
        spine.set(color=TEXT, linewidth=0.5)


def left_out(n_drawn: int, count: int) -> str:
    """Say how many profiles have no panel."""
    if count == 0:
        return "No feature has a profile."
    rest = count - n_drawn
    if rest == 0:
        return ""
    return f"{rest} more {'profile is' if rest == 1 else 'profiles are'} in the table, not drawn."


def say(figure: "Figure", sentence: str, width: float, height: float) -> None:
    """Write a sentence at the foot of the sheet."""
    figure.text(
        SIDE / width, 3.0 / height, sentence, fontsize=FONT, color=TEXT, ha="left", va="bottom"
    )
