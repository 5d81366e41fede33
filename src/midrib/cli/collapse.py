"""The command ``midrib collapse``."""

import typer

from midrib.cli import options as cli
from midrib.cli.options import Centring, Channel, EndRule, Holes, WidthPlace
from midrib.errors import ParameterError

__all__ = ["collapse"]


def collapse(
    source: cli.Source,
    out: cli.LinesOut,
    layer: cli.Layer = None,
    main: cli.Main = None,
    method: cli.Method = "minimal-radii",
    spacing: cli.Spacing = None,
    count: cli.Count = None,
    percent: cli.Percent = None,
    vertices: cli.Vertices = None,
    centring: cli.CentringOption = Centring.centred,
    tolerance: cli.Tolerance = None,
    mean: cli.MeanOption = None,
    skip: cli.SkipOption = None,
    holes: cli.HolesOption = Holes.blocked,
    channel: cli.ChannelOption = Channel.shorter,
    ends: cli.EndsOption = EndRule.caps,
    end_clearance: cli.EndClearance = None,
    connect: cli.Connect = False,
    simplify: cli.Simplify = None,
    smooth: cli.Smooth = False,
    width: cli.Width = WidthPlace.columns,
    out_layer: cli.OutLayer = None,
    figure: cli.LineFigure = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Collapse areas to lines: one line without branches inside each."""
    from midrib.cli.job import Results, check_options, collapse_layer
    from midrib.cli.lines import options_of_line
    from midrib.cli.output import Places, draw, joints_of
    from midrib.cli.report import Report
    from midrib.formats.guides import guides_for
    from midrib.formats.reading import choose_layer, open_layer

    if connect:
        check_alone(main=main, ends=ends)
    places = Places(source, out, figure, "joints" if connect else None)
    places.check(overwrite=overwrite, needs_m=width is WidthPlace.m)
    layer = choose_layer(source, layer)
    report = Report(quiet=quiet)
    with open_layer(source, layer) as features:
        options = options_of_line(
            features.crs, spacing=spacing, count=count, percent=percent, vertices=vertices,
            centring=centring, tolerance=tolerance, mean=mean, skip=skip, holes=holes,
            channel=channel, ends=ends, end_clearance=end_clearance, simplify=simplify,
            smooth=smooth,
        )  # fmt: skip
        check_options(method, options)
        guides = guides_for(main, source, features)
        results = Results(features, has_m=width is WidthPlace.m)
        collapse_layer(results, method, options, guides, report, connect=connect)
    places.write(results, out_layer or layer, report, joints_of(results) if connect else None)
    if figure is not None:
        with open_layer(source, layer) as features:
            draw(features, guides, options | {"method": method, "connect": connect}, figure)
    if results.n_refused:
        raise typer.Exit(1)


def check_alone(*, main: str | None, ends: EndRule) -> None:
    """Refuse options that ``--connect`` cannot be given with."""
    for name, is_given in {"--main": main is not None, "--ends": ends is not EndRule.caps}.items():
        if is_given:
            msg = f"--connect excludes {name}: joints place the ends"
            raise ParameterError(msg)
