"""What a reader of slopes gathers: slopes, problems, and points of known height on their edges."""

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import count
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.errors import InvalidAreaError
from midrib.formats.tops import Top, joined_tops
from midrib.hatching.edges import NEAR, Doubt, Edges, edges_along, edges_between, mean_width
from midrib.hatching.slope import Slope, SlopeError, SlopeProblem
from midrib.ragged import place_text

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Gathered", "Top", "check_area", "is_height", "place_of"]

ON_EDGE = 0.01  # of the mean width: points this near are on an edge
UNKNOWN = 0.0  # what registers write for a height that nobody has measured
PLACE = re.compile(r"\[([-+.\deE]+) ([-+.\deE]+)")


@dataclass
class Gathered:
    """Slopes of a file, in its order, and what is wrong with it."""

    slopes: list[Slope] = field(default_factory=list)
    problems: list[SlopeProblem] = field(default_factory=list)
    heights: "list[tuple[float, float, float]]" = field(default_factory=list)  # x, y, height

    @contextmanager
    def refusing(self, identifier: str) -> Iterator[None]:
        """Note what is no slope, and go on."""
        try:
            yield
        except InvalidAreaError as error:
            where = error.where if isinstance(error, SlopeError) else None
            self.problems.append(SlopeProblem(identifier, "refused", str(error), where))

    def add(self, slope: Slope, doubts: Sequence[Doubt] = ()) -> None:
        """Keep a slope, and what is doubtful about its edges."""
        self.slopes.append(slope)
        self.problems += [SlopeProblem(slope.id, *doubt) for doubt in doubts]

    def add_sides(
        self,
        identifier: str,
        areas: Sequence[Polygon],
        tops: Sequence[Top],
        slope: Callable[[str, Polygon, Edges], Slope],
    ) -> None:
        """Keep one slope for each top of an object, on the part of the object's area that it is on.

        Tops that follow each other along a part are one.
        ``slope`` makes it from its name, its area and its edges.
        """
        on_part: dict[int, list[Top]] = {}
        for top in tops:
            nearest = int(np.argmin([off(area, top) for area in areas]))
            on_part.setdefault(nearest, []).append(top)
        joined = {k: joined_tops(areas[k], some) for k, some in on_part.items()}
        n_sides = sum(len(some) for some, _ in joined.values())
        sides = count(1)
        for k, (some, doubts) in joined.items():
            for i, top in enumerate(some):
                own = f"{identifier}/{next(sides)}" if n_sides > 1 else identifier
                with self.refusing(own):
                    edges = edges_of(check_area(areas[k]), top)
                    if i == 0:
                        self.add(slope(own, areas[k], edges), [*edges.doubts, *doubts])
                    elif not edges.top.is_closed:  # a hole is the top of all sides at once
                        raise another_top(areas[k], top, some[:i])
        for k, area in enumerate(areas):
            if k not in on_part:
                with self.refusing(identifier):
                    msg = f"part {k + 1} of {len(areas)} of its area has no top"
                    raise SlopeError(msg, shapely.get_coordinates(area)[0])

    def result(self) -> tuple[list[Slope], list[SlopeProblem]]:
        """Slopes with the heights that are known on their edges, and problems."""
        rows = np.array(self.heights, dtype=np.float64).reshape(-1, 3)
        points = shapely.points(rows[:, :2])
        tree = shapely.STRtree(points)
        return [with_heights(slope, rows, points, tree) for slope in self.slopes], self.problems


def with_heights(slope: Slope, rows: "Floats", points: "Floats", tree: shapely.STRtree) -> Slope:
    """Slope with those of the points that are on an edge, after what it knows of itself."""
    near = ON_EDGE * mean_width(slope.area)
    found = tree.query(slope.area, predicate="dwithin", distance=near)
    known: dict[str, Floats | None] = {}
    for name, edge in (("top_heights", slope.top), ("toe_heights", slope.toe)):
        own = getattr(slope, name)
        on_edge = rows[found[shapely.distance(points[found], edge) <= near]]
        all_known = [heights_of(edge), on_edge, *([] if own is None else [own])]
        heights = np.concatenate(all_known)
        known[name] = heights if len(heights) else None
    return replace(slope, **known)  # type: ignore[arg-type]


def heights_of(edge: LineString) -> "Floats":
    """Vertices of an edge whose height is known."""
    if not edge.has_z:
        return np.empty((0, 3))
    rows: Floats = shapely.get_coordinates(edge, include_z=True)
    return rows[[is_height(z) for z in rows[:, 2]]]


def is_height(value: float) -> bool:
    """Whether a number is a measured height."""
    return bool(np.isfinite(value)) and value != UNKNOWN


def off(area: Polygon, top: Top) -> float:
    """How far a top is from the boundary of an area, in all."""
    corners = shapely.get_coordinates(top) if isinstance(top, LineString) else np.array(top)
    return float(shapely.distance(shapely.points(corners[:, :2]), area.boundary).sum())


def another_top(area: Polygon, top: Top, others: Sequence[Top]) -> SlopeError:
    """Say that a top is on a part of an area that has others, and how far from them."""
    apart, near = min(distance(top, other) for other in others), NEAR * mean_width(area)
    msg = (
        f"two tops are on the same part of its area, {apart:.3g} apart, expected a part for each "
        f"side, or {near:.3g} at most"
    )
    start = shapely.get_coordinates(top)[0] if isinstance(top, LineString) else top[0]
    return SlopeError(msg, start)


def distance(top: Top, other: Top) -> float:
    """How far two tops are apart; of those with start and end, those points are."""
    first, second = (
        one if isinstance(one, LineString) else shapely.multipoints(np.array(one)[:, :2])
        for one in (top, other)
    )
    return float(shapely.distance(first, second))


def edges_of(area: Polygon, top: Top) -> Edges:
    """Divide the boundary of an area by its top, however that is told.

    Raises
    ------
    SlopeError
        If the top is not on the boundary.
    """
    return edges_along(area, top) if isinstance(top, LineString) else edges_between(area, *top)


def check_area(area: object) -> Polygon:
    """Return an area that can be divided.

    Raises
    ------
    SlopeError
        If it is no valid Polygon.
    """
    if not isinstance(area, Polygon) or area.is_empty:
        kind = getattr(area, "geom_type", "nothing")
        empty = "an empty " * bool(getattr(area, "is_empty", False))
        msg = f"its geometry is {empty}{kind}, expected a Polygon"
        raise SlopeError(msg, place_of(area))
    if not np.isfinite(shapely.get_coordinates(area)).all():
        msg = "its area has a coordinate that is not finite"
        raise SlopeError(msg)
    if not area.is_valid:
        reason = shapely.is_valid_reason(area)
        place = PLACE.search(reason)
        where = None if place is None else np.array([float(place[1]), float(place[2])])
        at = "" if where is None else f" at {place_text(where)}"
        msg = f"its area is not valid: {reason.partition('[')[0]}{at}"
        raise SlopeError(msg, where)
    return area


def place_of(geometry: object) -> "Floats | None":
    """First point of a geometry, None if it has none."""
    points = shapely.get_coordinates(geometry)
    return points[0] if len(points) else None
