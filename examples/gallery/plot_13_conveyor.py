"""
Figure 13: the circles of a conveyor
====================================

Circles stand on the axis, every second one touches both edges, the others are in the middle between
them. The paper takes middles of minimal radii; they are centres of such circles where the edges are
parallel. Where they are not, the *centred* curve of minimal radii is the right axis, and the
standard ``pl-2015-conveyor`` draws with it.
"""

import matplotlib.pyplot as plt
from shapely import LineString, MultiLineString

from midrib import standard
from midrib.figures.panels import draw_line, draw_strip, finish, panels
from midrib.hatching.draw import draw
from shapes import conveyor

strip = conveyor()
(circles,) = draw(strip, standard("pl-2015-conveyor"), scale=500).symbols.placed

(sheet,) = panels([strip.area])
draw_strip(sheet, strip)
rings = MultiLineString([LineString(chain) for _, chain in circles.chains()])
draw_line(sheet, rings, name="circles", width=0.3)
finish([sheet])
plt.show()
