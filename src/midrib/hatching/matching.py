"""Whole strokes of a slope by matching its top with its toe."""

from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from midrib.errors import ParameterError
from midrib.hatching.improving import improved
from midrib.hatching.laying import Ground, draw_at
from midrib.hatching.middle import Middle, middle_of
from midrib.hatching.rule import Rule
from midrib.kernels.chords import ON_TOP
from midrib.kernels.ladder import GAP, TAU, Spacing, Strokes, build_ladder, draw_strokes
from midrib.kernels.mending import LEAST_FOOT
from midrib.kernels.spacing import place_strokes
from midrib.strip import Strip
from midrib.types import Bools, Floats, Ints

__all__ = ["Drawn", "Start", "draw_by_matching", "drawn_of"]

Start: TypeAlias = Literal["left", "right", "first", "last"]
MOST_STROKES = 1_000_000  # the ladder has eight rungs for each, and holds 2^24
STRAIGHT = 1e-9  # share of its length by which a side may be longer than its chord
UNMATCHED = "no straight stroke from top to toe goes on along both edges here; one is left out"


class Drawn(NamedTuple):
    """Whole strokes in the order of the pattern, from its start on."""

    station: Floats  # (n,) on the middle line
    middle: Floats  # (n, 2) the point there
    on_top: Floats
    on_toe: Floats
    feet: Floats  # (n, 2) stations of these on the edges of the middle line's slope
    local: Floats  # (n,) local widths
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
            self.local[rows],
            self.kept[rows],
            self.reason,
        )


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
    if middle.is_closed:
        origin = strip.main.coords[0] if start in ("first", "last") else None
        stations = stations_around(ground, origin, offset, len(rule.pattern))
    else:
        tau, gap = ladder.rungs[:, TAU].copy(), ladder.rungs[:, GAP].copy()
        stations, _ = place_strokes(tau, gap, offset, 1)
    found = draw_at(ground, stations, stiffness)
    strokes, kept, ground = improved(found, rule, offset, stiffness)
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


def stations_around(
    ground: Ground, origin: tuple[float, ...] | None, offset: float, period: int
) -> Floats:
    """Stations on a closed slope: a whole count of patterns, from a vertex of the top on.

    Seen from the right, the stroke at the start is the last one.
    """
    ladder, from_right = ground.ladder, ground.from_right
    tau, gap = ladder.rungs[:, TAU], ladder.rungs[:, GAP]
    length = tau[-1]
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
    return np.roll(stations, -1) if from_right else stations


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


def drawn_of(strokes: Strokes, kept: Bools) -> Drawn:
    """Whole strokes as arrays of ends."""
    return Drawn(
        strokes.pivot[:, 0],
        strokes.pivot[:, 1:3],
        strokes.chord[:, 2:4],
        strokes.chord[:, 4:6],
        strokes.chord[:, 0:2],
        strokes.pivot[:, 6],
        kept,
        UNMATCHED,
    )


def reversed_(drawn: Drawn) -> Drawn:
    """Return the same strokes the other way."""
    return drawn.of_rows(np.arange(len(drawn.station))[::-1])


def with_ends(drawn: Drawn, middle: Middle, rule: Rule) -> Drawn:
    """Add a stroke on each end of the slope that is straight; what is too near gives way.

    An end is a cap between top and toe, or a side that the toe holds too.
    """
    mesh, top, toe = middle.mesh, middle.top, middle.toe
    last = len(toe.vertex) - 1
    for end, station in ((0, 0.0), (-1, middle.length)):
        at = last - middle.sides[1] if end else middle.sides[0]
        a, b = top.vertex[end], toe.vertex[at]
        on_top, on_toe = np.array([mesh.x[a], mesh.y[a]]), np.array([mesh.x[b], mesh.y[b]])
        length = float(np.hypot(*(on_toe - on_top)))
        if a == b or abs(toe.arc[at] - toe.arc[end]) > (1.0 + STRAIGHT) * length:
            continue
        feet = np.array([top.arc[end], toe.arc[at]])
        (gap,) = rule.gaps(np.array([length]))
        is_near = (abs(drawn.feet - feet) < LEAST_FOOT * gap).any(axis=1)
        is_near |= drawn.feet[:, 1] > feet[1] if end else drawn.feet[:, 1] < feet[1]
        drawn = drawn.of_rows(np.flatnonzero(~is_near))
        place = 0 if end == 0 else len(drawn.station)
        drawn = Drawn(
            np.insert(drawn.station, place, station),
            np.insert(drawn.middle, place, (on_top + on_toe) / 2.0, axis=0),
            np.insert(drawn.on_top, place, on_top, axis=0),
            np.insert(drawn.on_toe, place, on_toe, axis=0),
            np.insert(drawn.feet, place, feet, axis=0),
            np.insert(drawn.local, place, length),
            np.insert(drawn.kept, place, True),
            drawn.reason,
        )
    return drawn
