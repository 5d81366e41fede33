"""How long the first line on a machine takes, and every later start: CPU seconds of processes.

Each process collapses a file of one area with ``midrib collapse``; the first finds an empty folder
for compiled kernels, the others what it has left there. docs/scale.md tells what is printed.
"""

import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import geopandas as gpd

from families import make

__all__ = ["cpu_of"]

LATER = 5  # starts, of which the quickest counts


def cpu_of(folder: Path) -> float:
    """CPU seconds of a process that collapses the file in a folder; kernels are kept there too."""
    command = [sys.executable, "-m", "midrib", "collapse", "area.geojson", "line.geojson"]
    (folder / "line.geojson").unlink(missing_ok=True)
    environment = os.environ | {"NUMBA_CACHE_DIR": str(folder)}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # what is installed has its bytecode
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, cwd=folder, env=environment, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main() -> None:
    """Print CPU seconds of the first start and of later ones."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        area = make("river", 100).area
        gpd.GeoSeries([area], crs=2180).to_file(folder / "area.geojson", driver="GeoJSON")
        first = cpu_of(folder)
        later = min(cpu_of(folder) for _ in range(LATER))
    print(f"first start {first:.1f} s, later ones {later:.2f} s of CPU")


if __name__ == "__main__":
    main()
