"""Radii for the limit curve: as many as a tolerance asks for, at stations that it chooses.

low   .     the end clearance: the least arc length of Q for each station, from the shared end
    .       to the first station whose free radius keeps half its distance from it
  .  . . .  half the station
. .    ___
--+----     arc length of Q of the free radii; here they have collapsed
  main_run
"""

import numpy as np

from midrib.curves.radii import COLLAPSED, NO_BAYS, EndClearance, Radii, pace_of, paced
from midrib.curves.stations import SAME_STATION
from midrib.kernels import limit as kernel
from midrib.kernels.stations import default_count, place_stations
from midrib.layout import Layout
from midrib.types import Floats, Ints

__all__ = ["draw_limit"]

ARCS_WITHIN = 2.0**-14  # of the mean width, where the tolerance is smaller: arcs have no last chord
NO_LIMITS = (-np.inf, -np.inf, np.inf, np.inf)


def draw_limit(layout: Layout, tolerance: float, clearance: EndClearance) -> Radii:
    """Radii whose middles make a chain within ``tolerance`` of the limit curve."""
    if isinstance(clearance, int | float):
        low = float(clearance) if layout.shares_start else -np.inf
        high = layout.auxiliary.length - clearance if layout.shares_end else np.inf
        return trace(layout, tolerance, Limits(layout, low=low, high=high))
    limits = Limits(layout)
    if clearance is not None and (layout.shares_start or layout.shares_end):
        limits.keep_clear(clearance, trace(layout, 0.0, limits))
    return trace(layout, tolerance, limits)


class Limits:
    """The least and the greatest arc length of Q at every station."""

    def __init__(self, layout: Layout, *, low: float = -np.inf, high: float = np.inf) -> None:
        self.layout, self.low, self.high = layout, low, high
        self.clear_until, self.clear_from = 0.0, np.inf  # stations
        self.start_pace = self.end_pace = (1.0, 1.0)

    def keep_clear(self, clearance: EndClearance, free: Radii) -> None:
        """Keep Q clear of shared ends as long as the free radii collapse into them."""
        layout, length = self.layout, self.layout.main.length
        main, auxiliary = layout.main.arc, layout.auxiliary.arc
        if layout.shares_start:
            self.clear_until = first_to_keep(free.stations, free.station, free.arc)
            self.start_pace = pace_of(main, auxiliary, layout, clearance, from_start=True)
        if layout.shares_end:
            n = free.stations.size - 1
            to_go = first_to_keep(
                length - free.stations[::-1],
                n - free.station[::-1],
                layout.auxiliary.length - free.arc[::-1],
            )
            self.clear_from = length - to_go if to_go > 0.0 else np.inf
            self.end_pace = pace_of(main, auxiliary, layout, clearance, from_start=False)

    def cuts(self) -> Floats:
        """Stations at which limits begin, end or change their pace."""
        length = self.layout.main.length
        cuts = [self.clear_until, *self.bends(*self.start_pace)]
        cuts += [self.clear_from, *(length - s for s in self.bends(*self.end_pace))]
        return np.array([s for s in cuts if 0.0 < s < length])

    def bends(self, main_run: float, auxiliary_run: float) -> tuple[float, float]:
        """Stations, from a shared end, at which the pace changes and at which Q arrives."""
        return main_run, main_run + self.layout.auxiliary.length - auxiliary_run

    def between(self, stations: Floats) -> Floats:
        """(n - 1, 4) limits at every station and the next one."""
        length, reach = self.layout.main.length, self.layout.auxiliary.length
        limits = np.tile(np.array([self.low, self.low, self.high, self.high]), (stations.size, 1))
        middle = (stations[1:] + stations[:-1]) / 2.0
        ends = np.column_stack([stations[:-1], stations[1:]])
        early, late = middle < self.clear_until, middle > self.clear_from
        limits = limits[:-1]
        limits[early, :2] = np.minimum(paced(ends[early], *self.start_pace), reach)
        far = reach - paced(length - ends[late], *self.end_pace)
        limits[late, 2:] = np.maximum(far, 0.0)
        return limits


def first_to_keep(stations: Floats, station: Ints, arc: Floats) -> float:
    """First station, from a shared end, whose radius keeps half its distance or that has none.

    0 if that is the end itself, and if there is none.
    """
    if station.size == 0 or station[0] != 0:
        return 0.0
    last = int(station[-1]) + 1
    blind = np.setdiff1d(np.arange(last), station)
    at = stations[station]
    ahead = arc - COLLAPSED * at
    ahead[at == 0.0] = 0.0  # there P is its own Q
    keeps = np.flatnonzero((ahead >= 0.0) & (at > 0.0))
    gap = float(stations[blind[0]]) if blind.size else np.inf
    if keeps.size == 0:
        return gap if np.isfinite(gap) else 0.0
    k = int(keeps[0])
    before, after = float(ahead[k - 1]), float(ahead[k])
    share = before / (before - after) if before < after else 1.0
    return min(float(at[k - 1] + share * (at[k] - at[k - 1])), gap)


def trace(layout: Layout, tolerance: float, limits: Limits) -> Radii:
    """Radii at the events that the tolerance leaves, within limits."""
    main, mesh = layout.main, layout.mesh
    n_vertices = main.arc.size + layout.auxiliary.arc.size
    count = default_count(main.length, layout.mean_width, n_vertices)
    count = min(count, layout.auxiliary.arc.size)  # a look along much less finds no more
    own = np.union1d(np.arange(count + 1) * (main.length / count), limits.cuts())
    stations, _, segment, _ = place_stations(
        own, True, SAME_STATION * main.length, main.arc, main.vertex, mesh.x, mesh.y
    )
    found = kernel.draw_limit(
        mesh, main, layout.auxiliary, stations, segment, limits.between(stations),
        tolerance, max(tolerance, ARCS_WITHIN * layout.mean_width), *layout.scale, True,
    )  # fmt: skip
    is_lopsided = np.zeros(len(found.points), dtype=np.bool_)
    return Radii(found.stations, found.points, found.at, is_lopsided, NO_BAYS)
