"""Bounds that a hatching keeps, or else says where it does not."""

from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from shapely import LineString, Point

from midrib.hatching.chains import Chain
from midrib.kernels.gauging import (
    ALLOWED,
    LEAN,
    NEAR_TOE,
    NEAR_TOP,
    NORMAL,
    STEP,
    TOE,
    TOP,
    TURN,
    Course,
    gauge,
)
from midrib.kernels.ladder import MOST_LOCAL
from midrib.types import Bools, Floats

__all__ = ["Curves", "Excess", "Laid", "excesses", "far_ends", "most_at_ends"]

SPACING = (0.8, 1.25)  # gaps between neighbours on the middle line
EDGE_GAP, LEAST_FOOT = 1.75, 0.25  # gaps between their ends: along the edge, and straight
END_GAP = 1.5  # gaps from the ends of the middle line
TIP_PLACES = 65  # between an end and the next stroke, where the width is told
ROUNDING = 1e-6  # relative
TEXTS = {
    STEP: f"neighbours are {{:.2f}} times the rule's gap apart, {SPACING[0]:g} to {SPACING[1]:g} "
    "wanted",
    TOP: f"ends on the top are {{:.2f}} gaps apart, {EDGE_GAP:g} at most wanted",
    TOE: f"ends on the toe are {{:.2f}} gaps apart, {EDGE_GAP:g} at most wanted",
    NEAR_TOP: f"ends on the top are {{:.2f}} gaps apart, {LEAST_FOOT:g} at least wanted",
    NEAR_TOE: f"ends on the toe are {{:.2f}} gaps apart, {LEAST_FOOT:g} at least wanted",
    TURN: "neighbours turn by {:.1f} degrees, {:.1f} at most wanted",
    NORMAL: "the stroke is {:.1f} degrees off the normals of the edges here, {:.1f} at most wanted",
}


class Curves(NamedTuple):
    """The middle line of a slope and its edges, beside each other."""

    middle: Chain
    top: Chain
    toe: Chain


class Laid:
    """Whole strokes in order along a slope, and how they keep the bounds.

    Parameters
    ----------
    curves : Curves
    station : (n,) stations on the middle line
    feet : (n, 2) stations on top and toe
    ends : (n, 4) x and y on top and toe
    asked : (n,) gaps that the rule asks for at each
    local : (n,) local widths there
    on_edge : (n,) which of them are drawn as far as the toe; all unless given
    """

    def __init__(
        self,
        curves: Curves,
        station: Floats,
        feet: Floats,
        ends: Floats,
        asked: Floats,
        local: Floats,
        on_edge: Bools | None = None,
    ) -> None:
        self.curves, self.station, self.feet, self.ends = curves, station, feet, ends
        self.asked, self.local = asked, local
        self.on_edge = np.ones(station.size, dtype=np.bool_) if on_edge is None else on_edge
        closed = curves.middle.is_closed and station.size > 1
        self.count = station.size if closed else max(station.size - 1, 0)  # of neighbours

    @cached_property
    def widths(self) -> Floats:
        """Lengths of the whole strokes."""
        lengths: Floats = np.hypot(*(self.ends[:, 2:] - self.ends[:, :2]).T)
        return lengths

    @cached_property
    def gauged(self) -> Floats:
        """All numbers about them; see ``midrib.kernels.gauging``."""
        line, top, toe = (Course(*curve) for curve in self.curves)
        local = np.minimum(self.widths, MOST_LOCAL * self.local)
        station, feet, ends, asked = (
            np.ascontiguousarray(a) for a in (self.station, self.feet, self.ends, self.asked)
        )
        table: Floats = gauge(line, top, toe, station, feet, ends, asked, local, self.on_edge)
        return table

    def between(self, column: int) -> Floats:
        """One number about all neighbours, on a closed slope all the way round."""
        column_of: Floats = self.gauged[: self.count, column]
        return column_of

    @property
    def tilts(self) -> Floats:
        """Degrees from the normal of an edge; see ``midrib.kernels.gauging``."""
        across = np.arctan2(self.ends[:, 3] - self.ends[:, 1], self.ends[:, 2] - self.ends[:, 0])
        off = np.degrees(across - self.gauged[:, NORMAL])
        tilts: Floats = abs(off - 180.0 * np.round(off / 180.0))
        return tilts

    @property
    def feet_apart(self) -> float:
        """Least straight distance between neighbouring ends on an edge, in gaps."""
        return float(
            np.fmin.reduce(self.gauged[:, [NEAR_TOP, NEAR_TOE]], axis=None, initial=np.inf)
        )

    @property
    def end_gaps(self) -> Floats:
        """Distances along the middle line from its ends to the next stroke, in gaps."""
        if not self.station.size:
            return np.full(2, np.inf)
        first, last = int(np.argmin(self.station)), int(np.argmax(self.station))
        away = np.array([self.station[first], self.curves.middle.length - self.station[last]])
        gaps: Floats = away / self.asked[[first, last]]
        return gaps

    @property
    def bare_ends(self) -> Floats:
        """(2, 2) distances along top and toe from their ends to the next foot, in gaps."""
        if not self.station.size:
            return np.full((2, 2), np.inf)
        first, last = int(np.argmin(self.station)), int(np.argmax(self.station))
        lengths = np.array([self.curves.top.length, self.curves.toe.length])
        away = np.array([self.feet[first], lengths - self.feet[last]])
        gaps: Floats = away / self.asked[[first, last], None]
        return gaps

    @cached_property
    def beyond(self) -> Floats:
        """(n, 9) how far each number is beyond its bound, 0 within.

        Of turns and tilts in radians, else as the logarithm of what it is off.
        """
        table = self.gauged
        off = np.zeros_like(table)
        with np.errstate(divide="ignore"):
            step = np.log(table[:, STEP])
            off[:, STEP] = np.fmax(step - np.log(SPACING[1]), np.log(SPACING[0]) - step)
            off[:, [TOP, TOE]] = np.log(table[:, [TOP, TOE]] / EDGE_GAP)
            off[:, [NEAR_TOP, NEAR_TOE]] = np.log(LEAST_FOOT / table[:, [NEAR_TOP, NEAR_TOE]])
        off[:, TURN] = table[:, TURN] - table[:, ALLOWED]
        off[:, NORMAL] = np.radians(self.tilts) - table[:, LEAN]
        return np.where(off > ROUNDING, off, 0.0)


