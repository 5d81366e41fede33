"""Slopes of any vector layer: areas, with what other layers or fields tell of their tops."""

from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np
import shapely
from shapely import LineString, MultiPolygon, Point, Polygon

from midrib.errors import ParameterError
from midrib.formats.bdot500 import kind_of
from midrib.formats.contents import (
    choose_layer,
    column_names,
    driver_of,
    layer_names,
    listed,
    may_hold_areas,
)
from midrib.formats.gathering import Gathered, check_area, place_of
from midrib.formats.guides import check_layer, guides_for
from midrib.formats.pairs import add_pairs
from midrib.formats.reading import open_layer
from midrib.formats.units import check_same_plane
from midrib.hatching.slope import Slope, SlopeError, SlopeKind, SlopeProblem

if TYPE_CHECKING:
    from collections.abc import Callable

    from midrib.formats.gathering import Top
    from midrib.formats.reading import Batch, Source
    from midrib.hatching.edges import Edges
    from midrib.types import Floats

__all__ = ["Hints", "read_layer"]

IDENTIFIERS = ("gml_id", "id", "ident", "lokalnyId", "fid", "ogc_fid")
# Tops of each feature of a batch, or why they cannot be read; points of each.
Finder: TypeAlias = "Callable[[Batch], list[list[Top] | str]]"
Points: TypeAlias = "Callable[[Batch], list[list[Floats] | str]]"


class Hints(NamedTuple):
    """Where the tops of a layer's areas are told.

    Attributes
    ----------
    layer : str or None
        The layer of areas; the one that fits best unless it is named.
    top : str or None
        Lines along the tops: ``LAYER``, ``LAYER:ID`` or ``FIELD``; see ``guides_for``.
    toe : str or None
        Layer of lines along the toes: ``top`` is a layer of lines too then, and areas are what is
        between the two.
    start, end : str or None
        Where the tops start and end: two fields ``X,Y``, or a layer of points ``LAYER:ID`` that has
        the field ID in common with the areas.
    """

    layer: str | None = None
    top: str | None = None
    toe: str | None = None
    start: str | None = None
    end: str | None = None

    @property
    def names(self) -> set[str]:
        """Every name of a field or a layer in them."""
        told = ",".join(text for text in self if text is not None)
        return {*told.replace(":", ",").split(",")}


# What known data sets call them; a layer of areas without a name is one that has the fields.
KNOWN = (
    Hints(start="gora_start_x,gora_start_y", end="gora_koniec_x,gora_koniec_y"),
    Hints("OT_Skarpa", start="OT_poczatekGorySkarpy:gml_id", end="OT_koniecGorySkarpy:gml_id"),
    Hints("talud", top="kruinlijn:gml_id"),
)
TURNING = ("ESRI Shapefile", "OpenFileGDB")  # formats that do not keep the order of rings
KINDS_OF_LAYERS: dict[str, SlopeKind] = {"talud": "slope-unreinforced"}


def read_layer(path: Path, hints: Hints) -> tuple[list[Slope], list[SlopeProblem]]:
    """Read the slopes of a layer, and what is wrong with some.

    Raises
    ------
    ParameterError
        If nothing tells where the tops are.
    """
    found = Gathered()
    if hints.toe is not None:
        add_lines(found, path, hints)
        return found.result()
    hints = with_known(path, hints)
    with open_layer(path, choose_layer(path, hints.layer)) as source:
        tops = tops_for(hints, path, source)
        for batch in source.batches():
            add_batch(found, source, batch, tops(batch))
        driver = driver_of(path, source.layer)
    if hints.start is not None and driver in TURNING:
        doubt_ways(found, driver)
    return found.result()


def doubt_ways(found: Gathered, driver: str) -> None:
    """Doubt all tops that lead from a start to an end: the ring may have led the other way."""
    reason = f"{driver} turns every ring clockwise: which edge leads from start to end is lost"
    for slope in found.slopes:
        if not slope.top.is_closed:
            where = Point(slope.top.coords[0][:2])
            found.problems.append(SlopeProblem(slope.id, "orientation", reason, where))


def add_lines(found: Gathered, path: Path, hints: Hints) -> None:
    """Keep the slopes between lines of two layers.

    Raises
    ------
    ParameterError
        If there are no such layers.
    """
    lines: dict[str, list[LineString]] = {}
    layers, crs = layer_names(path), None
    for name, layer in (("top", hints.top), ("toe", hints.toe)):
        if layer is None or layer not in layers:
            msg = f"{name} is {layer!r}, expected a layer of IN {str(path)!r}: {listed(layers)}"
            raise ParameterError(msg)
        with open_layer(path, layer) as source:
            check_same_plane(source.crs, crs, f"{name} {layer!r}")
            crs = source.crs or crs
            parts = shapely.get_parts([g for b in source.batches() for g in b.geometries if g])
        lines[name] = [p for p in parts if isinstance(p, LineString) and p.length > 0.0]
    add_pairs(found, lines["top"], lines["toe"], path.stem, crs)


