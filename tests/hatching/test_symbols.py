"""Symbols made of strokes: where they are, how large, and that they keep apart."""

from collections.abc import Callable
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np
import pytest
import shapely
from shapely.affinity import scale, translate

from midrib import standard
from midrib.errors import ParameterError
from midrib.hatching.drawn import Symbols
from midrib.hatching.keys import STROKED
from midrib.hatching.symbols import symbols
from tests.hatching.standin import Sides, bend, mound, rectangle

Shape = Callable[..., Any]
WIDE = 1.2  # millimetres: 0.6 units at 1:500
SHIFT = np.array([5e5, 5e6])
SHAPES: dict[str, tuple[Shape, int]] = {
    "dense_ring": (mound, 120),
    "uneven": (partial(rectangle, spread=3.0), 40),
    "rectangle": (rectangle, 9),
    "mound": (mound, 40),
    "bend": (bend, 40),
}
shapes = pytest.mark.parametrize("shape", SHAPES)
kinds = pytest.mark.parametrize("kind", STROKED)


def drawn(shape: str, kind: str, **values: Any) -> tuple[Any, Symbols]:
    """Chords of a shape and their symbols, wide ones."""
    make, count = SHAPES[shape]
    known = standard(
        "pl-2021-slope-unreinforced", **({"symbol": kind, "symbol_width": WIDE} | values)
    )
    hatching = make(known, count=count)
    return hatching, symbols(hatching)


@kinds
@shapes
def test_symbols_are_inside_the_area(shape: str, kind: str) -> None:
    hatching, found = drawn(shape, kind)
    flat = found.flat()
    grown = hatching.strip.area.buffer(1e-6)
    assert shapely.covers(grown, flat.lines).all()
    assert shapely.covers(grown, flat.areas).all()
    assert shapely.is_valid(flat.areas).all()


@kinds
@shapes
def test_symbols_of_different_strokes_do_not_overlap(shape: str, kind: str) -> None:
    flat = drawn(shape, kind)[1].flat()
    ink = [
        *zip(flat.lines, flat.line_stroke, strict=True),
        *zip(flat.areas, flat.area_stroke, strict=True),
    ]
    for (a, of_a), (b, of_b) in combinations(ink, 2):
        assert of_a == of_b or shapely.distance(a, b) > 1e-9


@kinds
@shapes
def test_every_stroke_is_drawn_and_keeps_its_end(shape: str, kind: str) -> None:
    hatching, found = drawn(shape, kind)
    flat = found.flat()
    for i, stroke in enumerate(hatching.strokes):
        ink = shapely.unary_union(
            [*flat.lines[flat.line_stroke == i], *flat.areas[flat.area_stroke == i]]
        )
        start, end = shapely.points(shapely.get_coordinates(stroke))
        assert ink.distance(end) < 1e-9
        if kind not in {"tadpole", "y"}:
            assert ink.distance(start) < 1e-9


@kinds
def test_strokes_of_equal_room_have_equal_symbols(kind: str) -> None:
    flat = drawn("mound", kind)[1].flat()
    for geometries, stroke in ((flat.lines, flat.line_stroke), (flat.areas, flat.area_stroke)):
        ink = np.bincount(stroke, shapely.length(geometries), minlength=40).reshape(-1, 2)
        # The rings are polygons of 72 sides: their corners break the symmetry a little.
        assert ink == pytest.approx(np.tile(ink.mean(axis=0), (20, 1)), rel=0.02)


def test_wedges_are_triangles_on_the_top() -> None:
    _, found = drawn("rectangle", "wedge")
    assert found.lines.size == 0
    long, short = 0.5 * 0.6 * 6.0, 0.5 * 0.6 * 3.0
    ends = np.array([0.5, 1, 1, 1, 1, 1, 1, 1, 0.5])  # the first and the last have half the top
    assert shapely.area(found.areas) == pytest.approx(np.resize([long, short], 9) * ends)
    assert found.areas[1].equals(shapely.Polygon([(2.2, 6), (2.8, 6), (2.5, 3)]))


def test_a_tapered_stroke_is_a_wedge_and_a_line() -> None:
    wedge, tapered = drawn("bend", "wedge")[1], drawn("bend", "tapered")[1]
    assert shapely.equals(wedge.areas, tapered.areas).all()
    assert shapely.equals(tapered.lines, drawn("bend", "line")[0].strokes).all()


