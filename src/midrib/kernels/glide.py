"""How a line glides from an end that is off the trunk onto it: less and less away from the end."""

from typing import NamedTuple

from midrib.kernels.banks import Banks
from midrib.kernels.jit import njit
from midrib.kernels.leaning import is_level, lean_at
from midrib.kernels.lengths import length
from midrib.kernels.paths import Beads
from midrib.types import Ints

__all__ = ["Ends", "allowance", "ends_of", "is_before_end"]

GLIDE = 2.0  # beads nearer to an end than so many times what it is off the trunk are left out
TINY = 2.0**-1000


class Ends(NamedTuple):
    """End points that the line has to reach, though they may be off the trunk; in lengths."""

    are_given: bool
    x0: float
    y0: float
    off_0: float
    reach_0: float
    x1: float
    y1: float
    off_1: float
    reach_1: float


@njit(borrows=True)
def ends_of(
    banks: Banks,
    beads: Beads,
    near: Ints,
    are_given: bool,
    apart: float,
    scale_x: float,
    scale_y: float,
) -> Ends:
    """Return the ends of a path, the first and the last bead if they are; note what is near."""
    n = beads.side.size
    x0, y0, x1, y1 = 0.0, 0.0, 0.0, 0.0
    off_0, off_1, reach_0, reach_1 = 0.0, 0.0, 0.0, 0.0
    if are_given:
        x0, y0 = beads.point[0, 0] * scale_x, beads.point[0, 1] * scale_y
        x1, y1 = beads.point[n - 1, 0] * scale_x, beads.point[n - 1, 1] * scale_y
        off_0, reach_0 = off_and_reach(banks, apart, x0, y0)
        near[0, 0], near[0, 1] = banks.last[0], banks.last[1]
        off_1, reach_1 = off_and_reach(banks, apart, x1, y1)
        near[n - 1, 0], near[n - 1, 1] = banks.last[0], banks.last[1]
    return Ends(are_given, x0, y0, off_0, reach_0, x1, y1, off_1, reach_1)


@njit(borrows=True)
def off_and_reach(banks: Banks, apart: float, x: float, y: float) -> tuple[float, float]:
    """How far an end is off the trunk, and how far from it the line may still be on its way."""
    lean = lean_at(banks, x, y)
    if is_level(lean, banks.slack):
        return 0.0, apart
    off = abs(lean.value) / 2.0
    return off, max(min(GLIDE * off, lean.to_main + lean.to_auxiliary), apart)


@njit(borrows=True)
def is_before_end(ends: Ends, x: float, y: float) -> bool:
    """Whether a point is so near to an end that the line has not come to the trunk yet."""
    return ends.are_given and (
        length(x - ends.x0, y - ends.y0) <= ends.reach_0
        or length(x - ends.x1, y - ends.y1) <= ends.reach_1
    )


@njit(borrows=True)
def allowance(ends: Ends, x: float, y: float) -> float:
    """How far off the trunk a point may be because an end is: less and less away from it."""
    if not ends.are_given:
        return 0.0
    first = 1.0 - length(x - ends.x0, y - ends.y0) / (2.0 * ends.reach_0 + TINY)
    last = 1.0 - length(x - ends.x1, y - ends.y1) / (2.0 * ends.reach_1 + TINY)
    return ends.off_0 * max(first, 0.0) + ends.off_1 * max(last, 0.0)
