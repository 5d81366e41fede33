"""Strokes at given stations of a slope, mended where they would meet or miss an edge."""

from typing import NamedTuple

import numpy as np

from midrib.hatching.middle import Middle
from midrib.hatching.rule import Rule
from midrib.kernels.chords import ON_TOE, ON_TOP
from midrib.kernels.ladder import TAU, THETA, Ladder, Spacing, Strokes, draw_strokes
from midrib.kernels.mending import LEAST_FOOT, MOST_FOOT, MOST_TURN, mend
from midrib.types import Bools, Floats

__all__ = ["Found", "Ground", "draw_at", "ratios_of"]

UNEVEN = 0.1  # logarithm of a gap over the others' ratio to the rule: from there on it is trouble


class Ground(NamedTuple):
    """A slope prepared for strokes, the rule for gaps, and where the pattern starts."""

    middle: Middle
    ladder: Ladder
    spacing: Spacing
    from_right: bool


class Found(NamedTuple):
    """Strokes of a slope in order along its middle line, which of them stay, and their ground."""

    strokes: Strokes
    kept: Bools
    ground: Ground

    def trouble(self, rule: Rule) -> Bools:
        """Which strokes are left out, or beside a neighbour that is not a gap away or turned too far.

        What was mended and keeps the bounds all the same is no trouble.
        """
        strokes, ground = self.strokes, self.ground
        found: Bools = ~self.kept
        ratios = ratios_of(strokes, ground, rule)
        is_off = abs(np.log(ratios / np.median(ratios))) > UNEVEN
        is_off |= turns_of(strokes, ground) > MOST_TURN
        feet = feet_of(strokes, ground, rule)
        is_off |= ((feet < LEAST_FOOT) | (feet > MOST_FOOT)).any(axis=1)
        found[: is_off.size] |= is_off
        found[(np.flatnonzero(is_off) + 1) % found.size] = True
        return found

    def badness(self, rule: Rule) -> tuple[int, float]:
        """Return strokes left out, and how far the worst places are beyond what they may be.

        That is the logarithm of the largest gap over the smallest, both over what the rule asks
        for, and of feet that are too far or too near, and the turn beyond the most, in radians.
        """
        pivot, triangle, chord, on = self.strokes
        some = Strokes(pivot[self.kept], triangle[self.kept], chord[self.kept], on[self.kept])
        ratios = ratios_of(some, self.ground, rule)
        worst = 0.0
        if ratios.size:
            feet = feet_of(some, self.ground, rule)
            worst = float(
                np.log(ratios.max() / ratios.min())
                + max(np.log(feet.max() / MOST_FOOT), 0.0)
                + max(np.log(LEAST_FOOT / feet.min()), 0.0)
                + max(turns_of(some, self.ground).max() - MOST_TURN, 0.0)
            )
        return int(np.count_nonzero(~self.kept)), worst


def ratios_of(strokes: Strokes, ground: Ground, rule: Rule) -> Floats:
    """Gaps over what the rule asks for; of a closed slope, the last one is back to the first."""
    gap, period = rule.gaps(strokes.chord[:, 6]), ground.middle.periods[2]
    steps = np.diff(strokes.pivot[:, 0], append=strokes.pivot[:1, 0] + period)
    ratios: Floats = steps / ((gap + np.roll(gap, -1)) / 2.0)
    return ratios if period > 0.0 else ratios[:-1]


def feet_of(strokes: Strokes, ground: Ground, rule: Rule) -> Floats:
    """(k, 2) distances between feet along both edges, over the gaps that the rule asks for."""
    gap, periods = rule.gaps(strokes.chord[:, 6]), ground.middle.periods
    steps = np.roll(strokes.chord[:, :2], -1, axis=0) - strokes.chord[:, :2]
    if periods[2] > 0.0:
        steps %= periods[:2]
    feet: Floats = steps / ((gap + np.roll(gap, -1)) / 2.0)[:, None]
    return feet if periods[2] > 0.0 else feet[:-1]


def turns_of(strokes: Strokes, ground: Ground) -> Floats:
    """Angles between neighbours; of a closed slope, the last one is back to the first."""
    theta, rungs = strokes.pivot[:, 4], ground.ladder.rungs
    lap = rungs[-1, THETA] - rungs[0, THETA]
    turns: Floats = abs(np.diff(theta, append=theta[:1] + lap))
    return turns if ground.middle.is_closed else turns[:-1]


def draw_at(ground: Ground, stations: Floats, stiffness: float, *, is_final: bool = False) -> Found:
    """Draw strokes at stations in order along the middle line, and mend them.

    If their directions are final, those that will not do are only left out.
    """
    middle, ladder, spacing, _ = ground
    if not middle.is_closed:
        strokes = draw_strokes(ladder, stations, spacing)
        return Found(strokes, mend(ladder, strokes, middle.periods, stiffness, is_final), ground)
    length, turn = ladder.rungs[-1, TAU], ladder.rungs[-1, THETA] - ladder.rungs[0, THETA]
    stations = stations % length
    first = int(np.argmin(stations))
    strokes = draw_strokes(ladder, np.roll(stations, -first), spacing)
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
