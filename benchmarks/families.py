"""Ten families of long areas, made from numbers: the same call always gives the same area.

                  left bank
       ,------------------------------.
    e0 |                              | e1      e0, e1   the ends a person would expect
       '------------------------------'
                  right bank

Rivers, embankments, strips with waists and strips with holes grow longer with the number of
vertices; the other families keep their shape and only get more vertices.

Rewritten from ``corpus.py`` (MIT licence, made for this project), which drew the first tables of
rivals; draws come in the same order, so coordinates are bit for bit the same.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import Polygon

__all__ = ["DENSER", "FAMILIES", "GROWING", "Case", "make", "mixed"]

Floats: TypeAlias = NDArray[np.float64]
Rng: TypeAlias = np.random.Generator

# The order is part of the seed.
FAMILIES = (
    "river",
    "river_dense",
    "embankment",
    "waist",
    "holes",
    "rect",
    "lshape",
    "ushape",
    "sshape",
    "star",
)
GROWING = ("river", "embankment", "waist", "holes")
DENSER = tuple(family for family in FAMILIES if family not in GROWING)
SMALL = 100  # areas of so few vertices get longer steps, so that they are still long areas
FALSE_ORIGIN = np.array([5e5, 5.6e6])  # rivers lie where projected coordinates do
TILT = 0.3  # radians by which the shapes with straight sides are turned off the axes


@dataclass(frozen=True, eq=False)
class Case:
    """One area and what is known about it."""

    family: str
    n: int  # vertices asked for; the area has about so many
    area: Polygon
    ends: Floats  # (2, 2) the ends a person would expect, on the outer boundary
    left: Floats  # (k, 2) the bank from the first end to the second, left of the way
    right: Floats  # (m, 2) the other bank, in the same direction

    @property
    def name(self) -> str:
        """Family and size, for tables."""
        return f"{self.family} {self.n:,}"

    @property
    def width(self) -> float:
        """Width of the rectangle that has the outer boundary's area and perimeter."""
        quarter = self.area.exterior.length / 4.0
        root = quarter**2 - Polygon(self.area.exterior).area
        return float(quarter - np.sqrt(max(root, 0.0)))


def make(family: str, n: int, seed: int = 0) -> Case:
    """Area of a family with about ``n`` vertices."""
    if family not in MAKERS:
        msg = f"family is {family!r}, expected one of {', '.join(FAMILIES)}"
        raise ValueError(msg)
    rng = np.random.default_rng([seed, FAMILIES.index(family), n])
    return MAKERS[family](family, n, rng)


