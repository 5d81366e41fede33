"""The work of ``midrib label`` and ``midrib points``: features in, lines or points out."""

from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import shapely

from midrib import measures
from midrib.cli.job import add_refused, with_columns
from midrib.curves.collapse import collapse
from midrib.curves.control import control_points
from midrib.curves.label import label_line
from midrib.engines.batches import numbers, statuses
from midrib.formats.units import is_geographic

if TYPE_CHECKING:
    from midrib.cli.job import Results
    from midrib.curves.log import Problem
    from midrib.formats.reading import Batch

__all__ = ["check_label", "label_layer", "point_layer"]


def check_label(options: dict[str, Any]) -> None:
    """Refuse options that have a value they cannot have, even where no feature needs them."""
    label_line([], **options)


def label_layer(results: "Results", batch: "Batch", options: dict[str, Any]) -> None:
    """Find the label lines of the features of a batch."""
    geographic = is_geographic(results.source.crs)
    labels, problems = label_line(
        batch.geometries, on_error="report", geographic=geographic, **options
    )
    refused = dict(batch.unreadable)
    status = statuses(batch.geometries, problems, refused)
    rows = np.array([i for i in range(len(status)) if i not in refused], dtype=np.intp)
    lines = labels.lines[rows]
    length = measures.length(lines, geographic=geographic)
    columns = {
        "length": numbers(length),
        "height": numbers(labels.heights[rows]),
        "status": pa.array([status[i] for i in rows], type=pa.string()),
    }
    results.attributes.append(with_columns(batch.attributes.take(rows), columns))
    results.lines.append(lines)
    results.n_lines += int(np.count_nonzero(~shapely.is_missing(lines)))
    results.total_length += float(np.nansum(length))
    count(results, batch, problems, refused)


def point_layer(results: "Results", batch: "Batch", method: str, options: dict[str, Any]) -> None:
    """Find the control points of the lines of a batch."""
    geographic = is_geographic(results.source.crs)
    lines, problems = collapse(batch.geometries, method, on_error="report", geographic=geographic)
    refused = dict(batch.unreadable)
    status = statuses(batch.geometries, problems, refused)
    parts, row = shapely.get_parts(lines, return_index=True)
    parts, row = parts[~shapely.is_empty(parts)], row[~shapely.is_empty(parts)]
    whole = shapely.is_valid(batch.geometries)
    found = []
    for line, i in zip(parts, row, strict=True):
        area = next((p for p in shapely.get_parts(batch.geometries[i]) if p.covers(line)), None)
        found.append(
            control_points(line, area=area if whole[i] else None, geographic=geographic, **options)
        )
    sizes = [len(points.rows) for points in found]
    rows = np.repeat(row, sizes)
    part = np.repeat(np.arange(row.size) - np.searchsorted(row, row), sizes)
    empty = [np.empty(0)]
    columns = {
        "part": pa.array(part, type=pa.int64()),
        "vertex": pa.array(np.concatenate([*empty, *(p.rows for p in found)]).astype(np.int64)),
        "importance": numbers(np.concatenate([*empty, *(p.importance for p in found)])),
        "status": pa.array([status[i] for i in rows], type=pa.string()),
    }
    results.attributes.append(with_columns(batch.attributes.take(rows), columns))
    places = [shapely.points(points.points) for points in found]
    results.lines.append(np.concatenate([np.empty(0, dtype=object), *places]))
    results.n_lines += len(parts)
    results.total_length += float(np.nansum(measures.length(parts, geographic=geographic)))
    count(results, batch, problems, refused)


def count(
    results: "Results", batch: "Batch", problems: "list[Problem]", refused: dict[int, str]
) -> None:
    """Keep what was refused, and count features."""
    add_refused(results, batch, refused)
    results.n_features += len(batch.geometries)
    results.n_repaired += len({p.index for p in problems if p.status == "repaired"})
