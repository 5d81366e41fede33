"""Point clouds: what goes into a file comes back, and broken files are told in a sentence."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from midrib.errors import ParameterError
from midrib.formats.clouds import open_cloud
from midrib.towers.cloud import Tally
from midrib.types import Floats

FAR = np.array([6_482_000.0, 5_617_000.0, 150.0])
POINTS = np.random.default_rng(4).uniform(0.0, 50.0, (1000, 3)) + FAR


def las(path: Path) -> None:
    """Write POINTS with a tenth of a millimetre."""
    laspy = pytest.importorskip("laspy")
    header = laspy.LasHeader(point_format=0, version="1.2")
    header.scales, header.offsets = np.full(3, 1e-4), FAR
    cloud = laspy.LasData(header)
    cloud.x, cloud.y, cloud.z = POINTS.T
    cloud.write(path)


def e57(path: Path) -> None:
    """Write POINTS as two scans, the second one turned and moved by its pose."""
    pye57 = pytest.importorskip("pye57")
    file = pye57.E57(str(path), mode="w")
    names = ("cartesianX", "cartesianY", "cartesianZ")
    near = POINTS - FAR
    file.write_scan_raw(dict(zip(names, near[:400].T.copy(), strict=True)), translation=FAR)
    half_turn = near[400:] * [-1.0, -1.0, 1.0]  # a pose that turns by 180° about z takes it back
    turn = np.array([0.0, 0.0, 0.0, 1.0])
    file.write_scan_raw(
        dict(zip(names, half_turn.T.copy(), strict=True)), rotation=turn, translation=FAR
    )
    file.close()


def ply(form: str, kind: str) -> Callable[[Path], None]:
    """Writer of POINTS with a colour between the coordinates and a face after them."""

    def write(path: Path) -> None:
        names = {"f8": "double", "f4": "float"}
        head = f"ply\nformat {form} 1.0\ncomment x\nelement vertex {len(POINTS)}\n"
        head += f"property {names[kind]} x\nproperty uchar red\nproperty {names[kind]} y\n"
        head += f"property {names[kind]} z\nelement face 1\n"
        head += "property list uchar int vertex_indices\nend_header\n"
        if form == "ascii":
            rows = "".join(f"{x!r} 7 {y!r} {z!r}\n" for x, y, z in POINTS.tolist())
            path.write_bytes((head + rows + "3 0 1 2\n").encode())
            return
        order = "<" if "little" in form else ">"
        record = np.zeros(
            len(POINTS),
            dtype=[("x", order + kind), ("red", "u1"), ("y", order + kind), ("z", order + kind)],
        )
        record["x"], record["y"], record["z"] = POINTS.T
        path.write_bytes(head.encode() + record.tobytes() + b"\x03" + bytes(12))

    return write


def text(line: str, heading: str = "") -> Callable[[Path], None]:
    """Writer of POINTS as text."""

    def write(path: Path) -> None:
        rows = (line.format(i=i, x=x, y=y, z=z) for i, (x, y, z) in enumerate(POINTS.tolist()))
        path.write_text(heading + "\n".join(rows) + "\n", encoding="utf-8")

    return write


WRITERS: dict[str, tuple[str, Callable[[Path], None], float]] = {
    "las": ("a.las", las, 6e-5),
    "laz": ("a.laz", las, 6e-5),
    "e57": ("a.e57", e57, 3e-6),
    "ply_little": ("a.ply", ply("binary_little_endian", "f8"), 0.0),
    "ply_big": ("a.PLY", ply("binary_big_endian", "f8"), 0.0),
    "ply_single": ("a.ply", ply("binary_little_endian", "f4"), 0.5),
    "ply_text": ("a.ply", ply("ascii", "f8"), 0.0),
    "blanks": ("a.xyz", text(" {x!r}  {y!r}\t{z!r} 255 "), 0.0),
    "commas": ("a.csv", text("{x!r},{y!r},{z!r}"), 0.0),
    "heading": ("a.csv", text("{i};{z!r};{x!r};{y!r}", "id;Z;X;Y\n"), 0.0),
    "english": ("a.txt", text("{y!r},{x!r},{z!r}", "northing,easting,height\n"), 0.0),
    "names": ("a.csv", text("p{i},{x!r},{y!r},{z!r},"), 0.0),
    "numbers": ("a.csv", text("{i},{x!r},{y!r},{z!r}"), 0.0),
    "comments": ("a.txt", text("{x!r} {y!r} {z!r}", "# made by hand\n\n// twice\n"), 0.0),
    "count": ("a.pts", text("{x!r} {y!r} {z!r} 12", "1000\n"), 0.0),
    "npy": ("a.npy", lambda path: np.save(path, POINTS), 0.0),
    "npy_columns": ("a.npy", lambda path: np.save(path, np.asfortranarray(POINTS)), 0.0),
    "npy_big": ("a.npy", lambda path: np.save(path, POINTS.astype(">f8")), 0.0),
    "npy_whole": ("a.npy", lambda path: np.save(path, POINTS.astype(np.int32)), 1.0),
    "npz_packed": ("a.npz", lambda path: np.savez_compressed(path, POINTS), 0.0),
    "npz_columns": ("a.npz", lambda path: np.savez_compressed(path, POINTS.T.copy().T), 0.0),
    "npz": ("a.npz", lambda path: np.savez(path, other=np.zeros(3), points=POINTS), 0.0),
}


def read(path: Path) -> Floats:
    """All points of a file, read twice to see that every reading begins anew."""
    cloud = open_cloud(path)
    once, twice = (np.concatenate(list(cloud.chunks())) for _ in range(2))
    assert np.array_equal(once, twice)
    assert cloud.count in {None, len(once)}
    return once


@pytest.mark.parametrize("case", WRITERS)
def test_points_come_back(case: str, tmp_path: Path) -> None:
    name, write, most = WRITERS[case]
    write(tmp_path / name)
    found = read(tmp_path / name)
    assert found.shape == POINTS.shape
    assert np.abs(found - POINTS).max() <= most


def test_unit_of_a_las_file_is_that_of_its_reference_system(tmp_path: Path) -> None:
    laspy = pytest.importorskip("laspy")
    header = laspy.LasHeader(point_format=6, version="1.4")
    wkt = (
        'LOCAL_CS["site",LOCAL_DATUM["site",0],UNIT["foot",0.3048],AXIS["x",EAST],AXIS["y",NORTH]]'
    )
    header.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr(wkt))
    laspy.LasData(header).write(tmp_path / "a.las")
    assert open_cloud(tmp_path / "a.las").metres in {0.3048, None}
    header = laspy.LasHeader(point_format=6, version="1.4")
    utm = (
        'PROJCS["x",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
        'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],'
        'PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],'
        'PARAMETER["central_meridian",15],PARAMETER["scale_factor",0.9996],'
        'PARAMETER["false_easting",500000],PARAMETER["false_northing",0],'
        'UNIT["US survey foot",0.304800609601219]]'
    )
    header.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr(utm))
    laspy.LasData(header).write(tmp_path / "b.las")
    assert open_cloud(tmp_path / "b.las").metres == pytest.approx(0.304800609601219)


FOOT, SURVEY_FOOT = 0.3048, 1200.0 / 3937.0
SYSTEMS: dict[str, tuple[str | dict[int, int], float]] = {
    # What a file says, and how many units of x and y one of z has.
    "wkt_feet_over_metres": ("EPSG:6344+6360", SURVEY_FOOT),
    "wkt_metres_over_feet": ("EPSG:2264+5703", 1.0 / SURVEY_FOOT),
    "wkt_metres": ("EPSG:6344+5703", 1.0),
    "wkt_feet": ("EPSG:2264+6360", 1.0),
    "wkt_plane": ("EPSG:6344", 1.0),
    "keys_of_units": ({3072: 6344, 4099: 9003}, SURVEY_FOOT),
    "keys_of_systems": ({3072: 6344, 4096: 6360}, SURVEY_FOOT),
    "keys_at_odds": ({3072: 6344, 4096: 5703, 4099: 9002}, FOOT),
    "keys_without_a_system": ({3072: 32767, 3076: 9002, 4099: 9001}, 1.0 / FOOT),
    "keys_of_the_plane": ({3072: 6344}, 1.0),
    "keys_of_heights_only": ({4099: 9003}, 1.0),
}


def las_in(path: Path, system: str | dict[int, int]) -> None:
    """Write POINTS as a file that says it is in a reference system."""
    laspy, pyproj = pytest.importorskip("laspy"), pytest.importorskip("pyproj")
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = np.full(3, 1e-4), FAR
    if isinstance(system, str):
        wkt = pyproj.CRS(system).to_wkt("WKT1_GDAL")
        header.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr(wkt))
    else:
        words = [1, 1, 0, len(system)]
        for key, value in sorted(system.items()):
            words += [key, 0, 1, value]
        keys = laspy.vlrs.known.GeoKeyDirectoryVlr()
        keys.parse_record_data(np.array(words, dtype="<u2").tobytes())
        header.vlrs.append(keys)
    cloud = laspy.LasData(header)
    cloud.x, cloud.y, cloud.z = POINTS.T
    cloud.write(path)


@pytest.mark.parametrize("case", SYSTEMS)
def test_heights_of_a_las_file_are_in_the_unit_of_its_plane(case: str, tmp_path: Path) -> None:
    system, stretch = SYSTEMS[case]
    las_in(tmp_path / "a.las", system)
    cloud = open_cloud(tmp_path / "a.las")
    expected = POINTS * [1.0, 1.0, stretch]
    assert np.concatenate(list(cloud.chunks())) == pytest.approx(expected, abs=4e-4)
    assert np.concatenate(list(cloud.some(len(POINTS))))[:, :3] == pytest.approx(expected, abs=4e-4)
    # Heights that were turned are no longer in the vertical system of the file.
    assert stretch == 1.0 or "Compound" not in str(cloud.crs)


def test_heights_of_a_las_file_in_an_unknown_unit_are_refused(tmp_path: Path) -> None:
    las_in(tmp_path / "a.las", {3072: 6344, 4099: 9036})
    with pytest.raises(ParameterError, match=r"heights in the unit EPSG:9036, expected one of"):
        open_cloud(tmp_path / "a.las")


BROKEN = {
    "missing": ("a.las", None, "does not exist"),
    "ending": ("a.docx", b"x", "ends in '.docx', expected .las, .laz"),
    "las": ("a.las", b"LASF" + bytes(20), "breaks off after 24 bytes, the header alone has 227"),
    "no_las": ("a.laz", b"hello", "begins with b'hell', expected b'LASF', as .laz files do"),
    "empty_las": ("a.las", b"", "is empty, expected points"),
    "no_e57": ("a.e57", b"hello" * 99, "begins with b'hellohel', expected b'ASTM-E57'"),
    "empty_e57": ("a.e57", b"", "is empty, expected points"),
    "empty_ply": ("a.ply", b"", "is empty, expected points"),
    "empty_npy": ("a.npy", b"", "is empty, expected points"),
    "no_ply": ("a.ply", b"hello", "it is no PLY file"),
    "ply_short": (
        "a.ply",
        b"ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty double x\n"
        b"property double y\nproperty double z\nend_header\n" + bytes(30),
        "it ends after 1 of 9 points",
    ),
    "ply_flat": (
        "a.ply",
        b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        b"end_header\n1 2\n",
        "has no property z",
    ),
    "words": ("a.txt", b"once upon a time\nthere was\n", "no line with three numbers"),
    "word": ("a.csv", b"1.0,2.0,3.0\n1.0,oops,3.0\n", "has 'oops' for a coordinate"),
    "empty": ("a.xyz", b"", "is empty, expected points"),
    "blank": ("a.xyz", b"\n \n", "no line with three numbers"),
    "npy": ("a.npy", b"hello", "cannot be read"),
    "no_npz": ("a.npz", b"hello", "cannot be read"),
}


@pytest.mark.parametrize("case", BROKEN)
def test_broken_files_are_told_in_a_sentence(case: str, tmp_path: Path) -> None:
    name, content, sentence = BROKEN[case]
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    if name.endswith(".e57"):
        pytest.importorskip("pye57")
    with pytest.raises(ParameterError, match="CLOUD") as caught:
        list(open_cloud(path).chunks())
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.99])
@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("a.las", r"breaks off after [\d,]+ of \d"),
        ("a.laz", r"breaks off after [\d,]+ bytes, more"),
    ],
)
def test_files_that_break_off_say_where(
    name: str, sentence: str, share: float, tmp_path: Path
) -> None:
    las(tmp_path / name)
    whole = (tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(whole[: max(int(share * len(whole)), 400)])
    with pytest.raises(ParameterError, match=sentence):
        open_cloud(tmp_path / name)


def test_arrays_of_another_shape_are_refused(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", np.zeros((5, 2)))
    with pytest.raises(ParameterError, match=r"\(5, 2\) of float64, expected numbers \(n, 3\)"):
        open_cloud(tmp_path / "a.npy")


def rows_of(points: Floats) -> list[str]:
    """Points as rows of a text file."""
    return [f"{x!r} {y!r} {z!r}" for x, y, z in points.tolist()]


@pytest.mark.parametrize("odd", ["1 2", "1 2 3 4", "so it ends"])
def test_rows_of_another_width_are_points_without_coordinates(odd: str, tmp_path: Path) -> None:
    rows = rows_of(POINTS)
    path = tmp_path / "a.xyz"
    for k in range(7):
        rows.insert(100 * k + 50, odd if odd != "so it ends" else "so it all ends")
    path.write_text("\n".join(rows), encoding="ascii")
    tally = Tally()
    kept = np.concatenate(list(tally.over(open_cloud(path).chunks())))
    assert np.array_equal(kept, POINTS)
    assert tally.unusable == 7


def test_a_text_with_many_rows_of_another_width_is_refused(tmp_path: Path) -> None:
    rows = rows_of(POINTS)
    rows[200:211] = ["1.5 2.5 3.5 4.5"] * 11
    path = tmp_path / "a.xyz"
    path.write_text("\n".join(rows), encoding="ascii")
    with pytest.raises(ParameterError, match=r"has 11 of 1,000 rows .*'1.5 2.5 3.5 4.5', expected"):
        list(open_cloud(path).chunks())


def test_comments_and_counts_of_scans_are_no_rows(tmp_path: Path) -> None:
    scans = [[str(len(scan)), *rows_of(scan)] for scan in np.array_split(POINTS, 50)]
    rows = [row for scan in scans for row in scan]
    text = "\n".join([*rows, "# made by hand", ""])
    for ending in ("pts", "xyz"):
        (tmp_path / f"a.{ending}").write_text(text, encoding="ascii")
    assert np.array_equal(read(tmp_path / "a.pts"), POINTS)
    with pytest.raises(ParameterError, match=r"has 49 of 1,049 rows"):
        list(open_cloud(tmp_path / "a.xyz").chunks())


Columns = dict[str, "np.ndarray[Any, Any]"]


def e57_of(path: Path, columns: Columns, translation: Floats) -> None:
    """Write one scan of any fields, which the writer of pye57 does not know."""
    pye57 = pytest.importorskip("pye57")
    from pye57 import libe57

    file = pye57.E57(str(path), mode="w")
    image = file.image_file
    scan, prototype, pose, shift = (libe57.StructureNode(image) for _ in range(4))
    scan.set("guid", libe57.StringNode(image, "{a}"))
    for name, value in zip("xyz", translation, strict=True):
        shift.set(name, libe57.FloatNode(image, value))
    pose.set("translation", shift)
    scan.set("pose", pose)
    buffers = libe57.VectorSourceDestBuffer()
    kept = []  # buffers point into these
    for name, column in columns.items():
        is_whole = column.dtype.kind == "i"
        node = (
            libe57.IntegerNode(image, 0, 0, 2)
            if is_whole
            else libe57.FloatNode(image, 0.0, libe57.E57_DOUBLE, -1e9, 1e9)
        )
        prototype.set(name, node)
        kept.append(np.ascontiguousarray(column, dtype="i1" if is_whole else "f8"))
        buffers.append(libe57.SourceDestBuffer(image, name, kept[-1], len(column), True, True))
    points = libe57.CompressedVectorNode(image, prototype, libe57.VectorNode(image, True))
    scan.set("points", points)
    file.data3d.append(scan)
    writer = points.writer(buffers)
    writer.write(len(kept[0]))
    writer.close()
    file.close()


def test_spherical_points_of_an_e57_file_are_placed(tmp_path: Path) -> None:
    scanner = FAR + np.array((20.0, 30.0, 25.0))  # points are all around it, above and below
    x, y, z = (POINTS - scanner).T
    invalid = np.arange(len(POINTS)) % 5 == 0
    columns = {
        "sphericalRange": np.where(invalid, 0.0, np.hypot(np.hypot(x, y), z)),
        "sphericalAzimuth": np.arctan2(y, x),
        "sphericalElevation": np.arctan2(z, np.hypot(x, y)),
        "sphericalInvalidState": np.where(invalid, 2, 0),
    }
    e57_of(tmp_path / "a.e57", columns, scanner)
    found = np.concatenate(list(open_cloud(tmp_path / "a.e57").chunks()))
    assert found == pytest.approx(POINTS[~invalid], rel=0.0, abs=5e-9)


def test_an_e57_file_without_coordinates_is_refused(tmp_path: Path) -> None:
    columns = {"cartesianX": POINTS[:, 0], "sphericalRange": POINTS[:, 1]}
    e57_of(tmp_path / "a.e57", columns, FAR)
    with pytest.raises(ParameterError, match=r"scan 0 has the fields cartesianX, sphericalRange, "):
        list(open_cloud(tmp_path / "a.e57").chunks())


def test_bytes_that_are_no_text_are_told_in_a_sentence(tmp_path: Path) -> None:
    path = tmp_path / "a.laz"
    las(path)
    whole = path.read_bytes()
    path.write_bytes(whole[:229] + b"\xb5" * (len(whole) - 229))
    with pytest.raises(ParameterError, match=r"bytes that are no UTF-8 text .* no \.laz file"):
        list(open_cloud(path).chunks())


@pytest.mark.parametrize("ending", ["npy", "npz"])
def test_memory_for_arrays_does_not_depend_on_their_size(ending: str, tmp_path: Path) -> None:
    # Own numbers and pages of a mapped file both: in a process that reads and does nothing else.
    resource = pytest.importorskip("resource")
    assert resource
    code = (
        "import sys, resource, pathlib\n"
        "from midrib.formats.clouds import open_cloud\n"
        "peak = lambda: resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "cloud = open_cloud(pathlib.Path(sys.argv[1]))\n"
        "next(iter(cloud.chunks())).sum()\n"
        "before = peak()\n"
        "total = sum(len(chunk) for chunk in cloud.chunks() if chunk.sum() == 0.0)\n"
        "print(total, (peak() - before) * (1 if sys.platform == 'darwin' else 1024))\n"
    )
    path = tmp_path / f"a.{ending}"
    n = 6_000_000
    (np.save if ending == "npy" else np.savez)(path, np.zeros((n, 3)))
    told = subprocess.run([sys.executable, "-c", code, path], capture_output=True, check=True)
    total, grown = map(int, told.stdout.split())
    assert total == n
    assert grown < 0.4 * path.stat().st_size


def test_an_array_that_is_cut_off_is_told(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", POINTS)
    (tmp_path / "b.npy").write_bytes((tmp_path / "a.npy").read_bytes()[:-8])
    with pytest.raises(ParameterError, match="it ends before the last of 1000 points"):
        list(open_cloud(tmp_path / "b.npy").chunks())


def test_a_damaged_laz_file_does_not_ask_for_all_memory(tmp_path: Path) -> None:
    las(tmp_path / "a.laz")
    whole = bytearray((tmp_path / "a.laz").read_bytes())
    start = int.from_bytes(whole[96:100], "little")  # of points, LAS 1.2
    table = int.from_bytes(whole[start : start + 8], "little")
    whole[table + 4 : table + 8] = b"\xff\xff\xff\xff"
    (tmp_path / "b.laz").write_bytes(whole)
    with pytest.raises(ParameterError, match=r"4,294,967,295 packs of points in [\d,]+ bytes"):
        open_cloud(tmp_path / "b.laz")
