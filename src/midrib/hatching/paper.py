"""The procedure of the paper, for comparison.

    P0   P1    P2          From a point P of the top to the nearest Q of the toe that it sees; the
 ---+----+-----+----       next P is b = (a + c) / 4 farther, where a and c are the lengths of the
    : a  : c   :           last two strokes. Every second stroke is trimmed to the curve of minimal
 ---+----+-----+----       radii, that is halved.
    Q0   Q1    Q2

Source: Buczek, Area collapse algorithm computing new curve of 2D geometric objects, Geodesy and
Cartography 66(1), 2017, section 5, Eq. 2 and Fig. 12.
"""

import numpy as np

from midrib.curves.minimal_radii import minimal_radii
from midrib.errors import InvalidAreaError
from midrib.hatching.matching import Drawn
from midrib.hatching.rule import Rule
from midrib.strip import Strip
from midrib.types import Floats

__all__ = ["draw_by_paper"]

BLIND = "the top sees nothing of the toe here; one stroke is left out"
PROBES = 4.0  # for each least gap


def draw_by_paper(strip: Strip, rule: Rule) -> Drawn:
    """Whole strokes from the first point of the top on.

    Lengths are those of radii as far apart as a quarter of the least gap, and between them in
    proportion.

    Raises
    ------
    InvalidAreaError
        If the edges are closed: the procedure has no start there.
    """
    if strip.is_closed:
        msg = "top and toe are closed, which rule='paper' does not hatch; rule='matching' does"
        raise InvalidAreaError(msg)
    total = strip.main.length
    least = rule.min_spacing if rule.factor is not None else rule.spacing or 0.0
    probe = minimal_radii(strip, spacing=max(least / PROBES, total / 2.0**20), ends=None)
    stations, gaps = march(probe.stations, probe.radii, total, rule, least)
    curve = minimal_radii(strip, stations=stations, vertices=False, ends=None)
    _, row = np.unique(curve.stations, return_index=True)
    found = np.isin(stations, curve.stations[row])
    on_top, on_toe = np.full((stations.size, 2), np.nan), np.full((stations.size, 2), np.nan)
    on_top[found], on_toe[found] = curve.on_main[row], curve.on_auxiliary[row]
    on_top[~found] = [strip.main.interpolate(s).coords[0] for s in stations[~found]]
    middle = np.where(found[:, None], (on_top + on_toe) / 2.0, on_top)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(middle, axis=0).T))])
    return Drawn(along, middle, on_top, on_toe, gaps, found, BLIND)


def march(
    probes: Floats, lengths: Floats, total: float, rule: Rule, least: float
) -> tuple[Floats, Floats]:
    """Stations of strokes, and the gap before each."""
    factor = rule.factor or 0.0
    most = np.inf if rule.max_spacing is None else rule.max_spacing
    stations, gaps = [], []
    station, a = 0.0, 0.0
    while True:
        c = float(np.interp(station, probes, lengths))
        gap = min(max(factor * (a + c) / 2.0, least), most)
        station += gap
        if station >= total:
            break
        stations.append(station)
        gaps.append(gap)
        a = c
    return np.array(stations), np.array(gaps)
