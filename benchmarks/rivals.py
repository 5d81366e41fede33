"""Other ways to a centre line, and yardsticks, under one signature.

Every entry is called with an area and its average width, so that those that need a density in
coordinate units get a sensible one. Packages are imported by the entry that needs them.
"""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from shapely import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from families import Case, Floats

__all__ = [
    "MIDRIB",
    "RIVALS",
    "VARIANTS",
    "YARDSTICKS",
    "Way",
    "available",
    "line_by",
    "longest_path",
    "variant",
]


@dataclass(frozen=True)
class Way:
    """Something to do with an area: its name in tables, the packages it needs, how to run it."""

    name: str
    packages: tuple[str, ...]
    run: Callable[[Polygon, float], Any]
    about: str


def line_by(way: Way, case: Case) -> tuple[BaseGeometry | None, str | None]:
    """Line of an area that nobody has prepared before, or None and the kind of error."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # whatever rivals warn of, their lines are measured
        try:
            return way.run(shapely.from_wkb(shapely.to_wkb(case.area)), case.width), None
        except Exception as failure:  # rivals raise what they like
            return None, type(failure).__name__


def variant(name: str, **options: Any) -> Way:
    """Midrib with options."""

    def run(area: Polygon, width: float) -> Any:  # noqa: ARG001
        import midrib

        return midrib.collapse(area, **options)

    written = ", ".join(["area", *(f"{key}={value!r}" for key, value in options.items())])
    return Way(name, ("midrib",), run, f"`midrib.collapse({written})`")


def available(variants: Sequence[Way]) -> tuple[list[Way], list[str]]:
    """Those of midrib's variants whose options it has, and a note for each of the others."""
    from midrib.errors import ParameterError

    ways, notes = [], []
    for way in variants:
        try:
            way.run(shapely.box(0, 0, 9, 2), 2.0)
        except ParameterError as error:
            notes.append(f"{way.name} ({way.about}) is left out: {error}.")
        else:
            ways.append(way)
    return ways, notes


def by_midrib(area: Polygon, width: float) -> Any:  # noqa: ARG001  # it finds the width itself
    """Midrib as it comes, without options."""
    import midrib

    return midrib.collapse(area)


def by_pygeoops_tuned(area: Polygon, width: float) -> Any:
    """PyGeoOps with the settings that score best."""
    import pygeoops

    return pygeoops.centerline(
        area,
        densify_distance=width / 2,
        min_branch_length=3 * width,
        simplifytolerance=-0.02,
        extend=True,
    )


def by_pygeoops(area: Polygon, width: float) -> Any:  # noqa: ARG001
    """PyGeoOps as it comes."""
    import pygeoops

    return pygeoops.centerline(area)


def by_centerline(area: Polygon, width: float) -> Any:
    """Package centerline with points every quarter of a width."""
    from centerline.geometry import Centerline

    return Centerline(area, interpolation_distance=width / 4).geometry


def by_voronoi(area: Polygon, width: float) -> LineString:
    """Home-made: Voronoi diagram of points on the boundary, longest path of what is inside."""
    from scipy.spatial import Voronoi

    dense = shapely.segmentize(area, width / 4)
    rings = [np.asarray(ring.coords)[:-1] for ring in (dense.exterior, *dense.interiors)]
    points = np.concatenate(rings)
    origin = points.mean(axis=0)
    diagram = Voronoi(points - origin)
    nodes = diagram.vertices + origin
    shapely.prepare(area)
    inside = shapely.contains_xy(area, nodes)
    links = np.asarray(diagram.ridge_vertices)
    links = links[(links >= 0).all(axis=1) & inside[links].all(axis=1)]
    return longest_path(nodes, links)


