"""What a drawing holds: objects with their symbols, and objects that could not be drawn."""

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pyarrow as pa
import shapely

from midrib.formats.writing import Features

if TYPE_CHECKING:
    from shapely import Point

    from midrib.formats.drawing.heights import Relief
    from midrib.formats.reading import Geometries
    from midrib.hatching.drawn import Symbols
    from midrib.hatching.standard import Standard
    from midrib.types import Bools, Floats, Ints

__all__ = [
    "AREAS",
    "EDGES",
    "LEFT_OUT",
    "LINES",
    "PROBLEMS",
    "REFUSED",
    "Drawing",
    "Drawn",
    "Trouble",
    "layers_of",
]

# Kinds of problems, beside those of readers and checks: an object not drawn, or not to be drawn.
REFUSED, LEFT_OUT = "refused", "left out"
LINES, AREAS, EDGES, PROBLEMS = "strokes", "symbols", "outlines", "problems"
GEOMETRY = "geom"


@dataclass(frozen=True)
class Drawn:
    """An object and what is drawn of it."""

    id: str
    kind: str
    symbols: "Symbols"
    is_long: "Bools | None" = None  # of each stroke, if it is made of strokes
    width: "Floats | None" = None  # of the object at each stroke, from top to toe
    attributes: dict[str, object] = field(default_factory=dict)  # what its register says of it
    relief: "Relief | None" = None  # its heights, if both edges have them all along
    n_excluded: int = 0  # strokes that zones have taken


class Trouble(NamedTuple):
    """Something that is not drawn, or not as it should be."""

    id: str
    reason: str
    where: "Point | None" = None
    kind: str = REFUSED


@dataclass
class Drawing:
    """Objects to draw on a map.

    Attributes
    ----------
    scale : float
        500 for 1:500.
    crs : str or None
        PROJJSON.
    metres_per_unit : float
        Length of a coordinate unit.
    objects : list of Drawn
    problems : list of Trouble
    """

    scale: float
    crs: str | None = None
    metres_per_unit: float = 1.0
    objects: list[Drawn] = field(default_factory=list)
    problems: list[Trouble] = field(default_factory=list)

    @property
    def millimetre(self) -> float:
        """Length of a millimetre on paper, in coordinate units."""
        return self.scale / 1000.0 / self.metres_per_unit

    @property
    def standards(self) -> "dict[str, Standard]":
        """Standards of the objects by name, in alphabetical order."""
        found = {drawn.symbols.standard.name: drawn.symbols.standard for drawn in self.objects}
        return dict(sorted(found.items()))

    @property
    def n_refused(self) -> int:
        """Number of objects that should have been drawn and are not."""
        return len({trouble.id for trouble in self.problems if trouble.kind == REFUSED})

    @property
    def n_excluded(self) -> int:
        """Number of strokes that zones have taken."""
        return sum(drawn.n_excluded for drawn in self.objects)

    @property
    def is_blank(self) -> bool:
        """Whether there is nothing to see: no object, and no problem with a place."""
        return not self.objects and all(trouble.where is None for trouble in self.problems)

    @property
    def has_symbols(self) -> bool:
        """Whether there is a stroke or a symbol in it; outlines are none."""
        return any(drawn.symbols.count for drawn in self.objects)

    @property
    def n_raised(self) -> int:
        """Number of objects whose heights are known."""
        return sum(drawn.relief is not None for drawn in self.objects)

    @property
    def bounds(self) -> "Floats":
        """Least and largest x and y of everything that is drawn, zeros if there is nothing."""
        ink = [
            geometry
            for drawn in self.objects
            for part in (drawn.symbols.flat(),)
            for geometry in (*part.lines, *part.areas, *part.edges)
        ]
        ink += [trouble.where for trouble in self.problems if trouble.where is not None]
        x_low, y_low, x_high, y_high = shapely.total_bounds([*ink, None])
        corners = np.array([[x_low, y_low], [x_high, y_high]])
        return corners if np.isfinite(corners).all() else np.zeros((2, 2))


