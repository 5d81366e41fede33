r"""Gauging: how far apart strokes are, how much they turn, and from what they lean.

top  ----a-----c--------     gap       the mean of what the rule asks for at both strokes
          |     |            STEP      between neighbours on the middle line, in gaps
line  ----o-----o--------    TOP, TOE  between their ends along the edges, in gaps
          |     |            NEAR_TOP, NEAR_TOE  straight, in gaps; to the next that is drawn
toe  -----b-----d--------              as far as the toe
                             TURN, ALLOWED  angle between them, and what it may be
                             NORMAL    direction of the normal of an edge
                             LEAN      how far the stroke may be off it
"""

from typing import NamedTuple

import numpy as np

from midrib.kernels.jit import njit
from midrib.kernels.lengths import length
from midrib.types import Bools, Floats

__all__ = [
    "ALLOWED", "LEAN", "LEAST_TURN", "MOST_TILT", "NEAR_TOE", "NEAR_TOP", "NORMAL", "STEP", "TOE",
    "TOP", "TURN", "Course", "allowed_turns", "direction_on", "gauge", "is_straight",
    "leans",
]  # fmt: skip

STEP, TOP, TOE, NEAR_TOP, NEAR_TOE, TURN, ALLOWED, NORMAL, LEAN = range(9)
LEAST_TURN = np.pi / 9.0  # 20 degrees: so much neighbours may turn anyway
CORNER = 1.5  # lengths of stroke to either side, over which the middle line may turn too
STRAIGHT = np.pi / 18.0  # 10 degrees: an edge that turns less within two widths has no corner there
MOST_TILT = np.pi / 18.0  # 10 degrees from the normal of a top that is straight
MOST_LEAN = np.pi / 7.2  # 25 degrees beyond all normals of the straighter edge, anywhere else
SHORTEST_CHORD = 0.25  # of a chord: shorter ends of an edge have no direction
FEWEST_CHORDS = 8.0  # of an edge
NEAR_END, SIDE = 2.0, np.pi / 3.0  # widths from an end; 60 degrees between a side and an edge
PLACES = (-1.5, -0.75, 0.0, 0.75, 1.5)  # widths from an end, where directions over a width are told


class Course(NamedTuple):
    """A polyline with stations."""

    points: Floats  # (m, 2)
    arc: Floats  # (m,)
    is_closed: bool


@njit(borrows=True)
def folded(angle: float, period: float) -> float:
    """Angle or length brought to between minus and plus half a period."""
    return angle - period * np.round(angle / period)


@njit(borrows=True)
def ahead(course: Course, low: float, high: float) -> float:
    """Distance between two stations, on a closed course the shorter way."""
    way = high - low
    return abs(folded(way, course.arc[course.arc.size - 1]) if course.is_closed else way)


@njit(borrows=True)
def place_on(course: Course, station: float) -> tuple[float, float]:
    """Point at a station: round a closed course, else no farther than its ends."""
    arc = course.arc
    m = arc.size
    at = station % arc[m - 1] if course.is_closed else min(max(station, 0.0), arc[m - 1])
    k = min(max(np.searchsorted(arc, at, side="right") - 1, 0), m - 2)
    share = (at - arc[k]) / (arc[k + 1] - arc[k])
    ax, ay = course.points[k, 0], course.points[k, 1]
    return ax + share * (course.points[k + 1, 0] - ax), ay + share * (course.points[k + 1, 1] - ay)


@njit(borrows=True)
def direction_on(course: Course, station: float, width: float) -> float:
    """Direction of a course over a width around a station; NaN beyond its ends."""
    if not course.is_closed and not 0.0 <= station <= course.arc[course.arc.size - 1]:
        return np.nan
    ax, ay = place_on(course, station - width / 2.0)
    bx, by = place_on(course, station + width / 2.0)
    return np.arctan2(by - ay, bx - ax)


@njit(borrows=True)
def is_straight(course: Course, station: float, width: float) -> bool:
    """Whether a course has no corner within two widths of a station, nor an end in 1.5."""
    here = direction_on(course, station, width)
    for place in PLACES:
        off = direction_on(course, station + place * width, width) - here
        if not abs(folded(off, 2.0 * np.pi)) <= STRAIGHT:
            return False
    return True


@njit(borrows=True)
def spread(course: Course, station: float, width: float) -> tuple[float, float]:
    """Middle of the directions of a course within two widths of a station, and half their range.

    They are told over a width, and over an eighth of a course that is shorter than eight: one chord
    of half a ring would be a straight edge.
    """
    low, high, first = np.inf, -np.inf, np.nan
    total = course.arc[course.arc.size - 1]
    chord = min(width, total / FEWEST_CHORDS)
    reach = int(np.ceil(2.0 * width / chord))
    for k in range(-reach, reach):
        start, stop = station + k * chord, station + (k + 1) * chord
        if not course.is_closed:
            start, stop = max(start, 0.0), min(stop, total)
        if stop - start < SHORTEST_CHORD * chord:
            continue
        ax, ay = place_on(course, start)
        bx, by = place_on(course, stop)
        direction = np.arctan2(by - ay, bx - ax)
        if np.isnan(first):
            first = direction
        off = folded(direction - first, 2.0 * np.pi)
        low, high = min(low, off), max(high, off)
    return first + (low + high) / 2.0, (high - low) / 2.0


