"""
Figure 8: four methods on one object
====================================

The medial axis and the straight skeleton have branches, and as a line they need pruning; the mean
curve, as Rhinoceros makes it, and the curve of minimal radii are one line from the start.
"""

import matplotlib.pyplot as plt

from midrib import collapse, minimal_radii, skeleton
from midrib.figures.panels import draw_line, draw_strip, finish, panels
from shapes import sample

strip = sample()
results = {
    "a) medial axis": skeleton(strip.area, "medial-axis").lines,
    "b) straight skeleton": skeleton(strip.area, "straight-skeleton").lines,
    "c) mean curve": collapse(strip.area, "mean-curve", along=strip.main, ends="main"),
    "d) curve of minimal radii": minimal_radii(strip, count=200, end_clearance="station").line,
}

sheets = panels([strip.area] * 4, list(results), columns=2)
for sheet, result in zip(sheets, results.values(), strict=True):
    draw_strip(sheet, strip)
    draw_line(sheet, result, name="result")
finish(sheets)
plt.show()
