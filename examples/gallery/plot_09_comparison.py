"""
Figure 9: four methods compared
===============================

In the upper, regular part the medial axis, the straight skeleton and the curve of minimal radii are
the same line, away from the ends; the mean curve comes to it from the corner only slowly, as its
pairs halve both curves in proportion. In the first bend, the middle part, the two skeletons differ,
and the curve of minimal radii lies between them; the mean curve is too close to the auxiliary
curve. Both skeletons fork at the ends, and the curve of minimal radii runs along one of the
branches into the corner where the main curve ends.

**Where it does not lie between them:** in the second bend, where the main curve is inside. A single
point of the main curve has the whole bend of the auxiliary curve before it, the radii turn about
it, and the line cuts the corner that both skeletons go round. ``centring="centred"`` mends that: it
is the trunk of the medial axis.
"""

import matplotlib.pyplot as plt
from shapely import box

from midrib import collapse, minimal_radii, skeleton
from midrib.figures.panels import draw_line, draw_strip, finish, panels
from shapes import sample

GREEN, BROWN, VIOLET = "#1e9e58", "#b8742a", "#8e44ad"

strip = sample()
curve = minimal_radii(strip, count=200, end_clearance="station")
medial = skeleton(strip.area, "medial-axis")
straight = skeleton(strip.area, "straight-skeleton")
mean = collapse(strip.area, "mean-curve", along=strip.main, ends="main")

bend = box(1.0, 7.0, 5.2, 11.2)
sheets = panels([strip.area, bend], ["the object", "its middle part"], columns=2)
for sheet in sheets:
    draw_strip(sheet, strip)
    draw_line(sheet, medial.lines, GREEN, "medial axis", width=0.8)
    draw_line(sheet, straight.lines, BROWN, "straight skeleton", width=0.4)
    draw_line(sheet, mean, VIOLET, "mean curve", width=0.4)
    draw_line(sheet, curve.line, width=0.4)
finish(sheets)
plt.show()
