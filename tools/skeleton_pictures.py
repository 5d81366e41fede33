"""Draw the pictures of docs/networks.md and docs/labels.md, and of kinks in docs/methods.md.

python tools/skeleton_pictures.py
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from shapely import LineString, Point, Polygon, box

from midrib import collapse, control_points, label_line, network, partial_collapse, skeleton, split
from midrib.curves.kinks import kink_pairs
from midrib.figures.paper import save
from midrib.types import Floats

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FOLDER = Path(__file__).parents[1] / "docs" / "pictures"
WIDTH = 200.0 / 25.4  # inches
FILL, OUTLINE, BRANCH, LINE, NODE = "#eef1ea", "#b9c0b0", "#8e44ad", "#000000", "#1e9e58"
WATER = "#9ecae1"


def road(*points: tuple[float, float], width: float = 4.0) -> Polygon:
    """Make a road along a chain, with flat ends."""
    return LineString(points).buffer(width / 2.0, cap_style="flat", join_style="mitre")


def town() -> Polygon:
    """Make streets: crossings at several angles, a staggered one, a roundabout, rounded corners."""
    streets = [
        road((0, 12), (150, 12), width=6),
        road((0, 45), (62, 45)),
        road((15, 0), (15, 78), width=5),
        road((40, 12), (66, 70)),
        road((58, 0), (58, 12), width=5),
        road((60.5, 12), (84, 47)),
        road((98, 0), (98, 40)),
        road((119, 14), (149, 34)),
        road((98, 56), (98, 78), width=5),
        road((106, 48), (150, 48)),
        road((15, 66), (66, 70), (90, 48)),
    ]
    ring = Point(98, 48).buffer(9, quad_segs=16).difference(Point(98, 48).buffer(5, quad_segs=16))
    sharp = shapely.union_all([*streets, ring])
    rounded = sharp.buffer(1.2).buffer(-1.2, join_style="mitre")
    return shapely.union_all([sharp, rounded.intersection(box(-9, 1, 149, 77))])


def fill(axes: "Axes", area: Any, face: str = FILL) -> None:
    """Fill an area, holes left out."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    for part in shapely.get_parts(area):
        rings = [shapely.get_coordinates(ring) for ring in (part.exterior, *part.interiors)]
        path = Outline.make_compound_path(*(Outline(ring, closed=True) for ring in rings))
        axes.add_patch(PathPatch(path, facecolor=face, edgecolor=OUTLINE, linewidth=0.5))


def stroke(axes: "Axes", lines: Any, colour: str, width: float) -> None:
    """Draw lines."""
    for line in shapely.get_parts(lines):
        axes.plot(*shapely.get_coordinates(line).T, color=colour, linewidth=width)


def dots(axes: "Axes", points: Floats, colour: str = NODE, size: float = 12.0) -> None:
    """Draw dots."""
    axes.scatter(*points.T, color=colour, s=size, linewidth=0, zorder=3)


def sheet(area: Any, rows: int, columns: int) -> "tuple[Any, list[Axes]]":
    """Open a sheet with panels that show an area."""
    import matplotlib.pyplot as plt

    west, south, east, north = shapely.total_bounds(area)
    height = WIDTH / columns * (north - south) / (east - west) * rows
    figure, panels = plt.subplots(
        rows, columns, figsize=(WIDTH, height), layout="constrained", squeeze=False
    )
    for axes in panels.ravel():
        axes.set_aspect("equal")
        axes.axis("off")
    return figure, list(panels.ravel())


def finish(figure: Any, path: Path) -> None:
    """Write a sheet."""
    import matplotlib.pyplot as plt

    save(figure, path)
    plt.close(figure)


def draw_network(path: Path) -> None:
    """Draw the skeleton of streets, and their network."""
    area = town()
    figure, (left, right) = sheet(area, 1, 2)
    for axes in (left, right):
        fill(axes, area)
    stroke(left, skeleton(area, min_significance=3.0).lines, BRANCH, 0.9)
    found = network(area)
    stroke(right, found, LINE, 0.9)
    ends = np.array([line.coords[k] for line in found.geoms for k in (0, -1)])
    places, ways = np.unique(ends, axis=0, return_counts=True)
    dots(right, places[ways > 2])
    finish(figure, path)


