"""Elongated areas of real layers, in metres: rivers, roads, slopes, lakes, parcels.

The layers are not part of the project; without the folder beside it there are none.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import Polygon

from midrib.geodesy import degree_lengths
from tables import ROOT

__all__ = ["FOLDER", "LAYERS", "layers", "long_areas"]

FOLDER = ROOT.parent / "shared" / "data"
ELONGATED = 5.0  # length over width of the rectangle with an area's area and perimeter
MOST_VERTICES = 20_000

LAYERS = (
    ("road parts, verges, water, banks", "nl_bgt_gooi.gpkg", "vlak"),
    ("slopes, Netherlands", "nl_bgt_gooi.gpkg", "talud"),
    ("slopes, Poland", "pl_bdot500_opole_west.gpkg", "skarpa"),
    ("carriageways", "pl_bdot500_opole_west.gpkg", "BDZ_Jezdnia"),
    ("trees and bushes", "pl_bdot500_opole_west.gpkg", "BDZ_TerenLesnyZadrzewionyLubZakrzewiony"),
    ("water and streets, Heidelberg", "osm_de_heidelberg.gpkg", "areas"),
    ("water and streets, Helsinki", "osm_fi_helsinki.gpkg", "areas"),
    ("water and streets, Krems", "osm_at_krems.gpkg", "areas"),
    ("roads and junctions", "osm2streets_road_polygons.parquet", None),
    ("parcels", "nl_plots.parquet", None),
    ("river, Louisiana", "us_river_louisiana.gpkg", "polygon"),
    ("rivers and lakes, simplified", "geomaps_rivers_americas_poland.parquet", None),
    ("rivers and lakes", "gshhg_rivers_lakes_americas.parquet", None),
)


def layers(folder: Path = FOLDER) -> Iterator[tuple[str, NDArray[np.object_]]]:
    """Name and long areas of each layer that is there."""
    for name, file, layer in LAYERS:
        if (folder / file).exists():
            yield name, long_areas(folder / file, layer)


def long_areas(path: Path, layer: str | None) -> NDArray[np.object_]:
    """Read the valid Polygons that are much longer than wide; degrees are made metres."""
    import geopandas as gpd

    frame = gpd.read_parquet(path) if layer is None else gpd.read_file(path, layer=layer)
    parts = shapely.force_2d(shapely.get_parts(frame.geometry.to_numpy()))
    is_area = (shapely.get_type_id(parts) == 3) & shapely.is_valid(parts)
    areas = parts[is_area & (shapely.get_num_coordinates(parts) <= MOST_VERTICES)]
    if frame.crs is not None and frame.crs.is_geographic:
        areas = np.array([in_metres(area) for area in areas], dtype=object)
    quarter = shapely.length(shapely.get_exterior_ring(areas)) / 4.0
    squared = quarter**2 - shapely.area(shapely.polygons(shapely.get_exterior_ring(areas)))
    root = np.sqrt(np.maximum(squared, 0.0))
    found: NDArray[np.object_] = areas[quarter + root >= ELONGATED * (quarter - root)]
    return found


def in_metres(area: Polygon) -> Polygon:
    """Area in a plane that is true to scale at its middle latitude."""
    unit = np.array(degree_lengths(np.array(area.bounds)))
    return shapely.transform(area, lambda degrees: degrees * unit)
