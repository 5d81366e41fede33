"""How far apart strokes are and how long: the rule of a standard, in ground units."""

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from midrib.checks import is_number, shown
from midrib.errors import ParameterError

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["LEAST_LENGTH", "Rule", "rule_of"]

LEAST_LENGTH = 0.25  # of the least gap: about the width of the line, shorter strokes are dots
MILLIMETRES = 1000.0
SHORTEST, LONGEST = 0.05, 0.95  # short strokes, of whole ones


class Standard(Protocol):
    """What a rule needs to know of a standard; lengths are millimetres on paper."""

    @property
    def factor(self) -> float | None:
        """Gap over length of stroke, None for fixed gaps."""

    @property
    def spacing(self) -> float | None:
        """Fixed gap, where there is no factor."""

    @property
    def min_spacing(self) -> float:
        """Least gap."""

    @property
    def max_spacing(self) -> float | None:
        """Largest gap, if there is one."""

    @property
    def pattern(self) -> str:
        """L and S in turn."""

    @property
    def short_ratio(self) -> float:
        """Length of a short stroke over that of a whole one."""


@dataclass(frozen=True)
class Rule:
    """The rule of a standard at a scale, in coordinate units.

    The gap between two strokes is ``clamp(factor w, min_spacing, max_spacing)`` where w is their
    length from top to toe, or ``spacing`` throughout.
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

    def gaps(self, width: "Floats") -> "Floats":
        """Gaps that the rule asks for beside strokes that are so long."""
        gaps: Floats = np.clip((self.factor or 0.0) * width, self.least_gap, self.largest_gap)
        return gaps


# The paper's formula b = (a + c) / 4, for the name that is the default, if there are no others.
STAND_IN = Rule(0.5, None, 0.72, None, "LS", 0.5)
STAND_IN_NAME = "pl-2021-slope-unreinforced"
STANDARDS = "midrib.hatching.standards"


def rule_of(standard: Any, scale: Any, metres_per_unit: Any, **overrides: Any) -> Rule:
    """Return the rule of a standard, given by name or as a record, with some values replaced.

    Raises
    ------
    ParameterError
        If a value is none that it can have.
    """
    check_positive(scale, "scale")
    check_positive(metres_per_unit, "metres_per_unit")
    ground = float(scale) / MILLIMETRES / float(metres_per_unit)
    found: Standard = standard_of(standard) if isinstance(standard, str) else standard
    names = ("factor", "spacing", "min_spacing", "max_spacing", "pattern", "short_ratio")
    missing = [name for name in names if not hasattr(found, name)]
    if missing:
        msg = f"standard is {shown(standard)}, expected a name or a Standard"
        raise ParameterError(msg)
    values: dict[str, Any] = {name: getattr(found, name) for name in names}
    given = {name: value for name, value in overrides.items() if value is not None}
    if "spacing" in given:  # it wins over the standard's factor
        values["factor"] = None
    values |= given
    for name in ("factor", "spacing", "min_spacing", "max_spacing"):
        if values[name] is not None:
            check_positive(values[name], name)
    if values["factor"] is None and values["spacing"] is None:
        msg = f"standard {shown(standard)} has neither factor nor spacing, expected one of them"
        raise ParameterError(msg)
    check_pattern(values["pattern"])
    ratio = values["short_ratio"]
    if not is_number(ratio) or not (SHORTEST <= ratio <= LONGEST or ratio == 1.0):
        msg = f"short_ratio is {shown(ratio)}, expected {SHORTEST} to {LONGEST}, or 1"
        raise ParameterError(msg)
    for name in ("spacing", "min_spacing", "max_spacing"):
        if values[name] is not None:
            values[name] = float(values[name]) * ground
    return Rule(**values)


def standard_of(name: str) -> Standard:
    """Return a standard by its name or path.

    Raises
    ------
    ParameterError
        If there is none.
    """
    if find_spec(STANDARDS) is not None:
        found: Standard = import_module(STANDARDS).standard(name)
        return found
    if name == STAND_IN_NAME:
        return STAND_IN
    msg = f"standard is {shown(name)}, expected {STAND_IN_NAME!r}"
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
