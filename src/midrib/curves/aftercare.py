"""After-care: simpler and smoother lines that still lie in their areas.

Both change a line piece by piece, and keep a change only where the new piece is covered by the
area and the line does not meet itself; elsewhere the line stays what it was. All lines are worked
on together, a round at a time: a round has one call for all pieces that it tries.

simplify  a run of vertices becomes a segment, as long as none of them is farther from it than
          the stated deviation; else the farthest one is kept and both halves are tried
smooth    a corner v between u and w becomes two points, a quarter of the way to u and to w, but
          no farther from v than half its radius, so that nothing comes near the boundary

                 v
                 .
            .....+.....            the disc around v in the area has the radius of v
           .   .   .   .
          . u.       .w .

Sources: Douglas and Peucker 1973 (simplify); Chaikin 1974 (smooth).
"""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import LineString
from shapely.geometry.base import BaseGeometry

from midrib.checks import check_flag, is_number, shown
from midrib.errors import ParameterError
from midrib.geodesy import lengths_at
from midrib.kernels.clearance import clearances
from midrib.kernels.simplification import farthest_vertices
from midrib.types import Bools, Floats, Ints

__all__ = ["Aftercare", "aftercare", "tend"]

Geometries = np.ndarray[tuple[int], np.dtype[np.object_]]
ROUNDS = 3  # of corner cutting: a right angle becomes turns of 11 degrees and less
QUARTER, HALF = 0.25, 0.5
LEAST_RADIUS = 1.0 / 64.0  # of the mean width; a corner nearer to the boundary stays
FLAT = np.tan(np.radians(1.0))  # tangent of a turn that nobody sees


class Aftercare(NamedTuple):
    """What is done to lines once they are found."""

    max_deviation: float | None  # of the simplified line, in coordinate units
    share: float | None  # or as a share of the mean width
    smooth: bool

    @property
    def is_wanted(self) -> bool:
        """Whether there is anything to do."""
        return self.smooth or self.max_deviation is not None or self.share is not None


def aftercare(simplify: float | str | None = None, smooth: bool = False) -> Aftercare:
    """Check the options of after-care and return them as one rule.

    Raises
    ------
    ParameterError
        If ``simplify`` is neither a length nor a percentage.
    """
    check_flag(smooth, "smooth")
    if simplify is None:
        return Aftercare(None, None, bool(smooth))
    is_share = isinstance(simplify, str) and simplify.strip().endswith("%")
    try:
        value = float(simplify.strip().removesuffix("%")) if is_share else simplify  # type: ignore[union-attr]
    except ValueError:
        value = simplify
    if not (is_number(value) and 0.0 <= float(value) < np.inf):
        msg = (
            f"simplify is {shown(simplify)}, expected a length, or a share of the width such as "
            "'5%'"
        )
        raise ParameterError(msg)
    if is_share:
        return Aftercare(None, float(value) / 100.0, bool(smooth))
    return Aftercare(float(value), None, bool(smooth))


def tend(
    lines: list[LineString | None],
    areas: list[BaseGeometry],
    care: Aftercare,
    *,
    geographic: bool = False,
) -> list[LineString | None]:
    """Simplify and smooth lines inside their areas.

    Parameters
    ----------
    lines : list of LineString or None
        Simple lines, each covered by its area. Z is carried along.
    areas : list of Polygon
        The area of each line.
    care : Aftercare
        What to do. Simplification comes first.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude; lengths are in metres then.

    Returns
    -------
    list of LineString or None
        Simple lines from the same start to the same end, covered by their areas. Every point of
        a simplified line is within the deviation of the full one, and the other way round. A
        corner at the boundary stays.
    """
    there = [i for i, line in enumerate(lines) if line is not None and not line.is_empty]
    if not there or not care.is_wanted:
        return lines
    chains = chains_of(object_array([lines[i] for i in there]), areas, there, geographic)
    shapely.prepare(chains.areas)
    if care.max_deviation is not None or care.share is not None:
        chains = proven(simplified(chains, deviations(chains, care)), chains)
    if care.smooth:
        boundaries = boundaries_of(chains)
        for _ in range(ROUNDS):
            chains = proven(with_corners_cut(chains, boundaries), chains)
    tended = list(lines)
    for i, line in zip(there, chains.lines(), strict=True):
        tended[i] = line
    return tended


