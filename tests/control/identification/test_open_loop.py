"""The open-loop simulation against golden samples, and from any initial state."""

from __future__ import annotations

import numpy as np

from app.control.identification.open_loop import open_loop
from app.control.motor import PAR4_MOTOR, Motor
from tests.robots.golden import golden

PERIOD_S = 0.01


def test_the_simulation_is_exact():
    values, times = golden("motor_ident")["y_first"]
    u = np.where(np.sin(2 * np.pi * np.arange(2000) * PERIOD_S / 8.0) > -1e-9, 12.0, -12.0)
    y = open_loop(PAR4_MOTOR, u, PERIOD_S)
    assert np.allclose(y[np.round(np.array(times) / PERIOD_S).astype(int)], values, rtol=1e-10, atol=1e-12)


def test_the_simulation_starts_from_any_state():
    """At rest against the droop, and moving: a run cut in two is the same run."""
    rest = 2.0 * PAR4_MOTOR.dc_gain
    assert np.allclose(open_loop(PAR4_MOTOR, np.full(50, 2.0), PERIOD_S, y0=rest), rest)
    motor, u = Motor(9.0, 3.0), np.ones(400)
    whole, cut = open_loop(motor, u, PERIOD_S), 150
    v = 3.0 * (1.0 - np.exp(-3.0 * cut * PERIOD_S))
    assert np.allclose(open_loop(motor, u[cut:], PERIOD_S, whole[cut], v), whole[cut:], atol=1e-9)
