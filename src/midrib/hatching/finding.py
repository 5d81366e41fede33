"""What checks of slopes look for, and what they find."""

from dataclasses import dataclass

from shapely import Point

__all__ = ["CHECKS", "CHECK_OF", "Finding"]

CHECKS = {
    "refused": "no slope, for want of a top, an area or good coordinates",
    "swapped": "the top is lower than the toe",
    "off-ring": "an edge, or its start or end, is off the boundary",
    "orientation": "it is doubtful which edge is the top",
    "pieces": "the top is stored in pieces: they were joined, or one was left out",
    "pairs": "lines alone do not tell which top goes with which toe",
    "unmatched": "strokes are left out or cut short, or there is none, in some place",
    "beyond": "strokes that are drawn exceed a bound, since the edges let none keep it",
    "crossing": "strokes that are drawn cross or lie on each other",
    "outside": "strokes that are drawn are outside of every slope, or stick out of theirs",
}
CHECK_OF = {"missing": "unmatched", "beyond": "beyond"}  # by the kinds of a hatching's problems


@dataclass(frozen=True)
class Finding:
    """Something that a check has found.

    Attributes
    ----------
    id : str
        Name of the slope, empty for strokes that are on none.
    check : str
        One of ``CHECKS``.
    reason : str
    where : Point or None
        The place, if there is one.
    """

    id: str
    check: str
    reason: str
    where: Point | None
