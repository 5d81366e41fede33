"""One batch of areas to one batch of lines: the function that every engine calls.

It depends on its arguments alone and knows neither files nor machines, so that the same areas have
the same lines, byte by byte, wherever they are computed and however they are divided into batches.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pyarrow as pa
import shapely

from midrib import measures
from midrib.curves.collapse import collapse
from midrib.formats.reading import Batch, decoded
from midrib.measures.widths import mean_and_largest_width
from midrib.profiles import add_widths
from midrib.ragged import without_holes

if TYPE_CHECKING:
    from midrib.curves.log import Problem
    from midrib.engines.recipe import Recipe
    from midrib.formats.reading import Geometries
    from midrib.types import Floats

__all__ = ["Collapsed", "Counts", "collapse_batch", "measured", "numbers", "statuses"]

NO_GEOMETRY = "no geometry"


@dataclass
class Counts:
    """What has become of features."""

    features: int = 0
    lines: int = 0
    refused: int = 0
    repaired: int = 0
    length: float = 0.0  # of all lines, in units of the CRS, metres if it is geographic

    def add(self, other: "Counts") -> None:
        """Count others too."""
        for name, value in vars(other).items():
            setattr(self, name, getattr(self, name) + value)


class Collapsed(NamedTuple):
    """What has become of a batch.

    Attributes
    ----------
    rows : ndarray of intp
        Rows of the batch that ``lines`` are of: all but the refused ones.
    lines : pyarrow.RecordBatch
        Attributes, length, width_mean, width_max, status, WKB of the line; of features that never
        had a geometry too.
    refused_rows : ndarray of intp
        Rows of the batch that ``refused`` are of.
    refused : pyarrow.RecordBatch
        Attributes, reason, WKB of the area.
    counts : Counts
        Of both.
    """

    rows: "np.ndarray[tuple[int], np.dtype[np.intp]]"
    lines: pa.RecordBatch
    refused_rows: "np.ndarray[tuple[int], np.dtype[np.intp]]"
    refused: pa.RecordBatch
    counts: Counts


def collapse_batch(
    areas: pa.RecordBatch, recipe: "Recipe", first: int = 0, threads: int | None = 1
) -> Collapsed:
    """Collapse the areas of a batch.

    Parameters
    ----------
    areas : pyarrow.RecordBatch
        Attributes and a column of WKB, named as the recipe says; other columns are left out.
    recipe : Recipe
        What to make of them.
    first : int, default 0
        Number of features of the layer before the batch, for guides that go by it.
    threads : int or None, default 1
        Those of ``midrib.collapse``; where processes share a machine one each is enough.

    Returns
    -------
    Collapsed
        Lines and refused areas, each in the order of the batch.
    """
    attributes = pa.Table.from_batches([areas]).select(recipe.attributes.names)
    batch = Batch(first, attributes, *decoded(areas.column(recipe.geometry)))
    along, unreadable = recipe.guides.of(batch)
    lines, problems = collapse(
        batch.geometries,
        recipe.method,
        on_error="report",
        along=along,
        geographic=recipe.geographic,
        threads=threads,
        **recipe.options,
    )
    lines[shapely.is_empty(lines)] = None
    lines[list(unreadable)] = None
    refused = dict(batch.unreadable) | unreadable
    status = statuses(batch.geometries, problems, refused)
    rows = np.flatnonzero(~shapely.is_missing(lines) | is_none_of(len(lines), refused))
    columns, length = lines_of(batch.geometries[rows], lines[rows], recipe)
    text = pa.array([status[i] for i in rows], type=pa.string())
    refused_rows = np.array(sorted(refused), dtype=np.intp)
    reasons = pa.array([refused[i] for i in refused_rows.tolist()], type=pa.string())
    return Collapsed(
        rows,
        record_batch(attributes.take(rows), [*columns[:-1], text, columns[-1]], recipe.lines),
        refused_rows,
        record_batch(
            attributes.take(refused_rows),
            [reasons, wkb_of(batch.geometries[refused_rows])],
            recipe.refused,
        ),
        Counts(
            len(lines),
            int(np.count_nonzero(~shapely.is_missing(lines[rows]))),
            len(refused),
            len({p.index for p in problems if p.status == "repaired"}),
            length,
        ),
    )


def lines_of(
    areas: "Geometries", lines: "Geometries", recipe: "Recipe"
) -> tuple[list[pa.Array], float]:
    """Columns of lines, length and widths and WKB, and how long all are."""
    if recipe.options.get("holes") == "ignored":
        areas = np.array([*map(without_holes, areas), None], dtype=object)[:-1]
    columns, length = measured(lines, areas, geographic=recipe.geographic)
    if recipe.has_m:
        lines = add_widths(lines, areas, geographic=recipe.geographic)
    return [*columns, wkb_of(lines)], length


def measured(
    lines: "Geometries",
    areas: "Geometries",
    *,
    geographic: bool,
    inside: "Geometries | None" = None,
) -> tuple[list[pa.Array], float]:
    """Columns of the length and of the mean and largest width, and how long all lines are.

    ``inside`` are the pieces of the lines that are in their areas, if these are not all.
    """
    length = measures.length(lines, geographic=geographic)
    own = lines if inside is None else inside
    mean, largest = mean_and_largest_width(own, areas, geographic=geographic)
    return [numbers(length), numbers(mean), numbers(largest)], float(np.nansum(length))


def statuses(
    areas: "Geometries", problems: "Sequence[Problem]", refused: dict[int, str]
) -> list[str]:
    """Text about each feature; reasons of refusals are added to ``refused``."""
    said: list[list[str]] = [[] for _ in areas]
    for problem in problems:
        where = f"part {problem.part}" if problem.part else ""
        reason = problem.reason.removesuffix(f" {problem.status}")
        said[problem.index].append(f"{where} {problem.status}: {reason}".lstrip())
        if problem.status == "refused":
            refused.setdefault(problem.index, f"{where}: {reason}".removeprefix(": "))
    there = ~(shapely.is_missing(areas) | shapely.is_empty(areas))
    return ["; ".join(s) or ("ok" if t else NO_GEOMETRY) for s, t in zip(said, there, strict=True)]


def is_none_of(count: int, rows: dict[int, str]) -> "np.ndarray[tuple[int], np.dtype[np.bool_]]":
    """Whether each of some rows is none of others."""
    result = np.ones(count, dtype=np.bool_)
    result[list(rows)] = False
    return result


def record_batch(
    attributes: pa.Table, columns: Sequence[pa.Array], schema: pa.Schema
) -> pa.RecordBatch:
    """Attributes and more columns as one batch."""
    kept = [column.combine_chunks() for column in attributes.columns]
    return pa.RecordBatch.from_arrays([*kept, *columns], schema=schema)


def wkb_of(geometries: "Geometries") -> pa.Array:
    """Column of WKB, with M values where geometries have them."""
    return pa.array(shapely.to_wkb(geometries, flavor="iso"), type=pa.binary())


def numbers(values: "Floats") -> pa.Array:
    """Make a column of numbers, null where they are NaN."""
    return pa.array(values, type=pa.float64(), from_pandas=True)
