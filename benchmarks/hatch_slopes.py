"""Slopes to hatch: made-up shapes, random ones by seed, rings, and those of real registers."""

import json
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Polygon

from midrib import Strip
from midrib.errors import MidribError
from tables import ROOT

__all__ = [
    "KINDS",
    "Slope",
    "deep_bays",
    "noisy",
    "random_slopes",
    "real_dutch",
    "real_polish",
    "shapes",
]

Floats = NDArray[np.float64]
DATA = ROOT.parent / "shared" / "data"
KINDS = ("bend", "corner", "sharp", "lens", "wedge", "noise", "bay", "spur", "deep", "ring")
ATTEMPTS = 200
DEEP_BAYS = (  # lengths of the top, mouths and depths
    (20.0, 2.0, 3.0), (20.0, 2.0, 8.0), (20.0, 2.0, 10.0), (20.0, 4.0, 3.0), (20.0, 4.0, 5.0),
    (20.0, 4.0, 15.0), (20.0, 6.0, 8.0), (40.0, 4.0, 30.0), (60.0, 4.0, 30.0),
)  # fmt: skip
TOUCH = 0.05  # metres: a crest line this near to a slope's boundary runs along it


class Slope(NamedTuple):
    """One slope: where it comes from, and its strip."""

    name: str
    strip: Strip


def shapes() -> list[Slope]:
    """Eleven made-up shapes."""
    pairs = json.loads((DATA / "hatch_shapes.json").read_text(encoding="utf-8"))
    return [
        Slope(name, Strip(LineString(top), LineString(toe))) for name, (top, toe) in pairs.items()
    ]


def deep_bays() -> list[Slope]:
    """Slopes 5 wide with a bay amid the toe, up to six times as deep as they are wide."""
    found = []
    for length, mouth, depth in DEEP_BAYS:
        x = length / 2.0
        bay = [
            (x + way * mouth / 2.0, y) for way, y in ((-1, 0), (-1, -depth), (1, -depth), (1, 0))
        ]
        toe = LineString([(0.0, 0.0), *bay, (length, 0.0)])
        top = LineString([(0.0, 5.0), (length, 5.0)])
        found.append(Slope(f"bay {mouth:g} x {depth:g} on {length:g}", Strip(top, toe)))
    return found


def random_slopes(count: int, seed: int) -> list[Slope]:
    """Random slopes of all kinds in turn; the seed of each is in its name."""
    return [one_random(KINDS[i % len(KINDS)], seed + i) for i in range(count)]


def one_random(kind: str, seed: int) -> Slope:
    """Random slope of a kind; what is no slope is drawn again."""
    rng = np.random.default_rng(seed)
    for _ in range(ATTEMPTS):
        top, toe = ring(rng) if kind == "ring" else band(kind, rng)
        if rng.random() < 0.5:
            top, toe = toe, top
        try:
            return Slope(f"{kind} {seed}", Strip(LineString(top), LineString(toe)))
        except MidribError:
            continue
    msg = f"no slope of kind {kind} from seed {seed}"
    raise RuntimeError(msg)


