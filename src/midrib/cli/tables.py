"""The work of ``midrib profile``: batches of areas in, a table of stations and widths out."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
import shapely

from midrib.cli.job import with_columns
from midrib.curves.log import Log
from midrib.errors import ParameterError
from midrib.figures.profiles import MOST_PANELS, Panel, draw_profiles
from midrib.formats.contents import listed
from midrib.formats.endings import format_of
from midrib.formats.units import is_geographic, unit_of
from midrib.formats.writing import Features, staged, write_layer
from midrib.profiles import profiles_of

if TYPE_CHECKING:
    from midrib.cli.output import Places
    from midrib.cli.report import Report
    from midrib.formats.guides import Guides
    from midrib.formats.reading import Batch, Source
    from midrib.profiles import PartProfile, Profile

__all__ = ["Table", "check_field", "check_table", "profile_layer", "write_table"]

PLAIN = ".csv"


@dataclass
class Table:
    """What has become of a layer, batch by batch."""

    source: "Source"
    identifier: str | None  # field to put beside each row
    spacing: float | None
    features: list[pa.Table] = field(default_factory=list)  # number, identifier, part of each row
    profiles: "list[Profile]" = field(default_factory=list)
    panels: list[Panel] = field(default_factory=list)  # the first few, for the figure
    refused: list[pa.Table] = field(default_factory=list)
    n_features: int = 0
    n_refused: int = 0

    @property
    def n_rows(self) -> int:
        """Number of stations."""
        return sum(profile.stations.size for profile in self.profiles)


def check_table(out: Path, name: str = "OUT") -> None:
    """Refuse a format that has no attributes; ``name`` is what the file is called.

    Raises
    ------
    ParameterError
        If the file has its ending.
    """
    if format_of(out, name).is_drawing:
        msg = (
            f"{name} {str(out)!r} ends in {out.suffix!r}, which holds no table, expected .csv, say"
        )
        raise ParameterError(msg)


def check_field(identifier: str | None, source: "Source") -> None:
    """Refuse a field that the layer does not have.

    Raises
    ------
    ParameterError
        If it does not.
    """
    names = source.attributes.names
    if identifier is not None and identifier not in names:
        msg = f"--id is {identifier!r}, expected a field of layer {source.layer!r}: {listed(names)}"
        raise ParameterError(msg)


def profile_layer(
    table: Table, method: str, options: dict[str, Any], guides: "Guides", report: "Report"
) -> None:
    """Profile all features of the table's layer, a batch at a time; options are of the line."""
    source = table.source
    geographic = is_geographic(source.crs)
    report.start()
    for batch in report.track(source.batches(), source.count):
        along, unreadable = guides.of(batch)
        refused = dict(batch.unreadable) | unreadable
        areas = batch.geometries.copy()
        areas[list(refused)] = None
        log = Log(None, strict=False)
        for found in profiles_of(
            areas,
            method,
            log,
            along=along,
            spacing=table.spacing,
            geographic=geographic,
            **options,
        ):
            add_profile(table, batch, found)
        for problem in log.problems:
            if problem.status == "refused":
                part = f"part {problem.part}: " if problem.part else ""
                refused.setdefault(problem.index, f"{part}{problem.reason}")
        add_refused(table, batch, refused)
        table.n_features += len(areas)


def add_profile(table: Table, batch: "Batch", found: "PartProfile") -> None:
    """Keep the rows of one part of an area."""
    rows = labels(table, batch, np.full(found.profile.stations.size, found.area))
    parts = pa.array(np.full(rows.num_rows, found.part))
    table.features.append(with_columns(rows, {"part": parts}))
    table.profiles.append(found.profile)
    if len(table.panels) <= MOST_PANELS:
        name = f"part {found.part} of " if found.part else ""
        label = labels(table, batch, np.array([found.area])).columns[-1][0].as_py()
        table.panels.append(Panel(f"{name}{table.identifier or 'feature'} {label}", found.profile))


