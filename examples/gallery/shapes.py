"""Shapes of the gallery: areas of our own with the traits that the paper's figures have.

The paper's data are not published. Source of the traits: M. M. Buczek, Geodesy and Cartography
66(1), 2017, sections 3 to 5 and 7.
"""

from math import pi, tan

import numpy as np
import shapely
from shapely import LineString, box

from midrib import Strip
from midrib.towers import Scan, Tower, TowerAxis

__all__ = [
    "BULGE",
    "NOTCH",
    "chain",
    "chimney",
    "conveyor",
    "disjoint",
    "disturbed",
    "embankment",
    "irregular",
    "polygonal",
    "regular_embankment",
    "sample",
    "true_axis",
    "variants",
]


def chain(text: str) -> LineString:
    """Make a chain from its numbers."""
    return shapely.from_wkt(f"LINESTRING ({text})")


def disjoint() -> Strip:
    """Figure 1: two chains that do not meet."""
    return Strip(chain("0 0, 4 0.5, 8 -0.5, 12 0"), chain("-1 3, 3 4, 7 2.5, 11 3.5"))


def polygonal() -> Strip:
    """Figures 2 and 3: main and auxiliary curve are the two sides of one polygon, sharp ends."""
    return Strip(chain("0 0, 3 -1, 7 -1.5, 12 0"), chain("0 0, 2 1, 6 1.5, 9 2, 12 0"))


def sample() -> Strip:
    """Figures 4, 8 and 9: sides of different kinds, and a main curve that hides what is nearest.

    The upper part is regular. In the first bend the main curve is outside and has a chamfer that
    touches the circle around the auxiliary curve's corner; in the second one it turns back around
    a narrow slot. A polygon: the auxiliary curve has both straight ends.
    """
    width = 4.0
    touch = width * tan(pi / 8.0)
    main = [(0, 22), (0, 10 - touch), (4 - touch, 6), (14, 6), (14.4, 5.6), (14, 5.2), (5, 5.2)]
    auxiliary = [
        (0, 22), (4, 22), (4, 10), (16.5, 10), (18.5, 8), (18.5, 4.5), (16.5, 3), (11, 2.6), (5, 3),
        (5, 5.2),
    ]  # fmt: skip
    return Strip(LineString(main), LineString(auxiliary))


def variants() -> dict[str, Strip]:
    """Figure 5: one area, three main curves: too short, as long as the other, too long."""
    area = box(0, 0, 12, 2)
    return {
        "short": Strip(chain("0 0, 12 0"), chain("0 0, 0 2, 12 2, 12 0"), area),
        "even": Strip(chain("0 1, 0 0, 12 0, 12 1"), chain("0 1, 0 2, 12 2, 12 1"), area),
        "long": Strip(chain("0 2, 0 0, 12 0, 12 2"), chain("0 2, 12 2"), area),
    }


def irregular() -> Strip:
    """Figure 6: sharp ends, uneven sides that come near each other."""
    return Strip(
        chain("0 0, 1 -1, 2.5 -0.8, 3 -2, 5 -2.2, 6 -1, 8 -1.6, 9.5 -0.4, 12 0.5"),
        chain("0 0, 1.5 0.8, 3 0.4, 4 1.6, 5.5 0.2, 7 1.2, 9 1.5, 10 0.9, 12 0.5"),
    )


def disturbed() -> Strip:
    """Figure 7: a notch in the main curve and one in the auxiliary curve."""
    return Strip(chain("0 0, 3 0, 3.3 -1, 3.6 0, 12 0"), chain("0 2, 7.4 2, 7.7 3, 8 2, 12 2"))


NOTCH = box(2.99, -2.0, 3.61, 0.0)  # where the main curve of ``disturbed`` is disturbed


def embankment() -> Strip:
    """Figures 10 and 12: a slope in metres whose top turns around a corner and has a bay."""
    x = np.linspace(0.0, 26.0, 27)
    top = [*np.column_stack([x, 14.0 + 1.5 * np.sin(x / 3.0)]), (30, 12), (33, 6), (34, -2)]
    toe = [(0, 10.5), (9, 9.5), (17, 10), (24, 8.5), (28, 4.5), (29.5, -2)]
    return Strip(LineString(top), LineString(toe))


def regular_embankment() -> Strip:
    """Figure 11: straight edges, sides of lengths a = 8 and c = 4 metres."""
    return Strip(chain("0 8, 40 8"), chain("0 0, 40 4"))


def conveyor() -> Strip:
    """Figure 13: a long object of even width in metres, with a bend."""
    x = np.linspace(0.0, 30.0, 61)
    y = 3.0 * np.sin(x / 10.0)
    return Strip(LineString(np.column_stack([x, y + 2.4])), LineString(np.column_stack([x, y])))


BULGE = (55.0, 0.05)  # height in metres and depth, in metres, of the bulge of ``chimney``


def chimney() -> tuple[Scan, np.ndarray]:
    """Figures 14 and 15: a scan of a chimney 60 m high, and its points; the top is disturbed.

    A bulge on the western side, 3 m high, as where a lining came loose.
    """
    tower = Tower(60.0, 3.0, 1.6, lean=0.08, bend=0.02, form_error=0.0005)
    scan = Scan(tower, count=600_000, noise=(0.002, 0.004), ladder=40.0, seed=14)
    points = scan.points()
    height, depth = BULGE
    away = np.hypot(points[:, 0], points[:, 1])
    off = depth * np.exp(-(((points[:, 2] - height) / 1.5) ** 2)) * (points[:, 0] < 0.0)
    points[:, :2] += points[:, :2] / away[:, None] * off[:, None]
    return scan, points


def true_axis(scan: Scan, axis: TowerAxis, direction: np.ndarray) -> np.ndarray:
    """Make the true axis a chain (n, 2) in a plane of ``mode="paper"``: across it and upwards."""
    z = np.linspace(0.0, scan.tower.height, 601)
    inner = axis.cells.reference.frame.inwards(np.column_stack([scan.axis(z), z]))
    return np.column_stack([inner[:, :2] @ direction, inner[:, 2]])
