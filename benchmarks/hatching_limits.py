"""What no hatching of a slope can do better: an exhaustive search beside ours.

Every hatching is a sequence of chords that advance on both edges. Chords are tried at places an
eighth of a gap apart on the middle line, each in directions 4 degrees apart; a sequence from end to
end is looked for in which, with a factor e,

    neighbours are 0.8 / e to 1.25 e gaps apart, whole counts stretched by a tenth at most included,
    turn by 20 e degrees or by e times what a corner allows, lean by e times what they may,
    and their ends are 0.25 / e to 1.75 e gaps apart on both edges.

The least e for which there is one is printed beside that of our hatching. Chords between those that
are tried are up to a 16th of a gap and 2 degrees off, so that a true optimum may be a little lower.
"""

import argparse
import sys
from typing import NamedTuple

import numba as nb
import numpy as np
from numpy.typing import NDArray
from shapely import LineString

from hatch_slopes import Slope, one_random, real_polish, shapes
from midrib import Strip, hatch
from midrib.hatching import Hatching
from midrib.hatching.bounds import Laid
from midrib.hatching.measures import laid_of, measure
from midrib.kernels.chords import ON_TOE, ON_TOP
from midrib.kernels.gauging import LEAN, Course, allowed_turns
from midrib.kernels.ladder import draw_strokes, turn_rungs
from tables import ROOT, markdown

Floats = NDArray[np.float64]
PAGE = ROOT / "docs" / "hatching.md"
BEGIN, END = "<!-- limits -->", "<!-- end of limits -->"
SLOPES = (
    "spur_bottom", "deep 1238", "deep 1588", "deep 1658", "deep 1178", "sharp 1312", "PL 31",
    "PL 67",
)  # fmt: skip
BAYS = ((10.0, 12.0), (20.0, 20.0), (20.0, 12.0), (35.0, 12.0))  # depths and mouths
DIRECTIONS = np.radians(np.arange(-60.0, 60.1, 4.0))
SPARSE, DENSE, TURN, LEAST, MOST = 1.25, 0.8, 20.0, 0.25, 1.75
STRETCHES = np.linspace(0.9, 1.1, 9)
HIGHEST, HALVINGS = 4.0, 7


class Chords(NamedTuple):
    """Chords of a slope: m directions at each of n places on the middle line."""

    station: Floats  # (n,)
    theta: Floats  # (n, m)
    feet: Floats  # (n, m, 2) stations on top and toe, NaN where a chord does not join them
    gap: Floats  # (n, m) that the rule asks for
    allowed: Floats  # (n,) degrees that neighbours may turn here
    lean: Floats  # (n, m) from the normal, over what it may be


def chords_of(hatching: Hatching) -> Chords:
    """Every chord to try."""
    ground = hatching.ground
    assert ground is not None
    ladder = ground.ladder
    station = ladder.rungs[:, 0].copy()
    theta = ladder.rungs[:, 3:4] + DIRECTIONS
    feet, gap = np.full((*theta.shape, 2), np.nan), np.empty(theta.shape)
    width, lean = ladder.rungs[:, 5], np.full(theta.shape, np.inf)
    for k in range(len(DIRECTIONS)):
        turned = turn_rungs(ladder, theta[:, k].copy(), ground.spacing)
        strokes = draw_strokes(turned, station, ground.spacing)
        leads = (strokes.on == (ON_TOP, ON_TOE)).all(axis=1)
        feet[leads, k] = strokes.chord[leads, :2]
        gap[:, k] = strokes.pivot[:, 5]
        chord, pivot = strokes.chord[leads], strokes.pivot[leads]
        laid = Laid(
            ground.curves, pivot[:, 0], chord[:, :2], chord[:, 2:6], pivot[:, 5], pivot[:, 6]
        )
        lean[leads, k] = laid.tilts / np.degrees(laid.gauged[:, LEAN])
    line = Course(*ground.curves.middle)
    allowed = np.degrees(allowed_turns(line, station, width.copy(), hatching.rule.gaps(width)))
    return Chords(station, theta, feet, gap, allowed, lean)


