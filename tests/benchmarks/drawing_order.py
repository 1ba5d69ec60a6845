"""How short the way with the pen up becomes, and how long that takes, as ratios in one run.

    python tests/benchmarks/drawing_order.py [--many 20000] [--budgets-s 0 0.5] [--peers venv/bin/python] [--json]

Made-up drawings, shuffled and turned at random, each ordered by us, by the nearest neighbour and by the greedy edge;
with an interpreter that has vpype also by its `linesort` and `linesort --two-opt`. The pen-up
way counts from home, the middle of the sheet, for everyone; vpype, which knows no home, begins anywhere, so `free`
is the ratio to two-opt without that first hop. Seconds are of the processor, vpype's without its start.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import tyro

from app.drawing.order import order_strokes, pen_up_mm, pen_up_s
from app.drawing.order.cost import DEFAULT_COST, HOME, Array
from app.drawing.order.greedy import greedy_tour
from app.drawing.order.tour import Ends, in_order
from tests.benchmarks.drawing_peers import ask, pack, unpack

Strokes = list[Array]
SHEET_MM = 160.0
TWO_OPT = "linesort --two-opt"


@dataclass(frozen=True)
class Options:
    """What to measure."""

    many: int = 20_000
    """Strokes in the largest drawing; vpype's two-opt needs a minute for 20 000."""
    budgets_s: tuple[float, ...] = (0.0, 0.5)
    """Seconds to improve our order."""
    peers: Path | None = None
    """Interpreter that has vpype, of an environment of its own."""
    json: bool = False
    """Print JSON instead of a table."""


def random_lines(count: int, rng: np.random.Generator) -> Strokes:
    starts = rng.uniform(-SHEET_MM / 2, SHEET_MM / 2, (count, 2))
    angles, lengths = rng.uniform(0.0, 2 * np.pi, count), rng.uniform(0.0, 3.0, count)
    stops = starts + lengths[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    return list(np.stack([starts, stops], axis=1))


def crowded_curves(count: int, rng: np.random.Generator) -> Strokes:
    """Wavy curves of very different length, most of them in a few places, as the edges in a photo."""
    centres = rng.uniform(-60.0, 60.0, (8, 2))
    curves = []
    for _ in range(count):
        points = int(rng.lognormal(2.5, 0.8)) + 2
        heading = rng.uniform(0.0, 2 * np.pi) + np.cumsum(rng.normal(0.0, 0.15, points))
        start = centres[rng.integers(8)] + rng.normal(0.0, 12.0, 2)
        curves.append(start + np.cumsum(0.8 * np.column_stack([np.cos(heading), np.sin(heading)]), axis=0))
    return curves


def hatched_discs(count: int, rng: np.random.Generator) -> Strokes:
    """Discs filled with parallel lines in two directions."""
    lines = []
    for _ in range(count):
        centre, radius, angle = rng.uniform(-60.0, 60.0, 2), rng.uniform(6.0, 20.0), rng.integers(2) * np.pi / 2
        for offset in np.arange(-radius + 0.5, radius, 1.5):
            half = np.sqrt(radius**2 - offset**2)
            along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
            lines.append(centre + offset * across + np.outer([-half, half], along))
    return lines


def rings(count: int, rng: np.random.Generator) -> Strokes:
    """Closed circles; with `crowded_curves` a cartoon."""
    angle = np.append(np.linspace(0.0, 2 * np.pi, 80, endpoint=False), 0.0)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    return [rng.uniform(-70.0, 70.0, 2) + rng.uniform(1.0, 12.0) * circle for _ in range(count)]


def shuffled(strokes: Strokes, rng: np.random.Generator) -> Strokes:
    return [strokes[k][:: rng.choice([1, -1])] for k in rng.permutation(len(strokes))]


def drawings(many: int) -> dict[str, Strokes]:
    rng = np.random.default_rng(0)
    sets = {f"random {count}": random_lines(count, rng) for count in (200, 2000, many)}
    sets |= {f"crowded {count}": crowded_curves(count, rng) for count in (150, 400)}
    sets["hatched discs"] = hatched_discs(30, rng)
    sets["cartoon"] = rings(60, rng) + crowded_curves(60, rng)
    return {name: shuffled(strokes, rng) for name, strokes in sets.items()}


def nearest_neighbour(strokes: Strokes) -> Strokes:
    """From home always to the nearest end of a stroke that is left."""
    ends = np.array([point for stroke in strokes for point in (stroke[0], stroke[-1])])
    here, result = np.array(HOME), []
    for _ in strokes:
        end = int(np.argmin(((ends - here) ** 2).sum(axis=1)))
        stroke = strokes[end // 2][:: -1 if end % 2 else 1]
        result.append(stroke)
        here, ends[end & ~1 : (end | 1) + 1] = stroke[-1], np.inf
    return result


def greedy(strokes: Strokes) -> Strokes:
    return in_order(strokes, greedy_tour(Ends(strokes, HOME, DEFAULT_COST)))


def with_vpype(python: Path, command: str, strokes: Strokes) -> tuple[Strokes, float]:
    """Ordered strokes, seconds."""
    found = ask(python, "vpype", pack(strokes), command)
    return unpack(found), float(found["seconds"])


def timed(order: Callable[[], Strokes]) -> tuple[Strokes, float]:
    start = time.process_time()
    return order(), time.process_time() - start


def measure(name: str, strokes: Strokes, options: Options) -> list[dict[str, float | str]]:
    """A row for each way to order one drawing."""
    ways: dict[str, tuple[Strokes, float]] = {
        "nearest neighbour": timed(lambda: nearest_neighbour(strokes)),
        "greedy edge": timed(lambda: greedy(strokes)),
    }
    for budget_s in options.budgets_s:
        ways[f"ours, {budget_s:g} s"] = timed(lambda budget_s=budget_s: order_strokes(strokes, budget_s=budget_s))
    if options.peers:
        for command in ("linesort", TWO_OPT):
            ways[command] = with_vpype(options.peers, command, strokes)
    rows = []
    for way, (ordered, seconds) in ways.items():
        row: dict[str, float | str] = {"drawing": name, "way": way, "seconds": seconds}
        row |= {"pen_up_mm": pen_up_mm(ordered), "pen_up_s": pen_up_s(ordered)}
        for other in ("nearest neighbour", "greedy edge", "linesort", TWO_OPT):
            if other in ways:
                row[f"over {other}"] = pen_up_mm(ordered) / pen_up_mm(ways[other][0])
        if TWO_OPT in ways:
            row["free"] = _free(ordered) / _free(ways[TWO_OPT][0])
        rows.append(row)
    return rows


def _free(ordered: Strokes) -> float:
    return pen_up_mm(ordered, tuple(ordered[0][0]))


def main() -> None:
    options = tyro.cli(Options, description=__doc__)
    rows = [row for name, strokes in drawings(options.many).items() for row in measure(name, strokes, options)]
    if options.json:
        print(json.dumps(rows, indent=2))
        return
    print(f"| {' | '.join(rows[0])} |\n{'|---' * len(rows[0])}|")
    for row in rows:
        print(f"| {' | '.join(cell if isinstance(cell, str) else f'{cell:.3f}' for cell in row.values())} |")


if __name__ == "__main__":
    main()
