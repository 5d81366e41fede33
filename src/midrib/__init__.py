"""midrib: one unbranched line inside a long area.

Names are imported when they are first used, so that ``midrib --help`` need not wait for them.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from midrib import measures
    from midrib.comparison import Comparison, compare
    from midrib.curves.collapse import collapse
    from midrib.curves.control import ControlPoints, control_points
    from midrib.curves.label import Labels, label_line
    from midrib.curves.log import Joint, Problem
    from midrib.curves.methods import methods
    from midrib.curves.minimal_radii import Curve, minimal_radii
    from midrib.curves.network import network
    from midrib.curves.partial import Partial, partial_collapse
    from midrib.curves.skeleton import Skeleton, skeleton
    from midrib.curves.space import SpaceCurve, minimal_radii_3d
    from midrib.formats.drawing.slopes import draw_slopes
    from midrib.formats.drawing.write import write_drawing
    from midrib.formats.slopes import Slope, read_slopes
    from midrib.hatching.checking import check_slopes
    from midrib.hatching.finding import Finding
    from midrib.hatching.hatch import Hatching, hatch
    from midrib.hatching.standard import Standard
    from midrib.hatching.standards import standard, standards
    from midrib.profiles import Profile, add_widths, profile
    from midrib.scans import tower_axis
    from midrib.strip import Strip, split

__version__ = "0.1.0"
__all__ = [
    "Comparison",
    "ControlPoints",
    "Curve",
    "Finding",
    "Hatching",
    "Joint",
    "Labels",
    "Partial",
    "Problem",
    "Profile",
    "Skeleton",
    "Slope",
    "SpaceCurve",
    "Standard",
    "Strip",
    "add_widths",
    "check_slopes",
    "collapse",
    "compare",
    "control_points",
    "draw_slopes",
    "hatch",
    "label_line",
    "measures",
    "methods",
    "minimal_radii",
    "minimal_radii_3d",
    "network",
    "partial_collapse",
    "profile",
    "read_slopes",
    "skeleton",
    "split",
    "standard",
    "standards",
    "tower_axis",
    "write_drawing",
]

HOME = {
    "Comparison": "midrib.comparison",
    "ControlPoints": "midrib.curves.control",
    "Curve": "midrib.curves.minimal_radii",
    "Finding": "midrib.hatching.finding",
    "Hatching": "midrib.hatching.hatch",
    "Joint": "midrib.curves.log",
    "Labels": "midrib.curves.label",
    "Partial": "midrib.curves.partial",
    "Problem": "midrib.curves.log",
    "Profile": "midrib.profiles",
    "Skeleton": "midrib.curves.skeleton",
    "Slope": "midrib.formats.slopes",
    "SpaceCurve": "midrib.curves.space",
    "Standard": "midrib.hatching.standard",
    "Strip": "midrib.strip",
    "add_widths": "midrib.profiles",
    "check_slopes": "midrib.hatching.checking",
    "collapse": "midrib.curves.collapse",
    "compare": "midrib.comparison",
    "control_points": "midrib.curves.control",
    "draw_slopes": "midrib.formats.drawing.slopes",
    "hatch": "midrib.hatching.hatch",
    "label_line": "midrib.curves.label",
    "methods": "midrib.curves.methods",
    "minimal_radii": "midrib.curves.minimal_radii",
    "minimal_radii_3d": "midrib.curves.space",
    "network": "midrib.curves.network",
    "partial_collapse": "midrib.curves.partial",
    "profile": "midrib.profiles",
    "read_slopes": "midrib.formats.slopes",
    "skeleton": "midrib.curves.skeleton",
    "split": "midrib.strip",
    "standard": "midrib.hatching.standards",
    "standards": "midrib.hatching.standards",
    "tower_axis": "midrib.scans",
    "write_drawing": "midrib.formats.drawing.write",
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
