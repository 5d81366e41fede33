"""Tolerances of verticality: how far a level may be from the vertical through the base.

A standard's figure depends on the country, the material and the year; none is built in. What the
reader of a standard finds there goes in as text.
"""

import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.errors import ParameterError

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Tolerance", "tolerance_from"]

TERM = re.compile(r"(?P<length>\d+\.?\d*)\s*(?P<unit>mm|cm|m)|h\s*/\s*(?P<share>\d+\.?\d*)")
METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}


class Tolerance(NamedTuple):
    """A length and a share of the height above the base."""

    text: str
    metres: float
    share: float

    def at(self, height: "Floats", unit: float) -> "Floats":
        """Tolerance in coordinate units at heights above the base."""
        allowed: Floats = self.metres * unit + self.share * np.maximum(height, 0.0)
        return allowed


def tolerance_from(text: str) -> Tolerance:
    """Tolerance from a text: a length, h/N (h: height above the base), or the sum of both.

    Raises
    ------
    ParameterError
        If the text is none of these.

    Examples
    --------
    >>> tolerance_from("20mm + h/1000").at(np.array([0.0, 50.0]), 1.0)
    array([0.02, 0.07])
    """
    metres, share = 0.0, 0.0
    for part in text.split("+"):
        match = TERM.fullmatch(part.strip())
        if match is None or (match["share"] and float(match["share"]) == 0.0):
            msg = f"--tolerance is {text!r}, expected a length (50mm), h/1000, or a sum of both"
            raise ParameterError(msg)
        if match["share"]:
            share += 1.0 / float(match["share"])
        else:
            metres += float(match["length"]) * METRES[match["unit"]]
    return Tolerance(text, metres, share)
