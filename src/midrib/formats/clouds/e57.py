"""E57: the scans of a file, one after the other, each put where its pose says; metres.

Points of a scan are Cartesian, or spherical: range r, azimuth a from x towards y, elevation e above
the plane of x and y, so that x, y, z = r cos e cos a, r cos e sin a, r sin e (ASTM E2807).
"""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from midrib.checks import check_library
from midrib.errors import ParameterError
from midrib.formats.clouds.common import check_signature, refusing
from midrib.towers.cloud import CHUNK, InOrder

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["E57Cloud"]

SIGNATURE, LEAST_HEADER = b"ASTM-E57", 48  # bytes
# Coordinates of points, and what is 0 where these mean something.
CARTESIAN = (("cartesianX", "cartesianY", "cartesianZ"), "cartesianInvalidState")
SPHERICAL = (("sphericalRange", "sphericalAzimuth", "sphericalElevation"), "sphericalInvalidState")


class E57Cloud(InOrder):
    """An E57 file; the standard (ASTM E2807) has metres."""

    metres: float | None = 1.0
    crs: str | None = None

    def __init__(self, path: Path) -> None:
        check_library("pye57", "an E57 file", "e57")
        import pye57

        self.path, self.name = path, f"CLOUD {str(path)!r}"
        with refusing(path, pye57.libe57.E57Exception, RuntimeError, ValueError):
            check_signature(path, SIGNATURE, LEAST_HEADER)
            file = pye57.E57(str(path))
            self.has_stations = file.scan_count > 1
            self.count = sum(file.get_header(k).point_count for k in range(file.scan_count))
            file.close()

    def chunks(self, *, with_stations: bool = False) -> Iterator["Floats"]:
        """Points (n, 3), a chunk at a time; those without a return are left out.

        The station of a point is the number of its scan.
        """
        import pye57

        with refusing(self.path, pye57.libe57.E57Exception, RuntimeError):
            file = pye57.E57(str(self.path))
            for k in range(file.scan_count):
                header = file.get_header(k)
                names, valid = coordinates_of(header.point_fields, f"{self.name} scan {k}")
                fields = [name for name in (*names, valid) if name in header.point_fields]
                values, buffers = file.make_buffers(fields, min(CHUNK, header.point_count))
                turn, shift = np.eye(3), np.zeros(3)
                if header.has_pose():
                    turn, shift = header.rotation_matrix, header.translation
                reader = header.points.reader(buffers)
                while count := reader.read():
                    points = np.column_stack([values[name][:count] for name in names])
                    if valid in fields:
                        points = points[values[valid][:count] == 0]
                    if names == SPHERICAL[0]:
                        points = cartesian(points)
                    placed = points @ turn.T + shift
                    yield (
                        np.column_stack([placed, np.full(len(placed), k)])
                        if with_stations
                        else placed
                    )
                reader.close()
            file.close()


def coordinates_of(fields: Any, name: str) -> tuple[tuple[str, ...], str]:
    """Find the fields that are the coordinates, and the one that says whether they are valid.

    Raises
    ------
    ParameterError
        If there are none.
    """
    for names, valid in (CARTESIAN, SPHERICAL):
        if set(names) <= set(fields):
            return names, valid
    expected = " or ".join(", ".join(names) for names, _ in (CARTESIAN, SPHERICAL))
    msg = f"{name} has the fields {', '.join(fields) or 'none'}, expected {expected}"
    raise ParameterError(msg)


def cartesian(points: "Floats") -> "Floats":
    """Turn range, azimuth and elevation, radians, (n, 3) into x, y, z."""
    r, azimuth, elevation = points.T
    level = r * np.cos(elevation)
    return np.column_stack(
        [level * np.cos(azimuth), level * np.sin(azimuth), r * np.sin(elevation)]
    )
