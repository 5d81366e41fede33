"""The command ``midrib hatch``."""

from collections import Counter
from typing import TYPE_CHECKING, Any

import typer

from midrib.cli import options as cli
from midrib.cli.options import SharedEdges, StartSide

if TYPE_CHECKING:
    from pathlib import Path

    from midrib.cli.report import Report
    from midrib.formats.drawing.content import Drawing

__all__ = ["hatch"]

MOST_LISTED = 10  # problems told on the terminal
MOST_NAMED = 3  # objects that a note names
TOLD = {  # what kinds of problems are called
    "left out": "objects left out",
    "swapped": "tops lower than their toes",
    "unmatched": "places where strokes are left out or cut short",
    "beyond": "places where strokes exceed a bound",
}


def hatch(
    source: cli.SlopesIn,
    out: cli.DrawingOut,
    standard: cli.StandardName = "pl-2021",
    scale: cli.MapScale = 500.0,
    symbol: cli.Symbol = None,
    symbol_width: cli.SymbolWidth = None,
    stroke_width: cli.StrokeWidth = None,
    factor: cli.Factor = None,
    spacing: cli.Gap = None,
    min_spacing: cli.LeastGap = None,
    max_spacing: cli.LargestGap = None,
    pattern: cli.Pattern = None,
    short_ratio: cli.ShortRatio = None,
    min_length: cli.LeastLength = None,
    from_side: cli.From = StartSide.left,
    offset: cli.Offset = 1.0,
    first: cli.First = None,
    shared: cli.SharedStrokes = SharedEdges.meet,
    end_strokes: cli.EndStrokes = False,
    stiffness: cli.Stiffness = None,
    top_share: cli.TopShare = None,
    rule: cli.RuleOption = None,
    layer: cli.Layer = None,
    top: cli.Top = None,
    toe: cli.Toe = None,
    start: cli.Start = None,
    end: cli.End = None,
    kind: cli.Kind = None,
    exclude: cli.Exclude = None,
    history: cli.History = False,
    paper: cli.PaperSize = None,
    no_problems: cli.NoProblems = False,
    overwrite: cli.Overwrite = False,
    quiet: cli.Quiet = False,
) -> None:
    """Hatch slopes at map scale; draw walls, stairs, conveyors, gantries and water gates."""
    from midrib.cli.report import Report
    from midrib.cli.zones import zones_in
    from midrib.formats.drawing.slopes import check_standard, draw_slopes, try_out
    from midrib.formats.drawing.write import check_places, write_drawing
    from midrib.formats.slopes import count_ended, read_slopes

    values = given(
        symbol=symbol,
        symbol_width=symbol_width,
        stroke_width=stroke_width,
        factor=factor,
        spacing=spacing,
        min_spacing=min_spacing,
        max_spacing=max_spacing,
        pattern=pattern,
        short_ratio=short_ratio,
    )
    options = given(
        min_length=min_length,
        first=first and first.value,
        stiffness=stiffness,
        top_share=top_share,
        offset=offset,
        rule=rule and rule.value,
    )
    options |= {"start": from_side.value, "end_strokes": end_strokes}
    sources = [source] if exclude is None else [source, exclude]
    check_places(out, sources, overwrite=overwrite, paper=paper)
    check_standard(standard, values, scale)
    told = {"layer": layer, "top": top, "toe": toe, "start": start, "end": end, "kind": kind}
    slopes, problems = read_slopes(source, history=history, **told)
    if exclude is not None:
        options["exclude"] = zones_in(exclude, slopes[0].crs if slopes else None)
    report = Report(quiet=quiet)
    report.start(lambda: try_out(standard, scale, values, **options))
    drawing = draw_slopes(
        slopes,
        standard,
        scale,
        problems=problems,
        values=values,
        shared=shared.value,
        track=lambda slopes: report.track(slopes, len(slopes), lambda _: 1, "hatching"),
        **options,
    )
    for note in write_drawing(out, drawing, paper=paper, marks=not no_problems):
        report.say(f"note: {note}")
    sum_up(drawing, out, report)
    if not slopes and not problems:
        ended = 0 if history else count_ended(source, problems, **told)
        if not ended:  # which is no failure: a register may hold none
            report.say("note: IN has no slopes")
            return
        report.say(f"nothing is drawn: slopes that have ended: {ended:,}; --history draws them")
        raise typer.Exit(1)
    if not drawing.has_symbols:
        report.say(f"nothing is drawn: {why_nothing(drawing, standard)}")
    if drawing.n_refused or not drawing.has_symbols:
        raise typer.Exit(1)


def given(**values: Any) -> dict[str, Any]:
    """Values that are given."""
    return {name: value for name, value in values.items() if value is not None}


def why_nothing(drawing: "Drawing", standard: str) -> str:
    """Reason why a drawing has no stroke and no symbol."""
    from midrib.formats.drawing.content import LEFT_OUT
    from midrib.hatching.standards import standards_named

    if any(trouble.kind == LEFT_OUT for trouble in drawing.problems) and not drawing.objects:
        kinds = dict.fromkeys(kind for known in standards_named(standard) for kind in known.kinds)
        return (
            f"standard {standard!r} is made for {', '.join(kinds)}, and IN has nothing of these; "
            "--kind says what its objects are"
        )
    first = drawing.problems[0] if drawing.problems else None
    return "the objects of IN have no stroke" if first is None else f"{first.id}: {first.reason}"


def sum_up(drawing: "Drawing", out: "Path", report: "Report") -> None:
    """Say what has come of a run."""
    from midrib.formats.drawing.content import REFUSED
    from midrib.formats.units import unit_of

    found = Counter(trouble.kind for trouble in drawing.problems)
    strokes = sum(0 if drawn.is_long is None else len(drawn.is_long) for drawn in drawing.objects)
    others = sum(drawn.symbols.count for drawn in drawing.objects if drawn.is_long is None)
    drawn_too = f" and {others:,} symbols" if others else ""
    report.say(
        f"{strokes:,} strokes{drawn_too} of {len(drawing.objects):,} objects "
        f"at 1:{drawing.scale:g}, {drawing.n_refused:,} refused; {report.elapsed:.1f} s"
    )
    if drawing.n_excluded:
        report.say(f"note: strokes left out in zones of --exclude: {drawing.n_excluded:,}")
    if out.exists():
        report.say(f"written to {out}")
    if drawing.objects and unit_of(drawing.crs) is None:
        report.say("note: IN does not say what its unit is, it is taken for the metre")
    listed = [trouble for trouble in drawing.problems if trouble.kind == REFUSED]
    for trouble in listed[:MOST_LISTED]:
        report.say(f"refused: {trouble.id}: {trouble.reason}")
    if len(listed) > MOST_LISTED:
        report.say(f"refused: {len(listed) - MOST_LISTED:,} more")
    for kind, number in found.items():
        if kind != REFUSED:
            named = first_of([trouble.id for trouble in drawing.problems if trouble.kind == kind])
            report.say(f"note: {TOLD.get(kind, f'doubts, {kind}')}: {number:,} ({named})")


def first_of(names: list[str]) -> str:
    """Name the first few of some objects, each once, and count the rest."""
    known = list(dict.fromkeys(names))
    more = f" and {len(known) - MOST_NAMED:,} more" if len(known) > MOST_NAMED else ""
    return ", ".join(known[:MOST_NAMED]) + more
