"""
Figure 6: an irregular object with sharp ends
=============================================

Where both curves end in one point, the paper's first rule for ends is the best one: the line runs
from tip to tip. A dent in the auxiliary curve moves it by less than the dent is deep, but for one
in the first segment, next to the tip: there one minimal radius leans the other way and crosses its
neighbours, so that the line turns back for a moment. The construction has no rule against that;
``centring="centred"`` goes round by the trunk of the medial axis, which does not turn back.
"""

import matplotlib.pyplot as plt

from midrib import minimal_radii
from midrib.figures.panels import draw_line, draw_radii, draw_strip, finish, panels
from shapes import irregular

strip = irregular()
curve = minimal_radii(strip, count=48)

(sheet,) = panels([strip.area])
draw_strip(sheet, strip)
draw_radii(sheet, curve)
draw_line(sheet, curve.line)
finish([sheet])
plt.show()