@njit(borrows=True)
def is_near_end(course: Course, station: float, width: float) -> bool:
    """Whether an open course ends within two widths of a station."""
    total = course.arc[course.arc.size - 1]
    return not course.is_closed and min(station, total - station) <= NEAR_END * width


@njit(borrows=True)
def side_of(course: Course, station: float, width: float, is_top: bool) -> float:
    """Direction down the side that an edge begins or ends with; NaN where a station is on it.

    A top that ends before the slope does leaves a side to the toe: strokes turn to run along it.
    """
    total = course.arc[course.arc.size - 1]
    end, way = (0.0, 0.5) if 2.0 * station < total else (total, -0.5)
    ax, ay = place_on(course, min(end, end + way * width))
    bx, by = place_on(course, max(end, end + way * width))
    side = np.arctan2(by - ay, bx - ax)
    off = direction_on(course, station, width / 2.0) - side
    if abs(folded(off, 2.0 * np.pi)) <= SIDE:
        return np.nan
    return side + np.pi if is_top == (end == 0.0) else side


@njit(borrows=True)
def leaning(
    top: Course, toe: Course, on_top: float, on_toe: float, width: float
) -> tuple[float, float]:
    """Direction of the normal that a stroke may not lean from too far, and how far it may.

    Where the top is straight it is that of the top; anywhere else see ``leaning_anywhere``.
    """
    if is_straight(top, on_top, width):
        return direction_on(top, on_top, width) + np.pi / 2.0, MOST_TILT
    return leaning_anywhere(top, toe, on_top, on_toe, width)


@njit(borrows=True)
def leaning_anywhere(
    top: Course, toe: Course, on_top: float, on_toe: float, width: float
) -> tuple[float, float]:
    """Direction and angle as above, where the top has a corner.

    The stroke may be normal to any part of the straighter edge beside it, of both if both are
    straight, and of all directions between. Near an end where an edge begins with a side, it may
    turn as far as that.
    """
    middle, half = spread(top, on_top, width)
    other, wider = spread(toe, on_toe, width)
    if not half <= wider:
        middle, half, other, wider = other, wider, middle, half
    if wider <= STRAIGHT:
        off = folded(other - middle, 2.0 * np.pi)  # they run beside each other
        low, high = min(-half, off - wider), max(half, off + wider)
        middle, half = middle + (low + high) / 2.0, (high - low) / 2.0
    if is_near_end(top, on_top, width) or is_near_end(toe, on_toe, width):
        for edge, at, is_top in ((top, on_top, True), (toe, on_toe, False)):
            side = side_of(edge, at, width, is_top)
            if not np.isnan(side):
                off = folded(side - middle - np.pi / 2.0, 2.0 * np.pi)
                low, high = min(-half, off), max(half, off)
                middle, half = middle + (low + high) / 2.0, (high - low) / 2.0
    return middle + np.pi / 2.0, half + MOST_LEAN


@njit()
def headings(course: Course) -> Floats:
    """(m - 1, 2) middles of the segments of a course, and their directions without leaps."""
    m = course.arc.size - 1
    found = np.empty((m, 2))
    for k in range(m):
        dx = course.points[k + 1, 0] - course.points[k, 0]
        dy = course.points[k + 1, 1] - course.points[k, 1]
        found[k, 0], found[k, 1] = (course.arc[k] + course.arc[k + 1]) / 2.0, np.arctan2(dy, dx)
        if k > 0:
            found[k, 1] = found[k - 1, 1] + folded(found[k, 1] - found[k - 1, 1], 2.0 * np.pi)
    return found


@njit(borrows=True)
def heading_at(course: Course, known: Floats, station: float) -> float:
    """Direction at a station, linear between the middles of segments."""
    m, total = known.shape[0], course.arc[course.arc.size - 1]
    lap, around = 0.0, 0.0
    if course.is_closed:
        lap = np.floor(station / total)
        station -= lap * total
        last = known[m - 1, 1] + folded(known[0, 1] - known[m - 1, 1], 2.0 * np.pi)
        around = last - known[0, 1]
    k = np.searchsorted(known[:, 0], station)
    if not (0 < k < m or course.is_closed):
        return known[min(k, m - 1), 1]
    low, high = (k - 1) % m, k % m
    a, b = known[low, 0] - (total if k == 0 else 0.0), known[high, 0] + (total if k == m else 0.0)
    at_a = known[low, 1] - (around if k == 0 else 0.0)
    at_b = known[high, 1] + (around if k == m else 0.0)
    return at_a + (station - a) / (b - a) * (at_b - at_a) + lap * around


