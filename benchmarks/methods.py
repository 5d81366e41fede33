"""CPU time of skeletons and of their rivals: tables in docs/methods.md and docs/straight.md.

python benchmarks/methods.py            everything, some three minutes; tables and results are kept
python benchmarks/methods.py --quick    up to 1,000 vertices, results go to out/ only
python benchmarks/methods.py --only "triangle script"    a table of it and the medial axis, up to
                                                         1,000 vertices; nothing is written

All ways take turns in one run: compare ratios. Some rivals do less: ``pyvoronoi`` leaves arcs as
chords and finds no radii, those from points of the boundary find no exact axis, and what a rival
needs to be told (spacing) is a quarter of the area's width.
"""

import argparse
import math
from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import Any

import numpy as np
import shapely
from shapely import Polygon

from families import make
from rivals import RIVALS, Way
from speed import MISSING, TIMES, take_turns
from tables import ROOT, machine, machine_text, markdown, milliseconds, versions, write_json

COMMAND = "python benchmarks/methods.py"
RESULTS = ROOT / "benchmarks" / "results" / "methods.json"
FAMILIES = ("river", "embankment", "holes", "rect")
SIZES = (100, 1000, 10_000)
ROUNDS, BUDGET = 3, 0.5
SLOWEST = 5.0  # seconds at ten times the vertices; what may last longer is left out there
GROWTH = 1.5
COMPARED = 1000  # vertices, where the fastest rival is named
SAME = ("pyvoronoi", "CGAL straight skeleton")  # those that find what midrib finds
GRID = 2**30  # places of an area that pyvoronoi, which wants whole numbers, tells apart

Times = dict[str, float | None]


def by_skeleton(method: str) -> Callable[[Polygon, float], Any]:
    """Skeleton of midrib by one of its methods."""

    def run(area: Polygon, width: float) -> Any:  # noqa: ARG001
        import midrib

        return midrib.skeleton(area, method)

    return run


def by_pyvoronoi(area: Polygon, width: float) -> Any:  # noqa: ARG001
    """Voronoi diagram of the segments of the boundary by Boost, its edges between places inside."""
    import pyvoronoi

    low = np.array(area.bounds[:2])
    size = max(np.array(area.bounds[2:]) - low)
    diagram = pyvoronoi.Pyvoronoi(1)
    for ring in (area.exterior, *area.interiors):
        rows = np.round((shapely.get_coordinates(ring) - low) * (GRID / size)).tolist()
        for a, b in pairwise(rows):
            diagram.AddSegment([a, b])
    diagram.Construct()
    nodes = np.array([(v.X, v.Y) for v in diagram.GetVertices()]) * (size / GRID) + low
    links = np.array([(e.start, e.end) for e in diagram.GetEdges() if e.is_primary])
    links = links[(links >= 0).all(axis=1)]
    shapely.prepare(area)
    inside = shapely.contains_xy(area, nodes)
    return nodes, links[inside[links].all(axis=1)]


def by_sfcgal(call: str) -> Callable[[Polygon, float], Any]:
    """CGAL, through PySFCGAL (GPL: to measure only)."""

    def run(area: Polygon, width: float) -> Any:  # noqa: ARG001
        from pysfcgal.geometry import Geometry

        oriented = shapely.to_wkb(shapely.orient_polygons(area))
        found = getattr(Geometry.from_wkb(oriented), call)()
        if found is None:  # it prints why
            msg = f"{call} failed"
            raise ValueError(msg)
        return found

    return run


GROUPS = {
    "methods": (
        Way("medial-axis", ("midrib",), by_skeleton("medial-axis"), "exact"),
        Way("chordal-axis", ("midrib",), by_skeleton("chordal-axis"), "triangles"),
        Way("point-voronoi", ("midrib",), by_skeleton("point-voronoi"), "points"),
        Way("pyvoronoi", ("pyvoronoi",), by_pyvoronoi, "segments, Boost"),
        *RIVALS,
        Way("CGAL approximate", ("pysfcgal",), by_sfcgal("approximate_medial_axis"), "GPL"),
    ),
    "straight": (
        Way("straight-skeleton", ("midrib",), by_skeleton("straight-skeleton"), "checked"),
        Way("CGAL straight skeleton", ("pysfcgal",), by_sfcgal("straight_skeleton"), "GPL"),
    ),
}
MIDRIB = {"methods": "medial-axis", "straight": "straight-skeleton"}


