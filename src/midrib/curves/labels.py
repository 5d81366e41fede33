"""Label lines: where the name of an area goes, along a curve with few bends in its widest part.

    ----------.                      .-----        The text fills a band along the line, as long
               '--------------------'              as it is, half its height to either side.
      ~~~~~~~~~  L A K E   N A M E  ~~~~~~~
               .------------.                      Candidates: polynomials of degree 1 to 3 that
    ----------'              '-------------        run along stretches of the area's trunk.

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
POINTS = 25  # of a line
LENGTHS, PLACES = 14, 29  # tried: lengths of a stretch, and its places, one in the very middle
TIED = 1e-6  # relative: sizes that differ by less are alike
SHORTEST = 1.0 / 64.0  # of the trunk
LONGER = 1.06  # a stretch of trunk than the line it makes
TIGHTEST = 1.5  # heights of text: the least radius that it is bent with
ROUNDS, CLOSER = 5, 0.35  # of looking nearer about the best one, by this factor


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
    """Candidates: stretches of the trunk, as shares of it, and degrees."""

    middle: Floats
    length: Floats
    degree: Ints


def best_label(area: Polygon, trunk: LineString, scale: Scale, wanted: Wanted) -> Label:
    """Best label line of an area.

    Raises
    ------
    InvalidAreaError
        If there is no place for what is wanted.
    """
    plane = scaled(area, *scale, origin=(0, 0))
    line = scaled(trunk, *scale, origin=(0, 0))
    shapely.prepare(plane)
    boundary = plane.boundary
    shapely.prepare(boundary)
    tried = first_tried(line.length, wanted)
    most, best, height = 0.0, np.empty((0, 2)), 0.0
    spread = np.array([1.0 / PLACES, SHORTEST ** (-1.0 / LENGTHS) - 1.0])  # the second relative
    for _ in range(ROUNDS):
        points, long_enough = curves(line, tried, wanted)
        turn = turns(points)
        heights = np.where(long_enough, heights_along(points, turn, plane, boundary), 0.0)
        lengths = np.hypot(*np.moveaxis(np.diff(points, axis=1), 2, 0)).sum(axis=1)
        straightness = 1.0 - BENT * (np.abs(turn).sum(axis=1) / np.radians(90.0)) ** 2
        liking = np.array(PLAINER)[tried.degree - 1] * np.maximum(straightness, LEAST_LIKED)
        size = sizes(lengths, heights, wanted) * liking
        k = most_central(size, tried.middle)
        if size[k] > most * (1.0 + TIED):
            most, height = float(size[k]), height_of(lengths[k], heights[k], wanted)
            best = points[k] if tried.degree[k] > 1 else points[k][[0, -1]]
        tried = nearer(tried, k, spread, wanted)
        spread *= CLOSER
    if most == 0.0:
        raise InvalidAreaError(refusal(wanted))
    if wanted.length is None and wanted.height is None:
        best = cut_to(best[None], wanted.aspect * height)[0][0]
        height = min(height, 2.0 * LineString(best).distance(boundary))
    return Label(reading(best / np.array(scale), area), height)


def most_central(size: Floats, middle: Floats) -> int:
    """Return the largest candidate, of several alike the one in the middle of them."""
    tied = np.flatnonzero(size >= (1.0 - TIED) * size.max())
    return int(tied[np.argmin(np.abs(middle[tied] - middle[tied].mean()))])


def first_tried(trunk: float, wanted: Wanted) -> Tried:
    """Stretches all along the trunk, of many lengths or of the one that is wanted."""
    if wanted.length is None:
        length = np.geomspace(1.0, SHORTEST, LENGTHS)
    else:
        length = np.array([min(LONGER * wanted.length / trunk, 1.0)])
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


def curves(trunk: LineString, tried: Tried, wanted: Wanted) -> tuple[Floats, np.ndarray]:
    """Points (n, POINTS, 2) of the candidates, and which are long enough."""
    low = np.clip(tried.middle - tried.length / 2.0, 0.0, 1.0 - tried.length)
    place = low[:, None] + np.linspace(0.0, 1.0, POINTS) * tried.length[:, None]
    vertices = shapely.get_coordinates(trunk)
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


def reading(points: Floats, area: Polygon) -> LineString:
    """Line to be read from its start: eastwards, or northwards if it is upright."""
    along = points[-1] - points[0]
    line = LineString(points if (along[0], along[1]) > (0.0, 0.0) else points[::-1])
    if not area.covers(line):  # it was covered where lengths are alike in x and y
        msg = "the label line is on the boundary but for rounding"
        raise InvalidAreaError(msg)
    return line
