"""Variants of methods: a method with a value of its main option, under one name.

``minimal-radii:none`` is the method ``minimal-radii`` with ``centring="none"``, the paper's curve.
"""

from typing import Any

from midrib.checks import shown
from midrib.curves.construction import CENTRINGS
from midrib.curves.methods import MEAN_CURVES, methods
from midrib.errors import ParameterError

__all__ = ["PAPER", "usual_variants", "variant_of", "variants"]

PAPER = "minimal-radii:none"
MAIN_OPTION: dict[str, tuple[str, tuple[str, ...]]] = {
    "minimal-radii": ("centring", CENTRINGS),
    "mean-curve": ("mean", MEAN_CURVES),
}


def variants() -> dict[str, tuple[str, dict[str, Any]]]:
    """Names of all methods and their variants, with the method and the option each stands for."""
    found: dict[str, tuple[str, dict[str, Any]]] = {}
    for method in methods():
        found[method.name] = method.name, {}
        option, values = MAIN_OPTION.get(method.name, ("", ()))
        for value in values:
            found[f"{method.name}:{value}"] = method.name, {option: value}
    return found


def usual_variants() -> list[str]:
    """Names of all methods as they come, the paper's curve after the first."""
    first, *others = (method.name for method in methods())
    return [first, PAPER, *others]


def variant_of(name: Any) -> tuple[str, dict[str, Any]]:
    """Return the method that a name stands for, and its options.

    Raises
    ------
    ParameterError
        If there is no such method or variant.
    """
    known = variants()
    if not isinstance(name, str) or name not in known:
        msg = f"method is {shown(name)}, expected {' or '.join(map(repr, known))}"
        raise ParameterError(msg)
    return known[name]
