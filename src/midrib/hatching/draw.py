"""Drawing an object: strokes first where its symbol is made of them."""

from typing import TYPE_CHECKING, Any, NamedTuple

from midrib.hatching.along import symbols_along
from midrib.hatching.hatch import Hatching, hatch
from midrib.hatching.keys import STROKED
from midrib.hatching.symbols import symbols

if TYPE_CHECKING:
    from midrib.hatching.drawn import Symbols
    from midrib.hatching.standard import Standard
    from midrib.strip import Strip

__all__ = ["Picture", "draw"]


class Picture(NamedTuple):
    """What is drawn of an object, and the strokes behind it, if there are any."""

    symbols: "Symbols"
    hatching: Hatching | None


def draw(
    strip: "Strip",
    standard: "Standard",
    scale: float = 500.0,
    *,
    metres_per_unit: float = 1.0,
    drop: float | None = None,
    **options: Any,
) -> Picture:
    """Draw an object as a standard wants it.

    Parameters
    ----------
    strip : Strip
        The object: its main curve is the top, or the directional polyline.
    standard : Standard
        ``midrib.standard`` finds it by name.
    scale : float, default 500
        Of the map, 500 for 1:500.
    metres_per_unit : float, default 1
        Length of a coordinate unit in metres.
    drop : float, optional
        Height of the top above the toe, in coordinate units; some standards draw gentle slopes
        in another way.
    **options
        Those of ``midrib.hatch``, for strokes.

    Returns
    -------
    Picture

    Raises
    ------
    ParameterError
        If an option has a value it cannot have.
    InvalidAreaError
        If the object cannot be hatched.
    """
    known = standard.at(scale)
    if known.symbol not in STROKED:
        return Picture(symbols_along(strip, known, scale, metres_per_unit=metres_per_unit), None)
    if is_gentle(strip, known, drop):
        known = known.with_values(factor=known.gentle_factor)
    hatching = hatch(strip, known, scale, metres_per_unit=metres_per_unit, **options)
    return Picture(symbols(hatching, metres_per_unit=metres_per_unit), hatching)


def is_gentle(strip: "Strip", known: "Standard", drop: float | None) -> bool:
    """Whether a slope, on the whole, is gentler than the standard has steep ones."""
    if known.gentle_run is None or drop is None or drop <= 0.0:
        return False
    return bool(strip.area.area / strip.main.length > known.gentle_run * drop)
