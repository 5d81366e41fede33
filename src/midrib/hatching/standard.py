"""A standard: what a hatched object looks like on paper, lengths in millimetres."""

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from midrib.checks import shown
from midrib.errors import ParameterError
from midrib.hatching.keys import STROKED, checked, is_length

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Scales", "Standard", "consistent"]

BASE_SCALE = 500
Template: TypeAlias = tuple[tuple[tuple[float, float], ...], ...]
Scales: TypeAlias = tuple[tuple[int, dict[str, Any]], ...]


@dataclass(frozen=True)
class Standard:
    """How objects of some kinds are drawn; lengths in millimetres on paper.

    Attributes
    ----------
    name, title, source : str
        Its name, what it is, and where its figures are from.
    confidence : str
        ``"read"``, ``"documented"`` or ``"assumed"``, see ``CONFIDENCES``.
    kinds : tuple of str
        Kinds of objects that it is made for.
    symbol : str
        What is drawn, one of ``SYMBOLS``.
    stroke_width : float
        Width of the lines of the symbol.
    rule : str
        ``"matching"``: gaps are those of the local width; ``"mean"``: one for each slope, by its
        mean width, and strokes at right angles to the top.
    factor : float or None
        F of the spacing b = F w, for a local width w; None if the spacing is fixed.
    spacing : float or None
        The fixed spacing; None where there is a factor.
    min_spacing, max_spacing : float, float or None
        Bounds of b.
    gentle_factor, gentle_run : float or None
        F of slopes gentler than 1 : ``gentle_run``, where heights are known.
    pattern : str
        Long and short strokes in turn: ``"LS"``, ``"LSS"``, ``"L"``.
    short_ratio : float
        Share of the whole stroke that a short one has.
    wedge_below : float
        Strokes shorter than this are wedges.
    symbol_width : float
        Width of a wedge, triangle or head across its stroke; length of a tick.
    pair : float
        Distance of the two ticks of a pair; 0 for single ones.
    angle : float
        Of ticks to the edge, in degrees.
    small_ratio : float
        Diameter of a small circle over that of a large one in the same place.
    template : tuple of tuple of (float, float)
        Lines of a symbol in local widths: along the axis from its middle, and across.
    outline : str
        Which edges are drawn: ``"all"``, ``"top"`` or ``"none"``.
    outline_width : float
        Width of their line.
    outline_dash : tuple of float
        Dash, gap in turn; empty if the line is solid.
    colour : str
        ``"#rrggbb"``.
    code : str
        Cartographic code that registers give the symbol.
    assumed : tuple of str
        Keys whose values are our own, whatever the confidence in the others.
    by_scale : tuple of (int, dict)
        Values that differ at other scales than 1:500.
    """

    name: str
    title: str
    source: str
    confidence: str
    kinds: tuple[str, ...]
    symbol: str
    stroke_width: float
    rule: str = "matching"
    factor: float | None = None
    spacing: float | None = None
    min_spacing: float = 0.0
    max_spacing: float | None = None
    gentle_factor: float | None = None
    gentle_run: float | None = None
    pattern: str = "L"
    short_ratio: float = 1.0
    wedge_below: float = 0.0
    symbol_width: float = 0.5
    pair: float = 0.0
    angle: float = 45.0
    small_ratio: float = 0.5
    template: Template = ()
    outline: str = "none"
    outline_width: float = 0.18
    outline_dash: tuple[float, ...] = ()
    colour: str = "#000000"
    code: str = ""
    assumed: tuple[str, ...] = ()
    by_scale: Scales = field(default=(), repr=False, hash=False)

    def at(self, scale: float) -> "Standard":
        """Return the standard with the figures of the nearest scale that it has any for.

        Nearest by ratio: 1:700 is nearer to 1:500 than to 1:1000.
        """
        if not is_length(scale):
            msg = f"scale is {shown(scale)}, expected a number above 0: 500 for 1:500"
            raise ParameterError(msg)
        known: dict[int, dict[str, Any]] = {BASE_SCALE: {}, **dict(self.by_scale)}
        nearest = min(known, key=lambda other: abs(math.log(other / scale)))
        return replace(self, **known[nearest], by_scale=())

    def spacing_at(self, widths: "Floats") -> "Floats":
        """Spacing where objects are so wide, both in millimetres on paper."""
        apart = np.full(len(widths), self.spacing or 0.0)
        if self.factor is not None:
            apart = self.factor * widths
        most = np.inf if self.max_spacing is None else self.max_spacing
        clamped: Floats = np.clip(apart, self.min_spacing, most)
        return clamped

    def with_values(self, **values: Any) -> "Standard":
        """Return the standard with some values of the caller's, which hold at every scale.

        A spacing takes the place of a factor and of its bounds, and the other way round.

        Raises
        ------
        ParameterError
            If there is no such value, or it cannot be that.
        """
        where = f"standard {self.name!r}"
        values = checked(values, where)
        for key, other in (("spacing", "factor"), ("factor", "spacing")):
            if key in values:
                values.setdefault(other, None)
        if values.get("spacing") is not None:
            values = {"min_spacing": 0.0, "max_spacing": None} | values
        elsewhere = tuple(
            (scale, {key: value for key, value in some.items() if key not in values})
            for scale, some in self.by_scale
        )
        return consistent(replace(self, **values, by_scale=elsewhere), where)


def consistent(found: Standard, where: str) -> Standard:
    """Return a standard whose values go together.

    Raises
    ------
    ParameterError
        If they do not.
    """
    has_factor, has_spacing = found.factor is not None, found.spacing is not None
    rules = {
        f"a symbol {found.symbol!r} and no lines in key 'template'": found.symbol == "template"
        and not found.template,
        f"a symbol {found.symbol!r} and no key 'spacing'": found.symbol == "ticks"
        and not has_spacing,
        "both keys 'factor' and 'spacing', expected one of them": has_factor and has_spacing,
        "neither key 'factor' nor 'spacing', expected one of them": found.symbol
        in {*STROKED, "circles"}
        and not (has_factor or has_spacing),
        "one of the keys 'gentle_factor' and 'gentle_run', expected both or none": (
            found.gentle_factor is None
        )
        != (found.gentle_run is None),
        "a key 'max_spacing' below 'min_spacing'": found.max_spacing is not None
        and found.max_spacing < found.min_spacing,
        "a key 'spacing' that is not between 'min_spacing' and 'max_spacing'": (
            found.spacing is not None
            and not found.min_spacing <= found.spacing <= (found.max_spacing or math.inf)
        ),
    }
    for fault, is_there in rules.items():
        if is_there:
            msg = f"{where} has {fault}"
            raise ParameterError(msg)
    return found
