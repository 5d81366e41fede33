"""Contact sheets: many areas with their lines in one picture, to be looked at."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import shapely
from shapely import Polygon
from shapely.geometry.base import BaseGeometry

from families import Floats

__all__ = ["Panel", "draw_sheet"]


class Panel(NamedTuple):
    """One area of a sheet."""

    title: str
    area: Polygon
    axis: Floats  # (k, 2) the line that should be found
    line: BaseGeometry | None  # the line that was
    ends: Floats  # (2, 2)
    place: tuple[float, float, float] | None = None  # x, y, half the side of what to show again


def draw_sheet(
    panels: Sequence[Panel],
    path: Path,
    columns: int = 4,
    size: tuple[float, float] = (6.0, 4.5),
) -> None:
    """Draw areas, the first end at the left; beside each its place, larger, if it has one."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    views = [
        (panel, is_near)
        for panel in panels
        for is_near in ((False,) if panel.place is None else (False, True))
    ]
    rows = -(-len(views) // columns)
    inches = columns * size[0], rows * size[1]
    figure, axes = plt.subplots(rows, columns, figsize=inches, squeeze=False)
    for plot in axes.flat:
        plot.axis("off")
    for plot, (panel, is_near) in zip(axes.flat, views, strict=False):
        draw(plot, panel, is_near=is_near)
    figure.tight_layout()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=60)
    plt.close(figure)


def draw(plot: Any, panel: Panel, *, is_near: bool) -> None:
    """Draw an area with axis (green, wide) and line (red, thin), or what is near its place."""
    upright = turned(panel)
    for ring in (panel.area.exterior, *panel.area.interiors):
        plot.plot(*upright(np.asarray(ring.coords)[:, :2]).T, color="0.5", linewidth=0.7)
    plot.plot(*upright(panel.axis).T, color="tab:green", linewidth=2.5)
    for part in shapely.get_parts(panel.line):
        plot.plot(*upright(shapely.get_coordinates(part)).T, color="tab:red", linewidth=1)
    plot.plot(*upright(panel.ends).T, "o", color="tab:blue", markersize=4)
    plot.set_aspect("equal", "datalim")
    if panel.place is not None:
        (x, y), half = upright(np.array([panel.place[:2]]))[0], panel.place[2]
        plot.plot([x], [y], "o", color="black", markersize=12, fillstyle="none")
        if is_near:
            plot.set_aspect("equal", "box")
            plot.set_xlim(x - half, x + half)
            plot.set_ylim(y - 0.7 * half, y + 0.7 * half)
    if not is_near:
        plot.set_title(panel.title)


def turned(panel: Panel) -> Callable[[Floats], Floats]:
    """How to turn an area so that its ends lie level."""
    first, last = panel.ends
    x, y = (last - first) / (np.hypot(*(last - first)) or 1.0)
    turn = np.array([[x, -y], [y, x]])
    return lambda points: (points - first) @ turn
