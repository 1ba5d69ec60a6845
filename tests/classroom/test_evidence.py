"""Plots for the store: small, with their gaps."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass

from app.classroom.evidence import LARGEST_BYTES, packed


@dataclass
class AsObject:
    title: str
    x_label: str
    y_label: str
    series: list[dict]


def plot(xs: list, ys: list, series: int = 1) -> dict:
    return {"title": "T", "x_label": "x", "y_label": "y", "series": [{"label": "a", "x": xs, "y": ys}] * series}


def test_nothing_is_nothing():
    assert packed([]) == ""


def test_numbers_keep_the_digits_that_are_seen():
    (kept,) = json.loads(packed([plot([0.123456789, 1234.56789], [math.nan, None])]))
    assert kept["series"] == [{"label": "a", "x": [0.12, 1234.57], "y": [None, None]}]
    (kept,) = json.loads(packed([plot([1e-9, 2.3456789e-9], [math.inf, 1e308])]))
    assert kept["series"][0] == {"label": "a", "x": [1e-9, 2.34568e-9], "y": [None, None]}


def test_a_plot_may_be_an_object():
    packed_object = packed([AsObject(**plot([0, 1], [2, 3]))])  # type: ignore[arg-type]
    assert json.loads(packed_object) == json.loads(packed([plot([0, 1], [2, 3])]))


def test_a_large_plot_gets_fewer_points_but_keeps_its_gaps():
    xs = [None if number % 100 == 99 else number / 7.0 for number in range(1500)]
    text = packed([plot(xs, xs, series=6)])
    assert len(text.encode()) <= LARGEST_BYTES
    (kept,) = json.loads(text)
    line = kept["series"][5]["x"]
    assert line.count(None) == 15 and 100 < len(line) < 1000


def test_even_nothing_but_gaps_fits():
    assert len(packed([plot([None] * 1500, [None] * 1500, series=12)] * 6).encode()) <= LARGEST_BYTES
