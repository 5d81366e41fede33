"""Whole strokes of a slope by matching its top with its toe."""

from collections.abc import Callable
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from midrib.errors import ParameterError
from midrib.hatching.middle import Middle, middle_of
from midrib.hatching.rule import Rule
from midrib.kernels.chords import ON_TOE, ON_TOP
from midrib.kernels.ladder import Ladder, Spacing, Strokes, build_ladder, draw_strokes, turn_rungs
from midrib.kernels.mending import LEAST_FOOT, MOST_FOOT, MOST_TURN, mend
from midrib.kernels.spacing import place_strokes
from midrib.strip import Strip
from midrib.types import Bools, Floats, Ints

__all__ = ["Drawn", "Ground", "Start", "draw_by_matching", "drawn_of"]

Start: TypeAlias = Literal["left", "right", "first", "last"]
TAU, THETA, GAP = 0, 4, 6  # columns of rungs
ROUNDS = 5  # of mending and placing anew
DIGITS = 3  # of what tells rounds apart: the first of those that tie, whatever rounding says
MOST_STROKES = 1_000_000  # the ladder has eight rungs for each, and holds 2^24
UNMATCHED = "no straight stroke from top to toe goes on along both edges here; one is left out"


class Drawn(NamedTuple):
    """Whole strokes in the order of the pattern, from its start on."""

    station: Floats  # (n,) on the middle line
    middle: Floats  # (n, 2) the point there
    on_top: Floats
    on_toe: Floats
    feet: Floats  # (n, 2) stations of these on the edges of the middle line's slope
    kept: Bools
    reason: str  # why others are not

    def of_rows(self, rows: Ints) -> "Drawn":
        """Return some of the strokes."""
        return Drawn(
            self.station[rows],
            self.middle[rows],
            self.on_top[rows],
            self.on_toe[rows],
            self.feet[rows],
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
    strip: Strip,
    rule: Rule,
    start: Start,
    offset: float,
    end_strokes: bool,
    stiffness: float,
    top_share: float,
) -> tuple[Drawn, Ground]:
    """Draw whole strokes: none crosses another, all lead from top to toe."""
    middle = middle_of(strip)
    spacing = spacing_of(rule)
    check_count(middle, spacing)
    ladder = build_ladder(
        middle.mesh, middle.top, middle.toe, middle.line, spacing, stiffness, top_share
    )
    from_right = start in ("right", "last")
    if start in ("first", "last") and middle.is_turned:
        from_right = not from_right
    ground = Ground(middle, ladder, spacing, from_right)
    origin = strip.main.coords[0] if start in ("first", "last") else None
    period = len(rule.pattern)

    def draw(ground: Ground) -> tuple[Strokes, Bools]:
        if middle.is_closed:
            return draw_around(ground, origin, offset, period, stiffness)
        return draw_along(ground, offset, stiffness)

    strokes, kept, ground = settled(ground, draw, rule)
    drawn = drawn_of(strokes, kept)
    if end_strokes and not middle.is_closed:
        drawn = with_ends(drawn, middle, rule)
    return reversed_(drawn) if from_right else drawn, ground


def spacing_of(rule: Rule) -> Spacing:
    """Return the rule for gaps as the kernels take it."""
    return Spacing(float(rule.factor or 0.0), float(rule.least_gap), float(rule.largest_gap))


def check_count(middle: Middle, spacing: Spacing) -> None:
    """Refuse gaps that are absurdly small for a slope."""
    if middle.length > MOST_STROKES * spacing.least:
        msg = (
            f"gaps of {spacing.least:.3g} make more than {MOST_STROKES} strokes on a slope that is "
            f"{middle.length:.3g} long; scale or min_spacing is too small"
        )
        raise ParameterError(msg)


def settled(
    ground: Ground, draw: Callable[[Ground], tuple[Strokes, Bools]], rule: Rule
) -> tuple[Strokes, Bools, Ground]:
    """Draw strokes; where some had to be mended, place all anew in the mended directions.

    Turned strokes are longer or shorter, so that the rule asks for other gaps beside them. Of a few
    rounds the one with the fewest omissions, and then with the most even gaps, is taken.
    """
    best: tuple[tuple[int, float], Strokes, Bools, Ground] | None = None
    for _ in range(ROUNDS):
        strokes, kept = draw(ground)
        found = (int(np.count_nonzero(~kept)), unevenness(strokes, kept, rule))
        if best is None or found < best[0]:
            best = (found, strokes, kept, ground)
        turns = (strokes.pivot[:, 4] - strokes.pivot[:, 3])[kept]
        if not turns.any():
            break
        rungs, station = ground.ladder.rungs, strokes.pivot[kept, 0]
        length = rungs[-1, TAU] if ground.middle.is_closed else None
        theta = rungs[:, THETA] + np.interp(rungs[:, TAU], station, turns, period=length)
        ground = ground._replace(ladder=turn_rungs(ground.ladder, theta, ground.spacing))
    assert best is not None
    return best[1:]