@nb.njit()
def is_possible(  # noqa: C901
    chords: Chords, stretch: float, factor: float, end: float
) -> bool:
    """Whether a sequence from end to end keeps all bounds times a factor."""
    n, m = chords.theta.shape
    reached = np.zeros((n, m), np.bool_)
    total = chords.station[n - 1]
    for i in range(n):
        for c in range(m):
            if np.isnan(chords.feet[i, c, 0]) or chords.lean[i, c] > factor:
                continue
            b = chords.gap[i, c]
            is_reached = chords.station[i] <= end * factor * stretch * b
            j = i - 1
            while j >= 0 and not is_reached:
                step = chords.station[i] - chords.station[j]
                if step > 4.0 * SPARSE * factor * stretch * b:
                    break
                for d in range(m):
                    if not reached[j, d]:
                        continue
                    gap = (b + chords.gap[j, d]) / 2.0
                    ratio = step / (stretch * gap)
                    if not DENSE / factor <= ratio <= SPARSE * factor:
                        continue
                    turn = abs(np.degrees(chords.theta[i, c] - chords.theta[j, d]))
                    if turn > factor * max(TURN, chords.allowed[i], chords.allowed[j]):
                        continue
                    is_good = True
                    for edge in range(2):
                        foot = (chords.feet[i, c, edge] - chords.feet[j, d, edge]) / gap
                        is_good = is_good and LEAST / factor <= foot <= MOST * factor
                    if is_good:
                        is_reached = True
                        break
                j -= 1
            reached[i, c] = is_reached
            if is_reached and total - chords.station[i] <= end * factor * stretch * b:
                return True
    return False


def least_factor(chords: Chords) -> float:
    """Least factor for which there is a hatching."""
    low, high = 1.0, HIGHEST
    if any(is_possible(chords, stretch, low, 1.5) for stretch in STRETCHES):
        return low
    for _ in range(HALVINGS):
        factor = float(np.sqrt(low * high))
        if any(is_possible(chords, stretch, factor, 1.5) for stretch in STRETCHES):
            high = factor
        else:
            low = factor
    return low


def factor_of(hatching: Hatching) -> float:
    """Return the factor that our hatching needs."""
    found, ground = measure(hatching), hatching.ground
    assert ground is not None
    middle = LineString(ground.middle.line)
    whole = np.ones(len(hatching.strokes), dtype=np.bool_)
    laid = laid_of(hatching.strip, hatching.rule, middle, whole, hatching.on_top, hatching.on_toe)
    return float(
        max(
            1.0,
            found.spacing.max() / SPARSE,
            DENSE / found.spacing.min(),
            (found.turns / found.allowed).max(),
            found.top_gap / MOST,
            found.toe_gap / MOST,
            LEAST / found.least_foot,
            (laid.tilts / np.degrees(laid.gauged[:, LEAN])).max(),
        )
    )


def slopes() -> list[tuple[Slope, float | None]]:
    """Slopes with the worst figures, and the least gap to ask for."""
    known = {slope.name: slope for slope in (*shapes(), *real_polish())}
    found: list[tuple[Slope, float | None]] = []
    for name in SLOPES:
        if name in known:
            found.append((known[name], None))
        else:
            kind, seed = name.split()
            found.append((one_random(kind, int(seed)), 0.1))
    for depth, mouth in BAYS:
        found.append((Slope(f"bay {depth:g} deep, {mouth:g} wide", bay(depth, mouth)), None))
    return found


def bay(depth: float, mouth: float) -> Strip:
    """Straight slope, 10 wide, with a bay in its toe that narrows to half its mouth."""
    x = [0.0, *(100.0 + mouth * np.array([-0.5, -0.25, 0.25, 0.5])), 200.0]
    y = [0.0, 0.0, -depth, -depth, 0.0, 0.0]
    return Strip(LineString([(0.0, 10.0), (200.0, 10.0)]), LineString(np.column_stack([x, y])))


def main() -> int:
    """Print a table and write it to the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--dry", action="store_true", help="print only")
    options = parser.parse_args()
    rows = []
    for slope, least in slopes():
        hatching = hatch(slope.strip, min_spacing=least)
        rows.append(
            [slope.name, f"{factor_of(hatching):.2f}", f"{least_factor(chords_of(hatching)):.2f}"]
        )
    table = markdown(("slope", "ours", "none can be below"), rows)
    print(table)
    if not options.dry:
        before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
        after = rest.partition(END)[2]
        PAGE.write_text(f"{before}{BEGIN}\n{table}{END}{after}", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