def with_known(path: Path, hints: Hints) -> Hints:
    """Add what the names of known data sets tell.

    Raises
    ------
    ParameterError
        If hints are missing and the names tell nothing, or hints exclude each other.
    """
    if (hints.start is None) != (hints.end is None):
        msg = f"start is {hints.start!r} and end is {hints.end!r}, expected both or neither"
        raise ParameterError(msg)
    if hints.top is not None and hints.start is not None:
        msg = "top excludes start and end, give one or the other"
        raise ParameterError(msg)
    if hints.top is not None or hints.start is not None:
        return hints
    layers = layer_names(path)
    with_areas = [name for name, kind in layers.items() if may_hold_areas(kind)]
    for known in KNOWN:
        fit = [
            layer
            for layer in (with_areas if hints.layer is None else [choose_layer(path, hints.layer)])
            if known.layer in {None, layer} and known.names <= {*layers, *column_names(path, layer)}
        ]
        if fit:
            return known._replace(layer=fit[0] if len(fit) == 1 else choose_layer(path, None))
    layer = choose_layer(path, hints.layer)
    msg = (
        f"IN {str(path)!r} does not tell the tops of its areas: layer {layer!r} has the fields "
        f"{listed(column_names(path, layer)) or 'none'}, expected top, or start and end"
    )
    raise ParameterError(msg)


def add_batch(
    found: Gathered, source: "Source", batch: "Batch", tops: "list[list[Top] | str]"
) -> None:
    """Keep the slopes of some features, each with its tops or with what is wrong with them."""
    rows = batch.attributes.to_pylist() or [{}] * len(batch.geometries)
    key = next((name for name in IDENTIFIERS if name in source.attributes.names), None)
    for row, (said, geometry) in enumerate(zip(rows, batch.geometries, strict=True)):
        told = tops[row]
        identifier = str(batch.first + row if key is None else said[key])
        with found.refusing(identifier):
            if row in batch.unreadable:
                raise SlopeError(batch.unreadable[row])
            # First the area: where it is none, or not valid, no top may have been found for it.
            is_whole = isinstance(geometry, MultiPolygon) and not geometry.is_empty
            parts = [*geometry.geoms] if is_whole else [check_area(geometry)]
            if not told or isinstance(told, str):
                msg = str(told or "it has no top")
                raise SlopeError(msg, place_of(geometry))
            found.add_sides(identifier, parts, told, maker(source, said))


def maker(source: "Source", said: dict[str, object]) -> "Callable[[str, Polygon, Edges], Slope]":
    """Make slopes of a feature, by their name, area and edges."""
    kind = kind_of("OT_Skarpa", said)
    if kind == "other":
        kind = KINDS_OF_LAYERS.get(source.layer, kind)

    def slope(identifier: str, area: Polygon, edges: "Edges") -> Slope:
        origin = f"layer {source.layer}"
        return Slope(identifier, kind, area, edges.top, edges.toe, origin, said, crs=source.crs)

    return slope


def tops_for(hints: Hints, path: Path, source: "Source") -> Finder:
    """Find the tops of the features of a batch, by whatever hint there is."""
    if hints.top is not None:
        guides = guides_for(hints.top, path, source, "top")

        def along(batch: "Batch") -> "list[list[Top] | str]":
            lines, unreadable = guides.all_of(batch)
            return [unreadable.get(k) or [*some] for k, some in enumerate(lines)]

        return along
    starts = points_for(str(hints.start), "start", path, source)
    ends = points_for(str(hints.end), "end", path, source)

    def between(batch: "Batch") -> "list[list[Top] | str]":
        pairs = zip(starts(batch), ends(batch), strict=True)
        return [paired(first, last) for first, last in pairs]

    return between


def paired(starts: "list[Floats] | str", ends: "list[Floats] | str") -> "list[Top] | str":
    """Tops from their starts to their ends, or what is wrong with them."""
    if isinstance(starts, str) or isinstance(ends, str):
        return starts if isinstance(starts, str) else str(ends)
    if len(starts) != len(ends):
        return f"its top has {len(starts)} starts and {len(ends)} ends, expected as many"
    return [*zip(starts, ends, strict=True)]


def place_in(values: tuple[object, ...], fields: list[str]) -> "list[Floats] | str":
    """Point of two fields, none if one is empty, or why it is none."""
    if None in values:
        return []
    try:
        return [np.array([float(str(value)) for value in values])]
    except ValueError:
        found = " and ".join(repr(value) for value in values)
        return f"its fields {' and '.join(fields)} hold {found}, expected two numbers"


def points_for(text: str, option: str, path: Path, source: "Source") -> Points:
    """Find the points of the features of a batch that an option speaks of.

    Raises
    ------
    ParameterError
        If there are no such fields and no such layer.
    """
    fields, layers = source.attributes.names, layer_names(path)
    columns = [name.strip() for name in text.split(",")]
    if len(columns) == 2 and {*columns} <= {*fields}:
        return lambda batch: [
            place_in(pair, columns)
            for pair in zip(*(batch.attributes[name].to_pylist() for name in columns), strict=True)
        ]
    layer, _, key = text.rpartition(":")
    if layer in layers and key in fields:
        check_layer(path, layer, source, option)
        points = points_by_key(path, layer, key)
        return lambda batch: [[*points[value]] for value in batch.attributes[key].to_pylist()]
    msg = (
        f"{option} is {text!r}, expected two fields X,Y of layer {source.layer!r} "
        f"({listed(fields)}) or a layer of points and a common field, LAYER:ID"
    )
    raise ParameterError(msg)


def points_by_key(path: Path, layer: str, key: str) -> "dict[object, list[Floats]]":
    """Read the points of a layer, by a field that areas have too."""
    found: dict[object, list[Floats]] = defaultdict(list)
    with open_layer(path, layer) as source:
        if key not in source.attributes.names:
            msg = f"layer {layer!r} has no field {key!r}, expected one of "
            raise ParameterError(msg + listed(source.attributes.names))
        for batch in source.batches():
            keys = batch.attributes[key].to_pylist()
            for value, geometry in zip(keys, batch.geometries, strict=True):
                found[value] += [*shapely.get_coordinates(geometry)]
    return found
