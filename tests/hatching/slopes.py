"""Slopes to hatch, from plain numbers."""

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import LineString

from midrib import Strip
from midrib.errors import MidribError

__all__ = [
    "Floats",
    "annulus",
    "bands",
    "bend",
    "elbow",
    "lens",
    "rectangle",
    "ring",
    "rings",
    "trapezium",
]

Floats = NDArray[np.float64]


def rectangle(length: float = 100.0, width: float = 10.0) -> Strip:
    """Top along y = width, from left to right."""
    return Strip(LineString([(0, width), (length, width)]), LineString([(0, 0), (length, 0)]))


def trapezium() -> Strip:
    """Twelve wide at its left end, six at its right one."""
    return Strip(LineString([(0, 12), (100, 12)]), LineString([(0, 0), (100, 6)]))


def elbow() -> Strip:
    """A corner of 90 degrees, the top on its outside."""
    return Strip(
        LineString([(0, 10), (0, 70), (60, 70)]), LineString([(10, 10), (10, 60), (60, 60)])
    )


def lens(width: float = 12.0) -> Strip:
    """Two arcs that meet at both ends."""
    x = np.linspace(0.0, 100.0, 41)
    y = width / 2.0 * np.sin(np.pi * x / 100.0)
    y[[0, -1]] = 0.0
    return Strip(LineString(np.column_stack([x, y])), LineString(np.column_stack([x, -y])))


def bend(inner: float = 20.0, outer: float = 30.0, angle: float = 2.5) -> Strip:
    """A sector of an annulus, the top on its outside."""
    turn = np.linspace(0.0, angle, 200)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    return Strip(LineString(outer * circle), LineString(inner * circle))


def ring(radius: float, n: int, turned: float = 0.0) -> LineString:
    """A closed regular polygon around the origin."""
    turn = np.append(np.arange(n), 0) * (2.0 * np.pi / n) + turned
    return LineString(radius * np.column_stack([np.cos(turn), np.sin(turn)]))


def annulus(inner: float = 10.0, outer: float = 16.0, n: int = 120) -> Strip:
    """A mound: the top is the inner circle."""
    return Strip(ring(inner, n), ring(outer, n))


@st.composite
def bands(draw: st.DrawFn) -> Strip:
    """Bent bands of changing width; the edges may meet at the ends."""
    n = draw(st.integers(4, 24))
    turns = draw(st.lists(st.integers(-5, 5), min_size=n, max_size=n))
    widths = draw(st.lists(st.integers(2, 12), min_size=n + 1, max_size=n + 1))
    step = draw(st.integers(4, 30))
    angle = np.cumsum(np.array(turns) * 0.15)
    line = np.vstack(
        [np.zeros(2), np.cumsum(step * np.column_stack([np.cos(angle), np.sin(angle)]), axis=0)]
    )
    along = np.gradient(line, axis=0)
    left = np.column_stack([-along[:, 1], along[:, 0]]) / np.hypot(*along.T)[:, None]
    half = np.array(widths)[:, None] / 2.0
    top, toe = line + half * left, line - half * left
    if draw(st.booleans()):
        top[0] = toe[0] = line[0]
    if draw(st.booleans()):
        top, toe = toe, top
    try:
        return Strip(LineString(top), LineString(toe))
    except MidribError:
        assume(False)
        raise


@st.composite
def rings(draw: st.DrawFn) -> Strip:
    """Two star-shaped rings, one around the other, the top inside or outside."""
    n = draw(st.integers(3, 16))
    inner = np.array(draw(st.lists(st.integers(6, 14), min_size=n, max_size=n)), dtype=float)
    wide = np.array(draw(st.lists(st.integers(3, 9), min_size=n, max_size=n)), dtype=float)
    turn = np.arange(n) * (2.0 * np.pi / n) + 0.1
    unit = np.column_stack([np.cos(turn), np.sin(turn)])
    curves = []
    for radius in (inner, inner + wide):
        points = radius[:, None] * unit
        curves.append(LineString(np.vstack([points, points[:1]])))
    try:
        return Strip(*(curves if draw(st.booleans()) else curves[::-1]))
    except MidribError:
        assume(False)
        raise
