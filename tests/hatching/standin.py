"""Hatchings of straight chords, built by hand."""

from typing import Any, NamedTuple

import numpy as np
import shapely
from shapely import LineString, Polygon

from midrib.types import Bools, Floats


class Sides(NamedTuple):
    """What of a strip the symbols look at."""

    main: LineString
    auxiliary: LineString
    area: Polygon


class Chords(NamedTuple):
    """What of a hatching the symbols look at."""

    strokes: Any
    is_long: Bools
    width: Floats
    on_top: Floats
    on_toe: Floats
    strip: Any
    standard: Any
    scale: float
    problems: tuple[Any, ...] = ()


def chords(
    top: LineString,
    toe: LineString,
    standard: Any,
    scale: float = 500.0,
    *,
    count: int = 9,
    spread: float = 1.0,
    area: Polygon | None = None,
    short: float = 0.5,
) -> Any:
    """Chords between equal shares of top and toe, long and short in turn; closed ones go round.

    With ``spread`` above 1 they are dense at the start.
    """
    is_ring = top.is_closed
    shares = np.linspace(0.0, 1.0, count + is_ring)[:count] ** spread
    on_top, on_toe = (
        shapely.get_coordinates(line.interpolate(shares, normalized=True)) for line in (top, toe)
    )
    is_long = np.arange(count) % 2 == 0
    ends = np.where(is_long[:, None], on_toe, on_top + short * (on_toe - on_top))
    if area is None:
        area = Polygon([*top.coords, *reversed(toe.coords)])
    return Chords(
        shapely.linestrings(np.stack([on_top, ends], axis=1)),
        is_long,
        np.hypot(*(on_toe - on_top).T),
        on_top,
        on_toe,
        Sides(top, toe, area),
        standard,
        scale,
    )


def rectangle(standard: Any, scale: float = 500.0, **options: Any) -> Any:
    """Slope of 20 by 6 units."""
    return chords(
        LineString([(0, 6), (20, 6)]), LineString([(0, 0), (20, 0)]), standard, scale, **options
    )


def mound(standard: Any, scale: float = 500.0, **options: Any) -> Any:
    """Ring between two circles, its top inside."""
    angles = np.linspace(0.0, 2.0 * np.pi, 73)
    angles[-1] = 0.0
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    top, toe = LineString(6.0 * circle), LineString(10.0 * circle)
    return chords(top, toe, standard, scale, area=Polygon(toe, [top.coords]), **options)


def bend(standard: Any, scale: float = 500.0, **options: Any) -> Any:
    """Slope round a corner, noisy along its top, tilted strokes."""
    x = np.linspace(0.0, 12.0, 61)
    noise = 0.15 * np.sin(40.0 * x)
    top = LineString([*np.column_stack([x, 8.0 + noise]), (16, 4), (16, -4)])
    toe = LineString([(1.5, 5.0), (11.0, 5.0), (13.0, 3.0), (13.0, -4.0)])
    return chords(top, toe, standard, scale, **options)