def mixed(count: int, n: int) -> list[Polygon]:
    """Areas of ``n`` vertices of all families in turn, each with a seed of its own."""
    return [make(FAMILIES[i % len(FAMILIES)], n, i // len(FAMILIES)).area for i in range(count)]


def between_banks(
    family: str, n: int, left: Floats, right: Floats, holes: list[Floats] | None = None
) -> Case:
    """Area between two banks; its ends are halfway between the banks' ends."""
    area = Polygon(np.vstack([left, right[::-1]]), holes)
    ends = np.array([(left[0] + right[0]) / 2, (left[-1] + right[-1]) / 2])
    return Case(family, n, area, ends, left, right)


def inside_ring(family: str, n: int, ring: Floats, ends: Floats) -> Case:
    """Area inside a ring, whose banks part at the vertices nearest to the ends."""
    first, last = (int(np.argmin(((ring - end) ** 2).sum(axis=1))) for end in ends)
    k = len(ring)
    left = ring[np.arange(first, first + (last - first) % k + 1) % k]
    right = ring[np.arange(last, last + (first - last) % k + 1) % k][::-1]
    return Case(family, n, Polygon(ring), ends, left, right)


def smooth_noise(rng: Rng, m: int, correlation: float) -> Floats:
    """Smooth noise of about unit variance at ``m`` places, ``correlation`` places long."""
    k = max(4, int(np.ceil(m / correlation)) + 3)
    knots = rng.standard_normal(k)
    x = np.linspace(0, k - 1, m)
    i = np.clip(np.floor(x).astype(int), 0, k - 2)
    t = x - i
    t = t * t * (3 - 2 * t)
    smooth: Floats = knots[i] * (1 - t) + knots[i + 1] * t
    return smooth


def meanders(
    rng: Rng, m: int, step: float, count: int | None = None
) -> tuple[Floats, Floats, Floats]:
    """Sine-generated meanders: x, y and heading, which stays below 86 degrees so that x grows."""
    length = step * (m - 1)
    s = np.arange(m) * step
    heading = np.zeros(m)
    position, sign = 0.0, 1.0
    while position < length:
        if count is None:
            bend = rng.uniform(200, 400)
        else:
            bend = length / count * rng.uniform(0.8, 1.25) / 2
        swing = rng.uniform(0.5, 1.45)
        here = (s >= position) & (s < position + bend)
        heading[here] = sign * swing * np.sin(np.pi * (s[here] - position) / bend)
        position += bend
        sign = -sign
    mean = (heading[1:] + heading[:-1]) / 2
    x = np.concatenate([[0], np.cumsum(np.cos(mean) * step)])
    y = np.concatenate([[0], np.cumsum(np.sin(mean) * step)])
    return x, y, heading


def river(family: str, n: int, rng: Rng) -> Case:
    """Meandering river with rough banks of varying width."""
    m = n // 2
    if family == "river_dense":
        step = 6000.0 / (m - 1)
        x, y, heading = meanders(rng, m, step, count=10)
    else:
        step = 5.0 if n > SMALL else 20.0
        x, y, heading = meanders(rng, m, step)
    correlation = 120.0 / step
    half = 18 + 6 * np.clip(smooth_noise(rng, m, correlation), -1.6, 1.6)
    rough = min(0.6, 0.1 * step)
    to_left, to_right = (
        half * (1 + 0.15 * np.clip(smooth_noise(rng, m, correlation / 4), -2, 2))
        + rng.uniform(-rough, rough, m)
        for _ in range(2)
    )
    u, v = -np.sin(heading), np.cos(heading)
    to_left, to_right = np.clip(to_left, 4, 36), np.clip(to_right, 4, 36)
    left = np.column_stack([x + u * to_left, y + v * to_left])
    right = np.column_stack([x - u * to_right, y - v * to_right])
    return between_banks(family, n, left + FALSE_ORIGIN, right + FALSE_ORIGIN)


def embankment(family: str, n: int, rng: Rng) -> Case:
    """Strip with two rough edges that know nothing of each other."""
    m = n // 2
    x = np.arange(m) * 2.0
    middle = 15 * smooth_noise(rng, m, 80)
    top, toe = (
        middle + side + 2.0 * smooth_noise(rng, m, 10) + rng.normal(0, 0.5, m).clip(-1.2, 1.2)
        for side in (10, -10)
    )
    narrow = top - toe < 2
    top[narrow] = toe[narrow] + 2
    return between_banks(family, n, np.column_stack([x, top]), np.column_stack([x, toe]))


def waist(family: str, n: int, rng: Rng) -> Case:
    """Strip that narrows to a fiftieth of its width again and again."""
    m = n // 2
    x = np.arange(m) * 2.0
    period = 100.0 if n > SMALL else 50.0
    half = 0.4 + 20 * np.abs(np.sin(np.pi * (x + period / 2) / period)) ** 1.5
    middle = 10 * smooth_noise(rng, m, 60)
    rough = rng.uniform(0, 0.08, (2, m)) * half
    left = np.column_stack([x, middle + half - rough[0]])
    right = np.column_stack([x, middle - half + rough[1]])
    return between_banks(family, n, left, right)


def holes(family: str, n: int, rng: Rng) -> Case:
    """Channel with an island for every 500 vertices."""
    count, corners = max(1, n // 500), 16 if n > SMALL else 10
    m = (n - count * corners) // 2
    x = np.arange(m) * 5.0
    middle = 30 * smooth_noise(rng, m, 80)
    half = 25 + 4 * np.clip(smooth_noise(rng, m, 12), -2, 2)
    angle = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    islands = []
    for k in range(count):
        i = int((k + 0.5) * m / count)
        radius = 8 * (1 + 0.15 * rng.uniform(-1, 1, corners))
        islands.append(
            np.column_stack(
                [x[i] + radius * np.cos(angle), middle[i] + 0.6 * radius * np.sin(angle)]
            )
        )
    left, right = np.column_stack([x, middle + half]), np.column_stack([x, middle - half])
    return between_banks(family, n, left, right, islands)


# Corners and expected ends of the shapes with straight sides, all 40 wide.
CORNERS = {
    "rect": (
        [(0, 0), (400, 0), (400, 40), (0, 40)],
        [(0, 20), (400, 20)],
    ),
    "lshape": (
        [(0, 0), (300, 0), (300, 40), (40, 40), (40, 300), (0, 300)],
        [(300, 20), (20, 300)],
    ),
    "ushape": (
        [(0, 0), (200, 0), (200, 300), (160, 300), (160, 40), (40, 40), (40, 300), (0, 300)],
        [(180, 300), (20, 300)],
    ),
    "sshape": (
        [
            *[(0, 0), (300, 0), (300, 140), (40, 140), (40, 200), (300, 200)],
            *[(300, 240), (0, 240), (0, 100), (260, 100), (260, 40), (0, 40)],
        ],
        [(0, 20), (300, 220)],
    ),
}


def straight(family: str, n: int, rng: Rng) -> Case:  # noqa: ARG001  # nothing is left to chance
    """Shape with straight sides, densified to ``n`` vertices and turned off the axes."""
    corners, ends = (np.asarray(points, dtype=np.float64) for points in CORNERS[family])
    cos, sin = np.cos(TILT), np.sin(TILT)
    turn = np.array([[cos, -sin], [sin, cos]])
    return inside_ring(family, n, densified(corners, n) @ turn.T, ends @ turn.T)


def densified(corners: Floats, n: int) -> Floats:
    """Ring with its sides divided into about ``n`` equal steps, corners kept."""
    following = np.roll(corners, -1, axis=0)
    length = np.linalg.norm(following - corners, axis=1)
    steps = np.maximum(1, np.floor(n * length / length.sum())).astype(int)
    return np.vstack(
        [
            a + (np.arange(k) / k)[:, None] * (b - a)
            for a, b, k in zip(corners, following, steps, strict=True)
        ]
    )


def star(family: str, n: int, rng: Rng) -> Case:
    """Lobed blob: no long area at all; the ends are its farthest vertices."""
    angle = np.linspace(0, 2 * np.pi, n, endpoint=False)
    angle = np.sort(angle + rng.uniform(0, 0.3 * 2 * np.pi / n, n))
    radius = np.full(n, 100.0)
    for k in range(1, 9):
        swing = 0.45 / k * rng.uniform(0.4, 1)
        radius = radius * (1 + swing * np.cos(k * angle + rng.uniform(0, 6.28)))
    radius = np.clip(radius, 15, None) * (1 + rng.normal(0, min(0.02, 2.0 / n), n))
    ring = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    hull = shapely.get_coordinates(Polygon(ring).convex_hull)
    hull = hull if len(hull) < 3000 else hull[::50]
    squared = ((hull[:, None] - hull[None]) ** 2).sum(axis=-1)
    far = list(np.unravel_index(int(squared.argmax()), squared.shape))
    return inside_ring(family, n, ring, hull[far])


MAKERS: dict[str, Callable[[str, int, Rng], Case]] = {
    "river": river,
    "river_dense": river,
    "embankment": embankment,
    "waist": waist,
    "holes": holes,
    "rect": straight,
    "lshape": straight,
    "ushape": straight,
    "sshape": straight,
    "star": star,
}
