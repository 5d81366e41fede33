"""
Figure 10: strokes that cross, and strokes trimmed
==================================================

An embankment that is not trivial, hatched by normals of its upper edge as far as they go: they
cross one another around the rises and the corner (a). Trimmed to the curve of minimal radii, fewer
do (b). Figure 12 has strokes that never cross.
"""

import matplotlib.pyplot as plt
import numpy as np
import shapely

from midrib import minimal_radii
from midrib.figures.panels import draw_line, draw_strip, finish, panels
from shapes import embankment


def normals(strip, gap):
    """Draw normals of the main curve, a gap apart, as far as they lie inside the area."""
    stations = np.arange(gap, strip.main.length, gap)
    at, before, after = (
        shapely.get_coordinates(strip.main.interpolate(stations + step))
        for step in (0, -0.01, 0.01)
    )
    along = (after - before) / np.hypot(*(after - before).T)[:, None]
    right = np.column_stack([along[:, 1], -along[:, 0]])
    rays = shapely.linestrings(np.stack([at + 1e-6 * right, at + 100.0 * right], axis=1))
    return first_part(shapely.intersection(rays, strip.area), at)


def first_part(lines, at):
    """Keep of each line the part that begins next to its point."""
    parts = [shapely.get_parts(line) for line in lines]
    places = shapely.points(at)
    return np.array(
        [p[np.argmin(shapely.distance(p, place))] for p, place in zip(parts, places, strict=True)]
    )


strip = embankment()
curve = minimal_radii(strip, spacing=0.2, ends="caps")
untrimmed = normals(strip, gap=0.8)
starts = shapely.get_coordinates(shapely.get_point(untrimmed, 0))
trimmed = first_part(shapely.difference(untrimmed, curve.line), starts)

titles = "a) normals of the top", "b) trimmed to the curve"
sheets = panels([strip.area] * 2, titles, columns=2)
for sheet, strokes in zip(sheets, (untrimmed, trimmed), strict=True):
    draw_strip(sheet, strip)
    draw_line(sheet, shapely.multilinestrings(list(strokes)), name="strokes", width=0.2)
draw_line(sheets[1], curve.line, "#1e9e58", width=0.3)
finish(sheets)
plt.show()
