"""From a cloud to the axis: sample, shape, reference, cells, gate, mode, levels.

A sample gives coarse cells and a shell to measure from; then the cloud is read once for fine cells,
and again where that shell was off by more than matters. Where stations are to be put together it is
read before that, station by station, which gives a better shell too. Memory does not depend on the
number of points.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np

from midrib.checks import check_library, is_number, shown
from midrib.errors import ParameterError
from midrib.towers.cells import FINE, Cells, Reference, cells_of, grid_for, reference_of, scale_of
from midrib.towers.cloud import Cloud, Tally, check_spacing, sample_of
from midrib.towers.faces import rough_polygon
from midrib.towers.gate import bands_of, shape_of, steady
from midrib.towers.joint import Fit, fit_cells
from midrib.towers.kinks import Kink, breaks_of, offsets_of, steps_of
from midrib.towers.levels import levels_of
from midrib.towers.oblong import Oval, oval_of
from midrib.towers.records import Shape, TowerAxis
from midrib.towers.rough import Rough, Search, rough_round
from midrib.towers.stations import Aligned, Station, labels_in, stations_of
from midrib.towers.thinning import Thinning

if TYPE_CHECKING:
    from midrib.types import Floats

__all__ = ["Mode", "Options", "ShapeName", "Shell", "axis_of", "untracked"]

Mode: TypeAlias = Literal["joint", "fan", "paper"]
ShapeName: TypeAlias = Literal["auto", "round", "polygon"]
Track: TypeAlias = Callable[["Iterable[Floats]", str], "Iterable[Floats]"]
MODES, SHAPES = ("joint", "fan", "paper"), ("auto", "round", "polygon")
SAMPLE = 200_000
BEYOND = 0.02  # of the height: the tower may go on where the sample has few points
MOST_OFF = (0.05, 0.012)  # of the radius, metres: a section whose points are farther off is another
BETTER = 0.6  # times as far off points are if the tower has faces, or is an oval
# Amplitude of an oval: of the reach of fine cells, which hold it, and of the radius, as more is
# near no circle.
MOST_OVAL, MOST_OVALITY = 0.92, 0.15
MOVED = 2e-4  # metres: fine cells are counted anew if their reference was off by more
MOVED_SHARE = 0.2  # of the residuals: less makes no difference to what the noise leaves
MOST_PASSES = 3
SEARCHES = 5  # for breaks, each beside those that the last one found
LEAST_HEIGHT = 0.05  # metres: less is a floor
HIGHEST = 1000.0  # metres: no tower is higher, but its millimetres are
MOST_LEVELS = 100_000  # a centimetre apart in the highest tower
LYING = 2.0  # times the height: a cloud that reaches so far sideways may have its tower lie
MOST_LEAN = 45.0  # degrees: more, and the axis reaches farther sideways than up
EXCUSED = 1.5  # times the registration: harmonics that are no more than that are the stations'


@dataclass(frozen=True)
class Options:
    """What a caller may choose; lengths in coordinate units unless said."""

    mode: Mode = "joint"
    shape: ShapeName = "auto"
    step: float | None = None
    unit: float = 1.0
    near: tuple[float, float] | None = None
    radius: tuple[float, float] | None = None
    registration: float = 0.0
    levelling: float = 0.0  # mm per m
    planes: int = 18
    thinning: Thinning = "moving-least-squares"

    def check(self) -> None:
        """Refuse values that an option cannot have.

        Raises
        ------
        ParameterError
            If there is one.
        MissingDependencyError
            If scipy is not installed.
        """
        for name, value, known in (
            ("mode", self.mode, MODES),
            ("shape", self.shape, SHAPES),
            ("thinning", self.thinning, ("average-depth", "moving-least-squares")),
        ):
            if value not in known:
                msg = f"{name} is {shown(value)}, expected {' or '.join(map(repr, known))}"
                raise ParameterError(msg)
        for name in ("unit", "step"):
            value = getattr(self, name)
            if value is not None and not (is_number(value) and 0.0 < value < np.inf):
                msg = f"{name} is {shown(value)}, expected a number above 0"
                raise ParameterError(msg)
        for name in ("registration", "levelling"):
            value = getattr(self, name)
            if not (is_number(value) and 0.0 <= value < np.inf):
                msg = f"{name} is {shown(value)}, expected a number from 0 on"
                raise ParameterError(msg)
        for name in ("near", "radius"):
            pair = getattr(self, name)
            if pair is not None and not (len(pair) == 2 and all(is_number(v) for v in pair)):
                msg = f"{name} is {shown(pair)}, expected two numbers"
                raise ParameterError(msg)
        if not isinstance(self.planes, int) or not 3 <= self.planes <= 36:
            msg = f"planes is {shown(self.planes)}, expected a whole number from 3 to 36"
            raise ParameterError(msg)
        check_library("scipy", "a tower's axis", "towers")


class Shell(NamedTuple):
    """What every mode starts from: the cells, and the joint fit of them."""

    cells: Cells
    fit: Fit
    shape: Shape
    dents: "Floats"  # heights (k, 2) of bands with a dent, of the frame
    kinks: list[Kink]
    unit: float  # coordinate units in a metre
    cloud: Cloud  # its stations put together
    stations: list[Station]  # those that could be told apart
    unusable: int  # points without three finite coordinates
    labels: int  # stations that the cloud names


def untracked(chunks: "Iterable[Floats]", _: str) -> "Iterable[Floats]":
    """Show no progress."""
    return chunks


def axis_of(cloud: Cloud, options: Options, track: Track = untracked) -> TowerAxis:
    """Axis of the tower in a cloud.

    Raises
    ------
    ParameterError
        If there are too few points, or no tower is found among them.
    """
    from midrib.towers.fan import fan
    from midrib.towers.paper import paper

    options.check()
    shell = shell_of(cloud, options, track)
    steps: dict[str, Any] = {}
    if options.mode == "joint":
        levels = levels_of(shell, options)
    elif options.mode == "fan":
        centres, steps = fan(shell, options)
        levels = levels_of(shell, options, centres)
    else:
        centres, steps = paper(shell, options, track)
        levels = levels_of(shell, options, centres)
    fit = shell.fit
    return TowerAxis(
        levels=levels,
        mode=options.mode,
        shape=shell.shape,
        unit=options.unit,
        crs=cloud.crs,
        count=int(shell.cells.n.sum()),
        cells=shell.cells,
        stations=shell.stations,
        unusable=shell.unusable,
        labels=shell.labels,
        kinks=shell.kinks,
        offsets=offsets_of(shell.cells, fit),
        radius_steps=steps_of(shell.cells, fit),
        residual=fit.residual,
        used=fit.weight > 0.0,
        steps=steps,
    )


def shell_of(cloud: Cloud, options: Options, track: Track) -> Shell:
    """Cells of the shell and the joint fit to them."""
    unit = options.unit
    sample, came = sample_of(track(cloud.some(SAMPLE), "sampling"), SAMPLE, cloud.name)
    labels, sample = labels_in(sample), np.ascontiguousarray(sample[:, :3])
    check_spacing(sample, cloud.types, unit, cloud.name)
    check_height(sample, options, cloud.name)
    rough = shape_found(sample, options)
    check_lean(rough, sample, unit)
    heights = rough.frame.inwards(sample)[:, 2]
    low, high = np.percentile(heights, [0.2, 99.8])
    margin = BEYOND * (high - low)
    low, high = float(low - margin), float(high + margin)
    reference, near = reference_of(rough, unit, low, high), on_shell(rough, sample, unit)
    coarse = cells_of([sample], reference, grid_for(low, high, near, unit), unit, fine=False)
    reference = refined(reference, fit_cells(coarse, unit, rough=True))
    count = float(cloud.count or came)
    grid = grid_for(low, high, near * count / len(sample), unit)
    stations: list[Station] = []
    if labels.size:
        chunks = track(cloud.chunks(with_stations=True), "stations")
        stations, larger = stations_of(chunks, labels, reference, grid, unit)
        cloud = Aligned(cloud, stations) if stations else cloud
        if larger.level.size:
            reference = refined(reference, fit_cells(larger, unit))
    for _ in range(MOST_PASSES):
        tally = Tally()
        cells = cells_of(
            tally.over(track(cloud.chunks(), "cells")), reference, grid, unit, fine=True
        )
        fit = fit_cells(cells, unit)
        used = cells.s[fit.weight > 0.0]
        moved = np.abs(fit.values(used) - reference.at(used)[:, :3]).max(initial=0.0)
        noise = float(np.median(np.abs(fit.residual)))
        if moved < max(MOVED * unit, MOVED_SHARE * noise) or cells.grid.enough < 4:
            break
        reference = refined(reference, fit)
    return Shell(*gated(cells, fit, options, told_apart=bool(stations)), unit, cloud, stations,
                 tally.unusable, labels.size)  # fmt: skip


def check_height(sample: "Floats", options: Options, name: str) -> None:
    """Refuse points that are all about as high, or higher than any tower, and too many levels.

    Raises
    ------
    ParameterError
        If no tower can be so low, or so high, or the step is too small for it.
    """
    unit = options.unit
    low, high = np.percentile(sample[:, 2], [0.2, 99.8]) / unit
    if high - low > HIGHEST:
        msg = (
            f"no tower was found: {name} has heights that differ by {high - low:,.0f} m, expected "
            f"at most {HIGHEST:,.0f} m; unit= (--unit mm) may be missing"
        )
        raise ParameterError(msg)
    if high - low < LEAST_HEIGHT:
        msg = (
            f"{name} has points between z = {low:.3f} m and {high:.3f} m only, expected a tower "
            f"at least {LEAST_HEIGHT:g} m high; is another coordinate the height?"
        )
        raise ParameterError(msg)
    if options.step is not None and (high - low) * unit / options.step > MOST_LEVELS:
        msg = (
            f"step is {options.step / unit:g} m, expected at most {MOST_LEVELS:,} levels in "
            f"{high - low:.2f} m of height"
        )
        raise ParameterError(msg)


def shape_found(sample: "Floats", options: Options) -> Rough:
    """Rough axis with the shape that is wanted, or that explains the sample better.

    Raises
    ------
    ParameterError
        If neither does.
    """
    unit = options.unit
    search = Search(unit, options.near, options.radius)
    polygon = rough_polygon(sample, search) if options.shape != "round" else None
    circular, why = None, "no flat faces were found"
    if options.shape != "polygon":
        try:
            circular = rough_round(sample, search)
        except ParameterError as error:
            why = str(error)
    oval = oval_of(sample, unit)
    check_oval(oval, min([fit.off for fit in (circular, polygon) if fit], default=np.inf), unit)
    if polygon and oval.off < BETTER * polygon.off:
        polygon = None
    found = circular or polygon
    if polygon and circular:
        found = polygon if polygon.off < BETTER * circular.off else circular
    if found is None:
        raise ParameterError(why + lying(sample, unit))
    if found.off > most_off(float(np.median(found.table[:, 3])), unit):
        far = "hardly any is near the best"
        if np.isfinite(found.off):
            far = f"half of them more than {found.off / unit:.2g} m off the best"
        msg = (
            "no tower was found: points are neither on circles nor on the faces of a regular "
            f"polygon, {far}; near= and radius= say where it is and how thick"
        )
        raise ParameterError(msg + lying(sample, unit))
    return found


def lying(sample: "Floats", unit: float) -> str:
    """Question whether the tower lies, for sentences that say there is none; empty if not."""
    x, y, z = reach_of(sample, unit)
    if max(x, y) < LYING * z:
        return ""
    return (
        f"; the cloud reaches {x:.1f} m by {y:.1f} m by {z:.1f} m (x, y, z): is another coordinate "
        "the height?"
    )


def reach_of(sample: "Floats", unit: float) -> "Floats":
    """How far a cloud reaches along x, y and z, in metres, but for its farthest points."""
    reach: Floats = np.ptp(np.percentile(sample, [0.2, 99.8], axis=0), axis=0) / unit
    return reach


def check_oval(oval: Oval, off: float, unit: float) -> None:
    """Refuse ovals that are too large for the cells of a circle.

    Raises
    ------
    ParameterError
        If the sections are such ovals rather than what points are ``off`` by so much.
    """
    most = min(MOST_OVAL * FINE[0] * scale_of(oval.radius, unit), MOST_OVALITY * oval.radius)
    if oval.size > most and oval.off < min(BETTER * off, most_off(oval.radius, unit)):
        msg = (
            f"the tower's sections are oblong: the radius is {oval.radius / unit:.2f} m, give or "
            f"take {oval.size / unit:.3f} m, expected at most {most / unit:.3f} m"
        )
        raise ParameterError(msg)


def most_off(radius: float, unit: float) -> float:
    """Distance from the sections that half of the points are within, if there is a tower."""
    return max(MOST_OFF[0] * radius, MOST_OFF[1] * unit)


def check_lean(rough: Rough, sample: "Floats", unit: float) -> None:
    """Refuse what looks like a tower but reaches farther sideways than up.

    Raises
    ------
    ParameterError
        If the rough axis does.
    """
    lean = float(np.degrees(np.arccos(min(abs(rough.frame.turn[2, 2]), 1.0))))
    if lean > MOST_LEAN:
        x, y, z = reach_of(sample, unit)
        msg = (
            f"no tower was found: what looks like one leans by {lean:.0f}° from z, in a cloud that "
            f"reaches {x:.1f} m by {y:.1f} m by {z:.1f} m (x, y, z), expected a tower that stands "
            "along z; is another coordinate the height?"
        )
        raise ParameterError(msg)


def on_shell(rough: Rough, sample: "Floats", unit: float) -> int:
    """How many points of the sample are near the rough shell."""
    q = rough.frame.inwards(sample)
    x, y, r = (np.interp(q[:, 2], rough.table[:, 0], rough.table[:, k]) for k in (1, 2, 3))
    way = np.column_stack([q[:, 0] - x, q[:, 1] - y])
    away = (way @ rough.faces.T).max(axis=1) if len(rough.faces) else np.hypot(*way.T)
    return int((np.abs(away - r) < np.minimum(0.1 * unit, 0.2 * r)).sum())


def refined(reference: Reference, fit: Fit) -> Reference:
    """Return the shell of a fit to measure from."""
    s = reference.start + reference.step * np.arange(len(reference.table), dtype=np.float64)
    values = fit.values(s)
    values[:, 2] = np.maximum(values[:, 2], 0.1 * np.median(values[:, 2]))
    return reference._replace(table=np.column_stack([values, fit.slopes(s)]))


def gated(
    cells: Cells, fit: Fit, options: Options, *, told_apart: bool
) -> "tuple[Cells, Fit, Shape, Floats, list[Kink]]":
    """Look at the shape of the sections and at breaks; ovals and leaps are fitted anew."""
    unit = options.unit
    bands = bands_of(cells, fit.residual, fit.weight, unit)
    radius = float(np.median(cells.reference.table[:, 2]))
    # Stations that do not fit together make lobes of about their own shifts.
    excused = 0.0 if told_apart else EXCUSED * options.registration
    shape, dents = shape_of(bands, cells.reference.faces, radius, unit, excused)
    is_oval = shape.name == "oval"
    if is_oval:
        fit = fit_cells(cells, unit, is_oval=True)
    left = bands_of(cells, fit.residual, fit.weight, unit) if is_oval else bands
    shape = steady(shape, left, unit, excused)
    breaks = breaks_of(cells, fit, unit)
    # A leap that a fit smooths counts as an error of the wall, in which other breaks drown.
    for _ in range(SEARCHES):
        if breaks.are_in(fit):
            break
        fit = fit_cells(cells, unit, is_oval=is_oval, leaps=breaks.leaps, steps=breaks.steps)
        breaks = breaks_of(cells, fit, unit)
    low = cells.grid.start + dents * bands.height
    return cells, fit, shape, np.column_stack([low, low + bands.height]), breaks.kinks
