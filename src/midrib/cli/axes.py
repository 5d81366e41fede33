"""Where the results of ``midrib tower`` go: report, tables, drawings; and what its options say."""

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pyarrow as pa
import shapely

from midrib.checks import check_library
from midrib.cli.tables import write_rows
from midrib.errors import ParameterError
from midrib.figures.tower_report import check_report, write_report
from midrib.formats.drawing.axes import Mark, write_axis_dxf
from midrib.formats.endings import format_of
from midrib.formats.units import METRES, length_in
from midrib.formats.writing import Features, check_free, staged, write_layer
from midrib.towers.kinks import Kink, Offset, RadiusStep
from midrib.towers.pipeline import Options

if TYPE_CHECKING:
    from midrib.towers.cloud import Cloud
    from midrib.towers.records import TowerAxis
    from midrib.towers.tolerance import Tolerance

__all__ = ["Places", "chosen_options"]

IN_METRES = '{"coordinate_system": {"axis": [{"unit": "metre"}]}}'


class Places(NamedTuple):
    """The files of one run."""

    source: Path
    reports: tuple[Path, ...]
    out: tuple[Path, ...]

    @property
    def all(self) -> list[Path]:
        """Every file that is written."""
        return [*self.reports, *self.out]

    def check(self, *, overwrite: bool) -> None:
        """Refuse places that cannot be written to, before any work is done.

        Raises
        ------
        ParameterError
            If a place is taken or has an ending that nothing can be written with.
        MissingDependencyError
            If a library that a format needs is not installed.
        """
        for path in self.reports:
            check_report(path)
        check_free(self.reports, "--report", overwrite=overwrite)
        for path in self.out:
            if format_of(path).is_drawing:
                check_library("ezdxf", "writing DXF", "dxf")
        check_free(self.out, "--out", overwrite=overwrite)
        for path in self.all:
            if path.exists() and self.source.exists() and path.samefile(self.source):
                msg = f"{str(path)!r} is CLOUD, expected another file"
                raise ParameterError(msg)

    def write(
        self, axis: "TowerAxis", title: str, tolerance: "Tolerance | None", options: Options
    ) -> list[str]:
        """Write all files, each whole or not at all; say what a format could not keep."""
        notes: list[str] = []
        for path in self.all:
            with staged(path.parent) as stage:
                if path in self.reports:
                    write_report(
                        axis,
                        stage / path.name,
                        title=title,
                        source=self.source.name,
                        tolerance=tolerance,
                        outer=outer_text(options),
                    )
                else:
                    notes += write_axis(stage / path.name, axis)
        return [f"note: {note}" for note in dict.fromkeys(notes)]


def write_axis(path: Path, axis: "TowerAxis") -> list[str]:
    """Write levels, alone where a format has no layers, such as CSV; else axis and breaks too."""
    levels = levels_of(axis)
    if path.suffix.lower() == ".csv":
        return write_rows(path, levels)
    target = format_of(path)
    if target.is_drawing:
        write_axis_dxf(path, axis.points, axis.unit, axis.breaks, marks_of(axis))
        return []
    if not target.has_layers:
        return write_layer(path, levels)
    kinds = {"kinks": Kink, "offsets": Offset, "radius_steps": RadiusStep}
    breaks = [breaks_of(axis, name, kind) for name, kind in kinds.items()]
    return [note for layer in (line_of(axis), levels, *breaks) for note in write_layer(path, layer)]


def levels_of(axis: "TowerAxis") -> Features:
    """Layer ``levels``: a point for each, none where it has no centre."""
    names = axis.levels.dtype.names or ()
    columns = {name: pa.array(axis.levels[name], from_pandas=True) for name in names}
    points = np.empty(len(axis.levels), dtype=object)
    there = axis.is_answered
    points[there] = shapely.points(axis.points)
    return Features("levels", pa.table(columns), points, "geom", "Point Z", axis.crs)


def line_of(axis: "TowerAxis") -> Features:
    """Layer ``axis``: one line, of several parts where it is broken."""
    line = np.empty(1, dtype=object)
    line[0] = axis.line
    s = axis.summary
    about = {
        "mode": pa.array([axis.mode]),
        "sections": pa.array([axis.shape.text]),
        **{name: pa.array([getattr(s, name)], from_pandas=True) for name in s._fields},
    }
    return Features("axis", pa.table(about), line, "geom", "MultiLineString Z", axis.crs)


def marks_of(axis: "TowerAxis") -> list[Mark]:
    """Kinks, offsets and steps of the radius for a drawing, from the base up; none without axis."""
    if not len(axis.points):
        return []
    metre, milli = 1.0 / axis.unit, 1000.0 / axis.unit
    found = [
        *(("KINKS", k.z, f"kink {k.turn:.1f} mm/m") for k in axis.kinks),
        *(("OFFSETS", o.z, f"offset {milli * o.size:.0f} mm") for o in axis.offsets),
        *(("RADIUS_STEPS", r.z, f"radius {milli * r.size:+.0f} mm") for r in axis.radius_steps),
    ]
    return [
        Mark(f"MIDRIB_{layer}", axis.at(np.array([z]))[0], f"{text} at {metre * z:.2f}")
        for layer, z, text in sorted(found, key=lambda mark: mark[1])
    ]


def breaks_of(axis: "TowerAxis", name: str, kind: "type[Kink | Offset | RadiusStep]") -> Features:
    """Layer of breaks of a kind: points on the axis, none where it has no centre at all.

    The columns are those of the records, so lengths are in coordinate units and turns in mm per m.
    """
    rows = np.array(getattr(axis, name), dtype=np.float64).reshape(-1, len(kind._fields))
    columns = dict(zip(kind._fields, map(pa.array, rows.T), strict=True))
    points = np.empty(len(rows), dtype=object)
    if len(axis.points):
        points[:] = shapely.points(axis.at(rows[:, 0]))
    return Features(name, pa.table(columns), points, "geom", "Point Z", axis.crs)


def chosen_options(
    cloud: "Cloud", unit: str | None, told: dict[str, Any], **others: Any
) -> Options:
    """Options with lengths in coordinate units: those that name a unit are turned into these.

    Raises
    ------
    ParameterError
        If a text is no length, or no pair of lengths.
    """
    if unit is not None and unit not in METRES:
        msg = f"--unit is {unit!r}, expected one of {', '.join(METRES)}"
        raise ParameterError(msg)
    metres = (cloud.metres or 1.0) if unit is None else METRES[unit]
    found: dict[str, Any] = {"unit": 1.0 / metres, **others}
    for name in ("step", "registration"):
        if told[name] is not None:
            found[name] = length_of(told[name], metres, f"--{name}")
    for name in ("near", "radius"):
        if told[name] is not None:
            parts = str(told[name]).split(",")
            if len(parts) != 2:
                msg = f"--{name} is {told[name]!r}, expected two numbers: 1.5,3"
                raise ParameterError(msg)
            found[name] = tuple(length_of(part, metres, f"--{name}") for part in parts)
    return Options(**found)


def length_of(text: str, metres: float, name: str) -> float:
    """Length in coordinate units; a number without a unit is one of these."""
    try:
        return float(text)
    except ValueError:
        return length_in(text, IN_METRES, name) / metres


def outer_text(options: Options) -> str:
    """Say what was added to the uncertainty."""
    parts = []
    if options.registration:
        parts.append(
            f"registration of the stations, {1e3 * options.registration / options.unit:g} mm"
        )
    if options.levelling:
        parts.append(f"levelling, {options.levelling:g} mm/m")
    return f", with {' and '.join(parts)}" if parts else ", without registration and levelling"