def river() -> Polygon:
    """Make a river that widens into two lakes, with an arm, an island and a mouth."""
    x = np.linspace(0.0, 150.0, 301)
    middle = np.column_stack([x, 9.0 * np.sin(x / 17.0) + 3.0 * np.sin(x / 5.0)])
    radius = 1.6 + 7.0 * np.exp(-(((x - 38.0) / 11.0) ** 2)) + 5.0 * np.exp(-(((x - 96) / 9) ** 2))
    radius += 0.05 * np.clip(x - 120.0, 0.0, None) + 0.3 * np.sin(x / 2.3)
    discs = [Point(p).buffer(r) for p, r in zip(middle, radius, strict=True)]
    arm = np.column_stack([np.linspace(92.0, 122.0, 80), np.linspace(-6.0, -22.0, 80)])
    arm[:, 1] += 2.0 * np.sin(arm[:, 0] / 3.0)
    discs += [Point(p).buffer(1.1 + 0.01 * k) for k, p in enumerate(arm[::-1])]
    area = shapely.union_all(discs).simplify(0.05)
    island = shapely.affinity.scale(Point(34.0, 9.0).buffer(1.6), 2.0, 1.0)
    return area.difference(island.simplify(0.05))


def draw_partial(path: Path) -> None:
    """Draw a river, what is left of it at two widths, and lines of the rest."""
    area = river()
    figure, panels = sheet(area, 3, 1)
    for axes, width in zip(panels, (3.0, 6.0, 12.0), strict=True):
        found = partial_collapse(area, width)
        fill(axes, area, "white")
        if not found.areas.is_empty:
            fill(axes, found.areas, WATER)
        stroke(axes, found.lines, LINE, 0.9)
        west, south = area.bounds[:2]
        axes.plot([west, west + width], [south, south], color=NODE, linewidth=2.5)
    finish(figure, path)


def wall() -> Polygon:
    """Make a wall that turns in corners, with a buttress that only one side has."""
    middle = [(0, 0), (34, 0), (40, 20), (76, 20), (76, -4), (58, -4)]
    return road(*middle, width=5.0).union(box(52, 22, 58, 25))


def draw_kinks(path: Path) -> None:
    """Draw the mean curves of a wall: in proportion, and from pair to pair of kinks."""
    area = wall()
    strip = split(area)
    figure, (left, right) = sheet(area, 1, 2)
    for axes in (left, right):
        fill(axes, area)
    stroke(left, collapse(area, "mean-curve"), LINE, 0.9)
    pairs = zip(*kink_pairs(strip.layout), strict=True)
    for at, beside in pairs:
        ends = strip.main.interpolate(at), strip.auxiliary.interpolate(beside)
        stroke(right, LineString(ends), BRANCH, 0.6)
        dots(right, np.array([end.coords[0] for end in ends]), BRANCH, 8.0)
    stroke(right, collapse(area, "mean-curve", mean="kinks"), LINE, 0.9)
    finish(figure, path)


def lake() -> Polygon:
    """Make a lake in a bent valley, widest in the bend."""
    turn = np.linspace(0.78 * np.pi, 0.22 * np.pi, 121)
    middle = np.column_stack([75.0 + 95.0 * np.cos(turn), 70.0 * np.sin(turn) - 62.0])
    share = np.linspace(0.0, 1.0, 121)
    radius = 1.5 + 8.0 * np.sin(np.pi * share) + 0.7 * np.sin(23.0 * share)
    discs = [Point(p).buffer(r) for p, r in zip(middle, radius, strict=True)]
    return shapely.union_all(discs).simplify(0.05)


def draw_labels(path: Path) -> None:
    """Draw the name of a lake along its label line, and control points of a river's line."""
    water, area = lake(), river()
    figure, (upper, lower) = sheet(area, 2, 1)
    label = label_line(water, length=100.0)
    fill(upper, water, WATER)
    fill(lower, area, WATER)
    fill(upper, label.lines.buffer(label.heights / 2.0, cap_style="flat"), "#fdd0a2")
    stroke(upper, label.lines, LINE, 0.9)
    line = collapse(area)
    stroke(lower, line, OUTLINE, 2.5)
    found = control_points(line, count=12, area=area)
    stroke(lower, found.line, LINE, 0.9)
    dots(lower, found.points)
    finish(figure, path)


def main() -> None:
    """Draw them all."""
    FOLDER.mkdir(exist_ok=True)
    draw_network(FOLDER / "network.svg")
    draw_partial(FOLDER / "partial.svg")
    draw_kinks(FOLDER / "kinks.svg")
    draw_labels(FOLDER / "labels.svg")


if __name__ == "__main__":
    main()
