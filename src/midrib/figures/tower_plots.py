"""Plots of a tower's axis: deviations by height, plan, unrolled shell, sections.

Deviations are millimetres across and metres up: the scale across is exaggerated, and says so.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from midrib.figures.paper import FONT, POINT, TEXT
from midrib.figures.tower_labels import label_curve
from midrib.towers.tolerance import verdicts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from midrib.towers.records import TowerAxis
    from midrib.towers.tolerance import Tolerance
    from midrib.types import Floats

__all__ = ["plot_deviation", "plot_plan", "plot_radius", "plot_section", "plot_shell"]

AXIS, BAND, FLAG, LIMIT, LINE = "#000000", "#9db8dd", "#d62728", "#c8811a", "#1f5fbf"
GRID = "#d8dcd2"
NORMAL = 1.96
# Dark, middling and light, so that a print without colours tells them apart as well.
JUDGED = {"beyond": "#a3201d", "undecided": "#f0a63c", "within": "#cfe3c4"}
BREAKS = {"kink": 5.0, "offset": 6.5}  # points: marks, which differ in shape and size
STRIP = 0.025  # of a plot's width: the strip of verdicts along its left side
MOST_LABELS = 60
LABELS = 0.16  # of the plan's extent: as far apart as labels are
WALL = 0.25  # of the radius on paper: how far the largest residuals of a section reach
RESIDUAL_SHARE = 98.0  # percent of the residuals that the colours of the unrolled shell tell apart


def millimetres(values: "Floats", axis: "TowerAxis") -> "Floats":
    """Coordinate units as millimetres."""
    found: Floats = 1e3 * np.asarray(values) / axis.unit
    return found


def height_of(axis: "TowerAxis") -> "Floats":
    """Heights of the levels in metres."""
    found: Floats = axis.levels["z"] / axis.unit
    return found


def deviations(axis: "TowerAxis", name: str) -> "Floats":
    """Deviation of x or y from the vertical through the base in mm, NaN where there is none."""
    base = axis.points[0]["xy".index(name)] if len(axis.points) else np.nan
    return millimetres(axis.levels[name] - base, axis)


def broken(axis: "TowerAxis", column: "Floats") -> "Floats":
    """Values of the levels with a centre, with NaN wherever the axis is broken."""
    found: Floats = np.insert(column[axis.is_answered], axis.breaks, np.nan)
    return found


def plot_deviation(
    axes: "Axes", axis: "TowerAxis", name: str, tolerance: "Tolerance | None"
) -> None:
    """Plot the deviation of x or y by height, with its 95 % interval and the tolerance."""
    z, off = height_of(axis), deviations(axis, name)
    half = NORMAL * millimetres(axis.levels[f"sigma_{name}"], axis)
    up, left, right = (broken(axis, column) for column in (z, off - half, off + half))
    axes.fill_betweenx(up, left, right, color=BAND, lw=0.0, label="95 % interval")
    axes.plot(broken(axis, off), up, color=AXIS, lw=0.35 / POINT, label="axis")
    flagged = (axis.levels["flag"] != "") & np.isfinite(off)
    if flagged.any():
        axes.plot(off[flagged], z[flagged], "o", color=FLAG, ms=1.6, mew=0.0, label="flagged")
    axes.axvline(0.0, color=TEXT, lw=0.4)
    if tolerance is not None:
        low = axis.summary.low
        allowed = millimetres(tolerance.at(axis.levels["z"] - low, axis.unit), axis)
        for sign in (-1.0, 1.0):
            axes.plot(sign * allowed, z, color=LIMIT, lw=0.3 / POINT, ls=(0, (4.0, 2.0)),
                      label=f"tolerance {tolerance.text}" if sign > 0 else None)  # fmt: skip
        plot_verdicts(axes, axis, tolerance)
    plot_breaks(axes, axis, (off, z))
    reach = axes.get_xlim()
    widest = max(abs(reach[0]), abs(reach[1]), 1.0)
    axes.set_xlim(-widest, widest)
    axes.locator_params(axis="x", nbins=8)  # numbers of more places would touch
    compass = {"x": "x (east)", "y": "y (north)"}[name]
    times = exaggeration(axes)
    finish(axes, f"deviation in {compass}, mm, {times:.0f} times exaggerated", "height, m")


def plot_breaks(axes: "Axes", axis: "TowerAxis", chain: "tuple[Floats, Floats]") -> None:
    """Plot on the axis, drawn as a chain of two coordinates of its levels, its kinks and offsets.

    A mark is between the levels next to it, so that of an offset is in the middle of its step.
    """
    known = np.isfinite(chain[0]) & np.isfinite(chain[1])
    for name, found, marker in (("kink", axis.kinks, "D"), ("offset", axis.offsets, "s")):
        heights = np.array([one.z for one in found]) / axis.unit
        if heights.size:
            across, up = (np.interp(heights, height_of(axis)[known], c[known]) for c in chain)
            axes.plot(across, up, marker, mfc="none", mec=LINE, mew=0.9, label=name,
                      ms=BREAKS[name])  # fmt: skip


def plot_verdicts(axes: "Axes", axis: "TowerAxis", tolerance: "Tolerance") -> None:
    """Plot along the left side which levels are beyond a tolerance, undecided or within it."""
    z, found = height_of(axis), verdicts(axis.levels, tolerance, axis.unit)
    tall = float(np.min(np.diff(z))) if z.size > 1 else 1.0
    for name, colour in JUDGED.items():
        rows = found == name
        if rows.any():
            axes.barh(z[rows], STRIP, tall, color=colour, edgecolor=colour, lw=0.4, label=name,
                      transform=axes.get_yaxis_transform())  # fmt: skip


def exaggeration(axes: "Axes") -> float:
    """How many times longer a length is drawn across, in millimetres, than up, in metres."""
    box = axes.bbox
    width, height = box.width, box.height
    across, up = np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())
    return float(width / across * 1e3 / (height / up))


def plot_plan(axes: "Axes", axis: "TowerAxis", tolerance: "Tolerance | None") -> None:
    """Plot the axis from above, the hodograph: where each level is, beside the base."""
    x, y = deviations(axis, "x"), deviations(axis, "y")
    known = np.isfinite(x)
    z = height_of(axis)
    axes.plot(broken(axis, x), broken(axis, y), color=AXIS, lw=0.3 / POINT)
    extent = max(float(np.ptp(x[known])), float(np.ptp(y[known]))) if known.any() else 1.0
    if tolerance is not None and known.any():
        height = axis.levels["z"][known][-1] - axis.summary.low
        radius = float(millimetres(tolerance.at(np.array([height]), axis.unit), axis)[0])
        turn = np.linspace(0.0, 2.0 * np.pi, 181)
        axes.plot(radius * np.cos(turn), radius * np.sin(turn), color=LIMIT, lw=0.3 / POINT,
                  ls=(0, (4.0, 2.0)))  # fmt: skip
        extent = max(extent, 2.0 * radius)
        axes.set_title("dashed: tolerance at the top", fontsize=FONT - 1.0, color=TEXT, pad=2.0)
    plot_breaks(axes, axis, (x, y))
    axes.axhline(0.0, color=TEXT, lw=0.4)
    axes.axvline(0.0, color=TEXT, lw=0.4)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.12)
    axes.locator_params(nbins=6)  # numbers of more places would touch
    finish(axes, "x (east), mm", "y (north), mm")
    rows = np.flatnonzero(known)
    if rows.size:
        rows = np.unique(np.append(rows[:: max(1, rows.size // MOST_LABELS)], rows[-1]))
        rows = np.roll(rows, 1)  # top and base have the first choice
        texts = [f"{height:.0f} m" for height in z[rows]]
        chosen = label_curve(axes, np.column_stack([x, y]), rows, texts, LABELS * extent)
        axes.plot(x[chosen], y[chosen], "o", color=LINE, ms=2.6, mew=0.0)


def plot_radius(axes: "Axes", axis: "TowerAxis") -> None:
    """Plot the radius by height, and how much of the shell is seen."""
    z = height_of(axis)
    axes.plot(axis.levels["radius"] / axis.unit, z, color=AXIS, lw=0.35 / POINT)
    finish(axes, "radius, m", "height, m")
    other = axes.twiny()
    other.step(axis.levels["coverage"], z, color=LINE, lw=0.25 / POINT, alpha=0.6)
    other.set_xlim(0.0, 380.0)
    other.set_xticks([0, 90, 180, 270, 360])
    other.set_xlabel("shell seen, degrees", fontsize=FONT, color=LINE, labelpad=2.0)
    other.tick_params(labelsize=FONT - 0.5, colors=LINE, length=2.0, width=0.5, pad=1.0)
    for spine in other.spines.values():
        spine.set_visible(False)


def plot_shell(axes: "Axes", axis: "TowerAxis") -> Any:
    """Plot the unrolled shell: how far each cell is beyond the model, by azimuth and height."""
    cells = axis.cells
    grid = cells.grid
    field = np.full((grid.n_levels, grid.n_sectors), np.nan)
    field[cells.level[axis.used], cells.sector[axis.used]] = millimetres(
        axis.residual[axis.used], axis
    )
    origin = cells.reference.frame.origin[2]
    edges = (origin + grid.start + grid.level * np.arange(grid.n_levels + 1)) / axis.unit
    # From y (north) clockwise, as maps have it.
    sector = 360.0 / grid.n_sectors
    compass = (90.0 - (np.arange(grid.n_sectors) + 0.5) * sector) % 360.0
    field = field[:, np.argsort(compass)]
    most = float(np.nanpercentile(np.abs(field), RESIDUAL_SHARE)) if axis.used.any() else 1.0
    across = np.linspace(0.0, 360.0, grid.n_sectors + 1)
    image = axes.pcolormesh(across, edges, field, cmap="RdBu_r", vmin=-most, vmax=most,
                            rasterized=True)  # fmt: skip
    axes.set_facecolor("#e4e4e4")
    known = axis.levels["z"][axis.is_answered] / axis.unit
    if known.size:
        axes.set_ylim(known[0] - 0.5, known[-1] + 0.5)
    axes.set_xticks(np.arange(0, 361, 45), ["N", "NE", "E", "SE", "S", "SW", "W", "NW", "N"])
    finish(axes, "azimuth", "height, m")
    axes.grid(visible=False)
    return image


def plot_section(axes: "Axes", axis: "TowerAxis", index: int) -> None:
    """Plot one level's section: the model, and its cells with residuals exaggerated."""
    level = axis.levels[index]
    cells = axis.cells
    frame = cells.reference.frame
    s = (level["z"] - frame.origin[2]) / frame.turn[2, 2]
    rows = axis.used & (np.abs(cells.s - s) <= max(cells.grid.level, 0.5 * axis.unit))
    angle = cells.azimuth[rows]
    off = millimetres(axis.residual[rows], axis)
    most = float(np.percentile(np.abs(off), 95)) if off.size else 1.0
    beyond = WALL * np.clip(off / max(most, 1e-9), -1.3, 1.3)
    turn = np.linspace(0.0, 2.0 * np.pi, 361)
    outline = shape_outline(axis, turn, float(level["radius"]))
    at = np.interp(angle, turn, outline)
    axes.plot(outline * np.cos(turn), outline * np.sin(turn), color=AXIS, lw=0.25 / POINT)
    axes.plot((at + beyond) * np.cos(angle), (at + beyond) * np.sin(angle), "o", color=LINE, ms=1.5,
              mew=0.0)  # fmt: skip
    axes.plot(0.0, 0.0, "+", color=FLAG, ms=5.0, mew=0.6)
    axes.set_xlim(-1.9, 1.9)
    axes.set_ylim(-1.9, 1.9)
    axes.set_aspect("equal")
    axes.axis("off")
    scale = most / (WALL * 1e3 * level["radius"] / axis.unit)
    title = f"{level['z'] / axis.unit:.1f} m, r = {level['radius'] / axis.unit:.3f} m"
    axes.set_title(title, fontsize=FONT, color=TEXT, pad=1.0)
    note = f"residuals {1.0 / scale:.0f} times" if scale > 0.0 else ""
    axes.text(0.5, 0.0, note, fontsize=FONT - 1.5, color=TEXT, ha="center",
              transform=axes.transAxes)  # fmt: skip


