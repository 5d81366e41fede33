"""How good hatchings are: shapes, random slopes, rings, real registers; and rivals beside them.

Writes the figures of docs/hatching.md and a sheet of the worst cases to out/hatching.png.
"""

import argparse
import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString

from hatch_slopes import (
    KINDS,
    Slope,
    deep_bays,
    noisy,
    random_slopes,
    real_dutch,
    real_polish,
    shapes,
)
from hatching_bare import bare_runs, unexplained
from midrib import Strip, minimal_radii
from midrib.errors import MidribError
from midrib.hatching import Hatching, Rule, hatch
from midrib.hatching.measures import Measures, measure, measure_strokes, untold
from midrib.hatching.middle import middle_of
from tables import ROOT, machine_text, markdown, write_json

Floats = NDArray[np.float64]
Ends = tuple[Floats, Floats]
PAGE = ROOT / "docs" / "hatching.md"
BEGIN, END = "<!-- figures -->", "<!-- end of figures -->"
SEED, COUNT = 1000, 1200
PICTURED = ("L_top_outer", "s_curve", "bay", "spur_bottom")
HEAD = (
    "slopes", "strokes", "crossings", "outside", "short of an edge", "problems",
    "spacing within 0.9 to 1.1", "worst spacing", "worst gap on top, toe", "least foot",
    "turned too far", "worst turn", "tilt, 99 %, worst", "stretch", "worst end gap",
    "places beyond a bound", "without a problem", "gaps over the rule's", "bare places, untold",
)  # fmt: skip


MOST_TURN = 10.0  # degrees that noise may turn strokes
TURNED = ("slopes", "half of them", "19 of 20", "worst", f"more than {MOST_TURN:g}°")


class Row(NamedTuple):
    """A hatching and its numbers."""

    name: str
    strip: Strip
    hatching: Hatching | None
    strokes: NDArray[np.object_]
    measures: Measures
    problems: int
    untold: int  # places beyond a bound that no problem names
    bare: int = 0  # runs of places on edges that are far from strokes, by plain distances
    bare_untold: int = 0  # those that no problem is near to


# -- rivals ----------------------------------------------------------------------------------------


def stations_of(strip: Strip, gap: float) -> Floats:
    """Stations on the top, about a gap apart."""
    count = max(round(strip.main.length / gap), 2)
    stations: Floats = strip.main.length * np.arange(1, count) / count
    return stations


def by_normals(strip: Strip, stations: Floats) -> Ends:
    """Draw normals of the top, as far as the boundary."""
    on_top = points_at(strip.main, stations)
    before = points_at(strip.main, np.maximum(stations - 1e-6, 0.0))
    after = points_at(strip.main, stations + 1e-6)
    along = (after - before) / np.hypot(*(after - before).T)[:, None]
    left = np.column_stack([-along[:, 1], along[:, 0]])
    inwards = shapely.contains_xy(strip.area, *(on_top + 1e-6 * left).T)
    left[~inwards] *= -1.0
    x_low, y_low, x_high, y_high = strip.area.bounds
    far = on_top + left * (x_high - x_low + y_high - y_low)
    rays = shapely.linestrings(np.stack([on_top + 1e-9 * left, far], axis=1))
    hits = shapely.shortest_line(
        shapely.points(on_top), shapely.intersection(rays, strip.area.boundary)
    )
    return on_top, shapely.get_coordinates(shapely.get_point(hits, -1))


def by_proportion(strip: Strip, stations: Floats) -> Ends:
    """Equal shares of top and toe."""
    share = stations / strip.main.length
    return points_at(strip.main, stations), points_at(
        strip.auxiliary, share * strip.auxiliary.length
    )


def by_nearest(strip: Strip, stations: Floats) -> Ends:
    """Draw to the nearest point of the toe that is seen, as the paper does."""
    curve = minimal_radii(strip, stations=stations, vertices=False, ends=None)
    _, rows = np.unique(curve.stations, return_index=True)
    return curve.on_main[rows], curve.on_auxiliary[rows]


