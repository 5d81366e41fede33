"""Minimal radii: stations, end clearance, bays, jumps."""

from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from midrib.curves.stations import StationRule, Stations
from midrib.kernels import radii as kernel
from midrib.kernels.boxtree import GRAZE, LIMIT
from midrib.layout import Layout
from midrib.types import Bools, Floats, Ints

__all__ = ["EndClearance", "Radii", "draw_radii", "jumps_of"]

EndClearance: TypeAlias = Literal["station", "proportional"] | float | None
COLLAPSED = 0.5  # a radius has collapsed into the shared end if E is less than half as far from it
STRAIGHT = 2.0**-20  # a first segment goes on through vertices that bend by less than this
JUMP_SLACK = 2.0**-20
# A radius is lopsided if Q sees the main curve nearer than P by this factor. Of 1.2, 1.5, 2 and 3
# it gave the most centred lines on rivers, roads, verges and slopes.
LOPSIDED = 1.5
NO_BAYS = np.empty(0)


class Radii(NamedTuple):
    """Minimal radii in order of travel; several with one station where they tie."""

    stations: Floats  # (n,) all stations, with or without a radius
    points: Floats  # (k, 6) P, Q, arc length of Q, radius
    at: Ints  # (k, 6) station, side and vertex of P; segment, vertex and kind of Q
    is_lopsided: Bools  # (k,) whether Q sees the main curve much nearer than P, if that was asked
    bays: Floats  # (b,) stations left out because they lie in bays

    @property
    def station(self) -> Ints:
        """(k,) which of the stations each radius belongs to."""
        return self.at[:, 0]

    @property
    def arc(self) -> Floats:
        """(k,) arc length of each Q along the auxiliary curve."""
        return self.points[:, 4]

    @property
    def kind(self) -> Ints:
        """(k,) FOOT, VERTEX, GRAZE or LIMIT."""
        return self.at[:, 5]

    def chosen(self, rows: Ints | Bools) -> "Radii":
        """Return some of the radii, of the same stations."""
        return self._replace(
            points=self.points[rows], at=self.at[rows], is_lopsided=self.is_lopsided[rows]
        )

    def of_stations(self, stations: Floats, row: Ints) -> "Radii":
        """Return the radii of other stations, with the old rows' new places."""
        at = self.at.copy()
        at[:, 0] = row[at[:, 0]]
        return self._replace(stations=stations, at=at)


def draw_radii(layout: Layout, rule: StationRule, clearance: EndClearance) -> Radii:
    """Place the stations on the main curve and draw the radii from them."""
    mesh = layout.mesh
    n_vertices = layout.main.arc.size + layout.auxiliary.arc.size
    stations = rule.on(layout.main, mesh.x, mesh.y, layout.mean_width, n_vertices)
    low, high = np.full(stations.arc.size, -np.inf), np.full(stations.arc.size, np.inf)
    if isinstance(clearance, int | float):
        if layout.shares_start:
            low[:] = clearance
        if layout.shares_end:
            high[:] = layout.auxiliary.length - clearance
    lopsided = LOPSIDED if rule.skip_bays else 0.0
    radii = look_from(layout, stations, low, high, lopsided)
    if clearance in ("station", "proportional") and (layout.shares_start or layout.shares_end):
        crowded = np.flatnonzero(crowd_the_ends(layout, radii, clearance, low, high))
        if crowded.size:
            again = look_from(layout, stations.chosen(crowded), low[crowded], high[crowded])
            radii = replaced(radii, again, crowded)
    return without_bays(radii) if rule.skip_bays else radii


def look_from(
    layout: Layout, stations: Stations, low: Floats, high: Floats, lopsided: float = 0.0
) -> Radii:
    """Nearest visible points from stations, with arc lengths from low to high."""
    drawn = kernel.draw_radii(
        layout.mesh, layout.main, layout.auxiliary,
        stations.point, stations.side, stations.vertex, low, high, lopsided, *layout.scale,
    )  # fmt: skip
    return Radii(stations.arc, *drawn, bays=NO_BAYS)


def replaced(radii: Radii, again: Radii, crowded: Ints) -> Radii:
    """Radii with those of the crowded stations drawn again."""
    is_crowded = np.zeros(radii.stations.size, dtype=np.bool_)
    is_crowded[crowded] = True
    kept = radii.chosen(~is_crowded[radii.station])
    again = again.of_stations(radii.stations, crowded)
    both: dict[str, Any] = {
        name: np.concatenate([getattr(kept, name), getattr(again, name)])
        for name in ("points", "at", "is_lopsided")
    }
    merged = radii._replace(**both)
    return merged.chosen(np.argsort(merged.station, kind="stable"))


