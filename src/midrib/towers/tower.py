"""Towers whose axis is known: what `simulate` scans.

s          height along the unbent axis, from 0 at the base to the tower's height
c(s)       the axis: lean + bend + kinks + offset, in the horizontal plane
t(s)       its direction; a section is perpendicular to it, as a built tower's is
theta      azimuth in the section, anticlockwise from x
R(s, θ)    distance from the axis to the shell: radius, oval, polygon, form error

                 c(s) + R(s, θ) (cos θ · n₁ + sin θ · n₂),   n₁, n₂ ⟂ t
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from midrib.checks import check_library
from midrib.errors import ParameterError

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Tower"]

FORM_STEP = 0.4  # of the correlation length: the grid on which form errors are drawn


@dataclass(frozen=True)
class Tower:
    """A tapered tower with a known axis; lengths in metres.

    Parameters
    ----------
    height, base_radius, top_radius : float
        The taper is straight. Of a polygon the radii are those of the inscribed circle.
    lean : float
        How far the top is from the vertical through the base.
    lean_azimuth : float
        Where to, in degrees anticlockwise from x.
    bend : float
        Amplitude of an S-shaped bend that is zero at base and top and grows upwards.
    kink, kink_spacing : float
        Largest change of direction (mm per m) of a kink, and the heights between kinks.
    offset, offset_height : float
        A step of the axis, across the lean, and the height at which it is, as between two lifts.
    oval : float
        Amplitude of cos 2θ in the radius, everywhere the same.
    faces : int
        Number of faces; 0 is round, 4 square.
    twist : float
        Azimuth of the first face's normal, and of the longer diameter of an oval, in degrees.
    form_error, form_length : float
        Standard deviation and correlation length of a Gaussian random field added to the radius.
    seed : int
        Of kinks and form errors.

    Examples
    --------
    >>> Tower(height=100.0, lean=0.16).axis([0.0, 50.0, 100.0])[:, 0]
    array([0.  , 0.08, 0.16])
    """

    height: float = 100.0
    base_radius: float = 4.0
    top_radius: float = 2.0
    lean: float = 0.0
    lean_azimuth: float = 0.0
    bend: float = 0.0
    kink: float = 0.0
    kink_spacing: float = 10.0
    offset: float = 0.0
    offset_height: float = 0.0
    oval: float = 0.0
    faces: int = 0
    twist: float = 0.0
    form_error: float = 0.0
    form_length: float = 0.1
    seed: int = 0

    def __post_init__(self) -> None:
        """Refuse what is no tower.

        Raises
        ------
        ParameterError
            If a size is not positive, or there are one or two faces.
        """
        for name in ("height", "base_radius", "top_radius", "kink_spacing", "form_length"):
            if not getattr(self, name) > 0.0:
                msg = f"{name} is {getattr(self, name)}, expected a length above 0"
                raise ParameterError(msg)
        if self.faces in {1, 2} or self.faces < 0:
            msg = f"faces is {self.faces}, expected 0 (round) or at least 3"
            raise ParameterError(msg)

    def axis(self, s: "Floats | list[float]") -> "Floats":
        """Points (n, 2) of the axis at heights."""
        s, angle = np.asarray(s, dtype=np.float64), np.radians(self.lean_azimuth)
        step = self.offset * (s > self.offset_height)
        across = np.array([-np.sin(angle), np.cos(angle)])
        found: Floats = self.unbroken(s) + step[:, None] * across
        return found

    def unbroken(self, s: "Floats") -> "Floats":
        """Points (n, 2) of the axis without its offset: what has a direction everywhere."""
        share = s / self.height
        angle = np.radians(self.lean_azimuth)
        x = self.lean * share * np.cos(angle)
        y = self.lean * share * np.sin(angle)
        wave = self.bend * share * np.sin(2.0 * np.pi * share)
        x, y = x - wave * np.sin(angle), y + wave * np.cos(angle)
        at, turns = self.kinks
        if at.size:
            run = np.maximum(s[:, None] - at, 0.0)
            x, y = x + run @ turns[:, 0], y + run @ turns[:, 1]
        return np.column_stack([x, y])

    @cached_property
    def kinks(self) -> "tuple[Floats, Floats]":
        """Heights (k,) of kinks and the changes of direction (k, 2) there; together they cancel."""
        at = np.arange(self.kink_spacing, self.height - 1e-9, self.kink_spacing)
        if self.kink == 0.0:
            return at[:0], np.zeros((0, 2))
        random = np.random.default_rng([self.seed, 1])
        turns = random.uniform(-1.0, 1.0, (at.size, 2)) * self.kink * 1e-3
        turns[1:] -= turns[:-1].copy() / 2.0  # a builder steers back
        return at, turns

    def radius(self, s: "Floats") -> "Floats":
        """Radius at heights, without oval and form error."""
        return self.base_radius + (self.top_radius - self.base_radius) * s / self.height

    def shell(self, s: "Floats", theta: "Floats") -> "Floats":
        """Distance from the axis to the shell."""
        twist = np.radians(self.twist)
        away = self.radius(s)
        if self.faces:
            sector = 2.0 * np.pi / self.faces
            turned = (theta - twist + sector / 2.0) % sector - sector / 2.0
            away = away / np.cos(turned)
        if self.oval:
            away = away + self.oval * np.cos(2.0 * (theta - twist))
        if self.form_error:
            away = away + self.form(s, theta)
        return away

    @cached_property
    def form_field(self) -> "Floats":
        """Form errors on a grid of height and azimuth; the last column repeats the first."""
        check_library("scipy", "a form error", "towers")
        from scipy.ndimage import gaussian_filter

        middle = (self.base_radius + self.top_radius) / 2.0
        step = FORM_STEP * self.form_length
        shape = int(self.height / step) + 2, max(8, int(2.0 * np.pi * middle / step))
        field = np.random.default_rng([self.seed, 2]).normal(size=shape)
        field = gaussian_filter(field, 1.0 / FORM_STEP / np.sqrt(2.0), mode=("reflect", "wrap"))
        field *= self.form_error / field.std()
        return np.column_stack([field, field[:, 0]])

    def form(self, s: "Floats", theta: "Floats") -> "Floats":
        """Form error at places, between the grid's by two linear interpolations."""
        field = self.form_field
        row = np.clip(s / self.height, 0.0, 1.0) * (field.shape[0] - 1)
        column = (theta / (2.0 * np.pi) % 1.0) * (field.shape[1] - 1)
        i = np.minimum(row.astype(np.intp), field.shape[0] - 2)
        j = np.minimum(column.astype(np.intp), field.shape[1] - 2)
        u, v = row - i, column - j
        low = field[i, j] * (1.0 - v) + field[i, j + 1] * v
        high = field[i + 1, j] * (1.0 - v) + field[i + 1, j + 1] * v
        error: Floats = low * (1.0 - u) + high * u
        return error

    def frames(self, s: "Floats") -> "tuple[Floats, Floats, Floats]":
        """Axis points (n, 3) and two directions (n, 3) that span the section there."""
        half = 1e-4 * self.height
        slope = (self.unbroken(s + half) - self.unbroken(s - half)) / (2.0 * half)
        t = np.column_stack([slope, np.ones(s.size)])
        t /= np.linalg.norm(t, axis=1)[:, None]
        across = np.array([1.0, 0.0, 0.0]) - t * t[:, :1]
        across /= np.linalg.norm(across, axis=1)[:, None]
        return np.column_stack([self.axis(s), s]), across, np.cross(t, across)

    def points(self, s: "Floats", theta: "Floats", beyond: "Floats | float" = 0.0) -> "Floats":
        """Points (n, 3) of the shell, or so far beyond it."""
        centre, across, other = self.frames(s)
        away = (self.shell(s, theta) + beyond)[:, None]
        return centre + away * (np.cos(theta)[:, None] * across + np.sin(theta)[:, None] * other)
