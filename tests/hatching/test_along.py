"""Symbols along an object: ticks, circles, templates."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from shapely import LineString
from shapely.affinity import rotate

from midrib import Strip, standard
from midrib.errors import ParameterError
from midrib.hatching.along import symbols_along
from midrib.types import Floats

X = np.linspace(0.0, 60.0, 61)
WAVE = 5.0 * np.sin(X / 8.0)
STRIPS = {
    "rectangle": Strip(LineString([(0, 0), (30, 0)]), LineString([(0, 2), (30, 2)])),
    "corner": Strip(
        LineString([(0, 0), (20, 0), (20, 20)]), LineString([(0, -1), (21, -1), (21, 20)])
    ),
    "wave": Strip(
        LineString(np.column_stack([X, WAVE])),
        LineString(np.column_stack([X, WAVE + 4.0 + 2.0 * np.cos(X / 9.0)])),
    ),
    "hairpin": Strip(
        LineString([(0, 3), (20, 3), (20, 3.5), (0, 3.5)]),
        LineString([(0, 0), (23, 0), (23, 6.5), (0, 6.5)]),
    ),
}
strips = pytest.mark.parametrize("strip", STRIPS.values(), ids=STRIPS)


def circles_of(strip: Strip, scale: float = 500.0) -> tuple[Floats, Floats]:
    """Middles and radii of the circles of a conveyor."""
    (placed,) = symbols_along(strip, "pl-2015-conveyor", scale).placed
    return placed.at, placed.size / 2.0


@strips
def test_every_second_circle_is_tangent_to_both_edges(strip: Strip) -> None:
    (placed,) = symbols_along(strip, "pl-2015-conveyor").placed
    large = placed.stroke % 2 == 0
    assert large.sum() >= 3
    middles, radius = shapely.points(placed.at), placed.size / 2.0
    for edge in (strip.main, strip.auxiliary):
        assert shapely.distance(middles[large], edge) == pytest.approx(radius[large], rel=1e-5)
        assert (shapely.distance(middles[~large], edge) > 1.5 * radius[~large]).all()


@strips
@pytest.mark.parametrize("factor", [0.3, 0.6, 1.0])
def test_circles_are_inside_and_do_not_overlap(strip: Strip, factor: float) -> None:
    (placed,) = symbols_along(strip, standard("pl-2015-conveyor", factor=factor)).placed
    middles, radius = placed.at, placed.size / 2.0
    assert (shapely.distance(shapely.points(middles), strip.area.boundary) >= radius - 1e-9).all()
    apart = np.hypot(*(middles[:, None] - middles).transpose(2, 0, 1))
    free = apart - radius[:, None] - radius
    assert free[~np.eye(len(radius), dtype=np.bool_)].min() > -1e-9


def test_circles_of_a_rectangle_are_a_width_apart() -> None:
    middles, radius = circles_of(STRIPS["rectangle"])
    places = np.column_stack([np.arange(1.0, 30.0, 2.0), np.ones(15)])
    assert middles == pytest.approx(places, abs=1e-4)
    assert radius == pytest.approx(np.resize([1.0, 0.5], 15), rel=1e-5)


def test_caps_that_belong_to_an_edge_have_no_circles_of_their_own() -> None:
    """Registers give the top; the toe is the rest of the ring, with both short sides."""
    toe = [(0, 2), (0, 0), (30, 0), (30, 2)]
    middles, radius = circles_of(Strip(LineString([(0, 2), (30, 2)]), LineString(toe)))
    assert middles[:, 0] == pytest.approx(np.arange(1.0, 30.0, 2.0), abs=5e-3)
    assert middles[:, 1] == pytest.approx(1.0, abs=5e-3)
    assert radius == pytest.approx(np.resize([1.0, 0.5], 15), rel=5e-3)


def test_circles_do_not_depend_on_the_scale_where_only_the_width_counts() -> None:
    for here, there in zip(
        *(circles_of(STRIPS["wave"], scale) for scale in (500, 1000)), strict=True
    ):
        assert here == pytest.approx(there)


def test_tips_are_left_to_themselves() -> None:
    x = np.linspace(0.0, 30.0, 31)
    y = 1.5 * np.sin(np.pi * x / 30.0)
    lens = Strip(LineString(np.column_stack([x, y])), LineString(np.column_stack([x, -y])))
    middles, radius = circles_of(lens)
    assert 2.0 * radius.min() >= 0.5 * 2.0 * 0.18 * 0.5  # half of two line widths, small circles
    assert middles[:, 1] == pytest.approx(0.0, abs=1e-6)
    assert len(middles) > 15


def test_a_fixed_spacing_is_that_of_the_paper() -> None:
    known = standard("pl-2015-conveyor", spacing=10.0)  # 5 units at 1:500
    (placed,) = symbols_along(STRIPS["rectangle"], known).placed
    assert placed.at[:, 0] == pytest.approx(np.linspace(1.0, 29.0, 6), abs=1e-4)


@strips
def test_ticks_reach_from_edge_to_edge_at_45_degrees(strip: Strip) -> None:
    found = symbols_along(strip, "pl-2021-wall")
    for tick in found.lines:
        start, end = shapely.points(tick.coords)
        assert strip.main.distance(start) < 1e-9
        assert strip.area.boundary.distance(end) < 1e-9
        assert strip.area.buffer(1e-9).covers(tick)
        station = strip.main.project(start)
        nudge = 1e-6
        way = np.subtract(*(strip.main.interpolate(station + d).coords[0] for d in (nudge, 0.0)))
        angle = np.degrees(np.arccos(way @ np.subtract(*tick.coords[::-1]) / nudge / tick.length))
        assert angle == pytest.approx(45.0, abs=1e-3)


@strips
def test_ticks_do_not_meet(strip: Strip) -> None:
    ticks = symbols_along(strip, standard("pl-2021-wall", spacing=2.0)).lines
    assert len(ticks) > 10
    touching = shapely.intersects(ticks[:, None], ticks)
    assert (touching == np.eye(len(ticks), dtype=np.bool_)).all()


@pytest.mark.parametrize(("scale", "apart", "pair"), [(500, 5.5, 0.5), (1000, 8.25, 0.75)])
def test_ticks_come_in_pairs_at_the_spacing_of_the_scale(
    scale: int, apart: float, pair: float
) -> None:
    found = symbols_along(STRIPS["rectangle"], "pl-2021-wall", scale)
    first = shapely.get_coordinates(shapely.get_point(found.lines, 0))[:, 0]
    assert first.reshape(-1, 2) @ [-1, 1] == pytest.approx(pair)
    assert np.diff(first[::2]) == pytest.approx(apart)
    assert first[0] == pytest.approx(30.0 - first[-1])  # the row is in the middle
    assert first[0] < apart
    assert found.line_stroke.tolist() == np.repeat(np.arange(len(first) // 2), 2).tolist()


def test_ticks_go_round_a_closed_wall() -> None:
    ring = shapely.Point(0, 0).buffer(10.0, quad_segs=90).exterior
    inner = shapely.Point(0, 0).buffer(9.0, quad_segs=90).exterior

    class Round:
        main, auxiliary = LineString(ring), LineString(inner)
        area = shapely.Polygon(ring, [inner])

    ticks = symbols_along(Round, standard("pl-2021-wall", pair=0.0)).lines  # type: ignore[arg-type]
    assert len(ticks) == round(ring.length / 5.5)
    starts = shapely.points([tick.coords[0] for tick in ticks])
    apart = [a.distance(b) for a, b in pairwise([*starts, starts[0]])]
    assert apart == pytest.approx(apart[:1] * len(apart), rel=1e-3)
    assert shapely.length(ticks) == pytest.approx(1.5, rel=0.02)


@pytest.mark.parametrize("name", ["pl-2015-gantry", "pl-2015-water-gate"])
@pytest.mark.parametrize("angle", [0.0, 30.0, 200.0])
def test_a_template_reaches_across_the_middle(name: str, angle: float) -> None:
    rectangle = STRIPS["rectangle"]
    strip = Strip(
        *(rotate(line, angle, origin=(0, 0)) for line in (rectangle.main, rectangle.auxiliary))
    )
    drawn = symbols_along(strip, name).flat().lines
    assert (
        max(
            shapely.distance(drawn, strip.main).min(),
            shapely.distance(drawn, strip.auxiliary).min(),
        )
        < 1e-9
    )
    assert strip.area.buffer(1e-9).covers(shapely.multilinestrings(drawn))
    upright = rotate(shapely.multilinestrings(drawn), -angle, origin=(0, 0))
    assert upright.bounds == pytest.approx((14.5, 0.0, 15.5, 2.0))
    assert [line.length for line in drawn] == pytest.approx(
        [2.0 * LineString(line).length for line in standard(name).template]
    )


def test_a_gate_points_back_along_its_line() -> None:
    rectangle = STRIPS["rectangle"]
    (leaves,) = symbols_along(rectangle, "pl-2015-water-gate").flat().lines
    assert leaves.coords[1] == pytest.approx((14.5, 1.0))
    turned = Strip(rectangle.main.reverse(), rectangle.auxiliary.reverse())
    (leaves,) = symbols_along(turned, "pl-2015-water-gate").flat().lines
    assert leaves.coords[1] == pytest.approx((15.5, 1.0))


def test_strokes_take_a_hatching() -> None:
    with pytest.raises(ParameterError, match="'iof-104' draws 'line', which takes the strokes"):
        symbols_along(STRIPS["rectangle"], "iof-104")
