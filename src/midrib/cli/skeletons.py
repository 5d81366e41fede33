"""The work of ``midrib skeleton``: features in, the branches of their skeletons out."""

from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import shapely

from midrib import measures
from midrib.cli.job import add_refused, with_columns
from midrib.curves.skeleton import skeleton
from midrib.engines.batches import numbers, statuses
from midrib.formats.units import is_geographic
from midrib.profiles import with_m

if TYPE_CHECKING:
    from midrib.cli.job import Results
    from midrib.formats.reading import Batch

__all__ = ["check_skeleton", "skeleton_layer"]


def check_skeleton(method: str, options: dict[str, Any]) -> None:
    """Refuse a method or an option that there is not, even where no feature needs it."""
    skeleton([], method, **options)


def skeleton_layer(
    results: "Results", batch: "Batch", method: str, options: dict[str, Any]
) -> None:
    """Find the skeletons of the features of a batch: a row for each branch."""
    geographic = is_geographic(results.source.crs)
    found, problems = skeleton(
        batch.geometries, method, on_error="report", geographic=geographic, **options
    )
    refused = dict(batch.unreadable)
    status = statuses(batch.geometries, problems, refused)
    lines, row, number, radius, ends = [], [], [], [], []
    for i, one in enumerate(found):
        if one is None:
            continue
        ways = np.bincount(one.edges.ravel(), minlength=len(one.points))
        for k, rows in enumerate(one.branches):
            line = shapely.linestrings(one.points[rows])
            lines.append(with_m(line, one.radius[rows]) if results.has_m else line)
            radius.append(one.radius[rows])
            ends.append(int(np.count_nonzero(ways[rows[[0, -1]]] == 1)))
            row.append(i)
            number.append(k)
    shapes = np.array([*lines, None], dtype=object)[:-1]
    length = measures.length(shapes, geographic=geographic)
    columns = {
        "branch": pa.array(number, type=pa.int64()),
        "tips": pa.array(ends, type=pa.int64()),
        "length": numbers(length),
        "radius_min": numbers(np.array([r.min() for r in radius])),
        "radius_max": numbers(np.array([r.max() for r in radius])),
        "status": pa.array([status[i] for i in row], type=pa.string()),
    }
    rows_of = np.array(row, dtype=np.intp)
    results.attributes.append(with_columns(batch.attributes.take(rows_of), columns))
    results.lines.append(shapes)
    results.n_lines += len(shapes)
    results.total_length += float(np.nansum(length))
    add_refused(results, batch, refused)
    results.n_features += len(batch.geometries)
    results.n_repaired += len({p.index for p in problems if p.status == "repaired"})
