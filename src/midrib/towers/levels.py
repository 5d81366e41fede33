"""Levels: what the axis is at each height, how well it is known, and what is wrong there.

z         heights of the cloud's coordinates, at even steps
s         heights of the frame, along the rough axis
"""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from midrib.errors import ParameterError
from midrib.towers import gate
from midrib.towers.asides import asides_at
from midrib.towers.records import LEVELS
from midrib.towers.summary import azimuth_of

if TYPE_CHECKING:
    from midrib.towers.pipeline import Options, Shell
    from midrib.types import Bools, Floats

__all__ = ["Centres", "levels_of"]

LEAST_SHARE = 0.3  # of the usual coverage: less, and the tower has not begun or is over
SEEN = 200.0  # degrees that tell centre and radius apart
ARC = 40.0  # degrees of a level that are not enough for a centre
NEAR = 2.5  # metres above and below: what is seen there counts for a level
UNCERTAIN = 0.005  # metres: no level without a flag should be off by more
NORMAL, CERTAIN = 1.96, 3.72  # standard deviations: 95 % of one coordinate, 99.9 % of a distance
ROUGH, LEAST_ROUGH = 4.0, 5e-4  # times the usual residual; metres
FLOOR = 3e-5  # metres: what thinning to cells leaves of clutter, whatever the noise
OVAL = 0.0075  # metres: amplitude that a section may have where its shape cannot be told
NO_DATA = "no data"


class Centres(NamedTuple):
    """Centres at heights of the frame, of a mode that finds them level by level."""

    s: "Floats"  # (n,)
    xy: "Floats"  # (n, 2), NaN where there is none
    sigma: "Floats"  # (n, 2)
    why: "np.ndarray[Any, np.dtype[np.str_]]"  # (n,) reasons where there is none


class Seen(NamedTuple):
    """What is seen of the shell, level by level."""

    own: "Floats"  # degrees
    near: "Floats"  # degrees, levels near by together
    n: "Floats"  # points
    residual: "Floats"
    lure: "Floats"  # (n, 2): see gate.lure_of_an_oval, of what is seen near by


def levels_of(shell: "Shell", options: "Options", centres: Centres | None = None) -> Any:
    """Levels of a shell; with the centres of the joint fit unless given.

    Raises
    ------
    ParameterError
        If there is no level.
    """
    unit = options.unit
    frame, cells, fit = shell.cells.reference.frame, shell.cells, shell.fit
    s_axis = np.arange(cells.s.min(), cells.s.max(), cells.grid.level / 4.0)
    values = fit.values(s_axis)
    world = frame.outwards(np.column_stack([values[:, :2], s_axis]))
    step = options.step or cells.grid.level
    z, s, seen = heights_of(shell, world[:, 2], s_axis, step, unit)
    if not z.size:
        low, high = world[0, 2] / unit, world[-1, 2] / unit
        msg = (
            f"there is no level between z = {low:.2f} m and {high:.2f} m, where the tower is, at "
            f"steps of {step / unit:g} m, expected a smaller step"
        )
        raise ParameterError(msg)
    levels = np.zeros(z.size, dtype=LEVELS)
    levels["z"] = z
    untold = is_untold(shell, seen)
    xy, sigma, why = joint_centres(shell, s) if centres is None else at_heights(centres, s)
    # Planes through the axis have both walls of an oval alike; only a circle is drawn aside.
    drawn = OVAL * unit * seen.lure * (untold & (centres is None))[:, None]
    there = frame.outwards(np.column_stack([xy, s]))
    # The level is horizontal, the frame nearly so: a centre moves down its own slope to z.
    slope = np.gradient(world[:, :2], world[:, 2], axis=0)
    lift = (z - there[:, 2])[:, None]
    slopes = np.column_stack([np.interp(z, world[:, 2], column) for column in slope.T])
    levels["x"], levels["y"] = (there[:, :2] + lift * slopes).T
    levels["radius"] = fit.values(s)[:, 2]
    levels["coverage"], levels["n"], levels["residual"] = seen.own, seen.n, seen.residual
    oval = np.hypot(*fit.oval(s).T)
    is_told = shell.shape.name in {"round", "oval"}
    levels["ovality"] = 2.0 * oval / levels["radius"] if is_told else np.nan
    floor = (FLOOR * unit) ** 2
    outer = registration_of(shell, options) ** 2 + (1e-3 * options.levelling * (z - z[0])) ** 2
    levels["sigma_inner"] = np.sqrt((sigma**2 + drawn**2).sum(axis=1) / 2.0 + floor)
    levels["sigma_x"], levels["sigma_y"] = np.sqrt(sigma.T**2 + drawn.T**2 + floor + outer)
    levels["sigma"] = np.sqrt((levels["sigma_x"] ** 2 + levels["sigma_y"] ** 2) / 2.0)
    doubts = doubts_of(levels, sigma, unit)
    aside = asides_at(shell, s, xy, UNCERTAIN * unit)
    flags = flags_of(
        shell, s, seen, levels, why, doubts, untold, aside, told=options.registration > 0.0
    )
    levels["flag"] = flags
    unanswered = np.isnan(levels["x"]) | (seen.own == 0.0) | (seen.near < ARC)
    for name in ("x", "y", "radius", "sigma", "sigma_x", "sigma_y", "sigma_inner", "ovality"):
        levels[name][unanswered] = np.nan
    add_deviations(levels)
    return levels


