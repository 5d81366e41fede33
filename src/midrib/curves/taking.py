"""What is taken: one area, an array of them or a series; and results that are given back alike."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from shapely.geometry.base import BaseGeometry

from midrib.checks import check_flag
from midrib.errors import GeometryTypeError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Geometries = NDArray[np.object_]

__all__ = ["Taken", "as_array", "take"]


class Taken(NamedTuple):
    """Areas as an array, and what they came as."""

    array: "Geometries"
    series: Any  # a GeoSeries, or None
    geographic: bool

    @property
    def labels(self) -> Sequence[Any] | None:
        """Labels of a series."""
        return None if self.series is None else list(self.series.index)

    def given_back(self, found: "Geometries") -> Any:
        """One result for each area, as one thing, an array of the same shape or a series."""
        if self.series is not None:
            return type(self.series)(found, index=self.series.index, crs=self.series.crs)
        return found.reshape(self.array.shape) if self.array.ndim else found[0]


def take(areas: Any, geographic: bool | None) -> Taken:
    """Take areas in; degrees are told by the CRS of a series unless it is said.

    Raises
    ------
    GeometryTypeError
        If ``areas`` is neither a geometry nor a sequence.
    ParameterError
        If ``geographic`` is neither True nor False, nor None.
    """
    if geographic is not None:
        check_flag(geographic, "geographic")
    if not (hasattr(areas, "geometry") and hasattr(areas, "index")):
        return Taken(as_array(areas), None, bool(geographic))
    series = areas.geometry
    if geographic is None:
        geographic = series.crs is not None and series.crs.is_geographic
    return Taken(as_array(series.to_numpy()), series, bool(geographic))


def as_array(areas: Any) -> "Geometries":
    """Geometries as an object array; one geometry has no axis."""
    if isinstance(areas, np.ndarray) and areas.dtype == object:
        return areas
    if areas is None or isinstance(areas, BaseGeometry):
        single: Geometries = np.empty((), dtype=object)
        single[()] = areas
        return single
    try:
        sequence = list(areas)
    except TypeError:
        msg = f"areas is a {type(areas).__name__}, expected areas"
        raise GeometryTypeError(msg) from None
    array = np.empty(len(sequence), dtype=object)
    array[:] = sequence
    return array
