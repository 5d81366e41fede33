"""The construction: radii from the main to the auxiliary curve, and the chain of their middles.

        P0      P1     P2     P3       main curve, stations P
    ----+-------+------+------+----
        :       :      :      :        minimal radii PQ
    .S..S.......S......S......S..      the curve: middles S, and one point for each end
        :       :      :      :
    ----+-------+------+------+----
        Q0      Q1     Q2     Q3       auxiliary curve

Arrays only: ``minimal_radii`` and ``collapse`` shape the answer.
"""

from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
import shapely

from midrib.curves.stations import StationRule, Stations
from midrib.errors import InvalidAreaError, ParameterError
from midrib.kernels.boxtree import GRAZE
from midrib.kernels.loops import cut_loops
from midrib.kernels.paths import join_points
from midrib.kernels.radii import draw_radii as draw
from midrib.layout import EndPoint, Layout
from midrib.types import Bools, Floats, Ints

__all__ = [
    "EndClearance",
    "EndRule",
    "Path",
    "Radii",
    "check_ends",
    "draw_radii",
    "join_middles",
    "jumps_of",
]

EndRule: TypeAlias = Literal["main", "caps", "radii"] | tuple[object, object] | None
EndClearance: TypeAlias = Literal["station", "proportional"] | float | None
COLLAPSED = 0.5  # a radius has collapsed into the shared end if E is less than half as far from it
STRAIGHT = 2.0**-20  # a first segment goes on through vertices that bend by less than this
LOOP_ROUNDS = 8
JUMP_SLACK = 2.0**-20
# Stations by default in an area that is very thin for its number of vertices.
MOST_BY_WIDTH, MOST_BY_VERTEX = 256, 4
# A radius is lopsided if Q sees the main curve nearer than P by this factor. Of 1.2, 1.5, 2 and 3
# it gave the most centred lines on rivers, roads, verges and slopes.
LOPSIDED = 1.5
RULES = ("main", "caps", "radii")
PER_RADIUS = (
    "station", "on_main", "on_auxiliary", "arc", "length", "kind", "side", "vertex", "is_lopsided"
)  # fmt: skip


class Radii(NamedTuple):
    """Minimal radii in order of travel; several with one station where they tie."""

    stations: Floats  # (n,) all stations, with or without a radius
    station: Ints  # (k,) which of them each radius belongs to
    on_main: Floats  # (k, 2) P
    on_auxiliary: Floats  # (k, 2) Q
    arc: Floats  # (k,) arc length of Q along the auxiliary curve
    length: Floats  # (k,) the radius
    kind: Ints  # (k,) FOOT, VERTEX, GRAZE or LIMIT
    side: Ints  # (k,) boundary side of P
    vertex: Ints  # (k,) mesh vertex of P, or -1
    is_lopsided: Bools  # (k,) whether Q sees the main curve much nearer than P, if that was asked
    bays: Floats  # (b,) stations left out because they lie in bays

    def chosen(self, rows: Ints | Bools) -> "Radii":
        """Return some of the radii, of the same stations."""
        columns: dict[str, Any] = {name: getattr(self, name)[rows] for name in PER_RADIUS}
        return self._replace(**columns)


class Path(NamedTuple):
    """The finished chain: points, the middle (or end) each is, and the loops cut out."""

    points: Floats  # (m, 2)
    source: Ints  # (m,) row of the middles with the ends; -1 - v at mesh vertex v
    height: Floats | None  # (m,) Z
    loops: int


def draw_radii(layout: Layout, rule: StationRule, clearance: EndClearance) -> Radii:
    """Place the stations on the main curve and draw the radii from them."""
    mesh = layout.mesh
    most = MOST_BY_WIDTH + MOST_BY_VERTEX * (layout.main.arc.size + layout.auxiliary.arc.size)
    stations = rule.on(layout.main, mesh.x, mesh.y, layout.mean_width, most)
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
    found, at, is_lopsided = draw(
        layout.mesh, layout.main, layout.auxiliary,
        stations.point, stations.side, stations.vertex, low, high, lopsided, *layout.scale,
    )  # fmt: skip
    row = at[:, 0]
    return Radii(
        stations.arc,
        row,
        stations.point[row],
        found[:, :2],
        found[:, 2],
        found[:, 3],
        at[:, 1],
        stations.side[row],
        stations.vertex[row],
        is_lopsided,
        np.empty(0),
    )


