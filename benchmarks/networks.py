"""Networks: how straight roads go on past others that join them, and what that costs.

``python benchmarks/networks.py joins`` prints how far constructed roads bend, ``layers`` how far
real ones dip at their junctions, and how long that took in medial axes of the same areas.
"""

import itertools
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import geopandas as gpd
import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, MultiLineString, Point, Polygon, affinity, box

import midrib
from midrib.types import Floats
from real_areas import FOLDER
from tables import machine_text, markdown

ANGLES = (10, 15, 20, 25, 30, 35, 45, 60, 75, 90)
SHAPES = ((0.5, 0.0), (1.0, 0.0), (1.75, 0.0), (1.0, 0.5), (1.0, 1.0))  # of the road's width
TURNED = 10.0  # degrees, so that nothing is along an axis of coordinates
OSM = ("osm_at_krems", "osm_de_heidelberg", "osm_fi_helsinki")
PLACES = ("montlake_roundabout", "tempe_split", "quad_intersection", "seattle_slip_lane")
ROADS = "rijbaan|fietspad|inrit"
GAP = 0.1  # metres between pieces of one road
NEAR, BEYOND = 3.0, 6.0  # half-widths from a junction between which a road must be straight
STRAIGHT = 10.0  # degrees
JUNCTION = 3  # ways of one


def join(degrees: float, width: float, kerb: float) -> tuple[Polygon, LineString, LineString]:
    """Make a road 2 wide with one that joins it, rounded corners, and their middles."""
    turn = np.radians(degrees)
    length = 30.0 + 12.0 * max(width, 2.0) / np.sin(turn)
    through = LineString([(-length, 0.0), (length, 0.0)])
    branch = LineString([(0.0, 0.0), (length * np.cos(turn), length * np.sin(turn))])
    above = branch.buffer(width / 2.0, cap_style="flat") & box(-length, -1.0, 2 * length, length)
    area = box(-length, -1.0, length, 1.0) | above
    if kerb > 0.0:
        area = area.buffer(kerb, join_style="mitre").buffer(-kerb, quad_segs=32)
    return area, through, branch


def bends(degrees: float, width: float, kerb: float) -> tuple[float, float]:
    """How far the through road and the branch are from their middles at most, in half-widths."""
    area, through, branch = join(degrees, width, kerb)
    turned = midrib.network(affinity.rotate(area, TURNED, origin=(0, 0)))
    lines = shapely.get_parts(affinity.rotate(turned, -TURNED, origin=(0, 0)).segmentize(0.1))
    is_branch = shapely.bounds(lines)[:, 3] > 0.4 * branch.bounds[3]
    return farthest(lines[~is_branch], through), farthest(lines[is_branch], branch) * 2.0 / width


def farthest(lines: NDArray[np.object_], middle: LineString) -> float:
    """Greatest distance of vertices from a line."""
    vertices = shapely.points(shapely.get_coordinates(lines))
    return float(shapely.distance(vertices, middle).max(initial=0.0))


def joins() -> str:
    """Table of roads that join: a row for each width and kerb, through road and branch."""
    rows = []
    for width, kerb in SHAPES:
        found = [bends(degrees, 2.0 * width, 2.0 * kerb) for degrees in ANGLES]
        for name, column in zip(("road", "branch"), zip(*found, strict=True), strict=True):
            cells = (f"{value:.2f}" for value in column)
            rows.append((f"{name}; branch {width:g}, kerb {kerb:g} widths", *cells))
    return markdown(("off its middle, half-widths", *(f"{d}°" for d in ANGLES)), rows)


def dissolved(frame: gpd.GeoDataFrame) -> NDArray[np.object_]:
    """Areas that pieces cover together, where narrow gaps are closed."""
    shapes = frame.geometry.to_numpy()
    grown = shapely.buffer(shapes[shapely.is_valid(shapes)], GAP, join_style="mitre")
    united = shapely.buffer(shapely.union_all(grown), -GAP, join_style="mitre")
    parts: NDArray[np.object_] = shapely.get_parts(united)
    return parts


