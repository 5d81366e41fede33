"""Arguments and options of the commands: each with its name, its choices and its help text, once.

A command says which of them it has, in which order, and what they are unless given. Options of the
line are those of ``midrib.curves.construction``, under the same names.
"""

from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import Annotated, TypeAlias

import typer

__all__ = [
    "Aspect",
    "Centring",
    "CentringOption",
    "Channel",
    "ChannelOption",
    "CloudUnit",
    "ComparisonOut",
    "Connect",
    "Count",
    "Dissolve",
    "DrawingOut",
    "DrawingRule",
    "End",
    "EndClearance",
    "EndRule",
    "EndStrokes",
    "EndsOption",
    "Exclude",
    "Factor",
    "FindingsFigure",
    "FindingsOut",
    "First",
    "From",
    "Gap",
    "History",
    "Holes",
    "HolesOption",
    "Identifier",
    "LabelHeight",
    "LabelLength",
    "LargestGap",
    "Layer",
    "LeastBranch",
    "LeastGap",
    "LeastLength",
    "LeastPart",
    "Letter",
    "LevelStep",
    "Levelling",
    "LineFigure",
    "LinesOut",
    "Main",
    "MapScale",
    "Mean",
    "MeanOption",
    "Merge",
    "Method",
    "Methods",
    "NarrowerThan",
    "Near",
    "Offset",
    "OneFeature",
    "OutLayer",
    "Overwrite",
    "PaperSize",
    "Pattern",
    "Percent",
    "PointCount",
    "PointTolerance",
    "PointsIn",
    "PointsOut",
    "Quiet",
    "RadiusRange",
    "Registration",
    "ReportTitle",
    "RuleOption",
    "Scale",
    "ShortRatio",
    "Significance",
    "Simplify",
    "SkeletonMethod",
    "SkipOption",
    "SkipRule",
    "SlopesIn",
    "Smooth",
    "Source",
    "Spacing",
    "Standard",
    "StandardName",
    "Start",
    "StartSide",
    "StationSpacing",
    "Stiffness",
    "StrokeWidth",
    "Strokes",
    "Symbol",
    "SymbolWidth",
    "TableFigure",
    "TableOut",
    "Toe",
    "Tolerance",
    "Top",
    "TopShare",
    "TowerMode",
    "TowerModeOption",
    "TowerOut",
    "TowerReport",
    "TowerShape",
    "TowerShapeOption",
    "Verticality",
    "Vertices",
    "Width",
    "WidthPlace",
    "chosen",
]


class EndRule(StrEnum):
    """Rules for the ends of a line."""

    main = "main"
    caps = "caps"
    radii = "radii"
    none = "none"


class Centring(StrEnum):
    """Ways of centring a line."""

    none = "none"
    symmetric = "symmetric"
    centred = "centred"


class Mean(StrEnum):
    """Means of the two curves of a symmetric line."""

    radii = "radii"
    proportional = "proportional"
    kinks = "kinks"
    same_height = "same-height"


class SkipRule(StrEnum):
    """Stations that are dropped."""

    bays = "bays"
    none = "none"


class Holes(StrEnum):
    """What holes are."""

    blocked = "blocked"
    auxiliary = "auxiliary"
    ignored = "ignored"


class Channel(StrEnum):
    """On which side of islands a line passes."""

    shorter = "shorter"
    wider = "wider"


USUAL: dict[str, StrEnum] = {
    "centring": Centring.centred,
    "holes": Holes.blocked,
    "channel": Channel.shorter,
    "ends": EndRule.caps,
}


def chosen(**values: StrEnum) -> dict[str, str | None]:
    """Options of ``collapse`` that are not the usual ones, which some methods do not have."""
    found = {name: value for name, value in values.items() if value is not USUAL[name]}
    return {name: None if value is EndRule.none else value.value for name, value in found.items()}


class WidthPlace(StrEnum):
    """Where the width of areas is written."""

    columns = "columns"
    m = "m"


class StartSide(StrEnum):
    """Where a pattern of strokes starts."""

    left = "left"
    right = "right"
    first = "first"
    last = "last"


