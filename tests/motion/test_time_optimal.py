"""The time-optimal law against closed forms and against a linear program that knows nothing of it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linprog

from app.motion.demands import Demands
from app.motion.time_optimal import time_optimal


def duration(demands: Demands, points: int = 801) -> float:
    """s of the fastest course: its law, brought to one unit of time, must take so long that all demands hold."""
    s = np.linspace(0.0, 1.0, points)
    law = time_optimal(demands, s)
    u = np.concatenate([law.knots[:-1] + 1e-9, law.knots[1:] - 1e-9])
    value, rate, acceleration = law.at(u)
    linear, square, constant = (
        np.stack([np.interp(value, s, column) for column in part.T], axis=1) for part in demands[:3]
    )
    here = Demands(linear, square, constant, demands.limit)
    return float(here.least_durations(rate, acceleration).max())


def one_joint(speed: float, acceleration: float, points: int = 801) -> Demands:
    """A joint that moves by 1 rad, a frictionless mass without gravity."""
    one, zero = np.ones(points), np.zeros(points)
    linear, square = np.stack([zero, one, zero], 1), np.stack([one, zero, zero], 1)
    return Demands(linear, square, np.zeros((points, 3)), np.array([speed**2, acceleration, 1.0]))


def test_full_throttle_then_full_brake():
    assert duration(one_joint(speed=1e3, acceleration=4.0)) == pytest.approx(2.0 * np.sqrt(1.0 / 4.0), rel=2e-3)


def test_with_a_speed_limit_it_is_the_trapezoid():
    assert duration(one_joint(speed=0.5, acceleration=4.0)) == pytest.approx(1.0 / 0.5 + 0.5 / 4.0, rel=2e-3)


def test_gravity_helps_one_way_only():
    """Up against 3 of 8: accelerates with 5, brakes with 11; t = sqrt(2 d (a + b) / (a b))."""
    one, zero = np.ones(801), np.zeros(801)
    lift = Demands(one[:, None], zero[:, None], 3.0 * one[:, None], np.array([8.0]))
    assert duration(lift) == pytest.approx(np.sqrt(2.0 * 16.0 / 55.0), rel=2e-3)


def test_it_is_the_solution_of_a_linear_program():
    """The greatest x = s'^2 at all points at once, under the same demands at both ends of each stretch."""
    points = 61
    s, h = np.linspace(0.0, 1.0, points), 1.0 / (points - 1)
    turns = np.stack([6.0 * s + i for i in range(3)], axis=1)
    first, second = np.cos(turns), -6.0 * np.sin(turns)
    demands = Demands(
        np.hstack([0.0 * first, first, 0.7 * first + 0.2]),
        np.hstack([first**2, second, 1.2 * second]),
        np.hstack([0.0 * first, 0.0 * first, 0.4 * np.sin(turns)]),
        np.array([1.0] * 3 + [10.0] * 3 + [8.0] * 3),
    )
    u = (np.eye(points, k=1) - np.eye(points))[:-1] / (2.0 * h)
    rows, bounds = [], []
    for at in (slice(None, -1), slice(1, None)):
        for column, limit in enumerate(demands.limit):
            row = demands.linear[at, column, None] * u + demands.square[at, column, None] * np.eye(points)[at]
            rows += [row, -row]
            bounds += [limit - demands.constant[at, column], limit + demands.constant[at, column]]
    ends = [(0.0, 0.0)] + [(0.0, None)] * (points - 2) + [(0.0, 0.0)]
    best = linprog(-np.ones(points), np.vstack(rows), np.concatenate(bounds), bounds=ends)
    assert best.success

    law = time_optimal(demands, s)
    speed = law.at(law.knots)[1]
    x = (speed / law.knots[1:].max()) ** 2
    scale = best.x[points // 2] / x[points // 2]
    assert np.allclose(x * scale, best.x, rtol=1e-6, atol=1e-6 * best.x.max())
