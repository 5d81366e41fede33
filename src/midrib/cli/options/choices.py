"""Choices that options have, and which of them are the usual ones."""

from enum import StrEnum

__all__ = [
    "Centring",
    "Channel",
    "DrawingRule",
    "EndRule",
    "Engine",
    "Holes",
    "Letter",
    "Mean",
    "SharedEdges",
    "SkipRule",
    "StartSide",
    "TowerMode",
    "TowerShape",
    "TowerThinning",
    "WidthPlace",
    "chosen",
]


class Engine(StrEnum):
    """What does the work."""

    local = "local"
    dask = "dask"
    spark = "spark"


class EndRule(StrEnum):
    """Rules for the ends of a line."""

    main = "main"
    caps = "caps"
    radii = "radii"
    none = "none"


class Centring(StrEnum):
    """Ways of centring a line."""

    none = "none"
    symmetric = "symmetric"
    centred = "centred"


class Mean(StrEnum):
    """Means of the two curves of a symmetric line."""

    radii = "radii"
    proportional = "proportional"
    kinks = "kinks"
    same_height = "same-height"


class SkipRule(StrEnum):
    """Stations that are dropped."""

    bays = "bays"
    none = "none"


class Holes(StrEnum):
    """What holes are."""

    blocked = "blocked"
    auxiliary = "auxiliary"
    ignored = "ignored"


class Channel(StrEnum):
    """On which side of islands a line passes."""

    shorter = "shorter"
    wider = "wider"


USUAL: dict[str, StrEnum] = {
    "centring": Centring.centred,
    "holes": Holes.blocked,
    "channel": Channel.shorter,
    "ends": EndRule.caps,
}


def chosen(**values: StrEnum) -> dict[str, str | None]:
    """Options of ``collapse`` that are not the usual ones, which some methods do not have."""
    found = {name: value for name, value in values.items() if value is not USUAL[name]}
    return {name: None if value is EndRule.none else value.value for name, value in found.items()}


class WidthPlace(StrEnum):
    """Where the width of areas is written."""

    columns = "columns"
    m = "m"


class StartSide(StrEnum):
    """Where a pattern of strokes starts."""

    left = "left"
    right = "right"
    first = "first"
    last = "last"


class SharedEdges(StrEnum):
    """How slopes go together that have a top or a toe in common."""

    meet = "meet"
    between = "between"
    apart = "apart"


class Letter(StrEnum):
    """Lengths of strokes."""

    long = "long"
    short = "short"


class DrawingRule(StrEnum):
    """How strokes are found."""

    matching = "matching"
    mean = "mean"
    paper = "paper"


class TowerMode(StrEnum):
    """Ways to find a tower's axis."""

    joint = "joint"
    fan = "fan"
    paper = "paper"


class TowerThinning(StrEnum):
    """Ways to thin the walls of a section to curves."""

    moving_least_squares = "moving-least-squares"
    average_depth = "average-depth"


class TowerShape(StrEnum):
    """What a tower's sections are taken for."""

    auto = "auto"
    round = "round"
    polygon = "polygon"
