"""Arms of crossings: the kernel that cuts them back says what the plain way says."""

from typing import Any

import numpy as np
import pytest
import shapely
from shapely import Polygon, box

from midrib.curves.arms import Crossing, Net, Stretch, arms_of, net_of
from midrib.curves.junctions import crossings_of
from midrib.curves.skeletons import graph_finder, pruning
from midrib.kernels.arms import ALONG, FARTHEST, LOOK, NARROW, SAMPLES, STEADY, WEAK
from midrib.types import Floats
from tests.shapes import NAMED

ROADS = [((-40, 0), (40, 0)), ((0, -30), (3, 40)), ((-25, -30), (20, 35)), ((25, 0), (25, 44))]


def streets(wide: float) -> Polygon:
    """Roads that cross, at right angles and sharp ones, one of them as wide as asked for."""
    roads = [shapely.LineString(way).buffer(2.0, cap_style="flat") for way in ROADS[1:]]
    return shapely.union_all([shapely.LineString(ROADS[0]).buffer(wide), *roads])


AREAS = {
    "cross": box(-20, -1, 20, 1) | box(-1, -20, 1, 20),
    "comb": NAMED["comb"],
    "streets": streets(2.0),
    "wide_street": streets(5.0),
}


def narrow_from(
    net: Net, crossing: Crossing, stretch: Stretch
) -> tuple[float, float, tuple[Floats, Floats]]:
    """Where an arm is narrow, where it has left the discs, and discs before; plainly."""
    radii = net.radius[crossing.members]
    look = LOOK * float(radii.max())
    arc = np.linspace(0.0, min(stretch.length / 2.0, FARTHEST * float(radii.max())), SAMPLES)
    arc = np.union1d(arc, stretch.arc[stretch.arc < arc[-1]])
    end = int(np.searchsorted(arc, look, side="right"))  # of what is near the crossing
    points, radius = stretch.at(arc)
    away = points[:, None] - net.points[crossing.members][None]
    is_out = np.all(np.hypot(away[..., 0], away[..., 1]) >= radii, axis=1)
    if not is_out.any():
        last = float(arc[end - 1])
        return last, last, (points, radius)
    first = int(np.argmax(is_out))
    ahead = least_ahead(arc, radius)
    is_steady = is_out & (ahead >= STEADY * radius) & (arc + LOOK * radius <= arc[-1])
    if is_steady.any():
        least = ahead[np.argmax(is_steady)]
    else:
        least = radius[first : max(end, first + 1)].min()
    at = first + int(np.argmax(radius[first:] <= NARROW * least))
    vertices = stretch.arc[(stretch.arc >= arc[at]) & (stretch.arc <= arc[at] + radius[at] / 2.0)]
    vertices = vertices[vertices <= arc[-1]]
    narrow = float(vertices[0] if vertices.size else arc[at])
    is_near = arc <= narrow + radius[at]
    return narrow, float(arc[first]), (points[is_near], radius[is_near])


def least_ahead(arc: Floats, radius: Floats) -> Floats:
    """Least radius from each place on over ``LOOK`` of its radii."""
    first = np.arange(arc.size)
    last = np.searchsorted(arc, arc + LOOK * radius, side="right")
    pairs = np.column_stack([first, np.minimum(last, arc.size - 1)]).ravel()
    least: Floats = np.minimum(np.minimum.reduceat(radius, pairs)[::2], radius)
    return least


def plain_arm(net: Net, crossing: Crossing, stretch: Stretch) -> list[Any]:
    """What an arm says: cut, direction, bend, radius, weight, the next best cut, discs."""
    at, outside, (points, radii) = narrow_from(net, crossing, stretch)
    _, (radius,) = stretch.at(np.array([at]))
    far = min(at + ALONG * radius, stretch.length)
    weight = (far - at) / ALONG
    start = at
    if far == at:
        start, far, weight = 0.0, at, WEAK * radius
    (cut, middle, last), _ = stretch.at(np.array([start, (start + far) / 2.0, far]))
    half = (far - start) / 2.0
    direction = (3.0 * cut - 4.0 * middle + last) / (2.0 * half)
    bend = (cut - 2.0 * middle + last) / half**2
    (spare,), _ = stretch.at(np.array([outside]))
    kept = [np.count_nonzero(stretch.arc > place) for place in (start, outside)]
    unit = direction / np.hypot(*direction)
    return [start, cut, unit, bend, radius, weight, spare, kept, points, radii]


@pytest.mark.parametrize("method", ["medial-axis", "straight-skeleton", "chordal-axis"])
@pytest.mark.parametrize("name", sorted(AREAS))
def test_an_arm_says_what_its_branch_says_plainly(name: str, method: str) -> None:
    graph, layout = graph_finder(method)(AREAS[name], (1.0, 1.0))
    net = net_of(pruning(None, 1.5)(graph, (1.0, 1.0)), layout.scale)
    arms = [(c, arm) for c in crossings_of(net, 1.0) for arm in arms_of(net, c, net.ends())]
    assert len(arms) >= 3
    for crossing, arm in arms:
        found: list[Any] = [
            arm.at,
            arm.cut,
            arm.direction,
            arm.bend,
            arm.radius,
            arm.weight,
            arm.spare[0],
        ]
        found += [[arm.kept, arm.spare[1]], *arm.reach]
        for one, other in zip(
            found, plain_arm(net, crossing, net.stretch(arm.branch, arm.end)), strict=True
        ):
            np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-12)
