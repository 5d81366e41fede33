"""midrib: one unbranched line inside a long area.

Names are imported when they are first used, so that ``midrib --help`` need not wait for them.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from midrib import measures
    from midrib.curves.collapse import Joint, Problem, collapse
    from midrib.curves.methods import methods
    from midrib.curves.minimal_radii import Curve, minimal_radii
    from midrib.strip import Strip, split

__version__ = "0.1.0"
__all__ = [
    "Curve",
    "Joint",
    "Problem",
    "Strip",
    "collapse",
    "measures",
    "methods",
    "minimal_radii",
    "split",
]

HOME = {
    "Curve": "midrib.curves.minimal_radii",
    "Joint": "midrib.curves.collapse",
    "Problem": "midrib.curves.collapse",
    "Strip": "midrib.strip",
    "collapse": "midrib.curves.collapse",
    "methods": "midrib.curves.methods",
    "minimal_radii": "midrib.curves.minimal_radii",
    "split": "midrib.strip",
}


def __getattr__(name: str) -> object:
    """Import a public name from the module it lives in."""
    if name == "measures":  # a module itself
        return import_module("midrib.measures")
    if name not in HOME:
        msg = f"module 'midrib' has no attribute {name!r}"
        raise AttributeError(msg)
    value = getattr(import_module(HOME[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Public names."""
    return sorted([*globals(), *__all__])
