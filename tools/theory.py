"""Draw the pictures of docs/theory.

python -m tools.theory
"""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely
from examples.gallery.shapes import chain, disjoint, irregular, polygonal, sample, variants
from shapely import LineString, MultiLineString, Point, Polygon, box
from shapely.ops import substring

from midrib import Strip, collapse, methods, minimal_radii, skeleton
from midrib.errors import MidribError
from midrib.figures.draw import AUXILIARY, FILL, MAIN, OUTLINE, RADIUS
from midrib.figures.panels import (
    draw_line,
    draw_points,
    draw_radii,
    draw_strip,
    finish,
    panels,
)
from midrib.figures.paper import Paper, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FOLDER = Path(__file__).parents[1] / "docs" / "pictures"
GREEN, GREY = "#1e9e58", "#8a8f86"
THIN = 0.25  # millimetres


# -- what goes in ----------------------------------------------------------------------------------


class Refused(NamedTuple):
    """Two curves that bound no area, or do not divide the one that is given."""

    main: LineString
    auxiliary: LineString
    area: Polygon | None = None

    def message(self) -> str:
        """Sentence with which a strip of them is refused."""
        try:
            Strip(self.main, self.auxiliary, self.area)
        except MidribError as error:
            return str(error)
        msg = "a strip that should be refused is not"
        raise AssertionError(msg)


BOX = box(0, 0, 12, 4)
REFUSED = {
    "a segment is in both": Refused(chain("0 0, 12 0, 12 4, 9 4"), chain("0 0, 0 4, 12 4, 12 0")),
    "a piece is in neither": Refused(
        chain("0 0, 10 0"),
        chain("0 4, 10 4"),
        Polygon([(0, 0), (10, 0), (12, 2), (10, 4), (0, 4)]),
    ),
    "a curve leaves the boundary": Refused(chain("0 0, 6 1, 12 0"), chain("0 4, 12 4"), BOX),
    "the curves cross": Refused(chain("0 0, 5 4.5, 12 1"), chain("0 4, 7 0, 12 4")),
    "a curve crosses itself": Refused(
        chain("0 0, 7 0, 7 1.8, 5 1.8, 5 -1, 12 0"), chain("0 4, 12 4")
    ),
    "neither is around the other": Refused(
        chain("0 0, 5 0, 5 4, 0 4, 0 0"), chain("7 0, 12 0, 12 4, 7 4, 7 0")
    ),
}


def ring(radius: float) -> LineString:
    """Circle with corners."""
    angle = np.linspace(0.0, 2.0 * np.pi, 33)
    angle[-1] = 0.0
    return LineString(radius * np.column_stack([1.6 * np.cos(angle), np.sin(angle)]))


def valid() -> "Figure":
    """Four ways to divide a boundary."""
    strips = {
        "disjoint: two caps belong to neither": disjoint(),
        "polygonal: the curves meet in tips": polygonal(),
        "polygonal: the ends may be anywhere": variants()["even"],
        "closed: one around the other": Strip(ring(1.5), ring(3.0)),
    }
    sheets = panels([strip.area for strip in strips.values()], list(strips), columns=2)
    for sheet, strip in zip(sheets, strips.values(), strict=True):
        draw_strip(sheet, strip)
    return finished(sheets)


def refused() -> "Figure":
    """Curves that are no strip."""
    titles = [f"{k}  {name}" for k, name in enumerate(REFUSED, 1)]
    room = [box(0, -1, 12, 5)] * len(REFUSED)
    sheets = panels(room, titles, columns=3)
    for sheet, (main, auxiliary, area) in zip(sheets, REFUSED.values(), strict=True):
        if area is not None:
            sheet.fill(np.array([area], dtype=object), FILL, OUTLINE, "area")
        sheet.stroke([shapely.get_coordinates(main)], MAIN, 1.0, "main curve")
        sheet.stroke([shapely.get_coordinates(auxiliary)], AUXILIARY, 0.4, "auxiliary curve")
    return finished(sheets)


# -- minimal radii ---------------------------------------------------------------------------------

CASES = {  # main curve, auxiliary curve, place of P
    "foot: at right angles": (chain("0 0, 12 0"), chain("0 4, 12 5"), (5, 0)),
    "vertex: no foot is nearer": (chain("0 0, 12 0"), chain("0 5, 7 3, 12 5"), (7, 0)),
    "graze: past a corner": (
        chain("0 0, 7 0, 7 3.5, 8 4, 8 0, 12 0"),
        chain("0 2.5, 12 8"),
        (9, 0),
    ),
    "tie: two are equally near": (chain("0 0, 12 0"), chain("0 5, 3 4, 6 6, 9 4, 12 5"), (6, 0)),
}


def foot_and_vertex() -> "Figure":
    """How Q may lie on its segment."""
    strips = [Strip(main, auxiliary) for main, auxiliary, _ in CASES.values()]
    sheets = panels([strip.area for strip in strips], list(CASES), columns=2)
    for sheet, strip, (main, _, place) in zip(sheets, strips, CASES.values(), strict=True):
        station = main.project(Point(place))
        curve = minimal_radii(strip, stations=[station, 0.05], ends=None, end_clearance=None)
        rows = np.flatnonzero(np.abs(curve.stations - station) < 1e-9)
        draw_strip(sheet, strip)
        radius = curve.radii[rows[0]]
        circle = Point(place).buffer(radius, quad_segs=64).exterior.intersection(strip.area)
        draw_line(sheet, circle, GREEN, "circle", width=THIN)
        ways = np.stack([curve.on_main[rows], curve.on_auxiliary[rows]], axis=1)
        sheet.stroke(list(ways), RADIUS, 0.4, "minimal radius")
        draw_points(sheet, [place], "black", "P")
        draw_points(sheet, curve.on_auxiliary[rows], AUXILIARY, "Q")
        draw_points(sheet, curve.points[rows], GREEN, "S, the middle")
    return finished(sheets)


