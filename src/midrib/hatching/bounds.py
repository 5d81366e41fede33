r"""Bounds that a hatching keeps, or else says where it does not.

       top  ----a-----c--------     gap      that the rule asks for between two neighbours: the mean
                |     |                      of what it asks for at both
       middle --o-----o--------     station  of a stroke, where it crosses the middle line
                |     |             feet     stations of its ends on top and toe
       toe  ----b-----d--------     turn, tilt   angle with the next stroke; with the top's normal
"""

from typing import NamedTuple

import numpy as np
from shapely import Point

from midrib.hatching.chains import Chain
from midrib.types import Bools, Floats

__all__ = ["Excess", "Laid", "excesses", "strain", "turn_allowed"]

SPACING = (0.8, 1.25)  # gaps between neighbours on the middle line
EDGE_GAP, LEAST_FOOT = 1.75, 0.25  # gaps between their ends: along the edge, and straight
END_GAP = 1.5  # gaps from the ends of the middle line
LEAST_TURN = 20.0  # degrees: so much neighbours may turn anyway
MOST_TILT = 10.0  # degrees
STRAIGHT = 10.0  # degrees: an edge that turns less within two widths has no corner there
ROUNDING = 1e-6  # relative


class Laid(NamedTuple):
    """Whole strokes in order along a slope, and where they are."""

    middle: Chain
    edges: tuple[Chain, Chain]
    station: Floats  # (n,)
    feet: Floats  # (n, 2)
    on_top: Floats  # (n, 2)
    on_toe: Floats  # (n, 2)
    asked: Floats  # (n,) gaps that the rule asks for at each
    on_edge: Bools  # (n,) which of them are drawn as far as the toe

    @property
    def width(self) -> Floats:
        """Lengths of the strokes."""
        width: Floats = np.hypot(*(self.on_toe - self.on_top).T)
        return width

    @property
    def between(self) -> Floats:
        """Gaps that the rule asks for between neighbours, on a closed slope all the way round."""
        return neighbours(self.asked, self.middle.is_closed)

    @property
    def steps(self) -> Floats:
        """Distances between neighbours on the middle line, in gaps."""
        return ahead(self.station, self.middle) / self.between

    def foot_steps(self, edge: int) -> Floats:
        """Distances between the ends of neighbours along an edge, 0 the top, in gaps."""
        return ahead(self.feet[:, edge], self.edges[edge]) / self.between

    def nearest_feet(self) -> Floats:
        """Straight distances between ends on the top, then between those drawn on the toe."""
        closed = self.middle.is_closed
        parts = []
        every = np.ones(len(self.station), dtype=np.bool_)
        for ends, chosen in ((self.on_top, every), (self.on_toe, self.on_edge)):
            some, asked = ends[chosen], self.asked[chosen]
            parts.append(distances(some, closed) / neighbours(asked, closed))
        return np.concatenate(parts)

    def turns(self) -> Floats:
        """Degrees between neighbours."""
        angle = np.degrees(np.arctan2(*(self.on_toe - self.on_top).T[::-1]))
        turn = np.diff(np.append(angle, angle[:1]) if self.middle.is_closed else angle)
        return abs(folded(turn, 360.0))

    def turns_allowed(self) -> Floats:
        """Degrees that neighbours may turn; see ``turn_allowed``."""
        line, station = self.middle, self.station
        step = np.roll(station, -1) - station
        if line.is_closed:
            step = folded(step, line.length)
        width, count = np.maximum(self.width, np.roll(self.width, -1)), len(self.between)
        return turn_allowed(line, (station + step / 2.0)[:count], width[:count], self.between)

    def normals(self) -> Floats:
        """Directions of the normals of the top towards the toe, in degrees; NaN near corners.

        That is where an edge turns by more than 10 degrees within two widths to either side, or
        the two are not parallel but for 10 degrees.
        """
        width = self.width
        top, toe = (
            directions(edge, at, width) for edge, at in zip(self.edges, self.feet.T, strict=True)
        )
        calm = (spread(top) <= STRAIGHT) & (spread(toe) <= STRAIGHT)
        calm &= abs(folded(top[:, 2] - toe[:, 2], 360.0)) <= STRAIGHT
        return np.where(calm, top[:, 2] + 90.0, np.nan)

    def tilts(self) -> Floats:
        """Degrees from the normal of the top; NaN near corners."""
        across = np.degrees(np.arctan2(*(self.on_toe - self.on_top).T[::-1]))
        return abs(folded(across - self.normals(), 180.0))

    def end_gaps(self) -> Floats:
        """Distances along the middle line from its ends to the next stroke, in gaps."""
        if not len(self.station):
            return np.full(2, np.inf)
        first, last = int(np.argmin(self.station)), int(np.argmax(self.station))
        away = np.array([self.station[first], self.middle.length - self.station[last]])
        gaps: Floats = away / self.asked[[first, last]]
        return gaps


