r"""Hubs of crossings: the points where their arms meet.

If two arms are one road and the others are not, that road goes straight on and the others lead
there as they may: what is uncertain about a sharp branch bends the branch, not the road.

    ----------o-------------  through road, the middle of the lines of its two arms
             /
           /   branch
"""

import itertools
from typing import NamedTuple

import numpy as np

from midrib.curves.arms import Arm, Crossing, Net
from midrib.types import Floats

__all__ = ["bundle_of", "hub_of", "led_on"]

WEAK = 0.02  # of the larger eigenvalue: arms within 8 degrees do not say how far their lines meet
LED_ON = 4  # times at most, each to the hub of the last one
MOST_TURN = np.radians(45.0)  # of an arm that is led on
LEAST = 2.0**-52  # of the extent: what a disc weighs at least
SETTLED = 2.0**-20  # of the radius: where arms are straight the hub does not move again
HOLDS = (0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)  # what the middle weighs, of the weight of arms
ONE_ROAD = np.radians(30.0)  # two arms that turn less into each other may be one road
CLEARLY = 2.0  # times as much turns what is not


class Bundle(NamedTuple):
    """The arms of a crossing."""

    cuts: Floats  # (k, 2) from where they are led on
    directions: Floats  # (k, 2) of unit length, inwards
    bends: Floats  # (k, 2) how directions change with a unit of length
    weights: Floats  # (k,)


class Lines(NamedTuple):
    """Where arms lead: a point and a direction each."""

    points: Floats  # (k, 2)
    directions: Floats  # (k, 2) of unit length, inwards
    weights: Floats  # (k,)


def hub_of(net: Net, crossing: Crossing, arms: list[Arm]) -> Floats:
    """Point that is nearest to where all arms lead, weighted by how wide they are.

    It is in a disc of the crossing, of a branch inside it, or within reach of an arm: where they
    lead farther away it stays as near to the middle as that takes, and gives way along a road
    sooner than across it.
    """
    rows = np.concatenate([crossing.members, *(net.branches[b] for b in crossing.inner)])
    n = crossing.members.size
    places = np.concatenate([net.points[rows], *(arm.reach[0] for arm in arms)])
    radius = np.concatenate([net.radius[rows], *(arm.reach[1] for arm in arms)])
    # Between vertices next to each other discs may have no radius; their middle counts then.
    weights = np.maximum(radius[:n], LEAST * np.ptp(net.points))
    middle = np.average(places[:n], axis=0, weights=weights)
    bundle = bundle_of(arms)
    for hold in HOLDS:
        hub = middle
        for _ in range(LED_ON):
            last, hub = hub, meeting(middle, led_on(bundle, hub), hold)
            if np.abs(hub - last).max() <= SETTLED * radius[0]:
                break
        if (np.hypot(*(hub - places).T) <= radius).any():
            return hub
    largest: Floats = places[np.argmax(radius[:n])]
    return largest


def bundle_of(arms: list[Arm]) -> Bundle:
    """Arms as arrays."""
    columns = ((arm.cut, arm.direction, arm.bend, arm.weight) for arm in arms)
    return Bundle(*(np.array(column) for column in zip(*columns, strict=True)))


def led_on(bundle: Bundle, hub: Floats) -> Lines:
    """Lines of arms as far inwards as a hub is, bent as they are; by half a right angle at most."""
    away = bundle.cuts - hub
    length = np.hypot(away[:, 0], away[:, 1])[:, None]
    turn = np.hypot(bundle.bends[:, 0], bundle.bends[:, 1])[:, None] * length
    bend = bundle.bends * (MOST_TURN / np.maximum(turn, MOST_TURN)) * length
    direction = bundle.directions + bend
    points = bundle.cuts + (bundle.directions + bend / 2.0) * length
    size = np.hypot(direction[:, 0], direction[:, 1])[:, None]
    unit = direction / np.maximum(size, np.finfo(np.float64).tiny)  # a point leads nowhere
    return Lines(points, unit, bundle.weights)


def meeting(middle: Floats, lines: Lines, hold: float) -> Floats:
    """Point where lines meet: on the through road if there is one, else nearest to all."""
    pair = through(lines)
    return nearest_to(middle, lines, hold) if pair is None else on_road(middle, lines, pair, hold)


def through(lines: Lines) -> tuple[int, int] | None:
    """Return the two arms that are one road, None if there are none, or more such roads than one.

    No other arm comes near to going on into one of them.
    """
    turn = np.arccos(np.clip(-lines.directions @ lines.directions.T, -1.0, 1.0))
    np.fill_diagonal(turn, np.pi)
    rows = turn.tolist()
    found = []
    for i, j in itertools.combinations(range(len(rows)), 2):
        least = rows[i][j]
        others = [row[m] for row in (rows[i], rows[j]) for m in range(len(rows)) if m not in (i, j)]
        if least <= ONE_ROAD and others and CLEARLY * least <= min(others):
            found.append((i, j))
    return found[0] if len(found) == 1 else None


def on_road(middle: Floats, lines: Lines, pair: tuple[int, int], hold: float) -> Floats:
    """Point of a through road that is nearest to where the other arms lead.

    Where these hardly differ in direction from the road it is as near to the middle as can be.
    """
    i, j = pair
    others = [k for k in range(len(lines.points)) if k not in pair]
    along = lines.directions[i] - lines.directions[j]
    along = along / np.hypot(*along)
    share = lines.weights[[i, j]]
    road = share @ lines.points[[i, j]] / share.sum()
    base: Floats = road + ((middle - road) @ along) * along
    off, direction = lines.points[others] - base, lines.directions[others]
    weight = lines.weights[others]
    across = np.column_stack([-direction[:, 1], direction[:, 0]])
    pull, known = across @ along, weight.sum()
    stiffness = float(weight @ pull**2)
    if stiffness <= WEAK * known:
        return base
    step = weight @ (pull * (across * off).sum(axis=1)) / (stiffness + hold * known)
    hub: Floats = base + step * along
    return hub


def nearest_to(middle: Floats, lines: Lines, hold: float) -> Floats:
    """Point with the least weighted squares of distances to lines.

    Where these hardly differ in direction they do not say how far along it is: there it stays in
    the middle, which holds it by so much of the weight across.
    """
    off = lines.points - middle
    across = np.column_stack([-lines.directions[:, 1], lines.directions[:, 0]])
    normal = np.einsum("k,ki,kj->ij", lines.weights, across, across)
    pull = np.einsum("k,ki,k->i", lines.weights, across, (across * off).sum(axis=1))
    value, axis = np.linalg.eigh(normal)
    is_known = value > WEAK * value[-1]
    step = (axis.T @ pull)[is_known] / (value[is_known] + hold * value[-1])
    nearest: Floats = middle + axis[:, is_known] @ step
    return nearest