def joint_centres(shell: "Shell", s: "Floats") -> "tuple[Floats, Floats, Any]":
    """Centres, standard deviations and no reasons of the joint fit."""
    variance = shell.fit.covariances(s)[:, [0, 1], [0, 1]]
    return (
        shell.fit.values(s)[:, :2],
        np.sqrt(np.maximum(variance, 0.0)),
        np.full(s.size, "", LEVELS["flag"]),
    )


def at_heights(centres: Centres, s: "Floats") -> "tuple[Floats, Floats, Any]":
    """Centres between their heights, where both neighbours are there."""
    xy = np.column_stack([np.interp(s, centres.s, column) for column in centres.xy.T])
    sigma = np.column_stack([np.interp(s, centres.s, column) for column in centres.sigma.T])
    nearest = np.abs(s[:, None] - centres.s).argmin(axis=1)
    return xy, sigma, centres.why[nearest]


def heights_of(
    shell: "Shell", z_axis: "Floats", s_axis: "Floats", step: float, unit: float
) -> "tuple[Floats, Floats, Seen]":
    """Heights z and s of the levels, and what is seen there; from where the tower begins."""
    first, last = np.ceil(z_axis[0] / step), np.floor(z_axis[-1] / step)
    z = step * np.arange(first, last + 1)
    s = np.interp(z, z_axis, s_axis)
    seen = seen_at(shell, s, step, unit)
    some = seen.own > 0.0
    usual = LEAST_SHARE * np.median(seen.own[some]) if some.any() else np.inf
    inside = np.flatnonzero(seen.own >= usual)
    rows = slice(inside[0], inside[-1] + 1) if inside.size else slice(None)
    return z[rows], s[rows], Seen(*(column[rows] for column in seen))


def seen_at(shell: "Shell", s: "Floats", step: float, unit: float) -> Seen:
    """Look what is seen of the shell around heights."""
    cells, fit = shell.cells, shell.fit
    used = fit.weight > 0.0
    width = 360.0 / cells.grid.n_sectors
    own, near, n, residual = (np.zeros(s.size) for _ in range(4))
    lure = np.zeros((s.size, 2))
    half = max(step, cells.grid.level) / 2.0 + 1e-9
    for i, at in enumerate(s):
        off = np.abs(cells.s - at)
        here = used & (off <= half)
        own[i] = np.unique(cells.sector[here]).size * width
        around = used & (off <= NEAR * unit)
        sectors = np.unique(cells.sector[around])
        near[i] = sectors.size * width
        lure[i] = gate.lure_of_an_oval(np.radians(sectors * width))
        n[i] = cells.n[here].sum()
        residual[i] = np.sqrt(np.mean(fit.residual[here] ** 2)) if here.any() else np.nan
    return Seen(own, near, n, residual, lure)


def is_untold(shell: "Shell", seen: Seen) -> "Bools":
    """Whether the gate could not look at the shape of the sections near each level."""
    if len(shell.cells.reference.faces):
        return np.zeros(seen.near.size, dtype=np.bool_)
    nowhere = shell.shape.name == "unknown" and not shell.shape.problem
    untold: Bools = (seen.near < gate.SEEN) | nowhere
    return untold


