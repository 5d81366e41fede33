"""What a curve of minimal radii says about itself: where radii jump, and where there are none."""

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from midrib.errors import GeometryTypeError
from midrib.measures.chains import shaped
from midrib.strip import Strip

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["gap_share", "jumps"]


class HasRadii(Protocol):
    """A curve as these measures see it: ``midrib.Curve``."""

    strip: Strip

    @property
    def stations(self) -> "Floats":
        """(n,) arc length of each radius along the main curve."""

    @property
    def gaps(self) -> "Floats":
        """(k, 2) first and last of each run of stations without a radius."""

    @property
    def jumps(self) -> "Floats":
        """(k,) stations at which Q jumps."""


def jumps(curves: Any) -> Any:
    """Count the places at which Q jumps along the auxiliary curve.

    Each is a bay, a fold or a tie; a strip between two parallel banks has none.

    Parameters
    ----------
    curves : Curve or array_like of Curve, shape (...)
        Curves of ``midrib.minimal_radii``.

    Returns
    -------
    float or ndarray of float64, shape (...)
        Whole numbers; NaN where a curve is missing.

    Raises
    ------
    GeometryTypeError
        If something is not a Curve.

    Examples
    --------
    >>> jumps([minimal_radii(split(box(0, 0, 9, 2))), None])
    array([ 0., nan])
    """
    array = curves_of(curves)
    count = [np.nan if curve is None else float(len(curve.jumps)) for curve in array.ravel()]
    return shaped(np.array(count, dtype=np.float64), array)


def gap_share(curves: Any) -> Any:
    """Share of the main curve that sees nothing of the auxiliary curve.

    There the line is a guess, the shortest way between its neighbours: 0 is all drawn, 1 would be
    all guessed.

    Parameters
    ----------
    curves : Curve or array_like of Curve, shape (...)
        Curves of ``midrib.minimal_radii``.

    Returns
    -------
    float or ndarray of float64, shape (...)
        Between 0 and 1; NaN where a curve is missing.

    Raises
    ------
    GeometryTypeError
        If something is not a Curve.

    Notes
    -----
    Only stations are known: a gap reaches half-way from its first and last station to the
    nearest stations with a radius, or up to the end of the main curve. So the share is right to
    within the interval of the stations at every end of a gap. Stations left out on request, those
    in bays among them, are no gaps.

    Examples
    --------
    >>> gap_share(minimal_radii(split(box(0, 0, 9, 2))))
    0.0
    """
    array = curves_of(curves)
    share = [np.nan if curve is None else share_of_gaps(curve) for curve in array.ravel()]
    return shaped(np.array(share, dtype=np.float64), array)


def share_of_gaps(curve: HasRadii) -> float:
    """Share of one curve's main curve in its gaps."""
    whole = float(curve.strip.main.length)
    seen = curve.stations
    total = 0.0
    for first, last in curve.gaps:
        before, after = seen[seen < first], seen[seen > last]
        start = (before.max() + first) / 2.0 if before.size else 0.0
        end = (after.min() + last) / 2.0 if after.size else whole
        total += end - start
    return min(total / whole, 1.0)


def curves_of(curves: Any) -> NDArray[np.object_]:
    """Curves as an object array, some perhaps missing."""
    array = np.asarray(curves, dtype=object)
    for i, curve in enumerate(array.ravel()):
        is_curve = all(hasattr(curve, name) for name in ("strip", "stations", "gaps", "jumps"))
        if curve is not None and not is_curve:
            found = getattr(curve, "geom_type", type(curve).__name__)
            msg = f"curves{f'[{i}]' if array.ndim else ''} is a {found}, expected Curve"
            raise GeometryTypeError(msg)
    return array
