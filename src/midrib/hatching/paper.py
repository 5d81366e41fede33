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
import shapely

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
    probe = minimal_radii(strip, spacing=max(rule.least_gap / PROBES, total / 2.0**20), ends=None)
    stations = march(probe.stations, probe.radii, total, rule)
    curve = minimal_radii(strip, stations=stations, vertices=False, ends=None)
    _, row = np.unique(curve.stations, return_index=True)
    found = np.isin(stations, curve.stations[row])
    on_top, on_toe = np.full((stations.size, 2), np.nan), np.full((stations.size, 2), np.nan)
    on_top[found], on_toe[found] = curve.on_main[row], curve.on_auxiliary[row]
    places = shapely.line_interpolate_point(strip.main, stations[~found])
    on_top[~found] = shapely.get_coordinates(places)
    middle = np.where(found[:, None], (on_top + on_toe) / 2.0, on_top)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(middle, axis=0).T))])
    feet = np.full((stations.size, 2), np.nan)  # nothing looks for bare stretches
    local = np.full(stations.size, np.inf)  # the paper's rule takes radii as they are
    return Drawn(along, middle, on_top, on_toe, feet, local, found, BLIND)


def march(probes: Floats, lengths: Floats, total: float, rule: Rule) -> Floats:
    """Stations of strokes."""
    stations: list[float] = []
    station, a = 0.0, 0.0
    while True:
        c = float(np.interp(station, probes, lengths))
        station += float(rule.gaps(np.array([(a + c) / 2.0]))[0])
        if station >= total:
            return np.array(stations)
        stations.append(station)
        a = c
