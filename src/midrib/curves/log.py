"""What there is to say about areas: refused, repaired, and what was found beside lines."""

import sys
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from shapely import Point

from midrib.checks import shown
from midrib.errors import MidribError, ParameterError, RepairedAreaWarning, TooManyStationsError

if TYPE_CHECKING:
    from midrib.curves.connecting import Joined
    from midrib.curves.parts import Part

__all__ = ["Joint", "Log", "Problem", "check_on_error", "steps_to_caller"]


@dataclass(frozen=True)
class Problem:
    """What there is to say about an area: refused, repaired, loops cut, bays left out, uncut."""

    index: Any  # position of the area, or its label in a GeoSeries
    part: int  # of a MultiPolygon, else 0
    status: Literal[
        "refused", "repaired", "loops cut", "bays left out", "joint", "no joint", "uncut"
    ]
    reason: str


@dataclass(frozen=True)
class Joint(Problem):
    """What has become of an edge that two areas share: a joint of their lines, or none."""

    other: Any  # the second area, as ``index``
    other_part: int
    point: Point  # where the lines meet, or the middle of the edge
    kind: Literal["end to end", "side", "none"]  # side: the line of ``index`` ends on the other's


def check_on_error(on_error: Any) -> None:
    """Refuse what is no way to tell of areas that are refused."""
    if not isinstance(on_error, str) or on_error not in ("raise", "report"):
        msg = f"on_error is {shown(on_error)}, expected 'raise' or 'report'"
        raise ParameterError(msg)


def steps_to_caller() -> int:
    """How many calls up the one is that has called midrib, for a warning to name its line."""
    steps, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals["__name__"].split(".")[0] == "midrib":
        steps, frame = steps + 1, frame.f_back
    return steps


class Log:
    """What went wrong where; a strict one raises at the first refusal, any at absurd options."""

    def __init__(self, labels: Sequence[Any] | None, *, strict: bool) -> None:
        self.problems: list[Problem] = []
        self.labels, self.strict = labels, strict
        self.refused: set[tuple[int, int]] = set()  # areas by position, and parts

    def label(self, index: int) -> Any:
        """Name of an area: its label in a GeoSeries, else its position."""
        return index if self.labels is None else self.labels[index]

    def refuse(self, index: int, part: int, error: MidribError) -> None:
        """Record that an area (part) has no line, and why."""
        if self.strict or isinstance(error, TooManyStationsError):
            raise type(error)(self.sentence(index, part, str(error))) from error
        self.refused.add((index, part))
        self.problems.append(Problem(self.label(index), part, "refused", str(error)))

    def note(
        self,
        index: int,
        part: int,
        status: Literal["repaired", "loops cut", "bays left out", "uncut"],
        reason: str,
    ) -> None:
        """Record something about a line that is there; a strict log warns of repairs."""
        if not self.strict:
            self.problems.append(Problem(self.label(index), part, status, reason))
        elif status == "repaired":
            message = self.sentence(index, part, f"repaired: {reason}")
            warnings.warn(message, RepairedAreaWarning, stacklevel=steps_to_caller())

    def join(self, joined: "Joined", one: "Part", two: "Part") -> None:
        """Record what has become of an edge that two areas share."""
        if self.strict:
            return
        name, x, y = f"areas[{self.label(two.area)}]", *joined.point
        status: Literal["joint", "no joint"] = "no joint" if joined.kind == "none" else "joint"
        reason = f"{joined.kind} with {name} at ({x:.12g}, {y:.12g})"
        if joined.kind == "none":
            reason = f"edge shared with {name} at ({x:.12g}, {y:.12g}): {joined.reason}"
        of, other = (self.label(one.area), one.number), (self.label(two.area), two.number)
        self.problems.append(Joint(*of, status, reason, *other, Point(x, y), joined.kind))

    def sentence(self, index: int, part: int, text: str) -> str:
        """Text with the area it is about."""
        return f"areas[{self.label(index)}]{f' part {part}' if part else ''}: {text}"