def by_dropping(strip: Strip, stations: Floats) -> Ends:
    """Draw normals, but for those that cross one drawn already or do not end on the toe."""
    on_top, on_toe = by_normals(strip, stations)
    kept: list[int] = []
    lines = shapely.linestrings(np.stack([on_top, on_toe], axis=1))
    reaches = shapely.distance(shapely.points(on_toe), strip.auxiliary) < 1e-6
    for i in range(len(lines)):
        if reaches[i] and not (kept and shapely.intersects(lines[kept], lines[i]).any()):
            kept.append(i)
    return on_top[kept], on_toe[kept]


RIVALS: dict[str, Callable[[Strip, Floats], Ends]] = {
    "normals, clipped": by_normals,
    "proportional": by_proportion,
    "nearest visible (the paper)": by_nearest,
    "normals, dropped on conflict": by_dropping,
}


def points_at(line: LineString, stations: Floats) -> Floats:
    """Points of a line."""
    points: Floats = shapely.get_coordinates(shapely.line_interpolate_point(line, stations))
    return points


def gap_of(strip: Strip) -> float:
    """Half the mean width: one gap for the whole slope, so that every rival can keep it."""
    return float(strip.area.area / strip.main.length / 2.0)


def rival_row(name: str, slope: Slope, draw: Callable[[Strip, Floats], Ends]) -> Row:
    """Measure a rival on one slope; long and short strokes in turn."""
    strip, gap = slope.strip, gap_of(slope.strip)
    on_top, on_toe = draw(strip, stations_of(strip, gap))
    is_long = np.arange(len(on_top)) % 2 == 0
    share = np.where(is_long, 1.0, 0.5)[:, None]
    strokes = shapely.linestrings(np.stack([on_top, on_top + share * (on_toe - on_top)], axis=1))
    rule = Rule(factor=None, spacing=gap)
    middle = LineString(middle_of(strip).line)
    found = measure_strokes(strip, rule, middle, strokes, is_long, on_top, on_toe)
    return Row(f"{name}: {slope.name}", strip, None, strokes, found, 0, len(found.beyond))


# -- tables ----------------------------------------------------------------------------------------


def hatched(slopes: Iterable[Slope], **options: Any) -> list[Row]:
    """Hatch and measure."""
    rows = []
    for slope in slopes:
        hatching = hatch(slope.strip, **options)
        found = measure(hatching)
        count = len(hatching.problems)
        rows.append(
            Row(
                slope.name,
                slope.strip,
                hatching,
                hatching.strokes,
                found,
                count,
                len(untold(hatching, found)),
                len(bare_runs(hatching)),
                len(unexplained(hatching)),
            )
        )
    return rows


def evenly(slopes: Iterable[Slope]) -> list[Row]:
    """Hatch with the one gap that rivals have."""
    return [
        row
        for slope in slopes
        for row in hatched([slope], scale=1000, spacing=gap_of(slope.strip), min_spacing=1e-3)
    ]


def summary(title: str, rows: list[Row]) -> list[str]:
    """One line of the table."""
    every = [row.measures for row in rows]
    spacing = np.concatenate([m.spacing for m in every])
    beyond = np.concatenate([m.turns - m.allowed for m in every])
    turns = np.concatenate([m.turns for m in every])
    tilts = np.concatenate([m.tilts for m in every])
    raw = np.concatenate([m.spacing * m.stretch for m in every])
    bare = f"{sum(row.bare for row in rows):,}, {sum(row.bare_untold for row in rows):,}"
    if rows[0].hatching is None:
        bare = ""
    within = np.mean((spacing >= 0.9) & (spacing <= 1.1))
    return [
        f"{title} ({len(rows)})",
        f"{sum(m.strokes for m in every):,}",
        f"{sum(m.crossings for m in every):,}",
        f"{max(m.outside for m in every):.2g}",
        f"{sum(m.short_of_edge for m in every):,}",
        f"{sum(row.problems for row in rows):,}",
        f"{100.0 * within:.2f} %",
        f"{spacing.min():.2f} to {spacing.max():.2f}",
        f"{max(m.top_gap for m in every):.2f}, {max(m.toe_gap for m in every):.2f}",
        f"{min(m.least_foot for m in every):.2f}",
        f"{100.0 * np.mean(beyond > 0.5):.2f} %",
        f"{turns.max():.0f}°",
        f"{np.percentile(tilts, 99):.1f}°, {tilts.max():.1f}°" if tilts.size else "",
        f"{min(m.stretch for m in every):.2f} to {max(m.stretch for m in every):.2f}",
        f"{max(m.end_gap for m in every):.1f}",
        f"{sum(len(m.beyond) for m in every):,}",
        f"{sum(row.untold for row in rows):,}",
        f"{raw.min():.2f} to {raw.max():.2f}",
        bare,
    ]


