"""Laser scans of towers with a known axis: seeded, in chunks, as dirty as real ones.

A scan is a table of what a station's scanner would bring home: points of the shell that face it,
more of them where it is near and the beam is steep, with noise along the beam; then what stands in
the way (ladder, platforms, antennas, a neighbour), stray points, and stations that do not quite fit
together.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from midrib.errors import ParameterError
from midrib.towers.tower import Tower

if TYPE_CHECKING:
    from midrib.types import Bools, Floats, Ints

__all__ = ["Scan", "Tower"]

MIXED_COSINE = 0.15  # beams that graze the shell like this may be mixed with what is behind
MIXED_SHARE, MIXED_DEPTH = 0.3, 0.15  # how many of these are, and how far behind on average
LADDER_DEPTH, LADDER_WIDTH, LADDER_SHADE = (0.15, 0.7), 0.5, 0.4
PLATFORM_WIDTH, PLATFORM_THICKNESS = 1.0, 0.2


@dataclass(frozen=True)
class Scan:
    """A scan of a tower; lengths in metres, angles in degrees.

    Parameters
    ----------
    tower : Tower
    count : int
        Number of points, all stations together.
    azimuths, distance, station_height : float
        Where the stations stand: directions from the tower's base, how far, how high.
    noise : (float, float)
        Standard deviation along the beam at the base and at the top.
    outliers : float
        Share of points anywhere in a box around the tower.
    ladder : float, optional
        Azimuth of a ladder that stands off the wall and hides a part of it.
    platforms : tuple of float
        Heights, as shares of the tower's, of platforms around it; they hide what is behind.
    antennas : int
        Rods along the topmost tenth of the wall and above.
    arc : (float, float), optional
        Only azimuths between these two are seen at all.
    hidden_below : float
        A neighbour hides what is lower from the first station.
    registration : float
        Standard deviation of each station's shift in x, y and z.
    levelling : float
        Standard deviation of each station's tilt, in mm per m.
    origin : (float, float, float)
        Added to all coordinates, as a map's origin would be.
    seed : int

    Examples
    --------
    >>> scan = Scan(Tower(height=30.0), count=1000, seed=7)
    >>> scan.points().shape
    (1000, 3)
    """

    tower: Tower = field(default_factory=Tower)
    count: int = 1_000_000
    azimuths: tuple[float, ...] = (0.0, 120.0, 240.0)
    distance: float = 80.0
    station_height: float = 1.7
    noise: tuple[float, float] = (0.0, 0.0)
    outliers: float = 0.0
    ladder: float | None = None
    platforms: tuple[float, ...] = ()
    antennas: int = 0
    arc: tuple[float, float] | None = None
    hidden_below: float = 0.0
    registration: float = 0.0
    levelling: float = 0.0
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    seed: int = 0

    def __post_init__(self) -> None:
        """Refuse what cannot be scanned.

        Raises
        ------
        ParameterError
            If there is no station, or one is inside the tower.
        """
        if not self.azimuths or self.count < len(self.azimuths):
            msg = f"a scan of {self.count} points from {len(self.azimuths)} stations has no points"
            raise ParameterError(msg)
        if self.distance <= 2.0 * self.tower.base_radius:
            msg = f"distance is {self.distance}, expected more than the tower's base is wide"
            raise ParameterError(msg)

    def axis(self, z: "Floats | list[float]") -> "Floats":
        """Points (n, 2) of the true axis at heights of the scan's coordinates."""
        z = np.asarray(z, dtype=np.float64)
        centres: Floats = self.tower.axis(z - self.origin[2]) + np.array(self.origin[:2])
        return centres

    def points(self) -> "Floats":
        """All points (n, 3) at once."""
        return np.concatenate(list(self.chunks()))

    @property
    def stations(self) -> "Ints":
        """(n,) numbers of the stations that the points are from, from 0 on."""
        ends = np.linspace(0, self.count, len(self.azimuths) + 1).astype(np.intp)
        numbers: Ints = np.searchsorted(ends[1:], np.arange(self.count), side="right")
        return numbers

    def chunks(self, size: int = 500_000) -> Iterator["Floats"]:
        """Points (n, 3), at most ``size`` at a time, station by station."""
        for station, count in enumerate(np.bincount(self.stations)):
            for first in range(0, int(count), size):
                yield self.part(station, first, min(size, int(count) - first))

    def part(self, station: int, first: int, count: int) -> "Floats":
        """Return some points of one station."""
        random = np.random.default_rng([self.seed, station, first])
        kinds = random.multinomial(count, self.shares)
        stand = self.stand(station)
        makers = (self.wall, self.clutter_ladder, self.clutter_platforms, self.clutter_antennas)
        found = [maker(random, int(k), stand) for maker, k in zip(makers, kinds, strict=False)]
        found.append(self.strays(random, int(kinds[-1])))
        points = self.misplaced(random.permutation(np.concatenate(found)), station, stand)
        moved: Floats = points + np.array(self.origin)
        return moved

    @property
    def shares(self) -> "Floats":
        """Shares of wall, ladder, platforms, antennas and strays among the points."""
        parts = [
            0.0,
            0.01 * (self.ladder is not None),
            0.005 * len(self.platforms),
            0.002 * self.antennas,
            self.outliers,
        ]
        parts[0] = 1.0 - sum(parts)
        return np.array(parts)

    def stand(self, station: int) -> "Floats":
        """Where a station stands."""
        angle = np.radians(self.azimuths[station])
        place = [self.distance * np.cos(angle), self.distance * np.sin(angle), self.station_height]
        return np.array(place)

    def wall(self, random: np.random.Generator, count: int, stand: "Floats") -> "Floats":
        """Points of the shell as a station sees them: drawn evenly, kept as the beams are dense."""
        kept: list[Floats] = []
        missing, tries = count, 0
        while missing > 0:
            n = max(256, 4 * missing)
            s, theta = random.uniform(0.0, self.tower.height, n), random.uniform(0, 2 * np.pi, n)
            points = self.tower.points(s, theta)
            beam = stand - points
            away = np.linalg.norm(beam, axis=1)
            cosine = (self.normals(theta) * beam).sum(axis=1) / away
            chance = cosine * (self.distance / away) ** 2
            seen = (random.uniform(size=n) < chance) & self.is_free(random, s, theta, stand)
            chosen = np.flatnonzero(seen)[:missing]
            noise = np.interp(s[chosen], [0.0, self.tower.height], self.noise)
            shift = noise * random.normal(size=chosen.size)
            if any(self.noise):
                mixed = (cosine[chosen] < MIXED_COSINE) & (
                    random.uniform(size=shift.size) < MIXED_SHARE
                )
                shift[mixed] -= random.exponential(MIXED_DEPTH, mixed.sum())
            kept.append(points[chosen] + (shift / away[chosen])[:, None] * beam[chosen])
            missing -= chosen.size
            tries += 1
            if tries > 1000:
                msg = "hardly any of the tower is seen from a station"
                raise ParameterError(msg)
        return np.concatenate([np.zeros((0, 3)), *kept])

    def normals(self, theta: "Floats") -> "Floats":
        """Outward normals of the shell, near enough to tell what faces a station."""
        if self.tower.faces:
            sector, twist = 2.0 * np.pi / self.tower.faces, np.radians(self.tower.twist)
            theta = twist + sector * np.round((theta - twist) / sector)
        rise = (self.tower.base_radius - self.tower.top_radius) / self.tower.height
        return np.column_stack([np.cos(theta), np.sin(theta), np.full(theta.size, rise)])

    def is_free(
        self, random: np.random.Generator, s: "Floats", theta: "Floats", stand: "Floats"
    ) -> "Bools":
        """Whether nothing stands between a station and points of the shell."""
        free = np.ones(s.size, dtype=np.bool_)
        if self.arc is not None:
            low, high = np.radians(self.arc)
            free &= (theta - low) % (2.0 * np.pi) <= (high - low)
        if self.ladder is not None:
            off = (theta - np.radians(self.ladder) + np.pi) % (2.0 * np.pi) - np.pi
            is_behind = np.abs(off) * self.tower.radius(s) < LADDER_WIDTH / 2.0
            free &= ~(is_behind & (random.uniform(size=s.size) < LADDER_SHADE))
        for share in self.platforms:
            level = share * self.tower.height
            shade = PLATFORM_WIDTH * (level - stand[2]) / self.distance
            free &= (s < level - PLATFORM_THICKNESS) | (s > level + PLATFORM_THICKNESS + shade)
        if self.hidden_below > 0.0 and np.array_equal(stand, self.stand(0)):
            free &= s > self.hidden_below
        return free

    def clutter_ladder(self, random: np.random.Generator, count: int, _: "Floats") -> "Floats":
        """Points of the ladder and its cage."""
        s = random.uniform(2.0, self.tower.height, count)
        across = random.uniform(-0.5, 0.5, count) * LADDER_WIDTH / self.tower.radius(s)
        theta = np.radians(self.ladder or 0.0) + across
        return self.tower.points(s, theta, random.uniform(*LADDER_DEPTH, count))

    def clutter_platforms(self, random: np.random.Generator, count: int, _: "Floats") -> "Floats":
        """Points of the platforms."""
        if not count:
            return np.zeros((0, 3))
        s = self.tower.height * random.choice(self.platforms, count)
        s += random.uniform(-1.0, 1.0, count) * PLATFORM_THICKNESS
        theta = random.uniform(0.0, 2.0 * np.pi, count)
        return self.tower.points(s, theta, random.uniform(0.0, PLATFORM_WIDTH, count))

    def clutter_antennas(self, random: np.random.Generator, count: int, _: "Floats") -> "Floats":
        """Points of rods near the top."""
        s = self.tower.height * random.uniform(0.9, 1.03, count)
        rod = random.integers(0, max(self.antennas, 1), count).astype(np.float64)
        theta = 2.0 * np.pi * rod / max(self.antennas, 1) + 0.4
        return self.tower.points(s, theta, 0.3 + random.normal(0.0, 0.02, count))

    def strays(self, random: np.random.Generator, count: int) -> "Floats":
        """Points anywhere around the tower."""
        wide = 3.0 * self.tower.base_radius
        low, high = [-wide, -wide, 0.0], [wide, wide, self.tower.height]
        return random.uniform(low, high, (count, 3))

    def misplaced(self, points: "Floats", station: int, stand: "Floats") -> "Floats":
        """Points where a station that is a little off and out of level puts them."""
        random = np.random.default_rng([self.seed, station, 2**31])
        shift = random.normal(0.0, 1.0, 3) * self.registration
        tilt = random.normal(0.0, 1.0, 2) * self.levelling * 1e-3
        level = points[:, 2:] - stand[2]
        turned = np.column_stack([level * tilt, -(points - stand)[:, :2] @ tilt])
        moved: Floats = points + shift + turned
        return moved
