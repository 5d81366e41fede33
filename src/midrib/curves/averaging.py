"""The mean of two curves: the one drawn from the main curve and the one from the auxiliary.

     main       ------------------
     one curve   . . . . . . . . .      Points of both curves that have the same parameter are
     mean       ==================      averaged. What the parameter is makes the three means.
     other      .  .  .  .  .  .  .
     auxiliary  ------------------

proportional   share of the curve's own length: Rhino's mean curve
same-height    how far along a direction: walls of towers
kinks          the two sides themselves, from pair to pair of their kinks: see ``kinks``
radii          main curve plus auxiliary curve that a radius cuts off: it belongs to both banks
               alike, so that the mean of a wedge's two curves lies on its bisector
"""

from typing import Literal, TypeAlias

import numpy as np

from midrib.checks import is_number, shown
from midrib.curves.joining import Path, heights_of
from midrib.curves.radii import Radii
from midrib.errors import InvalidAreaError, ParameterError
from midrib.kernels.joining import join_beads
from midrib.kernels.paths import Beads
from midrib.layout import Layout
from midrib.types import Floats

__all__ = ["Mean", "average", "check_mean"]

Mean: TypeAlias = Literal["proportional", "same-height", "radii", "kinks"] | tuple[float, float]
MEANS = ("proportional", "same-height", "radii", "kinks")


def check_mean(mean: object, centring: str) -> None:
    """Refuse means that do not exist, or that nothing is averaged for."""
    if mean is None:
        return
    if centring != "symmetric":
        msg = f"mean goes with centring='symmetric', found centring={centring!r}"
        raise ParameterError(msg)
    is_direction = (
        isinstance(mean, tuple | list | np.ndarray)
        and len(mean) == 2
        and all(is_number(value) for value in mean)
        and 0.0 < np.hypot(*mean) < np.inf
    )
    if not is_direction and not (isinstance(mean, str) and mean in MEANS):
        msg = (
            f"mean is {shown(mean)}, expected 'proportional', 'same-height', 'radii', 'kinks' or a "
            "direction (dx, dy) for the same height along it"
        )
        raise ParameterError(msg)


def average(
    layout: Layout, one: tuple[Radii, Path], other: tuple[Radii, Path], mean: Mean | None
) -> Path:
    """Mean of two curves of one strip, joined inside the area without loops."""
    (radii, path), (other_radii, other_path) = one, other
    if mean is None or (isinstance(mean, str) and mean == "radii"):
        at, other_at = cut_off(layout, radii, path), cut_off(layout, other_radii, other_path)
    elif isinstance(mean, str) and mean == "proportional":
        at, other_at = share_of_length(layout, path), share_of_length(layout, other_path)
    else:
        along = upwards(layout) if isinstance(mean, str) else np.asarray(mean, dtype=np.float64)
        at, other_at = height_of(layout, path, along), height_of(layout, other_path, along)
    both = np.union1d(at, other_at)
    points = (sampled(path.points, at, both) + sampled(other_path.points, other_at, both)) / 2.0
    height = None
    if path.height is not None and other_path.height is not None:
        z, other_z = path.height[:, None], other_path.height[:, None]
        height = (sampled(z, at, both)[:, 0] + sampled(other_z, other_at, both)[:, 0]) / 2.0
    # The search for a mean begins at the foot of the radius next to it.
    near = np.interp(np.concatenate([both[:1], both, both[-1:]]), at, nearest_radius(path))
    near = near.astype(np.intp)
    beads = Beads(points, radii.points[near, :2].copy(), radii.at[near, 1], radii.at[near, 2])
    joined, source, loops, _ = join_beads(layout.mesh, beads, *layout.scale)
    if joined.shape[0] < 2:
        msg = "the mean of the two curves is one point; a line needs two"
        raise InvalidAreaError(msg)
    return Path(
        joined,
        heights_of(layout, joined, source, height),
        np.full(len(joined), -1),
        path.middles,
        path.loops + other_path.loops + loops,
    )


def nearest_radius(path: Path) -> Floats:
    """Return the radius of every point of a path, or that of a point before or after it, or 0."""
    rows = path.on_radii
    if rows.size == 0:
        return np.zeros(len(path.points))
    return np.interp(np.arange(len(path.points)), rows, path.radius[rows])


def sampled(points: Floats, at: Floats, where: Floats) -> Floats:
    """Points of a chain at parameters, between its own ends: several may share a parameter."""
    inner = np.column_stack([np.interp(where, at, column) for column in points.T])
    return np.concatenate([points[:1], inner, points[-1:]])


def arc_of(layout: Layout, path: Path) -> Floats:
    """Arc length at every point of a path."""
    steps = np.diff(path.points, axis=0) * layout.scale
    return np.concatenate([[0.0], np.cumsum(np.hypot(*steps.T))])


def share_of_length(layout: Layout, path: Path) -> Floats:
    """Share of the whole length at every point of a path."""
    arc = arc_of(layout, path)
    share: Floats = arc / arc[-1]
    return share


def upwards(layout: Layout) -> Floats:
    """Direction from the middle of the strip's start to the middle of its end."""
    along: Floats = (layout.middle.point[1] - layout.middle.point[0]) * layout.scale
    return along


def height_of(layout: Layout, path: Path, along: Floats) -> Floats:
    """How far along a direction every point of a path is; never back again."""
    heights = (path.points * layout.scale) @ along
    return np.maximum.accumulate(heights if heights[-1] >= heights[0] else -heights)


def cut_off(layout: Layout, radii: Radii, path: Path) -> Floats:
    """Length of both banks up to the radius of every point of a path; never back again.

    Of points between radii in proportion to the way; at the ends nothing, and all of it.
    """
    cut = radii.stations[radii.station] + radii.arc
    known = path.on_radii
    arc, last = arc_of(layout, path), len(path.points) - 1
    at, value = arc[known], cut[path.radius[known]]
    if 0 not in known:
        at, value = np.append(0.0, at), np.append(0.0, value)
    if last not in known:
        whole = layout.main.length + layout.auxiliary.length
        at, value = np.append(at, arc[last]), np.append(value, whole)
    return np.maximum.accumulate(np.interp(arc, at, value))
