"""Where beams graze the shell: beside a part of it that is not seen."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.types import Bools

__all__ = ["grazed"]

GAP, GAP_HEIGHT = 30.0, 2.5  # degrees, metres: a part without cells that is as large is hidden
GRAZED = 10.0  # degrees beside it


def grazed(cells: "Cells", unit: float) -> "Bools":
    """Which cells lie where beams graze the shell: next to a part that is not seen.

    There a beam is half on the shell and half behind it, and its points lie a few millimetres in.
    """
    grid = cells.grid
    seen = np.zeros((grid.n_levels, grid.n_sectors), dtype=np.bool_)
    seen[cells.level, cells.sector] = True
    rise = max(1, round(GAP_HEIGHT * unit / grid.level))
    bands = np.add.reduceat(seen, np.arange(0, grid.n_levels, rise), axis=0) > 0
    wide = max(1, round(GAP / 360.0 * grid.n_sectors))
    hidden = np.all([np.roll(~bands, k, axis=1) for k in range(wide)], axis=0)
    hidden = np.any([np.roll(hidden, -k, axis=1) for k in range(wide)], axis=0)
    margin = max(1, round(GRAZED / 360.0 * grid.n_sectors))
    near = np.any([np.roll(hidden, k, axis=1) for k in range(-margin, margin + 1)], axis=0)
    # What has hidden parts everywhere is a net of few points, not a shell seen from one side.
    near &= ~near.all(axis=1)[:, None]
    found: Bools = near[cells.level // rise, cells.sector]
    return found
