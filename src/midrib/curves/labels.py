"""Label lines: where the name of an area goes, along a curve with few bends in a wide part.

    ----------.                      .-----        The text fills a band along the line, as long
               '--------------------'              as it is, half its height to either side.
      ~~~~~~~~~  L A K E   N A M E  ~~~~~~~
               .------------.                      Candidates: polynomials of degree 1 to 3 that
    ----------'              '-------------        run along stretches of the area's spines.

A name is read from left to right, or upwards where that is steep; the more level it is the better.
A polynomial of degree 3 has two bends at most, and one change of direction between them.
"""

from typing import NamedTuple

import numpy as np
import shapely
from shapely import LineString, Polygon
from shapely.affinity import scale as scaled

from midrib.errors import InvalidAreaError
from midrib.layout import Scale
from midrib.types import Floats, Ints

__all__ = ["Label", "Wanted", "best_label"]

DEGREES = (1, 2, 3)
PLAINER = (1.0, 0.95, 0.9)  # what a size counts by degree: a tenth more is worth two bends
BENT, LEAST_LIKED = 0.3, 0.1  # less for a curve that turns by 90 degrees in all, and at the least
STEEP = np.radians(70.0)  # from there on a name is read upwards
UPRIGHT = 0.1  # less for a name that is upright
POINTS = 25  # of a line
LENGTHS, PLACES = 14, 29  # tried: lengths of a stretch, and its places, one in the very middle
TIED = 1e-6  # relative: sizes that differ by less are alike
SHORTEST = 1.0 / 64.0  # of the spine
LONGER = 1.06  # a stretch of spine than the line it makes
TIGHTEST = 1.5  # heights of text: the least radius that it is bent with
CLOSER = 0.35  # factor from round to round of looking nearer about the best ones
WORTH = (0.7, 0.9, 0.98, 0.999)  # of the best of all: a spine is looked at nearer, by round


class Wanted(NamedTuple):
    """What a label is to be like."""

    length: float | None
    height: float | None
    aspect: float  # length over height, where neither is given


class Label(NamedTuple):
    """A label line and the height of the text that fits along it."""

    line: LineString
    height: float


class Tried(NamedTuple):
    """Candidates: stretches of a spine, as shares of it, and degrees."""

    middle: Floats
    length: Floats
    degree: Ints


class Best(NamedTuple):
    """The best of the candidates along a spine."""

    size: float
    row: int
    label: Label


class Room(NamedTuple):
    """An area in lengths, and its boundary, both prepared."""

    area: Polygon
    boundary: shapely.Geometry


def best_label(area: Polygon, spines: list[LineString], scale: Scale, wanted: Wanted) -> Label:
    """Best label line of an area.

    Raises
    ------
    InvalidAreaError
        If there is no place for what is wanted.
    """
    plane = scaled(area, *scale, origin=(0, 0))
    room = Room(plane, plane.boundary)
    for part in room:
        shapely.prepare(part)
    lines = [scaled(spine, *scale, origin=(0, 0)) for spine in spines]
    tried = [first_tried(line.length, wanted) for line in lines]
    found = [best_of(room, *each, wanted) for each in zip(lines, tried, strict=True)]
    best = most_of(found)
    if best.size == 0.0:
        raise InvalidAreaError(refusal(wanted))
    rows = [one.row for one in found]
    spread = np.array([1.0 / PLACES, SHORTEST ** (-1.0 / LENGTHS) - 1.0])  # the second relative
    for worth in WORTH:
        for i, line in enumerate(lines):
            if found[i].size < worth * best.size:
                continue
            tried[i] = nearer(tried[i], rows[i], spread, wanted)
            other = best_of(room, line, tried[i], wanted)
            rows[i] = other.row
            if other.size > found[i].size * (1.0 + TIED):
                found[i] = other
        best = most_of(found)
        spread *= CLOSER
    points, height = shapely.get_coordinates(best.label.line), best.label.height
    if wanted.length is None and wanted.height is None:
        points = cut_to(points[None], wanted.aspect * height)[0][0]
        height = min(height, 2.0 * LineString(points).distance(room.boundary))
    return Label(inside(points / np.array(scale), area), height)


