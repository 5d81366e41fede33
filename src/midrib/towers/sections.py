"""Planar sections of clouds as strips: towers, tunnels, pipes, walls.

plane     through a point, with a normal
u, v      coordinates in the plane: v along the object, u across it
slab      points within half a thickness of the plane
walls     the two bands of points, each thinned to a curve: each followed along itself, or, where
          they do not hang together, what is on either side of the middle

           main . : . . : . : . .
                                       v -->
      auxiliary : . . : . . : . :
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from shapely import LineString

from midrib.checks import is_number, shown
from midrib.errors import ParameterError
from midrib.strip import Strip
from midrib.towers.cloud import ArrayCloud, Cloud
from midrib.towers.following import follow_walls
from midrib.towers.thinning import Thinning, thinned_wall

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from midrib.types import Bools, Floats, Ints

__all__ = ["Section", "section"]

LEAST = 20  # points of a section, or of a wall
BINS = 100  # along the object, in which the middle is looked for
SMOOTH = 7  # bins over which the middle is a running median
BROKEN = 0.25  # of the usual gap between the walls: with less there are no two of them
LONG = 2.0  # intervals: walls are carried on over shorter gaps
BAND, LEAST_OF_BAND = 0.1, 3  # share of the points of a bin, and points: fewer are strays
OTHERS = 0.15  # share of the points that may be no wall's
STRAY = 0.01  # share of the points of a bin on either side that may be strays


class Section(NamedTuple):
    """A section of a cloud in the coordinates of its plane."""

    points: "Floats"  # (n, 2) u and v of the slab's points
    main: LineString  # wall with the lesser u, where the object runs along v
    auxiliary: LineString
    origin: "Floats"  # (3,) where u and v are 0
    across: "Floats"  # (3,) direction of u
    along: "Floats"  # (3,) direction of v

    @property
    def strip(self) -> Strip:
        """Strip between the walls, for ``midrib.minimal_radii``."""
        return Strip(self.main, self.auxiliary)

    def in_space(self, line: LineString) -> LineString:
        """Line of the plane, such as an axis, as a LineString Z in the cloud's coordinates."""
        uv = np.array(line.coords)[:, :2]
        return LineString(self.origin + uv[:, :1] * self.across + uv[:, 1:] * self.along)


