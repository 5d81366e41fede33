"""Parts made by the workers of a Dask cluster, and lines of Dask's frames.

Every worker reads its partition and writes its part by itself: IN and OUT have to be where all of
them find them under the same name. Nothing but the numbers of features goes over the network.
"""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import pyarrow as pa

from midrib import interrupts
from midrib.checks import check_library
from midrib.engines.frames import collapse_rows, frame_recipe
from midrib.engines.local import POLL, largest_first
from midrib.engines.partitions import Partition
from midrib.engines.parts import Done, Work, make_part
from midrib.errors import MidribError, ParameterError

if TYPE_CHECKING:
    from distributed import Client

    from midrib.engines.recipe import Recipe

__all__ = ["collapse_frame", "run"]

RETRIES = 3  # of a partition that has failed; a worker that is gone does not count
PATIENCE = 30  # seconds until a scheduler that does not answer is taken for gone


def run(
    work: Work,
    partitions: list[Partition],
    said: Callable[[int], None],
    *,
    scheduler: str | None = None,
    workers: int | None = None,
) -> Iterator[Done]:
    """Make the parts of partitions, in any order; ``said`` hears of features that are done.

    Parameters
    ----------
    work, partitions
        What to make of what.
    said : callable
        Takes a number of features.
    scheduler : str, optional
        Address of one that runs. Without it workers are started on this machine.
    workers : int, optional
        How many of them; one a core unless given.

    Raises
    ------
    MissingDependencyError
        If Dask is not installed.
    ParameterError
        If the scheduler does not answer.
    """
    check_library("distributed", "--engine dask", "dask")
    from distributed import as_completed

    with client_of(scheduler, workers) as client:
        # Data that is scattered goes with the last worker that holds it; what tasks hold does not.
        futures = client.map(
            partial(make_part, work), largest_first(partitions), retries=RETRIES, pure=False
        )
        completed, n_missing = as_completed(futures), len(futures)
        try:
            while n_missing:
                interrupts.check()
                for future in completed.next_batch(block=False):
                    n_missing -= 1
                    done = result_of(future)
                    said(done.counts.features)
                    yield done
                time.sleep(POLL)
        finally:
            client.cancel(futures)


def result_of(future: Any) -> Done:
    """Return a part that is finished.

    Raises
    ------
    MidribError
        If it has failed again and again, or all workers that tried it are gone.
    """
    error = future.exception()
    if error is None:
        done: Done = future.result()
        return done
    if isinstance(error, MidribError):
        raise error
    msg = f"a part has failed on Dask {RETRIES + 1} times: {type(error).__name__}: {error}"
    raise MidribError(msg) from error


@contextmanager
def client_of(scheduler: str | None, workers: int | None) -> "Iterator[Client]":
    """Connect to a scheduler, or to one on this machine that is there for the block."""
    from distributed import Client, LocalCluster

    with ExitStack() as stack:
        if scheduler is None:
            cluster = LocalCluster(
                n_workers=workers,
                threads_per_worker=1,  # more would take turns, as Python's work does
                host="127.0.0.1",
                dashboard_address=None,
                worker_dashboard_address=None,
                silence_logs=50,
            )
            yield stack.enter_context(Client(stack.enter_context(cluster)))
            return
        try:
            client = Client(scheduler, timeout=PATIENCE)
        except (OSError, ValueError) as error:
            msg = f"--scheduler {scheduler!r} does not answer: {error}"
            raise ParameterError(msg) from error
        yield stack.enter_context(client)


def collapse_frame(frame: Any, geometry: str = "geometry", **options: Any) -> Any:
    """Collapse the areas of a Dask DataFrame, partition by partition.

    Parameters
    ----------
    frame : dask.dataframe.DataFrame
        With a column of WKB; the others are kept.
    geometry : str, default "geometry"
        That column.
    **options
        ``method``, ``geographic``, ``width`` and the options of ``midrib.collapse``: see
        ``midrib.engines.frames.frame_recipe``.

    Returns
    -------
    dask.dataframe.DataFrame
        The same rows: attributes, length, width_mean, width_max, status, WKB of the line. Where an
        area was refused the line is missing and the status says why.
    """
    recipe = frame_recipe(frame.columns, geometry, **options)
    return frame.map_partitions(collapse_pandas, recipe, meta=collapse_pandas(frame._meta, recipe))


def collapse_pandas(frame: Any, recipe: "Recipe") -> Any:
    """Collapse the areas of a pandas DataFrame; attributes do not leave pandas."""
    wkb = pa.array([*frame[recipe.geometry]], type=pa.binary())
    areas = pa.RecordBatch.from_pydict({recipe.geometry: wkb})
    lines = collapse_rows(areas, replace(recipe, attributes=pa.schema([])))
    names = recipe.lines.names[-lines.num_columns :]
    columns = [column.to_pandas().to_numpy() for column in lines.columns]
    kept = frame.drop(columns=[recipe.geometry])
    return kept.assign(**dict(zip(names, columns, strict=True)))
