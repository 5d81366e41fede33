"""Whole strokes of a slope by matching its top with its toe."""

from typing import Literal, NamedTuple, TypeAlias

import numpy as np
import shapely
from shapely import LineString

from midrib.errors import ParameterError
from midrib.hatching.middle import Middle, middle_of
from midrib.hatching.rule import Rule
from midrib.kernels.chords import ON_TOE, ON_TOP
from midrib.kernels.ladder import Ladder, Spacing, Strokes, build_ladder, draw_strokes
from midrib.kernels.mending import mend
from midrib.strip import Strip
from midrib.types import Bools, Floats, Ints

__all__ = ["Drawn", "Ground", "Start", "draw_by_matching", "drawn_of"]

Start: TypeAlias = Literal["left", "right", "first", "last"]
PHASE, TAU, THETA = 6, 0, 4  # columns of rungs and of pivots
MOST_STROKES = 10_000_000
UNMATCHED = "no straight stroke from top to toe goes on along both edges here; one is left out"


class Drawn(NamedTuple):
    """Whole strokes in the order of the pattern, from its start on."""

    station: Floats  # (n,) on the middle line
    middle: Floats  # (n, 2) the point there
    on_top: Floats
    on_toe: Floats
    gap: Floats  # (n,) that the rule asks for
    kept: Bools
    reason: str  # why others are not


class Ground(NamedTuple):
    """A slope prepared for strokes, the rule for gaps, and whether the pattern starts on the right."""

    middle: Middle
    ladder: Ladder
    spacing: Spacing
    from_right: bool


def draw_by_matching(
    strip: Strip, rule: Rule, start: Start, offset: float, end_strokes: bool, stiffness: float
) -> tuple[Drawn, Ground]:
    """Draw whole strokes: none crosses another, all lead from top to toe."""
    middle = middle_of(strip)
    spacing = spacing_of(rule)
    check_count(middle, spacing)
    ladder = build_ladder(middle.mesh, middle.top, middle.toe, middle.line, spacing, stiffness)
    from_right = start in ("right", "last")
    if start in ("first", "last") and middle.is_turned:
        from_right = not from_right
    ground = Ground(middle, ladder, spacing, from_right)
    if middle.is_closed:
        origin = strip.main.coords[0] if start in ("first", "last") else None
        strokes, kept = draw_around(ground, origin, offset, len(rule.pattern), stiffness)
    else:
        strokes, kept = draw_along(ground, offset, stiffness)
    drawn = drawn_of(strokes, kept)
    if end_strokes and not middle.is_closed:
        drawn = with_ends(drawn, middle)
    return reversed_(drawn) if from_right else drawn, ground


def spacing_of(rule: Rule) -> Spacing:
    """Return the rule for gaps as the kernels take it."""
    if rule.factor is None:
        fixed = max(rule.spacing or 0.0, rule.min_spacing)
        return Spacing(0.0, fixed, fixed)
    most = np.inf if rule.max_spacing is None else rule.max_spacing
    return Spacing(float(rule.factor), float(rule.min_spacing), max(float(most), rule.min_spacing))


def check_count(middle: Middle, spacing: Spacing) -> None:
    """Refuse gaps that are absurdly small for a slope."""
    total = float(np.hypot(*np.diff(middle.line, axis=0).T).sum())
    if total > MOST_STROKES * spacing.least:
        msg = (
            f"gaps of {spacing.least:.3g} make more than {MOST_STROKES} strokes on a slope that is "
            f"{total:.3g} long; scale or min_spacing is too small"
        )
        raise ParameterError(msg)


def draw_along(ground: Ground, offset: float, stiffness: float) -> tuple[Strokes, Bools]:
    """Strokes of an open slope: a whole count of gaps between those that are ``offset`` away."""
    middle, ladder, spacing, _ = ground
    total = ladder.rungs[-1, PHASE]
    count = max(int(np.round(total - 2.0 * offset)), 0)
    phases = total / (count + 2.0 * offset) * (offset + np.arange(count + 1))
    strokes = draw_strokes(ladder, phases, spacing)
    return strokes, mend(ladder, strokes, middle.periods, stiffness)


