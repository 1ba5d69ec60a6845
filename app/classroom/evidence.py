"""Plots for the store: plain, and never larger than agreed."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

LARGEST_BYTES = 64_000
MOST_PLOTS = 6
MOST_SERIES = 12
MOST_POINTS = 1500
LONGEST_WORD = 120
DIGITS = 6
LARGEST_NUMBER = 1e300


def packed(plots: Sequence[Any]) -> str:
    """Plots as JSON of at most `LARGEST_BYTES`, with fewer points where they would be larger; "" for none."""
    plain = [_plain_plot(plot) for plot in plots[:MOST_PLOTS]]
    if not plain:
        return ""
    text = _json(plain)
    while len(text.encode()) > LARGEST_BYTES:
        thinned = [_thinned(plot) for plot in plain]
        plain = thinned if thinned != plain else plain[:-1]  # nothing but gaps: one plot less
        text = _json(plain)
    return text


def _json(plots: list[dict[str, Any]]) -> str:
    return json.dumps(plots, separators=(",", ":"), ensure_ascii=False)


def _plain_plot(plot: Any) -> dict[str, Any]:
    data: Mapping[str, Any] = plot if isinstance(plot, Mapping) else dataclasses.asdict(plot)
    words = {name: str(data.get(name, ""))[:LONGEST_WORD] for name in ("title", "x_label", "y_label")}
    series = [_plain_series(dict(one)) for one in list(data.get("series", ()))[:MOST_SERIES]]
    return {**words, "equal": bool(data.get("equal", False)), "series": series}


def _plain_series(series: dict[str, Any]) -> dict[str, Any]:
    xs, ys = series.get("x", ()), series.get("y", ())
    count = min(len(xs), len(ys))
    shown = slice(0, count, max(1, -(-count // MOST_POINTS)))
    return {"label": str(series.get("label", ""))[:LONGEST_WORD], "x": _numbers(xs[shown]), "y": _numbers(ys[shown])}


def _numbers(values: Sequence[Any]) -> list[float | None]:
    """As many digits as are seen; a gap (None) where there is no number."""
    numbers = [math.nan if value is None else float(value) for value in values]
    largest = max((abs(number) for number in numbers if abs(number) < LARGEST_NUMBER), default=0.0)
    places = DIGITS - 1 - math.floor(math.log10(largest)) if largest else 0
    return [round(number, places) if abs(number) < LARGEST_NUMBER else None for number in numbers]


def _thinned(plot: dict[str, Any]) -> dict[str, Any]:
    """Every other point; the gaps stay, or strokes would become one line."""
    return {**plot, "series": [_every_other(one) for one in plot["series"]]}


def _every_other(series: dict[str, Any]) -> dict[str, Any]:
    xs, ys = series["x"], series["y"]
    kept = [place for place in range(len(xs)) if place % 2 == 0 or xs[place] is None or ys[place] is None]
    return {**series, "x": [xs[place] for place in kept], "y": [ys[place] for place in kept]}
