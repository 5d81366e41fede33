"""What a machine has to know to make lines of areas: the layer they come from, the options."""

from dataclasses import dataclass, field
from typing import Any

import pyarrow as pa

from midrib.curves.aftercare import aftercare
from midrib.curves.methods import finder_of
from midrib.formats.fitting import free_name
from midrib.formats.geoparquet import More
from midrib.formats.guides import Guides, NoGuides
from midrib.formats.units import is_geographic

__all__ = ["Recipe", "check_options"]

MEASURES = {  # columns that lines get
    "length": pa.float64(),
    "width_mean": pa.float64(),
    "width_max": pa.float64(),
    "status": pa.string(),
}
REASON = {"reason": pa.string()}  # that refused areas get


def check_options(method: str, options: dict[str, Any]) -> None:
    """Refuse a method or an option that there is not, even where no feature needs it."""
    options = dict(options)
    aftercare(options.pop("simplify", None), options.pop("smooth", False))
    finder_of(method, **options)


@dataclass(frozen=True)
class Recipe:
    """How the areas of a layer become lines; it can be sent to another process.

    Attributes
    ----------
    attributes : pyarrow.Schema
        Columns of the areas apart from the geometry.
    geometry : str
        Column of WKB, of areas and of lines.
    crs : str or None
        PROJJSON.
    method : str
        One of ``midrib.methods()``.
    options : dict
        Those of ``midrib.collapse``.
    has_m : bool
        Whether lines carry the width as M values.
    guides : Guides
        Directional polylines.
    more : pairs
        Metadata of GeoParquet that lines have from the areas.
    """

    attributes: pa.Schema
    geometry: str = "geometry"
    crs: str | None = None
    method: str = "minimal-radii"
    options: dict[str, Any] = field(default_factory=dict)
    has_m: bool = False
    guides: Guides = field(default_factory=NoGuides)
    more: More = ()

    @property
    def geographic(self) -> bool:
        """Whether coordinates are degrees."""
        return is_geographic(self.crs)

    @property
    def lines(self) -> pa.Schema:
        """Columns of lines: attributes, measures, WKB."""
        return self.with_columns(MEASURES)

    @property
    def refused(self) -> pa.Schema:
        """Columns of areas that were refused: attributes, reason, WKB."""
        return self.with_columns(REASON)

    def with_columns(self, columns: dict[str, pa.DataType]) -> pa.Schema:
        """Attributes, more columns, numbered on where a name is taken, and WKB."""
        fields = [pa.field(f.name, f.type) for f in self.attributes]
        for name, kind in columns.items():
            taken = {known.name.lower() for known in fields} | {self.geometry.lower()}
            fields.append(pa.field(free_name(name, taken), kind))
        return pa.schema([*fields, pa.field(self.geometry, pa.binary())])
