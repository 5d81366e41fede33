"""Panels: one size, true to scale, with a legend that names everything once."""

from typing import Any

import numpy as np
import pytest
import shapely
from shapely import LineString, box

from midrib import Strip, minimal_radii

pytest.importorskip("matplotlib")

import matplotlib as mpl
import matplotlib.pyplot as plt

from midrib.figures.draw import MAIN
from midrib.figures.panels import (
    draw_line,
    draw_points,
    draw_radii,
    draw_strip,
    finish,
    panels,
)

mpl.use("Agg")

STRIP = Strip(LineString([(0, 0), (40, 0)]), LineString([(0, 10), (40, 10)]))
INCH = 25.4


@pytest.fixture(autouse=True)
def _no_figure_stays_open() -> object:
    yield
    plt.close("all")


@pytest.mark.parametrize("columns", [1, 2, 3])
def test_every_shape_has_room_and_is_true_to_scale(columns: int) -> None:
    shapes = [box(0, 0, 40, 10), box(5, 5, 6, 9), box(-3, 0, 0, 3)]
    sheets = panels(shapes, "abc", columns=columns, width=120.0)
    finish(sheets)
    figure = sheets[0].figure
    size = figure.get_size_inches() * INCH
    assert size[0] == pytest.approx(120.0)
    for sheet, shape in zip(sheets, shapes, strict=True):
        (x0, x1), (y0, y1) = sheet.axes.get_xlim(), sheet.axes.get_ylim()
        assert box(x0, y0, x1, y1).contains_properly(shape)
        place = sheet.axes.get_position()
        per_unit = place.width * size[0] / (x1 - x0), place.height * size[1] / (y1 - y0)
        assert per_unit == pytest.approx(tuple(sheet.scale))


def test_panels_are_apart_and_inside_the_figure() -> None:
    sheets = panels([STRIP.area] * 5, "abcde", columns=2)
    for k in range(15):
        draw_line(sheets[k % 5], STRIP.main, name=f"line {k} with a name")
    draw_strip(sheets[0], STRIP)
    finish(sheets)
    boxes = [box(*sheet.axes.get_position().extents) for sheet in sheets]
    assert all(box(0, 0, 1, 1).contains(b) for b in boxes)
    tree = shapely.STRtree(boxes)
    assert tree.query(boxes, predicate="intersects").shape[1] == len(boxes)
    figure = sheets[0].figure
    figure.canvas.draw()
    legend = figure.legends[0].get_window_extent().transformed(figure.transFigure.inverted())
    assert legend.y0 >= 0.0
    assert legend.x1 <= 1.0
    assert not shapely.intersects(boxes, box(*legend.extents)).any()


def test_the_legend_names_everything_once() -> None:
    curve = minimal_radii(STRIP, count=4, ends="caps")
    sheets = panels([STRIP.area] * 2)
    for sheet in sheets:
        draw_strip(sheet, STRIP)
        draw_radii(sheet, curve)
        draw_line(sheet, curve.line)
    draw_points(sheets[1], curve.points, "black", "S")
    finish(sheets)
    assert [text.get_text() for text in sheets[0].figure.legends[0].get_texts()] == [
        "area",
        "main curve",
        "auxiliary curve",
        "minimal radii",
        "curve of minimal radii",
        "S",
    ]


def test_what_is_drawn_is_what_was_given() -> None:
    curve = minimal_radii(STRIP, count=4, ends="caps")
    (sheet,) = panels([STRIP.area])
    draw_strip(sheet, STRIP)
    draw_radii(sheet, curve)
    draw_line(sheet, shapely.MultiLineString([curve.line, STRIP.main]))
    drawn: list[Any] = list(sheet.axes.collections)
    _, main, auxiliary, radii, lines = drawn
    assert mpl.colors.same_color(main.get_colors(), MAIN)
    assert np.array_equal(auxiliary.get_segments()[0], STRIP.auxiliary.coords)
    assert len(radii.get_segments()) == len(curve.radii)
    assert np.array_equal(lines.get_segments()[0], curve.line.coords)
    assert np.array_equal(lines.get_segments()[1], STRIP.main.coords)
