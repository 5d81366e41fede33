r"""Junctions of a network: which ones of a skeleton are one crossing, and where its arms meet.

The skeleton of a crossing of two roads has two junctions unless the roads are alike, and near
every junction it leaves the middles of the roads: it dips towards the road that joins.

    ---------------------        A *crossing* is a junction, or several whose discs overlap. Its
     . . . .     . . . .         arms count from where they have left these discs and are as narrow
             . .                 as they are beyond: from there they go straight on to the *hub*,
    -------.  .  .-------        the point that is nearest to all of these straight lines.
           |  .  |
           |  .  |

Source: Haunert and Sester, Area collapse and road centerlines based on straight skeletons,
GeoInformatica 12, 2008: junctions near each other are one, and roads keep their directions.
"""

import numpy as np

from midrib.curves.arms import Crossing, Net, arms_of
from midrib.curves.hubs import bundle_of, hub_of, led_on
from midrib.types import Floats, Ints

__all__ = ["crossings_of"]

JUNCTION = 3  # ways of a point that is one
FARTHER = 2.0  # times as far, junctions are one if their arms meet within a part of their radius
MEETING = 0.25
NONE = np.empty(0, dtype=np.intp)


def crossings_of(net: Net, overlap: float) -> list[Crossing]:
    """Junctions that are one crossing, because their discs overlap or their arms meet in a point.

    The nearest ones are joined first; a branch back to a junction of the same crossing stays.

    Parameters
    ----------
    net : Net
    overlap : any two junctions of a crossing are at most so many times the sum of their radii
        apart; twice as much where all arms lead to one point
    """
    ends = net.ends()
    found = {int(v): Crossing(np.array([v]), NONE) for v in np.flatnonzero(net.degree >= JUNCTION)}
    is_between = (net.degree[ends] >= JUNCTION).all(axis=1) & (ends[:, 0] != ends[:, 1])
    between = np.flatnonzero(is_between)
    length = np.array([net.stretch(int(b), 0).length for b in between])
    share = in_radii(length, net.radius[ends[between]].sum(axis=1))
    for k in np.argsort(share, kind="stable"):
        if share[k] > FARTHER * overlap:
            break
        one, other = (found[int(v)] for v in ends[between[k]])
        if one is other:
            continue
        both = one.with_other(other, int(between[k]))
        apart = farthest_apart(net, one, other)
        if apart <= overlap or (apart <= FARTHER * overlap and meets_in_point(net, both, ends)):
            found |= dict.fromkeys(both.members.tolist(), both)
    return list({id(crossing): crossing for crossing in found.values()}.values())


def farthest_apart(net: Net, one: Crossing, other: Crossing) -> float:
    """Greatest distance between junctions of two crossings, in sums of their radii."""
    away = net.points[one.members][:, None] - net.points[other.members][None]
    reach = net.radius[one.members][:, None] + net.radius[other.members][None]
    return float(in_radii(np.hypot(away[..., 0], away[..., 1]), reach).max())


def in_radii(length: Floats, radii: Floats) -> Floats:
    """Lengths in radii: without a radius, everything else is infinitely far away."""
    far = np.where(length > 0.0, np.inf, 0.0)
    found: Floats = np.divide(length, radii, out=far, where=radii > 0.0)
    return found


def meets_in_point(net: Net, crossing: Crossing, ends: Ints) -> bool:
    """Whether the arms of a crossing lead to one point, but for a part of their width."""
    arms = arms_of(net, crossing, ends)
    hub = hub_of(net, crossing, arms)
    lines = led_on(bundle_of(arms), hub)
    off, (x, y) = hub - lines.points, lines.directions.T
    astray = np.abs(x * off[:, 1] - y * off[:, 0])
    return bool((astray <= MEETING * np.array([arm.radius for arm in arms])).all())
