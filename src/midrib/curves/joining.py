"""The chain of the middles of radii: its end points, shortest paths between them, its heights.

    P0      P1     P2     P3       main curve, stations P
----+-------+------+------+----
    :       :      :      :        minimal radii PQ
.S..S.......S......S......S..      the curve: middles S, and one point for each end
    :       :      :      :
----+-------+------+------+----
    Q0      Q1     Q2     Q3       auxiliary curve
"""

from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from midrib.checks import is_number, shown
from midrib.curves.heights import heights_inside
from midrib.curves.radii import EndClearance, Radii
from midrib.errors import InvalidAreaError, ParameterError
from midrib.kernels import joining as kernel
from midrib.kernels.channels import trace_wider
from midrib.kernels.radii import draw_radii
from midrib.kernels.trunk import trace_trunk
from midrib.layout import EndPoints, Layout
from midrib.strip import pair_of
from midrib.types import Floats, Ints

__all__ = [
    "Channel",
    "EndRule",
    "Path",
    "between_ends",
    "check_ends",
    "end_points",
    "heights_of",
    "join_middles",
]

Channel: TypeAlias = Literal["shorter", "wider"]
EndRule: TypeAlias = Literal["main", "caps", "radii"] | tuple[object, object] | None
RULES = ("main", "caps", "radii")
CLEARANCES = ("station", "proportional")
NO_ENDS = EndPoints(
    np.empty((0, 2)), np.empty((0, 2)), np.empty((0, 2), dtype=np.intp), np.empty(0)
)


class Path(NamedTuple):
    """The finished chain."""

    points: Floats  # (m, 2)
    height: Floats | None  # (m,) Z
    radius: Ints  # (m,) the radius that each point is on, or -1
    middles: Floats  # (k, 2) the point of each radius
    loops: int  # how many were cut out

    @property
    def on_radii(self) -> Ints:
        """Rows of the points that are on radii."""
        return np.flatnonzero(self.radius >= 0)


def join_middles(
    layout: Layout,
    radii: Radii,
    rule: EndRule,
    *,
    centred_within: float | None = None,
    channel: Channel = "shorter",
) -> Path:
    """Join the ends and the middles of radii by shortest paths inside the area; cut loops.

    Radii that never turn back cut an area without holes into pieces in order, so that the chain
    has no loops; radii that lie on each other or on the boundary are the exception to that.
    With ``centred_within`` (a length) the chain goes through the points of the radii that are
    equally far from both banks, and is nowhere probed to be farther than that from such a point;
    where there are islands, through channels by ``channel``.
    """
    ends = end_points(layout, rule)
    strung = radii.points, radii.at, ends.point, ends.origin, ends.at
    mesh, main, auxiliary = layout.mesh, layout.main, layout.auxiliary
    if centred_within is None:
        joined = kernel.join_middles(mesh, *strung, *layout.scale)
    else:
        trace = trace_wider if channel == "wider" or layout.has_bridges else trace_trunk
        within = rule not in ("main", "caps"), True, centred_within
        joined = trace(mesh, main, auxiliary, *strung, *within, *layout.scale)
    points, source, loops, beads = joined
    if rule not in RULES and len(ends.point):
        refuse_ends_outside(ends, points, source, len(radii.points) + 2)
    if points.shape[0] < 2:
        x, y = points[0]
        msg = f"the curve is one point, ({x:.12g}, {y:.12g}); a line needs two"
        raise InvalidAreaError(msg)
    first, k = len(ends.point) // 2, len(radii.points)
    is_radius = (source >= first) & (source < first + k)
    middles = beads[first : first + k]
    return Path(
        points,
        height_along(layout, radii, middles, points, source, ends),
        np.where(is_radius, source - first, -1),
        middles,
        loops,
    )


