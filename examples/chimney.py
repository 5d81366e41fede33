"""Figures 14 and 15 of the paper, from a simulated scan of a chimney.

Fig. 14: a section of the cloud, the curves its walls are thinned to, and the curve of minimal
radii. Fig. 15: the top, where the walls are disturbed, in two sections: the curves from either
wall, their mean curve and the curve of middles at the same height.

python examples/chimney.py            writes out/chimney_14.png and out/chimney_15.png
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import midrib
from midrib.towers import Scan, Tower

OUT = Path(__file__).parent.parent / "out"
MAIN, AUXILIARY, CURVE, SAME_HEIGHT, VIOLET = "#d62728", "#1f5fbf", "#000000", "#1f5fbf", "#8e44ad"
TOP = 12.0  # metres of the chimney that Fig. 15 shows

tower = Tower(height=60.0, base_radius=3.0, top_radius=1.6, lean=0.08, bend=0.02, form_error=0.004)
scan = Scan(tower, count=1_500_000, noise=(0.002, 0.004), ladder=40.0, platforms=(0.55,), seed=14)
# The top is disturbed, as in the paper: a bulge on one side, where the lining came loose.
points = scan.points()
away = np.hypot(points[:, 0], points[:, 1])
bulge = 0.05 * np.exp(-(((points[:, 2] - 55.0) / 1.5) ** 2)) * (points[:, 0] < 0.0)
points[:, :2] += points[:, :2] / away[:, None] * bulge[:, None]

axis = midrib.tower_axis(points, "paper", thinning="average-depth")
calm = midrib.tower_axis(points, "paper")
names = ("X", "Y")


def style(axes, title: str) -> None:  # type: ignore[no-untyped-def]
    """Label a panel."""
    axes.set_title(title, fontsize=8, loc="left")
    axes.tick_params(labelsize=7)
    axes.set_xlabel("across, m", fontsize=7)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def figure_14() -> Figure:
    """Draw the cloud's section, its two curves, the curve of minimal radii."""
    plane = axis.steps["planes"][0]
    figure = Figure(figsize=(7.0, 5.6), layout="constrained")
    cloud, curves, middle = figure.subplots(1, 3, sharey=True)
    cloud.plot(*plane.points.T, ",", color="#555555", rasterized=True)
    style(cloud, "a) section of the cloud")
    cloud.set_ylabel("height, m", fontsize=7)
    curves.plot(*plane.main.T, color=MAIN, lw=0.8)
    curves.plot(*plane.auxiliary.T, color=AUXILIARY, lw=0.8)
    style(curves, "b) main and auxiliary curve")
    middle.plot(*plane.main.T, "--", color=MAIN, lw=0.7)
    middle.plot(*plane.auxiliary.T, "--", color=AUXILIARY, lw=0.7)
    middle.plot(*plane.from_main.T, color=CURVE, lw=1.0)
    style(middle, "c) curve of minimal radii")
    return figure


def figure_15() -> Figure:
    """Draw the top in both planes, deviations a hundredfold against the height."""
    figure = Figure(figsize=(7.0, 5.6), layout="constrained")
    for name, plane, axes in zip(names, calm.steps["planes"], figure.subplots(1, 2), strict=True):
        high = plane.main[-1, 1]
        for wall, base in ((plane.main, -1.0), (plane.auxiliary, 1.0)):
            top = wall[wall[:, 1] > high - TOP]
            straight = np.polynomial.Polynomial.fit(top[:, 1], top[:, 0], 1)
            off = 1e3 * (top[:, 0] - straight(top[:, 1]))
            axes.plot(off + base * 60.0, top[:, 1], color=MAIN, lw=0.8,
                      label="walls off a straight line" if base > 0 else None)  # fmt: skip
        kinds = (
            (plane.from_main, "--", VIOLET, "curves from either wall"),
            (plane.from_auxiliary, "--", VIOLET, None),
            (plane.mean_curve, "-", CURVE, "mean curve"),
            (plane.same_height, "-", SAME_HEIGHT, "middles at the same height"),
        )
        for line, dashes, colour, label in kinds:
            top = line[line[:, 1] > high - TOP]
            axes.plot(1e3 * top[:, 0], top[:, 1], dashes, color=colour, lw=0.9, label=label)
        style(axes, f"direction {name}")
        axes.set_xlabel("across, mm (walls moved together)", fontsize=7)
        axes.set_ylabel("height, m", fontsize=7)
    figure.legend(*figure.axes[0].get_legend_handles_labels(), loc="outside lower center",
                  ncols=4, fontsize=7, frameon=False)  # fmt: skip
    return figure


def main() -> None:
    """Draw both figures and say how far the averages are from the true axis."""
    OUT.mkdir(exist_ok=True)
    for number, figure in ((14, figure_14()), (15, figure_15())):
        path = OUT / f"chimney_{number}.png"
        figure.savefig(path, dpi=200)
        print(f"written to {path}")
    for mode in ("paper", "joint"):
        levels = midrib.tower_axis(points, mode).levels
        known = levels[np.isfinite(levels["x"])]
        off = np.column_stack([known["x"], known["y"]]) - scan.axis(known["z"])
        print(
            f"{mode}: {1e3 * np.sqrt(np.mean((off**2).sum(axis=1))):.1f} mm RMS off the true axis"
        )


if __name__ == "__main__":
    main()
