"""Strokes at given stations of a slope, mended where they would meet or miss an edge."""

from typing import NamedTuple

import numpy as np

from midrib.hatching.bounds import Curves, Laid, most_at_ends
from midrib.hatching.middle import Middle
from midrib.hatching.rule import LEAST_LENGTH, Rule
from midrib.kernels.chords import ON_TOE, ON_TOP
from midrib.kernels.gauging import NORMAL, STEP, TOE, TOP
from midrib.kernels.ladder import TAU, THETA, Ladder, Spacing, Strokes, draw_turned
from midrib.kernels.mending import LEAST_FOOT, MOST_FOOT, mend
from midrib.types import Bools, Floats

__all__ = ["Found", "Ground", "draw_at"]

UNEVEN = 0.1  # logarithm of a gap over the others' ratio to the rule: from there on it is trouble
FAR_END = 2.0  # bounds of gaps at ends: ends of edges that are so far from strokes are bare
SPACED, LEAP = 3.0, 0.3  # gaps on the middle line count more; two leaps less than one twice as far
WITHIN = 1e-9  # relative, for rounding


class Ground(NamedTuple):
    """A slope prepared for strokes, the rule for gaps, and where the pattern starts."""

    middle: Middle
    ladder: Ladder
    spacing: Spacing
    from_right: bool

    @property
    def curves(self) -> Curves:
        """Middle line and edges."""
        return self.middle.curves


class Found(NamedTuple):
    """Strokes of a slope in order along its middle line, which of them stay, and their ground."""

    strokes: Strokes
    kept: Bools
    ground: Ground

    def laid(self, rule: Rule) -> Laid:
        """Those that stay, as bounds are checked."""
        chord = self.strokes.chord[self.kept]
        station = self.strokes.pivot[self.kept, 0]
        curves = self.ground.curves
        local = self.strokes.pivot[self.kept, 6]
        asked = rule.gaps(chord[:, 6], local)
        return Laid(curves, station, chord[:, :2], chord[:, 2:6], asked, local)

    def trouble(self, laid: Laid) -> Bools:
        """Which strokes are left out or beyond a bound, or not a gap from a neighbour.

        What was mended and keeps the bounds all the same is no trouble.
        """
        found: Bools = ~self.kept
        rows = np.flatnonzero(self.kept)
        found[rows[laid.beyond[:, NORMAL] > 0.0]] = True
        steps = laid.between(STEP)
        if steps.size:
            is_off = laid.beyond[: steps.size, :NORMAL].any(axis=1)
            is_off |= abs(np.log(steps / np.median(steps))) > UNEVEN
            pairs = np.flatnonzero(is_off)
            found[rows[pairs]] = True
            found[rows[(pairs + 1) % rows.size]] = True
        return found

    def inside(self, stations: Floats, between: tuple[float, float]) -> Bools:
        """Which stations lie from one to another, on a closed slope past its start."""
        period, (low, high) = self.ground.middle.periods[2], between
        ahead = (stations - low) % period if period > 0.0 else stations - low
        within: Bools = (ahead >= 0.0) & (ahead <= (1.0 + WITHIN) * (high - low))
        return within

    def badness(
        self, laid: Laid, between: tuple[float, float], offset: float
    ) -> tuple[int, float, float]:
        """How bad strokes are from one station to another, on a closed slope past its start.

        How many are left out or too short to be drawn, how far the others are beyond bounds, and
        how uneven they are: the logarithm of the largest gap over the smallest.
        """
        period, (low, high) = self.ground.middle.periods[2], between
        missing = int(np.count_nonzero(self.inside(self.strokes.pivot[~self.kept, 0], between)))
        some = self.inside(laid.station, between)
        missing += int(np.count_nonzero(some & (laid.widths < LEAST_LENGTH * laid.asked)))
        steps = laid.between(STEP)
        pairs = (some & np.roll(some, -1))[: steps.size]
        off = laid.beyond[: steps.size][pairs]
        beyond = off[:, :NORMAL].sum() + laid.beyond[some, NORMAL].sum()
        beyond += SPACED * off[:, STEP].sum() + LEAP * (off[:, [TOP, TOE]] ** 3).sum()
        if period == 0.0:
            reached = np.array([low <= 0.0, high >= self.ground.middle.length])
            most = most_at_ends(offset)
            beyond += np.log(np.maximum(laid.end_gaps / most, 1.0))[reached].sum()
            beyond += np.log(np.maximum(laid.bare_ends / (FAR_END * most), 1.0))[reached].sum()
        ratio = steps[pairs].max() / steps[pairs].min() if pairs.any() else 1.0
        return missing, round(float(beyond), 4), round(float(np.log(ratio)), 4)


def draw_at(
    ground: Ground, stations: Floats, stiffness: float, turns: Floats | None = None
) -> Found:
    """Draw strokes at stations in order along the middle line, and mend them.

    If they are told how much to turn, directions are final: those that will not do are left out.
    """
    middle, ladder, spacing, _ = ground
    is_final = turns is not None
    turned = np.zeros(len(stations)) if turns is None else turns
    if not middle.is_closed:
        strokes = draw_turned(ladder, stations, turned, spacing)
        return Found(strokes, mend(ladder, strokes, middle.periods, stiffness, is_final), ground)
    length, turn = ladder.rungs[-1, TAU], ladder.rungs[-1, THETA] - ladder.rungs[0, THETA]
    stations = stations % length
    first = int(np.argmin(stations))
    strokes = draw_turned(ladder, np.roll(stations, -first), np.roll(turned, -first), spacing)
    # Mending goes from a calm stroke round to itself.
    seam = calmest(strokes, middle.periods)
    strokes = with_first_again(rolled(strokes, seam, length, turn), length, turn)
    stays = mend(ladder, strokes, middle.periods, stiffness, is_final)[:-1]
    strokes = Strokes(
        strokes.pivot[:-1], strokes.triangle[:-1], strokes.chord[:-1], strokes.on[:-1]
    )
    if not goes_round_once(strokes.chord[stays, :2], middle.periods[:2]):
        stays[:] = False
    back = (-first - seam) % len(stations)
    return Found(rolled(strokes, back, length, turn), np.roll(stays, -back), ground)


def calmest(strokes: Strokes, periods: Floats) -> int:
    """Row in the middle of the longest run of strokes that advance on both edges as they should."""
    ahead = (np.roll(strokes.chord[:, :2], -1, axis=0) - strokes.chord[:, :2]) % periods[:2]
    shares = ahead / strokes.pivot[:, 5:6]
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
