"""Directional polylines of ``--main`` or ``--top``: which of them lies along which area."""

from abc import ABC, abstractmethod
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import shapely
from shapely import LineString

from midrib.errors import ParameterError
from midrib.formats.contents import layer_names, listed
from midrib.formats.reading import open_layer
from midrib.formats.units import check_same_plane

if TYPE_CHECKING:
    from midrib.formats.reading import Batch, Geometries, Source

__all__ = ["Guides", "check_layer", "guides_for"]

SAMPLES = 17  # places of a line at which its distance to an area is measured
SAME_DISTANCE = 1e-6  # areas whose mean distance differs by less, in line lengths, share a line


class Guides(ABC):
    """Directional polylines of the features of a layer."""

    @abstractmethod
    def all_of(self, batch: "Batch") -> tuple["list[list[LineString]]", dict[int, str]]:
        """Polylines of each feature of a batch, the longest first; why some cannot be read."""

    def of(self, batch: "Batch") -> tuple["Geometries", dict[int, str]]:
        """Polyline or None of each feature of a batch; why some cannot be read.

        Of several it is the longest, once those that follow each other along the area are joined.
        """
        from midrib.formats.tops import joined_tops  # with hatching, which nobody else needs here

        lines, unreadable = self.all_of(batch)
        found = np.full(len(lines), None, dtype=object)
        for k, (area, some) in enumerate(zip(batch.geometries, lines, strict=True)):
            found[k] = max(joined_tops(area, some)[0], key=length, default=None)
        return found, unreadable


def length(line: LineString) -> float:
    """Length of a line."""
    return float(line.length)


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
        check_layer(path, main, source, option)
        return PlacedGuides(all_geometries(path, source.layer), lines_of(path, main))
    layer, _, identifier = main.rpartition(":")
    if layer in layers:
        if identifier not in fields:
            msg = (
                f"{option} names the field {identifier!r}, expected one of layer {source.layer!r}: "
                f"{listed(fields)}"
            )
            raise ParameterError(msg)
        check_layer(path, layer, source, option)
        return KeyedGuides(identifier, lines_by_key(path, layer, identifier, option))
    if main in fields:
        return FieldGuides(main)
    others = [name for name in layers if name != source.layer]
    msg = (
        f"{option} is {main!r}, expected a layer of IN ({listed(others) or 'there is no other'}) "
        f"or a field of layer {source.layer!r} ({listed(fields)})"
    )
    raise ParameterError(msg)


def check_layer(path: Path, layer: str, source: "Source", option: str) -> None:
    """Refuse a layer in another plane than the areas of a source.

    Raises
    ------
    ParameterError
        If both CRS are known and are not the same.
    """
    with open_layer(path, layer) as other:
        check_same_plane(other.crs, source.crs, f"{option} {layer!r}")


class NoGuides(Guides):
    """No feature has one."""

    def all_of(self, batch: "Batch") -> tuple["list[list[LineString]]", dict[int, str]]:
        """None for any feature."""
        return [[] for _ in batch.geometries], {}


@dataclass(frozen=True)
class FieldGuides(Guides):
    """A field holds them as WKT or as WKB in hexadecimal digits."""

    field: str

    def all_of(self, batch: "Batch") -> tuple["list[list[LineString]]", dict[int, str]]:
        """Lines of the field."""
        found: list[list[LineString]] = []
        unreadable = {}
        for i, text in enumerate(batch.attributes[self.field].to_pylist()):
            found.append([] if text is None else lines_of_text(text))
            if text is not None and not found[i]:
                shown = repr(text if len(str(text)) < 40 else f"{str(text)[:37]}…")
                unreadable[i] = f"the field {self.field!r} is {shown}, expected a line in WKT"
        return found, unreadable


@dataclass(frozen=True)
class KeyedGuides(Guides):
    """A field that areas and lines have in common tells."""

    field: str
    lines: dict[object, list[LineString]]

    def all_of(self, batch: "Batch") -> tuple["list[list[LineString]]", dict[int, str]]:
        """Lines with the keys of the batch."""
        keys = batch.attributes[self.field].to_pylist()
        return [self.lines.get(key, []) for key in keys], {}


class PlacedGuides(Guides):
    """Each line belongs to the area whose boundary it is nearest to all along."""

    def __init__(self, areas: "Geometries", lines: "list[LineString]") -> None:
        self.lines: list[list[LineString]] = [[] for _ in areas]
        boundaries = shapely.boundary(areas)
        tree = shapely.STRtree(areas)
        for line in sorted(lines, key=lambda line: -line.length):
            near = tree.query(line)
            if near.size == 0:
                near = tree.query_nearest(line)
            samples = line.interpolate(np.linspace(0.0, 1.0, SAMPLES), normalized=True)
            distance = shapely.distance(samples[None, :], boundaries[near, None]).mean(axis=1)
            nearest = distance.min(initial=line.length)  # nothing farther off lies along it
            for k in near[distance <= nearest + SAME_DISTANCE * line.length].tolist():
                self.lines[k].append(line)

    def all_of(self, batch: "Batch") -> tuple["list[list[LineString]]", dict[int, str]]:
        """Lines of the areas of the batch."""
        return self.lines[batch.first : batch.first + len(batch.geometries)], {}


def lines_of_text(text: object) -> list[LineString]:
    """Read lines in WKT or hexadecimal WKB, the longest first; none if it holds none."""
    try:
        with np.errstate(invalid="ignore"):  # a coordinate may be no number
            is_hex = set(str(text)) <= HEXADECIMAL
            read = shapely.from_wkb(text) if is_hex else shapely.from_wkt(text)
    except (shapely.errors.GEOSException, TypeError):
        return []
    return joined_lines(np.array([read], dtype=object))


HEXADECIMAL = set("0123456789abcdefABCDEF")


def joined_lines(geometries: "Geometries") -> list[LineString]:
    """Lines when pieces that meet are joined, the longest first."""
    pieces = shapely.get_parts(geometries)
    pieces = pieces[shapely.get_type_id(pieces) == shapely.GeometryType.LINESTRING]
    known = [bool(np.isfinite(shapely.get_coordinates(piece)).all()) for piece in pieces]
    pieces = pieces[np.array(known, dtype=np.bool_)]  # others cannot be merged
    joined = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(pieces), directed=True))
    return sorted(joined[shapely.length(joined) > 0.0], key=lambda line: -line.length)


def all_geometries(path: Path, layer: str) -> "Geometries":
    """All geometries of a layer."""
    with open_layer(path, layer) as source:
        return np.concatenate(
            [np.empty(0, dtype=object), *(batch.geometries for batch in source.batches())]
        )


def lines_of(path: Path, layer: str) -> list[LineString]:
    """Read the lines of a layer; pieces of a feature are joined where they meet."""
    return [line for row in all_geometries(path, layer)[:, None] for line in joined_lines(row)]


def lines_by_key(path: Path, layer: str, field: str, option: str) -> dict[object, list[LineString]]:
    """Read the lines of each key; pieces with the same key are joined where they meet."""
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
    lines = {key: joined_lines(np.array(some, dtype=object)) for key, some in pieces.items()}
    return {key: some for key, some in lines.items() if some and key is not None}
