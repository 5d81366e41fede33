"""Directional polylines of ``--main`` or ``--top``: which of them lies along which area."""

from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
import shapely
from shapely import LineString

from midrib.errors import ParameterError
from midrib.formats.reading import layer_names, listed, open_layer

if TYPE_CHECKING:
    from midrib.formats.reading import Batch, Geometries, Source

__all__ = ["Guides", "guides_for"]

SAMPLES = 17  # places of a line at which its distance to an area is measured
SAME_DISTANCE = 1e-6  # areas whose mean distance differs by less, in line lengths, share a line


class Guides(Protocol):
    """Directional polylines of the features of a layer."""

    def of(self, batch: "Batch") -> tuple["Geometries", dict[int, str]]:
        """Polyline or None of each feature of a batch, and why some cannot be read."""


def guides_for(main: str | None, path: Path, source: "Source", option: str = "--main") -> Guides:
    """Guides that an option speaks of: a layer, a layer and a common field, or a field.

    Raises
    ------
    ParameterError
        If there is neither such a layer nor such a field.
    """
    if main is None:
        return NoGuides()
    layers, fields = layer_names(path), source.attributes.names
    if main in layers and main != source.layer:
        return PlacedGuides(all_geometries(path, source.layer), lines_of(path, main))
    layer, _, identifier = main.rpartition(":")
    if layer in layers:
        if identifier not in fields:
            msg = (
                f"{option} names the field {identifier!r}, expected one of layer {source.layer!r}: "
                f"{listed(fields)}"
            )
            raise ParameterError(msg)
        return KeyedGuides(identifier, lines_by_key(path, layer, identifier, option))
    if main in fields:
        return FieldGuides(main)
    others = [name for name in layers if name != source.layer]
    msg = (
        f"{option} is {main!r}, expected a layer of IN ({listed(others) or 'there is no other'}) "
        f"or a field of layer {source.layer!r} ({listed(fields)})"
    )
    raise ParameterError(msg)


class NoGuides(NamedTuple):
    """No feature has one."""

    def of(self, batch: "Batch") -> tuple["Geometries", dict[int, str]]:
        """None for every feature."""
        return np.full(len(batch.geometries), None, dtype=object), {}


class FieldGuides(NamedTuple):
    """A field holds them as WKT or as WKB in hexadecimal digits."""

    field: str

    def of(self, batch: "Batch") -> tuple["Geometries", dict[int, str]]:
        """Geometries of the field."""
        found = np.full(len(batch.geometries), None, dtype=object)
        unreadable = {}
        for i, text in enumerate(batch.attributes[self.field].to_pylist()):
            if text is None:
                continue
            line = line_of_text(text)
            if line is None:
                shown = repr(text if len(str(text)) < 40 else f"{str(text)[:37]}…")
                unreadable[i] = f"the field {self.field!r} is {shown}, expected a line in WKT"
            found[i] = line
        return found, unreadable


class KeyedGuides(NamedTuple):
    """A field that areas and lines have in common tells."""

    field: str
    lines: dict[object, LineString]

    def of(self, batch: "Batch") -> tuple["Geometries", dict[int, str]]:
        """Lines with the keys of the batch."""
        found = np.full(len(batch.geometries), None, dtype=object)
        found[:] = [self.lines.get(key) for key in batch.attributes[self.field].to_pylist()]
        return found, {}


class PlacedGuides:
    """Each line belongs to the area whose boundary it is nearest to all along."""

    def __init__(self, areas: "Geometries", lines: "list[LineString]") -> None:
        self.guides = np.full(len(areas), None, dtype=object)
        boundaries = shapely.boundary(areas)
        tree = shapely.STRtree(areas)
        for line in sorted(lines, key=lambda line: line.length):  # the longest one has its way
            near = tree.query(line)
            if near.size == 0:
                near = tree.query_nearest(line)
            samples = line.interpolate(np.linspace(0.0, 1.0, SAMPLES), normalized=True)
            distance = shapely.distance(samples[None, :], boundaries[near, None]).mean(axis=1)
            nearest = distance.min(initial=line.length)  # nothing farther off lies along it
            self.guides[near[distance <= nearest + SAME_DISTANCE * line.length]] = line

    def of(self, batch: "Batch") -> tuple["Geometries", dict[int, str]]:
        """Lines of the areas of the batch."""
        return self.guides[batch.first : batch.first + len(batch.geometries)], {}


def line_of_text(text: object) -> LineString | None:
    """Read a line in WKT or hexadecimal WKB, None if it is none."""
    try:
        with np.errstate(invalid="ignore"):  # a coordinate may be no number
            is_hex = set(str(text)) <= HEXADECIMAL
            read = shapely.from_wkb(text) if is_hex else shapely.from_wkt(text)
    except (shapely.errors.GEOSException, TypeError):
        return None
    return longest_line(np.array([read], dtype=object))


HEXADECIMAL = set("0123456789abcdefABCDEF")


def longest_line(geometries: "Geometries") -> LineString | None:
    """Return the longest line when pieces that meet are joined, None if there is none."""
    pieces = shapely.get_parts(geometries)
    pieces = pieces[shapely.get_type_id(pieces) == shapely.GeometryType.LINESTRING]
    known = [bool(np.isfinite(shapely.get_coordinates(piece)).all()) for piece in pieces]
    pieces = pieces[np.array(known, dtype=np.bool_)]  # others cannot be merged
    joined = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(pieces), directed=True))
    joined = joined[shapely.length(joined) > 0.0]
    return joined[np.argmax(shapely.length(joined))] if joined.size else None


def all_geometries(path: Path, layer: str) -> "Geometries":
    """All geometries of a layer."""
    with open_layer(path, layer) as source:
        return np.concatenate(
            [np.empty(0, dtype=object), *(batch.geometries for batch in source.batches())]
        )


def lines_of(path: Path, layer: str) -> list[LineString]:
    """Read the lines of a layer, one for each feature that has any."""
    lines = (longest_line(row) for row in all_geometries(path, layer)[:, None])
    return [line for line in lines if line is not None]


def lines_by_key(path: Path, layer: str, field: str, option: str) -> dict[object, LineString]:
    """Read the line of each key; pieces with the same key are joined where they meet."""
    pieces: dict[object, list[object]] = defaultdict(list)
    with open_layer(path, layer) as source:
        if field not in source.attributes.names:
            msg = (
                f"{option} names the field {field!r}, expected one of layer {layer!r}: "
                f"{listed(source.attributes.names)}"
            )
            raise ParameterError(msg)
        for batch in source.batches():
            keys = batch.attributes[field].to_pylist()
            for key, geometry in zip(keys, batch.geometries, strict=True):
                pieces[key].append(geometry)
    lines = {key: longest_line(np.array(some, dtype=object)) for key, some in pieces.items()}
    return {key: line for key, line in lines.items() if line is not None and key is not None}
