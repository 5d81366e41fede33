"""The command ``midrib network``."""

import typer

from midrib.cli import options as cli

__all__ = ["network"]


def network(
    source: cli.Source,
    out: cli.LinesOut,
    layer: cli.Layer = None,
    dissolve: cli.Dissolve = False,
    method: cli.SkeletonMethod = "medial-axis",
    merge: cli.Merge = 1.0,
    min_branch_length: cli.LeastBranch = None,
    min_significance: cli.Significance = 3.0,
    out_layer: cli.OutLayer = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Find the centre lines of networks: one feature from node to node."""
    from midrib.cli.job import Results
    from midrib.cli.networks import Nodes, check_network, dissolved, network_layer
    from midrib.cli.output import Places
    from midrib.cli.report import Report
    from midrib.formats.contents import choose_layer
    from midrib.formats.reading import open_layer
    from midrib.formats.units import length_in

    places = Places(source, out, None, "nodes")
    places.check(overwrite=overwrite)
    layer = choose_layer(source, layer)
    report = Report(quiet=quiet)
    with open_layer(source, layer) as features:
        least = min_branch_length and length_in(
            min_branch_length, features.crs, "--min-branch-length"
        )
        options = {
            "merge": merge,
            "min_significance": min_significance,
            "min_branch_length": least or None,
        }
        check_network(method, options)
        results, nodes = Results(features), Nodes()
        report.start()
        batches = report.track(features.batches(), features.count)
        for batch in [dissolved(batches)] if dissolve else batches:
            network_layer(results, nodes, batch, method, options)
    places.write(results, out_layer or layer, report, nodes.layer())
    if results.n_refused:
        raise typer.Exit(1)
