"""The measurement of many areas in one call."""

import numpy as np
import shapely
from shapely import box

from batch import digest, lines_of, measure, page


def test_lines_are_given_as_wkb_and_refused_areas_as_none() -> None:
    flat = shapely.Polygon([(0, 0), (4, 4), (4, 0), (0, 4)])
    lines = lines_of(shapely.to_wkb(np.array([box(0, 0, 4, 1), flat])), 1)
    assert shapely.from_wkb(lines[0]).length == 4.0
    assert lines[1] is None


def test_digests_tell_one_bit() -> None:
    assert digest([b"ab", None]) == digest([b"ab", None])
    assert len({digest([b"ab", None]), digest([b"ac", None]), digest([b"ab", b"-", None])}) == 3


def test_the_page_compares_threads_with_the_yardstick() -> None:
    results = measure(20)
    assert len(set(results["digests"].values())) == 1
    text = page(results)
    assert "midrib, 2 threads" in text
    assert "the same bit by bit" in text
    other = results | {"digests": {1: "a", 2: "b"}}
    assert "NOT the same" in page(other)
