"""A slope as a register tells of it: an area, its top and its toe, and what is wrong with it."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np
from shapely import LineString, Point, Polygon

from midrib.errors import InvalidAreaError
from midrib.strip import Strip

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["KINDS", "Slope", "SlopeError", "SlopeKind", "SlopeProblem"]

SlopeKind: TypeAlias = Literal[
    "slope-unreinforced",
    "slope-reinforced",
    "dyke",
    "cutting",
    "embankment",
    "wall",
    "stairs",
    "conveyor",
    "gantry",
    "water-gate",
    "directed",  # no slope: a road or another area with a line along one edge
    "other",
]
KINDS: tuple[SlopeKind, ...] = SlopeKind.__args__  # type: ignore[attr-defined]


@dataclass(frozen=True, eq=False)
class Slope:
    """An area that falls from its top to its toe.

    Attributes
    ----------
    id : str
        The register's name of it; sides of one object are numbered on: ``dyke/1``, ``dyke/2``.
    kind : str
        One of ``KINDS``.
    area : Polygon
    top, toe : LineString
        The two edges, side by side. Closed where the slope runs all round, as on a mound.
    source : str
        The model or the layer it was read from.
    attributes : dict
        What else the register says, under the register's names.
    top_heights, toe_heights : ndarray of float64, shape (n, 3), or None
        Points of known height on either edge: x, y and height.
    crs : str or None
        PROJJSON; x is east and y is north whatever order the register has.
    """

    id: str
    kind: SlopeKind
    area: Polygon
    top: LineString
    toe: LineString
    source: str
    attributes: dict[str, object] = field(default_factory=dict)
    top_heights: "Floats | None" = None
    toe_heights: "Floats | None" = None
    crs: str | None = None

    def strip(self) -> Strip:
        """Return the strip to hatch: main curve the top, auxiliary curve the toe.

        Raises
        ------
        InvalidAreaError
            If top and toe do not divide the boundary of the area.
        """
        return Strip(self.top, self.toe, self.area)

    @property
    def drop(self) -> float | None:
        """Height of the top above the toe on the mean, None if it is not known of both."""
        if self.top_heights is None or self.toe_heights is None:
            return None
        return float(np.mean(self.top_heights[:, 2]) - np.mean(self.toe_heights[:, 2]))


@dataclass(frozen=True)
class SlopeProblem:
    """Something that is wrong with an object of a register.

    Attributes
    ----------
    id : str
        The register's name of the object.
    kind : str
        ``"refused"``: it is no slope for want of something; the others leave a slope that may not
        be what was meant.
    reason : str
    where : Point or None
        The place, if there is one.
    """

    id: str
    kind: str
    reason: str
    where: Point | None = None


class SlopeError(InvalidAreaError):
    """An area has no top and toe; the message has the reason, ``where`` the place."""

    def __init__(self, reason: str, where: "Floats | None" = None) -> None:
        super().__init__(reason)
        self.where = None if where is None else Point(where[:2])
