"""Many areas in one call: the same lines as one by one, for any number of threads."""

import signal
import subprocess
import sys
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import MultiPolygon, Polygon, box

import midrib
from midrib.curves import parts, usual
from midrib.curves.lines import lines_at_once
from midrib.errors import ParameterError
from midrib.ragged import pack_rings
from midrib.strip import PLANE
from tests.shapes import annulus_sector, stadium, wavy_ribbon, wedge

POLE = 100.0


@pytest.fixture(scope="module")
def areas() -> "np.ndarray[tuple[int], np.dtype[np.object_]]":
    """Areas of several kinds, and some that the kernel leaves to the single steps."""
    usual_ones = [wavy_ribbon(n, 0.1 + n / 200.0) for n in range(20, 60)]
    usual_ones += [wedge(0.1 * k, 9.0) for k in range(1, 8)]
    usual_ones += [annulus_sector(4.0, 5.0 + k, 2.0, 12) for k in range(6)]
    usual_ones += [stadium(4.0, 0.2 * k) for k in range(1, 8)]
    touching = Polygon(
        [(0, 0), (40, 0), (40, 6), (0, 6)], [[(10, 6), (12, 3), (14, 3)]]
    )  # its hole touches the shell
    odd = [
        None,
        Polygon(),
        box(0, 0, 1e-3, 7),
        touching,
        shapely.force_3d(box(0, 0, 9, 2), 5.0),
        MultiPolygon([box(0, 0, 9, 2), box(20, 0, 29, 3)]),
    ]
    found = np.empty(len(odd) + 60, dtype=object)
    found[:] = [*odd[:3], *usual_ones, *odd[3:]]
    return found


