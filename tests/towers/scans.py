"""Scans that tests share."""

from typing import Any

import numpy as np

from midrib.towers.records import TowerAxis
from midrib.towers.simulate import Scan, Tower
from midrib.types import Floats

__all__ = ["CONE", "dirty", "offsets"]

CONE = Scan(Tower(height=40.0, base_radius=2.5, top_radius=1.5, lean=0.1), count=60_000, seed=3)


def dirty(tower: Tower | None = None, **changes: Any) -> Scan:
    """Scan with noise, a ladder, platforms, antennas and strays."""
    usual: dict[str, Any] = {"noise": (0.002, 0.004), "ladder": 30.0, "platforms": (0.4, 0.8)}
    usual |= {"antennas": 2, "outliers": 0.01, "count": 150_000, "seed": 4}
    tower = tower or Tower(height=40.0, base_radius=2.5, top_radius=1.5, lean=0.1, bend=0.01)
    return Scan(tower, **(usual | changes))


def offsets(axis: TowerAxis, scan: Scan) -> Floats:
    """Distances of the levels' centres from the true axis, NaN where there is none."""
    levels = axis.levels
    off = np.column_stack([levels["x"], levels["y"]]) - scan.axis(levels["z"])
    away: Floats = np.hypot(*off.T)
    return away