def strain(laid: Laid) -> tuple[Floats, Floats]:
    """How far beyond the bounds neighbours are, and strokes by themselves; 0 within.

    Of gaps and feet it is the logarithm of what they are off, of turns and tilts radians.
    """
    steps, feet = laid.steps, laid.nearest_feet()
    k, on_toe = len(steps), np.flatnonzero(laid.on_edge)
    with np.errstate(divide="ignore"):
        off = abs(np.log(steps / np.sqrt(SPACING[0] * SPACING[1])))
        beyond = np.maximum(off - np.log(SPACING[1] / SPACING[0]) / 2.0, 0.0)
        for edge in (0, 1):
            beyond += np.log(np.maximum(laid.foot_steps(edge) / EDGE_GAP, 1.0))
        near = np.log(np.maximum(LEAST_FOOT / feet, 1.0))
    beyond += near[:k]
    beyond[on_toe[: len(feet) - k]] += near[k:]
    beyond += np.radians(np.maximum(laid.turns() - laid.turns_allowed(), 0.0))
    tilts = np.nan_to_num(laid.tilts())
    return beyond, np.radians(np.maximum(tilts - MOST_TILT, 0.0))


class Excess(NamedTuple):
    """A place where strokes are beyond a bound."""

    row: int  # of the stroke, or of the first of two neighbours
    where: Point
    reason: str


def excesses(laid: Laid, offset: float = 1.0) -> list[Excess]:
    """Places where strokes exceed a bound, in order along the slope; O(n + m).

    ``offset`` is how many gaps from the ends of the slope the first and the last stroke should be.
    """
    n = len(laid.station)
    if not n:
        return []
    steps, gaps = laid.steps, [laid.foot_steps(0), laid.foot_steps(1)]
    turns, allowed = laid.turns(), laid.turns_allowed()
    tilts = np.nan_to_num(laid.tilts())
    low, high = SPACING[0] * (1.0 - ROUNDING), SPACING[1] * (1.0 + ROUNDING)
    told: list[tuple[int, int, str]] = []

    def tell(is_beyond: Bools, values: Floats, text: str, count: int = 2) -> None:
        told.extend((i, count, text.format(values[i])) for i in np.flatnonzero(is_beyond).tolist())

    wanted = f"times the rule's gap, {SPACING[0]:g} to {SPACING[1]:g} wanted"
    tell((steps < low) | (steps > high), steps, "neighbours are {:.2f} " + wanted)
    for name, edge_steps in zip(("top", "toe"), gaps, strict=True):
        text = f"ends on the {name} are {{:.2f}} gaps apart, {EDGE_GAP:g} at most wanted"
        tell(edge_steps > EDGE_GAP * (1.0 + ROUNDING), edge_steps, text)
    feet = laid.nearest_feet()
    near = feet < LEAST_FOOT * (1.0 - ROUNDING)
    text = f"ends on the {{}} are {{:.2f}} gaps apart, {LEAST_FOOT:g} at least wanted"
    k = len(steps)
    rows = np.concatenate([np.arange(k), np.flatnonzero(laid.on_edge)])[: len(feet)]
    told.extend(
        (int(rows[i]), 2, text.format("top" if i < k else "toe", feet[i]))
        for i in np.flatnonzero(near).tolist()
    )
    over = turns > allowed * (1.0 + ROUNDING)
    told.extend(
        (i, 2, f"neighbours turn by {turns[i]:.1f} degrees, {allowed[i]:.0f} at most wanted")
        for i in np.flatnonzero(over).tolist()
    )
    text = f"the stroke is {{:.1f}} degrees off the normal of the top, {MOST_TILT:g} at most wanted"
    tell(tilts > MOST_TILT * (1.0 + ROUNDING), tilts, text, 1)
    found = []
    pivots = laid.middle.at(laid.station)
    for row in sorted({row for row, _, _ in told}):
        reasons = [(count, reason) for at, count, reason in told if at == row]
        is_pair = any(count == 2 for count, _ in reasons)
        where = (pivots[row] + pivots[(row + 1) % n]) / 2.0 if is_pair else pivots[row]
        found.append(Excess(row, Point(where), "; ".join(reason for _, reason in reasons)))
    if laid.middle.is_closed:
        return found
    most = END_GAP * max(offset, 1.0) * (1.0 + ROUNDING)
    nearest = (int(np.argmin(laid.station)), int(np.argmax(laid.station)))
    for end, away, row in zip((0, -1), laid.end_gaps(), nearest, strict=True):
        if away > most:
            where = (laid.middle.points[end] + pivots[row]) / 2.0
            reason = f"the slope's end is {away:.1f} gaps from a stroke, {most:.3g} at most wanted"
            found.append(Excess(row, Point(where), reason))
    return found


