"""
Figure 5: ends depend on the main curve
=======================================

One area, three main curves, and the curve ends where the main curve does. On the left the plain
construction: next to an end that both curves share, minimal radii shrink to nothing and draw the
curve into the corner. Further right each Q keeps away from the end: as far as P is from it, or in
proportion to the first segments of the two curves.

The second main curve, as long as the auxiliary curve and of the same shape, gives what one expects
of an axis. Where the first segments are unlike, as in the third row, the proportion makes things
worse. In the middle all others are the same.
"""

import matplotlib.pyplot as plt

from midrib import minimal_radii
from midrib.figures.panels import draw_line, draw_radii, draw_strip, finish, panels
from shapes import variants

GREEN = "#1e9e58"
CLEARANCES = {"plain": None, "as far": "station", "in proportion": "proportional"}

curves = {
    (name, way): minimal_radii(strip, count=48, end_clearance=clearance)
    for name, strip in variants().items()
    for way, clearance in CLEARANCES.items()
}

titles = [f"{name} main curve, {way}" for name, way in curves]
sheets = panels([curve.strip.area for curve in curves.values()], titles, columns=3)
for sheet, curve in zip(sheets, curves.values(), strict=True):
    draw_strip(sheet, curve.strip)
    draw_radii(sheet, curve)
    draw_line(sheet, curve.line, GREEN)
finish(sheets)
plt.show()
