"""Lines of several methods side by side."""

import colorsys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import LineString, MultiPolygon, Point, Polygon, affinity, box

import midrib
from midrib.comparison import compare
from midrib.curves.variants import variant_of, variants
from midrib.errors import GeometryTypeError, ParameterError, RepairedAreaWarning
from midrib.figures.comparison import colours_of, draw_comparison
from midrib.figures.comparison_page import rows_of, write_comparison

L_SHAPE = Polygon([(0, 0), (10, 0), (10, 3), (3, 3), (3, 12), (0, 12)])
NOTCHED = Polygon([
    (0, 0), (40, 0), (40, 30), (34, 30), (34, 7), (22, 6), (20, 9), (18, 6), (0, 5),
])  # fmt: skip
BOW_TIE = Polygon([(50, 0), (52, 2), (52, 0), (50, 2)])
CURLED = Polygon([
    (0, 0), (10, 0), (10, 2), (5, 2), (5.001, 2.001), (5.001, 2), (5, 2.001), (0, 2),
])  # fmt: skip
NECK = shapely.union_all([
    box(0, 0, 5, 5),
    Polygon([(5, 2.5), (9, 2.5), (9, 2.51), (6.2, 2.51), (5, 2.51)]),
    box(9, 0, 14, 5),
])  # fmt: skip


def test_every_method_has_a_row_with_the_line_of_collapse() -> None:
    found = compare(L_SHAPE)
    first, *others = [method.name for method in midrib.methods()]
    assert [row.method for row in found.rows] == [first, "minimal-radii:none", *others]
    for row in found.rows:
        method, options = variant_of(row.method)
        assert row.line is not None
        assert row.line.equals(midrib.collapse(L_SHAPE, method, **options))
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


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("minimal-radii:none", {"centring": "none"}),
        ("minimal-radii:symmetric", {"centring": "symmetric"}),
        ("minimal-radii:centred", {}),
        ("mean-curve:kinks", {"method": "mean-curve", "mean": "kinks"}),
    ],
)
def test_variants_are_methods_with_an_option(name: str, options: dict[str, Any]) -> None:
    """Their lines and names, in the table and in the figure."""
    found = compare(NOTCHED, [name, "medial-axis"])
    assert found.rows[0].line == midrib.collapse(NOTCHED, **options)
    assert rows_of(found)[1][0] == name
    figure = draw_comparison(found)
    assert figure.axes[0].get_title(loc="left") == name
    assert figure.legends[0].get_texts()[0].get_text() == name


def test_panels_show_what_the_variant_is_made_of() -> None:
    """The middles of the radii are on the paper's curve, but not on the centred line."""
    found = compare(NOTCHED, ["minimal-radii:none", "minimal-radii"])
    paper, centred = (row.line for row in found.rows)
    assert paper is not None
    assert centred is not None
    drawn: list[Any] = list(draw_comparison(found).axes[0].collections)
    radii, *_, line = drawn
    middles = shapely.points(np.array(radii.get_segments()).mean(axis=1))
    assert np.array_equal(line.get_segments()[0], paper.coords)
    assert shapely.distance(paper, middles).max() < 1e-9
    assert shapely.distance(centred, middles).max() > 0.1


def test_panels_of_variants_have_radii_of_their_own() -> None:
    """The mean of two curves stays away from the ends, where the centred line does not."""
    drawn: list[Any] = [
        axes.collections[0]
        for axes in draw_comparison(
            compare(NOTCHED, ["minimal-radii:centred", "minimal-radii:symmetric"])
        ).axes[:2]
    ]
    centred, symmetric = (np.array(radii.get_segments()) for radii in drawn)
    assert not np.array_equal(centred, symmetric)


def test_variants_differ() -> None:
    found = compare(NOTCHED, sorted(variants()))
    lines = {row.method: row.line for row in found.rows}
    assert lines["minimal-radii"] == lines["minimal-radii:centred"]
    assert lines["mean-curve"] == lines["mean-curve:proportional"]
    assert len({line.wkb for line in lines.values() if line is not None}) == len(lines) - 2


def test_an_area_is_repaired_as_collapse_does_it() -> None:
    with pytest.warns(RepairedAreaWarning, match="area: repaired: Self-intersection at") as record:
        found = compare(CURLED, ["minimal-radii"])
    assert [warning.filename for warning in record] == [__file__]
    with pytest.warns(RepairedAreaWarning):
        assert found.rows[0].line == midrib.collapse(CURLED)
    assert found.area.is_valid
    assert found.notes[0].startswith("repaired: ")