def turned_by_noise(slopes: Iterable[Slope], share: float) -> Floats:
    """Largest change of direction of a stroke of each slope under noise on its top, in degrees.

    Strokes move along the slope too, so that each is held against directions that strokes of the
    calm slope have within half a gap, in proportion between two of them.
    """
    changes = []
    for i, slope in enumerate(slopes):
        shaken = noisy(slope.strip, share, SEED + i)
        if shaken is None:
            continue
        calm, moved = hatch(slope.strip), hatch(shaken)
        assert calm.ground is not None
        assert moved.ground is not None
        rungs, line = calm.ground.ladder.rungs, LineString(calm.ground.middle.line)
        pivots = points_at(LineString(moved.ground.middle.line), moved.station)
        at = shapely.line_locate_point(line, shapely.points(pivots))
        gap, drawn = np.interp(at, rungs[:, 0], rungs[:, 6]), drawn_directions(calm)
        across = moved.on_toe - moved.on_top
        angle = np.arctan2(across[:, 1], across[:, 0])
        off = [
            angle - np.interp(at + half * gap, rungs[:, 0], drawn)
            for half in np.linspace(-0.5, 0.5, 5)
        ]
        turned = np.degrees(abs((np.array(off) + np.pi) % (2 * np.pi) - np.pi)).min(axis=0)
        changes.append(turned.max(initial=0.0))
    return np.array(changes)


def drawn_directions(hatching: Hatching) -> Floats:
    """Directions at the rungs of a slope: the ladder's, turned as the strokes beside them are."""
    assert hatching.ground is not None
    rungs = hatching.ground.ladder.rungs
    order = np.argsort(hatching.station)
    station, across = hatching.station[order], (hatching.on_toe - hatching.on_top)[order]
    turn = np.arctan2(across[:, 1], across[:, 0]) - np.interp(station, rungs[:, 0], rungs[:, 4])
    turn = (turn + np.pi) % (2.0 * np.pi) - np.pi
    directions: Floats = rungs[:, 4] + np.interp(rungs[:, 0], station, turn)
    return directions


def turned_row(name: str, turns: Floats) -> list[str]:
    """One line about noise: of how many slopes, and how far strokes turn."""
    far = int(np.count_nonzero(turns > MOST_TURN))
    half, most = np.percentile(turns, [50, 95])
    return [
        f"{name} ({turns.size})",
        f"{half:.1f}°",
        f"{most:.1f}°",
        f"{turns.max():.1f}°",
        str(far),
    ]


def speed(n: int, spacing: float, noise: float) -> tuple[int, float]:
    """Strokes, and CPU seconds for them, on a slope with edges of n vertices; the best of seven.

    It is 10 wide, and both edges have noise of so much.
    """
    rng = np.random.default_rng(SEED)
    x = np.linspace(0.0, 2.0 * n, n)
    middle = 20.0 * np.sin(x / 60.0)
    top, toe = (
        LineString(np.column_stack([x, middle + side + rng.normal(0.0, noise, n)]))
        for side in (5.0, -5.0)
    )
    return best_of_seven([(top, toe, None)], scale=1000, spacing=spacing)


def best_of_seven(
    curves: list[tuple[LineString, LineString, Any]], **options: Any
) -> tuple[int, float]:
    """Strokes, and CPU seconds for them, on some slopes; the best of seven times."""
    best, count = np.inf, 0
    for _ in range(7):
        strips = [Strip(*some) for some in curves]  # they keep their triangles: each run needs new
        start = time.process_time()
        count = sum(len(hatch(strip, **options).strokes) for strip in strips)
        best = min(best, time.process_time() - start)
    return count, best