class Excess(NamedTuple):
    """A place where strokes are beyond a bound."""

    row: int  # of the stroke, or of the first of two neighbours
    where: Point
    reason: str


def excesses(laid: Laid) -> list[Excess]:
    """Places where neighbours, or strokes by themselves, exceed a bound; O(n + m)."""
    n, pivots = laid.station.size, laid.curves.middle.at(laid.station)
    found = []
    for row in np.flatnonzero(laid.beyond.any(axis=1)).tolist():
        columns = np.flatnonzero(laid.beyond[row]).tolist()
        values = laid.gauged[row].copy()
        values[[TURN, ALLOWED, LEAN]] = np.degrees(values[[TURN, ALLOWED, LEAN]])
        values[NORMAL], most = laid.tilts[row], {TURN: values[ALLOWED], NORMAL: values[LEAN]}
        reason = "; ".join(TEXTS[c].format(values[c], most.get(c)) for c in columns)
        where = pivots[row]
        if columns != [NORMAL]:
            where = (where + pivots[(row + 1) % n]) / 2.0
        found.append(Excess(row, Point(where), reason))
    return found


def most_at_ends(offset: float) -> float:
    """Gaps that the first and last stroke may be from the ends, where they should be so many."""
    return END_GAP * max(offset, 1.0)


def far_ends(laid: Laid, offset: float = 1.0, least: float = 0.0) -> list[Excess]:
    """Find ends of the middle line that are too far from the next stroke.

    ``offset`` is how many gaps it should be. What is narrower than the ``least`` stroke at an end
    is a tip in which none has room, and does not count.
    """
    middle = laid.curves.middle
    if middle.is_closed or not laid.station.size:
        return []
    most, found = most_at_ends(offset), []
    nearest = (int(np.argmin(laid.station)), int(np.argmax(laid.station)))
    for end, whole, row in zip((0, -1), laid.end_gaps, nearest, strict=True):
        if whole <= most * (1.0 + ROUNDING):
            continue
        at = laid.station[row]
        away = roomy(laid.curves, at, middle.length if end else 0.0, least) / laid.asked[row]
        if away <= most * (1.0 + ROUNDING):
            continue
        reason = f"the slope's end is {away:.1f} gaps from a stroke, {most:.3g} at most wanted"
        found.append(Excess(row, Point((middle.points[end] + middle.at(at)) / 2.0), reason))
    return found


def roomy(curves: Curves, start: float, end: float, least: float) -> float:
    """Length of the middle line, from a station towards an end, until only a narrow tip is left."""
    at = np.linspace(start, end, TIP_PLACES)
    points = shapely.points(curves.middle.at(at))
    off = [shapely.distance(points, LineString(edge.points)) for edge in (curves.top, curves.toe)]
    wide = np.flatnonzero(2.0 * np.maximum(*off) >= least)
    return float(abs(at[wide[-1]] - start)) if wide.size else 0.0
