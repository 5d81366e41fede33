"""What a report on a tower says, for pages and for paper: summary, table of levels, notes."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from midrib.towers.tolerance import VERDICTS, WITHIN, verdicts

if TYPE_CHECKING:
    from midrib.towers.records import TowerAxis
    from midrib.towers.tolerance import Tolerance
    from midrib.types import Bools

__all__ = ["TITLES", "Content", "headings_of", "notes", "rows_of_levels", "summary_lines"]

CHANCE = 3.0  # standard deviations of a coordinate: shifts that are no more may be none
DOUBTFUL = 6.0  # mm: stations registered as usual make a round tower as oval as that
TITLES = (
    "Axis: deviation from the vertical through the base",
    "Axis from above; radius, and what is seen",
    "Shell, unrolled: cells beyond the model",
    "Sections",
)
HEADINGS = (
    "z, m", "x, m", "y, m", "deviation, mm", "azimuth, °", "radius, m", "ovality, %", "seen, °",
    "points", "residual, mm", "sigma, mm",
)  # fmt: skip


class Content(NamedTuple):
    """What a report says."""

    title: str
    axis: "TowerAxis"
    tolerance: "Tolerance | None"
    source: str
    outer: str  # about registration and levelling, if these were given


def summary_lines(
    axis: "TowerAxis", tolerance: "Tolerance | None" = None, source: str = ""
) -> list[tuple[str, ...]]:
    """Return what there is to say about the axis as a whole, as pairs of name and text."""
    flagged, missing = int((axis.levels["flag"] != "").sum()), int((~axis.is_answered).sum())
    left_out = f"{axis.unusable:,} points without three finite coordinates"
    lines = [
        ("cloud", source),
        ("points on the shell", f"{axis.count:,}"),
        ("left out", left_out * bool(axis.unusable)),
        ("sections", sections_text(axis)),
        ("stations", stations_text(axis)),
        ("mode", axis.mode),
        ("levels", f"{len(axis.levels)}, {flagged} flagged, {missing} of these without a centre"),
    ]
    if len(axis.points) > 1:
        lines += axis_lines(axis)
    if tolerance is not None:
        lines.append(("tolerance", tolerance_text(axis, tolerance)))
    return [(name, text) for name, text in lines if text]


def axis_lines(axis: "TowerAxis") -> list[tuple[str, str]]:
    """Best line, deviations, uncertainty, breaks of an axis that there is."""
    s, mm, m = axis.summary, 1e3 / axis.unit, 1.0 / axis.unit
    straight = f"{s.straightness * mm:.1f} mm off the best line at {s.straightness_z * m:.1f} m"
    most = f"{s.deviation * mm:.1f} mm at {s.deviation_z * m:.1f} m"
    sigma = f"{np.nanmedian(axis.levels['sigma']) * mm:.2f} mm (median of the levels)"
    kinks = [f"{k.z * m:.0f} m ({k.turn:.1f} mm/m towards {k.azimuth:.0f}°)" for k in axis.kinks]
    offsets = [
        f"{o.z * m:.1f} m ({o.size * mm:.1f} ± {o.sigma * mm:.1f} mm towards {o.azimuth:.0f}°)"
        for o in axis.offsets
    ]
    steps = [
        f"{r.z * m:.1f} m ({r.size * mm:+.1f} ± {r.sigma * mm:.1f} mm)" for r in axis.radius_steps
    ]
    return [
        ("heights", f"{s.low * m:.2f} m to {s.high * m:.2f} m"),
        ("best line", f"leans by {s.slope:.2f} mm/m towards {s.azimuth:.1f}°"),
        ("straightness", straight),
        ("largest deviation", f"{most}; top {s.top_deviation * mm:.1f} mm"),
        ("sigma of the centre", sigma),
        ("kinks", ", ".join(kinks) or "none found"),
        ("offsets", ", ".join(offsets) or "none found"),
        ("steps of the radius", ", ".join(steps) or "none found"),
    ]


def sections_text(axis: "TowerAxis") -> str:
    """Say what the sections are, how oval, and what is wrong with them."""
    shape, oval = axis.shape, ""
    if shape.name == "oval" and 2 in shape.harmonics:
        size, sigma = (1e3 / axis.unit * value for value in shape.harmonics[2])
        oval = f" by {size:.1f} ± {sigma:.2f} mm, longest towards {shape.azimuth:.0f}°"
    return shape.text + oval + (f"; {shape.problem}" if shape.problem else "")


def stations_text(axis: "TowerAxis") -> str:
    """Say how stations were put together, or why not, and what sigma does not tell of them."""
    mm = 1e3 / axis.unit
    if axis.stations:
        parts = [
            f"{station.label}: {np.hypot(station.x, station.y) * mm:.1f} mm"
            for station in axis.stations
        ]
        most = max(station.sigma for station in axis.stations) * mm
        off = max(np.hypot(station.x, station.y) for station in axis.stations) * mm
        # Either coordinate of the farthest station's shift may be as large as that by chance.
        meaning = "so they fit together" if off < CHANCE * most else "so some did not fit together"
        return (
            f"{len(parts)}, put together where they overlap; off their mean by {', '.join(parts)}, "
            f"give or take {most:.1f} mm; {meaning}; sigma has what these tell of the mean"
        )
    if axis.labels:
        said = (
            f"{axis.labels}, but they could not be put together: what two of them see in common "
            "does not tell their shifts"
        )
    else:
        said = "not told apart by the points, so their shifts could not be checked"
    amplitude = axis.shape.harmonics.get(2, (0.0, 0.0))[0] * mm
    if axis.shape.name == "oval" and amplitude < DOUBTFUL:
        said += f"; that sections are oval by {amplitude:.1f} mm may be their registration"
    return f"{said}; registration is in sigma only if given"


def tolerance_text(axis: "TowerAxis", tolerance: "Tolerance") -> str:
    """Say how many levels are beyond a tolerance, undecided and within it, and where."""
    found = verdicts(axis.levels, tolerance, axis.unit)
    parts = [
        f"{count} {name}{at}"
        for name in VERDICTS
        if (count := int((found == name).sum()))
        for at in [f" ({heights_text(axis, found == name)})" if name != WITHIN else ""]
    ]
    return f"{tolerance.text}: of the levels, by their 95 % intervals, {', '.join(parts) or 'none'}"


def heights_text(axis: "TowerAxis", rows: "Bools") -> str:
    """Say from which height to which some levels are."""
    z = axis.levels["z"][rows] / axis.unit
    return f"{z[0]:.1f} m" if len(z) == 1 else f"{z[0]:.1f} m to {z[-1]:.1f} m"


def headings_of(tolerance: "Tolerance | None") -> tuple[str, ...]:
    """Headings of the table of levels."""
    return (*HEADINGS, *(["tolerance"] if tolerance is not None else []), "flag")


def rows_of_levels(
    axis: "TowerAxis", tolerance: "Tolerance | None" = None
) -> list[tuple[str, ...]]:
    """Table of the levels as texts under their headings, from the top down as the tower stands."""
    m, mm = 1.0 / axis.unit, 1e3 / axis.unit
    judged: list[tuple[str, ...]] = [()] * len(axis.levels)
    if tolerance is not None:
        judged = [(str(text),) for text in verdicts(axis.levels, tolerance, axis.unit)]
    rows = []
    for level, verdict in zip(axis.levels[::-1], judged[::-1], strict=True):
        numbers = [
            (level["z"] * m, 2), (level["x"] * m, 4), (level["y"] * m, 4),
            (level["deviation"] * mm, 1), (level["azimuth"], 1), (level["radius"] * m, 4),
            (100.0 * level["ovality"], 2), (level["coverage"], 0), (float(level["n"]), 0),
            (level["residual"] * mm, 1), (level["sigma"] * mm, 2),
        ]  # fmt: skip
        # Adding 0 makes 0 of -0.
        texts = [
            "" if np.isnan(value) else f"{round(float(value), digits) + 0.0:.{digits}f}"
            for value, digits in numbers
        ]
        rows.append((*texts, *verdict, str(level["flag"])))
    return rows


def notes(content: Content) -> str:
    """Say what the numbers mean."""
    judged = ""
    if content.tolerance is not None:
        judged = (
            " Beyond or within the tolerance are levels whose whole 95 % interval is; others are "
            "undecided."
        )
    return (
        "Sigma is the standard deviation of one coordinate of the centre, from what the cloud "
        f"tells about itself{content.outer}. Azimuths are clockwise from y (north).{judged}"
    )
