"""The work of ``midrib partial``: features in, lines of their narrow parts and wide parts out."""

from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import shapely

from midrib.cli.job import add_doubted, add_refused, with_columns
from midrib.cli.networks import add_pieces
from midrib.cli.output import Second
from midrib.curves.partial import partial_collapse
from midrib.engines.batches import statuses
from midrib.formats.units import is_geographic

if TYPE_CHECKING:
    from midrib.cli.job import Results
    from midrib.cli.networks import Nodes
    from midrib.formats.reading import Batch, Geometries

__all__ = ["WideParts", "check_partial", "partial_layer"]


class WideParts:
    """The parts of areas that are kept, batch by batch."""

    def __init__(self) -> None:
        self.attributes: list[pa.Table] = []
        self.areas: list[Geometries] = []
        self.n_uncut = 0  # features some narrow part of which has stayed an area

    def add(self, batch: "Batch", kept: "Geometries", status: list[str]) -> None:
        """Keep a row for each part, with the attributes of its feature."""
        areas, row = shapely.get_parts(kept, return_index=True)
        is_there = ~shapely.is_empty(areas)
        areas, row = areas[is_there], row[is_there]
        number = np.arange(row.size) - np.searchsorted(row, row)
        columns = {
            "part": pa.array(number, type=pa.int64()),
            "status": pa.array([status[i] for i in row], type=pa.string()),
        }
        self.attributes.append(with_columns(batch.attributes.take(row), columns))
        self.areas.append(areas)

    def layer(self) -> Second:
        """Return the layer of parts."""
        areas = np.concatenate(self.areas)
        summary = f"{len(areas)} areas that are wider"
        if self.n_uncut:
            summary += f", narrow parts of {self.n_uncut} features uncut among them"
        return Second(pa.concat_tables(self.attributes), areas, "Polygon", summary)


def check_partial(method: str, options: dict[str, Any]) -> None:
    """Refuse a method or an option that there is not, even where no feature needs it."""
    partial_collapse([], method=method, **options)


def partial_layer(
    results: "Results",
    nodes: "Nodes",
    wide: WideParts,
    batch: "Batch",
    method: str,
    options: dict[str, Any],
) -> None:
    """Collapse the narrow parts of the features of a batch."""
    geographic = is_geographic(results.source.crs)
    areas = batch.geometries
    partial, problems = partial_collapse(
        areas, method=method, on_error="report", geographic=geographic, **options
    )
    refused = dict(batch.unreadable)
    status = statuses(batch.geometries, problems, refused)
    add_pieces(results, nodes, batch, partial.lines, status, geographic)
    wide.add(batch, partial.areas, status)
    uncut = {p.index: status[p.index] for p in problems if p.status == "uncut"}
    wide.n_uncut += len(uncut)
    add_refused(results, batch, refused)
    add_doubted(results, batch, {i: why for i, why in uncut.items() if i not in refused})
    results.n_features += len(areas)
    results.n_repaired += len({p.index for p in problems if p.status == "repaired"})
