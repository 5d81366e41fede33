"""Lengths of a degree: what makes a small piece of longitude and latitude a plane.

Source of the ellipsoid: WGS 84, semi-major axis 6378137 m, flattening 1 / 298.257223563.
"""

import numpy as np

from midrib.errors import InvalidAreaError
from midrib.layout import Scale
from midrib.types import Bools, Floats

__all__ = ["degree_lengths", "is_beyond_pole", "lengths_at"]

SEMI_MAJOR = 6378137.0
FLATTENING = 1.0 / 298.257223563
SQUARED_ECCENTRICITY = FLATTENING * (2.0 - FLATTENING)
POLE = 90.0


def degree_lengths(bounds: Floats) -> Scale:
    """Metres in a degree of longitude and in one of latitude, at the middle latitude of bounds.

    Raises
    ------
    InvalidAreaError
        If the bounds (x low, y low, x high, y high) reach beyond a pole.
    """
    low, high = float(bounds[1]), float(bounds[3])
    if low < -POLE or high > POLE:
        msg = (
            f"latitude {low if low < -POLE else high:g} is beyond a pole, expected degrees "
            "(a planar CRS, perhaps?)"
        )
        raise InvalidAreaError(msg)
    across, along = lengths_at(np.array((low + high) / 2.0))
    return float(across), float(along)


def is_beyond_pole(bounds: Floats) -> Bools:
    """Whether bounds (rows of x low, y low, x high, y high) reach beyond a pole."""
    beyond: Bools = (bounds[:, 1] < -POLE) | (bounds[:, 3] > POLE)
    return beyond


def lengths_at(latitude: Floats) -> tuple[Floats, Floats]:
    """Metres in a degree of longitude and in one of latitude, at latitudes in degrees."""
    angle = np.radians(latitude)
    squeeze = 1.0 - SQUARED_ECCENTRICITY * np.sin(angle) ** 2
    across = SEMI_MAJOR / np.sqrt(squeeze)  # radius of curvature, east-west
    along = SEMI_MAJOR * (1.0 - SQUARED_ECCENTRICITY) / squeeze**1.5  # north-south
    degree = np.pi / 180.0
    return degree * across * np.cos(angle), degree * along
