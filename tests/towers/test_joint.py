"""The joint model: one fit to cells that were measured from a reference shell."""

import numpy as np

from midrib.towers.cells import Reference, cells_of, grid_for
from midrib.towers.joint import fit_cells
from midrib.towers.rough import Frame
from midrib.towers.simulate import Scan, Tower


def test_one_fit_turns_an_upright_reference_onto_a_leaning_cone() -> None:
    tower = Tower(height=40.0, base_radius=3.0, top_radius=1.0, lean=0.04)
    scan = Scan(tower, count=60_000, seed=3)
    s = np.arange(-1.0, 42.0, 0.1)
    table = np.column_stack([0.0 * s, 0.0 * s, tower.radius(s), 0.0 * s, 0.0 * s])
    upright = Reference(Frame(np.zeros(3), np.eye(3)), float(s[0]), 0.1, table, np.zeros((0, 2)))
    grid = grid_for(0.0, 40.0, 60_000, 1.0)
    cells = cells_of([scan.points()], upright, grid, 1.0, fine=True)
    found = fit_cells(cells, 1.0).values(np.array([5.0, 20.0, 35.0]))
    # Without the foot's own motion the centre would be off by r tan(taper) slope, 0.1 mm.
    assert np.abs(found[:, :2] - scan.axis([5.0, 20.0, 35.0])).max() < 6e-5
