"""Stations of strokes: between two neighbours lies the mean of the gaps that both ask for.

b(tau)    gap that the rule asks for at a station, linear between rungs
stretch   factor that makes a whole count of gaps fit

    tau[k + 1] - tau[k] = stretch (b(tau[k]) + b(tau[k + 1])) / 2

With b = factor w that is Eq. 2 of the paper, b = (a + c) / 4 for the factor 1/2, whichever end the
strokes are counted from.
"""

import numpy as np

from midrib.kernels.jit import njit
from midrib.types import Floats

__all__ = ["place_strokes"]

HALVINGS = 50
WIDEST = 16.0  # stretch of a slope that is long enough for one gap


@njit(borrows=True)
def march(
    tau: Floats, gap: Floats, stretch: float, offset: float, stations: Floats
) -> tuple[int, float]:
    """Write the stations of strokes; return how many, and how many gaps the whole line has.

    The first is ``offset`` gaps from the start. ``stations`` may be too short for all of them.
    """
    n, j, count = tau.size, 0, 0
    total, at, b, share = tau[n - 1], tau[0], gap[0], offset
    while True:
        # The next station is where the line reaches as far as the mean of both gaps asks for.
        k = j
        reached = False
        while k + 1 < n:
            short = at + share * stretch * (b + gap[k + 1]) / 2.0 - tau[k + 1]
            if short <= 0.0:
                reached = True
                break
            k += 1
        if not reached:
            break
        low = max(tau[k], at)
        slope = (gap[k + 1] - gap[k]) / (tau[k + 1] - tau[k])
        b_low = gap[k] + slope * (low - tau[k])
        missing = at + share * stretch * (b + b_low) / 2.0 - low
        step = missing / (1.0 - share * stretch * slope / 2.0)
        new = min(low + max(step, 0.0), tau[k + 1])
        b = gap[k] + slope * (new - tau[k])
        at, j, share = new, k, 1.0
        if count < stations.size:
            stations[count] = at
        count += 1
    rest = (total - at) / (stretch * (b + gap[n - 1]) / 2.0)
    return count, rest + (offset + count - 1 if count > 0 else 0.0)


@njit(entry=True)
def place_strokes(tau: Floats, gap: Floats, offset: float, period: int) -> tuple[Floats, float]:
    """Place strokes along a line.

    Parameters
    ----------
    tau, gap : (n,) stations of rungs and the gaps asked for there
    offset : gaps from the start to the first stroke, and from the last stroke to the end; 0 for a
        closed line, on which the last gap leads to the first stroke
    period : the count of gaps is a multiple of it

    Returns
    -------
    stations : (k,) increasing
    stretch : by how much gaps are wider than asked for
    """
    none = np.empty(0)
    _, gaps = march(tau, gap, 1.0, offset, none)
    count = period * max(round((gaps - 2.0 * offset) / period), 1 if offset == 0.0 else 0)
    low, high = 1.0 / WIDEST, WIDEST
    for _ in range(HALVINGS):
        stretch = np.sqrt(low * high)
        _, gaps = march(tau, gap, stretch, offset, none)
        if gaps > count + 2.0 * offset:
            low = stretch
        else:
            high = stretch
    stations = np.empty(count + 1 if offset > 0.0 else count)
    # At the lower bound no stroke is missing by rounding.
    found, _ = march(tau, gap, low, offset, stations)
    return stations[: min(found, stations.size)], low
