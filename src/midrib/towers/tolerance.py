"""Tolerances of verticality: how far a level may be from the vertical through the base.

A deviation is known within its 95 % interval. A level is *beyond* the tolerance if the whole
interval is, *within* it if the whole interval is, and *undecided* in between.

A standard's figure depends on the country, the material and the year; none is built in. What the
reader of a standard finds there goes in as text.
"""

import re
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.errors import ParameterError

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["VERDICTS", "Tolerance", "tolerance_from", "verdicts"]

TERM = re.compile(r"(?P<length>\d+\.?\d*)\s*(?P<unit>mm|cm|m)|h\s*/\s*(?P<share>\d+\.?\d*)")
VERDICTS = BEYOND, UNDECIDED, WITHIN = ("beyond", "undecided", "within")
NORMAL = 1.96  # standard deviations: 95 %
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


def verdicts(levels: Any, tolerance: Tolerance, unit: float) -> Any:
    """Verdict on each level: one of ``VERDICTS``, empty where there is no centre.

    Parameters
    ----------
    levels : structured array (n,)
        Of a ``TowerAxis``.
    tolerance : Tolerance
    unit : float
        Coordinate units in a metre.

    Returns
    -------
    ndarray of str, shape (n,)

    Notes
    -----
    The interval is 1.96 standard deviations either way: those of the level and of the base level,
    which the deviation is measured from; registration counts once. The base level is its own
    vertical, so it is never off. O(n).
    """
    found = np.full(len(levels), "", dtype="U9")
    known = np.flatnonzero(np.isfinite(levels["x"]))
    if not known.size:
        return found
    there, base = levels[known], levels[known[0]]
    half = NORMAL * np.hypot(there["sigma"], base["sigma_inner"])
    half[0] = 0.0
    allowed = tolerance.at(there["z"] - base["z"], unit)
    is_beyond = there["deviation"] - half > allowed
    is_within = there["deviation"] + half <= allowed
    found[known] = np.select([is_beyond, is_within], [BEYOND, WITHIN], UNDECIDED)
    return found
