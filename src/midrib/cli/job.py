"""Results of commands in memory; the work of ``midrib collapse --connect``."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import shapely

from midrib.curves.collapse import collapse
from midrib.curves.log import Joint
from midrib.engines.batches import Counts, measured, statuses
from midrib.engines.recipe import MEASURES
from midrib.formats.fitting import free_name
from midrib.formats.units import is_geographic
from midrib.profiles import add_widths, with_m
from midrib.ragged import without_holes

if TYPE_CHECKING:
    from collections.abc import Iterable

    from midrib.cli.report import Report
    from midrib.formats.reading import Batch, Geometries, Source
    from midrib.types import Ints

__all__ = ["JOINT_COLUMNS", "Results", "collapse_connected", "joint_features"]

JOINT_COLUMNS = {  # name, and which attribute of a joint it holds
    "area": ("index", pa.int64()),
    "other": ("other", pa.int64()),
    "kind": ("kind", pa.string()),
    "reason": ("reason", pa.string()),
}


@dataclass
class Results:
    """What has become of a layer, batch by batch."""

    source: "Source"
    has_m: bool = False  # whether lines carry the width as M values
    attributes: list[pa.Table] = field(default_factory=list)
    lines: "list[Geometries]" = field(default_factory=list)
    refused_attributes: list[pa.Table] = field(default_factory=list)
    refused_areas: "list[Geometries]" = field(default_factory=list)
    joints: list[Joint] = field(default_factory=list)
    total_length: float = 0.0
    n_features: int = 0
    n_lines: int = 0
    n_refused: int = 0
    n_repaired: int = 0

    @property
    def has_doubts(self) -> bool:
        """Whether there are areas, refused or not, to be looked at."""
        return any(map(len, self.refused_areas))

    @property
    def counts(self) -> Counts:
        """Counts of all features."""
        numbers = (self.n_features, self.n_lines, self.n_refused, self.n_repaired)
        return Counts(*numbers, self.total_length)


def collapse_connected(results: Results, options: dict[str, Any], report: "Report") -> None:
    """Collapse all features of a layer at once, so that lines of neighbours meet."""
    source = results.source
    geographic = is_geographic(source.crs)
    report.start()
    batch = whole(report.track(source.batches(), source.count))
    areas = batch.geometries
    lines, problems = collapse(
        areas, on_error="report", geographic=geographic, connect=True, **options
    )
    results.joints += [p for p in problems if isinstance(p, Joint)]
    problems = [p for p in problems if not isinstance(p, Joint)]
    lines[shapely.is_empty(lines)] = None
    refused = dict(batch.unreadable)
    status = statuses(areas, problems, refused)
    holes = options.get("holes") != "ignored"
    add_lines(results, batch, lines, status, refused, geographic=geographic, holes=holes)
    add_refused(results, batch, refused)
    results.n_features += len(lines)
    results.n_repaired += len({p.index for p in problems if p.status == "repaired"})


def whole(batches: "Iterable[Batch]") -> "Batch":
    """All features in one batch."""
    parts = list(batches)
    unreadable = {b.first + row: why for b in parts for row, why in b.unreadable.items()}
    return parts[0]._replace(
        attributes=pa.concat_tables([b.attributes for b in parts]),
        geometries=np.concatenate([b.geometries for b in parts]),
        unreadable=unreadable,
    )


def joint_features(joints: list[Joint]) -> "tuple[pa.Table, Geometries]":
    """Rows about joints, and edges without one, and their points."""
    points = np.empty(len(joints), dtype=object)
    points[:] = [joint.point for joint in joints]
    columns = {
        name: pa.array([getattr(joint, attribute) for joint in joints], type=kind)
        for name, (attribute, kind) in JOINT_COLUMNS.items()
    }
    return pa.table(columns), points


def add_lines(
    results: Results,
    batch: "Batch",
    lines: "Geometries",
    status: list[str],
    refused: dict[int, str],
    *,
    geographic: bool,
    holes: bool,
) -> None:
    """Keep the features that have a line, and those that never had a geometry.

    Without ``holes`` these do not bound the widths.
    """
    keep = ~shapely.is_missing(lines)
    keep[[i for i in range(len(lines)) if i not in refused]] = True
    rows = np.flatnonzero(keep)
    lines, areas = lines[rows], batch.geometries[rows]
    if not holes:
        areas = np.array([*map(without_holes, areas), None], dtype=object)[:-1]
    inside = pieces_inside(lines, areas)
    measures, length = measured(lines, areas, geographic=geographic, inside=inside)
    text = pa.array([status[i] for i in rows], type=pa.string())
    columns = dict(zip(MEASURES, [*measures, text], strict=True))
    results.attributes.append(with_columns(batch.attributes.take(rows), columns))
    if results.has_m:
        lines = add_widths(lines, areas, geographic=geographic)
        lines = without_width_outside(lines, areas)
    results.lines.append(lines)
    results.n_lines += int(np.count_nonzero(~shapely.is_missing(lines)))
    results.total_length += length


def pieces_inside(lines: "Geometries", areas: "Geometries") -> "Geometries":
    """Lines but for what leads to joints in other areas; what an area does not cover is cut off.

    An area that is not valid keeps the whole line.
    """
    pieces = lines.copy()
    for i in leaving(lines, areas):
        parts = shapely.get_parts(shapely.intersection(lines[i], areas[i]))
        parts = parts[shapely.get_dimensions(parts) == 1]
        pieces[i] = shapely.multilinestrings(parts) if parts.size else None
    return pieces


def without_width_outside(lines: "Geometries", areas: "Geometries") -> "Geometries":
    """Lines with M 0 where they lead to joints in other areas."""
    measured = lines.copy()
    for i in leaving(lines, areas):
        rows = shapely.get_coordinates(lines[i], include_m=True)
        is_inside = shapely.intersects_xy(areas[i], rows[:, 0], rows[:, 1])
        measured[i] = with_m(lines[i], np.where(is_inside, rows[:, 2], 0.0))
    return measured


def leaving(lines: "Geometries", areas: "Geometries") -> "Ints":
    """Which lines their areas do not cover, where these are valid."""
    known = np.flatnonzero(~shapely.is_missing(lines) & shapely.is_valid(areas))
    leaves: Ints = known[~shapely.covers(areas[known], lines[known])]
    return leaves


def add_refused(results: Results, batch: "Batch", refused: dict[int, str]) -> None:
    """Keep the areas that were refused, with the reason."""
    add_doubted(results, batch, refused)
    results.n_refused += len(refused)


def add_doubted(results: Results, batch: "Batch", doubted: dict[int, str]) -> None:
    """Keep areas to be looked at beside the refused ones, with the reason."""
    rows = np.array(sorted(doubted), dtype=np.intp)
    columns = {"reason": pa.array([doubted[i] for i in rows], type=pa.string())}
    results.refused_attributes.append(with_columns(batch.attributes.take(rows), columns))
    results.refused_areas.append(batch.geometries[rows])


def with_columns(table: pa.Table, columns: dict[str, pa.Array]) -> pa.Table:
    """Table with columns added, numbered on where a name is taken: ``length_2``."""
    for name, values in columns.items():
        free = free_name(name, {known.lower() for known in table.column_names})
        # A table without columns has no rows either, however many features it is of.
        table = table.append_column(free, values) if table.num_columns else pa.table({free: values})
    return table