def by_triangles(area: Polygon, width: float) -> LineString:  # noqa: ARG001
    """Home-made: middles of the triangles' inner sides, longest path. The fastest way we know."""
    import pythoncdt as cdt

    mesh = cdt.Triangulation(
        cdt.VertexInsertionOrder.AUTO, cdt.IntersectingConstraintEdges.NOT_ALLOWED, 0.0
    )
    rings = [np.asarray(ring.coords)[:-1] for ring in (area.exterior, *area.interiors)]
    points: Any = np.concatenate(rings)
    sides, first = [], 0
    for ring in rings:
        k = np.arange(len(ring))
        sides.append(first + np.column_stack([k, np.roll(k, -1)]))
        first += len(ring)
    mesh.insert_vertices(points)
    edges: Any = np.concatenate(sides).astype(np.uintc)  # the stubs know no arrays before 3.12
    mesh.insert_edges(edges)
    mesh.erase_outer_triangles_and_holes()
    triangles = mesh.triangles_array()
    corner, beside = triangles["vertices"].astype(np.intp), triangles["neighbors"]
    is_inner = beside != cdt.NO_NEIGHBOR  # side k joins corners k and k + 1
    pair = np.sort(np.stack([corner, np.roll(corner, -1, axis=1)], axis=2), axis=2)
    key = pair[:, :, 0] * len(points) + pair[:, :, 1]
    inner, node = np.unique(key[is_inner], return_inverse=True)
    node_of_side = np.full(corner.shape, -1)
    node_of_side[is_inner] = node + len(points)
    middles = (points[inner // len(points)] + points[inner % len(points)]) / 2
    links = [
        np.column_stack([node_of_side[:, k], node_of_side[:, (k + 1) % 3]]) for k in range(3)
    ] + [np.column_stack([node_of_side[:, k], corner[:, (k + 2) % 3]]) for k in range(3)]
    is_ear = is_inner.sum(axis=1) == 1  # its side's middle is joined to the corner opposite
    links[3:] = [link[is_ear] for link in links[3:]]
    joined = np.concatenate(links)
    return longest_path(np.concatenate([points, middles]), joined[(joined >= 0).all(axis=1)])


def longest_path(nodes: Floats, links: Any) -> LineString:
    """Longest of the shortest paths of a graph, as far as two looks from far ends find it."""
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import dijkstra

    length = np.hypot(*(nodes[links[:, 0]] - nodes[links[:, 1]]).T)
    graph = csr_array((length, (links[:, 0], links[:, 1])), shape=(len(nodes), len(nodes)))
    far = int(links[0, 0])
    for _ in range(2):
        distance, before = dijkstra(graph, directed=False, indices=far, return_predecessors=True)
        far = int(np.argmax(np.where(np.isfinite(distance), distance, -1.0)))
    path = [far]
    while before[path[-1]] >= 0:
        path.append(int(before[path[-1]]))
    return LineString(nodes[path])


def by_earcut(area: Polygon, width: float) -> Any:  # noqa: ARG001
    """Triangulate by ear clipping."""
    import mapbox_earcut

    rings = [np.asarray(ring.coords)[:-1] for ring in (area.exterior, *area.interiors)]
    stops = np.cumsum([len(ring) for ring in rings]).astype(np.uint32)
    return mapbox_earcut.triangulate_float64(np.concatenate(rings), stops)


MIDRIB = Way("midrib", ("midrib",), by_midrib, "`midrib.collapse(area)`")
VARIANTS = (
    variant("midrib, tolerance 0", tolerance=0.0),
    variant("midrib, symmetric", centring="symmetric"),
    variant("midrib, symmetric by radii", centring="symmetric", mean="radii"),
    variant("midrib, centred", centring="centred"),
)
RIVALS = (
    Way(
        "pygeoops, tuned",
        ("pygeoops",),
        by_pygeoops_tuned,
        "`centerline(area, densify_distance=w / 2, min_branch_length=3 * w, "
        "simplifytolerance=-0.02, extend=True)`",
    ),
    Way("pygeoops, default", ("pygeoops",), by_pygeoops, "`centerline(area)`"),
    Way(
        "centerline",
        ("centerline",),
        by_centerline,
        "`Centerline(area, interpolation_distance=w / 4)`",
    ),
    Way(
        "Voronoi script",
        ("scipy",),
        by_voronoi,
        "20 lines of scipy: points every w / 4, ridges inside, longest path",
    ),
    Way(
        "triangle script",
        ("pythoncdt", "scipy"),
        by_triangles,
        "35 lines: constrained Delaunay triangles, middles of inner sides, longest path",
    ),
)
YARDSTICKS = (
    Way(
        "WKB there and back",
        ("shapely",),
        lambda area, _: shapely.from_wkb(shapely.to_wkb(area)),
        "write and read the area",
    ),
    Way("is_valid", ("shapely",), lambda area, _: shapely.is_valid(area), "`shapely.is_valid`"),
    Way(
        "buffer",
        ("shapely",),
        lambda area, width: shapely.buffer(area, width / 4),
        "`shapely.buffer(area, w / 4)`",
    ),
    Way("earcut", ("mapbox_earcut",), by_earcut, "triangulate by ear clipping"),
)
