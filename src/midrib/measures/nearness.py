r"""How near a line is to where it should be: between its curves, or on another line.

main  ----------------------        d_m, d_a   distances of a point of the line
          | d_m                                to the main and the auxiliary curve
line  . . o . . . . . . . .
          | d_a
auxiliary -----------------
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.checks import is_number, shown
from midrib.errors import ParameterError
from midrib.kernels.frechet import frechet_distances
from midrib.measures.chains import (
    Chains,
    distances,
    flat_together,
    is_there,
    lines_of,
    one,
    shaped,
    unit_lengths,
    vertices,
)
from midrib.measures.widths import mean_width
from midrib.strip import Strip, check_strip

if TYPE_CHECKING:
    from midrib.types import Floats, Ints

__all__ = ["Deviation", "centredness", "deviation", "symmetry"]

STEPS = 1000  # into which the longer of two lines is divided if nothing is said
P95 = 95.0


class Deviation(NamedTuple):
    """How far lines are from references: floats, or arrays of the shape of the input.

    In coordinate units, in metres if ``geographic``. Of the two directions, from the line to the
    reference and back, the larger counts.

    Attributes
    ----------
    mean : float or ndarray of float64, shape (...)
        Mean distance.
    p95 : float or ndarray of float64, shape (...)
        Distance that 95 % of the length does not exceed.
    hausdorff : float or ndarray of float64, shape (...)
        Largest distance.
    frechet : float or ndarray of float64, shape (...)
        Shortest leash for two who walk along, one on each line, without going back.
    """

    mean: Any
    p95: Any
    hausdorff: Any
    frechet: Any


def centredness(line: Any, strip: Strip, *, spacing: float | None = None) -> "Floats":
    """How far off the middle a line is at its vertices: 0 centred, 1 on one of the two curves.

    At a point with the distances d_m to the main curve and d_a to the auxiliary curve it is
    ``abs(d_m - d_a) / (d_m + d_a)``: in a strip of width w twice the offset from the middle over w.

    Parameters
    ----------
    line : LineString or MultiLineString
        Usually inside the strip; Z is ignored.
    strip : Strip
        The strip the line belongs to; ``midrib.split`` proposes one.
    spacing : float, optional
        Take places at equal steps of at most this length along each part of the line, both ends
        included, in coordinate units; without it the vertices, as the line has them.

    Returns
    -------
    ndarray of float64, shape (n,)
        For each of the n vertices or places in order, between 0 and 1; NaN where both distances
        are 0, as in a corner that the curves share. Without a line, empty.

    Raises
    ------
    GeometryTypeError
        If ``line`` is not a line, or ``strip`` not a Strip.
    ParameterError
        If ``spacing`` is not positive and finite.

    Notes
    -----
    Distances are straight, whatever lies between. Caps and holes belong to neither curve: towards
    an end that is rounded or shared the measure says less and less, past an island it tells on
    which side the line runs. O((n + m) log m) for m vertices of the two curves.

    Examples
    --------
    >>> strip = Strip(LineString([(0, 0), (9, 0)]), LineString([(0, 2), (9, 2)]))
    >>> centredness(LineString([(0, 1), (4, 1.5), (9, 2)]), strip)
    array([0. , 0.5, 1. ])
    """
    lines = one(lines_of(line, "line"), "line")
    check_strip(strip)
    check_spacing(spacing)
    chains = vertices(lines)
    points = chains.points if spacing is None else places(chains, spacing)
    owner, unit = np.zeros(len(points), dtype=np.intp), np.ones((1, 2))
    to_main, to_auxiliary = (
        distances(points, owner, vertices(np.array([curve], dtype=object)), unit)
        for curve in (strip.main, strip.auxiliary)
    )
    with np.errstate(invalid="ignore"):
        return np.abs(to_main - to_auxiliary) / (to_main + to_auxiliary)


def deviation(
    lines: Any, references: Any, *, spacing: float | None = None, geographic: bool = False
) -> Deviation:
    """How far lines are from references: mean, 95th percentile, Hausdorff and Fréchet distance.

    Beside a straight reference that is as long, and d away from it, all four are d. Hausdorff
    only asks how near the nearest place is; Fréchet also in which order the places come.

    Parameters
    ----------
    lines : LineString or MultiLineString, or array_like of them, shape (...)
        Z is ignored.
    references : LineString or MultiLineString, or array_like of them, shape (...)
        Broadcast against ``lines``.
    spacing : float, optional
        Largest step between the places at which distances are taken, in coordinate units, in
        metres if ``geographic``. By default a thousandth of the longer of the two lines.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude; they are measured in a plane
        that is true to scale at the references' middle latitude.

    Returns
    -------
    Deviation
        ``mean``, ``p95``, ``hausdorff`` and ``frechet``: each a float or an ndarray of float64,
        shape (...). In coordinate units, in metres if ``geographic``; NaN where a line or a
        reference is missing or empty. ``frechet`` is NaN as well where one has several parts.

    Raises
    ------
    GeometryTypeError
        If something is not a line.
    ParameterError
        If ``spacing`` is not positive and finite.

    Notes
    -----
    Each is taken from the line to the reference and from the reference to the line; the larger
    counts, so the order of the two does not matter. Mean and percentile are over places at equal
    steps along each part, both ends included; for the Hausdorff distance the vertices count too,
    so that it is at most half a step too small. The Fréchet distance is the continuous one, to
    13 digits, whatever the spacing; a line may be travelled either way, the smaller counts.
    O((n + m) log (n + m)) for n and m places, and for the Fréchet distance O(n m) at worst.

    References
    ----------
    Alt and Godau, Computing the Fréchet distance between two polygonal curves, International
    Journal of Computational Geometry & Applications 5, 1995, 75-91.

    Examples
    --------
    >>> deviation(LineString([(0, 1), (9, 1)]), LineString([(0, 0), (9, 0)]))
    Deviation(mean=1.0, p95=1.0, hausdorff=1.0, frechet=1.0)
    """
    check_spacing(spacing)
    flat_lines, flat_references, like = flat_together(
        lines_of(lines, "lines"), lines_of(references, "references")
    )
    unit = unit_lengths(flat_references, geographic)
    sides = [in_units(vertices(flat), unit) for flat in (flat_lines, flat_references)]
    there = is_there(flat_lines) & is_there(flat_references)
    result = np.full((4, flat_lines.size), np.nan)
    for i in np.flatnonzero(there):
        line, reference = (chains_of(side, int(i)) for side in sides)
        result[:3, i] = deviation_of(line, reference, spacing)
        if line.goes_on.all() and reference.goes_on.all():
            result[3, i] = frechet(line.points, reference.points, result[2, i])
    return Deviation(*(shaped(row, like) for row in result))


def symmetry(
    lines: Any,
    swapped: Any,
    areas: Any,
    *,
    spacing: float | None = None,
    geographic: bool = False,
) -> Any:
    """How much a line changes if main and auxiliary curve change places: 0 if not at all.

    The mean distance between the curve of a strip and the curve of the strip with its two curves
    swapped, as a fraction of the mean width. Construct both in the same way.

    Parameters
    ----------
    lines : LineString or MultiLineString, or array_like of them, shape (...)
        Curves of strips. Z is ignored.
    swapped : LineString or MultiLineString, or array_like of them, shape (...)
        Curves of the same strips with main and auxiliary curve swapped, broadcast against
        ``lines``.
    areas : Polygon or MultiPolygon, or array_like of them, shape (...)
        The areas of the strips, broadcast against ``lines``; they give the mean width.
    spacing : float, optional
        Largest step between the places at which distances are taken, as in ``deviation``.
    geographic : bool, default False
        Whether coordinates are degrees of longitude and latitude, as in ``deviation``.

    Returns
    -------
    float or ndarray of float64, shape (...)
        Mean deviation over mean width; NaN where a line or an area is missing or empty, or a line
        has no length.

    Raises
    ------
    GeometryTypeError
        If something is not a line, or not an area.
    ParameterError
        If ``spacing`` is not positive and finite.

    Examples
    --------
    >>> strip = split(box(0, 0, 8, 2))
    >>> other = Strip(strip.auxiliary, strip.main, strip.area)
    >>> lines = [minimal_radii(s, ends="caps").line for s in (strip, other)]
    >>> symmetry(*lines, strip.area)
    0.0
    """
    first, second = lines_of(lines, "lines"), lines_of(swapped, "swapped")
    between = deviation(first, second, spacing=spacing, geographic=geographic).mean
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = np.divide(between, mean_width(lines, areas, geographic=geographic))
    return ratio if np.ndim(ratio) else float(ratio)


def deviation_of(
    line: Chains, reference: Chains, spacing: float | None
) -> tuple[float, float, float]:
    """Mean, 95th percentile and maximum of the distances of two lines."""
    step = max(total_length(line), total_length(reference)) / STEPS if spacing is None else spacing
    ways, farthest = [], 0.0
    for one_way, other in ((line, reference), (reference, line)):
        along = places(one_way, step)
        both = np.concatenate([along, one_way.points])
        apart = distances(both, owned_by_one(both), other, np.ones((1, 2)))
        ways.append(apart[: len(along)])
        farthest = max(farthest, float(apart.max()))
    mean = max(float(way.mean()) for way in ways)
    return mean, max(float(np.percentile(way, P95)) for way in ways), farthest


def frechet(p: "Floats", q: "Floats", at_least: float) -> float:
    """Fréchet distance of two chains, whichever way each of them runs."""
    shortest = np.inf
    for way in (q, q[::-1]):
        # The ends bound it below: most often they alone rule one way out.
        least = max(at_least, float(np.hypot(*(p[[0, -1]] - way[[0, -1]]).T).max()))
        if least < shortest:
            rows = np.ascontiguousarray(p), np.array([0, len(p)])
            other = np.ascontiguousarray(way), np.array([0, len(way)])
            shortest = min(shortest, float(frechet_distances(*rows, *other, np.array([least]))[0]))
    return shortest


def check_spacing(spacing: float | None) -> None:
    """Refuse a spacing that divides nothing."""
    if spacing is not None and not (is_number(spacing) and 0.0 < spacing < np.inf):
        msg = f"spacing is {shown(spacing)}, expected a positive and finite length"
        raise ParameterError(msg)


def in_units(chains: Chains, unit: "Floats") -> Chains:
    """Chains with their coordinates in other units."""
    return chains._replace(points=chains.points * unit[chains.owner])


def chains_of(chains: Chains, i: int) -> Chains:
    """Chains of one geometry."""
    first, stop = np.searchsorted(chains.owner, [i, i + 1])
    points = chains.points[first:stop]
    return Chains(points, owned_by_one(points), chains.goes_on[first : stop - 1])


def owned_by_one(points: "Floats") -> "Ints":
    """Owner of points that are all of the first geometry."""
    return np.zeros(len(points), dtype=np.intp)


def total_length(chains: Chains) -> float:
    """Length of all chains together."""
    return float(np.hypot(*np.diff(chains.points, axis=0)[chains.goes_on].T).sum())


def places(chains: Chains, spacing: float) -> "Floats":
    """Points along each chain at equal steps of at most ``spacing``, both ends included."""
    found = [np.empty((0, 2))]
    for part in np.split(chains.points, np.flatnonzero(~chains.goes_on) + 1):
        if part.size == 0:  # of no chain at all
            continue
        arc = np.append(0.0, np.cumsum(np.hypot(*np.diff(part, axis=0).T)))
        count = max(1, int(np.ceil(arc[-1] / spacing))) if spacing > 0.0 else 1
        at = np.arange(count + 1) / count * arc[-1]
        found.append(np.column_stack([np.interp(at, arc, column) for column in part.T]))
    return np.concatenate(found)