class Chains(NamedTuple):
    """Lines as one array of vertices, and their areas."""

    points: Floats  # (n, 3) the third is NaN where a line has no Z
    line: Ints  # (n,) the line each vertex is of
    scale: Floats  # (k, 2) lengths of one unit of x and of y
    has_z: Bools  # (k,)
    areas: Geometries  # (k,)

    def lines(self) -> Geometries:
        """Return the geometries."""
        rows = np.split(self.points, np.flatnonzero(np.diff(self.line)) + 1)
        return object_array(
            [LineString(row if z else row[:, :2]) for row, z in zip(rows, self.has_z, strict=True)]
        )

    def flat(self) -> Geometries:
        """Return the geometries without Z."""
        lines: Geometries = shapely.linestrings(self.points[:, :2], indices=self.line)
        return lines

    def scaled(self) -> Floats:
        """Return the vertices (n, 2) in lengths."""
        return self.points[:, :2] * self.scale[self.line]

    def ends(self) -> Bools:
        """Which vertices are the first or the last of their line."""
        turn = np.diff(self.line) != 0
        ends: Bools = np.append(True, turn) | np.append(turn, True)
        return ends

    def covers(self, first: Floats, last: Floats, line: Ints) -> Bools:
        """Whether the segments from first to last are covered by the areas of the lines."""
        segments = shapely.linestrings(np.stack([first[:, :2], last[:, :2]], axis=1))
        covered: Bools = shapely.covers(self.areas[line], segments).astype(np.bool_)
        return covered


def chains_of(
    lines: Geometries, areas: list[BaseGeometry], there: list[int], geographic: bool
) -> Chains:
    """Vertices of lines that are there, with the areas they are in."""
    # Copies, since they will be prepared: callers may share theirs among threads.
    inside: Geometries = shapely.force_2d(object_array([areas[i] for i in there]))
    points, line = shapely.get_coordinates(lines, include_z=True, return_index=True)
    scale = np.ones((lines.size, 2))
    if geographic:
        bounds = shapely.bounds(inside)
        scale = np.column_stack(lengths_at((bounds[:, 1] + bounds[:, 3]) / 2.0))
    return Chains(points, line, scale, shapely.has_z(lines), inside)


def deviations(chains: Chains, care: Aftercare) -> Floats:
    """Greatest deviation for each line."""
    if care.max_deviation is not None:
        return np.full(chains.areas.size, care.max_deviation)
    return (care.share or 0.0) * mean_widths(chains)


def mean_widths(chains: Chains) -> Floats:
    """Mean width of each area: itself over its line's length."""
    goes_on = np.diff(chains.line) == 0
    steps = np.hypot(*np.diff(chains.scaled(), axis=0).T)[goes_on]
    length = np.bincount(chains.line[1:][goes_on], steps, minlength=chains.areas.size)
    widths: Floats = shapely.area(chains.areas) * chains.scale.prod(axis=1) / length
    return widths


def simplified(chains: Chains, max_deviation: Floats) -> Chains:
    """Chains with as few vertices as Douglas and Peucker find, inside their areas and simple.

    A run that is not replaced is split at its farthest vertex, whatever the reason: so the vertices
    that are kept would be kept again, and simplifying twice is simplifying once.
    """
    x, y = chains.scaled().T.copy()
    keep = chains.ends()
    first, last = runs(np.flatnonzero(keep), chains.line)
    while first.size:
        while first.size:
            first, last = split_runs(chains, x, y, first, last, max_deviation, keep)
        first, last = crossing_runs(chains, keep)
        far, _ = farthest_vertices(x, y, first, last)
        keep[far] = True
        first, last = np.concatenate([first, far]), np.concatenate([far, last])
    return chains._replace(points=chains.points[keep], line=chains.line[keep])


