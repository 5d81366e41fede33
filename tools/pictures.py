"""Draw the pictures of docs/holes.md, docs/straight.md and docs/towers.md.

python tools/pictures.py
"""

from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely import LineString, Polygon, box

from midrib import tower_axis
from midrib.comparison import compare
from midrib.curves.straight_skeleton import straight_skeleton_of
from midrib.figures.comparison import draw_comparison
from midrib.figures.draw import draw_collapse
from midrib.figures.paper import save
from midrib.figures.tower_pages import draw_deviation
from midrib.ragged import pack_areas
from midrib.towers.simulate import Scan, Tower
from midrib.towers.tolerance import tolerance_from
from midrib.types import Floats

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


def building() -> Polygon:
    """Make a building with a wing, a bay and a court."""
    shell = [
        (0, 0), (46, 0), (46, 14), (62, 20), (58, 34), (40, 29), (24, 29), (21, 24), (18, 29),
        (0, 29),
    ]  # fmt: skip
    return Polygon(shell, [[(9, 9), (12, 18), (30, 19), (33, 9)]])


FACE, FRONT, RIDGE = "#eef1ea", "#9aa58c", "#d62728"
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


def level(points: Floats, times: Floats, time: float) -> Floats:
    """Find the piece of the wavefront on a face, between the first and last place at a time."""
    places = []
    for i in range(len(points)):
        if (times[i - 1] > time) != (times[i] > time):
            share = (time - times[i - 1]) / (times[i] - times[i - 1])
            places.append(points[i - 1] + share * (points[i] - points[i - 1]))
    return np.array(places).reshape(-1, 2)


def draw_roof(area: Polygon, path: Path) -> None:
    """Draw the straight skeleton of an area, and its wavefront at some times, as a roof."""
    import matplotlib.pyplot as plt

    rows, starts = pack_areas(np.array([area], dtype=object)).rings(0)
    found = straight_skeleton_of(rows, starts)
    west, south, east, north = area.bounds
    size = WIDTH / 25.4, WIDTH / 25.4 * (north - south) / (east - west)
    figure, axes = plt.subplots(figsize=size, layout="constrained")
    for walk in found.faces:
        x, y = found.points[walk].T
        axes.fill(x, y, color=FACE, zorder=0)
        times = np.linspace(0.0, found.time.max(), 8)[1:-1]
        for time in times:
            axes.plot(
                *level(found.points[walk], found.time[walk], time).T, color=FRONT, linewidth=0.5
            )
    for i, j in found.ridges:
        axes.plot(*found.points[[i, j]].T, color=RIDGE, linewidth=0.9)
    for ring in (area.exterior, *area.interiors):
        axes.plot(*shapely.get_coordinates(ring).T, color="black", linewidth=1.1)
    axes.set_aspect("equal")
    axes.axis("off")
    save(figure, path)
    plt.close(figure)


def draw_tower(path: Path) -> None:
    """Draw deviations of a bent and kinked tower, with verdicts against a tolerance."""
    tower = Tower(60.0, 3.0, 1.6, lean=0.07, lean_azimuth=30.0, kink=6.0, kink_spacing=20.0, seed=2)
    clutter = {"ladder": 40.0, "platforms": (0.5,), "outliers": 0.01}
    scan = Scan(tower, count=300_000, noise=(0.002, 0.004), seed=8, **clutter)
    axis = tower_axis(scan.points(), registration=0.002)
    save(draw_deviation(axis, tolerance_from("20mm + h/1000")), path)


def main() -> None:
    """Draw them all."""
    FOLDER.mkdir(exist_ok=True)
    draw_roof(building(), FOLDER / "straight-skeleton.svg")
    draw_comparison(compare(river()), FOLDER / "methods.svg", width=2.0 * WIDTH)
    draw_tower(FOLDER / "tower.svg")
    for name, (area, options) in PICTURES.items():
        draw_collapse(area, FOLDER / f"{name}.svg", width=WIDTH, **options)


if __name__ == "__main__":
    main()
