"""What must hold of every hatching, whatever the slope."""

import itertools
from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString
from shapely.affinity import rotate, scale, translate

from midrib import Hatching, Strip, hatch
from midrib.hatching.measures import measure
from tests.hatching.slopes import (
    Floats,
    annulus,
    bands,
    bend,
    elbow,
    lens,
    rectangle,
    rings,
    trapezium,
)
from tests.strategies import divided

SLOPES = {
    "rectangle": rectangle(),
    "trapezium": trapezium(),
    "L": elbow(),
    "lens": lens(),
    "bend": bend(),
    "annulus": annulus(),
}
EVERY = [bands(), rings()]


def side(a: Floats, b: Floats, c: Floats) -> int:
    """Sign of the triangle a b c in whole fractions."""
    (ax, ay), (bx, by), (cx, cy) = (tuple(Fraction(float(v)) for v in p) for p in (a, b, c))
    value = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (value > 0) - (value < 0)


def cross(one: LineString, other: LineString) -> bool:
    """Whether two segments have a point in common, in whole fractions."""
    if not one.envelope.intersects(other.envelope):
        return False
    (a, b), (c, d) = shapely.get_coordinates(one), shapely.get_coordinates(other)
    first, second = (side(a, b, c), side(a, b, d)), (side(c, d, a), side(c, d, b))
    return first[0] * first[1] <= 0 and second[0] * second[1] <= 0


def check(hatching: Hatching) -> None:
    """No crossing, nothing outside, long strokes from edge to edge, in order."""
    strokes, strip = hatching.strokes, hatching.strip
    assert not any(cross(a, b) for a, b in itertools.combinations(strokes, 2))
    assert shapely.covers(strip.area, strokes).all()
    near = 1e-9 * max(strip.main.length, strip.auxiliary.length)
    assert (shapely.distance(shapely.points(hatching.on_top), strip.main) <= near).all()
    assert (shapely.distance(shapely.points(hatching.on_toe), strip.auxiliary) <= near).all()
    length = shapely.length(strokes)
    assert length == pytest.approx(hatching.share * hatching.width)
    at = shapely.line_locate_point(strip.main, shapely.points(hatching.on_top))
    beside = shapely.line_locate_point(strip.auxiliary, shapely.points(hatching.on_toe))
    for stations in (at, beside):
        falls = np.count_nonzero(np.diff(stations) <= 0.0)
        assert falls <= (1 if strip.is_closed else 0)


@given(strip=st.one_of(EVERY), share=st.sampled_from([0.2, 0.5, 1.0]))
@settings(max_examples=60)
def test_strokes_neither_cross_nor_leave(strip: Strip, share: float) -> None:
    check(hatch(strip, min_spacing=0.2, factor=share))


@given(strip=divided(), scale=st.sampled_from([100, 1000]))
@settings(max_examples=100)
def test_no_area_however_odd_gets_a_wrong_picture(strip: Strip, scale: int) -> None:
    """Folds, pockets, islands, rings closed by a touch: all is right, or left out and named."""
    hatching = hatch(strip, scale=scale)
    assert len(hatching.strokes) or hatching.problems
    if len(hatching.strokes) < 200:
        check(hatching)


@given(strip=st.one_of(EVERY))
@settings(max_examples=40)
def test_every_stroke_is_drawn_or_a_problem_says_why(strip: Strip) -> None:
    hatching = hatch(strip, min_spacing=0.2, min_length=0.0)
    left_out = sum("left out" in problem.reason for problem in hatching.problems)
    shortened = sum("ends before" in problem.reason for problem in hatching.problems)
    assert np.count_nonzero(hatching.is_long & (hatching.share < 1.0)) == shortened
    if left_out == 0:
        assert measure(hatching).spacing.max(initial=1.0) < 1.6


@pytest.mark.parametrize("name", SLOPES)
def test_doubling_is_exact(name: str) -> None:
    strip = SLOPES[name]
    plain = hatch(strip)
    for power in (-40, 17, 60):
        factor = 2.0**power
        larger = [scale(c, factor, factor, origin=(0, 0)) for c in (strip.main, strip.auxiliary)]
        scaled = hatch(Strip(*larger), metres_per_unit=2.0**-power)
        assert (scaled.on_top == factor * plain.on_top).all()
        assert (scaled.on_toe == factor * plain.on_toe).all()


@pytest.mark.parametrize("name", SLOPES)
def test_same_strokes_for_edges_the_other_way(name: str) -> None:
    strip = SLOPES[name]
    plain = hatch(strip)
    turned = hatch(Strip(shapely.reverse(strip.main), strip.auxiliary))
    assert same_strokes(plain, turned, 1e-9)
    if not strip.is_closed:
        assert turned.on_top == pytest.approx(plain.on_top[::-1], abs=1e-9)
        assert (turned.is_long == plain.is_long[::-1]).all()


def same_strokes(one: Hatching, other: Hatching, within: float) -> bool:
    """Whether two hatchings have the same strokes, in any order."""
    if len(one.strokes) != len(other.strokes):
        return False
    rows = [np.column_stack([h.on_top, h.on_toe, h.is_long]) for h in (one, other)]
    distances = abs(rows[0][:, None] - rows[1][None]).max(axis=2)
    return bool((distances.min(axis=1) <= within).all())