def layers_of() -> Iterator[tuple[str, NDArray[np.object_]]]:
    """Names and areas of real layers, in metres."""
    for name in OSM:
        frame = gpd.read_file(FOLDER / f"{name}.gpkg", layer="areas")
        frame = frame.to_crs(frame.estimate_utm_crs())
        parts = shapely.force_2d(shapely.get_parts(frame.geometry.to_numpy()))
        yield name, parts[shapely.is_valid(parts)]
    frame = gpd.read_file(FOLDER / "nl_bgt_gooi.gpkg", layer="vlak")
    yield "nl_bgt_gooi, roads", dissolved(frame[frame.function.str.match(ROADS, na=False)])
    frame = gpd.read_parquet(FOLDER / "osm2streets_road_polygons.parquet")
    for place in PLACES:
        of_place = frame[frame.place == place]
        yield place, dissolved(of_place.to_crs(of_place.estimate_utm_crs()))


def straight_roads(lines: MultiLineString, area: Polygon) -> list[tuple[LineString, float]]:
    """Chords of roads that go straight on past one that joins, and half their widths there."""
    arms: dict[tuple[float, float], list[LineString]] = {}
    for line in lines.geoms:
        for way in (line, line.reverse()):
            arms.setdefault(way.coords[0][:2], []).append(way)
    found = []
    for place, ways in arms.items():
        half = area.boundary.distance(Point(place))
        if len(ways) != JUNCTION or min(way.length for way in ways) < BEYOND * half:
            continue
        places = (NEAR * half, BEYOND * half)
        near, far = (np.array([way.interpolate(at).coords[0] for way in ways]) for at in places)
        for one, other in itertools.combinations(range(JUNCTION), 2):
            chord = near[other] - near[one]
            steps = (near[one] - far[one], chord, far[other] - near[other])
            if all(angle(a, b) < STRAIGHT for a, b in itertools.combinations(steps, 2)):
                found.append((LineString([near[one], near[other]]), half))
    return found


def angle(a: Floats, b: Floats) -> float:
    """Degrees between two directions."""
    return float(np.degrees(np.abs(np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b))))


def dips(roads: Sequence[tuple[LineString, float]], lines: MultiLineString) -> list[float]:
    """How far lines are from chords of roads at most, in half-widths."""
    return [
        max(lines.distance(Point(p)) for p in chord.segmentize(half / 8.0).coords) / half
        for chord, half in roads
    ]


def timed(run: Callable[[Polygon], Any], areas: NDArray[np.object_]) -> tuple[float, list[Any]]:
    """CPU seconds of the faster of two runs over areas, and what came of it."""
    times = []
    for _ in range(2):
        start = time.process_time()
        found = [run(area) for area in areas]
        times.append(time.process_time() - start)
    return min(times), found


def layers() -> str:
    """Table of real layers: how far through roads dip, in the skeleton and in the network."""
    rows = []
    for name, areas in layers_of():
        axis, skeletons = timed(midrib.skeleton, areas)
        taken, networks = timed(midrib.network, areas)
        roads = [straight_roads(n, area) for n, area in zip(networks, areas, strict=True)]
        before = np.concatenate([dips(r, s.lines) for r, s in zip(roads, skeletons, strict=True)])
        after = np.concatenate([dips(r, n) for r, n in zip(roads, networks, strict=True)])
        vertices = int(shapely.get_num_coordinates(areas).sum())
        cells = [""] * 4
        if len(after):
            cells = [f"{np.percentile(d, p):.2f}" for p in (50, 90) for d in (before, after)]
        rows.append((name, f"{vertices:,}", str(len(after)), *cells, f"{taken / axis:.1f}"))
    head = (
        "layer",
        "vertices",
        "roads",
        "median, skeleton",
        "network",
        "90 %, skeleton",
        "network",
    )
    return markdown((*head, "time, medial axes"), rows)


def main() -> None:
    """Print a table."""
    tables = {"joins": joins, "layers": layers}
    if len(sys.argv) != 2 or sys.argv[1] not in tables:
        sys.exit(f"usage: {sys.argv[0]} {'|'.join(tables)}")
    print(tables[sys.argv[1]]())
    print(machine_text())


if __name__ == "__main__":
    main()
