"""Strokes from the top of a slope to its toe."""

from midrib.hatching.editing import add_stroke, delete_stroke, move_stroke
from midrib.hatching.finishing import Problem
from midrib.hatching.hatch import Hatching, hatch
from midrib.hatching.rule import Rule

__all__ = [
    "Hatching",
    "Problem",
    "Rule",
    "add_stroke",
    "delete_stroke",
    "hatch",
    "move_stroke",
]