@njit(borrows=True)
def allowed_at(course: Course, known: Floats, at: float, width: float, gap: float) -> float:
    """Angle that neighbours may turn; see ``allowed_turns``."""
    low, high = at - CORNER * width, at + CORNER * width
    if not course.is_closed:
        low, high = max(low, 0.0), min(high, course.arc[course.arc.size - 1])
    turn = abs(heading_at(course, known, high) - heading_at(course, known, low))
    return max(LEAST_TURN, turn * gap / max(high - low, gap))


@njit(entry=True)
def allowed_turns(line: Course, at: Floats, width: Floats, gap: Floats) -> Floats:
    """Angles that neighbours may turn at stations of the middle line.

    20 degrees, or where the line turns by A within 1.5 w on either side, A gap over the length of
    that stretch, if that is more.
    """
    known, found = headings(line), np.empty(at.size)
    for i in range(at.size):
        found[i] = allowed_at(line, known, at[i], width[i], gap[i])
    return found


@njit(entry=True)
def leans(top: Course, toe: Course, feet: Floats, width: Floats) -> Floats:
    """(n, 2) what ``leaning_anywhere`` tells of strokes with such feet and widths."""
    found = np.empty((width.size, 2))
    for i in range(width.size):
        found[i] = leaning_anywhere(top, toe, feet[i, 0], feet[i, 1], width[i])
    return found


@njit(entry=True)
def gauge(
    line: Course,
    top: Course,
    toe: Course,
    station: Floats,
    feet: Floats,
    ends: Floats,
    asked: Floats,
    local: Floats,
    on_edge: Bools,
) -> Floats:
    """Gauge strokes.

    Parameters
    ----------
    line, top, toe : the middle line and the edges, beside each other, the top with the slope on
        its left
    station : (n,) of the strokes on the line, in order along it, either way
    feet : (n, 2) of their ends on top and toe
    ends : (n, 4) x and y of these
    asked : (n,) gaps that the rule asks for at each
    local : (n,) lengths of strokes, of longer ones so many local widths
    on_edge : (n,) which strokes are drawn as far as the toe

    Returns
    -------
    (n, 9) : what the columns are is told above. The last row of a slope that is not closed, and
        what there is not, is NaN. O((n + m) log m).
    """
    n = station.size
    found, known = np.full((n, 9), np.nan), headings(line)
    for i in range(n):
        dx, dy = ends[i, 2] - ends[i, 0], ends[i, 3] - ends[i, 1]
        found[i, NORMAL], found[i, LEAN] = leaning(top, toe, feet[i, 0], feet[i, 1], local[i])
        if n < 2 or (i == n - 1 and not line.is_closed):
            continue
        j = (i + 1) % n
        gap = (asked[i] + asked[j]) / 2.0
        step = station[j] - station[i]
        if line.is_closed:
            step = folded(step, line.arc[line.arc.size - 1])
        found[i, STEP] = abs(step) / gap
        found[i, TOP] = ahead(top, feet[i, 0], feet[j, 0]) / gap
        found[i, TOE] = ahead(toe, feet[i, 1], feet[j, 1]) / gap
        found[i, NEAR_TOP] = length(ends[j, 0] - ends[i, 0], ends[j, 1] - ends[i, 1]) / gap
        ex, ey = ends[j, 2] - ends[j, 0], ends[j, 3] - ends[j, 1]
        found[i, TURN] = abs(np.arctan2(dx * ey - dy * ex, dx * ex + dy * ey))
        widest = max(local[i], local[j])
        found[i, ALLOWED] = allowed_at(line, known, station[i] + step / 2.0, widest, gap)
    gauge_toe(found, ends, asked, on_edge, line.is_closed)
    return found


@njit(borrows=True)
def gauge_toe(found: Floats, ends: Floats, asked: Floats, on_edge: Bools, is_closed: bool) -> None:
    """Write straight distances between ends of strokes that are drawn as far as the toe."""
    n, first, last = asked.size, -1, -1
    for i in range(n):
        if not on_edge[i]:
            continue
        if last >= 0:
            away = length(ends[i, 2] - ends[last, 2], ends[i, 3] - ends[last, 3])
            found[last, NEAR_TOE] = away / ((asked[i] + asked[last]) / 2.0)
        else:
            first = i
        last = i
    if is_closed and last > first:
        away = length(ends[first, 2] - ends[last, 2], ends[first, 3] - ends[last, 3])
        found[last, NEAR_TOE] = away / ((asked[first] + asked[last]) / 2.0)