def flags_of(
    shell: "Shell",
    s: "Floats",
    seen: Seen,
    levels: Any,
    why: Any,
    doubts: Any,
    untold: "Bools",
    aside: "Floats",
    *,
    told: bool,
) -> "np.ndarray[Any, np.dtype[np.str_]]":
    """Flag of each level: why there is no centre, or everything that is wrong with it.

    ``told`` is whether sigma has what stations may be off by.
    """
    usual = max(np.nanmedian(levels["residual"]), LEAST_ROUGH * shell.unit)
    flags = np.full(s.size, "", dtype=LEVELS["flag"])
    in_dent = np.zeros(s.size, dtype=np.bool_)
    for low, high in shell.dents:
        in_dent |= (s >= low) & (s < high)
    # A hollow tower's faces may be hidden in part; only of round shells does the arc matter.
    is_round = not len(shell.cells.reference.faces)
    reach = max(shell.cells.grid.level, float(np.diff(s).max(initial=0.0))) * (1.0 + 1e-9)
    apart = np.full(s.size, shell.labels > 0 and not shell.stations and not told)

    def mark(rows: "Bools", text: Any) -> None:
        texts = np.full(s.size, text) if isinstance(text, str) else np.asarray(text)
        known = np.where(flags == "", "", "; ")
        added = np.char.add(np.char.add(flags, known), texts)
        flags[rows] = added[rows]

    mark(seen.own == 0.0, NO_DATA)
    mark(
        (seen.near < ARC) & (flags == ""),
        [f"only {arc:.0f}° of the shell seen" for arc in seen.near],
    )
    mark((why != "") & (flags == ""), why)
    mark(np.isnan(levels["x"]) & (flags == ""), NO_DATA)
    answered = flags == ""
    mark(answered & (shell.shape.problem != ""), shell.shape.problem)
    mark(answered & (doubts != ""), doubts)
    mark(
        answered & untold & (shell.shape.problem == ""),
        [f"shape not verified: {arc:.0f}° of the shell seen" for arc in seen.near],
    )
    mark(answered & is_round & (seen.near < SEEN), "radius from taper prior")
    mark(answered & apart, "stations not put together")
    mark(answered & in_dent, "dented, or partly hidden")
    mark(
        answered & (aside > 0.0),
        [f"its own section is {1e3 * a / shell.unit:.1f} mm aside" for a in aside],
    )
    # Cells of the level at which the axis leaps are partly below it and partly above.
    for leap, offset in zip(shell.fit.model.axis.leaps, shell.fit.leaps()[0], strict=True):
        size = 1e3 * float(np.hypot(*offset)) / shell.unit
        mark(answered & (np.abs(s - leap) <= reach), f"offset of {size:.1f} mm near by")
    for step, size in zip(shell.fit.model.taper.leaps, shell.fit.steps()[0], strict=True):
        text = f"step of the radius by {1e3 * size / shell.unit:.1f} mm near by"
        mark(answered & (np.abs(s - step) <= reach), text)
    mark(answered & (levels["residual"] > ROUGH * usual), "rough")
    return flags


def registration_of(shell: "Shell", options: "Options") -> float:
    """Find the centre's standard deviation by registration: as told, or as stations show.

    Stations that were put together share what is left of their shifts: that of the mean.
    """
    if not shell.stations:
        return options.registration
    shifts = np.array([(station.x, station.y) for station in shell.stations])
    n = len(shifts)
    shown = float(np.sqrt((shifts**2).sum() / 2.0 / (n - 1)))
    return max(shown, options.registration) / float(np.sqrt(n))


def doubts_of(levels: Any, inner: "Floats", unit: float) -> Any:
    """Say (n,) of levels that may be off by more than what goes without a flag by how much.

    By what the cloud tells, ``inner`` (n, 2), hardly any level may be; by registration and
    levelling too, which move all levels alike, the 95 % interval may not.
    """
    whole = NORMAL * np.maximum(levels["sigma_x"], levels["sigma_y"])
    alone = CERTAIN * inner.max(axis=1)
    texts = np.full(whole.size, "", dtype="<U64")
    for i in np.flatnonzero(np.fmax(whole, alone) > UNCERTAIN * unit):
        texts[i] = f"uncertain by {1e3 * whole[i] / unit:.1f} mm"
        if not whole[i] > UNCERTAIN * unit:
            texts[i] += f" and once in a thousand by {1e3 * alone[i] / unit:.1f} mm"
    return texts


def add_deviations(levels: Any) -> None:
    """Deviations from the vertical through the lowest level with a centre."""
    answered = np.flatnonzero(np.isfinite(levels["x"]))
    if not answered.size:
        levels["deviation"] = levels["azimuth"] = np.nan
        return
    base = levels[answered[0]]
    dx, dy = levels["x"] - base["x"], levels["y"] - base["y"]
    levels["deviation"] = np.hypot(dx, dy)
    levels["azimuth"] = azimuth_of(dx, dy)