def test_triangles_are_equilateral_with_a_tail() -> None:
    _, found = drawn("rectangle", "filled-triangle")
    height = 0.6 * 3.0**0.5 / 2.0
    assert shapely.area(found.areas[1:-1]) == pytest.approx(0.5 * 0.6 * height)
    assert shapely.length(found.lines[1:-1]) == pytest.approx(np.resize([3.0, 6.0], 7) - height)
    _, hollow = drawn("rectangle", "triangle")
    rings = [line for line in hollow.lines if line.is_closed]
    assert [shapely.area(shapely.polygons(ring.coords)) for ring in rings] == pytest.approx(
        shapely.area(found.areas)
    )


def test_a_fork_is_as_deep_as_wide() -> None:
    _, found = drawn("rectangle", "y")
    fork, tail = found.lines[found.line_stroke == 1]
    assert fork.equals(shapely.LineString([(2.2, 6), (2.5, 5.4), (2.8, 6)]))
    assert tail.equals(shapely.LineString([(2.5, 5.4), (2.5, 3)]))


def test_the_fork_of_a_short_stroke_takes_half_of_it() -> None:
    chords = rectangle(
        standard("pl-2021-slope-unreinforced", symbol="y", symbol_width=WIDE), short=0.1
    )
    found = symbols(chords)
    fork, tail = found.lines[found.line_stroke == 1]
    assert fork.coords[1] == pytest.approx((2.5, 5.7))
    assert tail.length == pytest.approx(0.3)


@kinds
@shapes
def test_nothing_is_drawn_twice_in_a_place(shape: str, kind: str) -> None:
    """No line without a length, no point of an area twice."""
    flat = drawn(shape, kind)[1].flat()
    assert (shapely.length(flat.lines) > 0.0).all()
    ink = np.array([*flat.lines, *flat.areas])
    plain = shapely.remove_repeated_points(ink)
    assert (shapely.get_num_coordinates(plain) == shapely.get_num_coordinates(ink)).all()


@kinds
def test_strokes_without_a_length_do_no_harm(kind: str) -> None:
    known = standard("pl-2021-slope-unreinforced", symbol=kind, symbol_width=WIDE)
    flat = symbols(rectangle(known, short=0.0)).flat()
    corners = shapely.get_coordinates([*flat.lines, *flat.areas])
    assert np.isfinite(corners).all()


def test_heads_are_as_large_as_fits() -> None:
    """Strokes go outward 3 degrees apart; a head takes 0.49 of the way to the next one.

    It may lie two radii below the top.
    """
    (heads,) = drawn("dense_ring", "tadpole")[1].placed
    apart = 0.49 * np.sin(np.radians(3.0))
    radius = 6.0 * apart / (1.0 - 2.0 * apart)
    assert heads.size.max() <= 2.0 * radius * 1.001  # the ring is a polygon
    assert heads.size.min() >= 2.0 * radius * 0.96


def test_heads_are_discs_below_the_top() -> None:
    _, found = drawn("rectangle", "tadpole")
    (heads,) = found.placed
    assert heads.stroke.tolist() == [1, 2, 3, 4, 5, 6, 7]  # on the sides there is no room for one
    assert heads.size == pytest.approx(0.6)
    assert heads.at[:, 1] == pytest.approx(6.0 - 1.05 * 0.3)
    areas = shapely.area(found.flat().areas)
    assert areas == pytest.approx(np.pi * 0.3**2, rel=1e-3)


def test_where_strokes_are_dense_symbols_are_narrow() -> None:
    known = standard("pl-2021-slope-unreinforced", symbol="wedge", symbol_width=WIDE)
    found = symbols(rectangle(known, count=101))
    base = shapely.area(found.areas[2:-2:2]) / 3.0
    assert base == pytest.approx(0.9 * 0.2)  # nine tenths of what is between the middles of gaps