def bits(lines: object) -> list[bytes | None]:
    """Return lines as bytes."""
    found: list[bytes | None] = list(shapely.to_wkb(lines))
    return found


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_lines_are_those_of_single_areas(
    areas: "np.ndarray[tuple[int], np.dtype[np.object_]]",
    threads: int,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(usual, "RUN", 300)  # a few areas at a time
    lines = midrib.collapse(areas, threads=threads)
    assert bits(lines) == bits([midrib.collapse(area) for area in areas])


def test_degrees_are_those_of_single_areas() -> None:
    rng = np.random.default_rng(5)
    at = rng.uniform((-170, -80), (170, 80), (20, 2))
    areas = [box(x, y, x + 0.02, y + 0.003) for x, y in at] + [box(0, 0, 1, POLE)]
    lines, problems = midrib.collapse(areas, geographic=True, on_error="report", threads=2)
    alone = [midrib.collapse(area, geographic=True) for area in areas[:-1]]
    assert bits(lines) == [*bits(alone), None]
    assert [problem.index for problem in problems] == [20]
    assert "beyond a pole" in problems[0].reason


def test_problems_come_in_order(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(usual, "RUN", 8)
    flat = Polygon([(0, 0), (4, 4), (4, 0), (0, 4)])
    lines, problems = midrib.collapse([flat, box(0, 0, 5, 1), flat], on_error="report", threads=2)
    assert [line is None for line in lines] == [True, False, True]
    assert [problem.index for problem in problems] == [0, 2]


SHELL = [(0.0, 0.0), (20.0, 0.0), (20.0, 6.0), (0.0, 6.0)]
HOLE = [(4.0, 2.0), (7.0, 2.0), (7.0, 4.0), (4.0, 4.0)]
INVALID = {
    "bow-tie": ([(0, 0), (8, 6), (8, 0), (0, 6)], []),
    "spike": ([*SHELL, (0, 6), (-3, 6), (0, 6)], []),
    "pinched": ([(0, 0), (9, 0), (5, 3), (9, 6), (0, 6), (5, 3)], []),
    "hole in a hole": (SHELL, [HOLE, [(5, 2.5), (6, 2.5), (6, 3)]]),
    "hole around a hole": (SHELL, [HOLE, [(3, 1), (8, 1), (8, 5), (3, 5)]]),
    "hole outside": (SHELL, [[(4, 7), (7, 7), (7, 9)]]),
    "hole around the shell": (HOLE, [SHELL]),
    "hole twice": (SHELL, [HOLE, HOLE]),
    "hole like the shell": (SHELL, [SHELL]),
    "hole across the shell": (SHELL, [[(4, 4), (7, 4), (7, 9), (4, 9)]]),
    "hole of two points": (SHELL, [[(4, 2), (7, 2), (7, 2)]]),
    "hole of one point": (SHELL, [[(4, 2), (4, 2), (4, 2)]]),
    "no number": ([*SHELL, (np.nan, 3)], []),
    "infinite": ([*SHELL, (-np.inf, 3)], []),
}


def is_shown_valid(area: Polygon) -> bool:
    """Whether the kernel itself finds an area valid."""
    return usual.usual_line(*pack_rings(area), PLANE, is_known=False) is not None


@pytest.mark.filterwarnings("ignore:invalid value encountered")  # of what is no number
@pytest.mark.parametrize("name", INVALID)
def test_triangles_show_no_invalid_area_to_be_valid(name: str) -> None:
    area = Polygon(*INVALID[name])
    assert not shapely.is_valid(area)
    assert not is_shown_valid(area)
    assert usual.line_of_one(area) is None


@pytest.mark.filterwarnings("ignore:invalid value encountered")
def test_invalid_areas_are_left_to_the_single_steps() -> None:
    areas = np.array([Polygon(*INVALID[name]) for name in INVALID], dtype=object)
    assert all(line is None for line in lines_at_once(areas, geographic=False, threads=1))


def test_only_areas_that_triangles_leave_open_are_asked_about(
    areas: "np.ndarray[tuple[int], np.dtype[np.object_]]", monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[Any] = []

    def is_valid(some: Any) -> Any:
        asked.extend(area for area in some if area is not None and not area.is_empty)
        return shapely.is_valid(some)

    monkeypatch.setattr(parts, "is_valid", is_valid)
    midrib.collapse(areas)
    assert asked == list(areas[-3:])  # rings that touch, Z, several parts


@pytest.mark.parametrize("holes", [[], [HOLE], [HOLE, [(9, 2), (9, 4), (11, 3)]]])
def test_triangles_show_that_areas_are_valid(
    holes: list[list[tuple[float, float]]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(usual, "is_valid_one", lambda _: False)
    area = Polygon(SHELL, holes)
    for turned in (area, shapely.reverse(area), shapely.normalize(area)):
        assert usual.line_of_one(turned) is not None


corners = st.tuples(st.integers(0, 5), st.integers(0, 5))


@given(
    shell=st.lists(corners, min_size=3, max_size=7),
    holes=st.lists(st.lists(corners, min_size=3, max_size=4), max_size=2),
)
def test_areas_that_triangles_show_to_be_valid_are(
    shell: list[tuple[int, int]], holes: list[list[tuple[int, int]]]
) -> None:
    area = Polygon(shell, holes)
    assert shapely.is_valid(area) or not is_shown_valid(area)


def test_rings_that_touch_are_asked_about() -> None:
    area = Polygon(SHELL, [HOLE, [(7.0, 2.0), (9.0, 2.0), (9.0, 3.0)]])
    assert not is_shown_valid(area)
    assert usual.line_of_one(area) is not None


@pytest.mark.parametrize("threads", [0, -1, 1.5, True, "two"])
def test_threads_are_a_positive_number(threads: Any) -> None:
    with pytest.raises(ParameterError, match=r"threads is .*, expected a positive whole number"):
        midrib.collapse(box(0, 0, 3, 1), threads=threads)


def test_runs_cover_areas_once() -> None:
    starts = np.concatenate([[0], np.cumsum([5, 70_000, 3, 30_000, 10_000, 5])])
    runs = usual.runs_of(starts)
    assert [run[0] for run in runs[1:]] == [run[1] for run in runs[:-1]]
    assert runs[0][0] == 0
    assert runs[-1][1] == 6
    assert all(last > first for first, last in runs)


STORM = """
import random, signal, sys
import midrib
from tests.shapes import wavy_ribbon

class Raised(Exception):
    pass

def handle(*_):
    raise Raised

area, hits = wavy_ribbon(40, 0.2), 0
line = midrib.collapse(area)
rng = random.Random(8)
signal.signal(signal.SIGALRM, handle)
while hits < 1500:
    try:
        signal.setitimer(signal.ITIMER_REAL, rng.uniform(2e-5, 4e-4))
        while True:
            assert midrib.collapse(area).equals_exact(line, 0.0)
    except Raised:
        hits += 1
"""


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs a timer that sends signals")
def test_a_handler_that_raises_harms_no_single_area() -> None:
    done = subprocess.run(
        [sys.executable, "-c", STORM], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
