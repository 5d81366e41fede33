"""What ``midrib check`` has found: a table on the terminal, a file, a figure, a summary."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pyarrow as pa
import shapely
from rich import box
from rich.console import Console
from rich.table import Table

from midrib.cli.tables import check_table, write_rows
from midrib.errors import ParameterError
from midrib.figures.checks import draw_checks
from midrib.figures.draw import check_figure
from midrib.formats.bdot500 import BASIC_MODEL, read_drawn
from midrib.formats.cad import read_lines
from midrib.formats.contents import layer_names, listed
from midrib.formats.gml import namespaces
from midrib.formats.reading import Geometries, open_layer
from midrib.formats.slopes import DRAWING, XML
from midrib.formats.units import check_same_plane, is_geographic, unit_of
from midrib.formats.writing import Features, check_free, staged
from midrib.hatching.finding import Finding

if TYPE_CHECKING:
    from midrib.cli.report import Report
    from midrib.hatching.slope import Slope

__all__ = ["Places", "drawn_strokes", "metres_per_unit", "print_findings"]

HEADINGS = ("slope", "check", "x", "y", "reason")
LAYER = "findings"
DIGITS = 3  # of coordinates on the terminal
LINE_KINDS = ("Line", "Curve", "Unknown", "GeometryCollection")
LINE_TYPES = (shapely.GeometryType.LINESTRING, shapely.GeometryType.LINEARRING)
WIDEST = 10_000  # characters of a line that nobody looks at


class Places(NamedTuple):
    """The files of one run."""

    source: Path
    out: Path | None
    figure: Path | None

    def check(self, *, overwrite: bool) -> None:
        """Refuse places that cannot be written to, before any work is done.

        Raises
        ------
        ParameterError
            If a place is IN, is taken, or has an ending that nothing can be written with.
        """
        if self.out is not None:
            check_table(self.out, "--out")
            check_free([self.out], "--out", overwrite=overwrite)
        if self.figure is not None:
            check_figure(self.figure)
            check_free([self.figure], "--figure", overwrite=overwrite)
        for path in (self.out, self.figure):
            if path is not None and path.exists() and path.samefile(self.source):
                msg = f"{str(path)!r} is IN, expected another file"
                raise ParameterError(msg)

    def write(
        self, slopes: "Sequence[Slope]", findings: Sequence[Finding], report: "Report"
    ) -> None:
        """Write table and figure, each whole or not at all; then sum up."""
        crs = next((slope.crs for slope in slopes), None)
        notes = []
        is_blank = not slopes and all(finding.where is None for finding in findings)
        if self.out is not None:
            with staged(self.out.parent) as stage:
                notes = write_rows(stage / self.out.name, features_of(findings, crs))
        if self.figure is not None and is_blank:
            notes.append("there is nothing to draw, no figure is written")
            with staged(self.figure.parent, stale=[self.figure]):
                pass
        elif self.figure is not None:
            unit = unit_of(crs)
            with staged(self.figure.parent) as easel:
                draw_checks(
                    slopes,
                    findings,
                    easel / self.figure.name,
                    unit=None if unit is None else unit.name,
                )
        for note in notes:
            report.say(f"note: {note}")
        report.say(f"slopes: {len(slopes)}; {summary(findings)}")
        for path in (self.out, self.figure):
            if path is not None and path.exists():
                report.say(f"written to {path}")


def print_findings(findings: Sequence[Finding]) -> None:
    """Print a table: as wide as the terminal, or as it has to be if it goes into a file."""
    if not findings:
        return
    console = Console(highlight=False, soft_wrap=True)
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for name in HEADINGS:
        table.add_column(name, justify="right" if name in {"x", "y"} else "left", overflow="fold")
    for row in rows_of(findings):
        numbers = ["" if c is None else f"{c:.{DIGITS}f}" for c in (row["x"], row["y"])]
        table.add_row(str(row["slope"]), str(row["check"]), *numbers, str(row["reason"]))
    if not console.is_terminal:
        console.width = console.measure(table, options=console.options.update(width=WIDEST)).maximum
    console.print(table, markup=False)


def rows_of(findings: Sequence[Finding]) -> list[dict[str, object]]:
    """Put findings under ``HEADINGS``."""
    return [
        {
            "slope": finding.id,
            "check": finding.check,
            "x": None if finding.where is None else finding.where.x,
            "y": None if finding.where is None else finding.where.y,
            "reason": finding.reason,
        }
        for finding in findings
    ]


def features_of(findings: Sequence[Finding], crs: str | None) -> Features:
    """Make features of findings, at their places."""
    kinds = {name: pa.float64() if name in {"x", "y"} else pa.string() for name in HEADINGS}
    table = pa.Table.from_pylist(rows_of(findings), schema=pa.schema([*kinds.items()]))
    places = np.empty(len(findings), dtype=object)
    places[:] = [None if f.where is None else shapely.force_2d(f.where) for f in findings]
    return Features(LAYER, table, places, "geom", "Point", crs)


def summary(findings: Sequence[Finding]) -> str:
    """Count findings by check."""
    counts = Counter(finding.check for finding in findings)
    told = ", ".join(f"{count} {check}" for check, count in counts.items())
    return f"findings: {len(findings)}" + f", {told}" * bool(told)


def metres_per_unit(slopes: "Sequence[Slope]") -> float:
    """Length of a coordinate unit; 1 where nothing tells.

    Raises
    ------
    ParameterError
        If coordinates are degrees.
    """
    crs = next((slope.crs for slope in slopes), None)
    if is_geographic(crs):
        msg = "IN is in degrees, expected a projected CRS: slopes are drawn at scale"
        raise ParameterError(msg)
    unit = unit_of(crs)
    return 1.0 if unit is None else unit.metres


def drawn_strokes(strokes: str, source: Path, crs: str | None) -> Geometries:
    """Read strokes from a layer of IN, or from another file or a layer of it.

    Raises
    ------
    ParameterError
        If there is no such layer or file, or it is in another CRS than the slopes.
    """
    file, _, layer = strokes.rpartition(":")
    if Path(strokes).exists():
        file, layer = strokes, ""
    path = Path(file) if file and Path(file).exists() else source
    if path.suffix.lower() == DRAWING:
        return np.array([*read_lines(path, "--strokes", layer or "*"), None], dtype=object)[:-1]
    if path.suffix.lower() in XML and any(BASIC_MODEL in uri for uri in namespaces(path)):
        return np.array([*read_drawn(path, layer or "*"), None], dtype=object)[:-1]
    layers = layer_names(path, "--strokes")
    if not layer and len(layers) == 1:
        layer = next(iter(layers))
    if layer not in layers:
        msg = f"--strokes is {strokes!r}, expected a layer of {str(path)!r}: {listed(layers)}"
        raise ParameterError(msg)
    kind = layers[layer] or "no geometries"
    if not any(word in kind for word in LINE_KINDS):
        msg = f"--strokes is {strokes!r}, which holds {kind}, expected lines"
        raise ParameterError(msg)
    with open_layer(path, layer) as features:
        check_same_plane(features.crs, crs, f"--strokes {strokes!r}")
        parts = [shapely.get_parts(batch.geometries) for batch in features.batches()]
    every: Geometries = np.concatenate(parts)
    return every[np.isin(shapely.get_type_id(every), LINE_TYPES)]
