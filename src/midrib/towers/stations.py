"""Stations that do not quite fit together, and what makes them.

o_k       how far station k is off, in the frame's plane: a shift; the mean of all stations is 0
n         outward normal of the shell in a cell
d_k       distance of the cell as station k has it

f(θ)      form of the section, the same for all stations: harmonics of a band of the shell

Two stations that see the same cell see the same bump of the wall, so

    d_k - f(θ_k) - d_j + f(θ_j) = n · (o_k - o_j)

Points of a cell lie nearer to the side from which they are seen, so their mean azimuths θ_k differ,
and with them an oval's distances: 1 mm at an oval of 30 mm. With the form taken off, where each
station has its points does not matter, whatever the section is. What all stations are off by
together no cloud can tell.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.towers.cells import Cells, Cube, Grid, Reference
from midrib.towers.joint import normals_of
from midrib.towers.weights import tukey

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from midrib.towers.cloud import Cloud
    from midrib.types import Floats, Ints

__all__ = ["Aligned", "Station", "Stations", "labels_in", "stations_of"]

LEAST_SHARE = 0.01  # of the sample, that makes a label a station
MOST_STATIONS = 12  # each has a cube of counts of its own
COARSER = 2  # cells are so much larger than those of the fit, either way
USUAL = 0.01  # metres: standard deviation of shifts before any is known
KNOWN = 0.0005  # metres: shifts that are less certain are not applied
GRAZING = 0.0003  # metres: what beams that graze the shell may differ by, as simulated scans show
ROUNDS = 8
FORM_BAND, FORM_ROUNDS = 5.0, 3  # metres of the shell that have one form; fits, the last weighed
HIGHEST_ORDER = 8  # of the form, as of the gate's
FORM_LEFT = 0.01  # of the form's amplitude: what is left of it in shifts, as simulated scans show


class Station(NamedTuple):
    """A station, and how far it is off the mean of all: coordinate units."""

    label: int
    cells: int  # of the shell, that it shares with others
    x: float
    y: float
    sigma: float  # of x and y


class Stations(NamedTuple):
    """What a reading station by station tells."""

    found: list[Station]  # none if they see too little in common
    cells: Cells  # larger ones than those of the fit, of all stations where they fit together


class Aligned:
    """A cloud whose stations are put where they fit together."""

    has_stations = True

    def __init__(self, cloud: "Cloud", stations: list[Station]) -> None:
        self.cloud = cloud
        self.count, self.metres = cloud.count, cloud.metres
        self.crs, self.name, self.types = cloud.crs, cloud.name, cloud.types
        order = sorted(stations)
        self.labels = np.array([station.label for station in order], dtype=np.float64)
        self.shifts = np.array([(station.x, station.y, 0.0) for station in order])

    def chunks(self, *, with_stations: bool = False) -> "Iterator[Floats]":
        """Points, a chunk at a time."""
        for chunk in self.cloud.chunks(with_stations=True):
            yield self.moved(chunk)[:, : 3 + with_stations]

    def some(self, most: int) -> "Iterator[Floats]":
        """Points from all over the cloud."""
        return map(self.moved, self.cloud.some(most))

    def moved(self, chunk: "Floats") -> "Floats":
        """Points with their stations' shifts taken off; those of no station stay."""
        at = np.minimum(np.searchsorted(self.labels, chunk[:, 3]), len(self.labels) - 1)
        known = self.labels[at] == chunk[:, 3]
        found = chunk.copy()
        found[:, :3] -= np.where(known[:, None], self.shifts[at], 0.0)
        return found


def labels_in(sample: "Floats") -> "Floats":
    """Labels of stations in a sample (n, 4); none if there are one or too many, or no column."""
    if sample.shape[1] < 4:
        return np.zeros(0)
    labels, counts = np.unique(sample[:, 3], return_counts=True)
    labels = labels[counts >= LEAST_SHARE * len(sample)]
    return labels if 2 <= labels.size <= MOST_STATIONS else np.zeros(0)


def stations_of(
    chunks: "Iterable[Floats]", labels: "Floats", reference: Reference, grid: Grid, unit: float
) -> Stations:
    """Find how far stations are off where they overlap; one pass.

    Notes
    -----
    Robust least squares of all differences, the mean of each cell taken off, with shifts that are
    some millimetres before anything is known. O(n) for n points.
    """
    cubes = [Cube(reference, coarser(grid), unit, fine=True) for _ in labels]
    for chunk in chunks:
        for label, cube in zip(labels, cubes, strict=True):
            cube.add(chunk[chunk[:, 3] == label, :3])
    seen = [cube.cells() for cube in cubes]
    parts = without_form(seen, unit)
    taken = np.concatenate([old.d - new.d for old, new in zip(seen, parts, strict=True)])
    design, known, shares = differences(parts)
    shifts, sigma = fitted(design, known, len(labels), unit)
    sigma = np.hypot(sigma, FORM_LEFT * np.sqrt(2.0) * float(np.std(taken)) if taken.size else 0.0)
    if not sigma.max(initial=np.inf if not known.size else 0.0) <= KNOWN * unit:
        return Stations([], together(seen, np.zeros_like(shifts)))
    turned = shifts @ reference.frame.turn[:2, :2]
    found = [
        Station(int(label), int(n), float(x), float(y), float(s))
        for label, n, (x, y), s in zip(labels, shares, turned, sigma, strict=True)
    ]
    return Stations(found, together(seen, shifts))