def most_of(found: list[Best]) -> Best:
    """Return the best of all, of several alike the first."""
    most = max(best.size for best in found)
    return next(best for best in found if best.size >= (1.0 - TIED) * most)


def best_of(room: Room, spine: LineString, tried: Tried, wanted: Wanted) -> Best:
    """Best of some candidates along a spine, to be read from its start."""
    points, long_enough = curves(spine, tried, wanted)
    points = read_from_start(points)
    turn = turns(points)
    heights = np.where(long_enough, heights_along(points, turn, *room), 0.0)
    lengths = np.hypot(*np.moveaxis(np.diff(points, axis=1), 2, 0)).sum(axis=1)
    straightness = 1.0 - BENT * (np.abs(turn).sum(axis=1) / np.radians(90.0)) ** 2
    liking = np.array(PLAINER)[tried.degree - 1] * np.maximum(straightness, LEAST_LIKED)
    size = sizes(lengths, heights, wanted) * liking * ease(points)
    k = most_central(size, tried.middle)
    height = height_of(lengths[k], heights[k], wanted)
    line = LineString(points[k] if tried.degree[k] > 1 else points[k][[0, -1]])
    return Best(float(size[k]), k, Label(line, height))


def read_from_start(points: Floats) -> Floats:
    """Curves turned to be read from their starts: eastwards, or upwards where they are steep."""
    x, y = (points[:, -1] - points[:, 0]).T
    is_steep = np.abs(y) > np.tan(STEEP) * np.abs(x)
    is_back = np.where(is_steep, y < 0.0, x < 0.0)
    turned: Floats = np.where(is_back[:, None, None], points[:, ::-1], points)
    return turned


def ease(points: Floats) -> Floats:
    """How easily each curve is read: less if steep, much less where it is upside down or falls."""
    x, y = np.moveaxis(np.diff(points, axis=1), 2, 0)
    length = np.maximum(np.hypot(x, y), np.finfo(float).tiny)
    is_bad = (x < -np.cos(STEEP) * length) | (y < -np.sin(STEEP) * length)
    bad = (length * is_bad).sum(axis=1) / length.sum(axis=1)
    along = points[:, -1] - points[:, 0]
    steep = np.abs(np.arctan2(along[:, 1], np.abs(along[:, 0]))) / np.radians(90.0)
    liked: Floats = (1.0 - UPRIGHT * steep**2) * np.maximum(1.0 - bad, LEAST_LIKED) ** 2
    return liked


def most_central(size: Floats, middle: Floats) -> int:
    """Return the largest candidate, of several alike the one in the middle of them."""
    tied = np.flatnonzero(size >= (1.0 - TIED) * size.max())
    return int(tied[np.argmin(np.abs(middle[tied] - middle[tied].mean()))])


def first_tried(spine: float, wanted: Wanted) -> Tried:
    """Stretches all along the spine, of many lengths or of the one that is wanted."""
    if wanted.length is None:
        length = np.geomspace(1.0, SHORTEST, LENGTHS)
    else:
        length = np.array([min(LONGER * wanted.length / spine, 1.0)])
    middle = (np.arange(PLACES) + 0.5) / PLACES
    grid = np.meshgrid(middle, length, DEGREES, indexing="ij")
    return Tried(*(part.ravel() for part in grid))


def nearer(tried: Tried, k: int, spread: Floats, wanted: Wanted) -> Tried:
    """Stretches about the best one."""
    offset = np.linspace(-1.0, 1.0, 9)
    length = np.array([tried.length[k]])
    if wanted.length is None:
        length = np.clip(length * (1.0 + spread[1] * offset), SHORTEST, 1.0)
    middle = np.clip(tried.middle[k] + spread[0] * offset, 0.0, 1.0)
    grid = np.meshgrid(middle, length, DEGREES, indexing="ij")
    return Tried(*(part.ravel() for part in grid))