def without_bays(radii: Radii) -> Radii:
    """Radii without those from bays and side arms of the main curve.

    In a bay P is far from the auxiliary curve, while Q, across the bay's mouth, has the main curve
    nearer on either side of it. Such a radius is lopsided: its middle is not between the banks.
    Stations next to a shared end are left as the end clearance has placed them.
    """
    in_bay = np.zeros(radii.stations.size, dtype=np.bool_)
    in_bay[radii.station[radii.is_lopsided]] = True
    is_kept = ~in_bay[radii.station]
    if is_kept.all() or not is_kept.any():
        return radii
    kept = radii.chosen(is_kept)._replace(bays=radii.stations[in_bay])
    return kept.of_stations(radii.stations[~in_bay], np.cumsum(~in_bay) - 1)


def crowd_the_ends(
    layout: Layout, radii: Radii, clearance: EndClearance, low: Floats, high: Floats
) -> Bools:
    """Which stations next to a shared end have a collapsed radius; writes their clearance.

    From the end on, up to the first station whose free radius already keeps half its distance:
    from there the construction needs no help, and a bound would only hide the nearest point.
    Where no station's radius keeps it, the area is no strip at that end and is left alone.
    """
    n, stations = radii.stations.size, radii.stations
    main, auxiliary = layout.main, layout.auxiliary
    first, last = np.full(n, np.nan), np.full(n, np.nan)
    np.fmin.at(first, radii.station, radii.arc)
    np.fmax.at(last, radii.station, radii.arc)
    crowded = np.zeros(n, dtype=np.bool_)
    if layout.shares_start:
        keeps = ~(last < COLLAPSED * stations) & (stations > 0.0)
        stop = int(np.argmax(keeps))
        if stop > 1:
            pace = pace_of(main.arc, auxiliary.arc, layout, clearance, from_start=True)
            crowded[:stop] = True
            low[:stop] = np.minimum(paced(stations[:stop], *pace), auxiliary.length)
    if layout.shares_end:
        to_go, left = main.length - stations, auxiliary.length - first
        keeps = ~(left < COLLAPSED * to_go) & (to_go > 0.0)
        start = n - int(np.argmax(keeps[::-1]))
        if n - start > 1:
            pace = pace_of(main.arc, auxiliary.arc, layout, clearance, from_start=False)
            crowded[start:] = True
            high[start:] = np.maximum(auxiliary.length - paced(to_go[start:], *pace), 0.0)
    return crowded


def pace_of(
    main: Floats, auxiliary: Floats, layout: Layout, clearance: EndClearance, *, from_start: bool
) -> tuple[float, float]:
    """Lengths of the first (last) segments of the two curves, equal for ``"station"``."""
    if clearance == "station":
        return 1.0, 1.0
    return (
        end_run(layout, layout.main.vertex, main, from_start=from_start),
        end_run(layout, layout.auxiliary.vertex, auxiliary, from_start=from_start),
    )


def end_run(layout: Layout, vertex: Ints, arc: Floats, *, from_start: bool) -> float:
    """Length of a chain's first (last) straight run; a vertex on a straight line ends nothing."""
    if not from_start:
        vertex, arc = vertex[::-1], arc[-1] - arc[::-1]
    x, y = layout.mesh.x[vertex] * layout.scale[0], layout.mesh.y[vertex] * layout.scale[1]
    dx, dy = x - x[0], y - y[0]
    i = 1
    while i + 1 < vertex.size:
        length_squared = dx[i + 1] ** 2 + dy[i + 1] ** 2
        if abs(dx[i + 1] * dy[i] - dy[i + 1] * dx[i]) > STRAIGHT * length_squared:
            break
        i += 1
    return float(arc[i])


def paced(stations: Floats, main_run: float, auxiliary_run: float) -> Floats:
    """Clearance at stations: in proportion along the first segments, then step by step."""
    on_run = stations * (auxiliary_run / main_run)
    return np.where(stations <= main_run, on_run, auxiliary_run + (stations - main_run))


def jumps_of(radii: Radii) -> Floats:
    """Stations at which Q jumps: halfway between two stations, or a station whose radii tie.

    Q moves along the auxiliary curve at most as fast as P along the main one, except behind a
    grazing vertex or at the end clearance; any other faster step is a jump.
    """
    at = radii.stations[radii.station]
    step = np.diff(at)
    move = np.abs(np.diff(radii.arc))
    before, after = radii.kind[:-1], radii.kind[1:]
    led = ((before == GRAZE) & (after == GRAZE)) | (before == LIMIT) | (after == LIMIT)
    slack = JUMP_SLACK * (radii.stations[-1] + (radii.arc.max() if radii.arc.size else 0.0))
    jump = (move > step * (1.0 + JUMP_SLACK) + slack) & ~led
    return np.unique((at[:-1][jump] + at[1:][jump]) / 2.0)
