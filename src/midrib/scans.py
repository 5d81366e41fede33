"""The door to towers: from a scan, in memory or in a file, to the axis."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from midrib.formats.clouds import open_cloud
from midrib.towers.cloud import ArrayCloud
from midrib.towers.pipeline import Mode, Options, ShapeName, axis_of, untracked
from midrib.towers.records import TowerAxis

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import ArrayLike

    from midrib.towers.thinning import Thinning
    from midrib.types import Floats

__all__ = ["tower_axis"]


def tower_axis(
    source: "str | Path | ArrayLike",
    mode: Mode = "joint",
    *,
    shape: ShapeName = "auto",
    step: float | None = None,
    near: tuple[float, float] | None = None,
    radius: tuple[float, float] | None = None,
    unit: float | None = None,
    registration: float = 0.0,
    levelling: float = 0.0,
    planes: int = 18,
    thinning: "Thinning" = "moving-least-squares",
    stations: "ArrayLike | None" = None,
    track: "Callable[[Iterable[Floats], str], Iterable[Floats]] | None" = None,
) -> TowerAxis:
    """Axis of a tower or chimney in a laser scan: centre, radius and uncertainty by levels.

    The wall is thinned to cells, half a metre high and five degrees wide, so that ladders,
    platforms and stray points fall away; then one model is fitted to all cells.

    Parameters
    ----------
    source : path or array_like, shape (n, 3)
        Points x, y, z with z up, as a file (.las, .laz, .e57, .ply, .xyz, .txt, .csv, .npy, .npz)
        or an array.
    mode : {"joint", "fan", "paper"}, default "joint"
        "joint": one spline for the axis and a stiff one for the taper, fitted to all cells at once;
        the only mode that answers where half of the shell is hidden. "fan": curves of minimal
        radii in ``planes`` planes through the axis, each from either wall, averaged at the same
        height. "paper": the two planes X and Y of the paper (of a tower with faces: across the
        faces), with every step in ``steps``.
    shape : {"auto", "round", "polygon"}, default "auto"
        What the sections are taken for; "auto" looks which explains the points.
    step : float, optional
        Distance of the levels in coordinate units; half a metre, or what the density of points
        allows, unless given.
    near : (float, float), optional
        A place, x and y, on or beside which the tower stands.
    radius : (float, float), optional
        Its least and largest radius.
    unit : float, optional
        Coordinate units in a metre: 3.2808… of feet. What the file says unless given, else 1.
    registration : float, default 0.0
        Standard deviation, in coordinate units, with which the stations were registered.
    levelling : float, default 0.0
        Standard deviation of the vertical in mm per m. Both are added to ``sigma``.
    planes : int, default 18
        Planes of the fan, 3 to 36.
    thinning : {"moving-least-squares", "average-depth"}, default "moving-least-squares"
        How walls become curves, for "paper".
    stations : array_like of int, shape (n,), optional
        Of an array: which points are from which station. Files have it in their own fields: point
        source (LAS), scan (E57), a property or column ``station`` (PLY, text with a heading).
        Stations that overlap are put together before anything is fitted.
    track : function of (iterable, str), optional
        Wraps the chunks of each reading to show progress.

    Returns
    -------
    TowerAxis
        ``levels``, ``line``, ``summary``, ``kinks``, ``offsets``, ``radius_steps``, ``shape``.

    Raises
    ------
    GeometryTypeError
        If the array has not three columns.
    ParameterError
        If a file cannot be read, an option has a value it cannot have, or no tower is found.
    MissingDependencyError
        If the library that reads the file is not installed.

    Notes
    -----
    1. A rough axis from a sample of 200,000 points. 2. The cloud is read in chunks, once or twice,
    and counted in a cube of level, sector and distance from the shell. 3. Of each cell the
    densest window, its median, and the mean near that. 4. Harmonics of the residuals tell circles
    from ovals and from what is neither. 5. The mode. O(n) time for n points, memory that does not
    depend on n. Sections are perpendicular to the axis.
    The uncertainty is what the cloud tells about itself. What it cannot tell, how well stations
    were registered and levelled, is ``registration`` and ``levelling``.

    References
    ----------
    Buczek, Area collapse algorithm computing new curve of 2D geometric objects, Geodesy and
    Cartography 66(1), 2017, 23-44, section 7.

    Examples
    --------
    >>> from midrib.towers import Scan, Tower
    >>> scan = Scan(Tower(height=40.0, lean=0.1), count=60_000, noise=(0.002, 0.002), seed=1)
    >>> axis = tower_axis(scan.points())
    >>> axis.shape.text, round(axis.summary.slope, 1)
    ('round', 2.5)
    """
    cloud = open_cloud(source) if isinstance(source, str | Path) else ArrayCloud(source, stations)
    if unit is None:
        unit = 1.0 if cloud.metres is None else 1.0 / cloud.metres
    options: dict[str, Any] = {"mode": mode, "shape": shape, "step": step, "unit": unit}
    options |= {"near": near, "radius": radius, "planes": planes, "thinning": thinning}
    chosen = Options(registration=registration, levelling=levelling, **options)
    return axis_of(cloud, chosen, track or untracked)
