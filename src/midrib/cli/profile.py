"""The command ``midrib profile``."""

import typer

from midrib.cli import options as cli
from midrib.cli.options import Centring, Channel, EndRule, Holes

__all__ = ["profile"]


def profile(
    source: cli.Source,
    out: cli.TableOut,
    layer: cli.Layer = None,
    main: cli.Main = None,
    spacing: cli.StationSpacing = None,
    identifier: cli.Identifier = None,
    method: cli.Method = "minimal-radii",
    centring: cli.CentringOption = Centring.centred,
    tolerance: cli.Tolerance = None,
    mean: cli.MeanOption = None,
    skip: cli.SkipOption = None,
    holes: cli.HolesOption = Holes.blocked,
    channel: cli.ChannelOption = Channel.shorter,
    ends: cli.EndsOption = EndRule.caps,
    end_clearance: cli.EndClearance = None,
    simplify: cli.Simplify = None,
    smooth: cli.Smooth = False,
    out_layer: cli.OutLayer = None,
    figure: cli.TableFigure = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Measure the width of areas along their lines: a table of stations and widths."""
    from midrib.cli.lines import options_of_line
    from midrib.cli.output import Places
    from midrib.cli.report import Report
    from midrib.cli.tables import Table, check_field, check_table, profile_layer, write_table
    from midrib.engines.recipe import check_options
    from midrib.formats.contents import choose_layer
    from midrib.formats.guides import guides_for
    from midrib.formats.reading import open_layer
    from midrib.formats.units import length_in

    places = Places(source, out, figure)
    check_table(out)
    places.check(overwrite=overwrite)
    layer = choose_layer(source, layer)
    report = Report(quiet=quiet)
    with open_layer(source, layer) as features:
        options = options_of_line(
            features.crs, centring=centring, tolerance=tolerance, mean=mean, skip=skip,
            holes=holes, channel=channel, ends=ends, end_clearance=end_clearance,
            simplify=simplify, smooth=smooth,
        )  # fmt: skip
        check_options(method, options)
        check_field(identifier, features)
        interval = None if spacing is None else length_in(spacing, features.crs, "--spacing")
        table = Table(features, identifier, interval)
        profile_layer(table, method, options, guides_for(main, source, features), report)
    write_table(table, places, out_layer or layer, report)
    if table.n_refused:
        raise typer.Exit(1)
