"""Chains: polylines with stations, open or closed."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

if TYPE_CHECKING:
    from shapely import LineString

    from midrib.types import Floats

__all__ = ["Chain", "chain_of"]


class Chain(NamedTuple):
    """A polyline whose points are told by their station; of a closed one, stations go round."""

    points: "Floats"  # (k, 2)
    stations: "Floats"  # (k,) from 0
    is_closed: bool

    @property
    def length(self) -> float:
        """Length of the chain."""
        return float(self.stations[-1])

    def within(self, stations: "Floats") -> "Floats":
        """Stations brought back onto the chain: round a closed one, else to its ends."""
        if self.is_closed:
            return np.mod(stations, self.length)
        return np.clip(stations, 0.0, self.length)

    def at(self, stations: "Floats") -> "Floats":
        """Points (…, 2) at stations."""
        known = self.within(stations)
        return np.stack([np.interp(known, self.stations, x) for x in self.points.T], axis=-1)

    def directions(self, stations: "Floats") -> "Floats":
        """Find unit vectors (…, 2) along the segments at stations, at a vertex of the next one."""
        segment = np.searchsorted(self.stations, self.within(stations), side="right") - 1
        segment = np.clip(segment, 0, len(self.stations) - 2)
        steps = np.diff(self.points, axis=0)
        unit: Floats = steps / np.hypot(*steps.T)[:, None]
        return unit[segment]

    def between(self, start: float, stop: float) -> "Floats":
        """Points (k, 2) from one station to a later one, with the vertices between them."""
        turns = np.array([0.0])
        if self.is_closed:
            turns = np.arange(np.floor(start / self.length), np.floor(stop / self.length) + 1.0)
        around = (
            self.stations[: -1 if self.is_closed else None] + self.length * turns[:, None]
        ).ravel()
        inner = around[(around > start) & (around < stop)]
        return self.at(np.concatenate([[start], inner, [stop]]))


def chain_of(line: "LineString") -> Chain:
    """Chain of a line, without repeated points."""
    points = shapely.get_coordinates(line)
    distinct = np.ones(len(points), dtype=np.bool_)
    distinct[1:] = (points[1:] != points[:-1]).any(axis=1)
    points = points[distinct]
    steps = np.hypot(*np.diff(points, axis=0).T)
    return Chain(points, np.concatenate([[0.0], np.cumsum(steps)]), bool(line.is_closed))