def runs(kept: Ints, line: Ints) -> tuple[Ints, Ints]:
    """First and last row of each run between two kept rows of one line."""
    goes_on = line[kept[:-1]] == line[kept[1:]]
    return kept[:-1][goes_on], kept[1:][goes_on]


def split_runs(
    chains: Chains,
    x: Floats,
    y: Floats,
    first: Ints,
    last: Ints,
    max_deviation: Floats,
    keep: Bools,
) -> tuple[Ints, Ints]:
    """Halves of the runs that no segment can replace; keeps the vertices between the halves."""
    far, off = farthest_vertices(x, y, first, last)
    is_open = far >= 0
    first, last, far, off = first[is_open], last[is_open], far[is_open], off[is_open]
    line, points = chains.line[first], chains.points
    is_fine = (off <= max_deviation[line]) & ((x[first] != x[last]) | (y[first] != y[last]))
    tried = np.flatnonzero(is_fine)
    is_fine[tried] = chains.covers(points[first[tried]], points[last[tried]], line[tried])
    first, last, far = first[~is_fine], last[~is_fine], far[~is_fine]
    keep[far] = True
    return np.concatenate([first, far]), np.concatenate([far, last])


def crossing_runs(chains: Chains, keep: Bools) -> tuple[Ints, Ints]:
    """Return the runs whose segments make a line meet itself, and that can still be split."""
    kept = np.flatnonzero(keep)
    candidate = chains._replace(points=chains.points[kept], line=chains.line[kept])
    first, last = runs(kept, chains.line)
    crossing = np.zeros(first.size, dtype=np.bool_)
    can_split = last - first > 1
    for i in np.flatnonzero(~shapely.is_simple(candidate.flat())):
        own = np.flatnonzero(chains.line[first] == i)
        meeting = own[meeting_segments(chains.points[first[own]], chains.points[last[own]])]
        meeting = meeting[can_split[meeting]]
        crossing[meeting if meeting.size else own[can_split[own]]] = True
    return first[crossing], last[crossing]


def meeting_segments(first: Floats, last: Floats) -> Ints:
    """Which segments of one chain meet another that is not next to them."""
    segments = shapely.linestrings(np.stack([first[:, :2], last[:, :2]], axis=1))
    one, other = shapely.STRtree(segments).query(segments, predicate="intersects")
    meeting: Ints = np.unique(one[np.abs(one - other) > 1])
    return meeting


class Boundaries(NamedTuple):
    """Boundaries of areas, in lengths, as ``kernels.clearance`` takes them."""

    x: Floats
    y: Floats
    goes_on: Bools
    offsets: Ints


def boundaries_of(chains: Chains) -> Boundaries:
    """Boundaries of the areas of chains."""
    rings, area = shapely.get_rings(shapely.get_parts(chains.areas), return_index=True)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    x, y = (points * chains.scale[area[ring]]).T.copy()
    goes_on = np.append(ring[:-1] == ring[1:], False)
    offsets = np.searchsorted(area[ring], np.arange(chains.areas.size + 1))
    return Boundaries(x, y, goes_on, offsets)


def with_corners_cut(chains: Chains, boundaries: Boundaries) -> Chains:
    """Chains with their corners cut, but for those whose cut would do harm."""
    share = cut_shares(chains, boundaries)
    while share.any():
        cut, vertex = cut_corners(chains, share)
        bad = bad_corners(chains, cut, vertex, share)
        if bad.size == 0:
            bad = crossing_corners(cut, vertex, share)
        if bad.size == 0:
            return cut
        share[bad] = 0.0
    return chains


