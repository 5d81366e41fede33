"""The report on a tower: a page to read in a browser, or a PDF to print."""

import io
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from midrib import __version__
from midrib.checks import check_library
from midrib.errors import ParameterError
from midrib.figures.tower_pages import draw_deviation, draw_plan, draw_sections, draw_shell
from midrib.figures.tower_paper import write_pdf
from midrib.figures.tower_text import (
    TITLES,
    Content,
    headings_of,
    notes,
    rows_of_levels,
    summary_lines,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from midrib.towers.records import TowerAxis
    from midrib.towers.tolerance import Tolerance

__all__ = ["ENDINGS", "check_report", "summary_lines", "write_report"]

ENDINGS = (".html", ".pdf")
FLAGGED_ROW = '<tr class="flagged">'
TEMPLATE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>
body {{ font: 15px/1.5 system-ui, sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em;
  color: #222; }}
svg {{ width: 100%; height: auto; }}
figure {{ margin: 0 0 1.5em; break-inside: avoid; }}
figcaption {{ color: #555; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; }}
th, td {{ padding: .15em .6em; border-bottom: 1px solid #ddd; text-align: right; }}
td:last-child, th:last-child, .summary td {{ text-align: left; }}
.summary td:first-child {{ color: #555; white-space: nowrap; vertical-align: top; }}
.levels {{ font-size: 12px; line-height: 1.3; width: 100%; }}
.levels th, .levels td {{ padding: .15em .4em; }}
.levels td:not(:last-child) {{ white-space: nowrap; }} .levels td:last-child {{ min-width: 9em; }}
.levels tr.flagged td {{ color: #a3201d; }}
thead {{ display: table-header-group; }}
@page {{ size: A4; margin: 14mm; }}
@media print {{ body {{ font-size: 9pt; line-height: 1.3; margin: 0; padding: 0; max-width: none; }}
  h1 {{ margin: 0 0 .3em; }} h2 {{ margin: .8em 0 .2em; break-after: avoid; }}
  figure {{ margin: 0; }} th, td {{ padding: .05em .4em; }}
  .levels {{ font-size: 7.5pt; }} .levels tr {{ break-inside: avoid; }} }}
</style></head><body><h1>{title}</h1>
<table class="summary"><tbody>{summary}</tbody></table>
{figures}
<h2>Levels</h2>
<table class="levels"><thead><tr>{head}</tr></thead><tbody>
{body}
</tbody></table>
<p>{notes} Made by midrib {version}.</p>
</body></html>
"""


def check_report(path: Path) -> None:
    """Refuse a report that cannot be written.

    Raises
    ------
    ParameterError
        If its ending is neither .html nor .pdf.
    MissingDependencyError
        If matplotlib is not installed.
    """
    if path.suffix.lower() not in ENDINGS:
        msg = f"--report {str(path)!r} ends in {path.suffix!r}, expected {' or '.join(ENDINGS)}"
        raise ParameterError(msg)
    check_library("matplotlib", "a report", "figures")


def write_report(
    axis: "TowerAxis",
    path: str | Path,
    *,
    title: str = "Tower",
    source: str = "",
    tolerance: "Tolerance | None" = None,
    outer: str = "",
) -> None:
    """Write a report on a tower's axis: summary, figures, table of levels.

    Parameters
    ----------
    axis : TowerAxis
    path : str or Path
        File to write, .html or .pdf.
    title, source : str
        Heading, and what to say about where the points come from.
    tolerance : Tolerance, optional
        ``midrib.towers.tolerance.tolerance_from`` makes one.
    outer : str
        What to say about uncertainty that the cloud does not tell.

    Raises
    ------
    ParameterError
        If the file has another ending.
    """
    path = Path(path)
    check_report(path)
    content = Content(title, axis, tolerance, source, outer)
    if path.suffix.lower() == ".html":
        figures = [
            draw_deviation(axis, tolerance),
            draw_plan(axis, tolerance),
            draw_shell(axis),
            draw_sections(axis),
        ]
        path.write_text(page(content, figures), encoding="utf-8")
    else:
        write_pdf(content, path)


def page(content: Content, figures: "list[Figure]") -> str:
    """Page of a report."""
    axis = content.axis
    rows = rows_of_levels(axis, content.tolerance)
    kinds = (FLAGGED_ROW if row[-1] else "<tr>" for row in rows)
    body = "\n".join(f"{kind}{cells(row)}</tr>" for kind, row in zip(kinds, rows, strict=True))
    lines = summary_lines(axis, content.tolerance, content.source)
    drawn = [
        f"<h2>{escape(title)}</h2>\n<figure>{svg_of(figure)}</figure>"
        for title, figure in zip(TITLES, figures, strict=True)
    ]
    return TEMPLATE.format(
        title=escape(content.title),
        summary="".join(f"<tr>{cells(line)}</tr>" for line in lines),
        figures="\n".join(drawn),
        head="".join(f"<th>{escape(name)}</th>" for name in headings_of(content.tolerance)),
        body=body,
        notes=escape(notes(content)),
        version=__version__,
    )


def cells(row: tuple[str, ...]) -> str:
    """Cells of a row of a table."""
    return "".join(f"<td>{escape(text)}</td>" for text in row)


def svg_of(figure: "Figure") -> str:
    """Figure as an element of a page; text stays text."""
    from matplotlib import rc_context

    buffer = io.StringIO()
    with rc_context({"svg.hashsalt": "midrib", "svg.fonttype": "none"}):
        figure.savefig(buffer, format="svg", metadata={"Date": None}, dpi=200)
    text = buffer.getvalue()
    return text[text.index("<svg") :]
