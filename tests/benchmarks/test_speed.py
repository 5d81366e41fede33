"""The speed table works on a tiny run, leaves out what would last and sees changed answers."""

import json
from pathlib import Path

import pytest
from shapely import LineString

from rivals import MIDRIB
from speed import Cell, Plan, changed_answers, checksum, growth, predicted, run, time_text
from tables import markdown, milliseconds

TINY = Plan((("rect", 40), ("holes", 100)), 1, 0.01, 20, 0)


def cell(n: int, seconds: float | None, left_out: dict[str, float] | None = None) -> Cell:
    times = {} if left_out else {"rival": seconds, MIDRIB.name: 0.001}
    return Cell("river", n, times, left_out or {}, "")


def test_page_of_a_tiny_run_has_every_family_and_the_batch() -> None:
    results, text = run(TINY, "a command")
    assert {"## rect", "## holes", "## 20 areas of 100 vertices"} <= set(text.splitlines())
    assert "| midrib | **" in text
    assert all(len(cell["checksum"]) == 12 for cell in results["cells"])
    json.dumps(results)


def test_growth_is_the_exponent() -> None:
    assert growth([(10, 1.0), (100, 100.0)]) == pytest.approx(2.0)


def test_prediction_goes_on_as_time_has_grown() -> None:
    smaller = [cell(100, 0.01), cell(1000, 1.0)]
    assert predicted(smaller, "rival", 10_000) == pytest.approx(100.0)
    assert predicted(smaller[:1], "rival", 1000) == pytest.approx(0.01 * 10**1.5)
    assert predicted([], "rival", 1000) == 0.0


def test_what_was_left_out_stays_left_out() -> None:
    smaller = [cell(100, 1.0), cell(1000, None, {"rival": 90.0})]
    assert predicted(smaller, "rival", 10_000) > 900.0


def test_times_say_their_ratio_or_why_there_is_none() -> None:
    assert time_text(cell(100, 0.0123), "rival") == "12 (12\N{MULTIPLICATION SIGN})"
    assert time_text(cell(100, None), "rival") == "fails"
    assert time_text(cell(100, None, {"rival": 90.0}), "rival") == "left out (some 90 s)"


def test_checksum_sees_moved_points_and_not_rounding() -> None:
    line = [(0, 0), (1, 2)]
    assert checksum(LineString(line)) == checksum(LineString([(0, 0), (1, 2 + 1e-12)]))
    assert checksum(LineString(line)) != checksum(LineString([(0, 0), (1, 2.001)]))


def test_changed_answers_are_named(tmp_path: Path) -> None:
    def results(key: str) -> dict[str, object]:
        return {
            "cells": [{"family": "rect", "n": 100, "checksum": key}],
            "batch": {"count": 5, "checksum": "same"},
        }

    kept = tmp_path / "speed.json"
    assert changed_answers(kept, results("a")) == []
    kept.write_text(json.dumps(results("a")), encoding="utf-8")
    assert changed_answers(kept, results("a")) == []
    assert changed_answers(kept, results("b")) == ["rect 100"]


def test_markdown_lays_out_rows() -> None:
    assert markdown(["", "a"], [["x", "1"]]) == "|  | a |\n| --- | ---: |\n| x | 1 |\n"


@pytest.mark.parametrize(
    ("seconds", "text"), [(0.00012, "0.12"), (0.0123, "12"), (12.3456, "12,346")]
)
def test_milliseconds_have_the_digits_that_mean_something(seconds: float, text: str) -> None:
    assert milliseconds(seconds) == text
