"""
Figure 3: circles, minimal radii, and their curve
=================================================

Around a point P of the main curve there is a circle for each segment of the auxiliary curve: it
touches the segment in its nearest point (a). The smallest circle counts, its radius is the minimal
radius of P; the same at stations all along the main curve (b). The middles of these radii, joined,
are the curve of minimal radii (c).
"""

import matplotlib.pyplot as plt
import numpy as np
import shapely
from shapely import LineString

from midrib import minimal_radii
from midrib.figures.panels import draw_line, draw_points, draw_radii, draw_strip, finish, panels
from shapes import polygonal

GREEN, VIOLET, BROWN = "#1e9e58", "#8e44ad", "#7a5c3e"

strip = polygonal()
curve = minimal_radii(strip, count=24, end_clearance=None)

p = curve.on_main[8]
corners = shapely.get_coordinates(strip.auxiliary)
segments = [LineString(pair) for pair in np.stack([corners[:-1], corners[1:]], axis=1)]
radii = [shapely.shortest_line(shapely.Point(p), segment) for segment in segments]
circles = [shapely.Point(p).buffer(radius.length, quad_segs=64).exterior for radius in radii]

titles = "a) circles around P", "b) minimal radii", "c) their middles, joined"
sheets = panels([strip.area] * 3, titles)
for sheet in sheets:
    draw_strip(sheet, strip)
draw_line(sheets[0], shapely.multilinestrings(circles), GREEN, "circles", width=0.25)
draw_line(sheets[0], shapely.multilinestrings(radii), VIOLET, "minimal radii", width=0.25)
draw_points(sheets[0], [p], "black", "P")
draw_radii(sheets[1], curve)
draw_line(sheets[2], curve.line, BROWN)
draw_points(sheets[2], curve.points, BROWN, "middles S")
finish(sheets)
plt.show()
