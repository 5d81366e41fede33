"""Each part of each area: what is found in it, and what is refused."""

from typing import TYPE_CHECKING, TypeVar

import numpy as np
import shapely

from midrib import interrupts
from midrib.curves.collapse import Log, valid_parts
from midrib.errors import MidribError
from midrib.geodesy import degree_lengths
from midrib.strip import PLANE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from shapely import Polygon

    from midrib.curves.taking import Taken
    from midrib.layout import Scale

__all__ = ["in_each_part"]

Found = TypeVar("Found")


def in_each_part(
    taken: "Taken",
    log: Log,
    find: "Callable[[Polygon, Scale], Found]",
    uncut: "Callable[[Found], Iterable[str]]" = lambda _: (),
) -> list[list[Found]]:
    """Find something in the parts of each area; nothing where they are refused or there are none.

    What ``uncut`` says of it is noted.

    Interrupts are looked for between areas.
    """
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
    return found
