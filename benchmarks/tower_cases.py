"""Scans of towers with a known axis, and circle fits level by level as the rival."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from midrib.towers.simulate import Scan, Tower

__all__ = ["CASES", "PATCHES", "Case", "circle_fits"]

Floats = NDArray[np.float64]
COUNT = 300_000
HALF_SLAB, TRIES, NEAR, LEAST = 0.05, 100, 0.04, 12  # of the rival: metres, triples, metres, points
TUKEY, ROUNDS = 4.685, 8


class Case(NamedTuple):
    """A kind of scan, made anew for each seed."""

    name: str
    make: Callable[[int], Scan]
    goal: float  # mm RMS; 0 if the goal is to refuse or to flag
    shape: str  # what the sections should be recognised as
    tells_stations: bool = False


class Parabolic(Tower):
    """A tower whose batter is a parabola that ends upright."""

    def radius(self, s: Floats) -> Floats:
        """Radius at heights."""
        share = 1.0 - np.asarray(s) / self.height
        radii: Floats = self.top_radius + (self.base_radius - self.top_radius) * share**2
        return radii


class Broken(Tower):
    """A tower whose batter breaks half way up."""

    def radius(self, s: Floats) -> Floats:
        """Radius at heights."""
        heights = [0.0, self.height / 2.0, self.height]
        radii: Floats = np.interp(s, heights, [self.base_radius, 2.3, self.top_radius])
        return radii


def dirty(seed: int, tower: Tower, **changes: object) -> Scan:
    """Three stations, noise of 2 to 5 mm, ladder, platforms, antennas, strays."""
    usual = Scan(
        replace(tower, seed=seed),
        count=COUNT,
        noise=(0.002, 0.005),
        ladder=30.0,
        platforms=(0.3, 0.6, 0.9),
        antennas=3,
        outliers=0.01,
        seed=seed,
    )
    return replace(usual, **changes)  # type: ignore[arg-type]


LEANING = Tower(lean=0.16, lean_azimuth=40.0, bend=0.03)
ROUGH = replace(LEANING, form_error=0.005)
PATCHES = replace(ROUGH, form_length=1.0)
KINKED = replace(ROUGH, kink=1.0)
SQUARE = replace(LEANING, faces=4, twist=20.0)
HALF = {"azimuths": (0.0, 70.0, 140.0), "arc": (-20.0, 160.0)}
CASES = (
    Case(
        "clean",
        lambda seed: Scan(replace(LEANING, seed=seed), COUNT, noise=(0.002, 0.005), seed=seed),
        0.4,
        "round",
    ),
    Case(
        "parabolic batter",
        lambda seed: Scan(
            Parabolic(100.0, 5.0, 2.0, lean=0.16, bend=0.03, seed=seed),
            COUNT,
            noise=(0.002, 0.005),
            seed=seed,
        ),
        0.4,
        "round",
    ),
    Case(
        "broken batter",
        lambda seed: Scan(
            Broken(60.0, 3.1, 2.0, lean=0.1, seed=seed), COUNT, noise=(0.002, 0.004), seed=seed
        ),
        0.4,
        "round",
    ),
    Case("full", lambda seed: dirty(seed, LEANING), 0.4, "round"),
    Case("form error", lambda seed: dirty(seed, ROUGH), 0.4, "round"),
    Case("form error, kinks", lambda seed: dirty(seed, KINKED), 0.4, "round"),
    Case(
        "form error, offset of 8 mm",
        lambda seed: dirty(seed, replace(ROUGH, offset=0.008, offset_height=43.2)),
        0.4,
        "round",
    ),
    Case(
        "form error in patches of 1 m",
        lambda seed: dirty(seed, PATCHES),
        0.4,
        "round",
    ),
    Case("oval, 10 mm", lambda seed: dirty(seed, replace(ROUGH, oval=0.01)), 0.4, "oval"),
    Case("half visible, form error", lambda seed: dirty(seed, ROUGH, **HALF), 1.0, "unknown"),
    Case(
        "one station, form error",
        lambda seed: dirty(seed, ROUGH, azimuths=(10.0,)),
        1.0,
        "unknown",
    ),
    Case("square, 3 stations", lambda seed: dirty(seed, SQUARE), 1.3, "square"),
    Case(
        "square, 2 stations",
        lambda seed: dirty(seed, SQUARE, azimuths=(0.0, 120.0)),
        1.3,
        "square",
    ),
    Case("octagon", lambda seed: dirty(seed, replace(SQUARE, faces=8)), 1.3, "polygon"),
    Case("nine faces", lambda seed: dirty(seed, replace(SQUARE, faces=9)), 1.3, "polygon"),
    Case(
        "full, stations registered to 2 mm",
        lambda seed: dirty(seed, LEANING, registration=0.002),
        0.0,
        "round",
    ),
    Case(
        "the same, points say from which station",
        lambda seed: dirty(seed, LEANING, registration=0.002),
        0.0,
        "round",
        tells_stations=True,
    ),
)


def circle_fits(scan: Scan, points: Floats, heights: Floats) -> Floats:
    """Centres (n, 2) of circles through thin horizontal slices, screened; NaN without one."""
    order = points[np.argsort(points[:, 2])]
    random = np.random.default_rng(3)
    centres = np.full((heights.size, 2), np.nan)
    for i, z in enumerate(heights):
        first, last = np.searchsorted(order[:, 2], [z - HALF_SLAB, z + HALF_SLAB])
        found = circle_of(order[first:last, :2], random, 2.0 * scan.tower.base_radius)
        if found is not None:
            centres[i] = found
    return centres


def circle_of(xy: Floats, random: np.random.Generator, most: float) -> Floats | None:
    """Centre of the circle that most points lie on, by robust least squares."""
    if len(xy) < LEAST:
        return None
    a, b, c = xy[random.integers(0, len(xy), (TRIES, 3))].transpose(1, 0, 2)
    b, c = b - a, c - a
    twice = 2.0 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    twice[twice == 0.0] = 1e-9
    bb, cc = (b**2).sum(axis=1), (c**2).sum(axis=1)
    x = (c[:, 1] * bb - b[:, 1] * cc) / twice
    y = (b[:, 0] * cc - c[:, 0] * bb) / twice
    radius = np.hypot(x, y)
    centre = a + np.column_stack([x, y])
    off = np.abs(np.hypot(*(xy[:, None] - centre).transpose(2, 0, 1)) - radius)
    score = np.where(radius < most, (off < NEAR).sum(axis=0), 0)
    best = int(np.argmax(score))
    if score[best] < LEAST:
        return None
    at, r = centre[best], radius[best]
    inner = xy[off[:, best] < NEAR]
    for _ in range(ROUNDS):
        way = inner - at
        away = np.hypot(*way.T)
        residual = away - r
        spread = max(1.4826 * float(np.median(np.abs(residual))), 1e-9)
        root = np.clip(1.0 - (residual / (TUKEY * spread)) ** 2, 0.0, 1.0)
        design = np.column_stack([way / away[:, None], np.ones(len(way))])
        step = np.linalg.lstsq(root[:, None] * design, root * residual, rcond=None)[0]
        at, r = at + step[:2], r + step[2]
    return np.asarray(at, dtype=np.float64)