def check_ends(ends: Any, clearance: Any) -> tuple[EndRule, EndClearance]:
    """Return an end rule, a pair of points as numbers, and a clearance.

    Raises
    ------
    ParameterError
        If there is no such rule, a point is none, or there is no such clearance.
    """
    is_pair = isinstance(ends, tuple | list | np.ndarray) and len(ends) == 2
    if not (is_pair or ends is None or (isinstance(ends, str) and ends in RULES)):
        msg = f"ends is {shown(ends)}, expected 'main', 'caps', 'radii', a pair of points or None"
        raise ParameterError(msg)
    rule: Any = (coordinates_of(ends[0]), coordinates_of(ends[1])) if is_pair else ends
    is_rule = clearance is None or (isinstance(clearance, str) and clearance in CLEARANCES)
    if not is_rule and not (is_number(clearance) and 0.0 <= clearance < np.inf):
        msg = (
            f"end_clearance is {shown(clearance)}, expected 'station', 'proportional', a length or "
            "None"
        )
        raise ParameterError(msg)
    return rule, clearance if is_rule else float(clearance)


def between_ends(radii: Radii, rule: EndRule) -> tuple[Radii, EndRule]:
    """Return the radii between two end points of the caller's, and these in main's direction.

    A radius counts as between if the line from its point to the next one leads away from the first
    end, and from the last one to its own leads towards the second. Other rules keep every radius.
    """
    if rule is None or isinstance(rule, str):
        return radii, rule
    ends = np.array([coordinates_of(point) for point in rule])
    p, q = radii.points[:, :2], radii.points[:, 2:4]
    middles = (p + q) / 2.0
    nearest = [int(np.argmin(squared_distances(end, p, q))) for end in ends]
    if nearest[0] > nearest[1]:
        nearest, ends = nearest[::-1], ends[::-1]
    low, high = nearest[0], nearest[1] + 1
    step = np.diff(middles, axis=0)
    while low < len(step) and (ends[0] - middles[low]) @ step[low] > 0.0:
        low += 1
    while high > 1 and (ends[1] - middles[high - 1]) @ step[high - 2] < 0.0:
        high -= 1
    kept = np.zeros(radii.stations.size, dtype=np.bool_)
    kept[radii.station[low:high]] = True
    chosen = radii.chosen(kept[radii.station])
    return chosen.of_stations(radii.stations[kept], np.cumsum(kept) - 1), tuple(ends)


def squared_distances(point: Floats, a: Floats, b: Floats) -> Floats:
    """Squared distance of one point to each of the segments a b."""
    along = b - a
    length_squared = (along**2).sum(axis=1)
    dot = ((point - a) * along).sum(axis=1)
    share = np.divide(dot, length_squared, out=np.zeros_like(dot), where=length_squared > 0.0)
    off = a + np.clip(share, 0.0, 1.0)[:, None] * along - point
    squared: Floats = (off**2).sum(axis=1)
    return squared


def end_points(layout: Layout, ends: EndRule) -> EndPoints:
    """Return the chain's two end points by rules 1 to 4 of the paper's section 4, or none."""
    main = layout.main
    if ends is None:
        return NO_ENDS
    if ends == "caps":
        return layout.middle
    if ends == "main":
        return vertex_ends(layout, main.vertex[[0, -1]])
    if ends == "radii":
        return radius_ends(layout)
    pair = np.array(ends, dtype=np.float64)
    return EndPoints(
        pair, pair, np.array([(main.side[i], -1) for i in (0, -1)]), np.full(2, np.nan)
    )


def coordinates_of(point: object) -> tuple[float, float]:
    """Coordinates of a Point or of a pair of numbers."""
    pair = pair_of(point)
    if pair is None:
        msg = f"ends has {shown(point)}, expected a Point or two finite numbers"
        raise ParameterError(msg)
    return float(pair[0]), float(pair[1])


def vertex_ends(layout: Layout, v: Ints) -> EndPoints:
    """Return two mesh vertices as end points."""
    point = np.column_stack([layout.mesh.x[v], layout.mesh.y[v]])
    height = np.full(2, np.nan) if layout.height is None else layout.height[v]
    return EndPoints(point, point, np.column_stack([layout.mesh.door[v], v]), height)


