"""What a format asks of a layer: one kind of geometry, even heights, names that differ.

A layer is known here by the kinds of its geometries and its columns, so that features may come
batch by batch.
"""

from collections.abc import Callable, Collection, Sequence
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import shapely

from midrib.formats.endings import PARQUET, Format
from midrib.formats.geoparquet import Kind

__all__ = ["Fit", "distinct_names", "fit", "fitted", "free_name"]

MULTI = "Multi"
# What pyogrio calls a kind of geometry, by whether it has Z and M.
NAMES = {
    (False, False): "{}",
    (True, False): "{} Z",
    (False, True): "Measured {}",
    (True, True): "Measured 3D {}",
}
BUILDERS = {  # of the multiple kinds
    "Point": shapely.multipoints,
    "LineString": shapely.multilinestrings,
    "Polygon": shapely.multipolygons,
}


class Fit(NamedTuple):
    """What becomes of the geometries of a layer.

    Attributes
    ----------
    kind : str
        The one kind that the layer has then, as pyogrio calls it; "Unknown" if there are several.
    is_multi : bool
        Whether single geometries become multiple ones of one part.
    adds_z : bool
        Whether geometries without heights get the height 0.
    """

    kind: str
    is_multi: bool = False
    adds_z: bool = False


def fit(kinds: Collection[Kind], default: str, target: Format) -> tuple[Fit, list[str]]:
    """Decide what a layer with some kinds of geometry becomes in a format, and what to note.

    Where single and multiple geometries occur, the single ones become multiple; heights are even
    if the format asks for that. ``default`` is the kind of a layer without geometries.
    """
    notes = []
    adds_z = target.has_one_kind and len({has_z for _, has_z, _ in kinds}) > 1
    if adds_z:
        kinds = {(kind, True, has_m) for kind, _, has_m in kinds}
        notes = [f"{target.driver} has a Z for all or for none, it is 0 where there was none"]
    if not kinds:
        return Fit(default), notes
    names = {kind for kind, _, _ in kinds}
    dimensions = {(has_z, has_m) for _, has_z, has_m in kinds}
    if len({name.removeprefix(MULTI) for name in names}) > 1 or len(dimensions) > 1:
        return Fit("Unknown", adds_z=adds_z), notes
    name = NAMES[dimensions.pop()].format(max(names, key=len))
    return Fit(name, is_multi=len(names) > 1, adds_z=adds_z), notes


def fitted(wkb: pa.ChunkedArray, wanted: Fit) -> pa.ChunkedArray:
    """WKB of geometries as they are to be."""
    if not wanted.is_multi and not wanted.adds_z:
        return wkb
    geometries = shapely.from_wkb(wkb.to_numpy())
    there = ~shapely.is_missing(geometries)
    if wanted.adds_z:
        flat = there & ~shapely.has_z(geometries)
        geometries[flat] = shapely.force_3d(geometries[flat], 0.0)
    if wanted.is_multi:
        for i in np.flatnonzero(there):
            kind = geometries[i].geom_type
            if not kind.startswith(MULTI):
                geometries[i] = BUILDERS[kind]([geometries[i]])
    return pa.chunked_array([pa.array(shapely.to_wkb(geometries, flavor="iso"), type=pa.binary())])


def distinct_names(
    names: Sequence[str], geometry: str, target: Format, numbering: Collection[str]
) -> tuple[list[str], list[str]]:
    """Names of the attributes that the format tells apart, and notes about new ones.

    Formats other than Parquet take names that differ only by case for one, or refuse the second;
    some write its values into the first. Those of ``numbering`` can number features: whole numbers,
    each once.
    """
    fold: Callable[[str], str] = str if target.driver == PARQUET else str.lower
    taken = {fold(geometry)}
    for name in names:
        if fold(name) == target.identifier and name not in numbering:
            taken.add(fold(name))
    distinct: list[str] = []
    for name in names:
        new = name
        if fold(name) in taken:
            new = free_name(name, taken | {fold(known) for known in names}, fold)
        taken.add(fold(new))
        distinct.append(new)
    pairs = zip(names, distinct, strict=True)
    return distinct, [
        f"the field {old!r} is written as {new!r}" for old, new in pairs if old != new
    ]


def free_name(name: str, taken: Collection[str], fold: Callable[[str], str] = str.lower) -> str:
    """Return a name, numbered on where it is taken: ``length_2``."""
    free, number = name, 2
    while fold(free) in taken:
        free, number = f"{name}_{number}", number + 1
    return free
