"""Clouds that are no tower, or hard to read: one sentence, or an axis."""

import re
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from midrib import tower_axis
from midrib.errors import ParameterError
from midrib.figures.tower_report import summary_lines
from midrib.towers.cloud import check_spacing
from midrib.towers.simulate import Scan, Tower
from midrib.types import Floats
from tests.towers.scans import CONE, dirty, offsets


def flat() -> Floats:
    """Points of a floor."""
    x, y = np.random.default_rng(0).uniform(-5.0, 5.0, (2, 5000))
    return np.column_stack([x, y, np.full(x.size, 1.5)])


def sliver() -> Floats:
    """Points of a shell of which 50 degrees are seen."""
    random = np.random.default_rng(1)
    angle, z = np.radians(random.uniform(0.0, 50.0, 40_000)), random.uniform(0.0, 40.0, 40_000)
    r = 2.5 - z / 40.0 + random.normal(0.0, 0.003, z.size)
    return np.column_stack([r * np.cos(angle), r * np.sin(angle), z])


@pytest.mark.parametrize("points", [flat(), np.ones((500, 3))])
def test_points_of_one_height_are_refused(points: Floats) -> None:
    with pytest.raises(ParameterError, match=r"expected a tower at least 0\.05 m high"):
        tower_axis(points)


@pytest.mark.parametrize(
    ("order", "sentence"),
    [
        ([0, 2, 1], "no tower was found: circles of 0 of 24 slabs stand one above the other"),
        ([2, 1, 0], "expected a tower that stands along z; is another coordinate the height?"),
    ],
)
def test_a_tower_that_lies_is_refused(order: list[int], sentence: str) -> None:
    with pytest.raises(ParameterError) as caught:
        tower_axis(CONE.points()[:, order])
    assert sentence in str(caught.value)
    assert "inf" not in str(caught.value)


@pytest.mark.parametrize("order", [[0, 2, 1], [2, 1, 0]])
def test_a_tower_with_faces_that_lies_is_refused_with_a_question(order: list[int]) -> None:
    points = dirty(Tower(40.0, 2.5, 1.5, lean=0.1, faces=4)).points()[:, order]
    with pytest.raises(ParameterError, match="no tower was found: ") as caught:
        tower_axis(points)
    assert "(x, y, z)" in str(caught.value)
    assert "is another coordinate the height?" in str(caught.value)


@pytest.mark.parametrize("unit", [1.0, 1000.0])
@pytest.mark.parametrize("order", [[0, 2, 1], [2, 1, 0]])
def test_how_a_tower_lies_is_told(order: list[int], unit: float) -> None:
    points = dirty().points()[:, order]
    with pytest.raises(ParameterError) as caught:
        tower_axis(unit * points, unit=unit)
    found = re.search(
        r"leans by (\d+)° from z, in a cloud that reaches ([\d.]+) m by ([\d.]+) m by ([\d.]+) m",
        str(caught.value),
    )
    assert found is not None
    lean, *reach = map(float, found.groups())
    assert lean == pytest.approx(90.0, abs=1.0)
    assert int(np.argmax(reach)) == order.index(2)
    assert max(reach) == pytest.approx(40.0, abs=0.3)


@pytest.mark.parametrize("height", [3.0, 8.0])
def test_a_tank_that_is_wider_than_it_is_high_stands(height: float) -> None:
    tank = Tower(height=height, base_radius=6.0, top_radius=6.0, lean=0.01)
    scan = Scan(tank, noise=(0.002, 0.004), count=60_000, seed=1)
    axis = tower_axis(scan.points())
    assert axis.is_answered.all()
    assert np.max(offsets(axis, scan)) < 0.002


@pytest.mark.parametrize("lean", [20.0, 40.0, 50.0])
def test_a_tower_may_lean_by_half_a_right_angle(lean: float) -> None:
    turn = np.radians(lean)
    x, y, z = CONE.points().T
    turned = np.column_stack(
        [np.cos(turn) * x + np.sin(turn) * z, y, np.cos(turn) * z - np.sin(turn) * x]
    )
    if lean > 45.0:
        with pytest.raises(ParameterError, match="leans by 50° from z"):
            tower_axis(turned)
    else:
        assert tower_axis(turned).summary.slope == pytest.approx(1000.0 * np.tan(turn), rel=0.02)


def test_a_step_without_a_level_is_refused() -> None:
    with pytest.raises(ParameterError, match="at steps of 500 m, expected a smaller step"):
        tower_axis(CONE.points() + np.array((0.0, 0.0, 100.0)), step=500.0)


