"""The methods that collapse areas, in one registry."""

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from midrib.checks import shown
from midrib.curves.construction import Construction
from midrib.curves.finding import Finder, Found, made
from midrib.curves.skeletons import trunk_finder
from midrib.curves.usual import usual_line
from midrib.errors import ParameterError
from midrib.layout import Scale
from midrib.ragged import normalised
from midrib.strip import divide

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapely import LineString

    from midrib.ends import End
    from midrib.types import Floats, Ints

__all__ = [
    "MEAN_CURVES",
    "OF_METHOD",
    "Method",
    "RadiiFinder",
    "construction_of_collapse",
    "finder_of",
    "methods",
]


@dataclass(frozen=True)
class Method:
    """One way to collapse an area.

    Attributes
    ----------
    name : str
        What ``collapse`` takes as ``method``.
    source : str
        Who described it, and when.
    has_branches : bool
        Whether it makes a skeleton, of which ``collapse`` returns the trunk.
    supports_holes : bool
    is_exact : bool
        Whether vertices of the line are where the method's definition puts them, but for rounding,
        and not as near as samples of the boundary allow. What lies between two vertices is
        straight: the arcs of a medial axis are chords within ``tolerance``, by default a 100th of
        the width.
    cost : str
        Time for n vertices.
    finder : callable
        Returns what finds lines, by the method's options.
    """

    name: str
    source: str
    has_branches: bool
    supports_holes: bool
    is_exact: bool
    cost: str
    finder: "Callable[..., Finder]"


USUAL: dict[str, Any] = {"ends": "caps", "centring": "centred", "end_clearance": None}


def construction_of_collapse(**options: Any) -> Construction:
    """Return the construction of ``collapse``, with its own defaults.

    The trunk does not enter bays, nor do its points collapse into a shared end; other curves keep
    the end clearance of ``minimal_radii``. The paper's curve leaves out stations in bays, unless a
    tolerance chooses them; a mean of two curves is not nearer to the trunk without, see
    docs/bays.md.
    """
    usual = USUAL
    centring = options.get("centring", "centred")
    if not isinstance(centring, str) or centring != "centred":  # an array cannot be compared
        usual = {"ends": "caps"}
        if isinstance(centring, str) and centring == "none" and options.get("tolerance") is None:
            usual["skip"] = "bays"
    return Construction(**(usual | options))


@dataclass(frozen=True)
class RadiiFinder:
    """Finds curves of minimal radii between the ends that the areas' shapes propose."""

    construction: Construction
    is_usual: bool  # whether one kernel does all of it

    def __call__(
        self,
        coordinates: "Floats",
        offsets: "Ints",
        along: "LineString | None",
        scale: Scale,
        joints: "tuple[End, End] | None" = None,
    ) -> Found:
        """Return the line of one area."""
        if self.is_usual and along is None and joints is None and coordinates.shape[1] == 2:
            found = usual_line(coordinates, offsets, scale)
            if found is not None:
                return found
        rings, height = normalised(coordinates, offsets)
        strip = divide(rings, height, scale, along=along, ends=joints)
        radii, path = self.construction.of(strip)
        bays, stations = radii.bays.size, radii.stations.size
        return Found(path.points, path.height, path.loops, bays, stations)


def minimal_radii_finder(**options: Any) -> RadiiFinder:
    """Curve of minimal radii between the ends that the area's shape proposes."""
    construction = construction_of_collapse(**options)
    plain = {"ends": construction.ends, "end_clearance": construction.end_clearance}
    usual = USUAL | {"channel": "shorter"}
    if construction.holes != "auxiliary":
        usual["holes"] = construction.holes  # those to be ignored are not there any more
    is_usual = (options | plain).items() <= usual.items()  # arrays would not compare
    return RadiiFinder(construction, is_usual)


MEAN_CURVES = ("proportional", "kinks")
# What makes other methods of the construction.
OF_METHOD: dict[str, dict[str, Any]] = {
    "mean-curve": {"centring": "symmetric", "mean": "proportional"}
}


def mean_curve_finder(**options: Any) -> Finder:
    """Rhino's mean curve: middles between points of the same share of either curve's length.

    With ``mean="kinks"`` these are the two sides themselves, from pair to pair of their kinks.
    """
    for name in sorted({"centring", "tolerance"} & options.keys()):
        msg = f"method 'mean-curve' has no option {name!r}"
        raise ParameterError(msg)
    mean = options.get("mean", "proportional")
    if not isinstance(mean, str) or mean not in MEAN_CURVES:
        msg = f"mean is {shown(mean)}, expected 'proportional' or 'kinks' for method 'mean-curve'"
        raise ParameterError(msg)
    return minimal_radii_finder(**(OF_METHOD["mean-curve"] | options))


METHODS = {
    method.name: method
    for method in (
        Method(
            name="minimal-radii",
            source="Buczek 2017",
            has_branches=False,
            supports_holes=True,
            is_exact=False,
            cost="n log n",
            finder=minimal_radii_finder,
        ),
        Method(
            name="mean-curve",
            source="Buczek 2017, section 7",
            has_branches=False,
            supports_holes=True,
            is_exact=False,
            cost="n log n",
            finder=mean_curve_finder,
        ),
        Method(
            name="medial-axis",
            source="Lee 1982",
            has_branches=True,
            supports_holes=True,
            is_exact=True,
            cost="n log n",
            finder=partial(trunk_finder, "medial-axis"),
        ),
        Method(
            name="chordal-axis",
            source="Bader and Weibel 1997",
            has_branches=True,
            supports_holes=True,
            is_exact=True,
            cost="n log n",
            finder=partial(trunk_finder, "chordal-axis"),
        ),
        Method(
            name="point-voronoi",
            source="Brandt and Algazi 1992",
            has_branches=True,
            supports_holes=True,
            is_exact=False,
            cost="m log m, for m points",
            finder=partial(trunk_finder, "point-voronoi"),
        ),
        Method(
            name="straight-skeleton",
            source="Aichholzer and Aurenhammer 1996",
            has_branches=True,
            supports_holes=True,
            is_exact=True,
            cost="n log n in practice",
            finder=partial(trunk_finder, "straight-skeleton"),
        ),
    )
}


def methods() -> list[Method]:
    """Return what ``collapse`` can do: name, source and capabilities of every method.

    Examples
    --------
    >>> [method.name for method in methods() if method.has_branches]
    ['medial-axis', 'chordal-axis', 'point-voronoi', 'straight-skeleton']
    """
    return list(METHODS.values())


def finder_of(name: str, **options: Any) -> Finder:
    """Return the finder of a method, with its options checked.

    Raises
    ------
    ParameterError
        If there is no such method, or it has no such option.
    """
    if not isinstance(name, str) or name not in METHODS:
        msg = f"method is {shown(name)}, expected {' or '.join(repr(known) for known in METHODS)}"
        raise ParameterError(msg)
    return made(METHODS[name].finder, name, options)
