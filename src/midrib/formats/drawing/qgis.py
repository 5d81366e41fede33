"""Styles for QGIS: the table ``layer_styles`` of a GeoPackage, with one symbol for each standard.

QGIS takes the style whose ``useAsDefault`` is 1 when it opens a layer. Widths are millimetres.
Source: QGIS 3.22, what it writes itself by "Save as default" into a GeoPackage.
"""

import sqlite3
from contextlib import closing
from typing import TYPE_CHECKING

from lxml import etree

from midrib.formats.drawing.content import AREAS, EDGES, LINES, PROBLEMS, Drawing

if TYPE_CHECKING:
    from pathlib import Path

    from midrib.hatching.standard import Standard

__all__ = ["add_styles", "style_of"]

TABLE = """
CREATE TABLE layer_styles (
  id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, f_table_catalog TEXT(256),
  f_table_schema TEXT(256), f_table_name TEXT(256), f_geometry_column TEXT(256),
  styleName TEXT(30), styleQML TEXT, styleSLD TEXT, useAsDefault BOOLEAN, description TEXT,
  owner TEXT(30), ui TEXT(30), update_time DATETIME DEFAULT CURRENT_TIMESTAMP)
"""
CONTENTS = """
INSERT INTO gpkg_contents (table_name, data_type, identifier, description)
VALUES ('layer_styles', 'attributes', 'layer_styles', '')
"""
STYLE = """
INSERT INTO layer_styles (f_table_catalog, f_table_schema, f_table_name, f_geometry_column,
  styleName, styleQML, styleSLD, useAsDefault, description, owner)
SELECT '', '', table_name, column_name, table_name, ?, '', 1, ?, '' FROM gpkg_geometry_columns
WHERE table_name = ?
"""
PROBLEM = "215,48,39,255"
GEOMETRIES = {
    LINES: ("line", "1"),
    AREAS: ("fill", "2"),
    EDGES: ("line", "1"),
    PROBLEMS: ("marker", "0"),
}


def add_styles(path: "Path", drawing: Drawing, layers: list[str]) -> None:
    """Put a style for each layer into a GeoPackage."""
    with closing(sqlite3.connect(path)) as file, file:
        file.execute(TABLE)
        file.execute(CONTENTS)
        for layer in layers:
            text = style_of(layer, drawing)
            about = f"midrib, for 1:{drawing.scale:g}; widths in millimetres"
            file.execute(STYLE, (text, about, layer))


def style_of(layer: str, drawing: Drawing) -> str:
    """Style of a layer as QML: by standard; of problems a dot."""
    kind, number = GEOMETRIES[layer]
    qgis = etree.Element("qgis", version="3.22.0", styleCategories="Symbology")
    if layer == PROBLEMS:
        renderer = etree.SubElement(qgis, "renderer-v2", type="singleSymbol")
        add_symbol(etree.SubElement(renderer, "symbols"), 0, kind, "SimpleMarker", marker())
    else:
        renderer = etree.SubElement(qgis, "renderer-v2", type="categorizedSymbol", attr="standard")
        categories = etree.SubElement(renderer, "categories")
        symbols = etree.SubElement(renderer, "symbols")
        for i, (name, known) in enumerate(drawing.standards.items()):
            etree.SubElement(
                categories, "category", value=name, symbol=str(i), label=known.title, render="true"
            )
            if layer == AREAS:
                add_symbol(symbols, i, kind, "SimpleFill", fill(known))
            else:
                add_symbol(symbols, i, kind, "SimpleLine", line(known, is_edge=layer == EDGES))
    etree.SubElement(qgis, "layerGeometryType").text = number
    text: str = etree.tostring(qgis, encoding="unicode", pretty_print=True)
    return text


def add_symbol(
    symbols: "etree._Element", number: int, kind: str, what: str, options: dict[str, str]
) -> None:
    """Add a symbol of one layer."""
    symbol = etree.SubElement(symbols, "symbol", type=kind, name=str(number), alpha="1")
    layer = etree.SubElement(
        symbol, "layer", {"class": what, "enabled": "1", "locked": "0", "pass": "0"}
    )
    table = etree.SubElement(layer, "Option", type="Map")
    for name, value in options.items():
        etree.SubElement(table, "Option", type="QString", name=name, value=value)


def line(known: "Standard", *, is_edge: bool) -> dict[str, str]:
    """Options of a line, that of an outline or that of strokes."""
    dashes = known.outline_dash if is_edge else ()
    width = known.outline_width if is_edge else known.stroke_width
    return {
        "line_color": colour(known),
        "line_style": "solid",
        "line_width": f"{width:g}",
        "line_width_unit": "MM",
        "capstyle": "flat",
        "joinstyle": "miter" if is_edge else "bevel",
        "use_custom_dash": "1" if dashes else "0",
        "customdash": ";".join(f"{length:g}" for length in dashes or (5, 2)),
        "customdash_unit": "MM",
    }


def fill(known: "Standard") -> dict[str, str]:
    """Options of a filled area without an outline."""
    return {"color": colour(known), "style": "solid", "outline_style": "no"}


def marker() -> dict[str, str]:
    """Options of a dot."""
    return {
        "name": "circle",
        "color": PROBLEM,
        "outline_style": "no",
        "size": "2",
        "size_unit": "MM",
    }


def colour(known: "Standard") -> str:
    """Colour of a standard as QGIS writes it."""
    red, green, blue = bytes.fromhex(known.colour[1:])
    return f"{red},{green},{blue},255"
