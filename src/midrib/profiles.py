"""Profiles: the width of an area, and the distances to its two banks, along a line.

                 left bank
    ------------------+--------------
                      |  to left
    .....S............+..............  line, in its direction
                      |  to right
    ------------------+--------------
                 right bank

The banks are the two curves that the area's boundary is divided into; caps and holes belong to
neither. The width counts all of the boundary, as in ``measures``.
"""

import struct
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely
from shapely import LineString, MultiLineString, Polygon

from midrib import interrupts
from midrib.checks import is_number, shown
from midrib.curves.collapse import collapse
from midrib.curves.log import Log
from midrib.curves.parts import filled_parts, valid_parts
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError
from midrib.geodesy import degree_lengths
from midrib.kernels.clearance import clearances
from midrib.measures import chains
from midrib.measures.widths import widths
from midrib.ragged import rings_of_area
from midrib.strip import PLANE, Strip, divide, split

if TYPE_CHECKING:
    from midrib.layout import Scale
    from midrib.types import Floats

    Geometries = np.ndarray[tuple[int], np.dtype[np.object_]]

__all__ = ["Profile", "add_widths", "profile", "profiles_of", "with_m"]

WHOLE = 2.0**-40  # a length is a whole number of intervals to within this share
MOST_STATIONS = 50_000_000
# Codes of OGC 06-103r4, which ISO WKB shares: a LineString is 2, a MultiLineString 5.
LINE, LINES, HAS_Z, HAS_M = 2, 5, 1000, 2000
LITTLE_ENDIAN = 1


class Profile(NamedTuple):
    """Widths along a line; one row for each station, in order of travel."""

    stations: "Floats"  # (n,) arc lengths along the line
    points: "Floats"  # (n, 2), or (n, 3) where the line has Z
    width: "Floats"  # (n,) twice the distance to the boundary, holes and caps included
    to_left: "Floats"  # (n,) distance to the bank on the left, in the line's direction
    to_right: "Floats"  # (n,) distance to the bank on the right


def profile(
    line: LineString,
    strip: Strip | Polygon,
    *,
    spacing: float | None = None,
    geographic: bool = False,
) -> Profile:
    """Width of an area and distances to its banks at stations along a line.

    On a line in the middle the two distances are equal, and each is half the width.

    Parameters
    ----------
    line : LineString
        Usually inside the area. Z is carried along.
    strip : Strip or Polygon
        The area and its two banks; a Polygon is divided as by ``midrib.split``.
    spacing : float, optional
        Interval of the stations from the start of the line, in coordinate units, in metres if
        ``geographic``; the end of the line is the last station in any case. Without it the
        stations are the line's vertices.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude, as in ``measures``.

    Returns
    -------
    Profile
        ``stations``, ``points``, ``width``, ``to_left`` and ``to_right``, each with n rows; lengths
        in coordinate units, in metres if ``geographic``.

    Raises
    ------
    GeometryTypeError
        If ``line`` is not a LineString, or ``strip`` neither a Strip nor a Polygon.
    InvalidAreaError
        If the area cannot be divided, or the line is empty.
    ParameterError
        If ``spacing`` is not a positive number, or asks for absurdly many stations.

    Notes
    -----
    Left and right are those of a traveller along the line. The distance to a bank is that to its
    nearest point, straight, whatever lies between: holes, or another reach of a winding area. So
    the smaller of the two is half the width, unless a hole or a cap is nearer. O((n + m) log m)
    for m boundary vertices.

    Examples
    --------
    >>> rows = profile(LineString([(0, 1), (9, 1)]), box(0, 0, 9, 3), spacing=4)
    >>> rows.stations
    array([0., 4., 8., 9.])
    >>> rows.to_left, rows.to_right
    (array([2., 2., 2., 2.]), array([1., 1., 1., 1.]))
    """
    if not isinstance(line, LineString):
        kind = getattr(line, "geom_type", type(line).__name__)
        msg = f"line is a {kind}, expected a LineString"
        raise GeometryTypeError(msg)
    if line.is_empty:
        msg = "line is empty, expected a line along the area"
        raise InvalidAreaError(msg)
    if not isinstance(strip, Strip):
        strip = split(strip)
    stations, points = stations_along(line, spacing, geographic)
    scale = degree_lengths(np.array(strip.area.bounds)) if geographic else PLANE
    one_line = np.zeros(stations.size, dtype=np.intp)
    at_stations = chains.Chains(points[:, :2], one_line, one_line[1:] == 0)
    across = widths(at_stations, object_array([strip.area]), geographic)
    left, right = banks(line, strip)
    return Profile(
        stations,
        points,
        across,
        distances(points, left, scale),
        distances(points, right, scale),
    )


def stations_along(
    line: LineString, spacing: float | None, geographic: bool
) -> tuple["Floats", "Floats"]:
    """Arc lengths along a line, and the points there."""
    points = shapely.get_coordinates(line, include_z=line.has_z)
    steps = np.hypot(*chains.step_vectors(points[:, :2], geographic).T)
    arc: Floats = np.concatenate([[0.0], np.cumsum(steps)])
    if spacing is None:
        return arc, points
    if not is_number(spacing) or not 0.0 < spacing < np.inf:
        msg = f"spacing is {shown(spacing)}, expected a positive number"
        raise ParameterError(msg)
    count = arc[-1] / spacing
    if count > MOST_STATIONS:
        msg = f"a spacing of {spacing:g} asks for {count:.3g} stations, expected fewer"
        raise ParameterError(msg)
    whole: Floats = np.arange(int(np.ceil(count * (1.0 - WHOLE))), dtype=np.float64)
    stations: Floats = np.append(whole * float(spacing), arc[-1])
    return stations, np.column_stack([np.interp(stations, arc, row) for row in points.T])