def test_the_largest_part_is_compared_unless_another_is_chosen() -> None:
    parts = MultiPolygon([box(0, 0, 9, 2), box(0, 5, 30, 7), BOW_TIE])
    found = compare(parts, ["minimal-radii"])
    assert found.area.equals(parts.geoms[1])
    assert found.notes[0] == "part 1 of 0 to 2, the largest"
    assert "part 2 is left out: the area is not valid" in found.notes[1]
    chosen = compare(parts, ["minimal-radii"], part=0)
    assert chosen.area.equals(parts.geoms[0])
    assert chosen.notes == ["part 0 of 0 to 2"]
    assert compare(MultiPolygon([L_SHAPE]), ["minimal-radii"]).notes == []


@pytest.mark.parametrize(
    ("area", "part", "message"),
    [
        (BOW_TIE, None, "area: the area is not valid and can be read in more than one way"),
        (MultiPolygon([L_SHAPE, BOW_TIE]), 1, "area part 1: the area is not valid"),
        (Polygon(), None, "area is empty"),
        (L_SHAPE, 1, "part is 1, expected 0, the area has one part"),
        (MultiPolygon([box(0, 0, 1, 1), L_SHAPE]), 2, "part is 2, expected 0 to 1"),
        (MultiPolygon([box(0, 0, 1, 1), L_SHAPE]), 0.5, "part is 0.5, expected 0 to 1"),
        (MultiPolygon([box(0, 0, 1, 1), L_SHAPE]), "1", "part is '1', expected 0 to 1"),
    ],
)
def test_parts_without_a_line_are_refused(area: Any, part: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        compare(area, ["minimal-radii"], part=part)


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
        (["medial-axis:none"], "method is 'medial-axis:none', expected .*'mean-curve:kinks'"),
        (["minimal-radii:"], "method is 'minimal-radii:', expected .*'minimal-radii:none'"),
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


def test_tall_areas_are_turned_with_an_arrow_to_the_north() -> None:
    """North is on the right: what is drawn runs from left to right as the area goes north."""
    road = box(100, 0, 110, 3000)
    figure = draw_comparison(compare(road))
    assert [text.get_text().strip() for text in figure.texts] == ["N"]
    width, height = figure.get_size_inches()
    assert 0.5 <= height / width <= 2.0
    bold: Any = figure.axes[0].collections[-1]
    x, y = np.asarray(bold.get_segments()[0]).T
    assert sorted((x[0], x[-1])) == pytest.approx([0.0, 3000.0])
    assert y == pytest.approx(-105.0)
    thin: Any = figure.axes[-1].lines[0].get_xdata()
    assert sorted((thin[0], thin[-1])) == pytest.approx([0.0, 3000.0])
    assert draw_comparison(compare(L_SHAPE)).texts == []


def test_lines_on_each_other_are_all_seen() -> None:
    """Where lines coincide the dashes of each method are in the gaps of the others."""
    pytest.importorskip("matplotlib")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.colors import to_rgb

    names = ["minimal-radii", "medial-axis", "chordal-axis"]
    found = compare(box(0, 0, 9, 2), names)
    figure = draw_comparison(found)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()  # type: ignore[no-untyped-call]
    panel = figure.axes[-1].get_window_extent()
    pixels = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
    picture = pixels[::-1, :, :3] / 255.0
    inside = picture[int(panel.y0) : int(panel.y1), int(panel.x0) : int(panel.x1)]
    seen = [
        int((np.abs(inside - to_rgb(colour)).max(axis=2) < 0.05).sum())
        for colour in colours_of(found.rows)
    ]
    assert min(seen) > 0.5 * max(seen) > 20


def test_methods_have_the_colours_of_the_paper_and_no_two_the_same() -> None:
    """The curve is black, medial axes green, straight skeletons brown, mean curves purple."""
    pytest.importorskip("matplotlib")
    rows = compare(box(0, 0, 9, 2)).rows
    colours = dict(zip([row.method for row in rows], colours_of(rows), strict=True))
    assert len(set(colours.values())) == len(rows)
    hues = {
        name: colorsys.rgb_to_hsv(*(int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5)))
        for name, colour in colours.items()
    }
    assert hues["minimal-radii"][2] < 0.1
    assert 90 < 360 * hues["medial-axis"][0] < 160
    assert 20 < 360 * hues["straight-skeleton"][0] < 45
    assert hues["straight-skeleton"][2] < 0.8
    assert 270 < 360 * hues["mean-curve"][0] < 300


def test_a_page_says_that_centredness_does_not_see_islands(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    for area, is_told in ((box(0, 0, 9, 2), False), (box(0, 0, 9, 3) - box(4, 1, 5, 2), True)):
        write_comparison(compare(area, ["minimal-radii"]), tmp_path / "page.html", "an area")
        assert ("does not see islands" in (tmp_path / "page.html").read_text()) == is_told
