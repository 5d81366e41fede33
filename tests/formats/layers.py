"""Small layers to write and read."""

import json
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyogrio
import shapely

from midrib.formats.contents import layer_names
from midrib.formats.reading import Geometries, Source, open_layer
from midrib.formats.writing import Features, write_layer

__all__ = ["RD_NEW", "crs_name", "features_of", "projjson", "read_all", "write"]


def projjson(crs: str) -> str:
    """PROJJSON of a CRS by way of a layer in memory."""
    table = pa.table({"geom": pa.array([shapely.Point(0, 0).wkb], type=pa.binary())})
    path = f"/vsimem/{crs.replace(':', '_')}.gpkg"
    pyogrio.write_arrow(
        table, path, driver="GPKG", geometry_name="geom", geometry_type="Point", crs=crs
    )
    with pyogrio.open_arrow(path, use_pyarrow=True) as (_, reader):
        metadata = reader.schema.field("geom").metadata[b"ARROW:extension:metadata"]
    pyogrio.vsi_unlink(path)
    return json.dumps(json.loads(metadata)["crs"])


RD_NEW = projjson("EPSG:28992")


def features_of(
    wkts: list[str | None],
    crs: str | None = RD_NEW,
    layer: str = "some",
    kind: str = "LineString",
) -> Features:
    """Features with a number, a text and a real attribute each."""
    n = len(wkts)
    attributes = pa.table(
        {
            "number": pa.array(range(n), type=pa.int64()),
            "name": pa.array([None if i == 1 else f"é {i}" for i in range(n)], type=pa.string()),
            "share": pa.array(np.arange(n) / 4.0),
        }
    )
    return Features(layer, attributes, shapely.from_wkt(wkts), "geom", kind, crs)


def write(
    path: Path,
    wkts: list[str | None],
    crs: str | None = RD_NEW,
    layer: str = "some",
    kind: str = "LineString",
) -> Path:
    """Write a layer and return the path; ``kind`` is what it declares where it has no geometry."""
    write_layer(path, features_of(wkts, crs, layer, kind))
    return path


def read_all(path: Path, layer: str | None = None) -> tuple[Source, pa.Table, Geometries]:
    """A whole layer: what is known of it, attributes and geometries."""
    name = next(iter(layer_names(path))) if layer is None else layer
    with open_layer(path, name, batch_size=2) as source:
        batches = list(source.batches())
    return (
        source,
        pa.concat_tables([batch.attributes for batch in batches]),
        np.concatenate([batch.geometries for batch in batches]),
    )


def crs_name(crs: str | None) -> str | None:
    """Name of a CRS."""
    return None if crs is None else str(json.loads(crs)["name"])
