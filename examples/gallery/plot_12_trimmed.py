"""
Figure 12: a hatching trimmed to the curve of minimal radii
===========================================================

The paper's procedure: from a point of the upper edge to the nearest point of the lower edge that it
sees, the next one *b* farther, every second stroke trimmed to the curve of minimal radii. Strokes
next to each other have similar lengths, and none cross; several may share a foot, where the lower
edge turns away. By the rule of ``midrib.hatch`` strokes advance on both edges.
"""

import matplotlib.pyplot as plt
import shapely

from midrib import hatch, minimal_radii
from midrib.figures.panels import draw_line, draw_strip, finish, panels
from shapes import embankment

strip = embankment()
curve = minimal_radii(strip, tolerance=0.0, ends=None)
hatchings = {
    "the paper's procedure": hatch(strip, "pl-2015-slope-reinforced", scale=500, rule="paper"),
    "midrib.hatch": hatch(strip, "pl-2015-slope-reinforced", scale=500),
}

sheets = panels([strip.area] * 2, list(hatchings), columns=2)
for sheet, hatching in zip(sheets, hatchings.values(), strict=True):
    draw_strip(sheet, strip)
    draw_line(sheet, shapely.multilinestrings(list(hatching.strokes)), name="strokes", width=0.25)
draw_line(sheets[0], curve.line, "#1e9e58", width=0.3)
finish(sheets)
plt.show()
