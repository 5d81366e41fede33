"""The command ``midrib skeleton``."""

import typer

from midrib.cli import options as cli

__all__ = ["skeleton"]


def skeleton(
    source: cli.Source,
    out: cli.LinesOut,
    layer: cli.Layer = None,
    method: cli.SkeletonMethod = "medial-axis",
    radius: cli.Radius = cli.WidthPlace.columns,
    min_branch_length: cli.LeastBranch = None,
    min_significance: cli.SkeletonSignificance = None,
    out_layer: cli.OutLayer = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Find the skeletons of areas: one feature a branch."""
    from midrib.cli.job import Results
    from midrib.cli.output import Places
    from midrib.cli.report import Report
    from midrib.cli.skeletons import check_skeleton, skeleton_layer
    from midrib.formats.contents import choose_layer
    from midrib.formats.reading import open_layer
    from midrib.formats.units import length_in

    is_m = radius is cli.WidthPlace.m
    places = Places(source, out, None)
    places.check(overwrite=overwrite, needs_m="--radius m" if is_m else "")
    layer = choose_layer(source, layer)
    report = Report(quiet=quiet)
    with open_layer(source, layer) as features:
        least = min_branch_length and length_in(
            min_branch_length, features.crs, "--min-branch-length"
        )
        options = {"min_branch_length": least or None, "min_significance": min_significance}
        check_skeleton(method, options)
        results = Results(features, has_m=is_m)
        report.start()
        for batch in report.track(features.batches(), features.count):
            skeleton_layer(results, batch, method, options)
    places.write(results, out_layer or layer, report)
    if results.n_refused:
        raise typer.Exit(1)
