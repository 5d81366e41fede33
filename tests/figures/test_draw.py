"""Pictures: everything asked for is on the sheet, to scale, and the same each time."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import MultiPolygon, Polygon, box
from shapely.affinity import scale

from midrib import collapse
from midrib.errors import MissingDependencyError, ParameterError
from tests.shapes import NOT_FINITE

pytest.importorskip("matplotlib")

from midrib.figures.draw import check_figure, draw_collapse, spread
from midrib.figures.paper import length_label, round_length, sheet_for

STRIP = box(0, 0, 90, 20)
BOW_TIE = Polygon([(0, 0), (8, 8), (8, 0), (0, 8)])
HOLES = Polygon(STRIP.exterior.coords, [[(40, 8), (50, 8), (50, 12), (40, 12)]])


def names(figure: object) -> list[str]:
    """Entries of the legend."""
    return [text.get_text() for text in figure.legends[0].get_texts()]  # type: ignore[attr-defined]


def test_everything_is_in_the_legend() -> None:
    assert names(draw_collapse([STRIP, BOW_TIE])) == [
        "area",
        "refused",
        "radii",
        "main curve",
        "auxiliary curve",
        "line",
    ]


@pytest.mark.parametrize("options", [{}, {"simplify": "5%"}, {"geographic": True}])
def test_connected_lines_are_drawn_with_dots_at_their_joints(options: dict[str, Any]) -> None:
    areas = [STRIP, None, BOW_TIE, box(90, 0, 150, 20), box(40, -70, 50, 0)]
    if "geographic" in options:
        areas = [scale(area, 1e-4, 1e-4, origin=(0, 0)) if area else None for area in areas]
    figure = draw_collapse(areas, connect=True, **options)
    assert names(figure)[-2:] == ["line", "joint"]
    lines, problems = collapse(areas, connect=True, on_error="report", **options)
    drawn = figure.axes[0].collections[-1].get_segments()  # type: ignore[attr-defined]
    for chain, line in zip(drawn, lines[[0, 3, 4]], strict=True):
        assert chain == pytest.approx(shapely.get_coordinates(line), abs=1e-9)
    joints = [p.point.coords[0] for p in problems if p.status == "joint"]
    assert len(joints) == 2
    assert figure.axes[0].lines[0].get_xydata() == pytest.approx(np.array(joints))


def test_what_places_ends_is_not_drawn_connected() -> None:
    with pytest.raises(ParameterError, match="connect places the ends"):
        draw_collapse([STRIP], connect=True, ends="main")


def test_thin_areas_are_drawn_as_their_line_only() -> None:
    assert names(draw_collapse(box(0, 0, 900, 1))) == ["area", "line"]


@pytest.mark.parametrize("areas", [[], [None], [Polygon()], STRIP, [HOLES, None]])
@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_any_areas_can_be_drawn(areas: object, ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"picture.{ending}"
    draw_collapse(areas, path)
    start = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF"}[ending]
    assert path.read_bytes().startswith(start)


@pytest.mark.parametrize(
    "other",
    [
        shapely.Point(500, 500),
        shapely.LineString([(0, 0), (0, 500)]),
        shapely.GeometryCollection([shapely.Point(500, 500), STRIP]),
        NOT_FINITE,
        shapely.affinity.translate(NOT_FINITE, np.inf),
    ],
)
def test_what_is_no_area_is_left_out_of_the_sheet(other: object, tmp_path: Path) -> None:
    alone, among = tmp_path / "alone.svg", tmp_path / "among.svg"
    draw_collapse([STRIP, BOW_TIE], alone)
    draw_collapse([other, STRIP, None, BOW_TIE], among)
    assert among.read_bytes() == alone.read_bytes()


def test_the_same_areas_give_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one.svg", "other.svg"):
        draw_collapse([STRIP, HOLES], tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "other.svg").read_bytes()


@pytest.mark.parametrize(
    "area", [box(0, 0, 90, 20), box(0, 0, 20, 90), box(5e5, 5e6, 5e5 + 1, 5e6 + 1)]
)
def test_sheets_are_true_to_scale(area: Polygon) -> None:
    paper = sheet_for(np.array([area], dtype=object), False, 200.0)
    width, height = paper.figure.get_size_inches() * 25.4
    place = paper.axes.get_position()
    x, y = np.ptp(paper.axes.get_xlim()), np.ptp(paper.axes.get_ylim())
    assert place.width * width / x == pytest.approx(paper.scale[0])
    assert place.height * height / y == pytest.approx(paper.scale[1])
    assert paper.scale[0] == paper.scale[1]


def test_degrees_are_squeezed_as_on_the_ground() -> None:
    paper = sheet_for(np.array([box(5, 59.9, 6, 60.1)], dtype=object), True, 200.0)
    assert paper.scale[0] / paper.scale[1] == pytest.approx(0.5, abs=0.005)


def test_holes_and_parts_are_left_and_filled() -> None:
    from midrib.figures.paper import path_of

    path = path_of(MultiPolygon([HOLES, box(0, 50, 90, 70)]))
    assert len(path.vertices) == len(shapely.get_coordinates([HOLES, STRIP]))
    assert np.count_nonzero(path.codes == path.MOVETO) == 3


def test_radii_are_thinned_out_on_paper() -> None:
    assert spread(np.full(9, 0.125)).sum() == 3
    assert spread(np.full(9, 5.0)).all()
    assert spread(np.empty(0)).tolist() == [True]


@pytest.mark.parametrize(
    ("length", "expected"), [(7.3, 5.0), (1.0, 1.0), (0.029, 0.02), (2e5, 2e5)]
)
def test_scale_bars_are_round(length: float, expected: float) -> None:
    assert round_length(length) == pytest.approx(expected)


def test_scale_bars_name_their_unit() -> None:
    assert length_label(500.0, "m") == "500 m"
    assert length_label(2000.0, "m") == "2 km"
    assert length_label(0.5, None) == "0.5 units"


def test_other_endings_are_refused() -> None:
    with pytest.raises(ParameterError, match=r"'a.gif' ends in '.gif', expected .svg, .png, .pdf"):
        check_figure(Path("a.gif"))


def test_missing_matplotlib_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("midrib.checks.find_spec", lambda _: None)
    with pytest.raises(MissingDependencyError, match=r"pip install midrib\[figures\]"):
        check_figure(Path("a.svg"))


def test_holes_that_turn_like_their_shell_are_not_filled() -> None:
    from midrib.figures.paper import path_of

    shell, hole = [(0, 0), (9, 0), (9, 9), (0, 9)], [(3, 3), (6, 3), (6, 6), (3, 6)]
    for rings in (hole, hole[::-1]):
        path = path_of(shapely.Polygon(shell, [rings]))
        corners = path.vertices
        turns = [
            shapely.is_ccw(shapely.linearrings(corners[i : i + 5])) for i in (0, len(corners) - 5)
        ]
        assert turns[0] != turns[1]
