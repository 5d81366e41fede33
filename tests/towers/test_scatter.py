"""How cells err together, how stiff curves are, and the uncertainty that follows."""

import numpy as np
import pytest
from scipy.sparse import csr_array

from midrib.towers.blocks import factor_of, product
from midrib.towers.cells import Cells, Grid, Reference
from midrib.towers.joint import fit_cells
from midrib.towers.rough import Frame
from midrib.towers.scatter import long_wave_variance, reach_of
from midrib.towers.weights import lost_to_weights
from midrib.types import Floats

LEVELS, SECTORS, RISE, RADIUS = 200, 72, 0.5, 3.0


def cells_with(d: Floats) -> Cells:
    """Cells of an upright cylinder that lie so far (levels, sectors) beyond it."""
    level, sector = (index.ravel() for index in np.indices(d.shape))
    s = np.arange(-1.0, LEVELS * RISE + 1.0, 0.1)
    table = np.column_stack([0.0 * s, 0.0 * s, RADIUS + 0.0 * s, 0.0 * s, 0.0 * s])
    reference = Reference(Frame(np.zeros(3), np.eye(3)), float(s[0]), 0.1, table, np.zeros((0, 2)))
    grid = Grid(0.0, RISE, LEVELS, SECTORS, 8)
    azimuth = (sector + 0.5) * 2.0 * np.pi / SECTORS
    height: Floats = np.asarray((level + 0.5) * RISE, dtype=np.float64)
    n = np.full(level.size, 50.0)
    return Cells(level, sector, height, azimuth, d.ravel(), n, 0.0 * n, reference, grid)


def patches(random: np.random.Generator, high: int, wide: int) -> Floats:
    """Errors of 1 mm, each the mean of so many white ones around it."""
    white = random.normal(0.0, 1.0, (LEVELS + high, SECTORS))
    errors = sum(
        np.roll(white[i : i + LEVELS], j, axis=1) for i in range(high) for j in range(wide)
    )
    return np.asarray(1e-3 * errors / np.sqrt(high * wide))


@pytest.mark.parametrize(("high", "wide"), [(1, 1), (3, 2), (6, 5)])
def test_sigma_counts_cells_that_err_together_once(high: int, wide: int) -> None:
    """A column of a design is a long wave: its variance is that of white errors times the area."""
    sigmas, offs, s = [], [], np.linspace(5.0, 95.0, 40)
    for seed in range(8):
        fit = fit_cells(cells_with(patches(np.random.default_rng(seed), high, wide)), 1.0)
        sigmas.append(np.sqrt(fit.covariances(s)[:, 0, 0].mean()))
        offs.append(np.sqrt(np.mean(fit.values(s)[:, :2] ** 2)))
    # A straight line through n cells: two unknowns of each coordinate, cos² is half on average.
    line = 1e-3 * np.sqrt(2.0 * 2.0 * high * wide / (LEVELS * SECTORS))
    # What bends the likeliest stiffness leaves comes on top.
    assert 0.8 * line < np.median(sigmas) < 1.6 * line
    assert np.mean(offs) == pytest.approx(np.mean(sigmas), rel=0.5)


@pytest.mark.parametrize(("high", "wide"), [(1, 1), (6, 5)])
def test_long_wave_variance_is_that_of_white_errors_times_the_area(high: int, wide: int) -> None:
    found = []
    for seed in range(12):
        cells = cells_with(patches(np.random.default_rng(seed), high, wide))
        design = csr_array(np.column_stack([np.cos(cells.azimuth), np.sin(cells.azimuth)]))
        weight = np.ones(cells.d.size)
        normal = product(design, weight, design)
        factor = factor_of(normal)
        residual = cells.d - design @ factor.solve(design.T @ cells.d)
        found.append(long_wave_variance(cells, design, normal, factor, weight, residual, 1.0))
    # Blocks of four reaches would have a sixth less without what reaches over their edges.
    assert np.mean(found) == pytest.approx(1e-6 * high * wide, rel=0.1)


def test_reach_is_that_of_the_errors() -> None:
    cells = cells_with(patches(np.random.default_rng(5), 6, 4))
    found = reach_of(cells, cells.d, np.ones(cells.d.size, dtype=np.bool_))
    assert found.levels == pytest.approx(6, abs=1)
    assert found.sectors == pytest.approx(4, abs=1)
    # Blocks of n cells hold 1 - (k² - 1) / (3 k n) of what means of k errors err together, a way.
    ideal = (1.0 - 35.0 / (18.0 * 24.0)) * (1.0 - 15.0 / (12.0 * 16.0))
    assert found.inside(24, 16) == pytest.approx(ideal, abs=0.02)


def test_weights_hide_as_much_of_gaussian_errors_as_theory_says() -> None:
    residual = np.random.default_rng(4).normal(0.0, 1e-2, 400_000)
    share = np.abs(residual) / (4.685e-2)
    weight = np.clip(1.0 - share**2, 0.0, 1.0) ** 2
    # Integrals of w = (1 - u²)² and ψ' = (1 - u²)(1 - 5u²) over the normal density.
    x = np.linspace(-4.685, 4.685, 20_001)
    density, square = np.exp(-(x**2) / 2.0), (x / 4.685) ** 2
    ratio = ((1.0 - square) ** 2 * density).sum() / (
        (1.0 - square) * (1.0 - 5.0 * square) * density
    ).sum()
    assert lost_to_weights(residual, weight, 1.0) == pytest.approx(ratio, rel=0.02)


def test_curves_are_as_stiff_as_the_tower() -> None:
    random = np.random.default_rng(6)
    noise = random.normal(0.0, 1e-3, (LEVELS, SECTORS))
    heights = (np.arange(LEVELS) + 0.5) * RISE
    angle = (np.arange(SECTORS) + 0.5) * 2.0 * np.pi / SECTORS
    wave = 5e-3 * np.sin(2.0 * np.pi * heights / 20.0)
    straight = fit_cells(cells_with(noise), 1.0)
    wavy = fit_cells(cells_with(noise + wave[:, None] * np.cos(angle)), 1.0)
    assert straight.stiffness[0] > 1e3 * wavy.stiffness[0]
    at = np.linspace(2.0, 98.0, 60)
    expected = 5e-3 * np.sin(2.0 * np.pi * at / 20.0)
    assert np.sqrt(np.mean((wavy.values(at)[:, 0] - expected) ** 2)) < 2e-4
    assert np.sqrt(np.mean(straight.values(at)[:, :2] ** 2)) < 5e-5


def test_uncertainty_scales_with_the_unit() -> None:
    errors = patches(np.random.default_rng(7), 3, 3)
    metres = fit_cells(cells_with(errors), 1.0)
    cells = cells_with(1e3 * errors)
    reference, grid = cells.reference, cells.grid
    table = reference.table * [1e3, 1e3, 1e3, 1.0, 1.0]
    large = cells._replace(
        s=1e3 * cells.s,
        reference=reference._replace(start=1e3 * reference.start, step=100.0, table=table),
        grid=grid._replace(level=1e3 * grid.level),
    )
    millimetres = fit_cells(large, 1e3)
    s = np.array([20.0, 70.0])
    assert 1e3 * metres.values(s) == pytest.approx(millimetres.values(1e3 * s), abs=1e-4)
    assert 1e6 * metres.covariances(s) == pytest.approx(
        millimetres.covariances(1e3 * s), rel=1e-3, abs=1e-9
    )
