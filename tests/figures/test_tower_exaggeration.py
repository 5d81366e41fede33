"""Plots of towers say how much deviations are exaggerated."""

import pytest
from matplotlib.figure import Figure

from midrib.figures.tower_plots import exaggeration


def test_exaggeration_is_that_of_a_ruler_on_paper() -> None:
    axes = Figure(figsize=(10.0, 10.0)).add_axes((0.1, 0.1, 0.4, 0.8))
    axes.set_xlim(-100.0, 100.0)  # mm: 50 to an inch
    axes.set_ylim(0.0, 80.0)  # m: 10,000 mm to an inch
    assert exaggeration(axes) == pytest.approx(200.0)