class Letter(StrEnum):
    """Lengths of strokes."""

    long = "long"
    short = "short"


class DrawingRule(StrEnum):
    """How strokes are found."""

    matching = "matching"
    paper = "paper"


class TowerMode(StrEnum):
    """Ways to find a tower's axis."""

    joint = "joint"
    fan = "fan"
    paper = "paper"


class TowerShape(StrEnum):
    """What a tower's sections are taken for."""

    auto = "auto"
    round = "round"
    polygon = "polygon"


argument = partial(typer.Argument, show_default=False)
of_layers = partial(typer.Option, rich_help_panel="Which features")
of_table = partial(typer.Option, rich_help_panel="What the table holds")
of_check = partial(typer.Option, rich_help_panel="What is checked")
of_strokes = partial(typer.Option, rich_help_panel="How strokes are made, lengths in mm on paper")
of_line = partial(typer.Option, rich_help_panel="How the line is made")
of_care = partial(typer.Option, rich_help_panel="After-care")
of_tower = partial(typer.Option, rich_help_panel="How the axis is found")
of_output = partial(typer.Option, rich_help_panel="Output")

Source: TypeAlias = Annotated[Path, argument(metavar="IN", help="Vector file with areas.")]
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

# Which features

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

# Which slopes

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
History: TypeAlias = Annotated[
    bool, of_layers("--history", metavar="", help="Objects too that have ended.")
]

Exclude: TypeAlias = Annotated[
    Path | None,
    of_layers("--exclude", metavar="FILE", help="Vector file with areas that no stroke may enter."),
]

# What is checked

Strokes: TypeAlias = Annotated[
    str | None,
    of_check(
        metavar="LAYER|FILE[:LAYER]",
        help="Strokes that are drawn already, in IN or in another file: do any cross? Layers of a "
        "drawing take wildcards, and so do codes of cartographic objects in BDOT500: BUBZ*.",
    ),
]
Standard: TypeAlias = Annotated[
    str,
    of_check(metavar="NAME", help="How the slopes would be hatched: as of [bold]midrib hatch[/]."),
]
Scale: TypeAlias = Annotated[float, of_check(metavar="N", min=1.0, help="Scale of the map, 1 : N.")]

# What the table holds

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

# How the line is made

Methods: TypeAlias = Annotated[
    str | None,
    of_line(metavar="NAME,NAME", help="Some of [bold]midrib methods[/], the first is the measure."),
]
Method: TypeAlias = Annotated[str, of_line(metavar="NAME", help="One of [bold]midrib methods[/].")]
Spacing: TypeAlias = Annotated[
    str | None,
    of_line(
        metavar="LENGTH",
        help="Interval of the radii: 2m, 50cm, 10ft; a plain number is in units of the CRS, "
        "metres if it is geographic. The mean width unless you say otherwise.",
    ),
]
Count: TypeAlias = Annotated[int | None, of_line(metavar="N", help="Or: number of intervals.")]
Percent: TypeAlias = Annotated[
    float | None, of_line(metavar="N", help="Or: interval in percent of the side's length.")
]
Vertices: TypeAlias = Annotated[
    bool | None,
    of_line(
        metavar="",
        help="Radii at the vertices of the side too; yes, unless the line is centred.",
        show_default=False,
    ),
]
CentringOption: TypeAlias = Annotated[
    Centring,
    of_line(
        metavar="HOW",
        help="centred: equally far from both sides; symmetric: mean of the two curves from "
        "either side; none: the paper's curve.",
    ),
]
Tolerance: TypeAlias = Annotated[
    str | None,
    of_line(
        metavar="LENGTH|PERCENT",
        help="How far off the middle a centred line may be where it is probed, a quarter of the "
        "width apart; 1% of the mean width unless you say otherwise, 0 for exact lines. Of other "
        "lines how far off the limit of ever denser radii. A length, or a share of the width: 1%.",
    ),
]
MeanOption: TypeAlias = Annotated[
    Mean | None,
    of_line(
        metavar="NAME", help="Mean of a symmetric line: radii, proportional, kinks, same-height."
    ),
]
SkipOption: TypeAlias = Annotated[
    SkipRule | None,
    of_line(
        metavar="WHICH",
        help="Radii to leave out. bays: those in bays and side arms, as of the paper's curve "
        "unless you say otherwise; none: no radius.",
    ),
]
HolesOption: TypeAlias = Annotated[
    Holes,
    of_line(
        metavar="WHAT",
        help="What holes are. blocked: in the way, the line goes round them; auxiliary: parts "
        "of the other side, the line stays between the main side and them; ignored: nothing, "
        "the line may cross them, and they do not bound widths.",
    ),
]
ChannelOption: TypeAlias = Annotated[
    Channel,
    of_line(
        metavar="WHICH",
        help="Where a centred line passes islands: the shorter way, or through the wider channels.",
    ),
]
EndsOption: TypeAlias = Annotated[
    EndRule,
    of_line(
        metavar="RULE",
        help="Where the line ends. caps: in the middles of the end caps; main: at the ends of "
        "the main side; radii: at the middles of its last radii to other segments; none: with "
        "its last radius.",
    ),
]
EndClearance: TypeAlias = Annotated[
    str | None,
    of_line(
        metavar="RULE|LENGTH",
        help="What keeps radii out of a tip that both sides share: station, proportional, "
        "none, or a length; proportional, unless the line is centred.",
    ),
]
Connect: TypeAlias = Annotated[
    bool,
    of_line(
        "--connect",
        metavar="",
        help="Lines of areas that share an edge meet; joints, and edges without one, go to a "
        "layer, or a file, …_joints.",
    ),
]

