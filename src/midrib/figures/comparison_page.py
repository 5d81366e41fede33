"""Comparisons as tables and as a page: the figure, and a table that is sorted by a click."""

import csv
import io
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from midrib.errors import ParameterError
from midrib.figures.comparison import draw_comparison
from midrib.figures.draw import ENDINGS

if TYPE_CHECKING:
    from midrib.comparison import Compared, Comparison

__all__ = ["PAGES", "check_comparison", "rows_of", "write_comparison"]

PAGE, TABLE = ".html", ".csv"
PAGES = (*ENDINGS, PAGE, TABLE)
HEADINGS = (
    "method", "vertices", "length", "centredness p95", "turning (° per width)", "off p95 (widths)",
    "off most (widths)", "CPU (ms)", "note",
)  # fmt: skip
ISLANDS = (
    "Centredness does not see islands: beside one it says nothing of the middle of the channel."
)
TEMPLATE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>
body {{ font: 15px/1.5 system-ui, sans-serif; max-width: 64em; margin: 2em auto; padding: 0 1em; }}
svg {{ width: 100%; height: auto; }}
table {{ border-collapse: collapse; }}
th, td {{ padding: .3em .8em; border-bottom: 1px solid #ccc; text-align: right; }}
th:first-child, td:first-child, td:last-child {{ text-align: left; }}
td:first-child {{ white-space: nowrap; }}
th {{ cursor: pointer; }} th:hover {{ text-decoration: underline; }}
</style></head><body><h1>{title}</h1>
{figure}
<p>A click on a heading sorts. <em>Centredness</em>: 0 in the middle of the two sides, 1 on one of
them, away from the ends. <em>Off</em>: distance from the line of the first method, in mean widths
of the area. Lengths in {unit}.{notes}</p>
<table><thead><tr>{head}</tr></thead><tbody>
{body}
</tbody></table><script>
document.querySelectorAll("th").forEach((cell, column) => cell.addEventListener("click", () => {{
  const body = document.querySelector("tbody"), sign = cell.dataset.sign === "1" ? -1 : 1;
  const value = row => row.cells[column].dataset.value;
  cell.dataset.sign = sign;
  [...body.rows].sort((a, b) => {{
    const [x, y] = [value(a), value(b)], difference = parseFloat(x) - parseFloat(y);
    return sign * (Number.isNaN(difference) ? x.localeCompare(y) : difference);
  }}).forEach(row => body.append(row));
}}));
</script></body></html>
"""


def check_comparison(path: Path) -> None:
    """Refuse a file for which there is no way to write a comparison.

    Raises
    ------
    ParameterError
        If its ending is none that is known.
    """
    if path.suffix.lower() not in PAGES:
        msg = f"OUT {str(path)!r} ends in {path.suffix!r}, expected {', '.join(PAGES)}"
        raise ParameterError(msg)


def rows_of(comparison: "Comparison") -> list[tuple[str, ...]]:
    """Table of a comparison as texts, its heading first."""
    rows = (tuple(shown(value) for value in values_of(row)) for row in comparison.rows)
    return [HEADINGS, *rows]


def values_of(row: "Compared") -> tuple[str | float, ...]:
    """Values of a row under ``HEADINGS``."""
    return (
        row.method,
        float(row.vertices),
        row.length,
        row.centredness,
        row.turning,
        row.off,
        row.off_most,
        1e3 * row.cpu,
        row.reason,
    )


def shown(value: str | float) -> str:
    """Text of a value, a number with four digits."""
    if isinstance(value, str):
        return value
    if np.isnan(value):
        return ""
    return f"{value:,.0f}" if abs(value) >= 1000.0 or value == round(value) else f"{value:.4g}"


def write_comparison(
    comparison: "Comparison", path: Path, title: str, unit: str | None = None
) -> None:
    """Write a comparison as its ending says: a figure, a page or a table.

    Raises
    ------
    ParameterError
        If its ending is none that is known.
    MissingDependencyError
        If it needs matplotlib and that is not installed.
    """
    check_comparison(path)
    if path.suffix.lower() == TABLE:
        text = io.StringIO()
        rows = [HEADINGS, *(values_of(row) for row in comparison.rows)]
        csv.writer(text, lineterminator="\n").writerows(rows)
        path.write_text(text.getvalue(), encoding="utf-8")
    elif path.suffix.lower() == PAGE:
        path.write_text(page_of(comparison, title, unit), encoding="utf-8")
    else:
        draw_comparison(comparison, path)


def notes_of(comparison: "Comparison") -> list[str]:
    """Sentences about the area that a reader of the table should know."""
    notes = [f"The area: {'; '.join(comparison.notes)}."] if comparison.notes else []
    return [*notes, ISLANDS] if comparison.area.interiors else notes


def page_of(comparison: "Comparison", title: str, unit: str | None) -> str:
    """Page with the figure and the table."""
    drawn = io.StringIO()
    draw_comparison(comparison).savefig(drawn, format="svg", metadata={"Date": None})
    figure = drawn.getvalue()
    body = "\n".join(
        "<tr>"
        + "".join(
            f'<td data-value="{escape(str(value))}">{escape(shown(value))}</td>'
            for value in values_of(row)
        )
        + "</tr>"
        for row in comparison.rows
    )
    return TEMPLATE.format(
        title=escape(title),
        figure=figure[figure.index("<svg") :],
        unit=escape(unit or "units of the coordinates"),
        notes="".join(f" {escape(note)}" for note in notes_of(comparison)),
        head="".join(f"<th>{escape(heading)}</th>" for heading in HEADINGS),
        body=body,
    )