def radius_ends(layout: Layout) -> EndPoints:
    """Rule 3: middles of the radii from the main curve's ends to segments apart from them."""
    main, auxiliary = layout.main, layout.auxiliary
    ends = vertex_ends(layout, main.vertex[[0, -1]])
    low, high = np.full(2, -np.inf), np.full(2, np.inf)
    if layout.shares_start:
        low[0] = auxiliary.arc[1]
    if layout.shares_end:
        high[1] = auxiliary.arc[-2]
    side = main.side[[0, -1]]
    drawn = draw_radii(
        layout.mesh, main, auxiliary, ends.point, side, ends.at[:, 1], low, high, 0.0, *layout.scale
    )
    found, first = np.unique(drawn.at[:, 0], return_index=True)
    for i, name in enumerate(("start", "end")):
        if i not in found:
            x, y = ends.point[i]
            msg = (
                f"ends='radii' finds no radius at the {name} of the main curve, "
                f"({x:.12g}, {y:.12g}), to a segment that does not touch it"
            )
            raise ParameterError(msg)
    middle = (drawn.points[first, :2] + drawn.points[first, 2:4]) / 2.0
    height = np.full(2, np.nan)
    if layout.height is not None:
        on_auxiliary = np.interp(
            drawn.points[first, 4], auxiliary.arc, layout.height[auxiliary.vertex]
        )
        height = (ends.height + on_auxiliary) / 2.0
    return EndPoints(middle, ends.point, np.column_stack([side, ends.at[:, 1]]), height)


def refuse_ends_outside(ends: EndPoints, points: Floats, source: Ints, count: int) -> None:
    """Refuse end points of the caller's that are not in the area, and so not on the path."""
    for i, name, row in ((0, "first", 0), (1, "second", count - 1)):
        is_repeat = points.size > 0 and bool((points[-1] == ends.point[i]).all())
        if row not in source and not is_repeat:
            x, y = ends.point[i]
            msg = f"the {name} of ends, ({x:.12g}, {y:.12g}), lies outside the area"
            raise ParameterError(msg)


def height_along(
    layout: Layout, radii: Radii, middles: Floats, points: Floats, source: Ints, ends: EndPoints
) -> Floats | None:
    """Z of every point of the path, None if the area has none.

    Of a point on a radius, what lies between the two curves' heights there; of an end of the
    caller's, that of the mesh there.
    """
    height = layout.height
    if height is None:
        return None
    main, auxiliary = layout.main, layout.auxiliary
    from_main = np.hypot(*((middles - radii.points[:, :2]) * layout.scale).T)
    radius = radii.points[:, 5]
    share = np.divide(from_main, radius, out=np.full_like(radius, 0.5), where=radius > 0.0)
    on_main = np.interp(radii.stations[radii.station], main.arc, height[main.vertex])
    on_auxiliary = np.interp(radii.arc, auxiliary.arc, height[auxiliary.vertex])
    beads = on_main + share * (on_auxiliary - on_main)
    beads = np.concatenate([ends.height[:1], beads, ends.height[1:]])
    return heights_of(layout, points, source, beads)


def heights_of(layout: Layout, points: Floats, source: Ints, beads: Floats | None) -> Floats | None:
    """Z of every point of a path that joins beads of known Z (NaN if not); None without.

    Of a mesh vertex, its own; of a point that is neither, in between along the path.
    """
    height = layout.height
    if height is None or beads is None:
        return None
    z = np.where(
        source < 0,
        height[np.where(source < 0, -1 - source, 0)],
        np.append(beads, np.nan)[np.maximum(source, 0)],
    )
    unknown = np.isnan(z)
    z[unknown] = heights_inside(layout.mesh, height, points[unknown])
    unknown = np.isnan(z)
    if unknown.any() and not unknown.all():
        along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        z[unknown] = np.interp(along[unknown], along[~unknown], z[~unknown])
    return z