def replaced(radii: Radii, again: Radii, crowded: Ints) -> Radii:
    """Radii with those of the crowded stations drawn again."""
    is_crowded = np.zeros(radii.stations.size, dtype=np.bool_)
    is_crowded[crowded] = True
    kept = radii.chosen(~is_crowded[radii.station])
    again = again._replace(station=crowded[again.station])
    both: dict[str, Any] = {
        name: np.concatenate([getattr(kept, name), getattr(again, name)]) for name in PER_RADIUS
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
    kept = radii.chosen(is_kept)
    new_row = np.cumsum(~in_bay) - 1
    return kept._replace(
        stations=radii.stations[~in_bay],
        station=new_row[kept.station],
        bays=radii.stations[in_bay],
    )


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


def check_ends(ends: EndRule, clearance: EndClearance) -> None:
    """Refuse end rules and clearances that do not exist."""
    is_pair = isinstance(ends, tuple | list) and len(ends) == 2
    if not (is_pair or ends is None or (isinstance(ends, str) and ends in RULES)):
        msg = f"ends is {ends!r}, expected 'main', 'caps', 'radii', a pair of points or None"
        raise ParameterError(msg)
    is_length = isinstance(clearance, int | float) and not isinstance(clearance, bool)
    if is_length and 0.0 <= float(clearance) < np.inf:  # type: ignore[arg-type]
        return
    if clearance is not None and clearance not in ("station", "proportional"):
        msg = (
            f"end_clearance is {clearance!r}, expected 'station', 'proportional', a length or None"
        )
        raise ParameterError(msg)


def end_points(layout: Layout, ends: EndRule) -> list[EndPoint]:
    """Return the chain's two end points by rules 1 to 4 of the paper's section 4, or none."""
    main = layout.main
    if ends is None:
        return []
    if ends == "main":
        return [vertex_end(layout, main.vertex[0]), vertex_end(layout, main.vertex[-1])]
    if ends == "caps":
        return list(layout.middle)
    if ends == "radii":
        return [radius_end(layout, 0), radius_end(layout, -1)]
    pair = [coordinates_of(point) for point in ends]
    return [
        EndPoint(p, p, int(main.side[i]), -1, np.nan) for p, i in zip(pair, (0, -1), strict=True)
    ]


def coordinates_of(point: object) -> tuple[float, float]:
    """Coordinates of a Point or of a pair of numbers."""
    values = point if isinstance(point, tuple | list | np.ndarray) else ()
    if isinstance(point, shapely.Point) and not point.is_empty:
        values = (point.x, point.y)
    is_pair = len(values) == 2 and all(isinstance(v, int | float | np.number) for v in values)
    if not is_pair or not np.isfinite([float(v) for v in values]).all():
        msg = f"ends has {point!r}, expected a Point or two finite numbers"
        raise ParameterError(msg)
    return float(values[0]), float(values[1])


def vertex_end(layout: Layout, v: int) -> EndPoint:
    """Return a mesh vertex as an end point."""
    point = float(layout.mesh.x[v]), float(layout.mesh.y[v])
    height = np.nan if layout.height is None else float(layout.height[v])
    return EndPoint(point, point, int(layout.mesh.door[v]), int(v), height)


def radius_end(layout: Layout, which: int) -> EndPoint:
    """Rule 3: the middle of the radius from an end of the main curve to a segment apart from it."""
    main, auxiliary = layout.main, layout.auxiliary
    v, side = main.vertex[which], main.side[which]
    low, high = -np.inf, np.inf
    if which == 0 and layout.shares_start:
        low = auxiliary.arc[1]
    if which == -1 and layout.shares_end:
        high = auxiliary.arc[-2]
    x, y = float(layout.mesh.x[v]), float(layout.mesh.y[v])
    found, _, _ = draw(
        layout.mesh, main, auxiliary,
        np.array([[x, y]]), np.array([side]), np.array([v]), np.array([low]), np.array([high]),
        0.0, *layout.scale,
    )  # fmt: skip
    if found.shape[0] == 0:
        end = "start" if which == 0 else "end"
        msg = (
            f"ends='radii' finds no radius at the {end} of the main curve, ({x:.12g}, {y:.12g}), "
            "to a segment that does not touch it"
        )
        raise ParameterError(msg)
    middle = float((x + found[0, 0]) / 2.0), float((y + found[0, 1]) / 2.0)
    return EndPoint(middle, (x, y), int(side), int(v), np.nan)


class Beads(NamedTuple):
    """Points to string on the chain, and where on the boundary the search for each begins."""

    point: Floats
    origin: Floats
    side: Ints
    vertex: Ints


def string_beads(radii: Radii, ends: list[EndPoint]) -> Beads:
    """Return the middles of the radii between the end points."""
    middles = (radii.on_main + radii.on_auxiliary) / 2.0
    if not ends:
        return Beads(middles, radii.on_main, radii.side, radii.vertex)
    n = middles.shape[0]
    point, origin = np.empty((n + 2, 2)), np.empty((n + 2, 2))
    side, vertex = np.empty(n + 2, dtype=np.intp), np.empty(n + 2, dtype=np.intp)
    point[1:-1], origin[1:-1] = middles, radii.on_main
    side[1:-1], vertex[1:-1] = radii.side, radii.vertex
    for row, end in zip((0, -1), ends, strict=True):
        point[row], origin[row], side[row], vertex[row] = end[:4]
    return Beads(point, origin, side, vertex)


def join_middles(layout: Layout, radii: Radii, rule: EndRule) -> Path:
    """Join the ends and the middles of radii by shortest paths inside the area; cut loops.

    Radii that never turn back cut an area without holes into pieces in order, so that the chain
    has no loops; radii that lie on each other or on the boundary are the exception to that.
    """
    ends = end_points(layout, rule)
    beads = string_beads(radii, ends)
    points, source = join_beads(layout, beads)
    if rule not in RULES and ends:
        refuse_ends_outside(ends, points, source, beads.point.shape[0])
    loops = 0
    for _ in range(LOOP_ROUNDS):
        cut, row, found = cut_loops(points)
        if not found:
            break
        loops += found
        points, source = join_again(layout, beads, cut, row, source)
    if points.shape[0] < 2:
        x, y = beads.point[0]
        msg = f"the curve is one point, ({x:.12g}, {y:.12g}); a line needs two"
        raise InvalidAreaError(msg)
    return Path(points, source, height_along(layout, radii, points, source, ends), loops)


def join_beads(layout: Layout, beads: Beads) -> tuple[Floats, Ints]:
    """Shortest paths between consecutive beads."""
    (x, y), (px, py) = beads.point.T.copy(), beads.origin.T.copy()
    path, source = join_points(layout.mesh, x, y, px, py, beads.side, beads.vertex, *layout.scale)
    return path, source


def join_again(
    layout: Layout, beads: Beads, cut: Floats, row: Ints, source: Ints
) -> tuple[Floats, Ints]:
    """Prove a path again after its loops have been cut; new points count as one past the beads."""
    new = beads.point.shape[0]
    came_from = np.where(row < 0, new, source[row])
    hint = np.where(came_from == new, -1, came_from)
    hint = np.maximum.accumulate(np.where(hint < 0, -1, np.arange(hint.size)))
    hint = came_from[np.maximum(hint, 0)]
    hint = np.where((hint < 0) | (hint >= new), 0, hint)
    again = Beads(cut, beads.origin[hint], beads.side[hint], beads.vertex[hint])
    points, place = join_beads(layout, again)
    return points, np.where(place < 0, place, came_from[np.maximum(place, 0)])


def refuse_ends_outside(ends: list[EndPoint], points: Floats, source: Ints, count: int) -> None:
    """Refuse end points of the caller's that are not in the area, and so not on the path."""
    for name, end, row in (("first", ends[0], 0), ("second", ends[1], count - 1)):
        is_repeat = points.size > 0 and tuple(points[-1]) == end.point
        if row not in source and not is_repeat:
            x, y = end.point
            msg = f"the {name} of ends, ({x:.12g}, {y:.12g}), lies outside the area"
            raise ParameterError(msg)


def height_along(
    layout: Layout, radii: Radii, points: Floats, source: Ints, ends: list[EndPoint]
) -> Floats | None:
    """Z of every point of the path, None if the area has none.

    Of a middle, the mean of the two curves' heights; of a mesh vertex, its own; of a crossing,
    in between along the path.
    """
    height = layout.height
    if height is None:
        return None
    main, auxiliary = layout.main, layout.auxiliary
    on_main = np.interp(radii.stations[radii.station], main.arc, height[main.vertex])
    on_auxiliary = np.interp(radii.arc, auxiliary.arc, height[auxiliary.vertex])
    beads = (on_main + on_auxiliary) / 2.0
    if ends:
        beads = np.concatenate([[ends[0].height], beads, [ends[1].height]])
    z = np.where(
        source < 0,
        height[np.where(source < 0, -1 - source, 0)],
        np.append(beads, np.nan)[np.maximum(source, 0)],
    )
    unknown = np.isnan(z)
    if unknown.any() and not unknown.all():
        along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        z[unknown] = np.interp(along[unknown], along[~unknown], z[~unknown])
    return z


def jumps_of(radii: Radii) -> Floats:
    """Stations at which Q jumps: halfway between two stations, or a station whose radii tie.

    Q moves along the auxiliary curve at most as fast as P along the main one, except behind a
    grazing vertex; a faster step is a jump.
    """
    at = radii.stations[radii.station]
    step = np.diff(at)
    move = np.abs(np.diff(radii.arc))
    behind = (radii.kind[:-1] == GRAZE) & (radii.kind[1:] == GRAZE)
    slack = JUMP_SLACK * (radii.stations[-1] + (radii.arc.max() if radii.arc.size else 0.0))
    jump = (move > step * (1.0 + JUMP_SLACK) + slack) & ~behind
    return np.unique((at[:-1][jump] + at[1:][jump]) / 2.0)
