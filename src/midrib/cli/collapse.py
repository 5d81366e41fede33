"""The command ``midrib collapse``."""

from typing import Any

import typer

from midrib.cli import options as cli
from midrib.cli.options import Centring, Channel, EndRule, Holes, WidthPlace, chosen
from midrib.errors import ParameterError

__all__ = ["collapse"]

CLEARANCES = {"station": "station", "proportional": "proportional", "none": None}


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
    from midrib.cli.output import Places, draw, joints_of
    from midrib.cli.report import Report
    from midrib.formats.guides import guides_for
    from midrib.formats.reading import choose_layer, open_layer
    from midrib.formats.units import length_in

    if connect:
        check_alone(main=main, ends=ends)
    places = Places(source, out, figure, "joints" if connect else None)
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
            "tolerance": tolerance and deviation(tolerance, features.crs, "--tolerance"),
            "simplify": simplify and deviation(simplify, features.crs, "--simplify"),
        }
        options: dict[str, Any] = {k: value for k, value in given.items() if value is not None}
        options |= chosen(centring=centring, holes=holes, channel=channel, ends=ends)
        if end_clearance is not None:
            options["end_clearance"] = clearance(end_clearance, features.crs)
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


def deviation(text: str, crs: str | None, option: str) -> str | float:
    """Read how far a line may be from another: a percentage as it stands, or a length."""
    from midrib.formats.units import length_in

    if text.strip().endswith("%"):
        return text
    try:
        return length_in(text, crs, option)
    except ParameterError as error:
        msg = f"{error}, or a share of the width: 5%"
        raise ParameterError(msg) from None