def worst_sheet(rows: list[Row], path: Path, count: int = 12) -> None:
    """Draw the slopes with the worst spacing, turn, gap and foot."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    keys: list[Callable[[Row], float]] = [
        lambda row: float(abs(np.log(row.measures.spacing)).max(initial=0.0)),
        lambda row: float((row.measures.turns - row.measures.allowed).max(initial=-90.0)),
        lambda row: max(row.measures.top_gap, row.measures.toe_gap),
        lambda row: -row.measures.least_foot,
    ]
    chosen = {row.name: row for key in keys for row in sorted(rows, key=key)[-count // len(keys) :]}
    columns = 3
    lines = -(-len(chosen) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(9 * columns, 7 * lines), squeeze=False)
    for plot in axes.flat:
        plot.axis("off")
    for plot, row in zip(axes.flat, chosen.values(), strict=False):
        hatching, (x, y) = row.hatching, row.strip.area.centroid.coords[0]
        assert hatching is not None
        for line, colour in ((row.strip.main, "tab:red"), (row.strip.auxiliary, "tab:blue")):
            plot.plot(*(shapely.get_coordinates(line) - (x, y)).T, color=colour, linewidth=1)
        for stroke, is_long in zip(hatching.strokes, hatching.is_long, strict=True):
            points = shapely.get_coordinates(stroke) - (x, y)
            plot.plot(*points.T, color="black" if is_long else "0.5", linewidth=1)
        plot.set_aspect("equal")
        found = row.measures
        plot.set_title(
            f"{row.name}: spacing {found.spacing.min():.2f} to {found.spacing.max():.2f}, "
            f"turn {found.turns.max(initial=0.0):.0f}°, "
            f"gaps {found.top_gap:.2f} {found.toe_gap:.2f}"
        )
    figure.tight_layout()
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=50)
    plt.close(figure)


def picture(made: list[Slope], path: Path) -> None:
    """Draw some shapes by clipped normals, by nearest points and by matching, with one gap."""
    import matplotlib as mpl

    mpl.use("Agg")
    mpl.rcParams["svg.hashsalt"] = "midrib"
    import matplotlib.pyplot as plt

    some = [slope for slope in made if slope.name in PICTURED]
    ways = [(name, RIVALS[name]) for name in list(RIVALS)[:3:2]]
    figure, axes = plt.subplots(len(some), 3, figsize=(12, 2.6 * len(some)))
    for plots, slope in zip(axes, some, strict=True):
        drawn = [rival_row(name, slope, draw) for name, draw in ways] + evenly([slope])
        for plot, row, title in zip(
            plots, drawn, (*(name for name, _ in ways), "matching"), strict=True
        ):
            for line, colour in (
                (slope.strip.main, "tab:red"),
                (slope.strip.auxiliary, "tab:blue"),
            ):
                plot.plot(*shapely.get_coordinates(line).T, color=colour, linewidth=1)
            ends = shapely.get_coordinates(row.strokes).reshape(-1, 2, 2)
            for stroke in ends:
                plot.plot(*stroke.T, color="black", linewidth=0.8)
            plot.set_title(title, fontsize=9)
            plot.set_aspect("equal")
            plot.axis("off")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def main() -> int:
    """Measure, write the page, draw the sheet."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=COUNT, help="random slopes")
    parser.add_argument("--shaken", type=int, default=40, help="of each kind, under noise")
    parser.add_argument("--dry", action="store_true", help="print only")
    options = parser.parse_args()
    made = shapes()
    drawn = random_slopes(options.count, SEED)
    rows = hatched(made)
    groups = [summary("the eleven shapes", rows)]
    bays = hatched(deep_bays())
    groups.append(summary("deep bays of the toe", bays))
    for kind in KINDS:
        some = hatched([s for s in drawn if s.name.startswith(kind)], min_spacing=0.1)
        groups.append(summary(f"random, {kind}", some))
        rows += some
    polish = hatched(real_polish())
    dutch = [slope for slope in real_dutch() if isinstance(slope, Slope)]
    groups += [summary("slopes of a Polish survey", polish)]
    groups += [summary("Dutch slopes with a crest line", hatched(dutch))]
    rivals = [summary("matching", evenly(made))]
    for name, draw in RIVALS.items():
        rivals.append(summary(name, [rival_row(name, slope, draw) for slope in made]))
    open_ones = [s for s in drawn if not s.strip.is_closed]
    rivals.append(summary("matching, random", evenly(open_ones)))
    for name, draw in RIVALS.items():
        found = []
        for slope in open_ones:
            try:
                found.append(rival_row(name, slope, draw))
            except (MidribError, ValueError):
                continue
        rivals.append(summary(f"{name}, random", found))
    shaken = {"the eleven shapes": turned_by_noise(made, 0.1)}
    for kind in KINDS[:-1]:
        of_kind = [s for s in open_ones if s.name.startswith(kind)]
        shaken[kind] = turned_by_noise(of_kind[: options.shaken], 0.1)
    shaken["deep bays of the toe"] = turned_by_noise(deep_bays(), 0.1)
    open_polish = [s for s in real_polish() if not s.strip.is_closed]
    shaken["slopes of a Polish survey"] = turned_by_noise(open_polish, 0.1)
    text = page(groups, rivals, shaken, options.count, on_paper(polish))
    print(text)
    if not options.dry:
        before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
        after = rest.partition(END)[2]
        PAGE.write_text(f"{before}{BEGIN}\n{text}{END}{after}", encoding="utf-8")
        write_json(
            ROOT / "benchmarks" / "results" / "hatching.json", {"groups": groups, "rivals": rivals}
        )
        picture(made, ROOT / "docs" / "pictures" / "hatching.svg")
    worst_sheet(rows + polish, ROOT / "out" / "hatching.png")
    return 0


