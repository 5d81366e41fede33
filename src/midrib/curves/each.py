"""Each part of each area: what is found in it, and what is refused."""

from typing import TYPE_CHECKING, Any, Generic, Literal, NamedTuple, TypeVar

import numpy as np
import shapely

from midrib import interrupts
from midrib.curves.log import Log, check_on_error
from midrib.curves.parts import valid_parts
from midrib.curves.taking import Taken, take
from midrib.errors import MidribError
from midrib.geodesy import degree_lengths
from midrib.strip import PLANE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray
    from shapely import Polygon

    from midrib.layout import Scale

__all__ = ["FoundInEach", "find_in_each"]

Found = TypeVar("Found")


class FoundInEach(NamedTuple, Generic[Found]):
    """What was found in the parts of each area."""

    taken: Taken
    parts: list[list[Found]]  # of each area: none where it is missing, empty or refused
    log: Log

    @property
    def flat(self) -> "NDArray[np.object_]":
        """Areas, on one axis."""
        return self.taken.array.ravel()

    def is_empty(self, i: int) -> bool:
        """Whether an area is there and has no part."""
        return self.flat[i] is not None and bool(self.flat[i].is_empty)

    def reported(self, result: Any) -> Any:
        """Return a result, with the problems if they were asked for."""
        return result if self.log.strict else (result, self.log.problems)


def find_in_each(
    areas: Any,
    find: "Callable[[Polygon, Scale], Found]",
    on_error: Literal["raise", "report"],
    geographic: bool | None,
    uncut: "Callable[[Found], Iterable[str]]" = lambda _: (),
) -> FoundInEach[Found]:
    """Take areas in, and find something in each part of each.

    What ``uncut`` says of it is noted. Interrupts are looked for between areas.
    """
    check_on_error(on_error)
    taken = take(areas, geographic)
    log = Log(taken.labels, strict=on_error == "raise")
    flat = taken.array.ravel()
    found: list[list[Found]] = [[] for _ in flat]
    with interrupts.deferred():
        for part in valid_parts(flat, log):
            interrupts.check()
            try:
                bounds = np.asarray(shapely.bounds(part.polygon))
                scale = degree_lengths(bounds) if taken.geographic else PLANE
                here = find(part.polygon, scale)
            except MidribError as error:
                log.refuse(part.area, part.number, error)
                continue
            found[part.area].append(here)
            for reason in uncut(here):
                log.note(part.area, part.number, "uncut", reason)
    return FoundInEach(taken, found, log)
