"""Gains follow from bandwidth and damping, and the defaults are the spec's."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.control.laws import LAWS, Tuning, TuningError
from app.robots import ROBOTS


def test_the_spec_s_gains_of_the_linear_delta():
    kp, kd, ki = Tuning.default("linear", "PID").joint_gains()
    assert np.allclose(kp, 3000.0) and np.allclose(kd, 110.0) and np.allclose(ki, 30000.0)
    kp, kd, _ = Tuning.default("linear", "CTC").gains()
    assert np.allclose(kp, 3600.0) and np.allclose(kd, 120.0)


def test_the_spec_s_gains_of_the_five_bar():
    kp, kd, ki = Tuning.default("fivebar", "TSIIDC").gains()
    assert np.allclose(kp, [35531, 35531, 30951, 30951], atol=0.6)
    assert np.allclose(kd, [263.9, 263.9, 211.1, 211.1], atol=0.06)
    assert np.allclose(np.array(ki) / kp, 25.0)
    assert np.allclose(np.array(ki) * Tuning.default("fivebar", "TSIIDC").sum_limits(ki), [20.0, 20.0, 10.0, 300.0])
    kp, _, _ = Tuning.default("fivebar", "PD").joint_gains()
    assert np.allclose(kp, np.array([0.614, 0.608, 0.03664, 0.03665]) * [35531, 35531, 30951, 30951], rtol=1e-4)


@pytest.mark.parametrize("law", ["PID", "CTC"])
def test_gains_come_back_as_they_were_given(law: str):
    tuning = Tuning.from_gains("linear", law, (600.0,) * 3, (50.0,) * 3, 2500.0)
    gains = tuning.joint_gains() if law == "PID" else tuning.gains()
    assert [values[0] for values in gains] == pytest.approx([600.0, 50.0, 2500.0])


@pytest.mark.parametrize("robot", ROBOTS)
def test_equal_bandwidth_is_equal_for_all_laws_and_axes(robot: str):
    for law in LAWS:
        kp, _, _ = Tuning.equal(robot, law, 12.0).gains()
        assert np.allclose(kp, (math.tau * 12.0) ** 2)


def test_what_makes_no_sense_is_refused():
    with pytest.raises(TuningError, match="above 0"):
        Tuning.equal("linear", "PD", 0.0)
    with pytest.raises(TuningError, match="too fast"):
        Tuning.equal("linear", "PD", 1e5)
    with pytest.raises(TuningError, match="steps ahead"):
        Tuning.default("linear", "MPC").changed(horizon=1)
    with pytest.raises(TuningError, match="kp and kd"):
        Tuning.from_gains("linear", "PD", (1.0, 1.0, -1.0), (1.0,) * 3)