@pytest.mark.parametrize("steps", [1, 50, 97])
def test_same_strokes_wherever_rings_start(steps: int) -> None:
    strip = annulus(n=100)
    rolled = [
        LineString(np.roll(np.array(c.coords)[:-1], steps, axis=0)[[*range(100), 0]])
        for c in (strip.main, strip.auxiliary)
    ]
    assert same_strokes(hatch(strip), hatch(Strip(*rolled)), 1e-9)


def test_a_ring_has_no_seam() -> None:
    """Turned by half a turn it is slit open elsewhere; a tight ring shows what the ends do."""
    turn = np.append(np.arange(24), 0) * (np.pi / 12.0)
    unit = np.column_stack([np.cos(turn), np.sin(turn)])
    inner = (5.0 + np.sin(2.0 * turn + 0.4))[:, None] * unit
    outer = (11.0 + 2.0 * np.cos(3.0 * turn))[:, None] * unit
    plain = hatch(Strip(LineString(inner), LineString(outer)), start="first", factor=0.2)
    turned = hatch(Strip(LineString(-inner), LineString(-outer)), start="first", factor=0.2)
    assert len(plain.strokes) == len(turned.strokes) > 10
    assert -turned.on_top == pytest.approx(plain.on_top, abs=0.02)
    assert -turned.on_toe == pytest.approx(plain.on_toe, abs=0.06)


@pytest.mark.parametrize("name", SLOPES)
def test_same_strokes_far_from_the_origin(name: str) -> None:
    strip = SLOPES[name]
    moved = [translate(c, 5e5, 5e6) for c in (strip.main, strip.auxiliary)]
    plain, far = hatch(strip), hatch(Strip(*moved))
    size = np.hypot(*np.subtract(strip.area.bounds[2:], strip.area.bounds[:2]))
    assert far.on_top - (5e5, 5e6) == pytest.approx(plain.on_top, abs=1e-6 * size)
    assert far.on_toe - (5e5, 5e6) == pytest.approx(plain.on_toe, abs=1e-6 * size)
    check(far)


@pytest.mark.parametrize("shift", [(1.1, 2.3), (5e5, 5e6)])
def test_ties_of_a_symmetric_slope_are_decided_alike_everywhere(shift: tuple[float, float]) -> None:
    turn = np.linspace(np.pi, 0.0, 25)
    unit = np.column_stack([np.cos(turn), np.sin(turn)])
    curves = [LineString(radius * unit + (40.0, 0.0)) for radius in (6.0, 25.0)]
    plain = hatch(Strip(*curves))
    other = hatch(Strip(*(translate(curve, *shift) for curve in curves)))
    assert other.on_top - shift == pytest.approx(plain.on_top, abs=5e-5)
    assert other.on_toe - shift == pytest.approx(plain.on_toe, abs=5e-5)


@given(strip=bands(), degrees=st.integers(1, 359))
@settings(max_examples=20)
def test_turning_the_slope_turns_the_strokes(strip: Strip, degrees: int) -> None:
    turned = [rotate(c, degrees, origin=(0, 0)) for c in (strip.main, strip.auxiliary)]
    plain, other = hatch(strip, min_spacing=0.2), hatch(Strip(*turned), min_spacing=0.2)
    assert abs(len(plain.strokes) - len(other.strokes)) <= 1  # a count that rounds either way
    if len(plain.strokes) == len(other.strokes):
        ends = [rotate(stroke, degrees, origin=(0, 0)) for stroke in plain.strokes]
        off = shapely.hausdorff_distance(ends, other.strokes)
        assert np.median(off) <= 0.02 * strip.layout.mean_width


@pytest.mark.parametrize("name", ["rectangle", "L", "bend"])
def test_noise_on_the_top_turns_no_stroke_far(name: str) -> None:
    strip = SLOPES[name]
    rng = np.random.default_rng(1)
    stations = np.linspace(0.0, strip.main.length, int(strip.main.length / 4.0))
    top = shapely.get_coordinates(shapely.line_interpolate_point(strip.main, stations))
    plain = hatch(strip)
    assert plain.ground is not None
    rungs, line = plain.ground.ladder.rungs, LineString(plain.ground.middle.line)
    for _ in range(5):
        moved = top + rng.uniform(-1.0, 1.0, top.shape)
        moved[[0, -1]] = top[[0, -1]]
        shaken = hatch(Strip(LineString(moved), strip.auxiliary))
        whole = shapely.linestrings(np.stack([shaken.on_top, shaken.on_toe], axis=1))
        at = shapely.line_locate_point(line, shapely.intersection(line, whole))
        across = shaken.on_toe - shaken.on_top
        angle = np.arctan2(across[:, 1], across[:, 0])
        # Strokes move along as well: each is held against the directions half a gap either way.
        off = [
            angle - np.interp(at + half, rungs[:, 0], rungs[:, 4]) for half in (-2.5, -1, 0, 1, 2.5)
        ]
        turned = np.degrees(abs((np.array(off) + np.pi) % (2.0 * np.pi) - np.pi)).min(axis=0)
        assert turned.max() <= 10.0
