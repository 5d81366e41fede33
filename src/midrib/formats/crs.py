"""Names of coordinate reference systems in GML: what they mean, and which axis comes first.

Source: OGC 07-092r3 and 09-048r5 (URN and URI of EPSG definitions). A URN or URI takes the order of
axes that the definition has, north first in Poland; the short form ``EPSG:2177`` is x, y.
"""

import json
import re
from functools import cache
from typing import NamedTuple

import pyarrow as pa
import pyogrio
import pyogrio.errors
import shapely

from midrib.formats.units import horizontal

__all__ = ["System", "system_of"]

CODE = re.compile(r"EPSG(?:::|:[\d.]+:|/[\d.]+/|:|\.xml#)(\d+)", re.IGNORECASE)
BY_DEFINITION = ("urn:", "http://www.opengis.net/def/", "https://www.opengis.net/def/")
KEY = b"ARROW:extension:metadata"


class System(NamedTuple):
    """A coordinate reference system."""

    crs: str | None  # PROJJSON
    is_north_first: bool


@cache
def system_of(name: str) -> System | None:
    """Look up what a name means, None if it is not known.

    Examples
    --------
    >>> system_of("urn:ogc:def:crs:EPSG::2177").is_north_first
    True
    """
    match = CODE.search(name)
    crs = None if match is None else definition(f"EPSG:{match[1]}")
    if crs is None:
        return None
    axes = horizontal(crs)["coordinate_system"]["axis"]
    is_north_first = axes[0]["direction"] == "north" and name.lower().startswith(BY_DEFINITION)
    return System(crs, is_north_first)


def definition(code: str) -> str | None:
    """Return the PROJJSON of a code, from a layer in memory, None if there is no such code."""
    path = "/vsimem/midrib-crs.gpkg"
    table = pa.table({"geom": pa.array([shapely.Point(0.0, 0.0).wkb], type=pa.binary())})
    try:
        pyogrio.write_arrow(
            table, path, driver="GPKG", geometry_name="geom", geometry_type="Point", crs=code
        )
    except pyogrio.errors.CRSError:
        return None
    with pyogrio.open_arrow(path, use_pyarrow=True) as (_, reader):
        metadata = reader.schema.field("geom").metadata[KEY]
    pyogrio.vsi_unlink(path)
    return json.dumps(json.loads(metadata)["crs"])
