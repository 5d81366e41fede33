"""The curve of minimal radii, faithful to the paper."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from shapely import LineString

from midrib.curves.averaging import Mean
from midrib.curves.construction import Centring, Construction, Holes
from midrib.curves.joining import Channel, EndRule
from midrib.curves.radii import EndClearance, jumps_of
from midrib.curves.stations import Skip
from midrib.ragged import without_holes
from midrib.strip import Strip, check_strip

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from midrib.curves.joining import Path
    from midrib.curves.radii import Radii
    from midrib.types import Floats

__all__ = ["Curve", "minimal_radii"]


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve of minimal radii and the radii it was made from.

    The arrays have one row for each radius, in order of travel; a station whose radii tie has
    several. Stations without a radius are not in them, see ``gaps``.
    """

    strip: Strip
    _radii: "Radii"
    _path: "Path"

    @cached_property
    def line(self) -> LineString:
        """The curve, one line without branches, covered by the area."""
        points, height = self._path.points, self._path.height
        return LineString(points if height is None else np.column_stack([points, height]))

    @property
    def stations(self) -> "Floats":
        """(n,) arc length of each P along the main curve."""
        return self._radii.stations[self._radii.station]

    @property
    def on_main(self) -> "Floats":
        """(n, 2) the points P."""
        return self._radii.points[:, :2]

    @property
    def on_auxiliary(self) -> "Floats":
        """(n, 2) the points Q, nearest to P of the auxiliary curve's points that P sees."""
        return self._radii.points[:, 2:4]

    @property
    def points(self) -> "Floats":
        """(n, 2) the points S halfway between P and Q, or equally far from both curves."""
        return self._path.middles

    @property
    def radii(self) -> "Floats":
        """(n,) the minimal radii, lengths of PQ."""
        return self._radii.points[:, 5]

    @cached_property
    def gaps(self) -> "Floats":
        """(k, 2) first and last of each run of stations that see nothing of the auxiliary curve."""
        blind = np.ones(self._radii.stations.size + 2, dtype=np.bool_)
        blind[0] = blind[-1] = False
        blind[1 + self._radii.station] = False
        turn = np.flatnonzero(np.diff(blind.astype(np.int8)))
        return self._radii.stations[np.column_stack([turn[::2], turn[1::2] - 1])]

    @cached_property
    def jumps(self) -> "Floats":
        """(k,) stations at which Q jumps, to within the distance of two stations."""
        return jumps_of(self._radii)

    @property
    def bays(self) -> "Floats":
        """(k,) stations left out because they lie in bays of the main curve (``skip="bays"``)."""
        return self._radii.bays

    @property
    def loops_cut(self) -> int:
        """Number of loops that were cut to make the line simple."""
        return self._path.loops

    def __repr__(self) -> str:
        """Show what there is of it."""
        return (
            f"<Curve: {self.radii.size} radii, {len(self.gaps)} gaps, {self.jumps.size} jumps, "
            f"{self.loops_cut} loops cut>"
        )


