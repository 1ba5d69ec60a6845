"""The board's PID against the control lab's program, sample by sample; and that the built-in gains suit the motors."""

from __future__ import annotations

import ctypes
import math

import numpy as np
import pytest

from app.control import PID_APPROX, PID_AUTO, Pid
from app.control.drives import DRIVES
from app.control.sampled_pid import Sampling, sampled_pid
from app.link.emulated.compiled import load_library
from app.link.firmware.generate import GAINS
from tests.support.tools import needs

PIDS = [PID_AUTO, PID_APPROX, Pid(2.0), Pid(2.0, 30.0), Pid(1.0, 5.0, 0.3, 200.0), Pid(0.0, 1.0)]


@needs("gcc")
@pytest.mark.parametrize("pid", PIDS)
@pytest.mark.parametrize("period_s", [0.001, 0.005])
def test_every_sample_is_that_of_the_control_lab(pid, period_s):
    """Errors large enough to be limited, of both signs, so that the integral is held and let go."""
    random = np.random.default_rng(3)
    errors = np.repeat(random.normal(0.0, 9.0, 40), 25) + random.normal(0.0, 0.05, 1000)
    law = sampled_pid(pid, Sampling(period_s, "backward Euler", "clamping"), 12.0)
    wanted = [law(error, 0.0) for error in errors.tolist()]
    gains = (ctypes.c_float * 4)(pid.kp, pid.ki, pid.kd, pid.n if math.isfinite(pid.n) else 0.0)
    memory = (ctypes.c_float * 3)()
    found = [load_library().dl_pid_step(memory, gains, period_s, error, 12.0) for error in errors.tolist()]
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=5e-3)
    assert (12.0 in found and -12.0 in found) or not pid.kp


@pytest.mark.parametrize(
    ("robot", "period_s"), [("par4", 1e-3), ("delta3", 5e-3), ("linear", 5e-3), ("linear", 1e-3), ("fivebar", 1e-3)]
)
def test_built_in_gains_leave_a_margin(robot, period_s):
    """At the frequency where the sampled loop's gain is 1; motor and controller in z."""
    drive, pid = DRIVES[robot], GAINS[robot]
    unit = 1e-3 if drive.unit == "mm" else math.pi / 180
    frequency = np.logspace(-2, math.log10(3.0 / period_s), 20_000)
    z = np.exp(1j * frequency * period_s)
    numerator, denominator = drive.motor.zoh(period_s).polynomials
    difference = (1 - 1 / z) / period_s
    controller = pid.kp + pid.ki / difference + pid.kd * pid.n * difference / (difference + pid.n)
    loop = controller * unit * np.polyval(numerator, z) / np.polyval(denominator, z)
    crossings = np.flatnonzero(np.diff(np.sign(np.abs(loop) - 1.0)))
    assert len(crossings) == 1
    assert 180.0 + np.degrees(np.angle(loop[crossings[0]])) > 50.0
    assert np.max(np.abs(1.0 / (1.0 + loop))) < 1.5
