"""Keys: what the values of a standard may be."""

import math
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from midrib.checks import is_number, shown
from midrib.errors import ParameterError

__all__ = ["CONFIDENCES", "RULES", "STROKED", "checked", "is_length"]

CONFIDENCES = {
    "read": "figures read in the standard itself, or in a symbol file of its publisher",
    "documented": "figures from the documentation or the code of others",
    "assumed": "figures of our own, where none were found",
}
# Symbols made of strokes from top to toe, and those that stand on the axis or on the edges.
STROKED = ("line", "wedge", "triangle", "filled-triangle", "tapered", "y", "tadpole")
SYMBOLS = (*STROKED, "ticks", "circles", "template")
SHORTEST, LONGEST = 0.05, 0.95  # short strokes, as shares of long ones
OF_GAPS = ("matching", "mean")  # rules that a standard may have, of those of ``midrib.hatch``
OUTLINES = ("all", "top", "none")


def is_length(value: Any) -> bool:
    """Whether a value is a finite number above 0."""
    return is_number(value) and 0.0 < value < math.inf


def is_texts(value: Any) -> bool:
    """Whether a value is a list of texts, at least one."""
    return is_listed(value) and len(value) > 0 and all(isinstance(text, str) for text in value)


def is_listed(value: Any) -> bool:
    """Whether a value is a list or a tuple."""
    return isinstance(value, list | tuple)


def is_template(value: Any) -> bool:
    """Whether a value is a list of lines, lists of two or more pairs of finite numbers."""
    return (
        is_listed(value)
        and len(value) > 0
        and all(is_listed(line) and len(line) > 1 and all(map(is_pair, line)) for line in value)
    )


def is_pair(value: Any) -> bool:
    """Whether a value is a pair of finite numbers."""
    return (
        is_listed(value)
        and len(value) == 2
        and all(is_number(part) and math.isfinite(part) for part in value)
    )


def among(names: Iterable[str]) -> tuple[Callable[[Any], bool], str]:
    """Rule: one of some names."""
    known = tuple(names)
    return lambda value: isinstance(value, str) and value in known, ", ".join(map(repr, known))


def matches(pattern: str, wanted: str) -> tuple[Callable[[Any], bool], str]:
    """Rule: a text of some form."""
    form = re.compile(pattern)
    return lambda value: isinstance(value, str) and form.fullmatch(value) is not None, wanted


TEXT = (lambda value: isinstance(value, str) and value != "", "a text")
TEXTS = (is_texts, "a list of texts")
LENGTH = (is_length, "a length above 0 in millimetres on paper")
NUMBER = (is_length, "a number above 0")
SHARE = (lambda value: is_number(value) and 0.0 < value <= 1.0, "a number above 0, at most 1")
# What a value may be, by key.
RULES: dict[str, tuple[Callable[[Any], bool], str]] = {
    "title": TEXT,
    "source": TEXT,
    "confidence": among(CONFIDENCES),
    "kinds": TEXTS,
    "symbol": among(SYMBOLS),
    "stroke_width": LENGTH,
    "rule": among(OF_GAPS),
    "factor": NUMBER,
    "spacing": LENGTH,
    "min_spacing": (lambda value: value == 0 or is_length(value), "a length in millimetres"),
    "max_spacing": LENGTH,
    "gentle_factor": NUMBER,
    "gentle_run": NUMBER,
    "pattern": matches("S*L[LS]*", "L for long and S for short strokes, an L among them: LS"),
    "short_ratio": (
        lambda value: is_number(value) and (SHORTEST <= value <= LONGEST or value == 1.0),
        f"a number from {SHORTEST} to {LONGEST}, or 1",
    ),
    "wedge_below": (lambda value: value == 0 or is_length(value), "a length in millimetres"),
    "symbol_width": LENGTH,
    "pair": (lambda value: value == 0 or is_length(value), "a length in millimetres"),
    "angle": (lambda value: is_number(value) and 0.0 < value < 180.0, "degrees from 0 to 180"),
    "small_ratio": SHARE,
    "template": (is_template, "a list of lines, [x, y] pairs in widths"),
    "outline": among(OUTLINES),
    "outline_width": LENGTH,
    "outline_dash": (
        lambda value: is_listed(value) and len(value) % 2 == 0 and all(map(is_length, value)),
        "lengths of dash and gap in turn",
    ),
    "colour": matches("#[0-9a-fA-F]{6}", "a colour: #000000"),
    "code": TEXT,
    "assumed": TEXTS,
}


def checked(values: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Return values by key, lists made tuples.

    Raises
    ------
    ParameterError
        If there is no such key, or its value cannot be that.
    """
    for key, value in values.items():
        if key not in RULES:
            msg = f"{where} has a key {key!r}, expected one of {', '.join(RULES)}"
            raise ParameterError(msg)
        is_right, wanted = RULES[key]
        if not is_right(value):
            msg = f"{where}: key {key!r} is {shown(value)}, expected {wanted}"
            raise ParameterError(msg)
    unknown = [key for key in values.get("assumed", ()) if key not in RULES]
    if unknown:
        msg = f"{where}: key 'assumed' names {unknown[0]!r}, expected keys: {', '.join(RULES)}"
        raise ParameterError(msg)
    return {key: frozen(value) for key, value in values.items()}


def frozen(value: Any) -> Any:
    """Make tuples of lists, all the way down."""
    return tuple(map(frozen, value)) if is_listed(value) else value
