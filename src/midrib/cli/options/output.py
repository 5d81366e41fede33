"""What is written, and where."""

from pathlib import Path
from typing import Annotated, TypeAlias

from midrib.cli.options.choices import WidthPlace
from midrib.cli.options.panels import of_output

__all__ = [
    "FindingsFigure",
    "FindingsOut",
    "LineFigure",
    "NoProblems",
    "OutLayer",
    "Overwrite",
    "PaperSize",
    "Quiet",
    "Radius",
    "ReportTitle",
    "TableFigure",
    "TowerOut",
    "TowerReport",
    "Width",
]

PaperSize: TypeAlias = Annotated[
    str | None,
    of_output(
        "--paper",
        metavar="A4…A0",
        help="Size of a .svg or .pdf sheet; as large as it needs to be unless you say otherwise.",
    ),
]
NoProblems: TypeAlias = Annotated[
    bool,
    of_output(
        "--no-problems",
        metavar="",
        help="No marks where something is amiss on sheets and in .dxf; layers keep theirs.",
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
Radius: TypeAlias = Annotated[
    WidthPlace,
    of_output(
        metavar="columns|m",
        help="Where the distance to the boundary is written. columns: the least and the greatest "
        "of each branch; m: beside them, as the M value of every vertex.",
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
TowerReport: TypeAlias = Annotated[
    list[Path] | None,
    of_output(
        "--report",
        metavar="FILE",
        help="Report with figures and the table of levels: .html, or .pdf for print. May be given "
        "several times.",
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
ReportTitle: TypeAlias = Annotated[
    str | None, of_output("--title", metavar="TEXT", help="Heading of the report.")
]
