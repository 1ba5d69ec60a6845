"""The time law of a drawing: how long it takes, how near the joints' limits, how long to compute.

    python tests/benchmarks/drawing_toolpath.py [--strokes 180] [--metres 3.7] [--json]

Random smooth curves with a few corners, thinned to 0.05 mm and joined end to nearest end, on every robot. The
yardstick for the strokes is a time-optimal law on the very same geometry: TOPP by the two-pass reachability of
Pham & Pham (2018), all strokes at once, with the pen's speed as a further limit. Targets of the specification: down
time at most 1.12 of that, hops at most 165 ms each at 4 mm lift, no sample above 1.05 of a joint's limit.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from itertools import combinations, pairwise

import cv2
import numpy as np

from app.drawing.toolpath import PenSettings, Toolpath, default_placement, plan_toolpath
from app.robots import ROBOTS, make_robot
from app.robots.limits import RateLimits, rate_limits
from app.robots.robot import Array

REPEATS = 3
GRID_S = 0.003
"""Time between two points of the path at which the yardstick keeps the limits."""


def drawing(strokes: int, metres: float, half_mm: float) -> list[Array]:
    rng = np.random.default_rng(0)
    lengths = rng.lognormal(0.0, 0.9, strokes)
    found = [curve(rng, 1e3 * metres * length / lengths.sum(), half_mm) for length in lengths]
    return nearest_first(found)


def curve(rng: np.random.Generator, length_mm: float, half_mm: float) -> Array:
    """A random walk of the curvature, radius 0.8 mm at least, with a corner every 15 mm or so."""
    count = max(2, round(length_mm / 0.1))
    bend = 0.02 * np.cumsum(rng.normal(size=count))
    heading = rng.uniform(0.0, math.tau) + np.cumsum(np.clip(bend, -1.2, 1.2)) * length_mm / count
    for _ in range(int(length_mm / 15.0)):
        heading[rng.integers(count) :] += rng.uniform(-2.0, 2.0)
    points = np.cumsum(np.column_stack([np.cos(heading), np.sin(heading)]), axis=0) * length_mm / count
    points = np.clip(points - points.mean(axis=0) + rng.uniform(-half_mm, half_mm, 2), -half_mm, half_mm)
    thinned = cv2.approxPolyDP(points.astype(np.float32)[:, None], 0.05, False)[:, 0].astype(float)
    return thinned if len(thinned) > 1 else np.repeat(thinned, 2, axis=0)


def nearest_first(strokes: list[Array]) -> list[Array]:
    left, ordered = strokes[1:], strokes[:1]
    while left:
        distances = [math.dist(stroke[0], ordered[-1][-1]) for stroke in left]
        ordered.append(left.pop(int(np.argmin(distances))))
    return ordered


def optimal_times(path: Toolpath, limits: RateLimits, speed_m_s: float) -> Array:
    """(k,) s, the least time for the path of each stroke, from rest to rest."""
    grids = [grid(path, number) for number in range(int(path.stroke.max()) + 1)]
    longest = max(len(s) for s, _ in grids)
    # shorter strokes are padded at their beginning, where they rest
    s = np.stack([np.concatenate([np.full(longest - len(s), s[0]), s]) for s, _ in grids])
    q = np.stack([np.concatenate([np.repeat(q[:1], longest - len(q), axis=0), q]) for _, q in grids])
    return topp(s, q, limits, speed_m_s)


def grid(path: Toolpath, number: int) -> tuple[Array, Array]:
    """Arc lengths (g,) and joints (g, n) of one stroke."""
    rows = np.flatnonzero(path.stroke == number)
    every = round(GRID_S / 1e-3)
    rows = np.unique(np.concatenate([rows[::every], rows[-1:]]))
    step = np.linalg.norm(np.diff(path.pose[rows, :2], axis=0), axis=1)
    moved = np.concatenate([[True], step > 1e-6])
    rows, step = rows[moved], step[moved[1:]]
    return np.concatenate([[0.0], np.cumsum(step)]), path.q[rows]


def topp(s: Array, q: Array, limits: RateLimits, speed_m_s: float) -> Array:
    """Backward: the largest squared speeds from which the end can be reached. Forward: the fastest within them."""
    step = np.diff(s, axis=1)
    first, second = derivatives(s, q)
    with np.errstate(divide="ignore"):
        top = np.minimum(speed_m_s, np.min(limits.speed / np.abs(first), axis=2)) ** 2
    top[:, -1] = 0.0
    for i in range(s.shape[1] - 2, -1, -1):
        rows = constraints(first[:, i], second[:, i], limits.acceleration, step[:, i], top[:, i + 1])
        top[:, i] = np.where(step[:, i] > 0.0, np.minimum(top[:, i], largest(*rows)), 0.0)
    speed = np.zeros_like(top)
    for i in range(s.shape[1] - 1):
        a, b, c = constraints(first[:, i], second[:, i], limits.acceleration, step[:, i], top[:, i + 1])
        room = np.where(a > 1e-12, (c - b * speed[:, i, None]) / np.maximum(a, 1e-12), np.inf).min(axis=1)
        gain = 2 * step[:, i] * np.where(step[:, i] > 0.0, room, 0.0)
        speed[:, i + 1] = np.where(step[:, i] > 0.0, np.clip(speed[:, i] + gain, 0.0, top[:, i + 1]), 0.0)
    root = np.sqrt(speed)
    return np.sum(2 * step / np.maximum(root[:, 1:] + root[:, :-1], 1e-9), axis=1)


def derivatives(s: Array, q: Array) -> tuple[Array, Array]:
    """dq/ds and d2q/ds2 (k, g, n) by three points each; 0 in the padding."""
    step = np.maximum(np.diff(s, axis=1), 1e-12)[..., None]
    slope = np.where(step > 1e-9, np.diff(q, axis=1) / step, 0.0)
    before, after = step[:, :-1], step[:, 1:]
    first, second = np.zeros_like(q), np.zeros_like(q)
    first[:, 1:-1] = (slope[:, :-1] * after + slope[:, 1:] * before) / (before + after)
    first[:, 0], first[:, -1] = slope[:, 0], slope[:, -1]
    second[:, 1:-1] = np.where(before > 1e-9, 2 * (slope[:, 1:] - slope[:, :-1]) / (before + after), 0.0)
    return first, second


def constraints(first: Array, second: Array, limit: Array, step: Array, following: Array) -> tuple[Array, Array, Array]:
    """a u + b x <= c for the acceleration u and the squared speed x: the joints, and 0 <= x + 2 step u <= following."""
    one = np.ones((len(step), 1))
    a = np.concatenate([first, -first, 2 * step[:, None], -2 * step[:, None]], axis=1)
    b = np.concatenate([second, -second, one, -one], axis=1)
    c = np.concatenate([np.tile(limit, (len(step), 2)), following[:, None], 0.0 * one], axis=1)
    return a, b, c


def largest(a: Array, b: Array, c: Array) -> Array:
    """(k,) largest x >= 0 with some u within the constraints: a linear programme by its corners."""
    best = np.zeros(len(a))
    for i, j in combinations(range(a.shape[1]), 2):
        det = a[:, i] * b[:, j] - a[:, j] * b[:, i]
        with np.errstate(divide="ignore", invalid="ignore"):
            u = (c[:, i] * b[:, j] - c[:, j] * b[:, i]) / det
            x = (a[:, i] * c[:, j] - a[:, j] * c[:, i]) / det
            inside = ((a * u[:, None] + b * x[:, None]) <= c + 1e-9 * (1 + np.abs(c))).all(axis=1)
        best = np.where(inside & (x > best), x, best)
    return best


def measure(name: str, strokes: int, metres: float) -> dict[str, float | str]:
    robot, pen = make_robot(name), PenSettings()
    placement = default_placement(robot)
    half_mm = 75.0 if name in ("par4", "delta3") else 45.0
    wanted = drawing(strokes, metres, half_mm)
    seconds = math.inf
    for _ in range(REPEATS):
        start = time.perf_counter()
        path = plan_toolpath(wanted, robot, placement, pen)
        seconds = min(seconds, time.perf_counter() - start)
    down = 1e-3 * np.count_nonzero(path.stroke >= 0)
    best = float(optimal_times(path, rate_limits(robot), 1e-3 * pen.speed_mm_s).sum())
    gaps = [math.dist(before[-1], after[0]) for before, after in pairwise(wanted)]
    return {
        "robot": name,
        "strokes": len(wanted),
        "points": sum(map(len, wanted)),
        "compute_s": seconds,
        "down_s": float(down),
        "down_over_optimal": float(down) / best,
        "hop_ms": 1e3 * (path.duration_s - float(down)) / (len(wanted) + 1),
        "median_gap_mm": float(np.median(gaps)),
        "joint_speed": path.max_joint_speed_ratio,
        "joint_acceleration": path.max_joint_acceleration_ratio,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--strokes", type=int, default=180)
    parser.add_argument("--metres", type=float, default=3.7)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    rows = [measure(name, options.strokes, options.metres) for name in ROBOTS]
    if options.json:
        print(json.dumps(rows, indent=2))
        return
    print("| robot | strokes, points | compute s | down s | down / optimal | hop ms (median gap mm) | speed | acc |")
    print("|---|---|---|---|---|---|---|---|")
    for row in rows:
        print(
            f"| {row['robot']} | {row['strokes']}, {row['points']} | {row['compute_s']:.3f} | {row['down_s']:.1f} | "
            f"{row['down_over_optimal']:.3f} | {row['hop_ms']:.0f} ({row['median_gap_mm']:.1f}) | "
            f"{row['joint_speed']:.2f} | {row['joint_acceleration']:.3f} |"
        )


if __name__ == "__main__":
    main()
