"""Areas that are not valid: repaired where there is no doubt how, otherwise refused."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely
from shapely import Polygon

from midrib.errors import InvalidAreaError
from midrib.ragged import place_text

__all__ = ["Overlap", "overlaps", "repaired"]

# The readings of a defective area agree if they differ by less than this share of it; pieces
# smaller than that are left out.
DOUBT = 1e-3
# Parts that share less than this share of the smaller one lie side by side: it is what rounding
# leaves where a vertex of the one is on a slanting segment of the other.
SIDE_BY_SIDE = 1e-9


def repaired(area: Polygon) -> tuple[list[Polygon], str]:
    """Return valid polygons for an invalid one, and what was wrong with it.

    The area is read in three ways: by structure (rings are outlines), by linework (rings are
    lines, odd and even) and by its signed area (what a ring winds around twice counts twice, what
    it winds around the other way is taken off). Where all three are the same size but for a
    thousandth there is no doubt: a spike, a tiny curl, a ring that touches itself and so falls
    into two. A bow-tie is refused: its lobes are wound against each other.

    Raises
    ------
    InvalidAreaError
        If a coordinate is not finite, the area is nothing, or the readings differ.
    """
    coordinates = shapely.get_coordinates(area)
    bad = np.flatnonzero(~np.isfinite(coordinates).all(axis=1))
    if bad.size:
        msg = f"vertex {bad[0]} is {place_text(coordinates[bad[0]])}, expected finite coordinates"
        raise InvalidAreaError(msg)
    reason = readable(shapely.is_valid_reason(area))
    by_structure = shapely.make_valid(area, method="structure", keep_collapsed=False)
    size = by_structure.area
    if size == 0.0:
        msg = f"the area is nothing: {reason}"
        raise InvalidAreaError(msg)
    by_linework = shapely.make_valid(area, method="linework").area
    by_sign = area.area  # of the shell less those of the holes
    doubt = (abs(size - by_linework) + abs(size - by_sign)) / size
    if doubt > DOUBT:
        msg = f"the area is not valid and can be read in more than one way: {reason}"
        raise InvalidAreaError(msg)
    parts = [part for part in shapely.get_parts(by_structure) if part.area > DOUBT * size]
    lost = max(1.0 - sum(part.area for part in parts) / size, 0.0)
    return parts, reason + (f", {lost:.2g} of the area left out" if lost > doubt else "")


def readable(reason: str) -> str:
    """Turn GEOS's ``Self-intersection[5 5]`` into ``Self-intersection at (5, 5)``."""
    text, bracket, place = reason.partition("[")
    if not bracket:
        return reason
    return f"{text} at ({', '.join(place.rstrip(']').split())})"


class Overlap(NamedTuple):
    """What becomes of a part that overlaps another."""

    is_refused: bool
    is_left_out: bool
    reason: str


def overlaps(parts: Sequence[Polygon], numbers: Sequence[int]) -> dict[int, Overlap]:
    """Parts of an area that overlap others, by position; each is valid by itself, and has a number.

    A part that is there twice, but for a thousandth, is left out once. Parts that overlap by less
    than a thousandth of the smaller one stay as they are. Any other overlap can be read in more
    than one way (counted once, twice, or as a hole): both parts are refused.
    """
    found: dict[int, Overlap] = {}
    if len(parts) < 2:
        return found
    one, other = shapely.STRtree(parts).query(parts, predicate="intersects")
    for i, j in sorted(zip(one[one < other], other[one < other], strict=True)):
        shared, sizes = parts[i].intersection(parts[j]), (parts[i].area, parts[j].area)
        share = shared.area / min(sizes)
        if share <= SIDE_BY_SIDE:
            continue
        place = place_text(shapely.get_coordinates(shared.representative_point())[0])
        if sum(sizes) - 2.0 * shared.area <= DOUBT * min(sizes):
            found.setdefault(j, Overlap(False, True, f"the same as part {numbers[i]}, left out"))
        elif share <= DOUBT:
            reason = f"overlaps part {numbers[i]} at {place} by {share:.2g} of the smaller one"
            found.setdefault(j, Overlap(False, False, reason))
        else:
            reason = "overlaps part {} at {}, which can be read in more than one way"
            found[i] = Overlap(True, False, reason.format(numbers[j], place))
            found[j] = Overlap(True, False, reason.format(numbers[i], place))
    return found
