"""Lines of several methods side by side."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import LineString, Point, Polygon, affinity, box

import midrib
from midrib.comparison import compare
from midrib.errors import GeometryTypeError, ParameterError
from midrib.figures.comparison import COLOURS, draw_comparison

L_SHAPE = Polygon([(0, 0), (10, 0), (10, 3), (3, 3), (3, 12), (0, 12)])
NECK = shapely.union_all([
    box(0, 0, 5, 5),
    Polygon([(5, 2.5), (9, 2.5), (9, 2.51), (6.2, 2.51), (5, 2.51)]),
    box(9, 0, 14, 5),
])  # fmt: skip


def test_every_method_has_a_row_with_the_line_of_collapse() -> None:
    found = compare(L_SHAPE)
    assert [row.method for row in found.rows] == [method.name for method in midrib.methods()]
    for row in found.rows:
        assert row.line is not None
        assert row.line.equals(midrib.collapse(L_SHAPE, row.method))
        assert row.vertices == len(row.line.coords)
        assert row.length == pytest.approx(row.line.length)
        assert row.cpu > 0.0
    assert (found.rows[0].off, found.rows[0].off_most) == (0.0, 0.0)
    assert 0.0 < found.rows[2].off <= found.rows[2].off_most


def test_numbers_are_shares_of_the_width() -> None:
    """Of a strip 4 wide, whose chordal axis is the middle, but the paper's curve is not."""
    small, large = (compare(affinity.scale(L_SHAPE, k, k, origin=(0, 0))) for k in (1, 8))
    for one, other in zip(small.rows, large.rows, strict=True):
        assert other.length == pytest.approx(8.0 * one.length)
        for name in ("off", "off_most", "turning", "centredness"):
            assert getattr(other, name) == pytest.approx(getattr(one, name), abs=1e-6)
    (row,) = compare(box(0, 0, 20, 2), ["chordal-axis"]).rows
    assert row.centredness == pytest.approx(0.0)
    assert row.turning == pytest.approx(0.0)


def test_a_method_that_refuses_the_area_says_why() -> None:
    found = compare(NECK, ["point-voronoi", "minimal-radii"])
    refused, other = found.rows
    assert refused.line is None
    assert "in pieces" in refused.reason
    assert np.isnan(refused.off)
    assert other.off == 0.0


def test_degrees_are_compared_in_metres() -> None:
    area = affinity.translate(affinity.scale(L_SHAPE, 2e-4, 1e-4, origin=(0, 0)), 18, 60)
    found = compare(area, geographic=True)
    assert 150.0 < found.rows[0].length < 250.0
    assert found.rows[2].off < 1.0


def test_the_main_curve_may_be_chosen() -> None:
    along = LineString([(0, 12), (0, 0), (10, 0)])
    expected = midrib.collapse(L_SHAPE, along=along)
    assert compare(L_SHAPE, ["minimal-radii"], along=along).rows[0].line == expected


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (["no such"], "method is 'no such', expected"),
        ("minimal-radii", "names is 'minimal-radii', expected a sequence"),
        ([], r"names is \[\], expected a sequence"),
    ],
)
def test_wrong_names_are_refused(names: Any, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        compare(L_SHAPE, names)


def test_what_is_no_area_is_refused() -> None:
    with pytest.raises(GeometryTypeError, match="area is a Point"):
        compare(Point(0, 0))


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_comparisons_are_drawn(ending: str, tmp_path: Path) -> None:
    found = compare(NECK, ["minimal-radii", "chordal-axis", "point-voronoi"])
    figure = draw_comparison(found, tmp_path / f"a.{ending}")
    assert (tmp_path / f"a.{ending}").stat().st_size > 1000
    assert [axes.get_title(loc="left").partition(":")[0] for axes in figure.axes] == [
        "minimal-radii",
        "chordal-axis",
        "point-voronoi",
        "all",
    ]
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["minimal-radii", "chordal-axis"]


def test_panels_keep_their_shape() -> None:
    for area in (box(0, 0, 100, 2), box(0, 0, 2, 100), L_SHAPE):
        figure = draw_comparison(compare(area, ["minimal-radii", "chordal-axis"]))
        for axes in figure.axes:
            place = axes.get_position()
            size = np.array([place.width, place.height]) * figure.get_size_inches()
            low, high = np.array(axes.get_xlim()), np.array(axes.get_ylim())
            assert size[0] / size[1] == pytest.approx(np.ptp(low) / np.ptp(high), rel=0.02)


def test_lines_on_each_other_are_all_seen() -> None:
    """Where lines coincide the dashes of each method are in the gaps of the others."""
    pytest.importorskip("matplotlib")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.colors import to_rgb

    names = ["minimal-radii", "medial-axis", "chordal-axis"]
    figure = draw_comparison(compare(box(0, 0, 9, 2), names))
    canvas = FigureCanvasAgg(figure)
    canvas.draw()  # type: ignore[no-untyped-call]
    panel = figure.axes[-1].get_window_extent()
    pixels = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
    picture = pixels[::-1, :, :3] / 255.0
    inside = picture[int(panel.y0) : int(panel.y1), int(panel.x0) : int(panel.x1)]
    seen = [
        int((np.abs(inside - to_rgb(colour)).max(axis=2) < 0.05).sum())
        for colour in COLOURS[: len(names)]
    ]
    assert min(seen) > 0.5 * max(seen) > 20
