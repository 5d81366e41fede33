"""The command ``midrib partial``."""

import typer

from midrib.cli import options as cli

__all__ = ["partial"]


def partial(
    source: cli.Source,
    out: cli.LinesOut,
    narrower_than: cli.NarrowerThan,
    layer: cli.Layer = None,
    min_length: cli.LeastPart = None,
    method: cli.PartialMethod = "medial-axis",
    merge: cli.Merge = 1.0,
    min_branch_length: cli.LeastBranch = None,
    min_significance: cli.Significance = 3.0,
    out_layer: cli.OutLayer = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Collapse the narrow parts of areas to lines, and keep the wide ones."""
    from midrib.cli.job import Results
    from midrib.cli.networks import Nodes
    from midrib.cli.output import Places
    from midrib.cli.partials import WideParts, check_partial, partial_layer
    from midrib.cli.report import Report
    from midrib.formats.contents import choose_layer
    from midrib.formats.reading import open_layer
    from midrib.formats.units import length_in

    places = Places(source, out, None, "areas")
    places.check(overwrite=overwrite)
    layer = choose_layer(source, layer)
    report = Report(quiet=quiet)
    with open_layer(source, layer) as features:
        lengths = {
            "narrower_than": narrower_than,
            "min_length": min_length,
            "min_branch_length": min_branch_length,
        }
        options = {
            name: length_in(text, features.crs, f"--{name.replace('_', '-')}")
            for name, text in lengths.items()
            if text is not None
        }
        options |= {"merge": merge, "min_significance": min_significance}
        check_partial(method, options)
        results, nodes, wide = Results(features), Nodes(), WideParts()
        report.start()
        for batch in report.track(features.batches(), features.count):
            partial_layer(results, nodes, wide, batch, method, options)
    places.write(results, out_layer or layer, report, wide.layer())
    if results.has_doubts:
        raise typer.Exit(1)
