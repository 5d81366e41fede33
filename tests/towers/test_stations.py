"""Stations that are a little off: told apart from the shape of the sections, and put together."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import laspy
import numpy as np
import pytest

from midrib import tower_axis
from midrib.errors import GeometryTypeError
from midrib.formats.clouds import open_cloud
from midrib.towers.cells import Cells, Grid, Reference
from midrib.towers.cloud import ArrayCloud
from midrib.towers.pipeline import Options, axis_of
from midrib.towers.rough import Frame
from midrib.towers.simulate import Scan, Tower
from midrib.towers.stations import Aligned, Station, labels_in, without_form
from midrib.types import Floats
from tests.towers.scans import dirty, offsets

NO_FACES = np.zeros((0, 2))
TOWER = Tower(40.0, 2.5, 1.5, lean=0.1, lean_azimuth=40.0)


def moved(scan: Scan) -> tuple[Floats, Floats]:
    """Points of a scan whose stations are off by known shifts (3, 2), and these."""
    shifts = np.array([(0.0045, 0.0), (0.0, -0.002), (-0.0045, 0.002)])
    points = scan.points()
    points[:, :2] += shifts[scan.stations]
    return points, shifts


@pytest.mark.parametrize("oval", [0.0, 0.01])
def test_shifts_are_found_whatever_the_shape_is(oval: float) -> None:
    scan = dirty(replace(TOWER, oval=oval, twist=20.0))
    points, shifts = moved(scan)
    axis = tower_axis(points, stations=scan.stations)
    found = np.array([(station.x, station.y) for station in axis.stations])
    assert found == pytest.approx(shifts, abs=8e-4)
    assert axis.shape.name == ("oval" if oval else "round")
    assert np.nanmax(offsets(axis, scan)) < 1e-3


@pytest.mark.parametrize(("oval", "twist"), [(0.03, 0.0), (0.06, 80.0)])
def test_an_oval_has_no_shifts_of_its_own(oval: float, twist: float) -> None:
    """Points of a cell lie nearer to their station, where the oval is another."""
    scan = dirty(replace(TOWER, oval=oval, twist=twist))
    axis = tower_axis(scan.points(), stations=scan.stations)
    shifts = np.array([(station.x, station.y) for station in axis.stations]).reshape(-1, 2)
    sigma = max([station.sigma for station in axis.stations], default=0.0)
    assert np.abs(shifts).max(initial=0.0) < 2.5 * sigma + 1e-12
    assert sigma < 6e-4
    assert np.sqrt(np.nanmean(offsets(axis, scan) ** 2)) < 3e-4


def test_the_form_of_a_section_is_taken_off_where_it_is_measured() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 500, endpoint=False)
    parts = []
    for off in (0.0, 0.03):  # the second station has its points a little farther round
        azimuth = angle + off
        form = 0.02 * np.cos(2.0 * azimuth + 0.4) + 0.004 * np.sin(5.0 * azimuth)
        zeros = np.zeros(angle.size)
        level = zeros.astype(np.intp)
        grid = Grid(0.0, 0.5, 1, 500, 1)
        reference = Reference(Frame(np.zeros(3), np.eye(3)), 0.0, 0.1, np.zeros((2, 5)), NO_FACES)
        cells = Cells(level, level, zeros, azimuth, form, zeros, zeros, reference, grid)
        parts.append(cells)
    for cells in without_form(parts, 1.0):
        assert np.abs(cells.d).max() < 1e-9


class Counted(ArrayCloud):
    """A cloud that knows how often it was read."""

    readings = 0

    def chunks(self, *, with_stations: bool = False) -> Iterator[Floats]:
        """Points, a chunk at a time."""
        self.readings += 1
        return super().chunks(with_stations=with_stations)


def test_the_reading_for_stations_gives_the_shell_to_measure_from() -> None:
    scan = dirty(TOWER)
    points, _ = moved(scan)
    cloud = Counted(points, scan.stations)
    axis_of(cloud, Options())
    assert cloud.readings == 2


def test_stations_that_could_not_be_put_together_are_flagged() -> None:
    """Two stations of which either sees two faces of its own have nothing in common."""
    tower = replace(TOWER, faces=4, twist=20.0)
    scan = dirty(tower, azimuths=(65.0, 245.0))
    points, labels = scan.points(), scan.stations
    levels = tower_axis(points, stations=labels).levels
    told = np.char.find(levels["flag"], "stations not put together") >= 0
    assert told[np.isfinite(levels["x"])].all()
    # Who says how well they were registered has it in sigma.
    assert (tower_axis(points, stations=labels, registration=1e-3).levels["flag"] == "").any()


def test_without_stations_shifts_look_like_an_oval() -> None:
    scan = dirty(TOWER)
    points, _ = moved(scan)
    assert tower_axis(points).shape.name == "oval"
    # Who says how well stations were registered is not told of ovals that are no larger.
    assert tower_axis(points, registration=0.003).shape.name == "round"


def test_sigma_is_that_of_the_mean_of_stations() -> None:
    scan = dirty(TOWER)
    points, shifts = moved(scan)
    levels = tower_axis(points, stations=scan.stations).levels
    left = np.sqrt((shifts**2).sum() / 2.0 / 2.0 / 3.0)
    assert np.nanmedian(levels["sigma"]) == pytest.approx(left, rel=0.15)


def test_stations_that_share_nothing_are_left_where_they_are() -> None:
    scan = dirty(TOWER, azimuths=(0.0, 180.0))
    opposite = np.where(np.cos(np.arctan2(*scan.points()[:, 1::-1].T)) > 0.0, 0, 1)
    assert tower_axis(scan.points(), stations=opposite).stations == []


def test_labels_of_few_points_are_no_stations() -> None:
    label = np.repeat([3.0, 7.0, 9.0], [500, 500, 5])
    sample = np.column_stack([np.zeros((label.size, 3)), label])
    assert labels_in(sample).tolist() == [3.0, 7.0]
    assert labels_in(sample[:500]).size == 0
    assert labels_in(sample[:, :3]).size == 0


def test_points_of_no_station_stay() -> None:
    cloud = ArrayCloud(np.zeros((3, 3)), np.array([5, 2, 8]))
    stations = [Station(5, 1, 0.1, 0.2, 0.0), Station(2, 1, -0.3, 0.0, 0.0)]
    chunk = next(iter(Aligned(cloud, stations).chunks()))
    assert chunk.tolist() == [[-0.1, -0.2, 0.0], [0.3, 0.0, 0.0], [0.0, 0.0, 0.0]]


def test_files_tell_stations(tmp_path: Path) -> None:
    scan = dirty(TOWER, count=1000)
    points = scan.points()
    header = laspy.LasHeader(point_format=0, version="1.2")
    header.scales = np.full(3, 1e-4)
    las = laspy.LasData(header)
    las.x, las.y, las.z = points.T
    las.point_source_id = scan.stations
    las.write(tmp_path / "a.laz")
    rows = np.column_stack([scan.stations, points])
    named = tmp_path / "a.csv"
    np.savetxt(named, rows, fmt="%g", delimiter=",", header="station,x,y,z", comments="")
    for path in (tmp_path / "a.laz", named):
        cloud = open_cloud(path)
        table = np.concatenate(list(cloud.chunks(with_stations=True)))
        assert cloud.has_stations
        assert np.array_equal(table[:, 3], scan.stations)
        assert np.concatenate(list(cloud.chunks())).shape == (1000, 3)


def test_sample_is_from_all_over_a_file(tmp_path: Path) -> None:
    points = np.arange(3.0e6).reshape(-1, 3)
    np.save(tmp_path / "a.npy", points)
    header = laspy.LasHeader(point_format=0, version="1.2")
    header.scales = np.ones(3)
    with laspy.open(tmp_path / "a.las", "w", header=header) as writer:
        record = laspy.ScaleAwarePointRecord.zeros(len(points), header=header)
        record.x, record.y, record.z = points.T
        writer.write_points(record)
    for name in ("a.npy", "a.las"):
        sample = np.concatenate(list(open_cloud(tmp_path / name).some(20_000)))[:, 0]
        assert len(sample) == 20_000
        parts = np.histogram(sample, bins=50, range=(0.0, 3.0e6))[0]
        assert (parts == 400).all()
        assert np.unique(sample).size == sample.size


def test_stations_beside_the_points_are_refused() -> None:
    with pytest.raises(GeometryTypeError, match=r"expected whole numbers \(1000,\)"):
        tower_axis(dirty(count=1000).points(), stations=[1, 2])
