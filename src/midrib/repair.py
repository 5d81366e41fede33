"""Areas that are not valid: repaired where there is no doubt how, refused with a reason elsewhere."""

import numpy as np
import shapely
from shapely import Polygon

from midrib.errors import InvalidAreaError
from midrib.ragged import place_text

__all__ = ["repaired"]

# Two readings of a defective ring agree if they differ by less than this share of the area, and a
# repaired area is still one area if nothing larger falls off.
DOUBT = 1e-3


def repaired(area: Polygon) -> tuple[Polygon, str]:
    """Return a valid polygon for an invalid one, and what was wrong with it.

    The area is repaired by structure (rings are outlines) and by linework (rings are lines, odd
    and even). If both give, but for a thousandth, the same single polygon, that is the answer.

    Raises
    ------
    InvalidAreaError
        If a coordinate is not finite, the area is nothing, or the two readings differ.
    """
    coordinates = shapely.get_coordinates(area)
    bad = np.flatnonzero(~np.isfinite(coordinates).all(axis=1))
    if bad.size:
        msg = f"vertex {bad[0]} is {place_text(coordinates[bad[0]])}, expected finite coordinates"
        raise InvalidAreaError(msg)
    reason = readable(shapely.is_valid_reason(area))
    by_structure = shapely.make_valid(area, method="structure", keep_collapsed=False)
    by_linework = shapely.make_valid(area, method="linework")
    parts = shapely.get_parts(by_structure)
    if by_structure.area == 0.0:
        msg = f"the area is nothing: {reason}"
        raise InvalidAreaError(msg)
    largest = parts[np.argmax(shapely.area(parts))]
    lost = by_structure.area - largest.area
    unsure = abs(by_structure.area - by_linework.area)
    if not isinstance(largest, Polygon) or lost + unsure > DOUBT * by_structure.area:
        msg = f"the area is not valid and can be read in more than one way: {reason}"
        raise InvalidAreaError(msg)
    share = (lost + unsure) / by_structure.area
    return largest, reason + (f", {share:.2g} of the area left out" if share > 0.0 else "")


def readable(reason: str) -> str:
    """Turn GEOS's ``Self-intersection[5 5]`` into ``Self-intersection at (5, 5)``."""
    text, bracket, place = reason.partition("[")
    if not bracket:
        return reason
    return f"{text} at ({', '.join(place.rstrip(']').split())})"
