"""Tables for the documentation, and what they have to say about the machine."""

import json
import os
import platform
from collections.abc import Iterable, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

__all__ = ["ROOT", "machine", "machine_text", "markdown", "milliseconds", "versions", "write_json"]

ROOT = Path(__file__).parent.parent
PACKAGES = (
    "numpy",
    "numba",
    "shapely",
    "scipy",
    "pygeoops",
    "centerline",
    "pythoncdt",
    "mapbox_earcut",
    "pyvoronoi",
    "pysfcgal",
)


def markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Lay out a Markdown table; the first column is text, the others are numbers."""
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines) + "\n"


def milliseconds(seconds: float) -> str:
    """Write a time with two or three digits."""
    value = seconds * 1000.0
    if value >= 100.0:
        return f"{value:,.0f}"
    return f"{value:.2g}" if value < 10.0 else f"{value:.0f}"


def machine() -> dict[str, str]:
    """Processor, cores and system; nothing that names the computer."""
    model = platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        for line in cpuinfo.read_text(encoding="utf-8").splitlines():
            key, _, value = line.partition(":")
            if key.strip() == "model name":
                model = value.strip()
                break
    return {
        "processor": model,
        "cores": str(os.cpu_count()),
        "system": f"{platform.system()}, Python {platform.python_version()}",
    }


def machine_text() -> str:
    """Say on what machine numbers were measured."""
    about = machine()
    return f"{about['processor']}, {about['cores']} cores; {about['system']}"


def versions() -> dict[str, str]:
    """Versions of midrib, of the rivals and of what they stand on."""
    from midrib import __version__

    found = {"midrib": __version__}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    found["GEOS"] = geos_version()
    return found


def geos_version() -> str:
    """Version of the library under shapely."""
    import shapely

    return str(shapely.geos_version_string)


def write_json(path: Path, content: Any) -> None:
    """Write results so that their differences read well."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
