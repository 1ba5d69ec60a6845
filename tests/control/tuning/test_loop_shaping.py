"""The tuner: Table 2, exact crossover and margin over random motors, and honest notes where they cannot be had."""

from __future__ import annotations

import cmath
import math
import time

import control
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from app.control.motor import PAR4_MOTOR, Motor
from app.control.pid import PID_APPROX, PID_AUTO, Pid
from app.control.tuning.loop_shaping import LoopDesign, tune, tune_loop
from app.control.tuning.phase_margin import smallest_margin
from app.control.tuning.reaction_curve import TuningError
from tests.robots.golden import golden

GOLDEN = golden("motor_steps")

decades = st.floats(-1.0, 1.0).map(lambda exponent: 10.0**exponent)
motors = st.builds(
    Motor,
    K=st.floats(-2.0, 4.0).map(lambda exponent: 10.0**exponent),
    T1=decades.map(lambda factor: 4.0 * factor),
    T2=st.one_of(st.just(0.0), decades.map(lambda factor: 0.5 * factor), decades.map(lambda factor: 30.0 * factor)),
)
bandwidths = decades.map(lambda factor: 5.0 * factor)
margins = st.floats(0.0, 90.0)
delays = st.one_of(st.just(0.0), st.floats(0.001, 0.2))


def loop_at(w: np.ndarray, pid: Pid, motor: Motor, delay_s: float) -> np.ndarray:
    """C G e^(-s delay) by python-control, apart from the code under test."""
    s = 1j * w
    return (pid.transfer_function() * motor.transfer_function())(s) * np.exp(-s * delay_s)


def encirclements(pid: Pid, motor: Motor, delay_s: float, w_scale: float) -> float:
    """How often the Nyquist curve of a loop stable in open loop, but for s = 0, goes round -1; 0 means stable.

    Poles at s = 0 are passed on a small half circle on their right, which is why the curve is closed by symmetry
    of the change of angle of 1 + L over positive frequencies, minus what the m poles at 0 put in.
    """
    w = np.geomspace(1e-6 * w_scale, 1e4 * w_scale, 15_000)
    angle = np.unwrap(np.angle(1.0 + loop_at(w, pid, motor, delay_s)))
    poles_at_zero = 1 + (motor.T2 == 0.0)
    return (angle[-1] - angle[0]) / math.pi - poles_at_zero / 2.0


def test_table_2_to_all_printed_digits():
    """At the crossover and the margin that Table 2's controller has."""
    pid = tune_loop(PAR4_MOTOR, GOLDEN["auto_N37.2929"]["w_cross"], 73.0).pid
    printed = [f"{pid.kp:.5f}", f"{pid.ki:.5f}", f"{pid.kd:.5f}", f"{pid.n:.4f}"]
    assert printed == ["4.36210", "0.38231", "0.99919", "37.2929"]


def test_sliders_are_those_of_pid_tuner():
    by_sliders, by_numbers = tune(PAR4_MOTOR, 0.2, 0.5, 0.01), tune_loop(PAR4_MOTOR, 10.0, 45.0, 0.01)
    assert by_sliders == by_numbers
    assert tune(PAR4_MOTOR, 0.2).phase_margin_deg == pytest.approx(60.0)


@pytest.mark.parametrize(
    ("pid", "name"), [(PID_AUTO, "auto_N37.2929"), (PID_APPROX, "approx_ideal")], ids=["filtered", "ideal"]
)
def test_smallest_margin_of_the_papers_controllers(pid, name):
    """PID_APPROX has rounded gains, the golden one has not."""
    w, margin = smallest_margin(pid, PAR4_MOTOR)
    assert w == pytest.approx(GOLDEN[name]["w_cross"], rel=1e-4)
    assert margin == pytest.approx(GOLDEN[name]["phase_margin_deg"], abs=2e-3)


def test_smallest_margin_without_an_integral():
    pid = Pid(2.0, kd=0.3, n=50.0)
    w, margin = smallest_margin(pid, PAR4_MOTOR)
    loop = pid.transfer_function() * PAR4_MOTOR.transfer_function()
    _, expected, _, _, crossover, _ = control.stability_margins(loop)
    assert [w, margin] == pytest.approx([crossover, expected], rel=1e-6)


def test_an_unstable_loop_has_no_margin():
    assert smallest_margin(Pid(1.0, ki=100.0), PAR4_MOTOR)[1] == -math.inf
    assert smallest_margin(PID_AUTO, PAR4_MOTOR, delay_s=0.2)[1] < 0.0


@given(motors, bandwidths, margins)
def test_python_control_finds_what_was_placed(motor, bandwidth, asked):
    design = tune_loop(motor, bandwidth, asked)
    loop = design.pid.transfer_function() * motor.transfer_function()
    assert np.real(control.poles(control.feedback(loop, 1))).max() < 0.0
    _, margin, _, _, crossover, _ = control.stability_margins(loop)
    assert design.phase_margin_deg == pytest.approx(margin, abs=1e-3)
    assert design.crossover_rad_s == pytest.approx(crossover, rel=1e-4)


