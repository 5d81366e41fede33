"""What is handed over about a tower: its levels, its axis as a whole, and how they were found."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely
from shapely import MultiLineString

from midrib.towers.summary import Summary, summary_of

if TYPE_CHECKING:
    from midrib.towers.cells import Cells
    from midrib.towers.kinks import Kink, Offset, RadiusStep
    from midrib.towers.stations import Station
    from midrib.types import Bools, Floats, Ints

__all__ = ["LEVELS", "Shape", "TowerAxis"]

LEVELS = np.dtype(
    [(name, np.float64) for name in ("z", "x", "y", "radius", "sigma", "deviation", "azimuth")]
    + [("coverage", np.float64), ("n", np.int64), ("flag", "U240")]
    + [(name, np.float64) for name in ("ovality", "residual", "sigma_x", "sigma_y", "sigma_inner")]
)


class Shape(NamedTuple):
    """What the sections are, and what they are not."""

    name: str  # round, oval, square, polygon, unknown
    faces: int  # number of flat faces, 0 if there are none
    azimuth: float  # degrees from north (y), clockwise: of a face's normal, of the longest diameter
    harmonics: dict[int, tuple[float, float]]  # amplitude and its standard deviation, by order
    problem: str  # why the sections do not suit the model, empty if they do

    @property
    def text(self) -> str:
        """Name for people."""
        return f"{self.name}, {self.faces} faces" if self.name == "polygon" else self.name


@dataclass(frozen=True, eq=False)
class TowerAxis:
    """The axis of a tower by levels, with its uncertainty.

    Attributes
    ----------
    levels : structured array
        From the base up. ``z``, ``x``, ``y`` of the centre; ``radius`` (of a polygon that of the
        inscribed circle); ``sigma`` of one coordinate of the centre; ``deviation`` from the
        vertical through the lowest level and its ``azimuth`` in degrees from y (north) clockwise;
        ``coverage``, degrees of the shell that are seen; ``n`` points; ``flag``, empty where all is
        well, else why there is no centre, or all that is wrong with it; ``ovality``, longest less
        shortest diameter over the mean one, NaN where unknown; ``residual``, standard deviation of
        the cells of the level; ``sigma_x``, ``sigma_y``; ``sigma_inner``, ``sigma`` without
        registration and levelling, which move all levels alike.
        Lengths are in coordinate units. A level without an answer has NaN and a flag.
    mode : str
        "joint", "fan" or "paper".
    shape : Shape
        What the sections are.
    unit : float
        Coordinate units in a metre.
    crs : str or None
        Reference system of the coordinates.
    count : int
        Points of the cloud that lie near the shell.
    steps : dict
        What was made on the way, of "paper": see ``midrib.towers.paper``.
    stations : list of Station
        How far each station is off the mean of all, where the cloud says which points are from
        which and they overlap enough to tell. The points were put together accordingly.
    unusable : int
        Points that were left out since a coordinate is missing or not finite.
    labels : int
        Stations that the points name; 0 if they name none, one, or too many.
    kinks : list of Kink
        Where the axis changes its direction, for certain and suddenly: by the joint fit's cells,
        whatever the mode.
    offsets : list of Offset
        Where it leaps, in the same way: a step between two casting lifts, say. The joint mode's
        axis leaps there too.
    radius_steps : list of RadiusStep
        Where the radius leaps, all round, and by how much: above 0 if it is wider above.
    """

    levels: "np.ndarray[Any, np.dtype[np.void]]"
    mode: str
    shape: Shape
    unit: float
    crs: str | None
    count: int
    cells: "Cells"
    residual: "Floats"  # (n,) of the cells, along the wall's normal
    used: "Bools"  # (n,) which cells counted
    steps: dict[str, Any] = field(default_factory=dict)
    stations: "list[Station]" = field(default_factory=list)
    unusable: int = 0
    labels: int = 0
    kinks: "list[Kink]" = field(default_factory=list)
    offsets: "list[Offset]" = field(default_factory=list)
    radius_steps: "list[RadiusStep]" = field(default_factory=list)

    @property
    def is_answered(self) -> "Bools":
        """(n,) which levels have a centre."""
        found: Bools = np.isfinite(self.levels["x"])
        return found

    @cached_property
    def points(self) -> "Floats":
        """(k, 3) centres of the levels that have one."""
        there = self.levels[self.is_answered]
        return np.column_stack([there["x"], there["y"], there["z"]])

    def at(self, z: "Floats") -> "Floats":
        """Points (m, 3) of the axis at heights, in line between the levels next to them."""
        x, y, heights = self.points.T
        return np.column_stack([np.interp(z, heights, x), np.interp(z, heights, y), z])

    @cached_property
    def breaks(self) -> "Ints":
        """Rows of ``points`` at which the axis begins anew: above missing levels and offsets.

        What is between them was not seen, or is no part of a smooth axis.
        """
        rows = np.flatnonzero(self.is_answered)
        leaps = np.searchsorted(np.sort([offset.z for offset in self.offsets]), self.points[:, 2])
        found: Ints = 1 + np.flatnonzero((np.diff(rows) > 1) | (np.diff(leaps) > 0))
        return found

    @cached_property
    def line(self) -> MultiLineString:
        """The axis, a MultiLineString Z with a part for each run of levels without a break."""
        parts = [part for part in np.split(self.points, self.breaks) if len(part) > 1]
        return MultiLineString(parts) if parts else shapely.from_wkt("MULTILINESTRING Z EMPTY")

    @cached_property
    def summary(self) -> Summary:
        """The axis as a whole: best line, straightness, largest deviation."""
        return summary_of(self.levels[self.is_answered], self.unit)

    def __repr__(self) -> str:
        """Show what there is of it."""
        flagged = int((self.levels["flag"] != "").sum())
        return (
            f"<TowerAxis: {self.mode}, {self.shape.text}, {len(self.levels)} levels, "
            f"{flagged} flagged>"
        )
