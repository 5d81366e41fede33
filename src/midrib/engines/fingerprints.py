"""What tells an input from others, and from what it was before: every file that it consists of."""

import hashlib
from pathlib import Path
from typing import Any

from midrib.formats.endings import sides_of

__all__ = ["files_behind", "fingerprints"]

FOOTER = 65_536  # bytes at the end of a file that tell it from others
LOCK = ".lock"  # files in a geodatabase that come and go with its readers


def files_behind(path: Path) -> list[Path]:
    """Files that are read where one name is given: itself and its side files, or those in it."""
    if path.is_dir():
        return sorted(f for f in path.rglob("*") if f.is_file() and f.suffix.lower() != LOCK)
    return [path, *sides_of(path)]


def fingerprints(path: Path) -> list[dict[str, Any]]:
    """Name, size, time and hash of the end of each file behind an input."""
    return [fingerprint(file, path.parent) for file in files_behind(path)]


def fingerprint(file: Path, folder: Path) -> dict[str, Any]:
    """Name of a file in a folder, its size, time, hash of its end."""
    about = file.stat()
    with file.open("rb") as stream:
        stream.seek(max(about.st_size - FOOTER, 0))
        end = hashlib.sha256(stream.read()).hexdigest()
    name = file.relative_to(folder).as_posix()
    return {"name": name, "bytes": about.st_size, "changed": about.st_mtime_ns, "sha256": end}
