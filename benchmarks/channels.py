"""How long lines past islands are by `channel`, against the shortest way: docs/holes.md.

python benchmarks/channels.py    a minute; needs the folder of real layers
"""

from collections.abc import Iterator

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import Point, box

import midrib
from real_areas import layers
from tables import markdown

LAYER = "rivers and lakes, simplified"  # most have islands
MOST_VERTICES = 3000
ISLANDS, STAGGER = 16, 1.0  # islands of 24 m, each 1 m off the middle of a channel of 60 m
HEAD = (
    "areas with islands",
    "number",
    "shorter / wider: above 1.02",
    "most",
    "shorter / trunk: above 1.1",
    "most",
    "wider / trunk: above 1.1",
    "most",
)


def families() -> Iterator[tuple[str, NDArray[np.object_]]]:
    """Name and areas of each row."""
    discs = [Point(60 * i + 30, 30 + (-1) ** i * STAGGER).buffer(12) for i in range(ISLANDS)]
    channel = box(0, 0, 60 * ISLANDS, 60).difference(shapely.union_all(discs))
    yield "16 islands, staggered", np.array([channel], dtype=object)
    for name, areas in layers():
        has_islands = shapely.get_num_interior_rings(areas) > 0
        if name == LAYER:
            yield name, areas[has_islands & (shapely.get_num_coordinates(areas) < MOST_VERTICES)]


def row(name: str, areas: NDArray[np.object_]) -> list[str]:
    """Cells of a row."""
    shorter = shapely.length(midrib.collapse(areas))
    wider = shapely.length(midrib.collapse(areas, channel="wider"))
    trunk = shapely.length(midrib.collapse(areas, "medial-axis"))
    cells = [name, f"{areas.size:,}"]
    for over, bound in ((shorter / wider, 1.02), (shorter / trunk, 1.1), (wider / trunk, 1.1)):
        cells += [f"{(over > bound).sum():,}", f"{over.max():.2f}"]
    return cells


if __name__ == "__main__":
    print(markdown(HEAD, [row(name, areas) for name, areas in families()]), end="")