def draw_around(
    ground: Ground, origin: tuple[float, ...] | None, offset: float, period: int, stiffness: float
) -> tuple[Strokes, Bools]:
    """Strokes of a closed slope: a whole count of patterns, from a vertex of the top on."""
    middle, ladder, spacing, from_right = ground
    total, length = ladder.rungs[-1, PHASE], ladder.rungs[-1, TAU]
    turn = ladder.rungs[-1, THETA] - ladder.rungs[0, THETA]
    unit = total / (period * max(int(np.round(total / period)), 1))
    count = int(np.round(total / unit))
    away = -offset if from_right else offset
    first = phase_of_vertex(ground, origin) + away * unit
    phases = np.sort((first + unit * np.arange(count)) % total)
    strokes = draw_strokes(ladder, phases, spacing)
    # The kernel mends from a calm stroke to itself: the seam goes where trouble is far.
    seam = calmest(strokes, middle.periods)
    strokes = rolled(strokes, seam, length, turn)
    kept = mend(ladder, strokes, middle.periods, stiffness)
    start = int(np.argmin(abs(phases - first % total)))
    back = (start - seam + (1 if from_right else 0)) % count
    return rolled(strokes, back, length, turn), np.roll(kept, -back)


def phase_of_vertex(ground: Ground, origin: tuple[float, ...] | None) -> float:
    """Phase of the stroke from a vertex of a closed top: one given, or the leftmost, lowest one."""
    middle, ladder, spacing, _ = ground
    vertex = middle.top.vertex[:-1]
    x, y = middle.mesh.x[vertex], middle.mesh.y[vertex]
    if origin is None:
        row = int(np.lexsort([y, x])[0])
    else:
        row = int(np.argmin(np.hypot(x - origin[0], y - origin[1])))
    period = middle.periods[0]
    rungs = draw_strokes(ladder, ladder.rungs[:-1, PHASE].copy(), spacing)
    ahead = (middle.top.arc[row] - rungs.chord[:, 0]) % period
    ahead[rungs.on[:, 0] != ON_TOP] = np.inf
    before = int(np.argmin(ahead))
    after = (before + 1) % ahead.size
    step = (rungs.chord[after, 0] - rungs.chord[before, 0]) % period
    share = min(ahead[before] / step, 1.0) if step > 0.0 else 0.0
    phase = ladder.rungs[:, PHASE]
    return float(phase[before] + share * (phase[before + 1] - phase[before]))


def calmest(strokes: Strokes, periods: Floats) -> int:
    """Row in the middle of the longest run of strokes that advance on both edges as they should."""
    ahead = (np.roll(strokes.chord[:, :2], -1, axis=0) - strokes.chord[:, :2]) % periods
    shares = ahead / strokes.pivot[:, 5:]
    is_calm = (strokes.on == (ON_TOP, ON_TOE)).all(axis=1)
    is_calm &= (shares > 0.3).all(axis=1) & (shares < 1.6).all(axis=1)
    n = is_calm.size
    trouble = np.flatnonzero(~is_calm)
    if not trouble.size:
        return 0
    run = np.diff(np.append(trouble, trouble[0] + n))
    longest = int(np.argmax(run))
    return int(trouble[longest] + (run[longest] + 1) // 2) % n


def rolled(strokes: Strokes, first: int, length: float, turn: float) -> Strokes:
    """Return the strokes of a closed slope from another one on."""
    pivot, triangle, chord, on = (np.roll(part, -first, axis=0) for part in strokes)
    if first:
        pivot[-first:, 0] += length
        pivot[-first:, 3:5] += turn
    pivot[:, 0] -= length * np.floor(pivot[0, 0] / length)
    return Strokes(pivot, triangle, chord, on)


def drawn_of(strokes: Strokes, kept: Bools) -> Drawn:
    """Whole strokes as arrays of ends."""
    return Drawn(
        strokes.pivot[:, 0],
        strokes.pivot[:, 1:3],
        strokes.chord[:, 2:4],
        strokes.chord[:, 4:6],
        strokes.pivot[:, 5],
        kept,
        UNMATCHED,
    )


def reversed_(drawn: Drawn) -> Drawn:
    """Return the same strokes the other way."""
    return Drawn(*(part[::-1] for part in drawn[:-1]), drawn.reason)


def with_ends(drawn: Drawn, middle: Middle) -> Drawn:
    """Add a stroke on each end of the slope that is a straight cap."""
    mesh, top, toe = middle.mesh, middle.top.vertex, middle.toe.vertex
    total = float(np.hypot(*np.diff(middle.line, axis=0).T).sum())
    for end, station, at in ((0, 0.0, 0), (-1, total, drawn.station.size)):
        a, b = top[end], toe[end]
        if a == b:
            continue
        at += 1 if end and drawn.station.size > at else 0
        on_top, on_toe = np.array([mesh.x[a], mesh.y[a]]), np.array([mesh.x[b], mesh.y[b]])
        gap = drawn.gap[end] if drawn.gap.size else 0.0
        row = (station, (on_top + on_toe) / 2.0, on_top, on_toe, gap, True)
        parts = [
            np.insert(part, 0 if end == 0 else len(part), value, axis=0)
            for part, value in zip(drawn[:-1], row, strict=True)
        ]
        drawn = Drawn(*parts, drawn.reason)
    return drawn
