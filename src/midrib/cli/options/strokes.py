"""How strokes are made."""

from typing import Annotated, TypeAlias

from midrib.cli.options.choices import DrawingRule, Letter, SharedEdges, StartSide
from midrib.cli.options.panels import of_strokes

__all__ = [
    "EndStrokes",
    "Factor",
    "First",
    "From",
    "Gap",
    "LargestGap",
    "LeastGap",
    "LeastLength",
    "MapScale",
    "Offset",
    "Pattern",
    "RuleOption",
    "SharedStrokes",
    "ShortRatio",
    "StandardName",
    "Stiffness",
    "StrokeWidth",
    "Symbol",
    "SymbolWidth",
    "TopShare",
]

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
SharedStrokes: TypeAlias = Annotated[
    SharedEdges,
    of_strokes(
        "--shared",
        metavar="NAME",
        help="Of slopes with a top or toe in common: meet, in step; between, half a gap on; apart.",
    ),
]
EndStrokes: TypeAlias = Annotated[
    bool,
    of_strokes(
        "--end-strokes",
        metavar="",
        help="Strokes on the straight ends of slopes too.",
    ),
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
    DrawingRule | None,
    of_strokes(
        "--rule",
        metavar="NAME",
        help="matching; mean: one gap for a slope, by the mean distance of the top's vertices from "
        "the toe, at right angles to the top; paper, for comparison. The standard's unless you say "
        "otherwise, matching for nearly all.",
    ),
]