def turn_allowed(line: Chain, at: Floats, width: Floats, gap: Floats) -> Floats:
    """Degrees that neighbours may turn between them, at stations of the middle line.

    20, or where the middle line turns by A within 1.5 w on either side, A gap over the length of
    that stretch, if that is more.
    """
    low, high = at - 1.5 * width, at + 1.5 * width
    direction = np.unwrap(np.arctan2(*np.diff(line.points, axis=0).T[::-1]))
    half = (line.stations[1:] + line.stations[:-1]) / 2.0
    if line.is_closed:
        turns = np.arange(
            np.floor(low.min(initial=0.0) / line.length) - 1.0,
            np.ceil(high.max(initial=0.0) / line.length) + 1.0,
        )
        lap = np.round((direction[-1] - direction[0]) / (2 * np.pi)) * 2 * np.pi
        half = np.concatenate([half + k * line.length for k in turns])
        direction = np.concatenate([direction + k * lap for k in turns])
    else:
        low, high = np.maximum(low, 0.0), np.minimum(high, line.length)
    theta = np.degrees(abs(np.interp(high, half, direction) - np.interp(low, half, direction)))
    allowed: Floats = np.maximum(LEAST_TURN, theta * gap / np.maximum(high - low, gap))
    return allowed


def ahead(stations: Floats, chain: Chain) -> Floats:
    """Distances between neighbours along a chain; on a closed one from last to first too."""
    if not chain.is_closed:
        steps: Floats = abs(np.diff(stations))
        return steps
    forth = (np.roll(stations, -1) - stations) % chain.length
    return np.minimum(forth, chain.length - forth) if len(stations) > 1 else np.empty(0)


def distances(points: Floats, is_closed: bool) -> Floats:
    """Straight distances between neighbours; if closed, from last to first too."""
    if len(points) < 2:
        return np.empty(0)
    steps = np.roll(points, -1, axis=0) - points
    away: Floats = np.hypot(*(steps if is_closed else steps[:-1]).T)
    return away


def neighbours(values: Floats, is_closed: bool) -> Floats:
    """Means of the values of neighbours."""
    means = (values + np.roll(values, -1)) / 2.0
    if len(means) < 2:
        return np.empty(0)
    return means if is_closed else means[:-1]


def directions(edge: Chain, at: Floats, width: Floats) -> Floats:
    """(n, 5) directions of an edge in degrees, each over a width, from 2 widths before to after."""
    places = at[:, None] + width[:, None] * np.array([-1.5, -0.75, 0.0, 0.75, 1.5])
    low, high = (edge.at(places + half * width[:, None]) for half in (-0.5, 0.5))
    step = high - low
    found: Floats = np.degrees(np.arctan2(step[..., 1], step[..., 0]))
    return found


def spread(directions: Floats) -> Floats:
    """Largest difference of directions from the middle one, in degrees."""
    off: Floats = abs(folded(directions - directions[:, 2:3], 360.0)).max(axis=1)
    return off


def folded(degrees: Floats, period: float) -> Floats:
    """Angles brought to between minus and plus half a period."""
    result: Floats = degrees - period * np.round(degrees / period)
    return result
