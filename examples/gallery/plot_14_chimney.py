"""
Figure 14: a chimney, from its points to its axis
=================================================

A plane cuts the cloud; points near each other become one (*Average Depth*, 0.01 m), and the two
walls are main and auxiliary curve. Deviations of the curve of minimal radii cannot be seen at the
walls' scale, so it is drawn once more with its distance from the middle exaggerated. The bulge of
the main curve near the top moves it by half of its depth, towards the main curve. The scan is
simulated, so the true axis is known.
"""

import matplotlib.pyplot as plt

import midrib
from shapes import chimney, true_axis

TIMES = 50  # how much farther from the middle the curve is drawn once more
MAIN, AUXILIARY, CURVE, AGAIN, CLOUD = "#d62728", "#1f5fbf", "#000000", "#2e7d32", "#555555"
scan, points = chimney()
axis = midrib.tower_axis(points, "paper", thinning="average-depth")
plane = axis.steps["planes"][0]
truth = true_axis(scan, axis, plane.direction)

figure, (cloud, curves, middle) = plt.subplots(1, 3, sharey=True, figsize=(8.0, 6.0))
cloud.plot(*plane.points.T, ",", color=CLOUD, rasterized=True)
for axes, dashes in ((curves, "-"), (middle, "--")):
    axes.plot(*plane.main.T, dashes, color=MAIN, lw=0.8, label="main curve")
    axes.plot(*plane.auxiliary.T, dashes, color=AUXILIARY, lw=0.8, label="auxiliary curve")
middle.plot(*plane.from_main.T, color=CURVE, lw=1.0, label="curve of minimal radii")
off, height = plane.from_main.T
middle.plot(TIMES * off, height, color=AGAIN, lw=0.5, label=f"the same, {TIMES} times exaggerated")
titles = ("a) section of the cloud", "b) curves", "c) curve of minimal radii")
for axes, title in zip((cloud, curves, middle), titles, strict=True):
    axes.set_title(title, fontsize=9, loc="left")
    axes.set_xlabel("across, m")
    axes.spines[["top", "right"]].set_visible(False)
cloud.set_ylabel("height, m")
figure.legend(*middle.get_legend_handles_labels(), loc="lower center", ncols=4, frameon=False,
              fontsize=9)  # fmt: skip
figure.subplots_adjust(left=0.08, right=0.98, top=0.94, bottom=0.15)
plt.show()