def curves(spine: LineString, tried: Tried, wanted: Wanted) -> tuple[Floats, np.ndarray]:
    """Points (n, POINTS, 2) of the candidates, and which are long enough."""
    low = np.clip(tried.middle - tried.length / 2.0, 0.0, 1.0 - tried.length)
    place = low[:, None] + np.linspace(0.0, 1.0, POINTS) * tried.length[:, None]
    vertices = shapely.get_coordinates(spine)
    arc = np.append(0.0, np.cumsum(np.hypot(*np.diff(vertices, axis=0).T)))
    points = np.stack([np.interp(place, arc / arc[-1], c) for c in vertices.T], axis=2)
    fitted = np.empty_like(points)
    for degree in DEGREES:
        powers = np.linspace(-1.0, 1.0, POINTS)[:, None] ** np.arange(degree + 1)
        project = powers @ np.linalg.pinv(powers)  # onto polynomials, by least squares
        rows = tried.degree == degree
        fitted[rows] = project @ points[rows]
    return cut_to(fitted, wanted.length)


def cut_to(points: Floats, length: float | None) -> tuple[Floats, np.ndarray]:
    """Curves cut to a length about their middles, and which are as long as that."""
    if length is None:
        return points, np.ones(len(points), dtype=np.bool_)
    lines = shapely.linestrings(points)
    whole = shapely.length(lines)
    spare = np.maximum(whole - length, 0.0) / 2.0
    share = np.linspace(0.0, 1.0, points.shape[1])
    places = spare[:, None] + share * (whole - 2.0 * spare)[:, None]
    cut = shapely.line_interpolate_point(lines[:, None], places)
    return shapely.get_coordinates(cut).reshape(points.shape), whole >= length


def turns(points: Floats) -> Floats:
    """How far each curve turns left at its inner points."""
    step = np.diff(points, axis=1)
    cross = step[:, :-1, 0] * step[:, 1:, 1] - step[:, :-1, 1] * step[:, 1:, 0]
    turn: Floats = np.arctan2(cross, (step[:, :-1] * step[:, 1:]).sum(axis=2))
    return turn


def heights_along(
    points: Floats, turn: Floats, area: Polygon, boundary: shapely.Geometry
) -> Floats:
    """Height of the band that fits along each curve and is not bent too much, 0 outside."""
    lines, clear = shapely.linestrings(points), np.zeros(len(points))
    inside = shapely.covers(area, lines)
    clear[inside] = shapely.distance(boundary, lines[inside])
    length = np.hypot(*np.moveaxis(np.diff(points, axis=1), 2, 0))
    with np.errstate(divide="ignore", invalid="ignore"):
        middle = (length[:, 1:] + length[:, :-1]) / 2.0
        radius = np.where(turn != 0.0, middle / np.abs(turn), np.inf)
    heights: Floats = np.minimum(2.0 * clear, radius.min(axis=1) / TIGHTEST)
    return heights


def sizes(length: Floats, height: Floats, wanted: Wanted) -> Floats:
    """How good candidates are: what is to be as large as it can, 0 if they will not do."""
    if wanted.height is not None:
        fits = height >= wanted.height
        return np.where(fits, height if wanted.length is not None else length, 0.0)
    if wanted.length is not None:
        return height
    return np.minimum(height, length / wanted.aspect)


def height_of(length: float, height: float, wanted: Wanted) -> float:
    """Height of the text along a line."""
    if wanted.height is not None:
        return wanted.height
    return float(height if wanted.length is not None else min(height, length / wanted.aspect))


def refusal(wanted: Wanted) -> str:
    """Say what there is no place for."""
    parts = [
        f"{value:.6g} {name}"
        for value, name in ((wanted.length, "long"), (wanted.height, "high"))
        if value is not None
    ]
    return f"there is no place for a name {' and '.join(parts) or 'of any size'}"


def inside(points: Floats, area: Polygon) -> LineString:
    """Line of points that the area covers, as it did where lengths are alike in x and y.

    Raises
    ------
    InvalidAreaError
        If rounding has put it outside.
    """
    line = LineString(points)
    if not area.covers(line):
        msg = "the label line is on the boundary but for rounding"
        raise InvalidAreaError(msg)
    return line
