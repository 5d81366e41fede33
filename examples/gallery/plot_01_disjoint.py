"""
Figure 1: a disjoint object
===========================

Two chains that do not meet: one is the main curve, the other one the auxiliary curve. Straight
*caps* close the area between their ends; they belong to neither. The line may end in the middle of
each cap: the paper's second rule for ends.
"""

import matplotlib.pyplot as plt

from midrib import minimal_radii
from midrib.figures.panels import draw_line, draw_strip, finish, panels
from shapes import disjoint

strip = disjoint()
curve = minimal_radii(strip, count=24, ends="caps")

(sheet,) = panels([strip.area])
draw_strip(sheet, strip)
draw_line(sheet, curve.line)
finish([sheet])
plt.show()
