"""The table of skeletons names the fastest rival, of those for the same and of all."""

from methods import GROUPS, SAME, fastest


def test_the_fastest_rival_is_named() -> None:
    ways = GROUPS["methods"]
    names = [way.name for way in ways]
    assert SAME[0] in names
    times = dict.fromkeys(names, 9.0) | {"medial-axis": 1.0, "pyvoronoi": 6.0, "centerline": 2.5}
    found = {"river 1000": times, "river 100": times, "rect 1000": times | {"pyvoronoi": None}}
    assert fastest(found, ways, "medial-axis").splitlines()[2:] == [
        "| river 1,000 | 6 (pyvoronoi) | 2.5 (centerline) |",
        "| rect 1,000 | – | 2.5 (centerline) |",
    ]
