"""Files, features and tables: what is read, and what is asked about it."""

from pathlib import Path
from typing import Annotated, TypeAlias

from midrib.cli.options.panels import argument, of_check, of_layers, of_table

__all__ = [
    "ComparisonOut",
    "Dissolve",
    "DrawingOut",
    "End",
    "Exclude",
    "History",
    "Identifier",
    "Kind",
    "Layer",
    "LinesOrParts",
    "LinesOut",
    "Main",
    "OneFeature",
    "OnePart",
    "PointsIn",
    "PointsOut",
    "Scale",
    "SlopesIn",
    "Source",
    "Sources",
    "Standard",
    "Start",
    "StationSpacing",
    "Strokes",
    "TableOut",
    "Toe",
    "Top",
]

Source: TypeAlias = Annotated[Path, argument(metavar="IN", help="Vector file with areas.")]
Sources: TypeAlias = Annotated[
    Path,
    argument(metavar="IN", help="Vector file with areas, or a folder of .parquet files alike."),
]
LinesOrParts: TypeAlias = Annotated[
    Path,
    argument(
        metavar="OUT",
        help="File for the lines; its ending chooses the format: .gpkg .parquet .fgb .geojson "
        ".shp .gml .csv .dxf … Without an ending a folder for parts of GeoParquet: what an "
        "interrupted run has finished there is kept.",
    ),
]
LinesOut: TypeAlias = Annotated[
    Path,
    argument(
        metavar="OUT",
        help="File for the lines; its ending chooses the format: .gpkg .parquet .fgb .geojson "
        ".shp .gml .csv .dxf …",
    ),
]
TableOut: TypeAlias = Annotated[
    Path,
    argument(
        metavar="OUT",
        help="File for the table; its ending chooses the format: .csv for a plain table, "
        ".parquet .gpkg .fgb .shp … for one with the stations as points.",
    ),
]
ComparisonOut: TypeAlias = Annotated[
    Path,
    argument(
        metavar="OUT",
        help="File for the comparison: .svg, .png or .pdf for a figure, .html for a page with the "
        "figure and a table to be sorted, .csv for the table.",
    ),
]
Layer: TypeAlias = Annotated[
    str | None, of_layers(metavar="NAME", help="Layer of IN; needed if several hold areas.")
]
Main: TypeAlias = Annotated[
    str | None,
    of_layers(
        metavar="LAYER[:ID]|FIELD",
        help="Directional polylines, whose side of the area the line follows: a layer of IN "
        "with lines, matched by place or by a common field ID; or a field with WKT or hex WKB.",
    ),
]
OneFeature: TypeAlias = Annotated[
    str | None,
    of_layers(
        metavar="N|FIELD=VALUE",
        help="The feature: its number in the file, from 0, or the value of a field; needed if "
        "there are several.",
    ),
]
OnePart: TypeAlias = Annotated[
    int | None,
    of_layers(
        "--part",
        metavar="N",
        min=0,
        help="Of a feature with several parts: which one, from 0; the largest unless you say "
        "otherwise.",
    ),
]
SlopesIn: TypeAlias = Annotated[
    Path,
    argument(
        metavar="IN",
        help="Register of slopes: BDOT500 or BGT (.gml), a drawing (.dxf), or any vector file with "
        "areas and what tells their tops.",
    ),
]
Top: TypeAlias = Annotated[
    str | None,
    of_layers(
        metavar="LAYER[:ID]|FIELD",
        help="Lines along the tops: a layer of IN, matched by place or by a common field ID; or a "
        "field with WKT. Of a drawing: its layers, with wildcards.",
    ),
]
Toe: TypeAlias = Annotated[
    str | None,
    of_layers(
        metavar="LAYER",
        help="Lines along the toes, where IN has lines and no areas; --top is a layer then too.",
    ),
]
Start: TypeAlias = Annotated[
    str | None,
    of_layers(
        metavar="X,Y|LAYER:ID",
        help="Where the tops start, in the order the rings are stored in: two fields, or a layer "
        "of points with a common field ID.",
    ),
]
End: TypeAlias = Annotated[
    str | None, of_layers(metavar="X,Y|LAYER:ID", help="Where the tops end, likewise.")
]
Kind: TypeAlias = Annotated[
    str | None,
    of_layers(
        metavar="NAME|FIELD",
        help="What the objects are, whatever IN says: dyke, cutting, wall, stairs, conveyor, "
        "gantry, water-gate …; or a field of IN that tells.",
    ),
]
History: TypeAlias = Annotated[
    bool, of_layers("--history", metavar="", help="Objects too that have ended.")
]
Exclude: TypeAlias = Annotated[
    Path | None,
    of_layers("--exclude", metavar="FILE", help="Vector file with areas that no stroke may enter."),
]
Strokes: TypeAlias = Annotated[
    str | None,
    of_check(
        metavar="LAYER|FILE[:LAYER]",
        help="Strokes that are drawn already, in IN or in another file: which cross, which are "
        "outside of the slopes? Layers of a drawing take wildcards, and so do codes of "
        "cartographic objects in BDOT500: BUBZ*.",
    ),
]
Standard: TypeAlias = Annotated[
    str,
    of_check(metavar="NAME", help="How the slopes would be hatched: as of [bold]midrib hatch[/]."),
]
Scale: TypeAlias = Annotated[float, of_check(metavar="N", help="Scale of the map, 1 : N.")]
StationSpacing: TypeAlias = Annotated[
    str | None,
    of_table(
        "--spacing",
        metavar="LENGTH",
        help="Interval of the stations: 10m, 50cm, 10ft; a plain number is in units of the "
        "CRS, metres if it is geographic. The vertices of the line unless you say otherwise.",
    ),
]
Identifier: TypeAlias = Annotated[
    str | None,
    of_table(
        "--id", metavar="FIELD", help="Field of IN to put beside each row, and on the figure."
    ),
]
Dissolve: TypeAlias = Annotated[
    bool,
    of_layers(
        "--dissolve",
        metavar="",
        help="All areas as one: those that touch are one network, without their attributes.",
    ),
]
PointsOut: TypeAlias = Annotated[
    Path,
    argument(
        metavar="OUT",
        help="File for the points; its ending chooses the format: .gpkg .parquet .geojson .csv …",
    ),
]
DrawingOut: TypeAlias = Annotated[
    Path,
    argument(
        metavar="OUT",
        help="File for the drawing; its ending chooses the format: .gpkg with a style for QGIS, "
        ".dxf, .svg and .pdf to scale, .gml for KR_ObiektKarto of BDOT500, .geojson .shp …",
    ),
]
PointsIn: TypeAlias = Annotated[
    Path,
    argument(
        metavar="CLOUD", help="Points: .las .laz .e57 .ply .xyz .txt .csv .npy …, x y z with z up."
    ),
]