def measure(ways: tuple[Way, ...], sizes: tuple[int, ...]) -> dict[str, Times]:
    """CPU seconds by family and size; None for what failed or would take too long."""
    found: dict[str, Times] = {}
    take_turns(make("holes", 100), ways, 1, BUDGET)  # kernels are compiled or loaded
    for family in FAMILIES:
        before: Times = {}
        for n in sizes:
            case = make(family, n)
            hopeful = [way for way in ways if lasts(before, way.name) <= SLOWEST]
            before = take_turns(case, hopeful, ROUNDS, BUDGET)
            found[f"{family} {n}"] = {way.name: before.get(way.name) for way in ways}
            print(family, n, {k: v and round(v * 1000.0, 2) for k, v in before.items()}, flush=True)
    return found


def lasts(before: Times, name: str) -> float:
    """Seconds that a way may last at ten times the vertices."""
    if not before:
        return 0.0
    seconds = before.get(name)
    return math.inf if seconds is None else seconds * 10.0**GROWTH


def table(found: dict[str, Times], mine: str) -> str:
    """Milliseconds of one way, and how many times as long the others take."""
    others = [name for name in next(iter(found.values())) if name != mine]
    rows = []
    for place, times in found.items():
        family, n = place.split(" ")
        own = times[mine]
        ratios = [
            ratio_text(seconds / own) if seconds and own else MISSING
            for seconds in (times[name] for name in others)
        ]
        rows.append((f"{family} {int(n):,}", milliseconds(own) if own else MISSING, *ratios))
    return markdown(("area", f"{mine} (ms)", *(f"{name} ({TIMES})" for name in others)), rows)


def fastest(found: Mapping[str, Times], ways: tuple[Way, ...], mine: str) -> str:
    """How many times as long the fastest rival takes at a size: of those for the same, of all."""
    rivals = [way.name for way in ways if "midrib" not in way.packages]
    rows = []
    for place, times in found.items():
        family, n = place.split(" ")
        own = times[mine]
        if int(n) != COMPARED or not own:
            continue
        cells = []
        for names in ([name for name in rivals if name in SAME], rivals):
            ratio, name = min((times[name] or math.inf, name) for name in names)
            cells.append(f"{ratio_text(ratio / own)} ({name})" if ratio < math.inf else MISSING)
        rows.append((f"{family} {COMPARED:,}", *cells))
    return markdown(("fastest rival", f"for the same ({TIMES})", f"of all ({TIMES})"), rows)


def ratio_text(ratio: float) -> str:
    """Write a ratio with two digits or as a whole number."""
    return f"{ratio:.2g}" if ratio < 10.0 else f"{ratio:,.0f}"


def write_table(page: str, text: str) -> None:
    """Put a table between the two marks on a page."""
    path = ROOT / "docs" / page
    start, stop = f"<!-- {COMMAND} -->\n", "<!-- end of it -->"
    head, rest = path.read_text(encoding="utf-8").split(start)
    tail = rest.split(stop)[1]
    note = f"\n`{COMMAND}`, {machine_text()}; {MISSING}: failed, or would take too long.\n"
    path.write_text(f"{head}{start}{text}{note}{stop}{tail}", encoding="utf-8")


def main() -> None:
    """Measure, keep the results and write the tables."""
    parser = argparse.ArgumentParser(description="CPU time of skeletons and of their rivals.")
    parser.add_argument("--quick", action="store_true", help="up to 1,000 vertices, docs stay")
    parser.add_argument("--only", help="rivals of the medial axis, commas between; just a table")
    given = parser.parse_args()
    if given.only:
        names = {MIDRIB["methods"], *given.only.split(", ")}
        ways = tuple(way for way in GROUPS["methods"] if way.name in names)
        print(table(measure(ways, SIZES[:2]), MIDRIB["methods"]))
        return
    quick = given.quick
    found = {name: measure(ways, SIZES[: 2 if quick else 3]) for name, ways in GROUPS.items()}
    kept = {"machine": machine(), "versions": versions(), "seconds": found}
    write_json(ROOT / "out" / "methods.json" if quick else RESULTS, kept)
    for name, times in found.items():
        mine = MIDRIB[name]
        text = f"{table(times, mine)}\n{fastest(times, GROUPS[name], mine)}"
        print(text)
        if not quick:
            write_table(f"{name}.md", text)


if __name__ == "__main__":
    main()
