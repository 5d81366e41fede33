"""How axes of towers are found."""

from typing import Annotated, TypeAlias

from midrib.cli.options.choices import TowerMode, TowerShape, TowerThinning
from midrib.cli.options.panels import of_tower

__all__ = [
    "CloudUnit",
    "FanPlanes",
    "LevelStep",
    "Levelling",
    "Near",
    "RadiusRange",
    "Registration",
    "TowerModeOption",
    "TowerShapeOption",
    "TowerThinningOption",
    "Verticality",
]

TowerModeOption: TypeAlias = Annotated[
    TowerMode,
    of_tower(
        "--mode",
        help="joint: one spline cone through the whole shell; fan: curves of minimal radii in many "
        "planes through the axis; paper: in two planes.",
    ),
]
TowerShapeOption: TypeAlias = Annotated[
    TowerShape,
    of_tower("--shape", help="What sections are taken for; auto looks what explains the points."),
]
FanPlanes: TypeAlias = Annotated[
    int,
    of_tower("--planes", metavar="NUMBER", help="Planes of --mode fan, 3 to 36."),
]
TowerThinningOption: TypeAlias = Annotated[
    TowerThinning,
    of_tower(
        "--thinning",
        help="How walls become curves in --mode paper: local lines, or means of points within 1 cm "
        "of each other.",
    ),
]
LevelStep: TypeAlias = Annotated[
    str | None,
    of_tower("--step", metavar="LENGTH", help="Distance of levels, 1m; half a metre unless given."),
]
Near: TypeAlias = Annotated[
    str | None,
    of_tower("--near", metavar="X,Y", help="A place on or beside which the tower stands."),
]
RadiusRange: TypeAlias = Annotated[
    str | None,
    of_tower("--radius", metavar="MIN,MAX", help="Least and largest radius of the tower: 1m,5m."),
]
CloudUnit: TypeAlias = Annotated[
    str | None,
    of_tower(
        "--unit",
        metavar="UNIT",
        help="Unit of the coordinates, m ft usft …; what the file says, or metres, unless given.",
    ),
]
Registration: TypeAlias = Annotated[
    str | None,
    of_tower(
        "--registration",
        metavar="LENGTH",
        help="Standard deviation of the stations' registration, 2mm: added to the uncertainty.",
    ),
]
Levelling: TypeAlias = Annotated[
    float,
    of_tower(
        "--levelling",
        metavar="MM_PER_M",
        help="Standard deviation of the vertical in mm per m: added to the uncertainty.",
    ),
]
Verticality: TypeAlias = Annotated[
    str | None,
    of_tower(
        "--tolerance",
        metavar="TEXT",
        help="Allowed deviation: a length (50mm), a share of the height (h/1000), or their sum.",
    ),
]
