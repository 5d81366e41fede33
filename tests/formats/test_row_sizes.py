"""Bytes of rows: what they hold, however they come."""

import decimal
from typing import Any

import pyarrow as pa
import pytest

from midrib.formats.row_sizes import row_sizes

PAIRS = pa.map_(pa.string(), pa.int64())
COLUMNS = [
    (pa.array(["a", "bcd", None, "éé"]), [1, 3, 0, 4]),
    (pa.array([b"12", None, b"", b"123"], pa.large_binary()), [2, 0, 0, 3]),
    (pa.array([1, 2, None, 4], pa.int32()), [4, 4, 4, 4]),
    (pa.array([True, False, None, True]), [1, 1, 1, 1]),
    (pa.array([decimal.Decimal("1.5")] * 4), [16, 16, 16, 16]),
    (pa.nulls(4), [1, 1, 1, 1]),
    (pa.array([[1, 2], None, [], [3]], pa.list_(pa.int64())), [16, 0, 0, 8]),
    (pa.array([["ab", "c"], None, [None, "defg"], []], pa.large_list(pa.string())), [3, 0, 4, 0]),
    (pa.array([[1.0, 2.0]] * 3 + [None], pa.list_(pa.float64(), 2)), [16, 16, 16, 0]),
    (
        pa.array([{"x": 1, "y": "abc"}, None, {"x": 2, "y": None}, {"x": 1, "y": "z"}]),
        [11, 8, 8, 9],
    ),
    (pa.array([[("k", 1)], [], None, [("a", 1), ("bb", 2)]], PAIRS), [9, 0, 0, 19]),
    (pa.array(["u", "v", "u", "u"]).dictionary_encode(), [4, 4, 4, 4]),
]


@pytest.mark.parametrize(("column", "sizes"), COLUMNS, ids=[str(c.type) for c, _ in COLUMNS])
def test_rows_are_as_large_as_what_they_hold(column: Any, sizes: list[int]) -> None:
    table = pa.table({"column": column})
    assert row_sizes(table).tolist() == sizes
    assert row_sizes(table.slice(1, 2)).tolist() == sizes[1:3]
    assert row_sizes(pa.concat_tables([table.slice(2), table])).tolist() == sizes[2:] + sizes
    assert row_sizes(table.slice(4)).tolist() == []
    twice = pa.table({"column": column, "other": column})
    assert row_sizes(twice).tolist() == [2 * size for size in sizes]
