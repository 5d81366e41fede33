"""
Figure 2: a polygonal object
============================

The main curve is a continuous part of a polygon's boundary, the auxiliary curve is the rest. No
part belongs to both or to neither: the two meet in the ends. ``midrib.split`` proposes a division
by itself, or makes one between two points.
"""

import matplotlib.pyplot as plt

from midrib import split
from midrib.figures.panels import draw_strip, finish, panels
from shapes import polygonal

area = polygonal().area
strip = split(area, start=(0, 0), end=(12, 0))

(sheet,) = panels([area])
draw_strip(sheet, strip)
finish([sheet])
plt.show()
