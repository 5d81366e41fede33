"""Stations: the arc lengths along the main curve at which radii are drawn.

Source: the paper's section 4 and its Equation 1, d = L / count = L percent / 100.
"""

from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple, TypeAlias, cast

import numpy as np
import shapely
from numpy.typing import ArrayLike

from midrib.checks import check_flag, is_number, shown
from midrib.errors import ParameterError, TooManyStationsError
from midrib.kernels.chain import Chain
from midrib.kernels.stations import default_count, place_stations
from midrib.types import Bools, Floats, Ints

__all__ = ["Skip", "StationRule", "Stations"]

SkipItem: TypeAlias = (
    Literal["bays"]
    | int
    | slice
    | shapely.Polygon
    | shapely.MultiPolygon
    | Callable[[Floats, Floats], Bools]
)
Skip: TypeAlias = SkipItem | Sequence[SkipItem]
SAME_STATION = 2.0**-40  # of the main curve's length: stations nearer than this are one
MOST_STATIONS = 50_000_000
WHOLE = 100.0  # percent
LEAST_PERCENT = WHOLE / MOST_STATIONS


class Stations(NamedTuple):
    """Points P on a main curve."""

    arc: Floats  # (n,) arc lengths
    point: Floats  # (n, 2)
    side: Ints  # (n,) boundary side
    vertex: Ints  # (n,) mesh vertex, or -1

    def chosen(self, rows: Ints | Bools) -> "Stations":
        """Return some of the stations."""
        return Stations(self.arc[rows], self.point[rows], self.side[rows], self.vertex[rows])


class StationRule:
    """Where radii are drawn: any mixture of an interval, the vertices and given stations.

    Parameters
    ----------
    spacing : float, optional
        Interval, counted from the start of the main curve.
    count : int, optional
        The interval is the curve's length over ``count`` (Eq. 1).
    percent : float, optional
        The interval is so many percent of the curve's length (Eq. 1).
    vertices : bool
        Complete with the vertices of the main curve.
    stations : array_like of float, optional
        Stations of the caller's own, as well as the others.
    skip : optional
        Stations to drop, after all others are in place: an index, a slice of indices
        (``slice(0, 3)`` the first three, ``slice(-2, None)`` the last two), a slice of arc lengths
        (``slice(10.0, 25.0)``: two floats), a Polygon (points in it), a function of stations
        and points that returns True for those to drop, ``"bays"``, or a list of such.
    """

    def __init__(
        self,
        spacing: float | None,
        count: int | None,
        percent: float | None,
        vertices: bool,
        stations: ArrayLike | None,
        skip: Skip | None,
    ) -> None:
        check_interval({"spacing": spacing, "count": count, "percent": percent})
        check_flag(vertices, "vertices")
        self.spacing, self.count, self.percent = spacing, count, percent
        self.vertices, self.stations = bool(vertices), own_stations(stations)
        items = list(skip) if isinstance(skip, list | tuple) else [] if skip is None else [skip]
        for item in items:
            check_skip(item)
        self.skip_bays = "bays" in [item for item in items if isinstance(item, str)]
        self.skip = [item for item in items if not isinstance(item, str)]

    def on(
        self, main: Chain, x: Floats, y: Floats, mean_width: float, n_vertices: int
    ) -> "Stations":
        """Stations on one main curve, ascending; x and y are those of mesh vertices.

        Without any rule for the interval, and no stations given, it is L / ``default_count``.

        Raises
        ------
        ParameterError
            If there are none, or absurdly many, or a given one is not on the curve.
        """
        own = self.own(main.length, mean_width, n_vertices)
        tolerance = SAME_STATION * main.length
        arc, points, segment, vertex = place_stations(
            own, self.vertices, tolerance, main.arc, main.vertex, x, y
        )
        placed = Stations(arc, points, main.side[segment], vertex)
        if self.skip:
            placed = placed.chosen(self.kept(arc, points))
        if placed.arc.size == 0:
            msg = "no station is left on the main curve, expected at least one"
            raise ParameterError(msg)
        return placed

    def own(self, length: float, mean_width: float, n_vertices: int) -> Floats:
        """Stations by interval and those given, on a curve of the given length."""
        interval = self.interval(length, mean_width, n_vertices)
        by_interval: Floats = np.empty(0)
        if interval is not None:
            n = np.floor(length / interval * (1.0 + SAME_STATION))
            if n > MOST_STATIONS:
                msg = f"an interval of {interval:g} asks for {n:.3g} stations, expected fewer"
                raise TooManyStationsError(msg)
            # i (L / n) rather than i d: commensurate stations stay so when the curve is reversed.
            steps: Floats = np.arange(int(n) + 1, dtype=np.float64)
            is_even = abs(length - n * interval) <= SAME_STATION * length
            by_interval = steps * (length / n) if is_even else steps * interval
        if self.stations is None:
            return by_interval
        outside = self.stations[(self.stations < 0.0) | (self.stations > length)]
        if outside.size:
            msg = f"station {outside[0]:.12g} is not on the main curve, expected 0 to {length:.12g}"
            raise ParameterError(msg)
        return np.union1d(by_interval, self.stations)

    def interval(self, length: float, mean_width: float, n_vertices: int) -> float | None:
        """Interval on a curve of the given length, None if the rule has none."""
        if self.spacing is not None:
            return float(self.spacing)
        if self.count is not None:
            return length / int(self.count)
        if self.percent is not None:
            return float(length * (self.percent / 100.0))
        if self.stations is not None:
            return None
        return length / default_count(length, mean_width, n_vertices)

    def kept(self, stations: Floats, points: Floats) -> Bools:
        """Which stations ``skip`` leaves, bays apart: those take the radii to tell."""
        keep = np.ones(stations.size, dtype=np.bool_)
        for item in self.skip:
            keep &= ~dropped(item, stations, points)
        return keep


