"""
Figure 11: the hatching of a regular embankment
===============================================

What the law draws: straight edges and two sides of lengths *a* and *c*. Strokes are *b* = (*a* +
*c*) / 4 apart (Eq. 2), and every second one is half as long as the slope is wide there. Here *a*
and *c* are taken from stroke to stroke, as the paper does it (``rule="paper"``).
"""

import matplotlib.pyplot as plt
import shapely

from midrib import hatch
from midrib.figures.panels import draw_line, draw_strip, finish, panels
from shapes import regular_embankment

strip = regular_embankment()
hatching = hatch(strip, "pl-2015-slope-reinforced", scale=500, rule="paper")

(sheet,) = panels([strip.area])
draw_strip(sheet, strip)
draw_line(sheet, shapely.multilinestrings(list(hatching.strokes)), name="strokes", width=0.3)
finish([sheet])
plt.show()
