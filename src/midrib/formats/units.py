"""Lengths with units: "2m" in metres, "10ft" in feet, "2" in the units of the CRS.

The CRS is PROJJSON text, so that no projection library is needed to learn its unit.
Source of the units: international yard and pound agreement of 1959; US survey foot 1200/3937 m.
"""

import json
import re
from typing import Any, NamedTuple

from midrib.errors import ParameterError

__all__ = [
    "METRE",
    "METRES",
    "Unit",
    "check_same_plane",
    "is_geographic",
    "is_same_plane",
    "is_wgs84",
    "length_in",
    "unit_of",
    "vertical_unit_of",
]

METRES = {
    "mm": 0.001,
    "cm": 0.01,
    "dm": 0.1,
    "m": 1.0,
    "km": 1000.0,
    "in": 0.0254,
    "ft": 0.3048,
    "usft": 1200.0 / 3937.0,
    "yd": 0.9144,
    "mi": 1609.344,
    "nmi": 1852.0,
}
WGS84 = {("EPSG", "4326"), ("OGC", "CRS84")}
LENGTH = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-zA-Z]*)\s*")


class Unit(NamedTuple):
    """A unit of length: its name and how many metres it has."""

    name: str
    metres: float


METRE = Unit("m", 1.0)


def length_in(text: str, crs: str | None, name: str) -> float:
    """Read a length in the unit of a CRS; in metres where that is geographic.

    Parameters
    ----------
    text : str
        A number, alone or with a unit: ``"2"``, ``"2m"``, ``"50 cm"``, ``"10ft"``.
    crs : str or None
        PROJJSON.
    name : str
        What the length is for, named in errors.

    Raises
    ------
    ParameterError
        If it is no length, or has a unit and the CRS does not tell its own.

    Examples
    --------
    >>> length_in("2.5", None, "--spacing")
    2.5
    """
    match = LENGTH.fullmatch(text)
    if match is None or match[2] not in {"", *METRES}:
        msg = (
            f"{name} is {text!r}, expected a number, alone (units of the CRS) or with one of "
            f"{', '.join(METRES)}: 2m"
        )
        raise ParameterError(msg)
    if not match[2]:
        return float(match[1])
    unit = unit_of(crs)
    if unit is None:
        msg = f"{name} is {text!r}, but IN has no CRS with a unit, expected a number without unit"
        raise ParameterError(msg)
    return float(match[1]) * METRES[match[2]] / unit.metres


def unit_of(crs: str | None) -> Unit | None:
    """Return the unit of lengths: that of the CRS, metres in a geographic one.

    Examples
    --------
    >>> unit_of('{"type": "ProjectedCRS", "coordinate_system": {"axis": [{"unit": "metre"}]}}')
    Unit(name='m', metres=1.0)
    """
    if is_geographic(crs):
        return METRE
    axes = horizontal(crs).get("coordinate_system", {}).get("axis", [])
    return unit_along(axes[0]) if axes else None


def vertical_unit_of(crs: str | None) -> Unit | None:
    """Return the unit of heights; None if a CRS has no vertical axis, or does not tell its unit.

    Examples
    --------
    >>> axis = '{"direction": "up", "unit": "metre"}'
    >>> vertical_unit_of(f'{{"type": "VerticalCRS", "coordinate_system": {{"axis": [{axis}]}}}}')
    Unit(name='m', metres=1.0)
    """
    parts: list[dict[str, Any]] = [] if crs is None else [json.loads(crs)]
    for part in parts:  # grows by what the parts consist of
        parts += part.get("components", [])
        parts += [part["source_crs"]] if "source_crs" in part else []
        for axis in part.get("coordinate_system", {}).get("axis", []):
            if axis.get("direction") in {"up", "down"}:
                return unit_along(axis)
    return None


def unit_along(axis: dict[str, Any]) -> Unit | None:
    """Return the unit of an axis of a CRS, if it is one of length."""
    unit = axis.get("unit")
    if unit == "metre":
        return METRE
    if isinstance(unit, dict) and "conversion_factor" in unit:
        return Unit(str(unit["name"]), float(unit["conversion_factor"]))
    return None


def is_geographic(crs: str | None) -> bool:
    """Whether coordinates are angles of longitude and latitude.

    Raises
    ------
    ParameterError
        If they are angles, but not degrees.
    """
    system = horizontal(crs).get("coordinate_system", {})
    if system.get("subtype") != "ellipsoidal":
        return False
    unit = system["axis"][0].get("unit")
    if unit != "degree":
        name = unit["name"] if isinstance(unit, dict) else unit
        msg = f"the CRS of IN counts in units of {name!r}, expected degrees or lengths"
        raise ParameterError(msg)
    return True


def is_same_plane(crs: str | None, other: str | None) -> bool:
    """Whether coordinates of two systems may go together: both are the same, or one is not told."""
    if crs is None or other is None:
        return True
    found, expected = ({**horizontal(one)} for one in (crs, other))
    if found.get("id") and expected.get("id"):
        return bool(found["id"] == expected["id"])
    return bool(found.get("name") == expected.get("name"))


def check_same_plane(crs: str | None, other: str | None, what: str) -> None:
    """Refuse what lies in another plane than the areas of IN.

    Raises
    ------
    ParameterError
        If both systems are known and are not the same.
    """
    if not is_same_plane(crs, other):
        names = [str(horizontal(one).get("name", "unknown")) for one in (crs, other)]
        msg = f"{what} is in another CRS than IN, {names[0]}, expected the same: {names[1]}"
        raise ParameterError(msg)


def is_wgs84(crs: str) -> bool:
    """Whether coordinates are longitude and latitude of WGS 84."""
    found = json.loads(crs).get("id", {})
    return (found.get("authority"), str(found.get("code"))) in WGS84


def horizontal(crs: str | None) -> dict[str, Any]:
    """Find the part of a CRS that is about the plane."""
    part: dict[str, Any] = {} if crs is None else json.loads(crs)
    while "source_crs" in part or "components" in part:
        part = part["source_crs"] if "source_crs" in part else part["components"][0]
    return part