@pytest.mark.parametrize("per_metre", [100.0, 1000.0])
def test_heights_that_no_tower_has_are_refused_before_memory_is_asked_for(
    per_metre: float,
) -> None:
    points = CONE.points()
    tracemalloc.start()
    with pytest.raises(ParameterError) as caught:
        tower_axis(per_metre * points)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    height = 40 * per_metre
    found = re.search(r"heights that differ by ([\d,]+) m, expected", str(caught.value))
    assert found is not None
    assert int(found[1].replace(",", "")) == pytest.approx(height, rel=0.01)
    assert "unit= (--unit mm) may be missing" in str(caught.value)
    assert most < 50e6
    assert tower_axis(per_metre * points, unit=per_metre).is_answered.all()


@pytest.mark.parametrize("unit", [1.0, 1000.0])
def test_more_levels_than_anyone_needs_are_refused(unit: float) -> None:
    sentence = r"step is 1e-06 m, expected at most 100,000 levels in \d\d\.\d\d m of height"
    with pytest.raises(ParameterError, match=sentence):
        tower_axis(unit * CONE.points(), step=1e-6 * unit, unit=unit)


@pytest.mark.parametrize("mode", ["joint", "fan", "paper"])
def test_a_sliver_has_no_centre_and_says_how_much_is_seen(mode: Any) -> None:
    axis = tower_axis(sliver(), mode)
    assert not axis.is_answered.any()
    assert set(axis.levels["flag"]) == {"only 30° of the shell seen"}
    assert axis.line.is_empty
    assert np.isnan(axis.levels["radius"]).all()
    # What is not known is not printed as a number.
    assert not [text for _, text in summary_lines(axis) if "nan" in text]


@pytest.mark.parametrize("ending", ["npy", "csv"])
def test_points_without_a_coordinate_are_counted(ending: str, tmp_path: Path) -> None:
    points = CONE.points()
    points[50::100, 1] = np.nan
    path = tmp_path / f"scan.{ending}"
    if ending == "npy":
        np.save(path, points)
    else:
        np.savetxt(path, points, fmt="%.5f", delimiter=",")
    axis = tower_axis(path)
    assert axis.unusable == len(points[50::100])
    told = [text for name, text in summary_lines(axis) if name == "left out"]
    assert told == ["600 points without three finite coordinates"]


def test_decimal_commas_between_semicolons_are_read(tmp_path: Path) -> None:
    points = CONE.points()[:20_000]
    path = tmp_path / "scan.csv"
    rows = "\n".join(";".join(f"{v:.5f}".replace(".", ",") for v in row) for row in points)
    path.write_text(f"x;y;z\n{rows}\n", encoding="ascii")
    axis = tower_axis(path)
    expected = tower_axis(np.round(points, 5))
    assert axis.points == pytest.approx(expected.points, abs=1e-9)


def write_ply(path: Path, points: Any) -> None:
    """Write single numbers."""
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz") + "end_header\n"
    path.write_bytes(head.encode() + points.astype("<f4").tobytes())


@pytest.mark.parametrize("door", ["array", "npy", "npz", "ply"])
def test_single_numbers_of_a_map_grid_are_refused(door: str, tmp_path: Path) -> None:
    points = (CONE.points() + np.array((500_000.0, 5_800_000.0, 100.0))).astype(np.float32)
    path = tmp_path / f"scan.{door}"
    if door == "ply":
        write_ply(path, points)
    elif door != "array":
        (np.save if door == "npy" else np.savez)(path, points)
    with pytest.raises(ParameterError) as caught:
        tower_axis(points if door == "array" else path)
    expected = "has y of about 5,800,000 stored as float32, whose numbers there are 500 mm apart"
    assert expected in str(caught.value)
    assert "subtract an offset before storing, or store float64" in str(caught.value)


def test_single_numbers_near_the_origin_are_as_good_as_doubles() -> None:
    points = CONE.points()
    axis = tower_axis(points.astype(np.float32))
    assert axis.points == pytest.approx(tower_axis(points).points, abs=1e-4)


def test_strays_of_a_scan_say_nothing_about_the_steps_of_its_numbers() -> None:
    """Numbers where the tower stands are fine: what is 5,800 km away is no part of it."""
    points = CONE.points()
    with_strays = points.copy()
    with_strays[::100] = (0.0, 5_800_000.0, 1.0)
    axis = tower_axis(with_strays.astype(np.float32))
    assert axis.points == pytest.approx(tower_axis(points).points, abs=1e-4)


def test_steps_of_single_numbers_are_measured_in_metres() -> None:
    # 30,000 mm: the step is 0.002 of the unit, and of no matter.
    sample = np.full((100, 3), 30_000.0)
    check_spacing(sample, ("f4", "f4", "f4"), 1000.0, "source")
    check_spacing(sample, ("f8", "i4", "f8"), 1.0, "source")
    with pytest.raises(ParameterError, match=r"source has y of about 30,000 .* 1\.95 mm apart"):
        check_spacing(sample, ("f8", "f4", "f8"), 1.0, "source")
