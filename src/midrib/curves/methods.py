"""The methods that collapse areas, in one registry."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from midrib.curves.joining import check_ends, join_middles
from midrib.curves.radii import draw_radii
from midrib.curves.stations import station_rule
from midrib.errors import InvalidAreaError, ParameterError
from midrib.layout import Scale
from midrib.strip import divide

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapely import LineString

    from midrib.ends import End
    from midrib.kernels.rings import Rings
    from midrib.types import Floats

__all__ = ["Finder", "Found", "Method", "finder_of", "methods"]


class Found(NamedTuple):
    """A line as arrays: points, Z of each or None, and the number of loops cut."""

    points: "Floats"
    height: "Floats | None"
    loops: int


class Finder(Protocol):
    """Finds the line of one area."""

    def __call__(
        self,
        rings: "Rings",
        height: "Floats | None",
        along: "LineString | None",
        scale: Scale,
        joints: "tuple[End, End] | None" = None,
    ) -> Found:
        """Return the line; ``joints`` are the ends it is to have, if they are given."""


@dataclass(frozen=True)
class Method:
    """One way to collapse an area."""

    name: str
    source: str
    supports_holes: bool
    is_exact: bool
    cost: str
    finder: "Callable[..., Finder]"


def minimal_radii_finder(
    *,
    ends: Any = "caps",
    end_clearance: Any = "proportional",
    skip: Any = "bays",
    **stations: Any,
) -> "Finder":
    """Curve of minimal radii between the ends that the area's shape proposes."""
    check_ends(ends, end_clearance)
    rule = station_rule(skip=skip, **stations)

    def find(
        rings: "Rings",
        height: "Floats | None",
        along: "LineString | None",
        scale: Scale,
        joints: "tuple[End, End] | None" = None,
    ) -> Found:
        layout = divide(rings, height, scale, along=along, ends=joints)
        radii = draw_radii(layout, rule, end_clearance)
        if len(radii.points) == 0:
            msg = "no station of the main curve sees anything of the auxiliary curve"
            raise InvalidAreaError(msg)
        path = join_middles(layout, radii, ends)
        return Found(path.points, path.height, path.loops)

    return find


METHODS = {
    method.name: method
    for method in (
        Method(
            name="minimal-radii",
            source="Buczek 2017",
            supports_holes=True,
            is_exact=False,
            cost="n log n",
            finder=minimal_radii_finder,
        ),
    )
}


def methods() -> list[Method]:
    """Return what ``collapse`` can do: name, source and capabilities of every method.

    Examples
    --------
    >>> [method.name for method in methods()]
    ['minimal-radii']
    """
    return list(METHODS.values())


def finder_of(name: str, **options: Any) -> "Finder":
    """Return the finder of a method, with its options checked.

    Raises
    ------
    ParameterError
        If there is no such method, or it has no such option.
    """
    if name not in METHODS:
        msg = f"method is {name!r}, expected {' or '.join(repr(known) for known in METHODS)}"
        raise ParameterError(msg)
    try:
        return METHODS[name].finder(**options)
    except TypeError as error:
        found = str(error).partition("keyword argument ")[2] or str(error)
        msg = f"method {name!r} has no option {found}"
        raise ParameterError(msg) from error
