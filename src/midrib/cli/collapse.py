"""The command ``midrib collapse``."""

from typing import TYPE_CHECKING

import typer

from midrib.cli import options as cli
from midrib.cli.options import Centring, Channel, EndRule, Engine, Holes, WidthPlace
from midrib.errors import ParameterError

if TYPE_CHECKING:
    from midrib.cli.running import Machines

__all__ = ["collapse"]


def collapse(
    source: cli.Sources,
    out: cli.LinesOrParts,
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
    engine: cli.EngineOption = Engine.local,
    workers: cli.Workers = None,
    scheduler: cli.Scheduler = None,
    master: cli.SparkMaster = None,
    part_rows: cli.PartRows = 50_000,
    width: cli.Width = WidthPlace.columns,
    out_layer: cli.OutLayer = None,
    figure: cli.LineFigure = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Collapse areas to lines: one line without branches inside each."""
    from midrib.cli.job import Results, collapse_connected
    from midrib.cli.lines import options_of_line
    from midrib.cli.output import Places, draw, joints_of
    from midrib.cli.report import Report
    from midrib.cli.running import Machines, Run, check_folder, is_folder
    from midrib.engines.partitions import check_alike, files_of
    from midrib.engines.recipe import Recipe, check_options
    from midrib.formats.contents import choose_layer
    from midrib.formats.guides import guides_for
    from midrib.formats.reading import open_layer

    machines = Machines(engine, workers, scheduler, master, part_rows)
    places = Places(source, out, figure, "joints" if connect else None)
    has_m, to_folder = width is WidthPlace.m, is_folder(out)
    check_together(connect=connect, main=main, ends=ends, machines=machines, to_folder=to_folder)
    if to_folder:
        check_folder(source, out, figure, has_m=has_m)
    else:
        places.check(overwrite=overwrite, needs_m="--width m" if has_m else "")
    files = files_of(source)
    check_alike(files)
    layer = choose_layer(files[0], layer)
    report = Report(quiet=quiet)
    with open_layer(files[0], layer) as features:
        options = options_of_line(
            features.crs, spacing=spacing, count=count, percent=percent, vertices=vertices,
            centring=centring, tolerance=tolerance, mean=mean, skip=skip, holes=holes,
            channel=channel, ends=ends, end_clearance=end_clearance, simplify=simplify,
            smooth=smooth,
        )  # fmt: skip
        check_options(method, options)
        guides = guides_for(main, files[0], features)
        recipe = Recipe(
            features.attributes,
            features.geometry,
            features.crs,
            method,
            options,
            has_m,
            guides,
            features.more,
        )
        if connect:
            results = Results(features, has_m=has_m)
            collapse_connected(results, options | {"method": method}, report)
            places.write(results, out_layer or layer, report, joints_of(results))
    run = Run(files, features, recipe, machines, report)
    if connect:
        counts = results.counts
    elif to_folder:
        counts = run.into_folder(out, main, overwrite=overwrite)
    else:
        counts = run.into_files(places, out_layer or layer)
    if figure is not None:
        with open_layer(files[0], layer) as features:
            draw(features, guides, options | {"method": method, "connect": connect}, figure)
    if counts.refused:
        raise typer.Exit(1)


def check_together(
    *, connect: bool, main: str | None, ends: EndRule, machines: "Machines", to_folder: bool
) -> None:
    """Refuse options that exclude each other."""
    machines.check()
    joints, memory = "joints place the ends", "neighbours have to be in one memory"
    alone = {
        "--main": (main is not None, joints),
        "--ends": (ends is not EndRule.caps, joints),
        "--engine": (machines.engine is not Engine.local, memory),
        "--workers": (machines.workers is not None, memory),
        "a folder as OUT": (to_folder, memory),
    }
    for name, (is_given, why) in alone.items():
        if connect and is_given:
            msg = f"--connect excludes {name}: {why}"
            raise ParameterError(msg)
