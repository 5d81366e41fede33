"""The report on a tower as a PDF on A4: summary, figures, table of levels."""

from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np

from midrib import __version__
from midrib.figures.paper import FONT, TEXT
from midrib.figures.tower_pages import (
    HEIGHTS,
    WIDTH,
    Sheet,
    draw_deviation,
    draw_plan,
    draw_sections,
    draw_shell,
    sheet_of,
)
from midrib.figures.tower_text import (
    TITLES,
    Content,
    headings_of,
    notes,
    rows_of_levels,
    summary_lines,
)

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["table_sheets", "write_pdf"]

A4 = (210.0, 297.0)
MARGIN, HEADING, ROW = 15.0, 9.0, 4.2  # millimetres
COLUMNS = (11.0, 19.5, 20.0, 14.0, 12.0, 12.0, 11.5, 9.0, 12.5, 12.0, 10.0)  # millimetres
JUDGED = 14.0  # millimetres: the column of verdicts
FLAG_ROW, LOWEST = 2.9, 18.0  # millimetres: between lines of a flag; where a sheet's rows end
LINE = 105  # characters of a line of the summary on paper
FOOTER = 150  # characters of a line at the foot of a sheet
CHARACTER, GAP, EDGE = 1.35, 3.0, 8.0  # millimetres: of a flag, before it, beside it
MOST_LINES = 3  # of an entry of the summary
FLAGGED = "#a3201d"


def write_pdf(content: Content, path: "Path") -> None:
    """Write a report as a PDF on A4."""
    from matplotlib.backends.backend_pdf import PdfPages

    axis, tolerance = content.axis, content.tolerance
    left = (A4[0] - WIDTH) / 2.0
    _, plan, shell, sections = HEIGHTS
    with PdfPages(path, metadata={"CreationDate": None, "Title": content.title}) as pages:
        first = sheet_of(*A4)
        write_summary(first, content)
        draw_plan(axis, tolerance, first._replace(left=left, low=MARGIN))
        draw_deviation(axis, tolerance, first._replace(left=left, low=MARGIN + plan))
        second = sheet_of(*A4)
        top = A4[1] - MARGIN - HEADING - shell
        heading(second, TITLES[2], top + shell)
        draw_shell(axis, second._replace(left=left, low=top))
        low = top - HEADING - sections
        heading(second, TITLES[3], low + sections)
        draw_sections(axis, second._replace(left=left, low=low))
        sheets = (first, second, *table_sheets(content))
        for number, sheet in enumerate(sheets, 1):
            write_footer(sheet, content, number, len(sheets))
            pages.savefig(sheet.figure)


def write_footer(sheet: Sheet, content: Content, number: int, count: int) -> None:
    """Write what the numbers mean, the cloud's name, version and number of a page at its foot."""
    for i, part in enumerate(wrap(notes(content), FOOTER)):
        write_text(sheet, MARGIN, 12.5 - 2.8 * i, part, fontsize=FONT - 1.5)
    name = f"{content.source or content.title}, page {number} of {count}; midrib {__version__}"
    write_text(sheet, A4[0] - MARGIN, 6.0, name, fontsize=FONT - 1.5, ha="right")


def write_text(sheet: Sheet, x: float, y: float, text: str, **chosen: Any) -> None:
    """Write at a place in millimetres from the lower left corner."""
    style: dict[str, Any] = {"fontsize": FONT, "color": TEXT, "va": "top"} | chosen
    sheet.figure.text(x / A4[0], y / A4[1], text, **style)


def heading(sheet: Sheet, text: str, low: float) -> None:
    """Write a heading above a place."""
    write_text(sheet, MARGIN, low + HEADING - 2.0, text, fontsize=FONT + 3.0)


def write_summary(sheet: Sheet, content: Content) -> None:
    """Write title and summary at the top of a sheet, closer where the figures leave little room."""
    top = A4[1] - MARGIN
    write_text(sheet, MARGIN, top, content.title, fontsize=FONT + 7.0)
    lines = [
        (name, wrap(text, LINE)[:MOST_LINES])
        for name, text in summary_lines(content.axis, content.tolerance, content.source)
    ]
    level = top - 10.0
    room = level - MARGIN - HEIGHTS[0] - HEIGHTS[1]
    row = min(ROW, room / sum(len(parts) for _, parts in lines))
    for name, parts in lines:
        write_text(sheet, MARGIN, level, name, color="#777777")
        for part in parts:
            write_text(sheet, MARGIN + 34.0, level, part)
            level -= row


def table_sheets(content: Content) -> list[Sheet]:
    """Return sheets with the table of levels; flags may take several lines."""
    names = tuple(name.replace(", ", "\n") for name in headings_of(content.tolerance))
    columns = (*COLUMNS, JUDGED) if content.tolerance is not None else COLUMNS
    rights = MARGIN + np.cumsum(columns)
    wide = int((A4[0] - EDGE - GAP - rights[-1]) / CHARACTER)
    sheets: list[Sheet] = []
    level = 0.0
    for row in rows_of_levels(content.axis, content.tolerance):
        parts = wrap(row[-1], wide) or [""]
        tall = ROW + FLAG_ROW * (len(parts) - 1)
        if not sheets or level - tall < LOWEST:
            sheets.append(sheet_of(*A4))
            write_row(sheets[-1], A4[1] - MARGIN, names[:-1], [names[-1]], rights, TEXT)
            level = A4[1] - MARGIN - 2.0 * ROW - 1.0
            draw_line(sheets[-1], level + 1.2)
        write_row(sheets[-1], level, row[:-1], parts, rights, FLAGGED if row[-1] else TEXT)
        level -= tall
    return sheets


def write_row(
    sheet: Sheet, level: float, row: tuple[str, ...], flag: list[str], rights: Any, colour: str
) -> None:
    """Write a row of the table, and its flag line by line."""
    small: dict[str, Any] = {"fontsize": FONT - 1.0, "color": colour}
    for right, text in zip(rights, row, strict=True):
        write_text(sheet, float(right), level, text, ha="right", **small)
    for k, part in enumerate(flag):
        write_text(sheet, float(rights[-1]) + GAP, level - FLAG_ROW * k, part, **small)


def draw_line(sheet: Sheet, y: float) -> None:
    """Draw a line across a sheet."""
    from matplotlib.lines import Line2D

    ends = [MARGIN / A4[0], 1.0 - MARGIN / A4[0]]
    sheet.figure.add_artist(Line2D(ends, [y / A4[1]] * 2, color=TEXT, lw=0.5))
