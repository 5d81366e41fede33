"""Standards: what a hatched object looks like on paper. Data, one TOML file each.

Users may have files of their own. Lengths are millimetres on paper. A file's name is the
standard's; its keys are the fields of ``Standard``. Figures for other scales than 1:500 stand in
tables ``[scale.1000]``. A file may build on another with ``base``; what it is called, where it is
from and how sure that is, it says itself.
"""

import tomllib
from dataclasses import MISSING, fields
from functools import cache
from pathlib import Path
from typing import Any

from midrib.checks import shown
from midrib.errors import ParameterError
from midrib.hatching.keys import RULES, checked
from midrib.hatching.standard import Scales, Standard, consistent

__all__ = ["standard", "standard_for", "standards", "standards_named"]

FOLDER = Path(__file__).with_name("standards")
ENDING = ".toml"
OWN = ("title", "source", "confidence")  # never taken from a base


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
