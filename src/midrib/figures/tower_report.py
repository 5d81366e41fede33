"""The report on a tower: a page to read in a browser, or a PDF to print."""

import io
from html import escape
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib import __version__
from midrib.checks import check_library
from midrib.errors import ParameterError
from midrib.figures.paper import FONT, TEXT
from midrib.figures.tower_pages import (
    HEIGHTS,
    WIDTH,
    Sheet,
    draw_axis,
    draw_sections,
    draw_shell,
    sheet_of,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from midrib.towers.records import TowerAxis
    from midrib.towers.tolerance import Tolerance

__all__ = ["ENDINGS", "check_report", "rows_of_levels", "summary_lines", "write_report"]

ENDINGS = (".html", ".pdf")
A4 = (210.0, 297.0)
MARGIN, HEADING, ROW, ROWS = 15.0, 9.0, 4.2, 60  # millimetres; number of rows on a sheet
COLUMNS = (13.0, 23.0, 24.0, 15.0, 13.0, 14.0, 13.0, 10.0, 14.0, 13.0, 9.0)  # millimetres
LINE = 105  # characters of a line of the summary on paper
FOOTER = 150  # characters of a line at the foot of a sheet
FLAG_LINE = 22  # characters of a line of a flag in the table on paper
MOST_LINES = 3  # of an entry of the summary on paper
DOUBTFUL = 6.0  # mm: stations registered as usual make a round tower as oval as that
FLAGGED, FLAGGED_ROW = "#a3201d", '<tr class="flagged">'
TITLES = (
    "Axis: deviation from the vertical through the base",
    "Shell, unrolled: cells beyond the model",
    "Sections",
)
HEADINGS = (
    "z, m", "x, m", "y, m", "deviation, mm", "azimuth, °", "radius, m", "ovality, %", "seen, °",
    "points", "residual, mm", "sigma, mm", "flag",
)  # fmt: skip
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
.summary td:first-child {{ color: #555; }}
.levels {{ font-size: 12px; line-height: 1.3; width: 100%; }}
.levels tr.flagged td {{ color: #a3201d; }}
thead {{ display: table-header-group; }}
@media print {{ body {{ font-size: 10pt; margin: 0; max-width: none; }}
  .levels {{ font-size: 7.5pt; }} h2 {{ break-after: avoid; }} }}
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


class Content(NamedTuple):
    """What a report says."""

    title: str
    axis: "TowerAxis"
    tolerance: "Tolerance | None"
    source: str
    outer: str  # about registration and levelling, if these were given


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
        figures = [draw_axis(axis, tolerance), draw_shell(axis), draw_sections(axis)]
        path.write_text(page(content, figures), encoding="utf-8")
    else:
        write_pdf(content, path)


def summary_lines(
    axis: "TowerAxis", tolerance: "Tolerance | None" = None, source: str = ""
) -> list[tuple[str, ...]]:
    """Return what there is to say about the axis as a whole, as pairs of name and text."""
    s, unit = axis.summary, axis.unit
    mm, m = 1e3 / unit, 1.0 / unit
    flagged, missing = int((axis.levels["flag"] != "").sum()), int((~axis.is_answered).sum())
    lines = [
        ("cloud", source),
        ("points on the shell", f"{axis.count:,}"),
        (
            "left out",
            f"{axis.unusable:,} points without three finite coordinates" * bool(axis.unusable),
        ),
        ("sections", sections_text(axis)),
        ("stations", stations_text(axis)),
        ("mode", axis.mode),
        ("levels", f"{len(axis.levels)}, {flagged} flagged, {missing} of these without a centre"),
        ("heights", f"{s.low * m:.2f} m to {s.high * m:.2f} m"),
        ("best line", f"leans by {s.slope:.2f} mm/m towards {s.azimuth:.1f}°"),
        (
            "straightness",
            f"{s.straightness * mm:.1f} mm off the best line at {s.straightness_z * m:.1f} m",
        ),
        (
            "largest deviation",
            f"{s.deviation * mm:.1f} mm at {s.deviation_z * m:.1f} m; "
            f"top {s.top_deviation * mm:.1f} mm",
        ),
        (
            "sigma of the centre",
            f"{np.nanmedian(axis.levels['sigma']) * mm:.2f} mm (median of the levels)",
        ),
    ]
    kinks = [f"{k.z * m:.0f} m ({k.turn:.1f} mm/m towards {k.azimuth:.0f}°)" for k in axis.kinks]
    lines.append(("kinks", ", ".join(kinks) or "none found"))
    if tolerance is not None:
        lines.append(("tolerance", exceeding(axis, tolerance)))
    return [(name, text) for name, text in lines if text]


def sections_text(axis: "TowerAxis") -> str:
    """Say what the sections are, how oval, and what is wrong with them."""
    shape, oval = axis.shape, ""
    if shape.name == "oval" and 2 in shape.harmonics:
        size, sigma = (1e3 / axis.unit * value for value in shape.harmonics[2])
        oval = f" by {size:.1f} ± {sigma:.2f} mm, longest towards {shape.azimuth:.0f}°"
    return shape.text + oval + (f"; {shape.problem}" if shape.problem else "")


def stations_text(axis: "TowerAxis") -> str:
    """Say how stations were put together, or why not, and what sigma does not tell of them."""
    mm = 1e3 / axis.unit
    if axis.stations:
        parts = [
            f"{station.label}: {np.hypot(station.x, station.y) * mm:.1f} mm"
            for station in axis.stations
        ]
        return (
            f"{len(parts)}, put together where they overlap; off their mean by {', '.join(parts)}; "
            "sigma has what these tell of the mean"
        )
    if axis.labels:
        said = f"{axis.labels}, but they could not be put together: too few cells are seen by two"
    else:
        said = "not told apart by the points, so their shifts could not be checked"
    amplitude = axis.shape.harmonics.get(2, (0.0, 0.0))[0] * mm
    if axis.shape.name == "oval" and amplitude < DOUBTFUL:
        said += f"; that sections are oval by {amplitude:.1f} mm may be their registration"
    return f"{said}; registration is in sigma only if given"


def exceeding(axis: "TowerAxis", tolerance: "Tolerance") -> str:
    """Say where the deviation exceeds a tolerance, and where it may."""
    levels = axis.levels[axis.is_answered]
    allowed = tolerance.at(levels["z"] - axis.summary.low, axis.unit)
    over = levels["deviation"] > allowed
    half = 1.96 * levels["sigma"]
    close = ~over & (levels["deviation"] + half > allowed) & (allowed > 0.0)
    if not over.any():
        may = f", {int(close.sum())} may be by their 95 % interval" * bool(close.any())
        return f"{tolerance.text}: no level is beyond it{may}"
    z = levels["z"][over] / axis.unit
    return (
        f"{tolerance.text}: {int(over.sum())} levels are beyond it, {z[0]:.1f} m to {z[-1]:.1f} m"
    )


def rows_of_levels(axis: "TowerAxis") -> list[tuple[str, ...]]:
    """Table of the levels as texts under ``HEADINGS``, from the top down as the tower stands."""
    m, mm = 1.0 / axis.unit, 1e3 / axis.unit
    rows = []
    for level in axis.levels[::-1]:
        numbers = [
            (level["z"] * m, 2), (level["x"] * m, 4), (level["y"] * m, 4),
            (level["deviation"] * mm, 1), (level["azimuth"], 1), (level["radius"] * m, 4),
            (100.0 * level["ovality"], 2), (level["coverage"], 0), (float(level["n"]), 0),
            (level["residual"] * mm, 1), (level["sigma"] * mm, 2),
        ]  # fmt: skip
        # Adding 0 makes 0 of -0.
        texts = [
            "" if np.isnan(value) else f"{round(float(value), digits) + 0.0:.{digits}f}"
            for value, digits in numbers
        ]
        rows.append((*texts, str(level["flag"])))
    return rows


def page(content: Content, figures: "list[Figure]") -> str:
    """Page of a report."""
    axis = content.axis
    rows = rows_of_levels(axis)
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
        head="".join(f"<th>{escape(name)}</th>" for name in HEADINGS),
        body=body,
        notes=escape(notes(content)),
        version=__version__,
    )


def notes(content: Content) -> str:
    """Say what the numbers mean."""
    return (
        "Sigma is the standard deviation of one coordinate of the centre, from what the cloud "
        f"tells about itself{content.outer}. Azimuths are clockwise from y (north)."
    )


def write_footer(sheet: Sheet, content: Content, number: int, count: int) -> None:
    """Write what the numbers mean, the cloud's name, version and number of a page at its foot."""
    for i, part in enumerate(wrap(notes(content), FOOTER)):
        write_text(sheet, MARGIN, 12.5 - 2.8 * i, part, fontsize=FONT - 1.5)
    name = f"{content.source or content.title}, page {number} of {count}; midrib {__version__}"
    write_text(sheet, A4[0] - MARGIN, 6.0, name, fontsize=FONT - 1.5, ha="right")


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


def write_pdf(content: Content, path: Path) -> None:
    """Write a report as a PDF on A4."""
    from matplotlib.backends.backend_pdf import PdfPages

    axis = content.axis
    left = (A4[0] - WIDTH) / 2.0
    _, shell_height, sections_height = HEIGHTS
    rows = rows_of_levels(axis)
    with PdfPages(path, metadata={"CreationDate": None, "Title": content.title}) as pages:
        first = sheet_of(*A4)
        write_summary(first, content)
        draw_axis(axis, content.tolerance, first._replace(left=left, low=MARGIN))
        second = sheet_of(*A4)
        top = A4[1] - MARGIN - HEADING - shell_height
        heading(second, TITLES[1], top + shell_height)
        draw_shell(axis, second._replace(left=left, low=top))
        low = top - HEADING - sections_height
        heading(second, TITLES[2], low + sections_height)
        draw_sections(axis, second._replace(left=left, low=low))
        tables = [table_sheet(rows[k : k + ROWS]) for k in range(0, len(rows), ROWS)]
        sheets = (first, second, *tables)
        for number, sheet in enumerate(sheets, 1):
            write_footer(sheet, content, number, len(sheets))
            pages.savefig(sheet.figure)


def write_text(sheet: Sheet, x: float, y: float, text: str, **chosen: Any) -> None:
    """Write at a place in millimetres from the lower left corner."""
    style: dict[str, Any] = {"fontsize": FONT, "color": TEXT, "va": "top"} | chosen
    sheet.figure.text(x / A4[0], y / A4[1], text, **style)


def heading(sheet: Sheet, text: str, low: float) -> None:
    """Write a heading above a place."""
    write_text(sheet, MARGIN, low + HEADING - 2.0, text, fontsize=FONT + 3.0)


def write_summary(sheet: Sheet, content: Content) -> None:
    """Write title and summary at the top of a sheet."""
    top = A4[1] - MARGIN
    write_text(sheet, MARGIN, top, content.title, fontsize=FONT + 7.0)
    lines = summary_lines(content.axis, content.tolerance, content.source)
    level = top - 10.0
    for name, text in lines:
        write_text(sheet, MARGIN, level, name, color="#777777")
        for part in wrap(text, LINE)[:MOST_LINES]:
            write_text(sheet, MARGIN + 34.0, level, part)
            level -= ROW


def table_sheet(rows: list[tuple[str, ...]]) -> Sheet:
    """Return a sheet with a part of the table of levels."""
    from matplotlib.lines import Line2D

    sheet = sheet_of(*A4)
    top = A4[1] - MARGIN
    rights = MARGIN + np.cumsum(COLUMNS)
    headings = tuple(name.replace(", ", "\n") for name in HEADINGS)
    for i, row in enumerate([headings, *rows]):
        level = top - ROW * (i + (i > 0)) - (i > 0)
        colour = FLAGGED if i and row[-1] else TEXT
        for right, text in zip(rights, row[:-1], strict=False):
            write_text(
                sheet, float(right), level, text, ha="right", fontsize=FONT - 1.0, color=colour
            )
        # Flags that need two lines are small, so that rows stay where they are.
        parts = wrap(row[-1], FLAG_LINE)
        small = FONT - (1.0 if len(parts) < 2 else 2.5)
        for k, part in enumerate(parts or [""]):
            at = level + 0.8 * (len(parts) > 1) - ROW / max(2, len(parts)) * k
            write_text(sheet, float(rights[-1]) + 3.0, at, part, fontsize=small, color=colour)
    y = (top - 2.0 * ROW + 0.2) / A4[1]
    line = Line2D([MARGIN / A4[0], 1.0 - MARGIN / A4[0]], [y, y], color=TEXT, lw=0.5)
    sheet.figure.add_artist(line)
    return sheet
