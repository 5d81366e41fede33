"""
Figure 4: the nearest point is hidden
=====================================

A radius must lie inside the area. From P the nearest point of the auxiliary curve is on the other
side of a slot, and so is that of the next segment: the way there crosses the main curve twice. The
minimal radius leads to the nearest point that P sees.
"""

import matplotlib.pyplot as plt
import numpy as np
import shapely
from shapely import LineString, Point, box

from midrib import minimal_radii
from midrib.figures.panels import draw_line, draw_points, draw_strip, finish, panels
from shapes import sample

GREEN, VIOLET, GREY = "#1e9e58", "#8e44ad", "#999999"

strip = sample()
curve = minimal_radii(strip, count=200, end_clearance=None)
row = np.argmin(shapely.distance(shapely.points(curve.on_main), Point(11.5, 6.0)))
p, q, minimal = curve.on_main[row], curve.on_auxiliary[row], curve.radii[row]

corners = shapely.get_coordinates(strip.auxiliary)
segments = [LineString(pair) for pair in np.stack([corners[:-1], corners[1:]], axis=1)]
candidates = np.array([shapely.shortest_line(Point(p), segment) for segment in segments])
seen = shapely.covers(strip.area, candidates)
nearer = shapely.length(candidates) < minimal

(sheet,) = panels([box(3.5, 2.2, 19.0, 10.4)])
draw_strip(sheet, strip)
circle = Point(p).buffer(minimal, quad_segs=64).exterior
draw_line(sheet, circle, GREEN, "circle of the minimal radius", width=0.3)
hidden = shapely.multilinestrings(candidates[nearer & ~seen])
draw_line(sheet, hidden, GREY, "nearer, but hidden", width=0.3)
draw_line(sheet, LineString([p, q]), VIOLET, "minimal radius")
draw_points(sheet, [p], "black", "P")
finish([sheet])
plt.show()
