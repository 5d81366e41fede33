"""Partial collapse: which ponds stay areas, and which crossings do not become some.

``python benchmarks/partial.py`` sweeps ponds on a canal 2 wide, and crossings of roads 2 wide, over
the width asked for.
"""

from collections.abc import Callable, Iterable, Sequence

from shapely import Point, Polygon, affinity, box

import midrib
from tables import markdown

RATIOS = (1.2, 1.35, 1.5, 2.0, 3.0, 5.0)  # of the pond's width to the canal's
SHARES = (0.3, 0.5, 0.7, 0.8, 0.9, 0.99, 1.01)  # of the pond's width
WIDTHS = (2.02, 2.2, 2.5, 3.0, 4.0)
ANGLES = (90, 60, 45, 30, 20)
KERBS = (0.0, 1.0, 1.4, 2.0)  # radius of the rounded corners
ROAD = box(-40.0, -1.0, 40.0, 1.0)


def disc(width: float) -> Polygon:
    """Round pond."""
    return Point(0.0, 0.0).buffer(width / 2.0, quad_segs=64)


def square(width: float) -> Polygon:
    """Square pond."""
    return box(-width / 2.0, -width / 2.0, width / 2.0, width / 2.0)


def crossing(degrees: float, kerb: float) -> Polygon:
    """Two roads at an angle, their corners rounded."""
    roads = ROAD | affinity.rotate(ROAD, degrees, origin=(0, 0))
    return roads.buffer(kerb, quad_segs=32, join_style="mitre").buffer(-kerb, quad_segs=32)


def stays(area: Polygon, width: float) -> bool:
    """Whether a part stays an area."""
    return not midrib.partial_collapse(area, width).areas.is_empty


def signs(area: Polygon, widths: Iterable[float]) -> list[str]:
    """One sign for each width that is asked for; nothing where the canal is as wide."""
    return ["" if w <= 2.0 else "●" if stays(area, w) else "no" for w in widths]


def ponds(shapes: Sequence[tuple[str, Callable[[float], Polygon]]]) -> str:
    """Table of ponds: a row for each shape and ratio."""
    rows = []
    for name, shape in shapes:
        for ratio in RATIOS:
            widths = [2.0 * ratio * share for share in SHARES]
            rows.append((f"{name}, {ratio:g} x", *signs(ROAD | shape(2.0 * ratio), widths)))
    return markdown(("pond, of the canal's width", *(f"{s:g} x" for s in SHARES)), rows)


def crossings() -> str:
    """Table of crossings: a row for each angle and kerb."""
    rows = [
        (f"{degrees}°, kerb {kerb / 2.0:g}", *signs(crossing(degrees, kerb), WIDTHS))
        for degrees in ANGLES
        for kerb in KERBS
    ]
    return markdown(("crossing, kerb in widths", *(f"{w / 2.0:g} x" for w in WIDTHS)), rows)


def main() -> None:
    """Print both tables."""
    print(ponds((("round", disc), ("square", square))))
    print(crossings())


if __name__ == "__main__":
    main()