def section(
    source: "ArrayLike | Cloud",
    point: "ArrayLike",
    normal: "ArrayLike",
    *,
    thickness: float,
    interval: float,
    along: "ArrayLike | None" = None,
    thinning: Thinning = "moving-least-squares",
    radius: float | None = None,
) -> Section:
    """Cut a cloud by a plane and thin what is on either side of the middle to two curves.

    Parameters
    ----------
    source : array_like, shape (n, 3), or Cloud
        Points, or what ``midrib.formats.clouds.open_cloud`` has opened.
    point, normal : array_like, shape (3,)
        A point of the plane and its normal.
    thickness : float
        Points within half of it on either side of the plane belong to the section.
    interval : float
        Distance of the curves' vertices.
    along : array_like, shape (3,), optional
        Direction of v; that in which the section extends most unless given. Main is the wall with
        the lesser u where the object runs along it. Walls in pieces must not turn back along it.
    thinning : {"moving-least-squares", "average-depth"}, default "moving-least-squares"
        How bands of points become curves.
    radius : float, optional
        Of "average-depth"; half the interval unless given.

    Returns
    -------
    Section
        ``strip`` goes into ``midrib.minimal_radii``, and ``in_space`` brings the line back.

    Raises
    ------
    ParameterError
        If a length is not above 0, the normal is none, there are no two walls, somewhere over more
        than two intervals, or more than 15 % of the points lie on neither.

    Notes
    -----
    Walls are what hangs together, cell by cell; bends may turn by any angle, and what stands apart
    from them is left out. Where that makes no two walls, they are on either side of the middle: the
    running median of what halves the points' range bin by bin, a percent of strays on either side
    left out. O(n) for the cut, O(k log k) for the k points in it.

    Examples
    --------
    A pipe along x, cut lengthwise by a level plane:

    >>> x, angle = np.random.default_rng(1).uniform(0, [[20.0], [2 * np.pi]], (2, 40_000))
    >>> pipe = np.column_stack([x, np.cos(angle), 3.0 + np.sin(angle)])
    >>> cut = section(pipe, (0, 0, 3), (0, 0, 1), thickness=0.05, interval=0.5)
    >>> curve = minimal_radii(cut.strip, ends="caps", centring="symmetric")
    >>> axis = cut.in_space(curve.line)
    >>> bool(np.abs(np.array(axis.coords)[:, 1]).max() < 0.001), round(float(curve.radii.mean()), 2)
    (True, 2.0)
    """
    for name, value in (("thickness", thickness), ("interval", interval)):
        if not (is_number(value) and 0.0 < value < np.inf):
            msg = f"{name} is {shown(value)}, expected a length above 0"
            raise ParameterError(msg)
    origin = vector(point, "point")
    n = direction(normal, "normal")
    cloud: Cloud = source if hasattr(source, "chunks") else ArrayCloud(source)  # type: ignore[assignment]
    slab = [chunk[np.abs((chunk - origin) @ n) <= thickness / 2.0] for chunk in cloud.chunks()]
    flat = np.concatenate([np.zeros((0, 3)), *slab])
    if len(flat) < LEAST:
        msg = f"the section has {len(flat)} points, expected at least {LEAST}: a larger thickness"
        raise ParameterError(msg)
    v_axis = longest(flat, n) if along is None else direction(along, "along")
    v_axis = direction(v_axis - (v_axis @ n) * n, "along, in the plane,")
    u_axis = np.cross(v_axis, n)
    points = np.column_stack([(flat - origin) @ u_axis, (flat - origin) @ v_axis])
    radius = radius or interval / 2.0
    walls = follow_walls(points, thinning, interval, radius)
    walls = walls or walls_beside_middle(points, thinning, interval, radius)
    main, auxiliary = (LineString(wall) for wall in walls)
    check_result(points, main, auxiliary, interval)
    return Section(points, main, auxiliary, origin, u_axis, v_axis)


def walls_beside_middle(
    points: "Floats", thinning: Thinning, interval: float, radius: float
) -> "list[Floats]":
    """Curves through what is on either side of the middle, where walls do not turn back along v.

    Raises
    ------
    ParameterError
        If there are no two walls.
    """
    check_walls(points, interval)
    is_main = below_middle(points)
    walls = []
    for rows in (is_main, ~is_main):
        wall = thinned_wall(points[rows], thinning, interval, radius)
        if len(wall) < 2:
            msg = f"the section has no two walls: one of {int(rows.sum())} points is no curve"
            raise ParameterError(msg)
        walls.append(wall)
    return walls


def vector(value: object, name: str) -> "Floats":
    """Three numbers.

    Raises
    ------
    ParameterError
        If a value is something else.
    """
    try:
        found = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.shape != (3,) or not np.isfinite(found).all():
        msg = f"{name} is {shown(value)}, expected three numbers"
        raise ParameterError(msg)
    return found


def direction(value: object, name: str) -> "Floats":
    """Return a unit vector; refuse one without a length."""
    found = vector(value, name)
    length = float(np.linalg.norm(found))
    if length < 1e-9:
        msg = f"{name} has no length, expected a direction"
        raise ParameterError(msg)
    return found / length


def longest(points: "Floats", normal: "Floats") -> "Floats":
    """Direction in the plane in which points extend most; strays count little."""
    way = points - np.median(points, axis=0)
    way = way - np.outer(way @ normal, normal)
    away = np.linalg.norm(way, axis=1)
    inner = way[away <= np.percentile(away, 98)]
    _, _, axes = np.linalg.svd(inner, full_matrices=False)
    best: Floats = axes[0]
    return best if best[np.argmax(np.abs(best))] > 0.0 else -best


