"""The command ``midrib check``."""

import typer

from midrib.cli import options as cli

__all__ = ["check"]


def check(
    source: cli.SlopesIn,
    layer: cli.Layer = None,
    top: cli.Top = None,
    toe: cli.Toe = None,
    start: cli.Start = None,
    end: cli.End = None,
    kind: cli.Kind = None,
    history: cli.History = False,
    strokes: cli.Strokes = None,
    standard: cli.Standard = "pl-2021",
    scale: cli.Scale = 500.0,
    out: cli.FindingsOut = None,
    figure: cli.FindingsFigure = None,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Check slopes before they are hatched: a table of what is wrong with them, and where."""
    from midrib import interrupts
    from midrib.cli.findings import Places, drawn_strokes, metres_per_unit, print_findings
    from midrib.cli.report import Report
    from midrib.formats.slopes import count_ended, read_slopes
    from midrib.hatching.checking import check_slopes

    report = Report(quiet=quiet)
    places = Places(source, out, figure)
    places.check(overwrite=overwrite)
    told = {"layer": layer, "top": top, "toe": toe, "start": start, "end": end, "kind": kind}
    slopes, problems = read_slopes(source, history=history, **told)
    ended = 0 if slopes or history else count_ended(source, problems, **told)
    if ended:
        report.say(f"note: slopes that have ended: {ended:,}; --history checks them")
    report.announce()
    interrupts.start_work()
    crs = slopes[0].crs if slopes else None
    findings = check_slopes(
        slopes,
        problems,
        strokes=() if strokes is None else drawn_strokes(strokes, source, crs),
        standard=standard,
        scale=scale,
        metres_per_unit=metres_per_unit(slopes),
    )
    print_findings(findings)
    places.write(slopes, findings, report)
    if findings:
        raise typer.Exit(1)
