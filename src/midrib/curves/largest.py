"""One polygon of an area: its only part, a chosen one, or the largest."""

from typing import Any

import numpy as np
from shapely import MultiPolygon, Polygon

from midrib.checks import is_number, shown
from midrib.curves.log import Log
from midrib.curves.parts import valid_parts
from midrib.errors import GeometryTypeError, InvalidAreaError, ParameterError

__all__ = ["one_part"]


def one_part(area: Any, part: Any = None) -> tuple[Polygon, list[str], bool]:
    """Choose one polygon of an area, repaired as ``collapse`` repairs it.

    Parameters
    ----------
    area : Polygon or MultiPolygon
    part : int, optional
        Number of the part, from 0; the largest that is not refused unless it is given. Where a
        repair has made several of a part it is the largest of them.

    Returns
    -------
    polygon : Polygon
        Valid.
    notes : list of str
        What there is to say: which part it is, which are refused and why, what was repaired.
    is_repaired : bool

    Raises
    ------
    GeometryTypeError
        If it is no area.
    InvalidAreaError
        If it is empty, or not valid and the repair is not certain.
    ParameterError
        If there is no such part.
    """
    if not isinstance(area, Polygon | MultiPolygon):
        kind = getattr(area, "geom_type", type(area).__name__)
        msg = f"area is a {kind}, expected a Polygon or MultiPolygon"
        raise GeometryTypeError(msg)
    if area.is_empty:
        msg = "area is empty"
        raise InvalidAreaError(msg)
    count = len(area.geoms) if isinstance(area, MultiPolygon) else 1
    check_part(part, count)
    log = Log(None, strict=False)
    parts = list(valid_parts(np.array([area], dtype=object), log))
    candidates = [found for found in parts if part in (None, found.number)]
    if not candidates:
        reason = next((p.reason for p in log.problems if part in (None, p.part)), "is empty")
        msg = f"area{'' if count == 1 else f' part {part or 0}'}: {reason}"
        raise InvalidAreaError(msg)
    chosen = max(candidates, key=lambda found: found.polygon.area)
    repairs = [p.reason for p in log.problems if p.status == "repaired" and p.part == chosen.number]
    notes = [f"repaired: {reason}" for reason in repairs]
    pieces = sum(found.number == chosen.number for found in parts)
    if pieces > 1:
        notes.append(f"the largest of {pieces} pieces that the repair has made")
    if count > 1:
        largest = ", the largest" if part is None else ""
        notes.append(f"part {chosen.number} of 0 to {count - 1}{largest}")
    if part is None:
        refused = [p for p in log.problems if p.status == "refused"]
        notes += [f"part {p.part} is left out: {p.reason}" for p in refused]
    return chosen.polygon, notes, bool(repairs)


def check_part(part: Any, count: int) -> None:
    """Refuse what is not the number of a part."""
    is_whole = is_number(part) and part == int(part)
    if part is not None and not (is_whole and 0 <= part < count):
        expected = "0, the area has one part" if count == 1 else f"0 to {count - 1}"
        msg = f"part is {shown(part)}, expected {expected}"
        raise ParameterError(msg)