def unevenness(strokes: Strokes, kept: Bools, rule: Rule) -> float:
    """How uneven gaps are, and turns beyond the most: logarithms and radians, the worst of each."""
    station, gap = strokes.pivot[kept, 0], rule.gaps(strokes.chord[kept, 6])
    if station.size < 2:
        return 0.0
    ratios = np.diff(station) / ((gap[1:] + gap[:-1]) / 2.0)
    turns = abs(np.diff(strokes.pivot[kept, 4]))
    worst = np.log(ratios.max() / ratios.min()) + max(turns.max() - MOST_TURN, 0.0)
    return float(np.round(worst, DIGITS))


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
    # Mending goes from a calm stroke round to itself.
    seam = calmest(strokes, middle.periods)
    strokes = with_first_again(rolled(strokes, seam, length, turn), length, turn)
    stays = mend(ladder, strokes, middle.periods, stiffness)[:-1]
    strokes = Strokes(
        strokes.pivot[:-1], strokes.triangle[:-1], strokes.chord[:-1], strokes.on[:-1]
    )
    if not goes_round_once(strokes.chord[stays, :2], middle.periods[:2]):
        stays[:] = False
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
    if len(trouble) == n:
        leads = (strokes.on == (ON_TOP, ON_TOE)).all(axis=1)
        return int(np.argmax(leads))
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


def goes_round_once(feet: Floats, periods: Floats) -> bool:
    """Whether feet that go on along two closed edges, back to the first one, go round each once."""
    ahead = (np.roll(feet, -1, axis=0) - feet) % periods
    return len(feet) < 2 or bool((np.round(ahead.sum(axis=0) / periods) == 1.0).all())


def with_first_again(strokes: Strokes, length: float, turn: float) -> Strokes:
    """Return the strokes of a closed slope and the first one again, a turn later."""
    pivot, triangle, chord, on = (np.concatenate([part, part[:1]]) for part in strokes)
    pivot[-1, 0] += length
    pivot[-1, 3:5] += turn
    return Strokes(pivot, triangle, chord, on)


def drawn_of(strokes: Strokes, kept: Bools) -> Drawn:
    """Whole strokes as arrays of ends."""
    return Drawn(
        strokes.pivot[:, 0],
        strokes.pivot[:, 1:3],
        strokes.chord[:, 2:4],
        strokes.chord[:, 4:6],
        strokes.chord[:, 0:2],
        kept,
        UNMATCHED,
    )


def reversed_(drawn: Drawn) -> Drawn:
    """Return the same strokes the other way."""
    return drawn.of_rows(np.arange(len(drawn.station))[::-1])


def with_ends(drawn: Drawn, middle: Middle, rule: Rule) -> Drawn:
    """Add a stroke on each end of the slope that is a straight cap; what is too near gives way."""
    mesh, top, toe = middle.mesh, middle.top, middle.toe
    for end, station in ((0, 0.0), (-1, middle.length)):
        a, b = top.vertex[end], toe.vertex[end]
        if a == b:
            continue
        on_top, on_toe = np.array([mesh.x[a], mesh.y[a]]), np.array([mesh.x[b], mesh.y[b]])
        feet = np.array([top.arc[end], toe.arc[end]])
        (gap,) = rule.gaps(np.array([np.hypot(*(on_toe - on_top))]))
        is_near = (abs(drawn.feet - feet) < LEAST_FOOT * gap).any(axis=1)
        drawn = drawn.of_rows(np.flatnonzero(~is_near))
        place = 0 if end == 0 else len(drawn.station)
        drawn = Drawn(
            np.insert(drawn.station, place, station),
            np.insert(drawn.middle, place, (on_top + on_toe) / 2.0, axis=0),
            np.insert(drawn.on_top, place, on_top, axis=0),
            np.insert(drawn.on_toe, place, on_toe, axis=0),
            np.insert(drawn.feet, place, feet, axis=0),
            np.insert(drawn.kept, place, True),
            drawn.reason,
        )
    return drawn
