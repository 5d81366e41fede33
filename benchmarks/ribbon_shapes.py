r"""Ribbons with a known axis: areas that are drawn around the line that should be found.

          bank
    o---o---o---o---o         c(s)   axis, r(s) half the width there
    :       | r(s)   :        banks  where discs of radius r about c end (their envelope), so that
    :. . . .o. . . . :  axis         c is their medial axis exactly; roughness is put on top
    :       | r(s)   :
    o---o---o---o---o
          bank

A ribbon is 40 widths long and lies where projected coordinates do, turned at random. Of islands
only the banks' axis is known; where to pass them, the medial axis says (``reference``).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from shapely import Polygon

from families import FALSE_ORIGIN, Case, Floats, Rng, meanders

__all__ = ["KINDS", "Ribbon", "make_ribbon"]

WIDTH = 20.0
LONG = 40  # widths
FINE = 20  # places on the axis for each width; banks have half as many vertices
BENDS = 2  # waves of a smooth ribbon: radii are above 1.7 widths
TIGHT = 0.75  # radius of tight bends, in widths
STRAIGHT = 3.0  # straight run between tight bends, in widths
TAPER = 5.0  # width at one end over width at the other
TIP = 1.5  # length of a sharp end, in widths
ISLANDS, ISLAND_HALF, ISLAND_ASIDE, ISLAND_CORNERS = 3, (1.25, 0.2), 0.1, 24  # in widths


@dataclass(frozen=True, eq=False)
class Course:
    """An axis with what is needed to put banks beside it."""

    points: Floats  # (k, 2)
    heading: Floats  # (k,) radians
    radius: Floats  # (k,) half the width
    every: tuple[int, int] = (2, 2)  # so many places of the axis for one vertex, left and right
    rough: float = 0.0  # largest displacement of a vertex of a bank, in widths
    ends: str = "flat"


@dataclass(frozen=True, eq=False)
class Ribbon:
    """An area with its axis from end to end, and the width along it; with islands, without."""

    case: Case
    axis: Floats  # (k, 2)
    width: Floats  # (k,) of the area at the axis, as its envelope has it


def make_ribbon(kind: str, seed: int) -> Ribbon:
    """Ribbon of a kind."""
    rng = np.random.default_rng([seed, list(KINDS).index(kind)])
    return around(kind, KINDS[kind](rng), rng)


def around(kind: str, course: Course, rng: Rng) -> Ribbon:
    """Put banks, ends and islands about an axis."""
    ahead = np.column_stack([np.cos(course.heading), np.sin(course.heading)])
    aside = np.column_stack([-ahead[:, 1], ahead[:, 0]])
    step = np.hypot(*np.diff(course.points, axis=0).T)
    slope = np.gradient(course.radius, np.append(0.0, np.cumsum(step)))
    banks = []
    for side, every in zip((1.0, -1.0), course.every, strict=True):
        places = places_of_vertices(len(ahead), every, rng)
        r = course.radius[:, None]
        across = side * np.sqrt(1.0 - slope[:, None] ** 2) * aside - slope[:, None] * ahead
        bank = (course.points + r * across)[places]
        bank += rng.uniform(-1, 1, len(bank))[:, None] * course.rough * WIDTH * aside[places]
        banks.append(bank)
    left, right = banks
    start, axis_start = cap(course.ends, course.points[0], -ahead[0], right[0], left[0])
    end, axis_end = cap(course.ends, course.points[-1], ahead[-1], left[-1], right[-1])
    axis = np.vstack([axis_start, course.points, axis_end])
    width = 2.0 * np.interp(along(axis), along(course.points) + len_of(axis_start), course.radius)
    ring = np.vstack([start, left, end, right[::-1]])
    place = placed(rng)
    islands = [place(hole) for hole in islands_on(course, aside, rng)] if "island" in kind else []
    area = Polygon(place(ring), islands)
    if not area.is_valid:
        msg = f"a ribbon of kind {kind} meets itself"
        raise RuntimeError(msg)
    axis = place(axis)
    ends = axis[[0, -1]]
    case = Case(kind, len(ring), area, ends, place(left), place(right))
    return Ribbon(case, axis, width)


def places_of_vertices(count: int, every: int, rng: Rng) -> NDArray[np.intp]:
    """Draw one of every so many places; two banks know nothing of each other's."""
    stretch = np.arange(0, count - every, every)
    inner = stretch + rng.integers(0, every, len(stretch))
    return np.unique(np.concatenate([[0], inner, [count - 1]]))


