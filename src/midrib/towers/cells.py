"""Cells of a shell: a cloud thinned to one distance for each level and sector.

cell      a level (a slice of the axis) and a sector (a range of azimuths)
d         distance of a point beyond the reference shell
window    the range of d, as wide as a wall is rough, that holds most points of a cell

Ladders, platforms and mixed pixels lie beside the window; what remains is the median, and then
the mean of what is near it, which has less noise and is exact where there is none.
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.errors import ParameterError
from midrib.kernels.cube import MOMENTS, count_points
from midrib.towers.rough import Frame, Rough

if TYPE_CHECKING:
    from collections.abc import Iterable

    from midrib.types import Bools, Floats, Ints

__all__ = ["Cells", "Cube", "Grid", "Reference", "cells_of", "grid_for", "reference_of"]

STEP = 0.1  # metres between the rows of a reference table
LEVEL, SECTORS = 0.5, 72  # metres, number
COARSE, FINE = (0.30, 0.002), (0.10, 0.0005)  # metres: reach, width of a bin
WINDOW = 0.036  # metres
ENOUGH = 8  # points of a cell, of large clouds
FULL = 24  # points a cell should have on average: small clouds get larger cells
ROWS = 2000  # cells that are thinned together
SKIPPED = 2.5  # standard deviations from the median beyond which points do not count
THIN = 0.3  # metres: thinner towers have everything in proportion


class Reference(NamedTuple):
    """A shell to measure from: axis and radius at even steps, in a frame."""

    frame: Frame
    start: float
    step: float
    table: "Floats"  # (m, 5): x, y, radius, slopes of x and y
    faces: "Floats"

    def at(self, s: "Floats") -> "Floats":
        """Rows of the table (n, 5) at heights, straight between them, as the kernel has them."""
        grid = self.start + self.step * np.arange(len(self.table))
        columns = [np.interp(s, grid, column) for column in self.table.T]
        return np.column_stack(columns).astype(np.float64, copy=False)


class Grid(NamedTuple):
    """Levels and sectors."""

    start: float
    level: float
    n_levels: int
    n_sectors: int
    enough: int

    @property
    def middles(self) -> "Floats":
        """Heights of the levels' middles."""
        heights = self.start + self.level * (np.arange(self.n_levels) + 0.5)
        return heights.astype(np.float64, copy=False)


class Cells(NamedTuple):
    """One row for each cell with enough points."""

    level: "Ints"
    sector: "Ints"
    s: "Floats"  # mean height of the points
    azimuth: "Floats"  # their mean azimuth
    d: "Floats"  # beyond the reference shell
    n: "Floats"  # points that were averaged
    spread: "Floats"  # standard deviation of them
    reference: Reference
    grid: Grid

    def where(self, rows: "Bools") -> "Cells":
        """Return some of the cells."""
        level, sector, s, azimuth, d, n, spread = (column[rows] for column in self.columns)
        return Cells(level, sector, s, azimuth, d, n, spread, self.reference, self.grid)

    @property
    def columns(self) -> "tuple[Any, ...]":
        """Everything with a row for each cell."""
        return self.level, self.sector, self.s, self.azimuth, self.d, self.n, self.spread


def reference_of(rough: Rough, unit: float, low: float, high: float) -> Reference:
    """Return the shell of a rough axis between two heights, straight on at its ends."""
    step = STEP * unit
    s = np.arange(low - step, high + 2.0 * step, step)
    table = rough.table
    columns = [extended(s, table[:, 0], table[:, k]) for k in (1, 2, 3)]
    columns[2] = np.maximum(columns[2], 1e-6 * table[:, 3].max())
    slopes = [np.gradient(columns[k], step) for k in (0, 1)]
    return Reference(
        rough.frame, float(s[0]), step, np.column_stack([*columns, *slopes]), rough.faces
    )