def band(kind: str, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Two edges beside a random line, of a kind's width."""
    width = rng.uniform(2.0, 12.0)
    length = width * rng.uniform(6.0, 40.0)
    line = bent_line(kind, rng, width, length)
    arc = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
    share = arc / arc[-1]
    half = width / 2.0 * (1.0 + 0.35 * np.sin(rng.uniform(0, 6.3) + share * rng.uniform(2.0, 14.0)))
    if kind == "lens":
        half = half * np.sin(np.pi * share) ** rng.uniform(0.5, 1.0)
    if kind == "wedge":
        half = half * (0.02 + share)
    normal = normals(line)
    top, toe = line + half[:, None] * normal, line - half[:, None] * normal
    if kind == "noise":
        top = top + rng.normal(0.0, 0.05 * width, top.shape)
    if kind == "bay":
        top = dented(top, normal, arc, width, rng, -1.0)
    if kind == "spur":
        toe = dented(toe, normal, arc, width, rng, rng.choice([-1.0, 1.0]))
    if kind == "deep":
        toe = dented(toe, normal, arc, width, rng, rng.uniform(-4.0, -1.0))
    if kind == "lens":
        top[[0, -1]] = toe[[0, -1]] = line[[0, -1]]
    return top, toe


def bent_line(kind: str, rng: np.random.Generator, width: float, length: float) -> Floats:
    """Random line: arcs, or straight runs with corners."""
    step = width / rng.uniform(1.0, 8.0)
    n = max(int(length / step), 8)
    if kind in ("corner", "sharp"):
        turn = np.zeros(n)
        least = max(int((2.0 if kind == "corner" else 4.0) * width / step), 1)
        corners = np.arange(least, n - least // 2, least + int(rng.integers(0, least + 1)))
        most = 1.2 if kind == "corner" else 2.2
        turn[corners] = rng.uniform(-most, most, corners.size)
    else:
        rate = rng.normal(0.0, 1.0, n)
        smooth = np.exp(-(np.linspace(-3, 3, max(int(4 * width / step), 3)) ** 2))
        turn = np.convolve(rate, smooth / smooth.sum(), mode="same")
        turn = turn / (abs(turn).max() or 1.0) * step / width * rng.uniform(0.1, 0.9)
    angle = np.cumsum(turn) + rng.uniform(0.0, 6.3)
    steps = step * np.column_stack([np.cos(angle), np.sin(angle)])
    return np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


def normals(line: Floats) -> Floats:
    """Return normals to the left at vertices; longer at corners, so that widths stay."""
    along = np.diff(line, axis=0)
    along /= np.hypot(*along.T)[:, None]
    before, after = np.vstack([along[:1], along]), np.vstack([along, along[-1:]])
    mean = (before + after) / 2.0
    mean /= (mean**2).sum(axis=1)[:, None]
    return np.column_stack([-mean[:, 1], mean[:, 0]])


def dented(
    edge: Floats, normal: Floats, arc: Floats, width: float, rng: np.random.Generator, way: float
) -> Floats:
    """Return an edge with a few steep dents, as deep as a third of the width times ``way``."""
    off = np.zeros(len(arc))
    for _ in range(int(rng.integers(1, 4))):
        middle, half = rng.uniform(0.1, 0.9) * arc[-1], width * rng.uniform(0.3, 1.0)
        off += np.clip((half - abs(arc - middle)) / (0.3 * half), 0.0, 1.0)
    return edge + way * 0.35 * width * np.minimum(off, 1.0)[:, None] * normal


def ring(rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Two closed edges, one around the other."""
    n = int(rng.integers(5, 60))
    angle = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False) + rng.uniform(0.0, 6.3)
    radius = rng.uniform(4.0, 20.0)
    shape = radius * (1.0 + 0.2 * np.sin(3 * angle + rng.uniform(0, 6.3)) * rng.random())
    width = radius * rng.uniform(0.2, 0.8) * (1.0 + 0.3 * np.sin(2 * angle + rng.uniform(0, 6.3)))
    rings = []
    for r in (shape, shape + width):
        points = np.column_stack([r * np.cos(angle), r * np.sin(angle)])
        rings.append(np.vstack([points, points[:1]]))
    return rings[0], rings[1]


def noisy(strip: Strip, share: float, seed: int) -> Strip | None:
    """Return a strip with noise on its top, in local widths; None if it is none any more."""
    rng = np.random.default_rng(seed)
    top = np.array(strip.main.coords)[:, :2]
    width = 2.0 * strip.area.area / (strip.main.length + strip.auxiliary.length)
    dense = shapely.get_coordinates(shapely.segmentize(LineString(top), width / 2.0))
    local = shapely.distance(shapely.points(dense), strip.auxiliary)
    moved = dense + rng.uniform(-share, share, dense.shape) * local[:, None]
    moved[[0, -1]] = dense[[0, -1]]
    try:
        return Strip(LineString(moved), strip.auxiliary)
    except MidribError:
        return None


def real_polish() -> Iterator[Slope]:
    """Slopes of a survey: the top runs forward along the stored ring between two given points."""
    import pyogrio

    table = pyogrio.read_dataframe(DATA / "pl_bdot500_opole_west.gpkg", layer="skarpa")
    for i, row in table.iterrows():
        area = row.geometry
        if area.interiors:
            top, toe = LineString(area.interiors[0]), LineString(area.exterior)
        else:
            ring = np.array(area.exterior.coords)[:-1, :2]
            ends = [(row.gora_start_x, row.gora_start_y), (row.gora_koniec_x, row.gora_koniec_y)]
            first, last = (int(np.argmin(np.hypot(*(ring - end).T))) for end in ends)
            n = len(ring)
            top, toe = (
                LineString(ring[np.arange(a, a + (b - a) % n + 1) % n])
                for a, b in ((first, last), (last, first))
            )
        yield Slope(f"PL {i}", Strip(top, toe, Polygon(area)))


def real_dutch() -> Iterator[Slope | str]:
    """Slopes whose crest line runs along the boundary: the part beside it is the top."""
    import pyogrio

    from midrib import split

    source = DATA / "nl_bgt_gooi.gpkg"
    areas = pyogrio.read_dataframe(source, layer="talud")
    crests = pyogrio.read_dataframe(source, layer="kruinlijn").groupby("gml_id").geometry
    lines = {name: list(group) for name, group in crests}
    for i, row in areas.iterrows():
        for crest in lines.get(row.gml_id, []):
            try:
                strip = split(row.geometry, along=crest)
            except MidribError as error:
                yield f"NL {i}: {error}"
                continue
            if strip.main.hausdorff_distance(crest) > TOUCH * 20.0:
                yield f"NL {i}: the crest line leaves the boundary"
                continue
            yield Slope(f"NL {i}", strip)
