"""Areas in, one branchless line each out."""

from operator import is_
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import shapely
from shapely import LineString, MultiLineString, MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from midrib import interrupts
from midrib.checks import check_flag
from midrib.curves.aftercare import Aftercare, aftercare, tend
from midrib.curves.connecting import make_joints, plan_joints, straightened
from midrib.curves.finding import Finder
from midrib.curves.lines import is_usual, lines_at_once, lines_of
from midrib.curves.log import Log, check_on_error
from midrib.curves.methods import finder_of
from midrib.curves.parts import Part, filled_parts, polygons_of, refused_parts, valid_parts
from midrib.curves.taking import as_array, take
from midrib.curves.usual import line_of_one, threads_to_use
from midrib.errors import (
    ParameterError,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Areas = NDArray[np.object_]

__all__ = ["check_connect", "collapse", "lines_of_parts"]


def collapse(
    areas: Any,
    method: str = "minimal-radii",
    *,
    on_error: Literal["raise", "report"] = "raise",
    along: Any = None,
    geographic: bool | None = None,
    connect: bool = False,
    simplify: float | str | None = None,
    smooth: bool = False,
    threads: int | None = None,
    **options: Any,
) -> Any:
    """Collapse areas to lines: one line without branches inside each.

    Parameters
    ----------
    areas : Polygon, MultiPolygon, array_like of them, GeoSeries or GeoDataFrame
        None and empty areas stay what they are. Z is carried along.
    method : str, default "minimal-radii"
        One of ``midrib.methods()``.
    on_error : {"raise", "report"}, default "raise"
        ``"report"`` returns ``(lines, problems)``: an area that is refused gives None and a row of
        ``problems`` that says why; repaired areas, lines that lost loops and those for which
        stations in bays were left out (how many) get a row too.
    along : LineString or array_like of them, optional
        Directional polylines, one for each area or None: the main curve is the part of the
        boundary beside it, see ``midrib.split``.
    geographic : bool, optional
        Whether coordinates are degrees of longitude and latitude. Lengths are then in metres; the
        line is constructed in a plane that is true to scale at the area's middle latitude. Taken
        from the CRS of a GeoSeries, otherwise False.
    connect : bool, default False
        Whether the lines of areas that share an edge meet: in its middle if it is at an end of
        both, else the line of the one goes on to the line of the other. See the notes.
    simplify : float or str, optional
        Leave out vertices as long as the line stays within this distance of the full one: a
        length in coordinate units, in metres if geographic; or text, a share of the mean width
        (the area over the line's length): ``"5%"``.
    smooth : bool, default False
        Cut the line's corners, in three rounds; after simplification. Of a line with many vertices
        it takes only a little: give ``simplify`` too for wide bows.
    threads : int, optional
        How many of them share the work, unless options ask for something unusual; as many as
        there are processors to use if it is not given. Lines are the same, bit by bit.
    **options
        Those of ``midrib.minimal_radii``. Unless you say otherwise ``ends`` is ``"caps"``,
        ``centring`` is ``"centred"`` and, only with that, ``end_clearance`` None; with
        ``centring="none"`` ``skip`` is ``"bays"``, unless a ``tolerance`` chooses the stations.

    Returns
    -------
    LineString or MultiLineString; object array; GeoSeries
        As ``areas`` is one area, an array (same shape) or a GeoSeries (index and CRS kept). A
        MultiPolygon gives a MultiLineString, part by part; parts that are refused are left out. A
        Polygon gives one only if its repair has made several of it.

    Raises
    ------
    GeometryTypeError
        If something is not an area.
    InvalidAreaError
        If an area is not valid and the repair is not certain.
    ParameterError
        If an option is unknown or has a value it cannot have.

    Notes
    -----
    The two ends come from the area's shape (``midrib.split``), the line from the radii between
    the two sides (``midrib.minimal_radii``), a mean width apart, and from probes in between that
    move it to where both sides are equally far. Every line is covered by its area, exactly, or by
    the repaired area where one was repaired; with ``holes="ignored"`` by the area without its
    holes. So are simplified and smoothed lines, which keep their
    ends and do not meet themselves: where a shorter way would leave the area, the vertices stay.

    With ``connect`` an area begins and ends at the shared edges that are at the ends its shape
    proposes: an edge that covers half a flat end or is half on it, or is within half a width of
    another end; unless the area reaches less than half as far from it as it is long. It also looks
    at edges within a width of its ends (three, if across) that are ends of its neighbours. Of
    several it takes those that are wide and far apart, but not an end together with the bank that
    leads up to it. Lines then meet in the same vertex, bit by bit, and turn there as the areas do:
    by 80 degrees and more where these meet at a corner or in an acute tip. The vertex is on the
    edge but for rounding, so that lines are covered by the areas of both. They are simplified and
    smoothed as far as the edges, and keep their joints. A line goes on into a neighbour for at most
    eight of its widths. ``"report"`` adds a ``Joint`` for each shared edge, with the reason where
    there is none. Edges are shared where boundaries are not farther apart than their coordinates
    are rounded.

    Examples
    --------
    >>> collapse(box(0, 0, 9, 2)).length
    9.0
    >>> collapse([box(0, 0, 6, 2), None])
    array([<LINESTRING (0 1, 2 1, 4 1, 6 1)>, None], dtype=object)
    """
    given = (method, on_error, along, geographic, connect, simplify, smooth, threads)
    if isinstance(areas, Polygon) and not options and all(map(is_, given, DEFAULTS)):
        line = line_of_one(areas)
        if line is not None:
            return line
    check_on_error(on_error)
    check_connect(connect, along, options.get("ends", "caps"))
    find, care = finder_of(method, **options), aftercare(simplify, smooth)
    taken, threads = take(areas, geographic), threads_to_use(threads)
    log = Log(taken.labels, strict=on_error == "raise")
    with interrupts.deferred():
        flat = taken.array.ravel()
        along = guides(along, flat.size)
        lines = collapse_all(
            flat, find, along, taken.geographic, log, care, threads,
            connect=connect, fills=options.get("holes") == "ignored",
        )  # fmt: skip
    result = taken.given_back(lines)
    return result if on_error == "raise" else (result, log.problems)


# What ``collapse`` takes if nothing is given; to be told by identity, as arrays do not compare.
DEFAULTS = (*(collapse.__defaults__ or ()), *(collapse.__kwdefaults__ or {}).values())


def check_connect(connect: Any, along: Any, ends: Any) -> None:
    """Refuse other options that place ends beside ``connect``."""
    check_flag(connect, "connect")
    if connect and (along is not None or not isinstance(ends, str) or ends != "caps"):
        msg = "connect places the ends of lines, give it without along and ends"
        raise ParameterError(msg)


def guides(along: Any, count: int) -> "Areas | None":
    """Directional polylines, one for each area."""
    if along is None:
        return None
    flat = as_array(along).ravel()
    if flat.size not in (1, count):
        msg = f"along has {flat.size} lines for {count} areas, expected one each"
        raise ParameterError(msg)
    return np.broadcast_to(flat, (count,))


def collapse_all(
    areas: "Areas",
    find: Finder,
    along: "Areas | None",
    geographic: bool,
    log: Log,
    care: Aftercare,
    threads: int,
    *,
    connect: bool,
    fills: bool,
) -> "Areas":
    """Lines of a flat array of areas."""
    lines: Areas = np.full(areas.size, None, dtype=object)
    if is_usual(find) and along is None and not (connect or fills or care.is_wanted):
        lines = lines_at_once(areas, geographic, threads)
    is_open = shapely.is_missing(lines)
    areas = areas.copy()
    areas[~is_open] = None
    parts = filled_parts(valid_parts(areas, log)) if fills else list(valid_parts(areas, log))
    found: dict[int, list[LineString]] = {}
    tended = lines_of_parts(
        parts, areas, find, along, geographic, log, care, threads, connect=connect
    )
    for part, line in zip(parts, tended, strict=True):
        if line is not None:
            found.setdefault(part.area, []).append(line)
    for i in np.flatnonzero(is_open).tolist():
        pieces = found.get(i)
        if pieces is None:
            lines[i] = empty_like(areas[i])
            continue
        is_multi = isinstance(areas[i], MultiPolygon) or len(pieces) > 1
        lines[i] = MultiLineString(pieces) if is_multi else pieces[0]
    return lines


def lines_of_parts(
    parts: list[Part],
    areas: "Areas",
    find: Finder,
    along: "Areas | None",
    geographic: bool,
    log: Log,
    care: Aftercare,
    threads: int = 1,
    *,
    connect: bool,
) -> list[LineString | None]:
    """Return the line of each part after its care, None where it was refused."""
    if connect:
        return connected_lines(parts, areas, find, geographic, log, care)
    lines = lines_of(parts, find, along, geographic, log, threads)
    return tend(lines, [part.polygon for part in parts], care, geographic=geographic)


def empty_like(area: Any) -> LineString | None:
    """Return the line of an area that has none yet: an empty one for an empty area, else None."""
    return LineString() if isinstance(area, BaseGeometry) and area.is_empty else None


def connected_lines(
    parts: list[Part],
    areas: "Areas",
    find: Finder,
    geographic: bool,
    log: Log,
    care: Aftercare,
) -> list[LineString | None]:
    """Return the line of each part, None where it was refused; lines of neighbours meet.

    After-care comes before joints: it keeps ends, and ways to other lines start there.
    """
    every = [*parts, *refused_parts(areas, log.refused - {part[:2] for part in parts})]
    plan = plan_joints(polygons_of(every), len(parts), geographic=geographic)
    prepared = [p._replace(polygon=area) for p, area in zip(parts, plan.areas, strict=False)]
    lines = straightened(plan, lines_of(prepared, find, None, geographic, log, joints=plan.ends))
    lines = tend(lines, [part.polygon for part in prepared], care, geographic=geographic)
    lines, joined = make_joints(plan, lines)
    for row in joined:
        log.join(row, *(every[i] for i in row.areas))
    return lines