def layers_of(drawing: Drawing) -> list[Features]:
    """Layers of a drawing: strokes always, others if there is something in them."""
    flat = [in_space(drawing, drawn) for drawn in drawing.objects]
    layers = [
        Features(
            LINES,
            *rows(drawing, [(s.lines, s.line_stroke) for s in flat]),
            GEOMETRY,
            "LineString",
            drawing.crs,
        ),
        Features(
            AREAS,
            *rows(drawing, [(s.areas, s.area_stroke) for s in flat]),
            GEOMETRY,
            "Polygon",
            drawing.crs,
        ),
        Features(EDGES, *edge_rows(drawing, flat), GEOMETRY, "LineString", drawing.crs),
        Features(PROBLEMS, *problem_rows(drawing), GEOMETRY, "Point", drawing.crs),
    ]
    return [layer for layer in layers if layer.layer == LINES or layer.geometries.size]


def in_space(drawing: Drawing, drawn: Drawn) -> "Symbols":
    """Return what is drawn of an object, with heights if any object has some, 0 for unknown ones.

    Z for some of a layer only would leave it without a kind of geometry.
    """
    flat = drawn.symbols.flat()
    if drawing.n_raised == 0:
        return flat
    lifted = shapely.force_3d if drawn.relief is None else drawn.relief.lifted
    return replace(
        flat, lines=lifted(flat.lines), areas=lifted(flat.areas), edges=lifted(flat.edges)
    )


def rows(drawing: Drawing, drawn: "list[tuple[Geometries, Ints]]") -> "tuple[pa.Table, Geometries]":
    """Rows of a layer of strokes or of areas: which object, which stroke, how it is."""
    columns: dict[str, list[Any]] = {
        name: [] for name in ("area", "kind", "standard", "stroke", "is_long", "width")
    }
    for one, (geometries, stroke) in zip(drawing.objects, drawn, strict=True):
        n = len(geometries)
        columns["area"] += [one.id] * n
        columns["kind"] += [one.kind] * n
        columns["standard"] += [one.symbols.standard.name] * n
        columns["stroke"] += stroke.tolist()
        for name, values in (("is_long", one.is_long), ("width", one.width)):
            columns[name] += [None] * n if values is None else values[stroke].tolist()
    kinds = (pa.string(), pa.string(), pa.string(), pa.int64(), pa.bool_(), pa.float64())
    table = {
        name: pa.array(values, type=kind)
        for (name, values), kind in zip(columns.items(), kinds, strict=True)
    }
    geometries = joined([geometries for geometries, _ in drawn])
    lengths = shapely.length(geometries) if geometries.size else np.empty(0)
    return pa.table(table | {"length": pa.array(lengths, type=pa.float64())}), geometries


def edge_rows(drawing: Drawing, drawn: "list[Symbols]") -> "tuple[pa.Table, Geometries]":
    """Rows of the layer of outlines."""
    whose = [drawn for drawn in drawing.objects for _ in drawn.symbols.edges]
    table = {
        "area": [drawn.id for drawn in whose],
        "kind": [drawn.kind for drawn in whose],
        "standard": [drawn.symbols.standard.name for drawn in whose],
    }
    columns = {name: pa.array(values, type=pa.string()) for name, values in table.items()}
    return pa.table(columns), joined([symbols.edges for symbols in drawn])


def problem_rows(drawing: Drawing) -> "tuple[pa.Table, Geometries]":
    """Rows of the layer of problems, numbered as their marks in DXF are."""
    numbers = pa.array(range(1, len(drawing.problems) + 1), type=pa.int64())
    table = {
        "area": [trouble.id for trouble in drawing.problems],
        "problem": [trouble.kind for trouble in drawing.problems],
        "reason": [trouble.reason for trouble in drawing.problems],
    }
    columns = {name: pa.array(values, type=pa.string()) for name, values in table.items()}
    points = np.empty(len(drawing.problems), dtype=object)
    points[:] = [trouble.where for trouble in drawing.problems]
    return pa.table({"number": numbers} | columns), points


def joined(parts: "list[Geometries]") -> "Geometries":
    """One array of geometries from many."""
    return np.concatenate([np.empty(0, dtype=object), *parts])
