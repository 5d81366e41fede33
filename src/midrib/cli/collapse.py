"""The command ``midrib collapse``."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer

from midrib.errors import ParameterError

__all__ = ["Channel", "Holes", "collapse"]

CLEARANCES = {"station": "station", "proportional": "proportional", "none": None}
LAYERS, LINE, CARE, OUTPUT = "Which features", "How the line is made", "After-care", "Output"


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
    same_height = "same-height"


class Holes(StrEnum):
    """What holes are."""

    blocked = "blocked"
    auxiliary = "auxiliary"
    ignored = "ignored"


class Channel(StrEnum):
    """On which side of islands a line passes."""

    shorter = "shorter"
    wider = "wider"


class WidthPlace(StrEnum):
    """Where the width of areas is written."""

    columns = "columns"
    m = "m"


def collapse(
    source: Annotated[
        Path, typer.Argument(metavar="IN", help="Vector file with areas.", show_default=False)
    ],
    out: Annotated[
        Path,
        typer.Argument(
            metavar="OUT",
            help="File for the lines; its ending chooses the format: .gpkg .parquet .fgb .geojson "
            ".shp .gml .csv .dxf …",
            show_default=False,
        ),
    ],
    layer: Annotated[
        str | None,
        typer.Option(
            help="Layer of IN; needed if several hold areas.",
            rich_help_panel=LAYERS,
            metavar="NAME",
        ),
    ] = None,
    main: Annotated[
        str | None,
        typer.Option(
            metavar="LAYER[:ID]|FIELD",
            help="Directional polylines, whose side of the area the line follows: a layer of IN "
            "with lines, matched by place or by a common field ID; or a field with WKT or hex WKB.",
            rich_help_panel=LAYERS,
        ),
    ] = None,
    method: Annotated[
        str,
        typer.Option(metavar="NAME", help="One of [bold]midrib methods[/].", rich_help_panel=LINE),
    ] = "minimal-radii",
    spacing: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH",
            help="Interval of the radii: 2m, 50cm, 10ft; a plain number is in units of the CRS, "
            "metres if it is geographic. The mean width unless you say otherwise.",
            rich_help_panel=LINE,
        ),
    ] = None,
    count: Annotated[
        int | None, typer.Option(metavar="N", help="Or: number of intervals.", rich_help_panel=LINE)
    ] = None,
    percent: Annotated[
        float | None,
        typer.Option(
            metavar="N", help="Or: interval in percent of the side's length.", rich_help_panel=LINE
        ),
    ] = None,
    vertices: Annotated[
        bool | None,
        typer.Option(
            metavar="",
            help="Radii at the vertices of the side too; yes, unless the line is centred.",
            rich_help_panel=LINE,
            show_default=False,
        ),
    ] = None,
    centring: Annotated[
        Centring,
        typer.Option(
            metavar="HOW",
            help="centred: equally far from both sides; symmetric: mean of the two curves from "
            "either side; none: the paper's curve.",
            rich_help_panel=LINE,
        ),
    ] = Centring.centred,
    tolerance: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH",
            help="How far off the middle a centred line may be; a 100th of the mean width unless "
            "you say otherwise.",
            rich_help_panel=LINE,
        ),
    ] = None,
    mean: Annotated[
        Mean | None,
        typer.Option(
            metavar="NAME",
            help="Mean of a symmetric line: radii, proportional, same-height.",
            rich_help_panel=LINE,
        ),
    ] = None,
    holes: Annotated[
        Holes,
        typer.Option(
            metavar="WHAT",
            help="What holes are. blocked: in the way, the line goes round them; auxiliary: parts "
            "of the other side, the line stays between the main side and them; ignored: nothing, "
            "the line may cross them.",
            rich_help_panel=LINE,
        ),
    ] = Holes.blocked,
    channel: Annotated[
        Channel,
        typer.Option(
            metavar="WHICH",
            help="Where a centred line passes islands: the shorter way, or through the wider "
            "channels.",
            rich_help_panel=LINE,
        ),
    ] = Channel.shorter,
    ends: Annotated[
        EndRule,
        typer.Option(
            metavar="RULE",
            help="Where the line ends. caps: in the middles of the end caps; main: at the ends of "
            "the main side; radii: at the middles of its last radii to other segments; none: with "
            "its last radius.",
            rich_help_panel=LINE,
        ),
    ] = EndRule.caps,
    end_clearance: Annotated[
        str | None,
        typer.Option(
            metavar="RULE|LENGTH",
            help="What keeps radii out of a tip that both sides share: station, proportional, "
            "none, or a length; proportional, unless the line is centred.",
            rich_help_panel=LINE,
        ),
    ] = None,
    connect: Annotated[
        bool,
        typer.Option(
            "--connect",
            metavar="",
            help="Lines of areas that share an edge meet; joints, and edges without one, go to a "
            "layer, or a file, …_joints.",
            rich_help_panel=LINE,
        ),
    ] = False,
    simplify: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH|PERCENT",
            help="Leave out vertices as long as the line stays this near to the full one, inside "
            "the area: 50cm, or 5% of the mean width.",
            rich_help_panel=CARE,
        ),
    ] = None,
    smooth: Annotated[
        bool,
        typer.Option(
            "--smooth",
            metavar="",
            help="Cut the line's corners, inside the area, in three rounds.",
            rich_help_panel=CARE,
        ),
    ] = False,
    width: Annotated[
        WidthPlace,
        typer.Option(
            metavar="columns|m",
            help="Where the width along the line is written. columns: its mean and maximum; m: "
            "beside them, as the M value of every vertex.",
            rich_help_panel=OUTPUT,
        ),
    ] = WidthPlace.columns,
    out_layer: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            help="Layer of OUT; named as in IN unless you say otherwise.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Draw areas and lines too: .svg .png .pdf", rich_help_panel=OUTPUT
        ),
    ] = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", metavar="", help="Replace files.", rich_help_panel=OUTPUT)
    ] = False,
    quiet: Annotated[
        bool,
        typer.Option(
            "--quiet", "-q", metavar="", help="No progress, no summary.", rich_help_panel=OUTPUT
        ),
    ] = False,
) -> None:
    """Collapse areas to lines: one line without branches inside each."""
    from midrib.cli.guides import guides_for
    from midrib.cli.job import Results, check_options, collapse_layer
    from midrib.cli.output import Places, draw
    from midrib.cli.report import Report
    from midrib.formats.reading import choose_layer, open_layer
    from midrib.formats.units import length_in

    if connect:
        check_alone(main=main, ends=ends)
    places = Places(source, out, figure, connect)
    places.check(overwrite=overwrite, needs_m=width is WidthPlace.m)
    layer = choose_layer(source, layer)
    report = Report(quiet=quiet)
    with open_layer(source, layer) as features:
        given = {
            "count": count,
            "percent": percent,
            "vertices": vertices,
            "mean": mean and mean.value,
            "smooth": smooth or None,
            "spacing": spacing and length_in(spacing, features.crs, "--spacing"),
            "tolerance": tolerance and length_in(tolerance, features.crs, "--tolerance"),
            "simplify": simplify and deviation(simplify, features.crs),
        }
        options: dict[str, Any] = {k: value for k, value in given.items() if value is not None}
        options |= {"centring": centring.value, "holes": holes.value, "channel": channel.value}
        options["ends"] = None if ends is EndRule.none else ends.value
        if end_clearance is not None:
            options["end_clearance"] = clearance(end_clearance, features.crs)
        check_options(method, options)
        guides = guides_for(main, source, features)
        results = Results(features, has_m=width is WidthPlace.m)
        collapse_layer(results, method, options, guides, report, connect=connect)
    places.write(results, out_layer or layer, report)
    if figure is not None:
        with open_layer(source, layer) as features:
            draw(features, guides, options | {"connect": connect}, figure)
    if results.n_refused:
        raise typer.Exit(1)


def check_alone(*, main: str | None, ends: EndRule) -> None:
    """Refuse options that ``--connect`` cannot be given with."""
    for name, is_given in {"--main": main is not None, "--ends": ends is not EndRule.caps}.items():
        if is_given:
            msg = f"--connect excludes {name}: joints place the ends"
            raise ParameterError(msg)


def clearance(text: str, crs: str | None) -> str | float | None:
    """Read the clearance at the ends: the name of a rule, None or a length."""
    from midrib.formats.units import length_in

    if text in CLEARANCES:
        return CLEARANCES[text]
    try:
        return length_in(text, crs, "--end-clearance")
    except ParameterError as error:
        msg = f"{error}, or station, proportional, none"
        raise ParameterError(msg) from None


def deviation(text: str, crs: str | None) -> str | float:
    """Read the deviation of a simplified line: a percentage as it stands, or a length."""
    from midrib.formats.units import length_in

    if text.strip().endswith("%"):
        return text
    try:
        return length_in(text, crs, "--simplify")
    except ParameterError as error:
        msg = f"{error}, or a share of the width: 5%"
        raise ParameterError(msg) from None