# How a network is made

Dissolve: TypeAlias = Annotated[
    bool,
    of_layers(
        "--dissolve",
        metavar="",
        help="All areas as one: those that touch are one network, without their attributes.",
    ),
]
SkeletonMethod: TypeAlias = Annotated[
    str, of_line(metavar="NAME", help="One of [bold]midrib methods[/] that have branches.")
]
Merge: TypeAlias = Annotated[
    float,
    of_line(
        metavar="N",
        help="Junctions are one crossing up to so many times the sum of their radii apart, twice "
        "as many where all arms lead to one point. 0 keeps those of the skeleton.",
    ),
]
NarrowerThan: TypeAlias = Annotated[
    str,
    of_line(
        "--narrower-than",
        metavar="LENGTH",
        help="Parts that are less wide become lines: 20m, 50ft; a plain number is in units of the "
        "CRS, metres if it is geographic.",
        show_default=False,
    ),
]
LeastPart: TypeAlias = Annotated[
    str | None,
    of_line(
        "--min-length",
        metavar="LENGTH",
        help="Shorter parts go with what is beside them, unless they are 1.25 times as wide as "
        "that. As long as it is wide unless you say otherwise.",
    ),
]
LeastBranch: TypeAlias = Annotated[
    str | None,
    of_line("--min-branch-length", metavar="LENGTH", help="Leave out shorter dead ends."),
]
Significance: TypeAlias = Annotated[
    float,
    of_line(
        metavar="N",
        help="Leave out dead ends that reach less than so many radii from their junction; a "
        "corner reaches 1.41.",
    ),
]

# Labels and points

LabelLength: TypeAlias = Annotated[
    str | None,
    of_line("--length", metavar="LENGTH", help="Of the text; as long as fits unless given."),
]
LabelHeight: TypeAlias = Annotated[
    str | None,
    of_line("--height", metavar="LENGTH", help="Of the text; as high as fits unless given."),
]
Aspect: TypeAlias = Annotated[
    float, of_line(metavar="N", help="Length over height of the text, where neither is given.")
]
PointsOut: TypeAlias = Annotated[
    Path,
    argument(
        metavar="OUT",
        help="File for the points; its ending chooses the format: .gpkg .parquet .geojson .csv …",
    ),
]
PointCount: TypeAlias = Annotated[
    int | None, of_line("--count", metavar="N", help="So many points of each line at most.")
]
PointTolerance: TypeAlias = Annotated[
    str | None,
    of_line(
        "--tolerance",
        metavar="LENGTH",
        help="Or: as few as keep the whole line this near to the line through them.",
    ),
]

# After-care

