"""Areas in, one branchless line each out."""

import sys
import warnings
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from operator import is_
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import shapely
from shapely import LineString, MultiLineString, MultiPolygon, Point, Polygon
from shapely.geometry.base import BaseGeometry

from midrib import interrupts
from midrib.checks import check_flag, shown
from midrib.curves.aftercare import Aftercare, aftercare, tend
from midrib.curves.connecting import Joined, make_joints, plan_joints, straightened
from midrib.curves.finding import Finder
from midrib.curves.lines import Part, lines_of, polygons_of
from midrib.curves.methods import finder_of
from midrib.curves.taking import as_array, take
from midrib.curves.usual import line_of_one, threads_to_use
from midrib.errors import (
    GeometryTypeError,
    InvalidAreaError,
    MidribError,
    ParameterError,
    RepairedAreaWarning,
    TooManyStationsError,
)
from midrib.ragged import without_holes
from midrib.repair import overlaps, repaired
from midrib.validity import is_valid

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Areas = NDArray[np.object_]

__all__ = ["Joint", "Problem", "collapse"]


@dataclass(frozen=True)
class Problem:
    """What there is to say about an area: refused, repaired, loops cut, bays left out, uncut."""

    index: Any  # position of the area, or its label in a GeoSeries
    part: int  # of a MultiPolygon, else 0
    status: Literal[
        "refused", "repaired", "loops cut", "bays left out", "joint", "no joint", "uncut"
    ]
    reason: str


@dataclass(frozen=True)
class Joint(Problem):
    """What has become of an edge that two areas share: a joint of their lines, or none."""

    other: Any  # the second area, as ``index``
    other_part: int
    point: Point  # where the lines meet, or the middle of the edge
    kind: Literal["end to end", "side", "none"]  # side: the line of ``index`` ends on the other's


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


def check_on_error(on_error: Any) -> None:
    """Refuse what is no way to tell of areas that are refused."""
    if not isinstance(on_error, str) or on_error not in ("raise", "report"):
        msg = f"on_error is {shown(on_error)}, expected 'raise' or 'report'"
        raise ParameterError(msg)


def check_connect(connect: Any, along: Any, ends: Any) -> None:
    """Refuse other options that place ends beside ``connect``."""
    check_flag(connect, "connect")
    if connect and (along is not None or not isinstance(ends, str) or ends != "caps"):
        msg = "connect places the ends of lines, give it without along and ends"
        raise ParameterError(msg)


def steps_to_caller() -> int:
    """How many calls up the one is that has called midrib, for a warning to name its line."""
    steps, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals["__name__"].split(".")[0] == "midrib":
        steps, frame = steps + 1, frame.f_back
    return steps


class Log:
    """What went wrong where; a strict one raises at the first refusal, any at absurd options."""

    def __init__(self, labels: Sequence[Any] | None, *, strict: bool) -> None:
        self.problems: list[Problem] = []
        self.labels, self.strict = labels, strict
        self.refused: set[tuple[int, int]] = set()  # areas by position, and parts

    def label(self, index: int) -> Any:
        """Name of an area: its label in a GeoSeries, else its position."""
        return index if self.labels is None else self.labels[index]

    def refuse(self, index: int, part: int, error: MidribError) -> None:
        """Record that an area (part) has no line, and why."""
        if self.strict or isinstance(error, TooManyStationsError):
            raise type(error)(self.sentence(index, part, str(error))) from error
        self.refused.add((index, part))
        self.problems.append(Problem(self.label(index), part, "refused", str(error)))

    def note(
        self,
        index: int,
        part: int,
        status: Literal["repaired", "loops cut", "bays left out", "uncut"],
        reason: str,
    ) -> None:
        """Record something about a line that is there; a strict log warns of repairs."""
        if not self.strict:
            self.problems.append(Problem(self.label(index), part, status, reason))
        elif status == "repaired":
            message = self.sentence(index, part, f"repaired: {reason}")
            warnings.warn(message, RepairedAreaWarning, stacklevel=steps_to_caller())

    def join(self, joined: Joined, one: "Part", two: "Part") -> None:
        """Record what has become of an edge that two areas share."""
        if self.strict:
            return
        name, x, y = f"areas[{self.label(two.area)}]", *joined.point
        status: Literal["joint", "no joint"] = "no joint" if joined.kind == "none" else "joint"
        reason = f"{joined.kind} with {name} at ({x:.12g}, {y:.12g})"
        if joined.kind == "none":
            reason = f"edge shared with {name} at ({x:.12g}, {y:.12g}): {joined.reason}"
        of, other = (self.label(one.area), one.number), (self.label(two.area), two.number)
        self.problems.append(Joint(*of, status, reason, *other, Point(x, y), joined.kind))

    def sentence(self, index: int, part: int, text: str) -> str:
        """Text with the area it is about."""
        return f"areas[{self.label(index)}]{f' part {part}' if part else ''}: {text}"


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
    parts = filled_parts(valid_parts(areas, log)) if fills else list(valid_parts(areas, log))
    lines: Areas = np.empty(areas.size, dtype=object)
    lines[:] = [empty_like(area) for area in areas]
    found: list[list[LineString]] = [[] for _ in range(areas.size)]
    tended = lines_of_parts(
        parts, areas, find, along, geographic, log, care, threads, connect=connect
    )
    for part, line in zip(parts, tended, strict=True):
        if line is not None:
            found[part.area].append(line)
    for i, pieces in enumerate(found):
        if pieces:
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


