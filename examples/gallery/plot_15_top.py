"""
Figure 15: the top of the chimney, and two ways to average
==========================================================

Two planes, X and Y; in each of them two curves of minimal radii, one from either wall. Below the
bulge they are nearly the same; the mean curve and the middles at the same height are nearer to the
axis than they are, and hardly differ. At the bulge the two curves differ most, and a bulge of one
wall stays in every average by half: more planes, or a model of the whole shell, are for that
(``mode="fan"``, ``"joint"``). Millimetres across, metres up; the walls are moved together.
"""

import matplotlib.pyplot as plt
import numpy as np

import midrib
from shapes import chimney, true_axis

WALL, CURVE, SAME_HEIGHT, VIOLET, TRUE = "#d62728", "#000000", "#1f5fbf", "#8e44ad", "#2e8b57"
TOP, APART = 12.0, 0.06  # metres: of the chimney that are shown, between axis and wall
scan, points = chimney()
axis = midrib.tower_axis(points, "paper")
planes = axis.steps["planes"]
truths = [true_axis(scan, axis, plane.direction) for plane in planes]


def top_of(chain: np.ndarray, low: float, middle: float) -> np.ndarray:
    """Columns of a chain above a height: millimetres from a middle, metres up."""
    above = chain[chain[:, 1] > low]
    return np.array([1e3 * (above[:, 0] - middle), above[:, 1]])


figure, panels = plt.subplots(1, 2, sharey=True, figsize=(8.0, 6.0))
for name, plane, truth, axes in zip("XY", planes, truths, panels, strict=True):
    low = plane.main[-1, 1] - TOP
    middle = float(np.interp(low, truth[:, 1], truth[:, 0]))
    for wall, side in ((plane.main, -1.0), (plane.auxiliary, 1.0)):
        calm = wall[wall[:, 1] < low]  # the taper, where nothing is disturbed
        taper = np.polynomial.Polynomial.fit(calm[:, 1], calm[:, 0], 2)
        off = wall[:, 0] - taper(wall[:, 1]) + side * APART
        axes.plot(*top_of(np.column_stack([off, wall[:, 1]]), low, 0.0), color=WALL, label="walls")
    for chain, style, colour, label in (
        (plane.from_main, "--", VIOLET, "curves from either wall"),
        (plane.from_auxiliary, "--", VIOLET, "curves from either wall"),
        (plane.mean_curve, "-", CURVE, "mean curve"),
        (plane.same_height, "-", SAME_HEIGHT, "middles at the same height"),
        (truth, ":", TRUE, "true axis"),
    ):
        axes.plot(*top_of(chain, low, middle), style, color=colour, lw=1.0, label=label)
    axes.set_title(f"direction {name}", fontsize=9, loc="left")
    axes.set_xlabel("across, mm")
    axes.spines[["top", "right"]].set_visible(False)
panels[0].set_ylabel("height, m")
named = dict(zip(*reversed(panels[0].get_legend_handles_labels()), strict=True))
figure.legend(named.values(), named.keys(), loc="lower center", ncols=3, frameon=False)
figure.subplots_adjust(left=0.08, right=0.98, top=0.94, bottom=0.18)
plt.show()