Simplify: TypeAlias = Annotated[
    str | None,
    of_care(
        metavar="LENGTH|PERCENT",
        help="Leave out vertices as long as the line stays this near to the full one, inside "
        "the area: 50cm, or 5% of the mean width.",
    ),
]
Smooth: TypeAlias = Annotated[
    bool,
    of_care(
        "--smooth",
        metavar="",
        help="Cut the line's corners, inside the area, in three rounds.",
    ),
]

# How strokes are made

StandardName: TypeAlias = Annotated[
    str,
    of_strokes(
        metavar="NAME|FILE",
        help="One of [bold]midrib standards[/], the beginning of some (pl-2015, each object by "
        "the one made for its kind), or a .toml file of your own.",
    ),
]
MapScale: TypeAlias = Annotated[float, of_strokes(metavar="N", help="Of the map: 500 for 1:500.")]
Symbol: TypeAlias = Annotated[
    str | None,
    of_strokes(
        metavar="NAME",
        help="line, wedge, triangle, filled-triangle, tapered, y, tadpole. This and what follows "
        "is the standard's, unless you say otherwise.",
    ),
]
SymbolWidth: TypeAlias = Annotated[
    float | None, of_strokes(metavar="MM", help="Width of wedges, triangles, forks, heads.")
]
StrokeWidth: TypeAlias = Annotated[
    float | None, of_strokes(metavar="MM", help="Width of the line of strokes.")
]
Factor: TypeAlias = Annotated[
    float | None, of_strokes(metavar="N", help="Gap between strokes over their length.")
]
Gap: TypeAlias = Annotated[
    float | None, of_strokes("--spacing", metavar="MM", help="Or: a fixed gap.")
]
LeastGap: TypeAlias = Annotated[
    float | None, of_strokes("--min-spacing", metavar="MM", help="Least gap.")
]
LargestGap: TypeAlias = Annotated[
    float | None, of_strokes("--max-spacing", metavar="MM", help="Largest gap.")
]
Pattern: TypeAlias = Annotated[
    str | None, of_strokes(metavar="LS", help="Long and short in turn: LS, LSS, LSSL, L.")
]
ShortRatio: TypeAlias = Annotated[
    float | None, of_strokes(metavar="N", help="Length of a short stroke over that of a long one.")
]
LeastLength: TypeAlias = Annotated[
    float | None, of_strokes("--min-length", metavar="MM", help="Shortest whole stroke.")
]
From: TypeAlias = Annotated[
    StartSide,
    of_strokes(
        "--from", metavar="SIDE", help="Where the pattern starts: left, right, first, last."
    ),
]
Offset: TypeAlias = Annotated[
    float, of_strokes(metavar="N", help="Where the first stroke falls, in gaps from the start.")
]
First: TypeAlias = Annotated[
    Letter | None, of_strokes(metavar="long|short", help="What the first stroke is.")
]
EndStrokes: TypeAlias = Annotated[
    bool,
    of_strokes("--end-strokes", metavar="", help="Strokes on the straight ends of slopes too."),
]
Stiffness: TypeAlias = Annotated[
    float | None,
    of_strokes(metavar="N", help="More turns slower at corners, less is nearer to normals: 0.9."),
]
TopShare: TypeAlias = Annotated[
    float | None,
    of_strokes(metavar="0-1", help="1: at right angles to the top; 0: to both edges alike."),
]
RuleOption: TypeAlias = Annotated[
    DrawingRule, of_strokes("--rule", metavar="NAME", help="matching; paper, for comparison.")
]

# Output

