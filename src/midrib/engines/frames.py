"""Frames of Spark and Dask: a column of WKB becomes lines, rows stay what they are."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import pyarrow as pa

from midrib.engines.batches import collapse_batch
from midrib.engines.recipe import MEASURES, Recipe, check_options
from midrib.errors import ParameterError
from midrib.formats.geoparquet import CRS84_TEXT

__all__ = ["collapse_rows", "frame_recipe"]

WIDTHS = ("columns", "m")


def frame_recipe(
    columns: Iterable[Any],
    geometry: str = "geometry",
    *,
    method: str = "minimal-radii",
    geographic: bool = False,
    width: str = "columns",
    **options: Any,
) -> Recipe:
    """Recipe for the rows of a frame.

    Parameters
    ----------
    columns : iterable
        Names of the columns of the frame.
    geometry : str, default "geometry"
        The one of WKB.
    method : str, default "minimal-radii"
        One of ``midrib.methods()``.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude.
    width : {"columns", "m"}, default "columns"
        Whether lines carry the width as M values beside the columns about it.
    **options
        Those of ``midrib.collapse``, but for ``along`` and ``connect``: each row is by itself.

    Raises
    ------
    ParameterError
        If there is no such column, or an option is unknown or has a value it cannot have.
    """
    names = [str(name) for name in columns]
    if geometry not in names:
        msg = f"geometry is {geometry!r}, expected a column: {', '.join(names)}"
        raise ParameterError(msg)
    if width not in WIDTHS:
        msg = f"width is {width!r}, expected one of {', '.join(WIDTHS)}"
        raise ParameterError(msg)
    check_options(method, options)
    crs = CRS84_TEXT if geographic else None
    attributes = pa.schema([(name, pa.null()) for name in names if name != geometry])
    return Recipe(attributes, geometry, crs, method, options, has_m=width == "m")


def collapse_rows(areas: pa.RecordBatch, recipe: Recipe) -> pa.RecordBatch:
    """Collapse the areas of a batch, and keep all its rows.

    Returns
    -------
    pyarrow.RecordBatch
        Columns as ``recipe.lines`` has them; where an area was refused the line and its measures
        are missing and the status says why.
    """
    found = collapse_batch(areas, recipe)
    n = found.refused.num_rows
    *attributes, reasons, _ = found.refused.columns
    said = pa.array([f"refused: {reason}" for reason in reasons.to_pylist()], type=pa.string())
    missing = [pa.nulls(n, kind) for kind in list(MEASURES.values())[:-1]]
    columns = [*attributes, *missing, said, pa.nulls(n, pa.binary())]
    without = pa.RecordBatch.from_arrays(columns, schema=recipe.lines)
    order = np.argsort(np.concatenate([found.rows, found.refused_rows]))
    both = pa.Table.from_batches([found.lines, without]).take(order).combine_chunks()
    return next(iter(both.to_batches()), found.lines)
