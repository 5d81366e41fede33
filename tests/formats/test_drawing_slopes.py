"""Slopes of a register as a drawing."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import LineString, Point, Polygon, box

from midrib.errors import ParameterError
from midrib.formats.drawing.content import LEFT_OUT, REFUSED, Drawing
from midrib.formats.drawing.slopes import check_standard, draw_slopes
from midrib.formats.slopes import read_slopes
from midrib.hatching.slope import Slope, SlopeKind, SlopeProblem
from tests.formats.layers import projjson

SHARED = Path(__file__).parents[3] / "shared" / "data"
FEET = projjson("EPSG:2263")  # New York Long Island, US survey feet


def slope(
    name: str, kind: SlopeKind = "slope-unreinforced", y: float = 0.0, **values: Any
) -> Slope:
    """Slope of 30 by 4."""
    top, toe = LineString([(0, y + 4), (30, y + 4)]), LineString([(0, y), (30, y)])
    return Slope(name, kind, box(0, y, 30, y + 4), top, toe, "test", **values)


BOW_TIE = Slope(
    "tie",
    "dyke",
    Polygon([(0, 0), (9, 9), (9, 0), (0, 9)]),
    LineString([(0, 0), (9, 9)]),
    LineString([(9, 0), (0, 9)]),
    "test",
)


def test_each_kind_has_its_standard() -> None:
    kinds: list[SlopeKind] = ["slope-reinforced", "cutting", "conveyor", "other"]
    drawing = draw_slopes([slope(kind, kind, 9.0 * i) for i, kind in enumerate(kinds)], "pl-2015")
    assert [drawn.symbols.standard.name.removeprefix("pl-2015-") for drawn in drawing.objects] == [
        "slope-reinforced",
        "cutting",
        "conveyor",
        "slope-unreinforced",
    ]
    assert [drawn.is_long is None for drawn in drawing.objects] == [False, False, True, False]


def test_what_is_not_drawn_is_listed_with_its_place() -> None:
    problems = [
        SlopeProblem("lost", "refused", "no top"),
        SlopeProblem("odd", "nudged", "a vertex"),
    ]
    drawing = draw_slopes([slope("a"), slope("b", "stairs"), BOW_TIE], "iof-104", problems=problems)
    assert [drawn.id for drawn in drawing.objects] == ["a"]
    assert [(t.id, t.kind) for t in drawing.problems] == [
        ("lost", REFUSED),
        ("odd", "nudged"),
        ("b", LEFT_OUT),
        ("tie", REFUSED),
    ]
    assert "no symbol for an object of kind 'stairs'" in drawing.problems[2].reason
    assert drawing.problems[2].where is not None
    assert drawing.n_refused == 2


def test_doubts_about_the_top_are_listed_and_change_nothing() -> None:
    fall: dict[str, Any] = {"top_heights": np.array([[0.0, 4.0, 168.0]])}
    toe_heights = np.array([[15.0, 0.0, 170.0]])
    plain = draw_slopes([slope("a")])
    for heights, kinds in ((fall | {"toe_heights": toe_heights}, ["swapped"]), (fall, [])):
        drawing = draw_slopes([slope("a", **heights)])
        assert [trouble.kind for trouble in drawing.problems] == kinds
        assert [trouble.where for trouble in drawing.problems] == [Point(15, 0)] * len(kinds)
        lines = [one.objects[0].symbols.lines for one in (drawing, plain)]
        assert shapely.equals_exact(*lines, tolerance=0.0).all()
    short = LineString([(0, 0), (0, 4)]), LineString([(0, 4), (30, 4), (30, 0), (0, 0)])
    drawing = draw_slopes([Slope("b", "other", box(0, 0, 30, 4), *short, "test")])
    assert "orientation" in {trouble.kind for trouble in drawing.problems}


def test_values_are_for_strokes_of_several_standards_and_for_any_single_one() -> None:
    slopes = [slope("a"), slope("w", "wall", 9.0)]
    drawing = draw_slopes(slopes, "pl-2021", values={"spacing": 3.0})
    assert [drawn.symbols.standard.spacing for drawn in drawing.objects] == [3.0, 11.0]
    drawing = draw_slopes(slopes, "pl-2021-wall", values={"spacing": 3.0})
    assert [drawn.symbols.standard.spacing for drawn in drawing.objects] == [3.0]


def test_units_are_those_of_the_crs() -> None:
    drawing = draw_slopes([slope("a", crs=FEET)], values={"spacing": 2.0})  # 1 m at 1:500
    assert drawing.metres_per_unit == pytest.approx(1200 / 3937)
    places = np.array([line.coords[0][0] for line in drawing.objects[0].symbols.lines])
    assert np.diff(places) == pytest.approx(3937 / 1200, rel=0.1)


def test_coordinates_of_one_plane_are_needed() -> None:
    with pytest.raises(ParameterError, match="in degrees, expected a CRS in a plane"):
        draw_slopes([slope("a", crs=projjson("EPSG:4326"))])
    with pytest.raises(ParameterError, match="in 2 different CRS, expected one"):
        draw_slopes([slope("a", crs=FEET), slope("b")])


def test_heights_make_a_slope_gentle() -> None:
    def gaps(drop: float) -> int:
        heights: dict[str, Any] = {
            "top_heights": np.array([[0.0, 4.0, 100.0 + drop]]),
            "toe_heights": np.array([[0.0, 0.0, 100.0]]),
        }
        return len(draw_slopes([slope("a", **heights)], "de-general").objects[0].symbols.lines)

    assert gaps(4.0) == pytest.approx(2 * gaps(1.0), abs=2)


def test_a_shared_edge_is_drawn_once() -> None:
    drawing = draw_slopes([slope("a"), slope("b", y=4.0), slope("c", y=20.0)])
    edges = [shapely.union_all(drawn.symbols.edges) for drawn in drawing.objects]
    assert [edge.length for edge in edges] == pytest.approx([68.0, 38.0, 68.0])
    assert len(drawing.objects[1].symbols.edges) == 1  # one dashed line, not three
    assert not edges[0].intersection(edges[1]).length
    assert edges[2].is_ring


def test_crossing_edges_are_left_as_they_are() -> None:
    drawing = draw_slopes([slope("a"), slope("b", y=2.0)])
    assert [len(drawn.symbols.edges) for drawn in drawing.objects] == [1, 2]


def test_nothing_makes_an_empty_drawing() -> None:
    drawing = draw_slopes([])
    assert drawing == Drawing(500.0)
    assert (drawing.bounds == 0.0).all()


def test_standards_are_checked_before_any_work() -> None:
    check_standard("pl-2021", {"symbol": "wedge", "symbol_width": 0.4}, 500.0)
    with pytest.raises(ParameterError, match="standard is 'pl-2035'"):
        check_standard("pl-2035", {}, 500.0)
    with pytest.raises(ParameterError, match="key 'symbol' is 'zigzag'"):
        check_standard("pl-2021", {"symbol": "zigzag"}, 500.0)


@pytest.mark.shared
@pytest.mark.skipif(not SHARED.exists(), reason="the folder of shared test data is absent")
@pytest.mark.parametrize("symbol", ["line", "wedge", "tadpole"])
def test_real_slopes_have_symbols_that_keep_apart(symbol: str) -> None:
    slopes, _ = read_slopes(SHARED / "pl_bdot500_opole_west.gml")
    drawing = draw_slopes(slopes[::4], "pl-2015", values={"symbol": symbol, "symbol_width": 0.6})
    assert len(drawing.objects) == len(slopes[::4])
    for drawn, one in zip(drawing.objects, slopes[::4], strict=True):
        flat = drawn.symbols.flat()
        grown = one.area.buffer(1e-6)
        assert shapely.covers(grown, [*flat.lines, *flat.areas]).all()
        ink = np.array([*flat.lines, *flat.areas])
        stroke = np.array([*flat.line_stroke, *flat.area_stroke])
        tree = shapely.STRtree(ink)
        near = tree.query(ink, predicate="dwithin", distance=1e-6)
        apart = stroke[near[0]] != stroke[near[1]]
        crossing = [
            (a, b)
            for a, b in near[:, apart].T
            if shapely.intersection(ink[a], ink[b]).length > 1e-6
        ]
        assert not crossing