DrawingOut: TypeAlias = Annotated[
    Path,
    argument(
        metavar="OUT",
        help="File for the drawing; its ending chooses the format: .gpkg with a style for QGIS, "
        ".dxf, .svg and .pdf to scale, .gml for KR_ObiektKarto of BDOT500, .geojson .shp …",
    ),
]
PaperSize: TypeAlias = Annotated[
    str | None,
    of_output(
        "--paper",
        metavar="A4…A0",
        help="Size of a .svg or .pdf sheet; as large as it needs to be unless you say otherwise.",
    ),
]
Width: TypeAlias = Annotated[
    WidthPlace,
    of_output(
        metavar="columns|m",
        help="Where the width along the line is written. columns: its mean and maximum; m: "
        "beside them, as the M value of every vertex.",
    ),
]
OutLayer: TypeAlias = Annotated[
    str | None,
    of_output(metavar="NAME", help="Layer of OUT; named as in IN unless you say otherwise."),
]
LineFigure: TypeAlias = Annotated[
    Path | None,
    of_output("--figure", metavar="FILE", help="Draw areas and lines too: .svg .png .pdf"),
]
TableFigure: TypeAlias = Annotated[
    Path | None,
    of_output("--figure", metavar="FILE", help="Plot width against station too: .svg .png .pdf"),
]
FindingsOut: TypeAlias = Annotated[
    Path | None,
    of_output(
        "--out",
        "-o",
        metavar="FILE",
        help="Write the table too: .csv plain; .geojson .gpkg .parquet … with places as points.",
    ),
]
FindingsFigure: TypeAlias = Annotated[
    Path | None,
    of_output(
        "--figure", metavar="FILE", help="Draw slopes and places of findings too: .svg .png .pdf"
    ),
]
Overwrite: TypeAlias = Annotated[bool, of_output("--overwrite", metavar="", help="Replace files.")]
Quiet: TypeAlias = Annotated[
    bool, of_output("--quiet", "-q", metavar="", help="No progress, no summary.")
]

PointsIn: TypeAlias = Annotated[
    Path,
    argument(
        metavar="CLOUD", help="Points: .las .laz .e57 .ply .xyz .txt .csv .npy …, x y z with z up."
    ),
]
TowerReport: TypeAlias = Annotated[
    Path | None,
    of_output(
        "--report",
        metavar="FILE",
        help="Report with figures and the table of levels: .html, or .pdf for print.",
    ),
]
TowerOut: TypeAlias = Annotated[
    list[Path] | None,
    of_output(
        "--out",
        "-o",
        metavar="FILE",
        help="Levels and axis; the ending chooses the format: .csv for the table of levels, .dxf "
        "for the axis in space, .gpkg .parquet … for layers. May be given several times.",
    ),
]
TowerModeOption: TypeAlias = Annotated[
    TowerMode,
    of_tower(
        "--mode",
        help="joint: one spline cone through the whole shell; fan: curves of minimal radii in 18 "
        "planes through the axis; paper: in two planes.",
    ),
]
TowerShapeOption: TypeAlias = Annotated[
    TowerShape,
    of_tower("--shape", help="What sections are taken for; auto looks what explains the points."),
]
LevelStep: TypeAlias = Annotated[
    str | None,
    of_tower("--step", metavar="LENGTH", help="Distance of levels, 1m; half a metre unless given."),
]
Near: TypeAlias = Annotated[
    str | None,
    of_tower("--near", metavar="X,Y", help="A place on or beside which the tower stands."),
]
RadiusRange: TypeAlias = Annotated[
    str | None,
    of_tower("--radius", metavar="MIN,MAX", help="Least and largest radius of the tower: 1m,5m."),
]
CloudUnit: TypeAlias = Annotated[
    str | None,
    of_tower(
        "--unit",
        metavar="UNIT",
        help="Unit of the coordinates, m ft usft …; what the file says, or metres, unless given.",
    ),
]
Registration: TypeAlias = Annotated[
    str | None,
    of_tower(
        "--registration",
        metavar="LENGTH",
        help="Standard deviation of the stations' registration, 2mm: added to the uncertainty.",
    ),
]
Levelling: TypeAlias = Annotated[
    float,
    of_tower(
        "--levelling",
        metavar="MM_PER_M",
        help="Standard deviation of the vertical in mm per m: added to the uncertainty.",
    ),
]
Verticality: TypeAlias = Annotated[
    str | None,
    of_tower(
        "--tolerance",
        metavar="TEXT",
        help="Allowed deviation: a length (50mm), a share of the height (h/1000), or their sum.",
    ),
]
ReportTitle: TypeAlias = Annotated[
    str | None, of_output("--title", metavar="TEXT", help="Heading of the report.")
]