def cut_shares(chains: Chains, boundaries: Boundaries) -> Floats:
    """How much of the segments before and after each vertex (n, 2) to cut off."""
    share = np.zeros((chains.line.size, 2))
    corner = np.flatnonzero(is_corner(chains))
    points, line = chains.scaled(), chains.line[corner]
    x, y = points[corner].T.copy()
    first = np.searchsorted(line, np.arange(chains.areas.size + 1))
    radius = clearances(
        x, y, first, boundaries.x, boundaries.y, boundaries.goes_on, boundaries.offsets
    )
    is_free = radius >= LEAST_RADIUS * mean_widths(chains)[line]
    corner, reach = corner[is_free], HALF * radius[is_free]
    for side, neighbour in enumerate((corner - 1, corner + 1)):
        length = np.hypot(*(points[neighbour] - points[corner]).T)
        share[corner, side] = np.minimum(QUARTER, reach / length)
    return share


def is_corner(chains: Chains) -> Bools:
    """Which vertices turn so much that one sees it."""
    step = np.diff(chains.scaled(), axis=0)
    cross = step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]
    dot = (step[:-1] * step[1:]).sum(axis=1)
    corner = ~chains.ends()
    corner[1:-1] &= np.abs(cross) > FLAT * dot
    return corner


def cut_corners(chains: Chains, share: Floats) -> tuple[Chains, Ints]:
    """Cut each corner by shares of its two segments; also the vertex that each point is from."""
    is_cut = share[:, 0] > 0.0
    vertex = np.repeat(np.arange(is_cut.size), 1 + is_cut)
    is_second = np.append(False, vertex[1:] == vertex[:-1])
    moves = is_cut[vertex]
    origin, side = vertex[moves], is_second[moves].astype(np.intp)
    points = chains.points[vertex]
    toward = chains.points[origin + 2 * side - 1] - points[moves]
    points[moves] += share[origin, side][:, None] * toward
    return chains._replace(points=points, line=chains.line[vertex]), vertex


def bad_corners(chains: Chains, cut: Chains, vertex: Ints, share: Floats) -> Ints:
    """Corners whose cut makes a piece that rounding takes out of the area, or of no length."""
    is_cut = share[:, 0] > 0.0
    is_new = is_cut[vertex[:-1]] | is_cut[vertex[1:]]
    piece = np.flatnonzero(is_new & (cut.line[:-1] == cut.line[1:]))
    first, last = cut.points[piece], cut.points[piece + 1]
    is_fine = (first[:, :2] != last[:, :2]).any(axis=1)
    is_fine[is_fine] = chains.covers(first[is_fine], last[is_fine], cut.line[piece[is_fine]])
    bad: Ints = vertex[piece[~is_fine] + [[0], [1]]].ravel()
    return bad[is_cut[bad]]


def crossing_corners(cut: Chains, vertex: Ints, share: Floats) -> Ints:
    """Corners whose cuts make a line meet itself; all of a line's if it is not clear which."""
    found = [np.empty(0, dtype=np.intp)]
    for i in np.flatnonzero(~shapely.is_simple(cut.flat())):
        own = np.flatnonzero(cut.line == i)
        meeting = own[meeting_segments(cut.points[own[:-1]], cut.points[own[1:]])]
        corners = vertex[np.concatenate([meeting, meeting + 1])]
        corners = corners[share[corners, 0] > 0.0]
        found.append(corners if corners.size else vertex[own])
    corners = np.concatenate(found)
    is_cut: Bools = share[corners, 0] > 0.0
    return corners[is_cut]


def proven(new: Chains, old: Chains) -> Chains:
    """Take the new chains, but the old one wherever rounding has spoilt a line as a whole."""
    lines = new.flat()
    is_fine = shapely.covers(new.areas, lines) & shapely.is_simple(lines)
    if is_fine.all():
        return new
    points = np.concatenate([new.points[is_fine[new.line]], old.points[~is_fine[old.line]]])
    line = np.concatenate([new.line[is_fine[new.line]], old.line[~is_fine[old.line]]])
    order = np.argsort(line, kind="stable")
    return new._replace(points=points[order], line=line[order])


def object_array(items: list[LineString | None] | list[BaseGeometry]) -> Geometries:
    """Geometries as an array."""
    array = np.empty(len(items), dtype=object)
    array[:] = items
    return array
