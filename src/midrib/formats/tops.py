"""Tops that are stored in pieces: which of them follow each other along a ring, and are one.

start, stop   stations along the ring, forward, where a piece begins and ends; a row of pieces may
              go on past the ring's first point
near          how far apart pieces may be, and how far off the ring: a tenth of the mean width

      +---->----+ +---->----+       The gap between the two is no longer than near: they are one.
      |  piece       piece  |       What is left of the ring has to be an edge as well: tops on
      +---------------------+       both sides of a slope that meet at its tips stay apart.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import shapely
from shapely import LineString, Point, Polygon

from midrib.hatching.checking import MOST_UNEQUAL
from midrib.hatching.edges import NEAR, Doubt, mean_width

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Top", "joined_tops"]

Top: TypeAlias = "tuple[Floats, Floats] | LineString"  # start and end, or all of it
SHORT = 1.5  # mean widths: no longer than this is a piece that runs across the end of a slope
TURN = 45.0  # degrees: it turns off the top by more than this
KIND = "pieces"


@dataclass(frozen=True, eq=False)
class Run:
    """A piece of a top, on the ring it lies along."""

    number: int
    ring: int
    start: float
    stop: float
    is_forward: bool
    points: "Floats"  # forward


def joined_tops(area: Polygon, tops: Sequence[Top]) -> tuple[list[Top], list[Doubt]]:
    """Join tops of an area that follow each other along one of its rings.

    Two are one if the gap between them is no longer than a tenth of the mean width, or if they
    overlap, unless next to nothing would be left of the outer ring for a toe. A short piece at the
    end of a row that turns off it runs across the end of the slope: it is left out.

    Parameters
    ----------
    area : Polygon
    tops : sequence of (start, end) or LineString
        Start and end are meant forward along the ring.

    Returns
    -------
    tops : list of (start, end) or LineString
        In the order of their first pieces. A row runs the way its longest piece does.
    doubts : list of Doubt
        What was joined, and what left out.

    Notes
    -----
    O(n log n) for n pieces.
    """
    if len(tops) < 2 or not isinstance(area, Polygon) or not area.is_valid:
        return list(tops), []
    width = mean_width(area)
    rings = [LineString(ring) for ring in shapely.get_rings(shapely.force_2d(area))]
    runs = [run_of(k, top, rings, NEAR * width) for k, top in enumerate(tops)]
    found = {k: top for k, (top, run) in enumerate(zip(tops, runs, strict=True)) if run is None}
    doubts: list[Doubt] = []
    for k, ring in enumerate(rings):
        has_toe = k > 0 or len(rings) > 1
        here = [run for run in runs if run is not None and run.ring == k]
        for row in rows_of(here, ring.length, NEAR * width):
            kept = without_ends(row, width, doubts)
            apart = [[run] for run in kept]
            for some in [kept] if has_toe or leaves_a_toe(kept, ring.length) else apart:
                first = min(run.number for run in some)
                found[first] = tops[first]
                if len(some) > 1:
                    found[first] = line_along(ring, some, NEAR * width)
                    doubts.append(joint_of(some))
    return [found[k] for k in sorted(found)], doubts


def run_of(number: int, top: Top, rings: Sequence[LineString], near: float) -> Run | None:
    """Find the ring that a top lies along, and where; None if there is none."""
    is_line = isinstance(top, LineString)
    line = shapely.force_2d(top) if is_line else LineString([point[:2] for point in top])
    samples = shapely.points(
        shapely.get_coordinates(shapely.segmentize(line, near) if is_line else line)
    )
    off = [float(shapely.distance(samples, ring).max()) for ring in rings]
    k = int(np.argmin(off))
    if off[k] > near:
        return None
    ring, points = rings[k], shapely.get_coordinates(line)
    first, last = ring.line_locate_point(shapely.points(points[[0, -1]]))
    ahead = (last - first) % ring.length or ring.length
    middle = ring.line_locate_point(line.interpolate(0.5, normalized=True))
    if not is_line or (middle - first) % ring.length <= ahead:
        return Run(number, k, first, first + ahead, True, points)
    back = (first - last) % ring.length
    return Run(number, k, last, last + back, False, points[::-1])


def rows_of(runs: Sequence[Run], length: float, near: float) -> list[list[Run]]:
    """Put runs of a ring in rows, forward: gaps in a row are no longer than ``near``."""
    rows: list[list[Run]] = []
    for run in sorted(runs, key=lambda run: run.start):
        if rows and run.start - stop_of(rows[-1]) <= near:
            rows[-1].append(run)
        else:
            rows.append([run])
    while len(rows) > 1 and rows[0][0].start + length - stop_of(rows[-1]) <= near:
        rows[-1] += [
            replace(run, start=run.start + length, stop=run.stop + length) for run in rows.pop(0)
        ]
    return rows


def stop_of(row: Sequence[Run]) -> float:
    """Station where a row ends."""
    return max(run.stop for run in row)


def without_ends(row: list[Run], width: float, doubts: list[Doubt]) -> list[Run]:
    """Leave out of a row what runs across the ends of the slope; that is doubted."""
    first, last = 0, len(row)
    for k in range(1, len(row)):
        turn = turn_at(row[k - 1], row[k], width)
        before, after = stop_of(row[:k]) - row[0].start, stop_of(row[k:]) - row[k].start
        if turn <= TURN or min(before, after) > SHORT * width:
            continue
        if before <= after:
            first = k
        else:
            last = min(last, k)
        length, run = min((before, row[0]), (after, row[-1]), key=lambda end: end[0])
        reason = (
            f"a piece of its top, {length:.3g} long, turns off the others by {turn:.0f} degrees: "
            "it is taken for the end of the slope"
        )
        doubts.append(Doubt(KIND, reason, Point(run.points[0])))
    return row[first:last]


def turn_at(before: Run, after: Run, width: float) -> float:
    """Degrees by which the direction turns from one run to the next, over a width of each."""
    lines = LineString(before.points), LineString(after.points)
    spans = (-width, lines[0].length), (0.0, width)
    ways = []
    for line, span in zip(lines, spans, strict=True):
        (x, y), (u, v) = (line.interpolate(station).coords[0] for station in span)
        ways.append(np.arctan2(v - y, u - x))
    turn = np.degrees(ways[1] - ways[0])
    return float(abs((turn + 180.0) % 360.0 - 180.0))


def leaves_a_toe(row: Sequence[Run], length: float) -> bool:
    """Whether enough is left of an outer ring, beside one top, to be the toe of it."""
    whole = stop_of(row) - row[0].start
    return whole <= MOST_UNEQUAL * (length - whole)


def line_along(ring: LineString, row: Sequence[Run], near: float) -> LineString:
    """Line from the first point of a row to its last, along the ring between them."""
    first, last = row[0], max(row, key=lambda run: run.stop)
    points = shapely.get_coordinates(ring)[:-1]
    station = np.append(0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))
    is_closed = last.stop - first.start >= ring.length - near
    stop = first.start + ring.length if is_closed else last.stop
    station = np.concatenate([station, station + ring.length, station + 2.0 * ring.length])
    between = np.vstack([points] * 3)[(station > first.start) & (station < stop)]
    end = first.points[:1] if is_closed else last.points[-1:]
    line = LineString(np.concatenate([first.points[:1], between, end]))
    longest = max(row, key=lambda run: run.stop - run.start)
    return line if longest.is_forward else line.reverse()


def joint_of(row: Sequence[Run]) -> Doubt:
    """Say that the pieces of a row were joined, at the widest gap between them."""
    gaps = [b.start - stop_of(row[: k + 1]) for k, b in enumerate(row[1:])]
    k = int(np.argmax(gaps))
    reason = (
        f"its top is stored in {len(row)} pieces, {max(gaps[k], 0.0):.3g} apart at most: joined"
    )
    return Doubt(KIND, reason, Point(row[k + 1].points[0]))
