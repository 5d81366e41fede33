"""The command ``midrib profile``."""

from pathlib import Path
from typing import Annotated

import typer

from midrib.cli.collapse import Channel, Holes

__all__ = ["profile"]

LAYERS, TABLE, OUTPUT = "Which features", "What the table holds", "Output"


def profile(
    source: Annotated[
        Path, typer.Argument(metavar="IN", help="Vector file with areas.", show_default=False)
    ],
    out: Annotated[
        Path,
        typer.Argument(
            metavar="OUT",
            help="File for the table; its ending chooses the format: .csv for a plain table, "
            ".parquet .gpkg .fgb .shp … for one with the stations as points.",
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
            help="Directional polylines, as in [bold]midrib collapse[/].",
            rich_help_panel=LAYERS,
        ),
    ] = None,
    spacing: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH",
            help="Interval of the stations: 10m, 50cm, 10ft; a plain number is in units of the "
            "CRS, metres if it is geographic. The vertices of the line unless you say otherwise.",
            rich_help_panel=TABLE,
        ),
    ] = None,
    identifier: Annotated[
        str | None,
        typer.Option(
            "--id",
            metavar="FIELD",
            help="Field of IN to put beside each row, and on the figure.",
            rich_help_panel=TABLE,
        ),
    ] = None,
    method: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Of the line: one of [bold]midrib methods[/].",
            rich_help_panel=TABLE,
        ),
    ] = "minimal-radii",
    holes: Annotated[
        Holes,
        typer.Option(
            metavar="WHAT",
            help="What holes are to the line, as in [bold]midrib collapse[/]; ignored ones do not "
            "bound the widths.",
            rich_help_panel=TABLE,
        ),
    ] = Holes.blocked,
    channel: Annotated[
        Channel,
        typer.Option(
            metavar="WHICH",
            help="Where the line passes islands, as in [bold]midrib collapse[/].",
            rich_help_panel=TABLE,
        ),
    ] = Channel.shorter,
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
            metavar="FILE",
            help="Plot width against station too: .svg .png .pdf",
            rich_help_panel=OUTPUT,
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
    """Measure the width of areas along their lines: a table of stations and widths."""
    from midrib.cli.guides import guides_for
    from midrib.cli.job import check_options
    from midrib.cli.output import Places
    from midrib.cli.report import Report
    from midrib.cli.tables import Table, check_field, check_table, profile_layer, write_table
    from midrib.formats.reading import choose_layer, open_layer
    from midrib.formats.units import length_in

    places = Places(source, out, figure)
    check_table(out)
    places.check(overwrite=overwrite)
    layer = choose_layer(source, layer)
    report = Report(quiet=quiet)
    with open_layer(source, layer) as features:
        options = {"holes": holes.value, "channel": channel.value}
        check_options(method, options)
        check_field(identifier, features)
        interval = None if spacing is None else length_in(spacing, features.crs, "--spacing")
        table = Table(features, identifier, interval)
        profile_layer(table, method, options, guides_for(main, source, features), report)
    write_table(table, places, out_layer or layer, report)
    if table.n_refused:
        raise typer.Exit(1)
