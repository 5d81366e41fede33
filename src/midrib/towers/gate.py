"""The gate: whether sections are what the model takes them for.

band          some metres of the shell
harmonic k    amplitude of cos kθ and sin kθ in the residuals of a band; 2 is an oval, 3 and 4 lobes
scatter       how much a harmonic differs from band to band

A circle has none of the harmonics from 2 on. One that is there in all bands alike is the section's
shape; one that is there in a single band is a dent; one that is there in most bands, but never the
same, is a shape that turns with height, which no model here has. Over a part of the circle
harmonics cannot be told, for there they are made of each other: an oval looks like a circle that is
elsewhere.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.towers.records import Shape
from midrib.towers.summary import azimuth_of

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.types import Floats

__all__ = ["SEEN", "Bands", "bands_of", "lure_of_an_oval", "shape_of", "steady"]

BAND, LEAST_BANDS = 5.0, 6  # metres, number: low towers have lower bands
ORDERS = np.arange(2, 13)  # a dodecagon's is the last: more faces are round but for millimetres
SEEN = 300.0  # degrees of a band that must be seen for its harmonics to be told
WAVES = 1.35  # lengths of a harmonic that may be hidden: with more it is made of the others
CERTAIN = 3.5  # standard deviations: a harmonic that counts,
LEAST, LEAST_SHARE = 0.0015, 5e-4  # and is more than this: metres, share of the radius
DENT, LEAST_DENT = 5.0, 0.008  # standard deviations, metres: one that counts in one band
TURNING = 0.004  # metres: harmonics that change by so much in most bands are no wall's bumps
LEAST_TOLD = 3  # bands that tell a harmonic
SQUARE = 4


class Bands(NamedTuple):
    """Harmonics of bands that are seen all round."""

    band: "Floats"  # (b,) numbers of the bands
    harmonics: "Floats"  # (b, orders) complex: a - i b of a cos kθ + b sin kθ; NaN where untold
    height: float  # of a band
    noise: float  # standard deviation that a harmonic of one band has if cells are independent


def bands_of(cells: "Cells", residual: "Floats", weight: "Floats", unit: float) -> Bands:
    """Harmonics of the residuals, band by band; NaN where too little is seen."""
    rise = min(round(BAND * unit / cells.grid.level), cells.grid.n_levels // LEAST_BANDS)
    rise = max(1, rise)
    band, half = cells.level // rise, cells.grid.n_sectors // 2
    rows, numbers, noise = [], [], []
    for b in np.unique(band):
        inside = (band == b) & (weight > 0.0)
        seen = np.unique(cells.sector[inside]).size * 360.0 / cells.grid.n_sectors
        if seen < SEEN:
            continue
        highest = int(min(ORDERS[-1], WAVES * 360.0 / max(360.0 - seen, 1.0), half - 1))
        angle = cells.azimuth[inside][:, None] * np.arange(1, highest + 1)
        design = np.column_stack([np.ones(inside.sum()), np.cos(angle), np.sin(angle)])
        answer = np.linalg.lstsq(design, residual[inside], rcond=None)[0]
        row = np.full(ORDERS.size, np.nan + 0j)
        told = np.arange(ORDERS[0], highest + 1)
        row[: told.size] = answer[told] - 1j * answer[highest + told]
        rows.append(row)
        numbers.append(b)
        noise.append(np.std(residual[inside] - design @ answer) * np.sqrt(2.0 / inside.sum()))
    harmonics = np.array(rows).reshape(-1, ORDERS.size)
    return Bands(
        np.array(numbers),
        harmonics,
        rise * cells.grid.level,
        float(np.mean([*noise, 0.0][: max(1, len(noise))])),
    )


def shape_of(
    bands: Bands, faces: "Floats", radius: float, unit: float, excused: float
) -> tuple[Shape, "Floats"]:
    """Shape of the sections, and the numbers of bands that have a dent.

    Harmonics that are not above ``excused``, a length, are not the shape's.
    """
    if len(faces):
        azimuth = float(azimuth_of(faces[0, 0], faces[0, 1]))
        name = "square" if len(faces) == SQUARE else "polygon"
        return Shape(name, len(faces), azimuth, {}, ""), np.zeros(0)
    if len(bands.band) < LEAST_TOLD:
        return Shape("unknown", 0, np.nan, {}, ""), np.zeros(0)
    count = np.isfinite(bands.harmonics.real).sum(axis=0)
    told = bands.harmonics[:, count >= LEAST_TOLD]
    count, orders = count[count >= LEAST_TOLD], ORDERS[count >= LEAST_TOLD]
    middle = np.nanmedian(told.real, axis=0) + 1j * np.nanmedian(told.imag, axis=0)
    off = told - middle
    scatter = 1.4826 * np.nanmedian(np.abs(off), axis=0) / np.sqrt(2.0) + 1e-9 * unit
    sigma = 1.2533 * scatter / np.sqrt(count)  # of a median
    sigma = np.hypot(sigma, bands.noise / np.sqrt(count))
    size = np.abs(middle)
    counts = size > np.maximum(CERTAIN * sigma, max(LEAST * unit, LEAST_SHARE * radius, excused))
    found = {int(k): (float(a), float(s)) for k, a, s in zip(orders, size, sigma, strict=True)}
    dented = (np.abs(off) > np.maximum(DENT * scatter, LEAST_DENT * unit)).any(axis=1)
    lobes = [int(k) for k in orders[counts] if k > 2]
    problem = ""
    if lobes:
        worst = max(lobes, key=lambda k: found[k][0])
        amplitude = found[worst][0] / unit
        problem = f"section not circular: harmonic {worst}, {1e3 * amplitude:.1f} mm"
    azimuth = float("nan")
    name = "unknown" if lobes else "round"
    if counts[0]:
        turn = -np.angle(middle[0]) / 2.0
        azimuth = float(azimuth_of(np.cos(turn), np.sin(turn)) % 180.0)
        name = name if lobes else "oval"
    return Shape(name, 0, azimuth, found, problem), bands.band[dented]


def steady(shape: Shape, bands: Bands, unit: float, excused: float) -> Shape:
    """Shape with its problem if the sections of a round tower change with height.

    Parameters
    ----------
    shape : Shape
    bands : Bands
        Of what the fit leaves.
    unit : float
        Coordinate units in a metre.
    excused : float
        Length that harmonics may have.
    """
    if shape.faces or shape.problem or len(bands.band) < LEAST_TOLD:
        return shape
    told = np.isfinite(bands.harmonics.real).sum(axis=0) >= LEAST_TOLD
    size = np.nanmedian(np.abs(bands.harmonics[:, told]), axis=0)
    worst = int(np.argmax(size))
    if size[worst] <= max(TURNING * unit, CERTAIN * bands.noise, excused):
        return shape
    amplitude = 1e3 * float(size[worst]) / unit
    problem = f"section changes with height: harmonic {ORDERS[told][worst]}, {amplitude:.1f} mm"
    return shape._replace(name="unknown", problem=problem)


def lure_of_an_oval(azimuths: "Floats") -> "Floats":
    """How far an oval draws the centre of a circle that is fitted to a part of it.

    On an arc cos 2θ and sin 2θ are not orthogonal to 1, cos θ, sin θ: least squares takes a part of
    an oval for a motion of the centre. All round, that part is nothing.

    Parameters
    ----------
    azimuths : ndarray, shape (n,)
        Where the shell is seen, in radians, evenly.

    Returns
    -------
    ndarray, shape (2,)
        Standard deviation of x and of y for an oval of amplitude 1 in any direction: half the
        squares of what cos 2θ and sin 2θ do to it.
    """
    design = np.column_stack([np.ones(azimuths.size), np.cos(azimuths), np.sin(azimuths)])
    oval = np.column_stack([np.cos(2.0 * azimuths), np.sin(2.0 * azimuths)])
    moved = np.linalg.lstsq(design, oval, rcond=None)[0][1:]
    lure: Floats = np.sqrt((moved**2).sum(axis=1) / 2.0)
    return lure