def shape_outline(axis: "TowerAxis", turn: "Floats", radius: float) -> "Floats":
    """Distance of the shell from the axis by angle from x, over its radius."""
    faces, shape = axis.cells.reference.faces, axis.shape
    if not len(faces):
        amplitude = shape.harmonics.get(2, (0.0, 0.0))[0] if shape.name == "oval" else 0.0
        longest = np.radians(90.0 - shape.azimuth) if amplitude else 0.0
        oval: Floats = 1.0 + amplitude / radius * np.cos(2.0 * (turn - longest))
        return oval
    along = np.column_stack([np.cos(turn), np.sin(turn)]) @ faces.T
    outline: Floats = 1.0 / along.max(axis=1)
    return outline


def finish(axes: "Axes", across: str, up: str) -> None:
    """Label axes and tone them down."""
    axes.set_xlabel(across, fontsize=FONT, color=TEXT, labelpad=1.5)
    axes.set_ylabel(up, fontsize=FONT, color=TEXT, labelpad=2.0)
    axes.tick_params(labelsize=FONT - 0.5, colors=TEXT, length=2.0, width=0.5, pad=2.0)
    axes.grid(color=GRID, lw=0.4)
    axes.set_axisbelow(True)
    for side, spine in axes.spines.items():
        spine.set_visible(side in {"left", "bottom"})
        spine.set(color=TEXT, linewidth=0.5)
