"""The machine beside its twin and beside its plan, on motions whose delay and error are known by construction."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.typing import NDArray

from app.control import PID_AUTO, Motor
from app.link.errors import LinkError
from app.link.protocol.codes import DriveKind, Flag, State
from app.link.protocol.settings import setting_id
from app.link.twin.compare import compare
from app.link.twin.gains import gains_for_board
from app.link.twin.lag import lag_s
from app.link.twin.model import DcTwin, ServoTwin, StepperTwin, board_twin
from app.link.twin.planned import compare_with_plan
from app.link.twin.recording import Recording
from app.robots import make_robot

T = np.linspace(0.0, 9.98, 500)


def motion(t: NDArray[np.float64]) -> NDArray[np.float64]:
    """(k, 3) smooth, from rest."""
    rise = 1.0 - np.exp(-((t.clip(0.0) / 0.5) ** 3))
    waves = np.column_stack([np.sin(2.1 * t), np.sin(3.3 * t + 0.4), np.cos(1.3 * t)])
    return 0.4 + 0.15 * rise[:, None] * waves


def recording(position: NDArray[np.float64], setpoint: NDArray[np.float64], robot: str = "delta3") -> Recording:
    k = len(position)
    state, flags = np.full(k, State.MOVING), np.full(k, Flag.HOMED | Flag.POWERED)
    latency = np.linspace(0.002, 0.006, k)
    t = np.linspace(0.0, 0.02 * (k - 1), k)
    return Recording(robot, "", t, position, setpoint, 0.0 * position, state.astype(int), flags.astype(int), latency)


@pytest.mark.parametrize("delay_s", [-0.0371, 0.0, 0.0043, 0.0123, 0.0888, 0.31])
def test_a_delay_is_found_within_a_millisecond(delay_s):
    jittered = T + 0.002 * np.sin(7.0 * T)
    noise = np.random.default_rng(3).normal(0.0, 1e-3, (len(T), 3))
    late = motion(jittered - delay_s) + noise
    assert lag_s(jittered, motion(jittered), late) == pytest.approx(delay_s, abs=1e-3)
    assert lag_s(jittered, motion(jittered), 0.8 * late + 0.1) == pytest.approx(delay_s, abs=1e-3)


def test_nothing_is_said_about_a_delay_where_nothing_moves():
    still = np.full((len(T), 3), 0.4)
    assert np.isnan(lag_s(T, still, still))
    assert np.isnan(lag_s(T[:20], motion(T[:20]), motion(T[:20])))


def test_lag_error_and_tool_error_are_those_that_were_made():
    setpoint = motion(T)
    found = compare(recording(motion(T - 0.03) + [0.0, 0.01, 0.0], setpoint), StepperTwin())
    assert found.lag_s == pytest.approx(0.03, abs=1e-3)
    np.testing.assert_allclose(found.joint_lag_s, 0.03, atol=1e-3)
    error = motion(T - 0.03) + [0.0, 0.01, 0.0] - setpoint
    np.testing.assert_allclose(found.rms_error, np.sqrt((error**2).mean(axis=0)))
    np.testing.assert_allclose(found.largest_error, np.abs(error).max(axis=0))
    assert found.rms_error_in_step[0] < 0.1 * found.rms_error[0]
    assert found.rms_error_in_step[1] == pytest.approx(0.01, rel=0.05)
    robot = make_robot("delta3")
    away = np.linalg.norm(robot.forward(setpoint + error) - robot.forward(setpoint), axis=1)
    assert found.rms_tool_error_m == pytest.approx(np.sqrt((away**2).mean()))
    assert (found.latency.median_s, found.latency.largest_s) == pytest.approx((0.004, 0.006))
    assert "after its twin" in found.sentence and "30." in found.sentence


def test_only_the_powered_stretch_without_gaps_counts():
    whole = recording(motion(T), motion(T))
    flags, state, t = whole.flags.copy(), whole.state.copy(), whole.t.copy()
    flags[:50] = Flag.HOMED
    state[400:430] = State.TESTING
    t[300:] += 0.5
    found = compare(replace(whole, flags=flags, state=state, t=t), StepperTwin())
    assert (found.t[0], found.t[-1]) == (t[50], t[299])
    with pytest.raises(LinkError, match="not on for long enough"):
        compare(replace(whole, flags=0 * flags), StepperTwin())


def test_a_motor_under_pid_follows_as_its_differential_equation_says():
    """Without a limit in the way the error of a slow ramp tends to v / Kv, for a motor without droop and ki = 0."""
    motor, pid = Motor(K=1000.0, T1=20.0), replace(PID_AUTO, kp=0.2, ki=0.0, kd=0.0)
    t = np.linspace(0.0, 2.98, 150)
    ramp = np.column_stack([0.3 + 0.1 * t, 0.3 - 0.05 * t])
    joints = DcTwin(motor, (pid, pid), 0.001, 12.0).follow(t, ramp)
    expected = np.array([0.1, -0.05]) * motor.T1 / (motor.K * pid.kp)
    np.testing.assert_allclose((ramp - joints)[-1], expected, rtol=0.01)
    np.testing.assert_allclose(joints[0], ramp[0])


def test_a_motor_at_its_limit_does_not_wind_up():
    """At full voltage for long: with the integral held meanwhile, as on the board, there is hardly an overshoot."""
    t = np.linspace(0.0, 8.0, 401)
    jump = np.where(t > 0.0, 1.0, 0.0)[:, None] + [0.2]
    pid = replace(PID_AUTO, ki=3.0)
    joints = DcTwin(Motor(K=9.4, T1=3.6), (pid,), 0.001, 12.0).follow(t, jump)
    fastest = np.radians(9.4 * 12.0 / 3.6)
    assert np.diff(joints[:, 0]).max() / 0.02 == pytest.approx(fastest, rel=0.01)
    assert 1.19 < joints.max() < 1.25


def test_a_servo_is_limited_in_speed_and_late_by_its_time_constant():
    t = np.linspace(0.0, 1.995, 400)
    jump = np.where(t > 0.0, 1.0, 0.0)[:, None]
    assert np.diff(ServoTwin(0.03, 5.0).follow(t, jump)[:, 0]).max() == pytest.approx(0.025)
    ramp = 2.0 * t[:, None]
    assert (ramp - ServoTwin(0.03, 5.0).follow(t, ramp))[-1, 0] == pytest.approx(2.0 * 0.03, rel=0.15)


def test_a_boards_twin_has_the_boards_gains():
    settings = gains_for_board(PID_AUTO, "rad", range(4)) | {setting_id("supply"): 12.0, setting_id("duty_max"): 0.5}
    twin = board_twin("par4", DriveKind.DC, 1000, settings)
    assert isinstance(twin, DcTwin)
    assert (twin.u_max, twin.period_s, len(twin.pids)) == (6.0, 0.001, 4)
    assert twin.pids[3].kp == pytest.approx(PID_AUTO.kp)
    assert isinstance(board_twin("delta3", DriveKind.SERVO, 5000, {}), ServoTwin)
    with pytest.raises(LinkError, match="read"):
        board_twin("par4", DriveKind.DC, 1000, {})


@dataclass
class Plan:
    t: NDArray[np.float64]
    q: NDArray[np.float64]


def test_a_plan_is_found_in_time_and_its_path_in_space():
    robot = make_robot("delta3")
    t = np.linspace(0.0, 5.99, 600)
    # not closed, and curved: 0.4 turns of a circle of 60 mm
    turn = 0.8 * np.pi * (t / t[-1]) ** 2
    path = np.column_stack([0.06 * np.cos(turn), 0.06 * np.sin(turn), np.full(len(t), -0.33)])
    plan = Plan(t, robot.inverse(path))
    when = np.linspace(0.0, 7.98, 400)
    measured = np.column_stack([np.interp(when - 1.37, t, column) for column in path.T]) - [0.0, 0.0, 0.001]
    found = compare_with_plan(recording(robot.inverse(measured), plan.q[:400]), plan)
    assert found.start_s == pytest.approx(1.37, abs=0.02)
    assert found.rms_path_error_m == pytest.approx(0.001, rel=1e-3)
    assert found.largest_path_error_m == pytest.approx(0.001, rel=1e-2)
    with pytest.raises(LinkError, match="different robots"):
        compare_with_plan(recording(motion(T), motion(T)), Plan(t, np.zeros((600, 4))))