@given(motors, bandwidths, margins, delays)
def test_as_asked_or_the_note_says_why_not(motor, bandwidth, asked, delay_s):
    design = tune_loop(motor, bandwidth, asked, delay_s)
    pid = design.pid
    assert min(pid.kp, pid.ki, pid.kd) >= 0.0
    as_asked = (
        abs(design.crossover_rad_s / bandwidth - 1.0) < 1e-6
        and abs(design.phase_margin_deg - asked) < 0.02
        and abs(abs(loop_at(np.array(bandwidth), pid, motor, delay_s)) - 1.0) < 1e-9
    )
    if not as_asked:
        assert any(reason in design.note for reason in ("least", "most", "slowed", "integral only", "several"))
    elif design.note:
        assert pid.kd == 0.0 or "least" in design.note


@given(motors.filter(lambda motor: motor.T1**2 > 4.0 * motor.T2), bandwidths, st.floats(10.0, 90.0))
def test_motors_that_do_not_swing_get_what_is_asked_within_reach(motor, bandwidth, asked):
    """The controller of the default ratios can turn the phase from -90 (integral only) to +64.7 degrees."""
    plant = motor.K / complex(motor.T2 - bandwidth**2, motor.T1 * bandwidth)
    assume(-90.0 < asked - 180.0 - math.degrees(cmath.phase(plant)) < 64.6)
    design = tune_loop(motor, bandwidth, asked)
    assert design.crossover_rad_s == pytest.approx(bandwidth, rel=1e-9)
    assert design.phase_margin_deg == pytest.approx(asked, abs=1e-6)
    assert design.note.startswith("No derivative") if design.pid.kd == 0.0 else design.note == ""


@given(motors, bandwidths, margins, delays)
def test_the_nyquist_curve_with_the_exact_delay_does_not_go_round_minus_one(motor, bandwidth, asked, delay_s):
    design = tune_loop(motor, bandwidth, asked, delay_s)
    assert encirclements(design.pid, motor, delay_s, bandwidth) == pytest.approx(0.0, abs=0.1)


def test_the_nyquist_count_notices_an_unstable_loop():
    assert abs(encirclements(PID_AUTO, PAR4_MOTOR, 0.0, 10.0)) < 0.1
    assert abs(encirclements(PID_AUTO, PAR4_MOTOR, 0.2, 10.0)) > 0.9
    assert abs(encirclements(Pid(1.0, ki=100.0), PAR4_MOTOR, 0.0, 10.0)) > 0.9


def parts(design: LoopDesign) -> str:
    pid = design.pid
    return "".join(letter for letter, gain in zip("PID", (pid.kp, pid.ki, pid.kd), strict=True) if gain)


@pytest.mark.parametrize(
    ("bandwidth", "margin", "delay_s", "expected", "note"),
    [
        (10.0, 60.0, 0.0, "PID", ""),
        (10.0, 60.0, 0.02, "PID", ""),
        (1.0, 60.0, 0.0, "PI", "No derivative"),
        (0.02, 60.0, 0.0, "I", "integral only"),
        (10.0, 90.0, 0.0, "PID", "84° is the most"),
        (10.0, 3.0, 0.0, "PI", "least"),
        (100.0, 60.0, 0.1, "PID", "slowed down to 8.59"),
    ],
)
def test_notes(bandwidth, margin, delay_s, expected, note):
    design = tune_loop(PAR4_MOTOR, bandwidth, margin, delay_s)
    assert parts(design) == expected
    assert note in design.note if note else design.note == ""


def test_ideal_derivative_and_faster_integral_on_request():
    design = tune_loop(PAR4_MOTOR, 10.0, 85.0, filter_ratio=math.inf)
    assert math.isinf(design.pid.n) and design.phase_margin_deg == pytest.approx(85.0)
    quick = tune_loop(PAR4_MOTOR, 10.0, 60.0, integral_ratio=0.1)
    assert quick.pid.ki == pytest.approx(0.1 * quick.pid.kp * 10.0)
    assert quick.phase_margin_deg == pytest.approx(60.0)


@pytest.mark.parametrize(
    "values",
    [
        {"bandwidth_rad_s": 0.0},
        {"bandwidth_rad_s": math.nan},
        {"phase_margin_deg": 91.0},
        {"delay_s": -1.0},
        {"integral_ratio": 0.0},
        {"filter_ratio": 1.0},
    ],
)
def test_values_out_of_range_are_refused(values):
    with pytest.raises(ValueError, match="must be above zero"):
        tune_loop(PAR4_MOTOR, **{"bandwidth_rad_s": 10.0, **values})


def test_response_time_must_be_positive():
    with pytest.raises(ValueError, match="response time"):
        tune(PAR4_MOTOR, 0.0)


def test_a_motor_that_no_pid_holds():
    with pytest.raises(TuningError, match="K, T1 and T2"):
        tune_loop(Motor(-1.0, 3.0, 1.0), 10.0)


def test_a_call_takes_less_than_two_milliseconds():
    def seconds(bandwidth: float) -> float:
        start = time.perf_counter()
        tune_loop(PAR4_MOTOR, bandwidth, 60.0, 0.01)
        return time.perf_counter() - start

    for bandwidth in (1.0, 10.0, 100.0, 1000.0):
        assert min(seconds(bandwidth) for _ in range(5)) < 2e-3
