"""The work of ``midrib collapse``: batches of features in, lines and refused areas out."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import shapely

from midrib import measures
from midrib.curves.aftercare import aftercare
from midrib.curves.collapse import Joint, Problem, collapse
from midrib.curves.methods import finder_of
from midrib.formats.units import is_geographic
from midrib.formats.writing import free_name
from midrib.measures.widths import mean_and_largest_width
from midrib.profiles import add_widths, with_m
from midrib.ragged import without_holes

if TYPE_CHECKING:
    from collections.abc import Iterable

    from midrib.cli.report import Report
    from midrib.formats.guides import Guides
    from midrib.formats.reading import Batch, Geometries, Source
    from midrib.types import Floats, Ints

__all__ = ["JOINT_COLUMNS", "Results", "check_options", "collapse_layer", "joint_features"]

NO_GEOMETRY = "no geometry"
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


def check_options(method: str, options: dict[str, Any]) -> None:
    """Refuse a method or an option that there is not, even where no feature needs it."""
    options = dict(options)
    aftercare(options.pop("simplify", None), options.pop("smooth", False))
    finder_of(method, **options)


def collapse_layer(
    results: Results,
    method: str,
    options: dict[str, Any],
    guides: "Guides",
    report: "Report",
    *,
    connect: bool = False,
) -> None:
    """Collapse all features of a layer: a batch at a time, or all at once if lines are to meet."""
    source = results.source
    geographic = is_geographic(source.crs)
    report.start()
    batches = report.track(source.batches(), source.count)
    for batch in [whole(batches)] if connect else batches:
        along, unreadable = guides.of(batch)
        lines, problems = collapse(
            batch.geometries,
            method,
            on_error="report",
            along=None if connect else along,
            geographic=geographic,
            connect=connect,
            **options,
        )
        results.joints += [p for p in problems if isinstance(p, Joint)]
        problems = [p for p in problems if not isinstance(p, Joint)]
        lines[shapely.is_empty(lines)] = None
        refused = dict(batch.unreadable) | unreadable
        lines[list(unreadable)] = None
        status = statuses(batch, problems, refused)
        add_lines(
            results,
            batch,
            lines,
            status=status,
            refused=refused,
            geographic=geographic,
            connect=connect,
            holes=options.get("holes") != "ignored",
        )
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


def statuses(batch: "Batch", problems: list[Problem], refused: dict[int, str]) -> list[str]:
    """Text about each feature; reasons of refusals are added to ``refused``."""
    said: list[list[str]] = [[] for _ in batch.geometries]
    for problem in problems:
        where = f"part {problem.part}" if problem.part else ""
        reason = problem.reason.removesuffix(f" {problem.status}")
        said[problem.index].append(f"{where} {problem.status}: {reason}".lstrip())
        if problem.status == "refused":
            refused.setdefault(problem.index, f"{where}: {reason}".removeprefix(": "))
    there = ~(shapely.is_missing(batch.geometries) | shapely.is_empty(batch.geometries))
    return ["; ".join(s) or ("ok" if t else NO_GEOMETRY) for s, t in zip(said, there, strict=True)]


def add_lines(
    results: Results,
    batch: "Batch",
    lines: "Geometries",
    *,
    status: list[str],
    refused: dict[int, str],
    geographic: bool,
    connect: bool,
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
    length = measures.length(lines, geographic=geographic)
    own = pieces_inside(lines, areas) if connect else lines
    mean, largest = mean_and_largest_width(own, areas, geographic=geographic)
    columns = {
        "length": numbers(length),
        "width_mean": numbers(mean),
        "width_max": numbers(largest),
        "status": pa.array([status[i] for i in rows], type=pa.string()),
    }
    results.attributes.append(with_columns(batch.attributes.take(rows), columns))
    if results.has_m:
        lines = add_widths(lines, areas, geographic=geographic)
        lines = without_width_outside(lines, areas) if connect else lines
    results.lines.append(lines)
    results.n_lines += int(np.count_nonzero(~shapely.is_missing(lines)))
    results.total_length += float(np.nansum(length))


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
    rows = np.array(sorted(refused), dtype=np.intp)
    columns = {"reason": pa.array([refused[i] for i in rows], type=pa.string())}
    results.refused_attributes.append(with_columns(batch.attributes.take(rows), columns))
    results.refused_areas.append(batch.geometries[rows])
    results.n_refused += len(rows)


def numbers(values: "Floats") -> pa.Array:
    """Make a column of numbers, null where they are NaN."""
    return pa.array(values, type=pa.float64(), from_pandas=True)


def with_columns(table: pa.Table, columns: dict[str, pa.Array]) -> pa.Table:
    """Table with columns added, numbered on where a name is taken: ``length_2``."""
    for name, values in columns.items():
        free = free_name(name, {known.lower() for known in table.column_names})
        # A table without columns has no rows either, however many features it is of.
        table = table.append_column(free, values) if table.num_columns else pa.table({free: values})
    return table
