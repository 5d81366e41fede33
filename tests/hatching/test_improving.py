"""Strokes placed anew at bays, spurs and sharp corners."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString

from midrib import Strip, hatch
from midrib.hatching.improving import improved, stretches
from midrib.hatching.laying import Found, Ground, draw_at
from midrib.hatching.matching import spacing_of
from midrib.hatching.measures import measure
from midrib.hatching.middle import middle_of
from midrib.hatching.rule import Rule
from midrib.kernels.gauging import NORMAL
from midrib.kernels.ladder import GAP, TAU, THETA, build_ladder
from midrib.kernels.spacing import place_strokes
from tests.hatching.slopes import bands, rectangle

RULE = Rule(factor=0.5, min_spacing=0.2)


def bay(depth: float, mouth: float = 12.0, length: float = 200.0) -> Strip:
    """A slope 10 wide with a bay in its toe."""
    x = length / 2.0
    toe = [(0, 0), (x - mouth / 2, 0), (x - mouth / 4, -depth), (x + mouth / 4, -depth)]
    return Strip(
        LineString([(0, 10), (length, 10)]), LineString([*toe, (x + mouth / 2, 0), (length, 0)])
    )


def corner(degrees: float) -> Strip:
    """A slope about 10 wide that turns by an angle in its middle, the top outside."""
    turn = np.radians(degrees)
    way, half = np.array([np.cos(turn), np.sin(turn)]), np.tan(turn / 2.0)
    left = np.array([-way[1], way[0]])
    top = [(-80.0, 0.0), (0.0, 0.0), tuple(80.0 * way)]
    inner = np.array([-10.0 * half, 10.0])
    toe = [(-80.0, 10.0), tuple(inner), tuple(80.0 * way + 10.0 * left)]
    return Strip(LineString(top), LineString(toe))


def tapering(width: float, power: float) -> Strip:
    """A lens whose edges leave each other steeply at both ends, more so on the toe's side."""
    x = np.linspace(0.0, 100.0, 41)
    y = width * np.sin(np.pi * x / 100.0) ** power
    y[[0, -1]] = 0.0
    return Strip(
        LineString(np.column_stack([x, 0.3 * y])), LineString(np.column_stack([x, -0.7 * y]))
    )


def before(strip: Strip, rule: Rule = RULE) -> Found:
    """Strokes as they are before any is placed anew."""
    middle, spacing = middle_of(strip), spacing_of(rule)
    ladder = build_ladder(middle.mesh, middle.top, middle.toe, middle.line, spacing, 0.9, 0.0)
    tau, gap = ladder.rungs[:, TAU].copy(), ladder.rungs[:, GAP].copy()
    stations, _ = place_strokes(tau, gap, 1.0, 1)
    return draw_at(Ground(middle, ladder, spacing, False), stations, 0.9)


@pytest.mark.parametrize("strip", [bay(10.0), bay(20.0, 20.0), corner(100.0), corner(120.0)])
def test_bays_and_sharp_corners_keep_all_bounds(strip: Strip) -> None:
    found = measure(hatch(strip))
    assert found.crossings == 0
    assert found.outside == 0.0
    assert found.spacing.min() >= 0.8
    assert found.spacing.max() <= 1.25
    assert max(found.top_gap, found.toe_gap) <= 1.75
    assert found.least_foot >= 0.25
    assert (found.turns <= np.maximum(found.allowed, 20.0) + 2.0).all()


def test_strokes_far_from_trouble_stay_what_they_are() -> None:
    strip = bay(20.0, 20.0, length=400.0)
    found = before(strip)
    other = improved(found, RULE, 1.0, 0.9)
    assert other is not found
    old = {tuple(row) for row in found.strokes.chord[:, 2:6].round(9)}
    new = {tuple(row) for row in other.strokes.chord[:, 2:6].round(9)}
    far = {row for row in old if abs(row[0] - 200.0) > 60.0}
    assert len(far) > 40
    assert far <= new
    assert old - new


@pytest.mark.parametrize(("width", "power"), [(12.0, 0.7), (20.0, 0.7), (24.0, 1.0)])
def test_strokes_that_lean_a_little_too_far_turn_a_little(width: float, power: float) -> None:
    found = before(tapering(width, power))
    excess = found.laid(RULE).beyond[:, NORMAL].max()
    assert 0.0 < excess < np.radians(3.0)
    placed = improved(found, RULE, 1.0, 0.9).strokes.pivot
    rungs = found.ground.ladder.rungs
    calm = np.interp(placed[:, 0], rungs[:, TAU], rungs[:, THETA])
    assert len(placed) == len(found.kept)
    assert abs(placed[:, 4] - calm).max() <= excess + np.radians(1.0)


@given(strip=bands())
@settings(max_examples=30)
def test_what_is_placed_anew_is_never_worse(strip: Strip) -> None:
    found = before(strip)
    other = improved(found, RULE, 1.0, 0.9)
    whole = 0.0, found.ground.middle.length
    before_it = found.badness(found.laid(RULE), whole, 1.0)
    assert other.badness(other.laid(RULE), whole, 1.0)[:2] <= before_it[:2]


def test_calm_slopes_stay_what_they_are() -> None:
    found = before(rectangle())
    assert improved(found, RULE, 1.0, 0.9) is found


def test_a_mound_with_a_bay_keeps_whole_patterns() -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 181)[:-1]
    out = np.where(abs(turn - 3.0) < 0.3, 30.0, 24.0)
    rings = [
        LineString(
            np.vstack([r[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])] * 2)[:181]
        )
        for r in (np.full(180, 16.0), out)
    ]
    hatching = hatch(Strip(*rings))
    found = measure(hatching)
    assert len(hatching.strokes) % 2 == 0
    assert found.crossings == 0
    assert found.spacing.min() >= 0.8
    assert found.spacing.max() <= 1.25
    assert shapely.covers(hatching.strip.area, hatching.strokes).all()


@given(flags=st.lists(st.booleans(), min_size=1, max_size=60), is_closed=st.booleans())
def test_stretches_hold_all_trouble_and_end_at_calm_strokes(
    flags: list[bool], is_closed: bool
) -> None:
    trouble = np.array(flags)
    n, inside = trouble.size, np.zeros(trouble.size, dtype=bool)
    kept = np.ones(n, dtype=bool)
    for first, last in stretches(trouble, kept, is_closed):
        assert first < 0 or not trouble[first] or trouble[kept].all()
        assert last < 0 or not trouble[last] or trouble[kept].all()
        stop = n if last < 0 else last + n * (is_closed and last <= first)
        inside[np.arange(first + 1, stop) % n] = True
        if first == last >= 0:
            inside[first] = True  # the one that has to stay
    assert (trouble <= inside).all()
