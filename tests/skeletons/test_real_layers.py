"""Skeletons of the areas of real layers: every method makes a line, or says why not."""

import numpy as np
import pytest
import shapely

import midrib
from midrib.types import Floats
from tests.test_real_areas import FOLDER, LAYERS, areas_of

MOST_VERTICES = 5000
SAMPLE = 12  # areas of a layer, the same ones every time
TRICKIEST = 2  # of each kind
BRANCHED = [method.name for method in midrib.methods() if method.has_branches]


def sample_of(file: str, layer: str | None) -> Floats:
    """Some valid areas of a layer, evenly through it, and its largest, most holed and thinnest."""
    parts = shapely.force_2d(shapely.get_parts(areas_of(file, layer).to_numpy()))
    parts = parts[shapely.is_valid(parts) & (shapely.get_type_id(parts) == 3)]
    parts = parts[shapely.get_num_coordinates(parts) <= MOST_VERTICES]
    evenly = np.linspace(0, len(parts) - 1, min(SAMPLE, len(parts))).astype(int)
    tricky = (
        shapely.get_num_coordinates(parts),
        shapely.get_num_interior_rings(parts),
        shapely.length(parts) ** 2 / shapely.area(parts),
    )
    most = [np.argsort(-trait, kind="stable")[:TRICKIEST] for trait in tricky]
    sample: Floats = parts[np.unique(np.concatenate([evenly, *most]))]
    return sample


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
@pytest.mark.parametrize(("file", "layer"), LAYERS)
@pytest.mark.parametrize("method", BRANCHED)
def test_every_method_ends_in_a_line_or_a_reason(method: str, file: str, layer: str | None) -> None:
    areas = sample_of(file, layer)
    lines, problems = midrib.collapse(areas, method, on_error="report")
    reasons = {problem.index: problem.reason for problem in problems}
    for i, (area, line) in enumerate(zip(areas, lines, strict=True)):
        if line is None:
            assert "please report" not in reasons[i]
        else:
            assert area.covers(line)
            assert line.is_simple


@pytest.mark.shared
@pytest.mark.skipif(not FOLDER.is_dir(), reason="the folder of shared test data is absent")
@pytest.mark.parametrize(("file", "layer"), LAYERS)
def test_medial_axes_of_real_areas_are_as_far_from_their_boundary(
    file: str, layer: str | None
) -> None:
    for area in sample_of(file, layer):
        found = midrib.skeleton(area, "medial-axis")
        distance = shapely.distance(shapely.points(found.points), area.boundary)
        size = float(np.hypot(*np.subtract(area.bounds[2:], area.bounds[:2])))
        slack = 1e-9 * size + 1e-14 * float(np.abs(area.bounds).max())
        assert found.radius == pytest.approx(distance, abs=slack)