def minimal_radii(
    strip: Strip,
    *,
    spacing: float | None = None,
    count: int | None = None,
    percent: float | None = None,
    vertices: bool | None = None,
    tolerance: float | str | None = None,
    stations: "ArrayLike | None" = None,
    skip: Skip | None = None,
    ends: EndRule = "main",
    end_clearance: EndClearance = "proportional",
    centring: Centring = "none",
    mean: Mean | None = None,
    holes: Holes = "blocked",
    channel: Channel = "shorter",
) -> Curve:
    """Curve of minimal radii of a strip.

    From each station P on the main curve goes the shortest segment inside the area to a point Q
    of the auxiliary curve; the curve joins the middles of these segments. Between parallel banks
    it is the centre line.

    Parameters
    ----------
    strip : Strip
        Area, main and auxiliary curve; ``midrib.split`` proposes one.
    spacing : float, optional
        Interval of the stations from the start of the main curve, in coordinate units.
    count : int, optional
        The interval is the main curve's length over ``count`` (Eq. 1).
    percent : float, optional
        The interval is so many percent of the main curve's length (Eq. 1).
    vertices : bool, optional
        The vertices of the main curve are stations too, as the paper recommends: True unless
        the curve is ``"centred"``, which needs no station at every vertex.
    tolerance : float or str, optional
        How far the curve may be from what it stands for: a length in coordinate units, or a share
        of the mean width as text, ``"1%"``. If centred, between its points from the line on which
        both curves are equally far, a 100th of the mean width unless given; at 0 straight
        stretches are exact, with their kinks as vertices, and arcs of parabolas, behind vertices
        of the boundary, within a 10,000th of the width. Otherwise from the limit curve, which the
        chain of middles becomes as the interval of stations goes to 0, and the limit curve from
        it: the tolerance then chooses the stations, as few as it can do with, and excludes every
        other way to choose them. At 0 every event is a vertex: where Q turns from one segment to
        the next, ties, comes in view or is lost. ``points`` are that chain; ``line`` is what is
        left of it without loops.
    stations : array_like of float, optional
        Arc lengths along the main curve to use as well; with ``vertices=False`` only these.
    skip : {"bays"}, int, slice, Polygon, function or list of them, optional
        Stations to drop. ``"bays"``: those in bays and side arms of the main curve, by the rule of
        lopsided radii, see the notes; ``bays`` of the result lists them. Others: by index; by
        ``slice`` of indices, or of arc lengths where its bounds are floats; those whose P lies in a
        Polygon; those for which a function of stations (n,) and points (n, 2) returns True.
    ends : {"main", "caps", "radii"}, pair of points or None, default "main"
        How the curve ends (section 4): at the ends of the main curve; halfway between
        corresponding ends of the two curves; at the middles of the radii at the main curve's ends
        to segments apart from them; at points of yours; or with its first and last middle.
    end_clearance : {"proportional", "station"}, float or None, default "proportional"
        Keeps radii from collapsing into an end that both curves share. While they would, Q is at
        least as far from that end along the auxiliary curve as P is along the main one
        ("station"), or in proportion to the lengths of their first straight runs ("proportional");
        a length keeps Q that far from it at every station.
    centring : {"none", "symmetric", "centred"}, default "none"
        "none": the paper's curve. "symmetric": the mean of the curve from the main and the curve
        from the auxiliary curve. "centred": S is moved along its radius until both curves are
        equally far, and points are added in between within ``tolerance``: the trunk of the
        medial axis between the two ends.
    mean : {"radii", "proportional", "kinks", "same-height"} or (dx, dy), optional
        Which points are averaged for "symmetric": those of radii that cut off as much of the two
        curves together ("radii", the default); in equal shares of the two lengths
        ("proportional"); of the two sides themselves, in equal shares between kinks of both that
        are paired in order ("kinks", Rhino's mean curve); at the same height along the strip, or
        along a direction (dx, dy).
    holes : {"blocked", "auxiliary", "ignored"}, default "blocked"
        What the area's holes, its islands, are. "blocked": in the way: no radius crosses one, and
        the curve goes round it. "auxiliary": parts of the auxiliary curve too: radii end on them,
        and the curve stays between the main curve and them. "ignored": nothing: the curve is that
        of the area without holes, which it may cross; it is covered by that area, and ``strip`` of
        the result is without holes.
    channel : {"shorter", "wider"}, default "shorter"
        On which side a centred curve passes each island that is "blocked". "shorter": where the
        shortest way from each radius to the next does, which is not always the shortest from end
        to end. "wider": through the channels whose narrowest place is widest, over all ways from
        end to end.

    Returns
    -------
    Curve
        ``line``, and for each radius ``stations``, ``on_main`` (P), ``on_auxiliary`` (Q),
        ``points`` (S) and ``radii``. Without any of spacing, count, percent and stations the
        interval is L / count for the smallest count that makes it at most the mean width,
        but for no more than 256 stations and four for each vertex.

    Raises
    ------
    GeometryTypeError
        If ``strip`` is not a Strip.
    ParameterError
        If an option has a value it cannot have.
    InvalidAreaError
        If no station sees the auxiliary curve.

    Notes
    -----
    1. Triangulate the area. 2. For each P find the nearest point of the auxiliary curve in a tree
    of boxes; if the segment to it is not free, look out through the triangles for the nearest
    visible one. 3. Join the middles by shortest paths inside the area. 4. Cut loops, which only
    come up where Q travels back or the area has holes.
    With a tolerance P looks from whole segments: 2. Windows that are open for an interval of
    stations offer moving points, of which the lower envelope is Q; 3. knots that the tolerance
    does not need are left out, a way at a time that is free and near all that it replaces.
    Arcs of hyperbolas, behind vertices that a sight grazes, become chords within the tolerance,
    but not within less than 1/16384 of the mean width. What is seen from one station and from none
    next to it does not count.
    Nearly linear in vertices and stations. Signs are exact, so the line never leaves the area; S
    is halfway between P and Q, and as far from the main as from the auxiliary curve only where
    the main curve is straight and parallel. A sight along a wall ends where a hole touches it.

    A radius is lopsided if Q sees the main curve nearer than P by a factor of 1.5: whatever the
    scale, P is then so far back that the middle of PQ is not between the banks. Stations with such
    a radius are in a bay.

    With ``holes="auxiliary"`` the auxiliary curve crosses to each island from the vertex next to
    where the channel is narrowest, goes round it and comes back; arc lengths count the way round,
    not the crossing.
    ``channel="wider"`` closes channels, the narrowest first, as long as one way is left. So its
    curve passes each island once, on one side.

    References
    ----------
    Buczek, Area collapse algorithm computing new curve of 2D geometric objects, Geodesy and
    Cartography 66(1), 2017, 23-44, sections 3 and 4.

    Examples
    --------
    >>> curve = minimal_radii(split(box(0, 0, 9, 2)), ends="caps", count=3)
    >>> curve.line.wkt
    'LINESTRING (0 1, 3 1, 6 1, 9 1)'
    >>> curve.radii
    array([2., 2., 2., 2.])
    """
    check_strip(strip)
    construction = Construction(
        spacing=spacing,
        count=count,
        percent=percent,
        vertices=vertices,
        tolerance=tolerance,
        stations=stations,
        skip=skip,
        ends=ends,
        end_clearance=end_clearance,
        centring=centring,
        mean=mean,
        holes=holes,
        channel=channel,
    )
    if holes == "ignored" and strip.area.interiors:
        strip = Strip(strip.main, strip.auxiliary, without_holes(strip.area))
    return Curve(strip, *construction.of(strip.layout))
