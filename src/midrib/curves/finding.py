"""What a method of collapsing areas takes and returns."""

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeVar

from midrib.errors import ParameterError

if TYPE_CHECKING:
    from collections.abc import Callable

    from shapely import LineString

    from midrib.ends import End
    from midrib.layout import Scale
    from midrib.types import Floats, Ints

__all__ = ["Finder", "Found", "made"]

Made = TypeVar("Made")


class Found(NamedTuple):
    """A line as arrays: points, Z of each or None; loops cut, stations left out as bays, others."""

    points: "Floats"
    height: "Floats | None"
    loops: int
    bays: int = 0
    stations: int = 0


class Finder(Protocol):
    """Finds the line of one area."""

    def __call__(
        self,
        coordinates: "Floats",
        offsets: "Ints",
        along: "LineString | None",
        scale: "Scale",
        joints: "tuple[End, End] | None" = None,
    ) -> Found:
        """Return the line; ``joints`` are the ends it is to have, if they are given."""


def made(make: "Callable[..., Made]", method: str, options: dict[str, Any]) -> Made:
    """Return what a method makes of its options.

    Raises
    ------
    ParameterError
        If it has no such option.
    """
    try:
        return make(**options)
    except TypeError as error:
        found = str(error).partition("keyword argument ")[2] or str(error)
        msg = f"method {method!r} has no option {found}"
        raise ParameterError(msg) from error