def pocket() -> Strip:
    """Strip whose main curve has a pocket that sees nothing of the auxiliary curve."""
    return Strip(
        chain("0 0, 4 0, 4 -1, 2.5 -1, 2.5 -3, 7.5 -3, 7.5 -2, 5 -2, 5 0, 12 0"),
        chain("0 3, 12 3"),
    )


def visibility() -> "Figure":
    """Gaps and jumps, and how the middles are joined."""
    strips = {"a gap: some P see nothing": pocket(), "a jump: what is nearest changes": sample()}
    sheets = panels([strip.area for strip in strips.values()], list(strips), columns=2)
    for sheet, strip in zip(sheets, strips.values(), strict=True):
        curve = minimal_radii(strip, count=90, ends=None, end_clearance=None)
        blind = [substring(strip.main, *gap) for gap in curve.gaps]
        draw_strip(sheet, strip)
        if blind:
            draw_line(sheet, MultiLineString(blind), "#e08a00", "sees nothing", width=0.9)
        draw_radii(sheet, curve)
        draw_line(sheet, curve.line)
        places = strip.main.interpolate(curve.jumps)
        draw_points(sheet, shapely.get_coordinates(places), GREEN, "jumps")
    return finished(sheets)


# -- ends ------------------------------------------------------------------------------------------

RULES: dict[str, Any] = {
    '1  "main": the main curve\'s ends': "main",
    '2  "caps": halfway between ends': "caps",
    '3  "radii": middles of the end radii': "radii",
    "4  a pair of points": ((0.5, 1.0), (10.8, 2.5)),
}


def end_rules() -> "Figure":
    """Draw the paper's four rules on one disjoint object."""
    strip = disjoint()
    sheets = panels([strip.area] * len(RULES), list(RULES), columns=2)
    for sheet, rule in zip(sheets, RULES.values(), strict=True):
        curve = minimal_radii(strip, count=24, ends=rule)
        draw_strip(sheet, strip)
        draw_radii(sheet, curve)
        draw_line(sheet, curve.line)
        ends = np.array(curve.line.coords)[[0, -1]]
        draw_points(sheet, ends, GREEN, "ends of the line")
    return finished(sheets)


# -- the middle ------------------------------------------------------------------------------------


def rough() -> Strip:
    """Strip with a straight main curve and a rough auxiliary one that comes nearer."""
    x = np.linspace(0.0, 24.0, 25)
    y = 4.0 - x / 12.0 + 0.5 * np.cos(np.arange(25) * 2.1)
    return Strip(chain("0 0, 24 0"), LineString(np.column_stack([x, y])))


def centrings() -> "Figure":
    """Draw the same radii with their middles, averaged, and moved to the middle."""
    strip = irregular()
    sheets = panels([strip.area] * 3, ['"none"', '"symmetric"', '"centred"'], columns=1, width=150)
    trunk = collapse(strip.area, "medial-axis", along=strip.main)
    for sheet, centring in zip(sheets, ("none", "symmetric", "centred"), strict=True):
        curve = minimal_radii(strip, count=48, centring=centring)  # type: ignore[arg-type]
        draw_strip(sheet, strip)
        if centring == "none":
            draw_radii(sheet, curve)
        draw_line(sheet, trunk, GREEN, "trunk of the medial axis", width=0.9)
        draw_line(sheet, curve.line, name="line", width=0.35)
    return finished(sheets)


# -- methods ---------------------------------------------------------------------------------------


def island() -> Polygon:
    """Area with an island, an arm and ends of different kinds."""
    shell = [
        (0, 2.5), (4, 0.5), (14, 0), (15, -3), (17, -3), (18, 0), (25, 0.5), (25, 4.5), (16, 5.5),
        (5, 5),
    ]  # fmt: skip
    return Polygon(shell, [[(7, 1.8), (8, 3.2), (11, 3.3), (10.5, 1.8)]])


def by_methods(area: Polygon) -> "Figure":
    """Draw what each method makes of an area: its line, and its branches if there are any."""
    names = [method.name for method in methods()]
    titles = ["minimal-radii, centring none", *names]
    sheets = panels([area] * len(titles), titles, columns=2)
    for sheet, method in zip(sheets[1:], methods(), strict=True):
        sheet.fill(np.array([area], dtype=object), FILL, OUTLINE, "area")
        if method.has_branches:
            draw_line(sheet, skeleton(area, method.name).lines, RADIUS, "branches", width=THIN)
        draw_line(sheet, collapse(area, method.name), name="line")
    sheets[0].fill(np.array([area], dtype=object), FILL, OUTLINE, "area")
    draw_line(sheets[0], collapse(area, centring="none", count=60), name="line")
    return finished(sheets)


def finished(sheets: Sequence[Paper]) -> "Figure":
    """Figure of some panels, with its legend."""
    finish(list(sheets))
    return sheets[0].figure


PICTURES: dict[str, Callable[[], "Figure"]] = {
    "theory-valid": valid,
    "theory-refused": refused,
    "theory-radii": foot_and_vertex,
    "theory-visibility": visibility,
    "theory-ends": end_rules,
    "theory-centred": centrings,
    "theory-methods": lambda: by_methods(island()),
    "theory-methods-rough": lambda: by_methods(rough().area),
}


def main() -> None:
    """Draw everything."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    for name, draw in PICTURES.items():
        save(draw(), FOLDER / f"{name}.svg")
        plt.close("all")


if __name__ == "__main__":
    main()