def extended(s: "Floats", at: "Floats", values: "Floats") -> "Floats":
    """Interpolated values, straight on beyond the ends."""
    inside = np.interp(s, at, values)
    n = max(1, len(at) // 20)
    first = (values[n] - values[0]) / (at[n] - at[0])
    last = (values[-1] - values[-1 - n]) / (at[-1] - at[-1 - n])
    inside = inside + np.minimum(s - at[0], 0.0) * first
    beyond: Floats = inside + np.maximum(s - at[-1], 0.0) * last
    return beyond


def grid_for(low: float, high: float, n_points: float, unit: float) -> Grid:
    """Levels and sectors for so many points on the wall: fewer where there are few points."""
    level = min(LEVEL * unit, rounded_down((high - low) / 40.0))
    sectors = SECTORS
    while n_points / ((high - low) / level * sectors) < FULL and sectors > 24:
        sectors //= 2
        if n_points / ((high - low) / level * sectors) < FULL and (high - low) / level > 20:
            level *= 2.0
    n_levels = max(1, int(np.ceil((high - low) / level - 1e-9)))
    mean = n_points / (n_levels * sectors)
    return Grid(low, level, n_levels, sectors, int(np.clip(mean / 4.0, 1, ENOUGH)))


def rounded_down(length: float) -> float:
    """Largest of 1, 2 and 5 times a power of ten that is not above a length."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(
        max(step * power for step in (1.0, 2.0, 5.0) if step * power <= length * (1 + 1e-9))
    )


def scale_of(rough_radius: float, unit: float) -> float:
    """Factor for reaches and bins: coordinate units, and smaller for thin towers."""
    return unit * float(np.clip(rough_radius / unit / THIN, 0.25, 1.0))


class Cube:
    """Counts of points by level, sector and distance from a shell."""

    def __init__(self, reference: Reference, grid: Grid, unit: float, *, fine: bool) -> None:
        factor = scale_of(float(np.median(reference.table[:, 2])), unit)
        reach, self.width = (factor * value for value in (FINE if fine else COARSE))
        n_bins = round(2.0 * reach / self.width) + 1  # odd: the shell is in the middle of a bin
        self.low = -0.5 * n_bins * self.width
        self.window = max(1, round(WINDOW * factor / self.width))
        self.reference, self.grid = reference, grid
        shape = (grid.n_levels, grid.n_sectors)
        # Half the memory of doubles: the cube is what takes room. Counts are exact up to 2^24.
        self.counts: Any = np.zeros((*shape, n_bins), dtype=np.float32)
        self.sums: Any = np.zeros_like(self.counts)
        self.moments = np.zeros((*shape, MOMENTS))

    def add(self, points: "Floats") -> None:
        """Count points (n, 3)."""
        reference, grid = self.reference, self.grid
        numbers = [reference.start, reference.step, grid.start, grid.level, self.low, self.width]
        count_points(
            np.ascontiguousarray(points, dtype=np.float64),
            reference.frame.origin,
            reference.frame.turn,
            np.ascontiguousarray(reference.table),
            np.ascontiguousarray(reference.faces).reshape(-1, 2),
            np.array(numbers),
            self.counts,
            self.sums,
            self.moments,
        )

    def cells(self) -> Cells:
        """One distance for each cell that has enough points."""
        level, sector = np.nonzero(self.counts.sum(axis=2) >= self.grid.enough)
        # A few rows at a time: copies of the whole cube in doubles would take most of the memory.
        parts = [(np.zeros(0),) * 3]
        for k in range(0, level.size, ROWS):
            rows = level[k : k + ROWS], sector[k : k + ROWS]
            parts.append(self.distances(self.counts[rows], self.sums[rows]))
        d, total, spread = (np.concatenate(column) for column in zip(*parts, strict=True))
        m = self.moments[level, sector]
        azimuth = sector * 2.0 * np.pi / self.grid.n_sectors + m[:, 0] / m[:, 2]
        height = m[:, 1] / m[:, 2]
        cells = Cells(level, sector, height, azimuth, d, total, spread, self.reference, self.grid)
        return cells.where(total >= self.grid.enough)

    def distances(self, counts: "Floats", sums: "Floats") -> "tuple[Floats, Floats, Floats]":
        """Distance, number of points and spread of each row of bins."""
        low, width = self.low, self.width
        counts, sums = counts.astype(np.float64), sums.astype(np.float64)
        first = densest(counts, self.window)
        columns = np.arange(counts.shape[1])
        inside = (columns >= first[:, None]) & (columns < first[:, None] + self.window)
        median, spread = middle_of(np.where(inside, counts, 0.0), low, width)
        near = np.abs(low + (columns + 0.5) * width - median[:, None])
        keep = near <= np.maximum(SKIPPED * spread, 1.5 * width)[:, None]
        kept = np.where(keep, counts, 0.0)
        total = kept.sum(axis=1)
        bin_middle = low + (columns + 0.5) * width
        d = (kept @ bin_middle + np.where(keep, sums, 0.0).sum(axis=1)) / np.maximum(total, 1.0)
        return d, total, spread


def cells_of(
    chunks: "Iterable[Floats]", reference: Reference, grid: Grid, unit: float, *, fine: bool
) -> Cells:
    """Thin a cloud to cells; one pass.

    Raises
    ------
    ParameterError
        If no cell has enough points.
    """
    cube = Cube(reference, grid, unit, fine=fine)
    for chunk in chunks:
        cube.add(chunk)
    cells = cube.cells()
    if not cells.level.size:
        msg = (
            f"no tower was found: no part of the best shell has {grid.enough} points; near= and "
            "radius= say where it is and how thick"
        )
        raise ParameterError(msg)
    return cells


def densest(counts: "Floats", window: int) -> "Ints":
    """First bin of the window (n,) that holds most; the middle one of several."""
    running = np.cumsum(np.pad(counts, ((0, 0), (1, 0))), axis=1)
    window = min(window, counts.shape[1])
    held = running[:, window:] - running[:, :-window]
    best = held == held.max(axis=1)[:, None]
    first = np.argmax(best, axis=1)
    last = held.shape[1] - 1 - np.argmax(best[:, ::-1], axis=1)
    middle = (first + last) // 2
    is_best: Bools = best[np.arange(len(best)), middle]
    chosen: Ints = np.where(is_best, middle, first)
    return chosen


def middle_of(counts: "Floats", low: float, width: float) -> "tuple[Floats, Floats]":
    """Median and standard deviation (by the quartiles) of binned values."""
    running = np.cumsum(counts, axis=1)
    total = running[:, -1]
    quartiles = []
    for share in (0.25, 0.5, 0.75):
        wanted = share * total
        at = np.argmax(running >= wanted[:, None], axis=1)
        rows = np.arange(len(at))
        inside = counts[rows, at]
        before = running[rows, at] - inside
        part = np.divide(wanted - before, inside, out=np.full(len(at), 0.5), where=inside > 0)
        quartiles.append(low + (at + part) * width)
    return quartiles[1], (quartiles[2] - quartiles[0]) / 1.349