def valid_parts(areas: "Areas", log: Log) -> Iterator[Part]:
    """Polygons of all areas, repaired where they are not valid."""
    is_area = np.array([isinstance(area, Polygon | MultiPolygon) for area in areas], dtype=bool)
    only_areas = areas.copy()
    only_areas[~is_area] = None
    valid = is_valid(only_areas)
    for i, area in enumerate(areas):
        if area is None or (isinstance(area, BaseGeometry) and area.is_empty):
            continue
        if not is_area[i]:
            kind = getattr(area, "geom_type", type(area).__name__)
            log.refuse(i, 0, GeometryTypeError(f"is a {kind}, expected a Polygon or MultiPolygon"))
            continue
        polygons = area.geoms if isinstance(area, MultiPolygon) else (area,)
        if valid[i]:
            yield from (Part(i, number, polygon) for number, polygon in enumerate(polygons))
        else:
            yield from apart(list(repaired_parts(i, polygons, log)), log)


def filled_parts(parts: Iterable[Part]) -> list[Part]:
    """Parts without their holes."""
    return [part._replace(polygon=without_holes(part.polygon)) for part in parts]


def repaired_parts(i: int, polygons: Sequence[Polygon], log: Log) -> Iterator[Part]:
    """Polygons of one area, each valid by itself."""
    for number, polygon in enumerate(polygons):
        if polygon.is_valid and not polygon.is_empty:
            yield Part(i, number, polygon)
            continue
        try:
            pieces, reason = repaired(polygon)
        except InvalidAreaError as error:
            log.refuse(i, number, error)
            continue
        log.note(i, number, "repaired", reason)
        yield from (Part(i, number, piece) for piece in pieces)


def apart(parts: list[Part], log: Log) -> Iterator[Part]:
    """Parts of one area that do not overlap others."""
    found = overlaps([part.polygon for part in parts], [part.number for part in parts])
    for row, part in enumerate(parts):
        overlap = found.get(row)
        if overlap is not None and overlap.is_refused:
            log.refuse(part.area, part.number, InvalidAreaError(overlap.reason))
            continue
        if overlap is not None:
            log.note(part.area, part.number, "repaired", overlap.reason)
        if overlap is None or not overlap.is_left_out:
            yield part


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


def refused_parts(areas: "Areas", refused: set[tuple[int, int]]) -> Iterator[Part]:
    """Polygons that were refused, if their coordinates are finite; others share edges with them."""
    for i, number in sorted(refused):
        area = areas[i]
        if isinstance(area, Polygon | MultiPolygon):
            polygon = area.geoms[number] if isinstance(area, MultiPolygon) else area
            if not polygon.is_empty and np.isfinite(shapely.get_coordinates(polygon)).all():
                yield Part(i, number, polygon)
