"""Areas by name, the simple ones that a person would draw first."""

import numpy as np
import shapely
from shapely import LineString, Polygon

__all__ = [
    "NAMED",
    "NOT_FINITE",
    "NOT_FINITE_LINE",
    "TOUCHING",
    "VALID",
    "annulus_sector",
    "rectangle",
    "stadium",
    "wavy_ribbon",
    "wedge",
]


def rectangle(length: float, width: float) -> Polygon:
    """A rectangle with its lower left corner at the origin."""
    return Polygon([(0, 0), (length, 0), (length, width), (0, width)])


def wedge(beta: float, length: float) -> Polygon:
    """An isosceles triangle with the angle beta (radians) at the origin, one leg along x."""
    return Polygon([(0, 0), (length, 0), (length * np.cos(beta), length * np.sin(beta))])


def annulus_sector(inner: float, outer: float, angle: float, n: int) -> Polygon:
    """A bent strip between two circles about the origin, of n chords each."""
    turn = np.linspace(0.0, angle, n + 1)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    return Polygon(np.concatenate([inner * circle, outer * circle[::-1]]))


def stadium(length: float, radius: float) -> Polygon:
    """A strip with round ends."""
    return LineString([(0, 0), (length, 0)]).buffer(radius, quad_segs=32)


def wavy_ribbon(n: int, width: float) -> Polygon:
    """A ribbon along one period of a sine."""
    x = np.linspace(0.0, 2.0 * np.pi, n + 1)
    u = np.column_stack([np.ones(n + 1), np.cos(x)])
    across = np.column_stack([-u[:, 1], u[:, 0]]) / np.hypot(*u.T)[:, None] * width / 2.0
    middle = np.column_stack([x, np.sin(x)])
    return Polygon(np.concatenate([middle - across, (middle + across)[::-1]]))


NAMED: dict[str, Polygon] = {
    name: shapely.from_wkt(wkt)
    for name, wkt in {
        "triangle": "POLYGON ((0 0, 8 0, 1 3, 0 0))",
        "needle": "POLYGON ((0 0, 100 0.5, 0 1, 0 0))",
        "square": "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0))",
        "rectangle": "POLYGON ((0 0, 10 0, 10 2, 0 2, 0 0))",
        "kite": "POLYGON ((0 0, 3 -1, 12 0, 3 1, 0 0))",
        "L": "POLYGON ((0 0, 10 0, 10 2, 2 2, 2 10, 0 10, 0 0))",
        "U": "POLYGON ((0 0, 8 0, 8 9, 6 9, 6 2, 2 2, 2 9, 0 9, 0 0))",
        "T": "POLYGON ((0 0, 9 0, 9 1, 5 1, 5 6, 4 6, 4 1, 0 1, 0 0))",
        "plus": "POLYGON ((1 0, 2 0, 2 1, 3 1, 3 2, 2 2, 2 3, 1 3, 1 2, 0 2, 0 1, 1 1, 1 0))",
        "comb": (
            "POLYGON ((0 0, 9 0, 9 5, 8 5, 8 1, 7 1, 7 4, 6 4, 6 1, 5 1, 5 6, 4 6, 4 1, 3 1, "
            "3 3, 2 3, 2 1, 1 1, 1 5, 0 5, 0 0))"
        ),
        "chevron": "POLYGON ((0 0, 5 4, 10 0, 10 1, 5 5, 0 1, 0 0))",
        "hook": "POLYGON ((0 0, 6 0, 6 6, 1 6, 1 2.5, 2 2.5, 2 5, 5 5, 5 1, 0 1, 0 0))",
        "nearly_flat": "POLYGON ((0 0, 10 0, 10 0.001, 5 0.0011, 0 0.001, 0 0))",
        "collinear_vertices": "POLYGON ((0 0, 1 0, 2 0, 7 0, 10 0, 10 1, 10 2, 6 2, 0 2, 0 0))",
        "river_with_island": (
            "POLYGON ((0 0, 6 -1, 12 0, 18 1, 24 0, 24 4, 18 5.5, 12 4, 6 3, 0 4, 0 0), "
            "(9 1, 12 2.5, 15 3, 12 1.2, 9 1))"
        ),
        "three_islands": (
            "POLYGON ((0 0, 20 0, 20 4, 0 4, 0 0), (3 1, 5 1, 5 3, 3 3, 3 1), "
            "(8 0.5, 9 3.5, 10 0.5, 8 0.5), (14 1.9, 17 1.9, 17 2.1, 14 2.1, 14 1.9))"
        ),
        "ring_road": "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (1 1, 9 1, 9 9, 1 9, 1 1))",
    }.items()
}

TOUCHING: dict[str, Polygon] = {
    name: shapely.from_wkt(wkt)
    for name, wkt in {
        "hole_at_vertex": "POLYGON ((0 0, 10 0, 10 4, 0 4, 0 0), (0 0, 3 1, 3 2, 0 0))",
        "hole_on_segment": "POLYGON ((0 0, 10 0, 10 4, 0 4, 0 0), (5 0, 6 2, 4 2, 5 0))",
        "shell_on_hole": ("POLYGON ((0 0, 5 1, 10 0, 10 4, 0 4, 0 0), (3 1, 7 1, 7 2, 3 2, 3 1))"),
        "holes_at_vertices": (
            "POLYGON ((0 0, 12 0, 12 4, 0 4, 0 0), (2 1, 6 2, 2 3, 2 1), (6 2, 10 1, 10 3, 6 2))"
        ),
        "hole_on_hole": (
            "POLYGON ((0 0, 12 0, 12 6, 0 6, 0 0), (2 1, 8 1, 8 2, 2 2, 2 1), (4 2, 6 4, 3 4, 4 2))"
        ),
        "necklace": (
            "POLYGON ((0 0, 12 0, 12 4, 0 4, 0 0), (0 2, 2 1, 4 2, 2 3, 0 2), "
            "(4 2, 6 1, 8 2, 6 3, 4 2))"
        ),
        "hole_at_end_cap": "POLYGON ((0 0, 10 0, 10 2, 0 2, 0 0), (0 1, 1 0.5, 1 1.5, 0 1))",
    }.items()
}

with np.errstate(invalid="ignore"):
    NOT_FINITE = Polygon([(0, 0), (1, 0), (1, np.nan)])
    NOT_FINITE_LINE = LineString([(0, 0), (np.inf, 1)])

VALID: dict[str, Polygon] = {**NAMED, **TOUCHING}
