"""Standards: what a hatched object looks like on paper. Data, one TOML file each.

Users may have files of their own. Lengths are millimetres on paper. A file's name is the
standard's; its keys are the fields of ``Standard``. Figures for other scales than 1:500 stand in
tables ``[scale.1000]``. A file may build on another with ``base``; what it is called, where it is
from and how sure that is, it says itself.
"""

import math
import tomllib
from dataclasses import MISSING, dataclass, field, fields, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from midrib.checks import shown
from midrib.errors import ParameterError
from midrib.hatching.keys import RULES, STROKED, checked, is_length

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Standard", "standard", "standard_for", "standards", "standards_named"]

FOLDER = Path(__file__).with_name("standards")
ENDING = ".toml"
BASE_SCALE = 500
OWN = ("title", "source", "confidence")  # never taken from a base
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


NEEDED = tuple(f.name for f in fields(Standard) if f.name in RULES and f.default is MISSING)


@cache
def presets() -> dict[str, Standard]:
    """Return the standards that come with midrib, by name."""
    return {path.stem: read(path) for path in sorted(FOLDER.glob(f"*{ENDING}"))}


def standards() -> list[Standard]:
    """Return the standards that come with midrib.

    Returns
    -------
    list of Standard
        In alphabetical order.

    Examples
    --------
    >>> [standard.name for standard in standards() if standard.symbol == "circles"]
    ['pl-2015-conveyor']
    """
    return list(presets().values())


def standard(name: "str | Path | Standard", **values: Any) -> Standard:
    """Return a standard by its name, or read one from a file of your own.

    Parameters
    ----------
    name : str or Path
        One of ``midrib.standards()``, or the path of a TOML file. A Standard is passed through.
    **values
        Values that take the place of the standard's, in millimetres on paper.

    Returns
    -------
    Standard

    Raises
    ------
    ParameterError
        If there is no such standard, or a key or a value of it is wrong.

    Examples
    --------
    >>> standard("iof-104").spacing
    0.5
    >>> standard("iof-104", factor=0.25).spacing is None
    True
    """
    if isinstance(name, Standard):
        found = name
    elif str(name) in presets():
        found = presets()[str(name)]
    elif str(name).endswith(ENDING):
        found = read(Path(name))
    else:
        msg = f"standard is {shown(name)}, expected one of {', '.join(presets())}, or a .toml file"
        raise ParameterError(msg)
    return found.with_values(**values)


def standards_named(name: "str | Path | Standard") -> list[Standard]:
    """Return the standard of a name, or all that begin with it: ``"pl-2015"`` for ``pl-2015-…``.

    Raises
    ------
    ParameterError
        If there is none.
    """
    family = [known for key, known in presets().items() if key.startswith(f"{name}-")]
    return family or [standard(name)]


def standard_for(name: "str | Path | Standard", kind: str) -> Standard | None:
    """Return that one of ``standards_named`` which is made for a kind of object, None if none is.

    Examples
    --------
    >>> standard_for("pl-2015", "embankment").name
    'pl-2015-dyke'
    """
    return next((known for known in standards_named(name) if kind in known.kinds), None)


def read(path: Path, above: tuple[Path, ...] = ()) -> Standard:
    """Read a standard from a file; ``above`` are the files that build on it.

    Raises
    ------
    ParameterError
        If the file cannot be read, or a key or a value in it is wrong.
    """
    where = f"standard {str(path)!r}"
    try:
        values = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        msg = f"{where} cannot be read: {getattr(error, 'strerror', None) or error}"
        raise ParameterError(msg) from error
    except tomllib.TOMLDecodeError as error:
        msg = f"{where} is no TOML: {error}"
        raise ParameterError(msg) from error
    values = based(values, path, above) | {"name": path.stem}
    missing = [key for key in NEEDED if key not in values]
    if missing:
        msg = f"{where} has no key {missing[0]!r}, expected {RULES[missing[0]][1]}"
        raise ParameterError(msg)
    found = consistent(Standard(**values), where)
    for scale, _ in found.by_scale:
        consistent(found.at(scale), f"{where} [scale.{scale}]")
    return found


def based(values: dict[str, Any], path: Path, above: tuple[Path, ...]) -> dict[str, Any]:
    """Return the values of a file, on top of those of its base."""
    where = f"standard {str(path)!r}"
    base, scales = values.pop("base", None), values.pop("scale", {})
    own = checked(values, where) | {"by_scale": by_scale(scales, where)}
    if base is None:
        return own
    below = base_of(base, path, (*above, path.resolve())).with_values(**values)
    inherited = {f.name: getattr(below, f.name) for f in fields(below) if f.name not in OWN}
    return inherited | own | {"by_scale": own["by_scale"] or below.by_scale}


def base_of(base: Any, path: Path, above: tuple[Path, ...]) -> Standard:
    """Return the standard that the one in a file builds on: a preset, or a file beside it."""
    if isinstance(base, str) and base.endswith(ENDING):
        place = path.parent / base
        if place.resolve() in above:
            msg = f"standard {str(path)!r}: key 'base' is {base!r}, which builds on this one"
            raise ParameterError(msg)
        return read(place, above)
    if not isinstance(base, str) or base not in presets():
        msg = f"standard {str(path)!r}: key 'base' is {shown(base)}, expected one of "
        raise ParameterError(f"{msg}{', '.join(presets())}, or a .toml file")
    return presets()[base]


def by_scale(scales: Any, where: str) -> Scales:
    """Return the values for other scales."""
    if not isinstance(scales, dict) or not all(
        key.isdecimal() and int(key) > 0 and isinstance(value, dict)
        for key, value in scales.items()
    ):
        msg = f"{where}: key 'scale' is {shown(scales)}, expected tables [scale.1000]"
        raise ParameterError(msg)
    return tuple(
        (int(key), checked(values, f"{where} [scale.{key}]")) for key, values in scales.items()
    )


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
