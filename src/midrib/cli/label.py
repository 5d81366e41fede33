"""The command ``midrib label``."""

import typer

from midrib.cli import options as cli

__all__ = ["label"]


def label(
    source: cli.Source,
    out: cli.LinesOut,
    layer: cli.Layer = None,
    length: cli.LabelLength = None,
    height: cli.LabelHeight = None,
    aspect: cli.Aspect = None,
    out_layer: cli.OutLayer = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Find lines for the names of areas."""
    from midrib.cli.job import Results
    from midrib.cli.labels import check_label, label_layer
    from midrib.cli.output import Places
    from midrib.cli.report import Report
    from midrib.formats.contents import choose_layer
    from midrib.formats.reading import open_layer
    from midrib.formats.units import length_in

    places = Places(source, out, None)
    places.check(overwrite=overwrite)
    layer = choose_layer(source, layer)
    report = Report(quiet=quiet)
    with open_layer(source, layer) as features:
        options = {
            "length": length and length_in(length, features.crs, "--length"),
            "height": height and length_in(height, features.crs, "--height"),
            "aspect": aspect,
        }
        check_label(options)
        results = Results(features)
        report.start()
        for batch in report.track(features.batches(), features.count):
            label_layer(results, batch, options)
    places.write(results, out_layer or layer, report)
    if results.n_refused:
        raise typer.Exit(1)
