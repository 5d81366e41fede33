"""The command ``midrib points``."""

import typer

from midrib.cli import options as cli

__all__ = ["points"]


def points(
    source: cli.Source,
    out: cli.PointsOut,
    layer: cli.Layer = None,
    count: cli.PointCount = None,
    tolerance: cli.PointTolerance = None,
    method: cli.Method = "minimal-radii",
    out_layer: cli.OutLayer = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Find the vertices of lines that matter most."""
    from midrib.cli.job import Results
    from midrib.cli.labels import point_layer
    from midrib.cli.output import Places
    from midrib.cli.report import Report
    from midrib.curves.control import least_importance
    from midrib.engines.recipe import check_options
    from midrib.formats.contents import choose_layer
    from midrib.formats.reading import open_layer
    from midrib.formats.units import length_in

    places = Places(source, out, None)
    places.check(overwrite=overwrite)
    layer = choose_layer(source, layer)
    report = Report(quiet=quiet)
    with open_layer(source, layer) as features:
        within = None
        if tolerance is not None:
            within = length_in(tolerance, features.crs, "--tolerance")
        least_importance(count, within)
        check_options(method, {})
        results = Results(features)
        report.start()
        for batch in report.track(features.batches(), features.count):
            point_layer(results, batch, method, {"count": count, "tolerance": within})
    places.write(results, out_layer or layer, report, kind="Point")
    if results.n_refused:
        raise typer.Exit(1)