def in_bins(points: "Floats") -> "tuple[Ints, Floats]":
    """Bins (n,) along the object that points (n, 2) are in, and the bins' ends."""
    low, high = np.percentile(points[:, 1], [0.5, 99.5])
    n_bins = int(np.clip(len(points) / LEAST, 1, BINS))
    place = np.clip((points[:, 1] - low) / max(high - low, 1e-300) * n_bins, 0, n_bins - 1)
    return place.astype(np.intp), np.linspace(low, high, n_bins + 1)


def running_median(values: "Floats", size: int) -> "Floats":
    """Median of every value and its neighbours; ``size`` is odd."""
    padded = np.pad(values, size // 2, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, size)
    medians: Floats = np.median(windows, axis=1)
    return medians


def check_walls(points: "Floats", interval: float) -> None:
    """Refuse sections that are empty, one-sided or full somewhere: their middle is no axis.

    Between two walls there is a gap in u. It is gone where one of them is, and where something
    stands between them.

    Raises
    ------
    ParameterError
        If the gap is gone for longer than walls are carried on over it.
    """
    place, ends = in_bins(points)
    gap, across = np.zeros(ends.size - 1), [np.zeros(0)] * (ends.size - 1)
    for b in np.unique(place):
        across[b] = np.sort(points[place == b, 0])
        gap[b] = np.diff(across[b]).max(initial=0.0)
    usual = running_median(gap, gap.size // 4 * 2 + 1)
    bands = np.array([bands_of(u, BROKEN * least) for u, least in zip(across, usual, strict=True)])
    for is_wrong, found in (
        (gap < BROKEN * usual, "no two walls with nothing between them"),
        (bands > 2, "more than two bands of points beside each other"),
    ):
        wrong = np.flatnonzero(is_wrong)
        runs = np.split(wrong, np.flatnonzero(np.diff(wrong) > 1) + 1)
        for run in runs if wrong.size else []:
            first, last = float(ends[run[0]]), float(ends[run[-1] + 1])
            if last - first > LONG * interval:
                msg = (
                    f"the section has {found} from {first:,.2f} to {last:,.2f} along it, seen from "
                    "point: expected both walls and nothing else, or a cut in two parts"
                )
                raise ParameterError(msg)


def check_result(
    points: "Floats", main: LineString, auxiliary: LineString, interval: float
) -> None:
    """Refuse walls that cross, or that have too few of the section's points beside them.

    Raises
    ------
    ParameterError
        If they do, or more than strays and clutter are farther off than an interval.
    """
    ring = shapely.Polygon([*main.coords, *auxiliary.coords[::-1]])
    if not ring.is_valid:
        msg = (
            f"the walls of the section cross ({shapely.is_valid_reason(ring)} in u and v): "
            "expected more points, a larger interval, or a cut in parts"
        )
        raise ParameterError(msg)
    where = shapely.points(points)
    away = np.minimum(shapely.distance(main, where), shapely.distance(auxiliary, where))
    share = float((away > interval).mean())
    if share > OTHERS:
        msg = (
            f"{share:.0%} of the section's points lie on neither of two walls, expected at most "
            f"{OTHERS:.0%}: a cut in parts, a larger thickness, or fewer things between the walls"
        )
        raise ParameterError(msg)


def bands_of(u: "Floats", gap: float) -> int:
    """How many bands values in order make, of a tenth of them at least, with such gaps between."""
    sizes = [len(band) for band in np.split(u, np.flatnonzero(np.diff(u) > gap) + 1)]
    return sum(size >= max(BAND * u.size, LEAST_OF_BAND) for size in sizes)


def below_middle(points: "Floats") -> "Bools":
    """Which points (n, 2) have a lesser u than the middle at their v."""
    place, ends = in_bins(points)
    middle = np.full(ends.size - 1, np.nan)
    for b in range(middle.size):
        u = np.sort(points[place == b, 0])
        if u.size >= 4:
            cut = int(STRAY * u.size)
            middle[b] = (u[cut] + u[u.size - 1 - cut]) / 2.0
    known = np.flatnonzero(np.isfinite(middle))
    middle = np.interp(np.arange(middle.size), known, middle[known])
    below: Bools = points[:, 0] < running_median(middle, SMOOTH)[place]
    return below
