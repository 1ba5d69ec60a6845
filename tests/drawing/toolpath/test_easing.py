"""Loads are the joints' own; where one exceeds its limit, the plan slows down there and nowhere else."""

from __future__ import annotations

import numpy as np

from app.drawing.toolpath.easing import Ease, Loads, find_loads, slowed
from app.drawing.toolpath.filter import TAPS, counted, moving_average
from app.drawing.toolpath.timeline import Timeline
from app.robots.limits import RateLimits

LIMITS = RateLimits(np.array([2.0, 4.0]), np.array([50.0, 10.0]))


def test_loads_of_a_parabola_and_of_a_line():
    t = 1e-3 * np.arange(200.0)
    loads = find_loads(np.column_stack([0.5 * 25.0 * t**2, 3.0 * t]), LIMITS)
    assert np.allclose(loads.acceleration[1:-1], 0.5)
    assert np.allclose(loads.speed[:50], 0.75) and loads.speed[-1] > 2.4
    assert loads.acceleration[0] > 100.0  # the line starts with a jump of its speed


def test_a_sample_out_of_reach_makes_the_worst_load_none():
    q = np.zeros((5, 2))
    q[2, 0] = np.nan
    assert np.isnan(find_loads(q, LIMITS).worst)


def line_of_samples() -> tuple[Timeline, Ease]:
    """Hop 0, stroke 0 of five segments, hop 1, stroke 1 of two segments, hop 2; forty samples each."""
    block = np.repeat(np.arange(5), 40)
    segment = np.full(200, -1)
    segment[40:80], segment[120:160] = np.repeat(np.arange(5), 8), np.repeat(np.arange(5, 7), 20)
    return Timeline(np.zeros((200, 3)), block, segment), Ease(np.ones(7), np.ones(3))


def test_only_the_segments_around_are_slowed():
    timeline, ease = line_of_samples()
    acceleration = np.full(200, 0.9)
    acceleration[43] = 1.2
    after = slowed(ease, timeline, Loads(np.zeros(200), acceleration), whole_strokes=False)
    assert (after.segments[:2] < 1.0 / 1.2).all() and (after.segments[2:] == 1.0).all()
    assert (after.hops == 1.0).all()
    whole = slowed(ease, timeline, Loads(np.zeros(200), acceleration), whole_strokes=True)
    assert (whole.segments[:5] < 1.0 / 1.2).all() and (whole.segments[5:] == 1.0).all()


def test_only_the_hop_beyond_a_limit_is_slowed():
    timeline, ease = line_of_samples()
    speed = np.full(200, 0.9)
    speed[100] = 1.1
    after = slowed(ease, timeline, Loads(speed, np.zeros(200)), whole_strokes=False)
    assert after.hops[1] > 1.04 and after.hops[[0, 2]].tolist() == [1.0, 1.0]
    assert (after.segments == 1.0).all()


def test_a_segment_shorter_than_a_step_is_slowed_with_its_neighbours():
    timeline, ease = line_of_samples()
    timeline.segment[timeline.segment == 1] = 2  # no sample falls on segment 1
    acceleration = np.zeros(200)
    acceleration[50] = 2.0
    after = slowed(ease, timeline, Loads(np.zeros(200), acceleration), whole_strokes=False)
    assert after.segments[1] < 0.3


def test_the_moving_average_is_the_mean_of_its_neighbours():
    rows = np.random.default_rng(0).normal(size=(50, 2))
    expected = [rows[k : k + TAPS].mean(axis=0) for k in range(50 - TAPS + 1)]
    assert np.allclose(moving_average(rows), expected)
    assert counted(np.array([3, 0, 2])).tolist() == [0, 1, 2, 0, 1]
