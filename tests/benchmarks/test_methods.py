"""The table of skeletons names the fastest rival, of those for the same and of all."""

from methods import GROUPS, SAME, Times, fastest
from speed import MISSING


def test_the_fastest_rival_is_named() -> None:
    ways = GROUPS["methods"]
    names = [way.name for way in ways]
    assert SAME[0] in names
    times: Times = dict.fromkeys(names, None)
    times |= {"medial-axis": 1.0, "pyvoronoi": 6.0, "centerline": 2.5}
    without = times | {"pyvoronoi": None}
    found = {"river 1000": times, "river 100": times, "rect 1000": without}
    assert fastest(found, ways, "medial-axis").splitlines()[2:] == [
        "| river 1,000 | 6 (pyvoronoi) | 2.5 (centerline) |",
        f"| rect 1,000 | {MISSING} | 2.5 (centerline) |",
    ]
