"""Towers and chimneys: from a laser scan to the axis."""

from midrib.towers.pipeline import Options, axis_of
from midrib.towers.records import LEVELS, TowerAxis
from midrib.towers.sections import Section, section
from midrib.towers.simulate import Scan, Tower

__all__ = ["LEVELS", "Options", "Scan", "Section", "Tower", "TowerAxis", "axis_of", "section"]
