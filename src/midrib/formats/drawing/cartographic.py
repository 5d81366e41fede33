"""Cartographic objects: KR_ObiektKarto of the Polish model of 2015, one for each line of a symbol.

The model keeps what is drawn of an object beside it: scale, cartographic code, geometry and a
reference to the object. A geometry there is a single primitive, so each line has an object.
Source: files of the register (C-GEO 8.15).
"""

import json
from itertools import count
from typing import TYPE_CHECKING, Any

import shapely
from lxml import etree

from midrib.errors import ParameterError
from midrib.formats.units import horizontal

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from midrib.formats.drawing.content import Drawing, Drawn

__all__ = ["check_cartographic", "write_cartographic"]

GML = "http://www.opengis.net/gml/3.2"
MODEL = "urn:gugik:specyfikacje:gmlas:modelPodstawowy:1.0"
SPACES = {"gml": GML, "bt": MODEL}
REFERENCE = ("lokalnyId", "przestrzenNazw", "wersjaId")  # of the object that is drawn
DIGITS = 8  # after the point, as in the register


def check_cartographic(drawing: "Drawing") -> None:
    """Refuse a drawing that the model has no place for.

    Raises
    ------
    ParameterError
        If a standard has no cartographic code, an object no identifier of the register, or the
        CRS no code.
    """
    for drawn in drawing.objects:
        missing = [name for name in REFERENCE[:2] if name not in drawn.attributes]
        if missing:
            msg = f"OUT is .gml of BDOT500, but object {drawn.id!r} has no {missing[0]} to refer to"
            raise ParameterError(msg)
        if not drawn.symbols.standard.code:
            name = drawn.symbols.standard.name
            msg = f"OUT is .gml, but standard {name!r} has no cartographic code, expected pl-2015"
            raise ParameterError(msg)
    if drawing.objects and code_of(drawing.crs) is None:
        msg = "OUT is .gml, but the CRS of IN has no code, expected one of EPSG"
        raise ParameterError(msg)


def write_cartographic(path: "Path", drawing: "Drawing") -> None:
    """Write what is drawn as cartographic objects.

    Raises
    ------
    ParameterError
        If the model has no place for it.
    """
    check_cartographic(drawing)
    system = f"urn:ogc:def:crs:EPSG::{code_of(drawing.crs)}"
    order = slice(None, None, -1) if is_north_first(drawing.crs) else slice(None)
    numbers = count(1)
    with etree.xmlfile(str(path), encoding="utf-8") as file:
        file.write_declaration()
        with file.element(f"{{{GML}}}FeatureCollection", {f"{{{GML}}}id": "midrib"}, nsmap=SPACES):
            for drawn in drawing.objects:
                for line in outlines_and_lines(drawn):
                    points = shapely.get_coordinates(line)[:, order]
                    member = etree.Element(f"{{{GML}}}featureMember", nsmap=SPACES)
                    add_object(
                        member, drawn, points.ravel().tolist(), system, next(numbers), drawing.scale
                    )
                    file.write(member, pretty_print=True)


def outlines_and_lines(drawn: "Drawn") -> "Iterator[Any]":
    """Lines of the symbols of an object, and rings of filled ones; the outline is the object's."""
    flat = drawn.symbols.flat()
    yield from flat.lines
    yield from (area.exterior for area in flat.areas)


def add_object(
    member: "etree._Element",
    drawn: "Drawn",
    ordinates: list[float],
    system: str,
    number: int,
    scale: float,
) -> None:
    """Add one cartographic object."""
    said = drawn.attributes
    top = add(member, "KR_ObiektKarto", {f"{{{GML}}}id": f"midrib.{number}"})
    add(top, "mianownikSkali").text = f"{scale:.0f}"
    add(top, "kodKarto").text = drawn.symbols.standard.code
    attributes = {f"{{{GML}}}id": f"midrib.{number}.g", "srsName": system, "srsDimension": "2"}
    line = etree.SubElement(add(top, "geometriaKarto"), f"{{{GML}}}LineString", attributes)
    places = etree.SubElement(line, f"{{{GML}}}posList", {"srsDimension": "2"})
    places.text = " ".join(f"{ordinate:.{DIGITS}f}" for ordinate in ordinates)
    shown = add(add(top, "obiektPrzedstawiany"), "BT_ReferencjaDoObiektu")
    identifier = add(add(shown, "idIIP"), "BT_Identyfikator")
    for name in REFERENCE:
        if name in said:
            add(identifier, name).text = str(said[name])


def add(
    parent: "etree._Element", name: str, attributes: dict[str, str] | None = None
) -> "etree._Element":
    """Add an element of the model."""
    return etree.SubElement(parent, f"{{{MODEL}}}{name}", attributes or {})


def code_of(crs: str | None) -> str | None:
    """EPSG code of a CRS, None if it has none."""
    identifier = {} if crs is None else json.loads(crs).get("id", {})
    return str(identifier["code"]) if identifier.get("authority") == "EPSG" else None


def is_north_first(crs: str | None) -> bool:
    """Whether the definition of a CRS counts northwards first, as in Poland."""
    axes = horizontal(crs).get("coordinate_system", {}).get("axis", [])
    return bool(axes) and axes[0].get("direction") == "north"