def check_interval(given: dict[str, Any]) -> None:
    """Refuse intervals that no main curve can have; ``given`` are those of ``StationRule``."""
    named = {name: value for name, value in given.items() if value is not None}
    if len(named) > 1:
        msg = f"{' and '.join(named)} exclude each other, give one of them"
        raise ParameterError(msg)
    for name, value in named.items():
        if not is_number(value) or not 0 < value < np.inf:
            msg = f"{name} is {shown(value)}, expected a positive number"
            raise ParameterError(msg)
        if name == "count" and value != int(value):
            msg = f"count is {value!r}, expected a whole number"
            raise ParameterError(msg)
        if name == "count" and value > MOST_STATIONS:
            msg = f"count is {value!r}, expected at most {MOST_STATIONS:,}"
            raise ParameterError(msg)
        if name == "percent" and not LEAST_PERCENT <= value <= WHOLE:
            msg = f"percent is {value!r}, expected at most 100, and at least {LEAST_PERCENT:g}"
            raise ParameterError(msg)


def own_stations(stations: ArrayLike | None) -> Floats | None:
    """Stations of the caller's own, ascending."""
    if stations is None:
        return None
    try:
        given = np.asarray(stations)
        own: Floats = np.unique(np.asarray(stations, dtype=np.float64)).astype(np.float64)
    except (TypeError, ValueError):
        given = np.empty(0, dtype=object)
    if given.dtype.kind not in "iuf" or given.ndim > 1:
        msg = f"stations is {shown(stations)}, expected arc lengths"
        raise ParameterError(msg)
    if not np.isfinite(own).all():
        msg = "stations have a value that is not finite, expected arc lengths"
        raise ParameterError(msg)
    return own


def check_skip(item: Any) -> None:
    """Refuse what names no stations, whatever the main curve."""
    if isinstance(item, str) and item == "bays":
        return
    if is_index(item) or isinstance(item, shapely.Polygon | shapely.MultiPolygon):
        return
    if isinstance(item, slice):
        ends = [end for end in (item.start, item.stop) if end is not None]
        is_even = is_index(item.step) and item.step and not has_arc_lengths(item)
        if all(is_number(end) and not np.isnan(end) for end in ends) and (
            item.step is None or is_even
        ):
            return
        msg = f"skip is {shown(item)}, expected a slice of indices, or of two arc lengths"
        raise ParameterError(msg)
    if not callable(item):
        msg = (
            f"skip is {shown(item)}, expected 'bays', an index, a slice, a Polygon, a function or "
            "a list of them"
        )
        raise ParameterError(msg)


def is_index(value: Any) -> bool:
    """Whether a value is a whole number; True and False are none."""
    return isinstance(value, int | np.integer) and not isinstance(value, bool)


def has_arc_lengths(item: slice) -> bool:
    """Whether a slice is one of arc lengths, not of indices."""
    return any(isinstance(end, float | np.floating) for end in (item.start, item.stop))


def dropped(item: SkipItem, stations: Floats, points: Floats) -> Bools:
    """Which stations one item of ``skip``, other than bays, names."""
    drop = np.zeros(stations.size, dtype=np.bool_)
    if isinstance(item, slice):
        if has_arc_lengths(item):
            low = -np.inf if item.start is None else item.start
            high = np.inf if item.stop is None else item.stop
            return (stations >= low) & (stations <= high)
        drop[item] = True
        return drop
    if isinstance(item, int | np.integer):
        if not -stations.size <= item < stations.size:
            msg = f"skip names station {item}, expected an index below {stations.size}"
            raise ParameterError(msg)
        drop[item] = True
        return drop
    if isinstance(item, shapely.Polygon | shapely.MultiPolygon):
        return cast("Bools", shapely.intersects_xy(item, points[:, 0], points[:, 1]))
    mask = np.asarray(cast("Callable[..., Any]", item)(stations, points), dtype=np.bool_)
    if mask.shape != stations.shape:
        msg = f"skip returned {mask.shape} values, expected {stations.shape}"
        raise ParameterError(msg)
    return mask
