"""What is asked of a hatching: options that are refused before any work is done."""

from typing import Any, NamedTuple

import numpy as np

from midrib.checks import check_flag, is_number, shown
from midrib.errors import ParameterError
from midrib.hatching.rule import LEAST_LENGTH, Rule

__all__ = ["STIFFNESS", "Asked", "check_asked", "check_choice", "least_length"]

STIFFNESS = 0.9  # see hatch
MOST_STIFF = 100.0  # from there on all strokes of a slope are parallel
LARGEST = float(np.finfo(np.float64).max)
STARTS = ("left", "right", "first", "last")
RULES = ("matching", "mean", "paper")


class Asked(NamedTuple):
    """Options of ``hatch`` that say where strokes are and which way they go."""

    rule: str = "paper"
    start: str = "left"
    offset: float = 1.0
    end_strokes: bool = False
    stiffness: float = STIFFNESS
    top_share: float | None = None


def check_asked(asked: Asked, first: str | None, rule: Rule) -> None:
    """Refuse values that options cannot have, or not together.

    Raises
    ------
    ParameterError
        If there are any.
    """
    check_choice(asked.rule, "rule", RULES)
    check_choice(asked.start, "start", STARTS)
    check_choice(first, "first", (None, "long", "short"))
    if first == "short" and "S" not in rule.pattern:
        msg = f"first is 'short', but pattern {rule.pattern!r} has no short stroke"
        raise ParameterError(msg)
    check_flag(asked.end_strokes, "end_strokes")
    check_above_zero(asked.offset, "offset")
    check_above_zero(asked.stiffness, "stiffness", MOST_STIFF)
    share = asked.top_share
    if share is not None and not (is_number(share) and 0.0 <= share <= 1.0):
        msg = f"top_share is {shown(share)}, expected a number from 0 to 1"
        raise ParameterError(msg)
    if asked.rule == "paper" and asked._replace(top_share=share or None) != Asked():
        msg = "rule='paper' has no start, offset, end_strokes, stiffness and top_share, found "
        raise ParameterError(f"{msg}one of them")


def least_length(value: Any, rule: Rule, ground: float) -> float:
    """Length in coordinate units of the shortest whole stroke to draw."""
    if value is None:
        return LEAST_LENGTH * rule.least_gap
    if not is_number(value) or not 0.0 <= value < np.inf:
        msg = f"min_length is {shown(value)}, expected a number of 0 or more"
        raise ParameterError(msg)
    return float(value) * ground


def check_choice(value: Any, name: str, choices: tuple[str | None, ...]) -> None:
    """Refuse what is none of the choices."""
    if not (value is None or isinstance(value, str)) or value not in choices:
        msg = f"{name} is {shown(value)}, expected {' or '.join(map(repr, choices))}"
        raise ParameterError(msg)


def check_above_zero(value: Any, name: str, most: float = LARGEST) -> None:
    """Refuse what is no number above 0, or too large."""
    if not is_number(value) or not 0.0 < value <= most:
        bound = "" if most == LARGEST else f", {most:g} at most"
        msg = f"{name} is {shown(value)}, expected a number above 0{bound}"
        raise ParameterError(msg)