def test_a_base_reaches_as_far_as_each_gap_lets_it() -> None:
    known = standard("pl-2021-slope-unreinforced", symbol="wedge", symbol_width=2.0)
    hatching = rectangle(known, count=12, spread=2.0)
    x, found = hatching.on_top[:, 0], symbols(hatching)
    room = np.concatenate([[0.0], 0.45 * np.diff(x), [0.0]])
    low, _, high, _ = shapely.bounds(found.areas).T
    assert x - low == pytest.approx(np.minimum(room[:-1], 0.5), abs=1e-6)
    assert high - x == pytest.approx(np.minimum(room[1:], 0.5), abs=1e-6)


def test_a_dense_ring_is_even_all_round() -> None:
    bases = shapely.area(drawn("dense_ring", "wedge")[1].areas[::2])
    assert bases == pytest.approx(bases.mean(), rel=0.02)


def test_sizes_are_those_of_the_paper() -> None:
    known = standard("pl-2021-slope-unreinforced", symbol="wedge", symbol_width=1.0)
    at_500, at_1000 = (symbols(rectangle(known, s)).areas for s in (500.0, 1000.0))
    assert shapely.area(at_1000) == pytest.approx(2.0 * shapely.area(at_500))
    feet = symbols(rectangle(known), metres_per_unit=0.3048).areas
    assert shapely.area(feet) == pytest.approx(shapely.area(at_500) / 0.3048)


def moved(hatching: Any, move: Callable[[Any], Any]) -> Any:
    """Chords with all geometries moved."""
    points = [
        shapely.get_coordinates([move(p) for p in shapely.points(xy)])
        for xy in (hatching.on_top, hatching.on_toe)
    ]
    strokes = np.array([move(stroke) for stroke in hatching.strokes])
    return hatching._replace(
        strokes=strokes, on_top=points[0], on_toe=points[1], strip=Sides(*map(move, hatching.strip))
    )


@kinds
@pytest.mark.parametrize("power", [-30, 7])
def test_doubling_is_exact(kind: str, power: int) -> None:
    hatching, found = drawn("bend", kind)
    factor = 2.0**power
    larger = moved(hatching, lambda g: scale(g, factor, factor, origin=(0, 0)))
    other = symbols(larger, metres_per_unit=1.0 / factor).flat()
    for name in ("lines", "areas", "edges"):
        here, there = (shapely.get_coordinates(getattr(s, name)) for s in (found.flat(), other))
        assert (here * factor == there).all()


@kinds
def test_far_from_the_origin_symbols_are_the_same(kind: str) -> None:
    hatching, found = drawn("bend", kind)
    there = symbols(moved(hatching, lambda g: translate(g, *SHIFT))).flat()
    for name in ("lines", "areas"):
        here, far = (shapely.get_coordinates(getattr(s, name)) for s in (found.flat(), there))
        assert here.shape == far.shape
        assert np.abs(here + SHIFT - far).max(initial=0.0) < 1e-6


def test_short_strokes_are_wedges_where_the_standard_says_so() -> None:
    known = standard("de-general")
    steep = symbols(rectangle(known, 5000.0))  # 6 units are 1.2 mm, short strokes 0.6
    assert steep.area_stroke.tolist() == [1, 3, 5, 7]
    assert steep.line_stroke.tolist() == [0, 2, 4, 6, 8]
    assert symbols(rectangle(known, 500.0)).areas.size == 0


def test_the_outline_is_what_the_standard_draws() -> None:
    ring = symbols(mound(standard("pl-2021-slope-reinforced")))
    assert len(ring.edges) == 2
    (top,) = symbols(mound(standard("iof-104"))).edges
    assert top.equals(mound("iof-104").strip.main)
    assert symbols(rectangle(standard("tadpole"))).edges.size == 0


def test_a_single_stroke_and_none() -> None:
    known = standard("pl-2021-slope-unreinforced", symbol="wedge")
    assert len(symbols(rectangle(known, count=1)).areas) == 1
    assert len(symbols(mound(known, count=1)).areas) == 1
    assert len(symbols(rectangle(known, count=0)).areas) == 0


def test_a_name_will_do_for_the_standard() -> None:
    assert symbols(rectangle("iof-104")).standard == standard("iof-104")


def test_other_symbols_are_not_made_of_strokes() -> None:
    with pytest.raises(ParameterError, match="'pl-2015-conveyor' draws 'circles', expected"):
        symbols(rectangle("pl-2015-conveyor"))
