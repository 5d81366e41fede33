"""How far apart strokes are and how long: the rule of a standard, in ground units."""

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from midrib.checks import is_number, shown
from midrib.errors import ParameterError
from midrib.hatching.keys import STROKED
from midrib.hatching.standards import standard as standard_named
from midrib.kernels.ladder import MOST_LOCAL

if TYPE_CHECKING:
    from shapely import LineString

    from midrib.types import Floats

__all__ = ["LEAST_LENGTH", "Rule", "rule_of", "with_mean_gap"]

LEAST_LENGTH = 0.25  # of the least gap: about the width of the line, shorter strokes are dots
MILLIMETRES = 1000.0
VALUES = ("factor", "spacing", "min_spacing", "max_spacing", "pattern", "short_ratio")
FIFTH, FEW = 0.2, 10  # a top with fewer vertices is densified to this share of its length
SHORTEST, LONGEST = 0.05, 0.95  # short strokes, of whole ones


@dataclass(frozen=True)
class Rule:
    """The rule of a standard at a scale, in coordinate units.

    The gap between two strokes is ``clamp(factor w, min_spacing, max_spacing)`` where w is their
    length from top to toe, but no more than 1.5 local widths, or ``spacing`` throughout.
    """

    factor: float | None = 0.5
    spacing: float | None = None
    min_spacing: float = 0.0
    max_spacing: float | None = None
    pattern: str = "LS"
    short_ratio: float = 0.5

    @property
    def least_gap(self) -> float:
        """Gap where strokes are shortest."""
        if self.factor is None:
            return max(self.spacing or 0.0, self.min_spacing)
        return self.min_spacing

    @property
    def largest_gap(self) -> float:
        """Gap where strokes are longest; infinite where there is no bound."""
        if self.factor is None:
            return self.least_gap
        return np.inf if self.max_spacing is None else max(self.max_spacing, self.min_spacing)

    def gaps(self, width: "Floats", local: "Floats | None" = None) -> "Floats":
        """Gaps that the rule asks for beside strokes that are so long, where slopes are so wide.

        A stroke down a bay is longer than the slope is wide there: it counts for 1.5 local widths.
        """
        if local is not None:
            width = np.minimum(width, MOST_LOCAL * local)
        gaps: Floats = np.clip((self.factor or 0.0) * width, self.least_gap, self.largest_gap)
        return gaps


def rule_of(standard: Any, scale: Any, metres_per_unit: Any, **overrides: Any) -> Rule:
    """Return the rule that a standard has at a scale, with some values replaced.

    Raises
    ------
    ParameterError
        If there is no such standard, or a value is none that it can have.
    """
    check_positive(scale, "scale")
    check_positive(metres_per_unit, "metres_per_unit")
    ground = float(scale) / MILLIMETRES / float(metres_per_unit)
    at_scale = standard_named(standard).at(scale)
    if at_scale.symbol not in STROKED:
        msg = (
            f"standard is {at_scale.name!r}, which draws {at_scale.symbol}, expected one that "
            "draws strokes; midrib.draw_slopes draws every kind"
        )
        raise ParameterError(msg)
    values: dict[str, Any] = {name: getattr(at_scale, name) for name in VALUES}
    given = {name: value for name, value in overrides.items() if value is not None}
    for name, other in (("factor", "spacing"), ("spacing", "factor")):
        if name in given:
            values[other] = None
    if "spacing" in given:  # the standard's bounds are those of its factor
        values |= {"min_spacing": 0.0, "max_spacing": None}
    values |= given
    if given.get("min_spacing") == 0.0:
        check_positive(given["min_spacing"], "min_spacing")
    check_gaps(values)
    check_pattern(values["pattern"])
    ratio = values["short_ratio"]
    if not is_number(ratio) or not (SHORTEST <= ratio <= LONGEST or ratio == 1.0):
        msg = f"short_ratio is {shown(ratio)}, expected {SHORTEST} to {LONGEST}, or 1"
        raise ParameterError(msg)
    for name in ("spacing", "min_spacing", "max_spacing"):
        if values[name] is not None:
            values[name] = float(values[name]) * ground
    return Rule(**values)


def with_mean_gap(rule: Rule, top: "LineString", toe: "LineString") -> Rule:
    """Return the rule with one gap for a whole slope, as drawing tools have it.

    It is the factor times the mean distance of the top's vertices from the toe. A top with fewer
    than ten vertices gets more of them first, a fifth of its length apart at most. Its ends count
    as well: where top and toe meet, with a distance of 0.

    Raises
    ------
    ParameterError
        If the rule has no factor.

    References
    ----------
    GML Explorer, a QGIS plugin: its code for slopes.
    """
    if rule.factor is None:
        msg = f"rule is 'mean' with a fixed spacing, {rule.least_gap:.3g}, expected a factor"
        raise ParameterError(msg)
    dense = shapely.force_2d(top)
    if shapely.get_num_coordinates(dense) < FEW:
        dense = shapely.segmentize(dense, FIFTH * dense.length)
    corners = shapely.points(shapely.get_coordinates(dense))
    mean = shapely.distance(corners, toe).mean(keepdims=True)
    (gap,) = rule.gaps(mean).tolist()
    return replace(rule, factor=None, spacing=gap, min_spacing=0.0, max_spacing=None)


def check_gaps(values: dict[str, Any]) -> None:
    """Refuse gaps that are none, or set by a factor and fixed too.

    Fixed gaps need no least one; where a factor makes them, they would come to 0 in tips.
    """
    factor, spacing = values["factor"], values["spacing"]
    if (factor is None) == (spacing is None):
        msg = f"factor is {shown(factor)} and spacing {shown(spacing)}, expected one of them"
        raise ParameterError(msg)
    for name in ("factor", "spacing", "min_spacing", "max_spacing"):
        value = values[name]
        if value is not None and not (name == "min_spacing" and factor is None and value == 0.0):
            check_positive(value, name)
    least, most = values["min_spacing"], values["max_spacing"]
    if most is not None and most < least:
        msg = f"max_spacing is {shown(most)}, expected min_spacing, {shown(least)}, or more"
        raise ParameterError(msg)
    if spacing is not None and not least <= spacing <= (math.inf if most is None else most):
        msg = f"spacing is {shown(spacing)}, expected it between min_spacing and max_spacing"
        raise ParameterError(msg)


def check_positive(value: Any, name: str) -> None:
    """Refuse what is no finite number above 0."""
    if not is_number(value) or not 0.0 < value < float("inf"):
        msg = f"{name} is {shown(value)}, expected a number above 0"
        raise ParameterError(msg)


def check_pattern(pattern: Any) -> None:
    """Refuse a pattern that is not made of L and S, or has no L."""
    if not isinstance(pattern, str) or "L" not in pattern or set(pattern) - {"L", "S"}:
        msg = f"pattern is {shown(pattern)}, expected letters L and S with an L: 'LS', 'LSS'"
        raise ParameterError(msg)
