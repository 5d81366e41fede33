"""Point clouds: files to chunks of coordinates, by the ending of their names."""

from pathlib import Path
from typing import TYPE_CHECKING

from midrib.errors import ParameterError
from midrib.formats.clouds.arrays import NumpyCloud
from midrib.formats.clouds.e57 import E57Cloud
from midrib.formats.clouds.las import LasCloud
from midrib.formats.clouds.ply import PlyCloud
from midrib.formats.clouds.text import TextCloud

if TYPE_CHECKING:
    from collections.abc import Callable

    from midrib.towers.cloud import Cloud

__all__ = ["ENDINGS", "open_cloud"]

ENDINGS: dict[str, "Callable[[Path], Cloud]"] = {
    ".las": LasCloud,
    ".laz": LasCloud,
    ".e57": E57Cloud,
    ".ply": PlyCloud,
    ".xyz": TextCloud,
    ".txt": TextCloud,
    ".csv": TextCloud,
    ".asc": TextCloud,
    ".pts": TextCloud,
    ".npy": NumpyCloud,
    ".npz": NumpyCloud,
}


def open_cloud(path: str | Path) -> "Cloud":
    """Open a file of points.

    Raises
    ------
    ParameterError
        If there is no such file, its ending is not known, or it is broken.
    MissingDependencyError
        If the library that reads it is not installed.
    """
    path = Path(path)
    if not path.is_file():
        found = "is a folder" if path.is_dir() else "does not exist"
        msg = f"CLOUD {str(path)!r} {found}, expected a file of points"
        raise ParameterError(msg)
    if path.stat().st_size == 0:
        msg = f"CLOUD {str(path)!r} is empty, expected points"
        raise ParameterError(msg)
    if path.suffix.lower() not in ENDINGS:
        msg = f"CLOUD {str(path)!r} ends in {path.suffix!r}, expected {', '.join(ENDINGS)}"
        raise ParameterError(msg)
    return ENDINGS[path.suffix.lower()](path)
