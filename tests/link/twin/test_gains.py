"""Gains between the control lab and a board, and the refusal of those under which a joint would swing."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.control import PID_AUTO, Motor, Pid
from app.control.drives import DRIVES
from app.link.errors import LinkError
from app.link.protocol.settings import setting_id
from app.link.twin.gains import UnsafeGains, check_gains, gains_for_board, gains_from_board

gain = st.floats(1e-3, 1e3)


def test_a_volt_per_degree_is_57_volts_per_radian():
    settings = gains_for_board(Pid(1.0, 2.0, 3.0, 40.0), "rad", [1])
    assert settings == {10: 180.0 / math.pi, 11: 360.0 / math.pi, 12: 540.0 / math.pi, 13: 40.0}
    assert gains_for_board(Pid(1.0, 2.0), "m", [0]) == {0: 1000.0, 1: 2000.0, 2: 0.0, 3: 0.0}


@given(gain, st.just(0.0) | gain, st.just(0.0) | gain, st.just(math.inf) | gain, st.integers(0, 3))
def test_gains_come_back(kp, ki, kd, n, joint):
    back = gains_from_board(gains_for_board(Pid(kp, ki, kd, n), "rad", range(4)), joint, "rad")
    assert (back.kp, back.ki, back.kd) == pytest.approx((kp, ki, kd))
    if kd:
        assert back.n == n


def test_what_the_board_cannot_do_is_refused():
    with pytest.raises(LinkError, match="set b and c to 1"):
        gains_for_board(Pid(1.0, c=0.0), "rad", [0])
    with pytest.raises(LinkError, match="finite"):
        gains_for_board(Pid(math.nan), "rad", [0])
    with pytest.raises(LinkError, match="joint 3 are not known"):
        gains_from_board({setting_id("kp", 0): 1.0}, 2, "rad")


def swing(motor: Motor, kp: float, ki: float, kd: float, n: float, period_s: float) -> float:
    """Size of the last tenth of 3000 periods after a step of 1, by a loop written out by hand."""
    steps = 20
    y = v = integral = derivative = last = 0.0
    h, tail = period_s / steps, []
    for k in range(3000):
        error = 1.0 - y
        integral += ki * period_s * error
        derivative = (derivative + kd * n * (error - last)) / (1.0 + n * period_s)
        last, u = error, kp * error + integral + derivative
        for _ in range(steps):
            v += h * (motor.K * u - motor.T1 * v - motor.T2 * y)
            y += h * v
        if not abs(y) < 1e6:
            return math.inf
        if k >= 2700:
            tail.append(abs(y - 1.0))
    return max(tail)


def passes(pid: Pid, motor: Motor, period_s: float) -> bool:
    try:
        check_gains(pid, motor, period_s)
    except UnsafeGains:
        return False
    return True


@pytest.mark.parametrize("factor", [1.0, 3.0, 30.0, 100.0])
@pytest.mark.parametrize("robot", ["par4", "delta3"])
def test_gains_that_make_a_joint_run_away_are_refused(robot, factor):
    drive = DRIVES[robot]
    kp, ki, kd, n = np.array([4.4, 0.4, 1.0, 37.0]) * ([1, 1, 1, 1] if robot == "par4" else [0.02, 0.05, 0.001, 5])
    kp *= factor
    calm = swing(drive.motor, kp, ki, kd, n, drive.period_s) < 0.2
    if passes(Pid(kp, ki, kd, n), drive.motor, drive.period_s):
        assert calm
    else:
        assert factor > 1.0
    assert calm or factor > 1.0


def test_an_unstable_loop_is_named_with_its_pole_and_period():
    with pytest.raises(UnsafeGains, match=r"at the board's period of 10 ms: a closed-loop pole lies at \+"):
        check_gains(Pid(200.0), DRIVES["par4"].motor, 0.01)
    assert swing(DRIVES["par4"].motor, 200.0, 0.0, 0.0, 1.0, 0.01) > 1.0


@pytest.mark.parametrize("pid", [Pid(-1.0), Pid(0.0, 1.0), Pid(1.0, -1.0), Pid(1.0, 0.0, -1.0)])
def test_gains_of_the_wrong_sign_are_refused(pid):
    with pytest.raises(UnsafeGains, match="away from its set-point"):
        check_gains(pid, DRIVES["par4"].motor, 0.01)


@pytest.mark.parametrize("period_s", [0.001, 0.005, 0.01])
def test_the_papers_gains_pass_and_their_margins_are_told(period_s):
    checked = check_gains(PID_AUTO, DRIVES["par4"].motor, period_s)
    assert checked.margins.stable and "phase margin" in checked.sentence


@given(st.floats(0.01, 1e4), st.just(0.0) | st.floats(0.01, 100.0), st.just(0.0) | st.floats(1e-3, 10.0))
def test_what_passes_has_its_poles_inside_the_unit_circle(kp, ki, kd):
    """A motor without droop under P or PI alone, whose polynomial is written out by hand."""
    motor, h = DRIVES["delta3"].motor, 0.005
    e = math.exp(-motor.T1 * h)
    b1 = motor.K / motor.T1 * (h - (1 - e) / motor.T1)
    b0 = motor.K / motor.T1 * ((1 - e) / motor.T1 - e * h)
    plant_over, plant_under = np.array([b1, b0]), np.array([1.0, -(1.0 + e), e])
    # kp + ki h z / (z - 1) + (kd / h) (z - 1) / z, all over z (z - 1)
    law_over = np.array([kp + ki * h + kd / h, -kp - 2 * kd / h, kd / h])
    poles = np.roots(np.polyadd(np.convolve(plant_under, [1.0, -1.0, 0.0]), np.convolve(plant_over, law_over)))
    inside = np.abs(poles).max() < 1.0 + (1e-7 if not ki else 0.0)
    assert inside or not passes(Pid(kp, ki, kd), motor, h)
