"""
Figure 7: disturbed curves, and stations left out
=================================================

The curve of minimal radii follows its main curve: a notch there draws it aside, a notch in the
auxiliary curve hardly does. Leaving out the stations in the notch mends it, here by a polygon
around them; ``skip="bays"`` finds such stations by itself where they lie in a bay that is deep
enough.
"""

import matplotlib.pyplot as plt

from midrib import minimal_radii
from midrib.figures.panels import draw_line, draw_radii, draw_strip, finish, panels
from shapes import NOTCH, disturbed

GREEN = "#1e9e58"

strip = disturbed()
plain = minimal_radii(strip, count=60, ends="caps")
mended = minimal_radii(strip, count=60, ends="caps", skip=NOTCH)

sheets = panels([strip.area] * 2, ["all stations", "stations in the notch left out"])
for sheet, curve in zip(sheets, (plain, mended), strict=True):
    draw_strip(sheet, strip)
    draw_radii(sheet, curve)
draw_line(sheets[0], plain.line)
draw_line(sheets[1], plain.line, width=0.3)
draw_line(sheets[1], mended.line, GREEN, "with stations left out")
finish(sheets)
plt.show()