def labels(
    table: Table, batch: "Batch", rows: "np.ndarray[tuple[int], np.dtype[np.intp]]"
) -> pa.Table:
    """Tell the features in some rows of a batch: number in the file, and the field for it."""
    named = pa.table({"feature": pa.array(batch.first + rows, type=pa.int64())})
    if table.identifier is None:
        return named
    return with_columns(named, {table.identifier: batch.attributes[table.identifier].take(rows)})


def add_refused(table: Table, batch: "Batch", refused: dict[int, str]) -> None:
    """Keep which features were refused, and why."""
    rows = np.array(sorted(refused), dtype=np.intp)
    reasons = pa.array([refused[i] for i in rows], type=pa.string())
    table.refused.append(with_columns(labels(table, batch, rows), {"reason": reasons}))
    table.n_refused += rows.size


def write_table(table: Table, places: "Places", layer: str, report: "Report") -> None:
    """Write everything, whole or not at all; then sum up."""
    out, figure = places.out, places.figure
    with staged(out.parent, stale=places.stale) as stage:
        notes = write_rows(stage / out.name, rows_of(table, layer))
        if table.n_refused:
            reasons = pa.concat_tables(table.refused)
            nowhere = np.full(reasons.num_rows, None, dtype=object)
            refused = Features(
                f"{layer}_refused",
                reasons,
                nowhere,
                table.source.geometry,
                "Point",
                table.source.crs,
            )
            notes += write_rows(stage / places.refused.name, refused)
    if figure is not None:
        unit = unit_of(table.source.crs)
        with staged(figure.parent) as easel:
            draw_profiles(
                table.panels,
                easel / figure.name,
                unit=None if unit is None else unit.name,
                count=len(table.profiles),
            )
    for note in dict.fromkeys(notes):
        report.say(f"note: {note}")
    report.say(
        f"{table.n_rows:,} stations of {table.n_features} features, {table.n_refused} refused; "
        f"{report.elapsed:.1f} s"
    )
    report.say(f"written to {out}")
    if table.n_refused:
        where = f"layer {layer}_refused of {out}" if places.refused == out else ""
        report.say(f"refused areas, with reasons, in {where or places.refused}")


def rows_of(table: Table, layer: str) -> Features:
    """Rows of all profiles, with the stations as points."""
    source, profiles = table.source, table.profiles
    has_z = any(profile.points.shape[1] > 2 for profile in profiles)
    points = np.concatenate(
        [np.empty((0, 2 + has_z)), *(with_height(profile.points, has_z) for profile in profiles)]
    )
    columns = {"station": stacked([profile.stations for profile in profiles])}
    columns |= dict(zip("xyz", map(pa.array, points.T.copy()), strict=False))
    for name in ("width", "to_left", "to_right"):
        columns[name] = stacked([getattr(profile, name) for profile in profiles])
    there = shapely.points(points) if len(points) else np.empty(0, dtype=object)
    return Features(
        layer,
        with_columns(features_of(table), columns),
        there,
        source.geometry,
        "Point" + " Z" * has_z,
        source.crs,
        source.more,
    )


def features_of(table: Table) -> pa.Table:
    """Columns that tell the feature and the part of each row."""
    if table.features:
        return pa.concat_tables(table.features)
    columns = {"feature": pa.array([], type=pa.int64())}
    if table.identifier is not None:
        kind = table.source.attributes.field(table.identifier).type
        columns[table.identifier] = pa.array([], type=kind)
    return pa.table(columns | {"part": pa.array([], type=pa.int64())})


def with_height(points: "np.ndarray", has_z: bool) -> "np.ndarray":
    """Points with a Z column if there is to be one, NaN where they have none."""
    if has_z and points.shape[1] == 2:
        return np.column_stack([points, np.full(len(points), np.nan)])
    return points


def stacked(columns: "list[np.ndarray]") -> pa.Array:
    """One column of numbers from many."""
    return pa.array(np.concatenate([np.empty(0), *columns]), type=pa.float64(), from_pandas=True)


def write_rows(path: Path, features: Features) -> list[str]:
    """Write a table: plain as CSV, with its points in any other format."""
    if path.suffix.lower() == PLAIN:
        pyarrow.csv.write_csv(features.attributes, path)
        return []
    return write_layer(path, features)
