"""Stations: the arc lengths along the main curve at which radii are drawn.

Source: the paper's section 4 and its Equation 1, d = L / count = L percent / 100.
"""

from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple, TypeAlias, cast

import numpy as np
import shapely
from numpy.typing import ArrayLike

from midrib.errors import ParameterError
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
        given = {"spacing": spacing, "count": count, "percent": percent}
        named = [name for name, value in given.items() if value is not None]
        if len(named) > 1:
            msg = f"{' and '.join(named)} exclude each other, give one of them"
            raise ParameterError(msg)
        for name in named:
            value = given[name]
            if not isinstance(value, int | float | np.number) or not 0 < value < np.inf:
                msg = f"{name} is {value!r}, expected a positive number"
                raise ParameterError(msg)
        if count is not None and count != int(count):
            msg = f"count is {count!r}, expected a whole number"
            raise ParameterError(msg)
        if percent is not None and percent > 100:
            msg = f"percent is {percent!r}, expected at most 100"
            raise ParameterError(msg)
        own: Floats | None = None
        if stations is not None:
            own = np.unique(np.asarray(stations, dtype=np.float64)).astype(np.float64)
        if own is not None and (own.ndim != 1 or not np.isfinite(own).all()):
            msg = "stations have a value that is not finite, expected arc lengths"
            raise ParameterError(msg)
        self.spacing, self.count, self.percent = spacing, count, percent
        self.vertices, self.stations = vertices, own
        items = list(skip) if isinstance(skip, list | tuple) else [] if skip is None else [skip]
        self.skip_bays = "bays" in [item for item in items if isinstance(item, str)]
        self.skip = [item for item in items if not (isinstance(item, str) and item == "bays")]

    def on(
        self, main: Chain, x: Floats, y: Floats, mean_width: float, n_vertices: int
    ) -> "Stations":
        """Stations on one main curve, ascending; x and y are those of mesh vertices.

        Without any rule for the interval, and no stations given, it is L / ``default_count``.

        Raises
        ------
        ParameterError
            If there are none, or absurdly many.
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
                raise ParameterError(msg)
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
            keep &= ~dropped(cast("SkipItem", item), stations, points)
        return keep


def dropped(item: SkipItem, stations: Floats, points: Floats) -> Bools:
    """Which stations one item of ``skip`` names."""
    drop = np.zeros(stations.size, dtype=np.bool_)
    if isinstance(item, slice):
        if isinstance(item.start, float) or isinstance(item.stop, float):
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
    if callable(item):
        mask = np.asarray(item(stations, points), dtype=np.bool_)
        if mask.shape != stations.shape:
            msg = f"skip returned {mask.shape} values, expected {stations.shape}"
            raise ParameterError(msg)
        return mask
    msg = (
        f"skip is {item!r}, expected 'bays', an index, a slice, a Polygon, a function or a list "
        "of them"
    )
    raise ParameterError(msg)