def banks(line: LineString, strip: Strip) -> tuple[LineString, LineString]:
    """Return the curves on the left and on the right of a line through a strip."""
    main, auxiliary = (shapely.get_coordinates(c) for c in (strip.main, strip.auxiliary))
    turns_left = shapely.is_ccw(shapely.linearrings(np.concatenate([main, auxiliary[::-1]])))
    # Where both ends are beside one vertex of the one curve, the other tells.
    curves, ends = (
        np.array([[strip.main], [strip.auxiliary]]),
        shapely.points(line.coords[0:1] + line.coords[-1:]),
    )
    ahead = np.diff(shapely.line_locate_point(curves, ends, normalized=True), axis=1).sum()
    if turns_left == (ahead >= 0.0):
        return strip.auxiliary, strip.main
    return strip.main, strip.auxiliary


def distances(points: "Floats", chain: LineString, scale: "Scale") -> "Floats":
    """Distance of each point to a chain."""
    x, y = (points[:, :2] * scale).T.copy()
    chain_x, chain_y = (shapely.get_coordinates(chain) * scale).T.copy()
    goes_on = np.ones(chain_x.size, dtype=np.bool_)
    return clearances(
        x, y, np.array([0, x.size]), chain_x, chain_y, goes_on, np.array([0, chain_x.size])
    )


def object_array(items: list[Any]) -> "Geometries":
    """Geometries as an array."""
    array = np.empty(len(items), dtype=object)
    array[:] = items
    return array


class PartProfile(NamedTuple):
    """The profile of one part of an area."""

    area: int  # its position
    part: int  # of a MultiPolygon, else 0
    profile: Profile


def profiles_of(
    areas: "Geometries",
    method: str,
    log: Log,
    *,
    along: "Geometries | None" = None,
    spacing: float | None = None,
    geographic: bool = False,
    **options: Any,
) -> Iterator[PartProfile]:
    """Profile along the line of each area, part by part; refusals go to the log.

    The line is that of ``collapse``, whose method and options these are. Holes that it ignores do
    not bound the widths either.
    """
    parts = list(valid_parts(areas, log))
    if options.get("holes") == "ignored":
        parts = filled_parts(parts)
    guides = object_array([None if along is None else along[part.area] for part in parts])
    lines, problems = collapse(
        object_array([part.polygon for part in parts]),
        method,
        on_error="report",
        along=guides,
        geographic=geographic,
        **options,
    )
    for problem in problems:
        part = parts[problem.index]
        if problem.status == "refused":
            log.refuse(part.area, part.number, InvalidAreaError(problem.reason))
    for part, guide, line in zip(parts, guides, lines, strict=True):
        interrupts.check()
        if line is None:
            continue
        scale = degree_lengths(np.array(part.polygon.bounds)) if geographic else PLANE
        layout = divide(*rings_of_area(part.polygon), scale, along=guide)
        strip = Strip._of_layout(layout, part.polygon)
        found = profile(line, strip, spacing=spacing, geographic=geographic)
        yield PartProfile(part.area, part.number, found)


def add_widths(lines: Any, areas: Any, *, geographic: bool = False) -> Any:
    """Lines with the width of their areas as the M values of their vertices.

    Parameters
    ----------
    lines : LineString or MultiLineString, array_like of them or GeoSeries, shape (...)
        Z is kept; M values that are there already are replaced.
    areas : Polygon or MultiPolygon, or array_like of them, shape (...)
        Broadcast against ``lines``.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude, as in ``measures``.

    Returns
    -------
    LineString or MultiLineString; object array; GeoSeries
        As ``lines``. M is twice the distance to the boundary (``measures.width``), in coordinate
        units, in metres if ``geographic``; lines that are missing or empty, or have no area, stay
        what they are.

    Raises
    ------
    GeometryTypeError
        If something is not a line, or not an area.

    Examples
    --------
    >>> add_widths(LineString([(0, 1), (1, 1), (9, 1)]), box(0, 0, 9, 2)).wkt
    'LINESTRING M (0 1 0, 1 1 2, 9 1 0)'
    """
    flat_lines, flat_areas, like = chains.flat_together(
        chains.lines_of(lines, "lines"), chains.areas_of(areas, "areas")
    )
    is_whole = chains.is_there(flat_lines) & chains.is_there(flat_areas)
    measured = flat_lines.copy()
    vertices = chains.vertices(flat_lines)
    across = widths(vertices, flat_areas, geographic)
    first = np.searchsorted(vertices.owner, np.arange(flat_lines.size + 1))
    for i in np.flatnonzero(is_whole):
        measured[i] = with_m(flat_lines[i], across[first[i] : first[i + 1]])
    if hasattr(lines, "crs") and hasattr(lines, "index"):
        return type(lines)(measured, index=lines.index, crs=lines.crs)
    return measured.reshape(like.shape) if like.ndim else measured[0]


def with_m(line: LineString | MultiLineString, values: "Floats") -> Any:
    """Return a line with an M value for each vertex, by way of WKB: nothing else builds it."""
    dimensions = HAS_M + HAS_Z * line.has_z
    rows = np.column_stack([shapely.get_coordinates(line, include_z=line.has_z), values])
    pieces = shapely.get_parts(line)
    stops = np.cumsum(shapely.get_num_coordinates(pieces))[:-1]
    bodies = [
        struct.pack("<BII", LITTLE_ENDIAN, LINE + dimensions, len(piece)) + piece.tobytes()
        for piece in np.split(rows.astype("<f8"), stops)
    ]
    if isinstance(line, LineString):
        return shapely.from_wkb(bodies[0])
    head = struct.pack("<BII", LITTLE_ENDIAN, LINES + dimensions, len(bodies))
    return shapely.from_wkb(head + b"".join(bodies))
