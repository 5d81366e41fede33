"""Whole strokes of a slope by matching its top with its toe."""

from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from midrib.errors import ParameterError
from midrib.hatching.middle import Middle, middle_of
from midrib.hatching.rule import Rule
from midrib.kernels.chords import ON_TOE, ON_TOP
from midrib.kernels.ladder import Ladder, Spacing, Strokes, build_ladder, draw_strokes
from midrib.kernels.mending import LEAST_FOOT, MOST_FOOT, mend
from midrib.kernels.spacing import place_strokes
from midrib.strip import Strip
from midrib.types import Bools, Floats, Ints

__all__ = ["Drawn", "Ground", "Start", "draw_by_matching", "drawn_of"]

Start: TypeAlias = Literal["left", "right", "first", "last"]
TAU, THETA, GAP = 0, 4, 6  # columns of rungs
MOST_STROKES = 1_000_000  # the ladder has eight rungs for each, and holds 2^24
UNMATCHED = "no straight stroke from top to toe goes on along both edges here; one is left out"


class Drawn(NamedTuple):
    """Whole strokes in the order of the pattern, from its start on."""

    station: Floats  # (n,) on the middle line
    middle: Floats  # (n, 2) the point there
    on_top: Floats
    on_toe: Floats
    kept: Bools
    reason: str  # why others are not

    def of_rows(self, rows: Ints) -> "Drawn":
        """Return some of the strokes."""
        return Drawn(
            self.station[rows],
            self.middle[rows],
            self.on_top[rows],
            self.on_toe[rows],
            self.kept[rows],
            self.reason,
        )


class Ground(NamedTuple):
    """A slope prepared for strokes, the rule for gaps, and where the pattern starts."""

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
    return Spacing(float(rule.factor or 0.0), float(rule.least_gap), float(rule.largest_gap))


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
    tau, gap = ladder.rungs[:, TAU].copy(), ladder.rungs[:, GAP].copy()
    stations, _ = place_strokes(tau, gap, offset, 1)
    strokes = draw_strokes(ladder, stations, spacing)
    return strokes, mend(ladder, strokes, middle.periods, stiffness)


def draw_around(
    ground: Ground, origin: tuple[float, ...] | None, offset: float, period: int, stiffness: float
) -> tuple[Strokes, Bools]:
    """Strokes of a closed slope: a whole count of patterns, from a vertex of the top on."""
    middle, ladder, spacing, from_right = ground
    tau, gap = ladder.rungs[:, TAU], ladder.rungs[:, GAP]
    length, turn = tau[-1], ladder.rungs[-1, THETA] - ladder.rungs[0, THETA]
    start = station_of_vertex(ground, origin)
    away = offset * float(np.interp(start, tau, gap))
    start = (start - away if from_right else start + away) % length
    # The same rungs, from the start on.
    after = np.searchsorted(tau, start, side="right")
    around = np.concatenate([[start], tau[after:-1], tau[:after] + length, [start + length]])
    ends = np.interp(start, tau, gap)
    gaps = np.concatenate([[ends], gap[after:-1], gap[:after], [ends]])
    around, kept = np.unique(around, return_index=True)
    stations, _ = place_strokes(around, gaps[kept], 0.0, period)
    stations %= length
    first = int(np.argmin(stations))
    strokes = draw_strokes(ladder, np.roll(stations, -first), spacing)
    # The kernel mends from a calm stroke to itself: the seam goes where trouble is far.
    seam = calmest(strokes, middle.periods)
    strokes = rolled(strokes, seam, length, turn)
    stays = mend(ladder, strokes, middle.periods, stiffness)
    back = (-first - seam + (1 if from_right else 0)) % len(stations)
    return rolled(strokes, back, length, turn), np.roll(stays, -back)


def station_of_vertex(ground: Ground, origin: tuple[float, ...] | None) -> float:
    """Station of the stroke from a vertex of a closed top: one given, or the leftmost, lowest."""
    middle, ladder, spacing, _ = ground
    vertex = middle.top.vertex[:-1]
    x, y = middle.mesh.x[vertex], middle.mesh.y[vertex]
    if origin is None:
        row = int(np.lexsort([y, x])[0])
    else:
        row = int(np.argmin(np.hypot(x - origin[0], y - origin[1])))
    period, tau = middle.periods[0], ladder.rungs[:, TAU]
    rungs = draw_strokes(ladder, tau[:-1].copy(), spacing)
    ahead = (middle.top.arc[row] - rungs.chord[:, 0]) % period
    ahead[rungs.on[:, 0] != ON_TOP] = np.inf
    before = int(np.argmin(ahead))
    after = (before + 1) % ahead.size
    step = (rungs.chord[after, 0] - rungs.chord[before, 0]) % period
    share = min(ahead[before] / step, 1.0) if step > 0.0 else 0.0
    return float(tau[before] + share * (tau[before + 1] - tau[before]))


def calmest(strokes: Strokes, periods: Floats) -> int:
    """Row in the middle of the longest run of strokes that advance on both edges as they should."""
    ahead = (np.roll(strokes.chord[:, :2], -1, axis=0) - strokes.chord[:, :2]) % periods[:2]
    shares = ahead / strokes.pivot[:, 5:]
    is_calm = (strokes.on == (ON_TOP, ON_TOE)).all(axis=1)
    is_calm &= (shares > LEAST_FOOT).all(axis=1) & (shares < MOST_FOOT).all(axis=1)
    n = is_calm.size
    trouble = np.flatnonzero(~is_calm).tolist()
    if not trouble:
        return 0
    runs = np.diff([*trouble, trouble[0] + n]).tolist()
    longest = int(np.argmax(runs))
    middle: int = (trouble[longest] + (runs[longest] + 1) // 2) % n
    return middle


def rolled(strokes: Strokes, first: int, length: float, turn: float) -> Strokes:
    """Return the strokes of a closed slope from another one on."""
    pivot, chord = np.roll(strokes.pivot, -first, axis=0), np.roll(strokes.chord, -first, axis=0)
    triangle, on = np.roll(strokes.triangle, -first), np.roll(strokes.on, -first, axis=0)
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
        kept,
        UNMATCHED,
    )


def reversed_(drawn: Drawn) -> Drawn:
    """Return the same strokes the other way."""
    return drawn.of_rows(np.arange(len(drawn.station))[::-1])


def with_ends(drawn: Drawn, middle: Middle) -> Drawn:
    """Add a stroke on each end of the slope that is a straight cap."""
    mesh, top, toe = middle.mesh, middle.top.vertex, middle.toe.vertex
    total = float(np.hypot(*np.diff(middle.line, axis=0).T).sum())
    for end, station in ((0, 0.0), (-1, total)):
        a, b = top[end], toe[end]
        if a == b:
            continue
        on_top, on_toe = np.array([mesh.x[a], mesh.y[a]]), np.array([mesh.x[b], mesh.y[b]])
        place = 0 if end == 0 else len(drawn.station)
        drawn = Drawn(
            np.insert(drawn.station, place, station),
            np.insert(drawn.middle, place, (on_top + on_toe) / 2.0, axis=0),
            np.insert(drawn.on_top, place, on_top, axis=0),
            np.insert(drawn.on_toe, place, on_toe, axis=0),
            np.insert(drawn.kept, place, True),
            drawn.reason,
        )
    return drawn
