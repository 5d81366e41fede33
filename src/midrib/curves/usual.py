"""Lines with the usual options, of many areas at once and by several threads."""

import os
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib import interrupts
from midrib.checks import shown
from midrib.curves.construction import CENTRED_WITHIN
from midrib.curves.finding import Found
from midrib.errors import ParameterError
from midrib.kernels.batch import UNDONE, collapse_many
from midrib.ragged import Packed, pack_rings
from midrib.strip import PLANE
from midrib.validity import is_valid_one

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from midrib.layout import Scale
    from midrib.types import Floats, Ints

__all__ = ["Usual", "line_of_one", "threads_to_use", "usual_line", "usual_lines"]

NO_Z = np.zeros(1, np.bool_)
RUN = 2**15  # vertices that a thread takes at a time: a few milliseconds of work


class Lines(NamedTuple):
    """Lines of several areas, see ``collapse_many``."""

    points: "Floats"
    offsets: "Ints"
    loops: "Ints"


class Usual(NamedTuple):
    """Lines of areas as geometries, None where the single steps are to be taken."""

    lines: "NDArray[np.object_]"
    loops: "Ints"  # how many each has lost, UNDONE for None


def threads_to_use(threads: object) -> int:
    """Return how many threads are wanted; None stands for every processor one may use.

    Raises
    ------
    ParameterError
        If it is no positive whole number.
    """
    if threads is None:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 1
    if isinstance(threads, bool) or not isinstance(threads, int | np.integer) or threads < 1:
        msg = f"threads is {shown(threads)}, expected a positive whole number or None"
        raise ParameterError(msg)
    return int(threads)


def line_of_one(area: Polygon) -> LineString | None:
    """Return the line of one area, None if there is anything to look at more closely or to say.

    What many areas need (a log, parts, labels, threads) takes longer than the line of a hundred
    vertices. So does the question whether an area is valid, which its triangles answer on the way
    unless rings touch. Interrupts need not be deferred: ``collapse_many`` is handed plain arrays
    and numbers and gives back a single array, see there.
    """
    if area.is_empty or area.has_z:
        return None
    coordinates, offsets = pack_rings(area)
    found = usual_line(coordinates, offsets, PLANE, is_known=False)
    if found is None and is_valid_one(area):
        found = usual_line(coordinates, offsets, PLANE)
    if found is None or found.loops:
        return None
    line: LineString = shapely.linestrings(found.points)
    return line


def usual_line(
    coordinates: "Floats", offsets: "Ints", scale: "Scale", *, is_known: bool = True
) -> Found | None:
    """Return the line of one area, None if the single steps are to be taken.

    Or if it is not known to be valid and is not shown to be.
    """
    whole = np.array([0, offsets.size - 1], np.intp)
    scales = np.array([scale], np.float64)
    packed = Packed(coordinates, offsets, whole, NO_Z)
    points, _, loops = lines_of_run(packed, (0, 1), scales, is_known=is_known)
    return None if loops[0] == UNDONE else Found(points, None, int(loops[0]))


def lines_of_run(
    packed: Packed, run: tuple[int, int], scales: "Floats", *, is_known: bool = True
) -> Lines:
    """Lines of the areas of one run."""
    n = run[1] - run[0]
    offsets, loops = np.empty(n + 1, np.intp), np.empty(n, np.intp)
    points = collapse_many(*packed[:3], *run, is_known, CENTRED_WITHIN, scales, offsets, loops)
    return Lines(points, offsets, loops)


def usual_lines(packed: Packed, scales: "Floats", threads: int, *, are_known: bool = True) -> Usual:
    """Lines of areas; the same ones, bit by bit, for any number of threads.

    Parameters
    ----------
    packed : the areas
    scales : (n, 2) lengths of one unit of x and of y in each; NaN where none is wanted
    threads : how many run at once
    are_known : whether they are known to be valid; those not shown to be are left out otherwise
    """
    runs = runs_of(packed.ring_offsets[packed.area_offsets])

    def found_in(run: tuple[int, int]) -> Lines:
        return lines_of_run(packed, run, scales, is_known=are_known)

    found: list[Lines] = []
    if min(threads, len(runs)) == 1:
        for run in runs:
            interrupts.check()
            found.append(found_in(run))
    else:
        with ThreadPoolExecutor(threads) as pool:
            try:
                for lines in pool.map(found_in, runs):
                    interrupts.check()
                    found.append(lines)
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise
    return as_geometries(found)


def runs_of(starts: "Ints") -> list[tuple[int, int]]:
    """Divide areas into runs of about as many vertices: the first one, the one after the last."""
    runs, n = [], starts.size - 1
    first = 0
    while first < n:
        last = int(np.searchsorted(starts, starts[first] + RUN, side="right")) - 1
        last = min(max(last, first + 1), n)
        runs.append((first, last))
        first = last
    return runs


def as_geometries(found: list[Lines]) -> Usual:
    """Return the lines of several runs as geometries."""
    if len(found) == 1:  # a single area should not wait for eight copies
        return geometries_of(found[0])
    runs = [geometries_of(lines) for lines in found]
    return Usual(*(np.concatenate(column) for column in zip(*runs, strict=True)))


def geometries_of(found: Lines) -> Usual:
    """Return the lines of a run as geometries."""
    sizes = found.offsets[1:] - found.offsets[:-1]
    lines: NDArray[np.object_] = np.full(sizes.size, None, dtype=object)
    shapely.linestrings(found.points, indices=np.repeat(np.arange(sizes.size), sizes), out=lines)
    return Usual(lines, found.loops)