def cap(
    ends: str, centre: Floats, ahead: Floats, first: Floats, last: Floats
) -> tuple[Floats, Floats]:
    """Vertices of the boundary between the banks' ends, and how the axis goes on to its own."""
    if ends == "flat":
        return np.empty((0, 2)), np.empty((0, 2))
    radius = np.hypot(*(first - last)) / 2.0
    if ends == "sharp":
        tip = centre + TIP * WIDTH * ahead
        return tip[None], tip[None]
    turn = np.linspace(0.0, np.pi, 17)[1:-1, None]
    arc = centre + np.cos(turn) * (first - centre) + np.sin(turn) * radius * ahead
    return arc, (centre + radius * ahead)[None]


def along(points: Floats) -> Floats:
    """Arc length at each point of a chain."""
    return np.append(0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))


def len_of(beginning: Floats) -> float:
    """Length by which an end has been put before an axis: of none, nothing."""
    return TIP * WIDTH if len(beginning) else 0.0


def placed(rng: Rng) -> Callable[[Floats], Floats]:
    """Turn at random, and shift to where projected coordinates are."""
    angle = rng.uniform(0.0, 2.0 * np.pi)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return lambda points: points @ turn + FALSE_ORIGIN


def islands_on(course: Course, aside: Floats, rng: Rng) -> list[Floats]:
    """Lenses along the axis, a little to one side of it."""
    angle = np.linspace(0.0, 2.0 * np.pi, ISLAND_CORNERS, endpoint=False)
    long, wide = ISLAND_HALF
    islands = []
    for k in range(ISLANDS):
        middle = (k + rng.uniform(0.35, 0.65)) / ISLANDS * LONG * FINE
        at = middle + long * FINE * np.cos(angle)
        off = (wide * np.sin(angle) + rng.choice([-1, 1]) * ISLAND_ASIDE) * WIDTH
        index = np.arange(len(aside))
        islands.append(
            np.column_stack(
                [
                    np.interp(at, index, course.points[:, d])
                    + off * np.interp(at, index, aside[:, d])
                    for d in (0, 1)
                ]
            )
        )
    return islands


def smooth(rng: Rng) -> Course:
    """Meanders of constant width."""
    m = LONG * FINE + 1
    x, y, heading = meanders(rng, m, WIDTH / FINE, count=BENDS)
    return Course(np.column_stack([x, y]), heading, np.full(m, WIDTH / 2.0))


def tapering(rng: Rng) -> Course:
    """Meanders that grow narrower, on average a width wide."""
    course = smooth(rng)
    share = np.linspace(1.0, TAPER, len(course.radius))
    return replace(course, radius=share[:: rng.choice([-1, 1])] / share.mean() * WIDTH / 2.0)


def tight(rng: Rng) -> Course:
    """Straight runs joined by arcs whose radius is less than the width."""
    heading: list[float] = []
    step, angle, sign = WIDTH / FINE, 0.0, 1.0
    while len(heading) < LONG * FINE:
        turn = sign * rng.uniform(1.0, 1.3) - angle
        count = int(np.ceil(abs(turn) * TIGHT * FINE))
        heading += list(angle + turn * np.arange(1, count + 1) / count)
        angle, sign = angle + turn, -sign
        heading += [angle] * int(STRAIGHT * FINE)
    turned = np.array(heading)
    middle = (turned[1:] + turned[:-1]) / 2.0
    steps = step * np.column_stack([np.cos(middle), np.sin(middle)])
    points = np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])
    return Course(points, turned, np.full(len(points), WIDTH / 2.0))


def uneven(rng: Rng) -> Course:
    """Meanders with ten times as many vertices on one bank as on the other."""
    few, many = FINE // 2, 1
    return replace(smooth(rng), every=(few, many) if rng.random() < 0.5 else (many, few))


KINDS: dict[str, Callable[[Rng], Course]] = {
    "smooth banks, flat ends": smooth,
    "round ends": lambda rng: replace(smooth(rng), ends="round"),
    "sharp ends": lambda rng: replace(smooth(rng), ends="sharp"),
    "rough banks, .05 w": lambda rng: replace(smooth(rng), rough=0.05),
    "rough banks, .1 w": lambda rng: replace(smooth(rng), rough=0.1),
    "uneven vertices, 1:10": uneven,
    "tapering, 1:5": tapering,
    "tight bends, radius .75 w": tight,
    "islands": smooth,
}
