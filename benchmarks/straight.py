"""Straight skeletons: how long they take, and on how many real areas they are sound.

``python benchmarks/straight.py speed`` prints times, ``areas`` what becomes of real layers, and
``hard`` what becomes of areas on squared paper, where most things happen at once, and of grids of
streets as a file has them, where things happen nearly at once.
"""

import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import affinity

from families import make
from midrib.curves.straight_skeleton import straight_skeleton_of
from midrib.errors import MidribError
from midrib.ragged import pack_areas
from real_areas import FOLDER, LAYERS
from tables import machine_text, markdown, milliseconds

SIZES = (100, 1_000, 10_000)
SHOWN = ("river", "embankment", "waist", "holes", "rect")
MOST_VERTICES = 5_000
ENOUGH = 0.3  # seconds of runs, of which the shortest counts
MOST_RUNS = 50
ROUNDS = 500
STREETS = (3, 4, 6)  # each way
DECIMALS = (2, 3, 5, 7)
DEGREES = np.arange(1, 90) + 0.37
PLACES = (
    ("as it is", 0.0, (0.0, 0.0)),
    ("turned by 30°", 30.0, (0.0, 0.0)),
    ("turned by 33.7°, at coordinates of 6e6", 33.7, (5e5, 5.8e6)),
)


def shortest(run: Callable[[], Any]) -> float:
    """CPU time of the shortest of several runs, in seconds; the first one warms up."""
    run()
    times: list[float] = []
    while sum(times) < ENOUGH and len(times) < MOST_RUNS:
        start = time.process_time()
        run()
        times.append(time.process_time() - start)
    return min(times)


def skeleton_of(area: shapely.Polygon) -> Any:
    """Find and check the straight skeleton of an area."""
    return straight_skeleton_of(*pack_areas(np.array([area], dtype=object)).rings(0))


def speed() -> str:
    """Measure CPU time by family and size, and how many mitred buffers that is in the same run."""
    rows = []
    for family in SHOWN:
        cells = []
        for n in SIZES:
            area = make(family, n).area
            step = -0.01 * make(family, n).width
            taken = shortest(lambda area=area: skeleton_of(area))  # type: ignore[misc]
            buffer = shortest(
                lambda area=area, step=step: area.buffer(step, join_style="mitre")  # type: ignore[misc]
            )
            cells += [milliseconds(taken), f"{taken / buffer:.1f}"]
        rows.append((family, *cells))
    head = ["family"]
    for n in SIZES:
        head += [f"{n:,} (ms)", "buffers"]
    return markdown(head, rows)


def valid_areas(path: Path, layer: str | None) -> NDArray[np.object_]:
    """Read the valid Polygons of a layer that are not too large."""
    import geopandas as gpd

    frame = gpd.read_parquet(path) if layer is None else gpd.read_file(path, layer=layer)
    parts = shapely.force_2d(shapely.get_parts(frame.geometry.to_numpy()))
    parts = parts[(shapely.get_type_id(parts) == 3) & shapely.is_valid(parts)]
    found: NDArray[np.object_] = parts[shapely.get_num_coordinates(parts) <= MOST_VERTICES]
    return found


def failures_in(parts: NDArray[np.object_]) -> Counter[str]:
    """Errors of the areas that have no sound skeleton."""
    failures: Counter[str] = Counter()
    for area in parts:
        try:
            skeleton_of(area)
        except MidribError as error:
            failures[type(error).__name__] += 1
    return failures


def areas() -> str:
    """Count the valid areas of each real layer, long or not, and those without a sound skeleton."""
    rows = []
    for name, file, layer in LAYERS:
        if not (FOLDER / file).exists():
            continue
        parts = valid_areas(FOLDER / file, layer)
        start = time.process_time()
        failures = failures_in(parts)
        taken = time.process_time() - start
        vertices = int(shapely.get_num_coordinates(parts).sum())
        reasons = ", ".join(f"{count} {reason}" for reason, count in failures.items()) or "0"
        each = f"{taken / max(vertices, 1) * 1e6:.1f}"
        rows.append((name, f"{len(parts):,}", f"{vertices:,}", reasons, each))
    return markdown(("layer", "areas", "vertices", "failures", "µs a vertex"), rows)


def on_squared_paper(rng: np.random.Generator) -> NDArray[np.object_]:
    """Unite squares, halves of squares, or triangles with whole coordinates."""
    n, share = int(rng.integers(2, 9)), rng.uniform(0.4, 0.95)
    cells = [shapely.box(i, j, i + 1, j + 1) for i in range(n) for j in range(n)]
    halves = [
        shapely.Polygon([(i, j), (i + 1, j + 1), (i + k, j + 1 - k)])
        for i in range(n)
        for j in range(n)
        for k in (0, 1)
    ]
    triangles = shapely.polygons(rng.integers(0, 12, (n, 3, 2)).astype(np.float64))
    united = [
        shapely.union_all([cell for cell in cells if rng.random() < share]),
        shapely.union_all([half for half in halves if rng.random() < share]),
        shapely.union_all(triangles[shapely.area(triangles) > 0.0]),
    ]
    parts = shapely.get_parts(united)
    found: NDArray[np.object_] = parts[(shapely.get_type_id(parts) == 3) & shapely.is_valid(parts)]
    return found


def streets(n: int, degrees: float, decimals: int) -> shapely.Polygon:
    """Grid of n by n streets, 12 m wide and every 50 m, at map coordinates, rounded."""
    middles = 50.0 * np.arange(n)
    blocks = [shapely.box(x + 6, y + 6, x + 44, y + 44) for x in middles[1:] for y in middles[1:]]
    town = shapely.box(44, 44, middles[-1] + 56, middles[-1] + 56)
    area = town.difference(shapely.union_all(blocks))
    turned = affinity.rotate(affinity.translate(area, 650_000, 480_000), degrees)
    return shapely.transform(turned, lambda points: np.round(points, decimals))


def hard() -> str:
    """Count failures where edges are parallel or nearly so, reflex vertices meet, and at once."""
    rng = np.random.default_rng(0)
    drawn = np.concatenate([on_squared_paper(rng) for _ in range(ROUNDS)])
    rows = []
    for name, degrees, origin in PLACES:
        parts = np.array(
            [
                affinity.translate(affinity.rotate(area, degrees, origin=(0, 0)), *origin)
                for area in drawn
            ]
        )
        parts = parts[shapely.is_valid(parts)]
        rows.append((name, f"{len(parts):,}", str(failures_in(parts).total())))
    for n in STREETS:
        for decimals in DECIMALS:
            grids = np.array([streets(n, degrees, decimals) for degrees in DEGREES])
            name = f"{n} by {n} streets, {decimals} decimals"
            rows.append((name, f"{len(grids):,}", str(failures_in(grids).total())))
    return markdown(("squared paper, and streets", "areas", "failures"), rows)


def main() -> None:
    """Print a table."""
    tables = {"speed": speed, "areas": areas, "hard": hard}
    if len(sys.argv) != 2 or sys.argv[1] not in tables:
        sys.exit(f"usage: {sys.argv[0]} {'|'.join(tables)}")
    print(tables[sys.argv[1]]())
    print(machine_text())


if __name__ == "__main__":
    main()