def on_paper(rows: list[Row]) -> str:
    """How many neighbours are nearer on paper than the standard's least gap, as a sentence."""
    near, all_gaps = 0, 0
    for row in rows:
        found = row.hatching
        assert found is not None
        steps = np.hypot(*np.diff(found.on_top, axis=0).T)
        near += int(np.count_nonzero(steps < 0.9 * found.rule.least_gap))
        all_gaps += steps.size
    return (
        f"On {near:,} of {all_gaps:,} places of the Polish survey neighbours begin nearer to each "
        "other than 0.9 of the least gap.\n\n"
    )


def page(
    groups: list[list[str]],
    rivals: list[list[str]],
    shaken: dict[str, Floats],
    count: int,
    paper: str,
) -> str:
    """Figures as text."""
    fast = {
        "edges of 1,600 vertices": speed(1600, 5.0, 0.2),
        "the same, denser strokes": speed(1600, 2.0, 0.2),
        "edges of 1,600 vertices, noise of a tenth of the width": speed(1600, 5.0, 1.0),
        "the same, denser strokes, noise of half a gap": speed(1600, 2.0, 1.0),
        "edges of 12,800 vertices": speed(12_800, 5.0, 0.2),
        "all slopes of the Polish survey": best_of_seven(
            [(s.strip.main, s.strip.auxiliary, s.strip.area) for s in real_polish()]
        ),
    }
    rates = [
        (name, f"{strokes:,}", f"{strokes / seconds:,.0f}")
        for name, (strokes, seconds) in fast.items()
    ]
    return (
        f"\nWritten by `python benchmarks/hatching.py`; random slopes have the seeds {SEED} to "
        f"{SEED + count - 1}.\n\n{markdown(HEAD, groups)}\n"
        "With one gap for the whole slope, half its mean width, beside rivals:\n\n"
        f"{markdown(HEAD, rivals)}\n"
        "Noise of a tenth of the width on the top turns strokes by so much at most:\n\n"
        f"{markdown(TURNED, [turned_row(name, turns) for name, turns in shaken.items()])}\n"
        f"{paper}"
        f"One core, CPU time, triangulation and middle line included ({machine_text()}):\n\n"
        f"{markdown(('slope', 'strokes', 'strokes a second'), rates)}"
    )


if __name__ == "__main__":
    sys.exit(main())
