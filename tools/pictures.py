"""Draw the pictures of docs/holes.md.

python tools/pictures.py
"""

from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely import LineString, Polygon, box

from midrib.figures.draw import draw_collapse

FOLDER = Path(__file__).parents[1] / "docs" / "pictures"
WIDTH = 120.0  # millimetres


def river() -> Polygon:
    """Make a river with four islands, two of them side by side."""
    x = np.linspace(0.0, 200.0, 81)
    middle = np.column_stack([x, 9.0 * np.sin(x / 32.0)])
    area = LineString(middle).buffer(15.0, cap_style="flat")
    islands = [
        ellipse(34.0, 12.5, 12.0, 3.0, 10.0),
        ellipse(80.0, -1.5, 10.0, 2.4, -28.0),
        ellipse(88.0, 7.0, 7.0, 2.0, -28.0),
        ellipse(150.0, -11.5, 14.0, 4.0, 4.0),
    ]
    return Polygon(area.exterior, [island.exterior for island in islands])


def ellipse(x: float, y: float, a: float, b: float, degrees: float) -> Polygon:
    """Make an ellipse of its half axes."""
    circle = shapely.Point(0.0, 0.0).buffer(1.0, quad_segs=8)
    turned = shapely.affinity.rotate(shapely.affinity.scale(circle, a, b), degrees, origin=(0, 0))
    return shapely.affinity.translate(turned, x, y)


def court() -> Polygon:
    """Make a court with a building in it."""
    return Polygon(box(0.0, 0.0, 40.0, 26.0).exterior, [box(9.0, 7.0, 33.0, 19.0).exterior])


def open_ring() -> Polygon:
    """Make a path around a bed that touches its outer edge in one point."""
    outer = shapely.Point(0.0, 0.0).buffer(20.0, quad_segs=16)
    inner = ellipse(0.0, -3.0, 17.0, 17.0, 0.0)
    return Polygon(outer.exterior, [inner.exterior])


PAPER: dict[str, Any] = {"centring": "none", "count": 60}
PICTURES: dict[str, tuple[Polygon, dict[str, Any]]] = {
    "holes-blocked": (river(), {}),
    "holes-auxiliary": (river(), {"holes": "auxiliary"}),
    "holes-ignored": (river(), {"holes": "ignored"}),
    "holes-wider": (river(), {"channel": "wider"}),
    "holes-paper-blocked": (river(), PAPER),
    "holes-paper-auxiliary": (river(), PAPER | {"holes": "auxiliary"}),
    "holes-paper-ignored": (river(), PAPER | {"holes": "ignored"}),
    "holes-court": (court(), {}),
    "holes-touching": (open_ring(), {}),
}


def main() -> None:
    """Draw them all."""
    FOLDER.mkdir(exist_ok=True)
    for name, (area, options) in PICTURES.items():
        draw_collapse(area, FOLDER / f"{name}.svg", width=WIDTH, **options)


if __name__ == "__main__":
    main()
