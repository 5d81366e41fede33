"""The areas of the benchmarks are valid, always the same, and what their description says."""

import hashlib
import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import shapely
from shapely import LineString

from families import FAMILIES, make, mixed

CORPUS = Path(__file__).parents[3] / "shared" / "data" / "corpus.py"
every_family = pytest.mark.parametrize("family", FAMILIES)


@every_family
@pytest.mark.parametrize("n", [100, 1000])
@pytest.mark.parametrize("seed", [0, 1])
def test_areas_are_valid_and_of_the_size_asked_for(family: str, n: int, seed: int) -> None:
    case = make(family, n, seed)
    assert case.area.is_valid
    assert shapely.get_num_coordinates(case.area) == pytest.approx(n, rel=0.06)
    assert bool(case.area.interiors) == (family == "holes")


@every_family
def test_same_call_gives_same_area_and_other_seeds_others(family: str) -> None:
    first, again, other = make(family, 100), make(family, 100), make(family, 100, seed=1)
    assert shapely.equals_identical(first.area, again.area)
    is_random = family in ("river", "river_dense", "embankment", "waist", "holes", "star")
    assert shapely.equals_identical(first.area, other.area) != is_random


@every_family
def test_banks_lie_on_the_boundary_between_the_ends(family: str) -> None:
    case = make(family, 100)
    shell = case.area.exterior
    for bank in (case.left, case.right):
        assert shapely.distance(shapely.points(bank), shell).max() == pytest.approx(0, abs=1e-9)
    assert shapely.distance(shapely.points(case.ends), shell).max() == pytest.approx(0, abs=1e-9)
    for i, end in ((0, case.ends[0]), (-1, case.ends[1])):
        across = LineString([case.left[i] - end, case.right[i] - end + 1e-12])
        assert across.distance(shapely.Point(0, 0)) < case.width


def test_width_of_a_rectangle_is_its_shorter_side() -> None:
    assert make("rect", 100).width == pytest.approx(40)


def test_unknown_family_is_refused_by_name() -> None:
    with pytest.raises(ValueError, match="'pond', expected one of river"):
        make("pond", 100)


def test_mixed_areas_take_every_family_in_turn() -> None:
    areas = mixed(len(FAMILIES) + 1, 100)
    assert shapely.equals_identical(areas[1], make(FAMILIES[1], 100).area)
    assert shapely.equals_identical(areas[-1], make(FAMILIES[0], 100, seed=1).area)


def test_coordinates_have_not_moved() -> None:
    digest = hashlib.sha256()
    for family in FAMILIES:
        case = make(family, 100)
        points = shapely.get_coordinates(case.area) - case.ends[0]
        digest.update((np.round(points, 4) + 0.0).astype("<f8").tobytes())
    assert digest.hexdigest()[:16] == "c384bcba04e22d58"


def corpus() -> ModuleType:
    spec = importlib.util.spec_from_file_location("corpus", CORPUS)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.shared
@pytest.mark.skipif(not CORPUS.exists(), reason="no shared test data")
@every_family
@pytest.mark.parametrize("n", [100, 1000, 10_000])
def test_areas_are_those_of_the_first_tables(family: str, n: int) -> None:
    before, case = corpus().make(family, n, 3), make(family, n, 3)
    assert shapely.equals_identical(before["poly"], case.area)
    assert case.width == before["width"]
    for name in ("ends", "left", "right"):
        np.testing.assert_array_equal(getattr(case, name), before[name])