def together(parts: list[Cells], shifts: "Floats") -> Cells:
    """Cells of all stations, each station's shift (x, y) taken off: means by numbers of points."""
    grid = parts[0].grid
    at = np.concatenate([cells.level * grid.n_sectors + cells.sector for cells in parts])
    moved = [
        cells.d - normals_of(cells)[0] @ shift for cells, shift in zip(parts, shifts, strict=True)
    ]
    means = np.column_stack(
        [
            np.concatenate([cells.s for cells in parts]),
            np.concatenate([cells.azimuth for cells in parts]),
            np.concatenate(moved),
            np.concatenate([cells.spread for cells in parts]),
        ]
    )
    n = np.concatenate([cells.n for cells in parts])
    place, cell = np.unique(at, return_inverse=True)
    total: Floats = np.bincount(cell, weights=n).astype(np.float64)
    s, azimuth, d, spread = (np.bincount(cell, weights=n * mean) / total for mean in means.T)
    level, sector = np.divmod(place, grid.n_sectors)
    return Cells(level, sector, s, azimuth, d, total, spread, parts[0].reference, grid)


def coarser(grid: Grid) -> Grid:
    """Grid with larger cells, so that many cubes have room."""
    levels, sectors = -(-grid.n_levels // COARSER), max(24, grid.n_sectors // COARSER)
    return grid._replace(level=COARSER * grid.level, n_levels=levels, n_sectors=sectors)


def without_form(parts: list[Cells], unit: float) -> list[Cells]:
    """Cells of stations with the harmonics of the shell that all of them see taken off."""
    rise = max(1, round(FORM_BAND * unit / parts[0].grid.level))
    band = np.concatenate([cells.level // rise for cells in parts])
    angle = np.concatenate([cells.azimuth for cells in parts])[:, None]
    turns = angle * np.arange(1, HIGHEST_ORDER + 1)
    design = np.column_stack([np.ones(len(turns)), np.cos(turns), np.sin(turns)])
    left = np.concatenate([cells.d for cells in parts])
    for b in np.unique(band):
        here = band == b
        left[here] = residual_of(design[here], left[here], unit)
    ends = np.cumsum([cells.d.size for cells in parts])[:-1]
    split = np.split(left, ends)
    return [cells._replace(d=d) for cells, d in zip(parts, split, strict=True)]


def residual_of(design: "Floats", known: "Floats", unit: float) -> "Floats":
    """Return what harmonics do not explain, by robust least squares; unseen parts have none."""
    every, weight, residual = np.ones(known.size, dtype=np.bool_), np.ones(known.size), known
    for _ in range(FORM_ROUNDS):
        root = np.sqrt(weight)
        answer = np.linalg.lstsq(root[:, None] * design, root * known, rcond=1e-3)[0]
        residual = known - design @ answer
        weight = tukey(residual, every, unit)
    return residual


def differences(parts: list[Cells]) -> "tuple[Floats, Floats, Ints]":
    """Design (m, 2 k) and distances (m,) of cells that two or more of k stations share.

    Of each cell the mean is taken off both. Also how many shared cells each station has.
    """
    n = len(parts)
    grid = parts[0].grid
    d: Floats = np.full((grid.n_levels * grid.n_sectors, n), np.nan)
    normal = np.zeros((len(d), n, 2))
    for k, cells in enumerate(parts):
        at = cells.level * grid.n_sectors + cells.sector
        directions, off_corner = normals_of(cells)
        d[at[off_corner], k] = cells.d[off_corner]
        normal[at, k] = directions
    is_shared = np.isfinite(d).sum(axis=1) > 1
    d, normal = d[is_shared], normal[is_shared]
    there = np.isfinite(d)
    share = there / there.sum(axis=1, keepdims=True)
    own = np.eye(n)[None, :, :, None] * normal[:, :, None, :]  # cell, station, whose shift, x y
    mean = (share[:, :, None, None] * own).sum(axis=1, keepdims=True)
    design: Floats = (own - mean).reshape(-1, 2 * n)
    known = (d - np.nanmean(d, axis=1, keepdims=True)).ravel() if len(d) else np.zeros(0)
    rows = there.ravel()
    return design[rows], known[rows], there.sum(axis=0)


def fitted(design: "Floats", known: "Floats", n: int, unit: float) -> "tuple[Floats, Floats]":
    """Shifts (n, 2) of stations about their mean, and standard deviations (n,)."""
    every = np.ones(known.size, dtype=np.bool_)
    weight = np.ones(known.size)
    residual, answer = known, np.zeros(2 * n)
    centred = np.kron(np.eye(n) - 1.0 / n, np.eye(2))
    inverse = np.zeros((2 * n, 2 * n))
    for _ in range(ROUNDS if known.size else 0):
        free = max(float(weight.sum()) - 2.0 * n, 1.0)
        noise = float((weight * residual**2).sum()) / free + (1e-6 * unit) ** 2
        told = (design * weight[:, None]).T @ design / noise
        inverse = np.asarray(np.linalg.inv(told + np.eye(2 * n) / (USUAL * unit) ** 2))
        answer = np.asarray(inverse @ (design.T @ (weight * known)) / noise)
        residual = known - design @ answer
        weight = tukey(residual, every, unit)
    variance = np.diag(centred @ inverse @ centred).reshape(n, 2)
    return (centred @ answer).reshape(n, 2), np.sqrt(variance.mean(axis=1) + (GRAZING * unit) ** 2)
