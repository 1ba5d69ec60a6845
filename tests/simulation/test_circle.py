"""The circle of the Par4 paper: its Table 4, digit for digit, and what the table hides."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from app.control import PAR4_MOTOR, PID_APPROX, PID_AUTO, Pid
from app.robots import make_robot
from app.simulation import Run, Task, TrackingError, circle_tracking, follow_simulink
from tests.robots.golden import golden
from tests.support.oracles import control
from tests.support.plain_loops import numpy_ode3, numpy_sampled

CONTROLLERS = {"auto": PID_AUTO, "approx": PID_APPROX}
APPROX_FILTERED = replace(PID_APPROX, n=100.0)
APPROX_AS_AUTO = replace(PID_APPROX, n=37.2929)
TABLE_4 = {"auto": [91.45, 124.0, 126.0, 88.85], "approx": [234.8, 305.4, 307.9, 231.7]}


@cache
def table4() -> dict[str, Any]:
    return golden("table4")


@cache
def paper(controller: str) -> Run:
    return circle_tracking(controller)  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_table_4_comes_out_as_printed(controller: str):
    assert np.allclose(paper(controller).ise, TABLE_4[controller], atol=0.05, rtol=0)
    assert table4()["paper"][controller] == TABLE_4[controller]


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_table_4_agrees_with_the_independent_computation(controller: str):
    assert np.allclose(paper(controller).ise, table4()["computed"][controller]["ISE"], atol=1e-6, rtol=0)


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_the_run_passes_through_the_golden_samples(controller: str):
    run, samples = paper(controller), table4()["computed"][controller]["samples"]
    assert len(samples) > 10
    for sample in samples:
        k = round(sample["t"] / 0.01)
        assert run.t[k] == pytest.approx(sample["t"], abs=1e-9)
        assert np.allclose(np.degrees(run.q_ref[k]), sample["ref_deg"], atol=1e-9, rtol=0)
        assert np.allclose(np.degrees(run.q[k]), sample["y_deg"], atol=1e-9, rtol=0)
        assert np.allclose(run.u[k], sample["u"], atol=1e-8, rtol=0)


@pytest.mark.parametrize("controller", [PID_APPROX, APPROX_FILTERED], ids=["ideal derivative", "filtered"])
def test_paper_mode_is_a_plain_ode3_loop(controller: Pid):
    robot, home = make_robot("par4"), make_robot("par4").home

    def reference(t: float) -> np.ndarray:
        angle = 2 * math.pi * t / 100.0
        return np.degrees(robot.inverse(home + [0.1 * math.cos(angle), 0.1 * math.sin(angle), 0.0, 0.0]))

    run = circle_tracking(controller, u_max=24.0, duration_s=3.0)
    y, u, ise = numpy_ode3(PAR4_MOTOR, controller, 24.0, 0.01, reference, 300)
    assert np.allclose(np.degrees(run.q), y, atol=1e-9, rtol=0)
    assert np.allclose(run.u, u, atol=1e-8, rtol=0)
    assert np.allclose(run.ise, ise, rtol=1e-10)


@pytest.mark.parametrize(
    ("controller", "u_max", "printed"),
    [
        ("auto", 12.0, [265.9, 342.7, 374.2, 233.6]),
        ("auto", 24.0, [170.7, 227.6, 238.3, 159.2]),
        ("approx", 12.0, [944, 1411, 1452, 900]),
        ("approx", 24.0, [429, 620, 639, 407]),
    ],
)
def test_a_smaller_supply_costs_what_the_specification_says(controller: Any, u_max: float, printed: list[float]):
    digit = 0.05 if controller == "auto" else 0.5
    run = circle_tracking(controller, u_max=u_max)
    assert np.allclose(run.ise, printed, atol=digit * 1.1, rtol=0)
    assert np.abs(run.u).max() == u_max == run.u_max


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_clockwise_swaps_the_drives_in_pairs(controller: Any):
    swapped = circle_tracking(controller, clockwise=True).ise
    assert np.allclose(swapped, paper(controller).ise[[3, 2, 1, 0]], rtol=1e-9)
    assert not np.allclose(swapped, paper(controller).ise, rtol=1e-3)


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_a_ten_times_finer_step_gives_the_golden_limit(controller: str):
    run = follow_simulink(Task(), CONTROLLERS[controller], 100.0, step_s=0.001)
    assert np.allclose(run.ise, table4()["h_0_001"][controller], atol=1e-6, rtol=0)


@pytest.mark.parametrize(
    ("key", "controller", "u_max"),
    [
        ("U12 approx_N100", APPROX_FILTERED, 12.0),
        ("U24 approx_N100", APPROX_FILTERED, 24.0),
        ("U100 auto", PID_AUTO, 100.0),
        ("U100 approx_N100", "approx", 100.0),
        ("U100 approx_N37.2929", APPROX_AS_AUTO, 100.0),
        ("U1e+09 approx_N100", APPROX_FILTERED, 1e9),
    ],
)
def test_sampled_controllers_give_the_golden_indices(key: str, controller: Any, u_max: float):
    run = circle_tracking(controller, "sampled", u_max)
    assert np.allclose(run.ise, table4()["discrete_controller_variant"]["ISE"][key], atol=1e-6, rtol=0)


@pytest.mark.parametrize("controller", [PID_AUTO, APPROX_FILTERED, PID_APPROX], ids=["auto", "approx", "ideal"])
def test_sampled_mode_is_a_plain_numpy_loop(controller: Pid):
    run = circle_tracking(controller, "sampled", 12.0, lap_s=20.0, duration_s=5.0)
    y, u, ise = numpy_sampled(PAR4_MOTOR, controller, 12.0, 0.01, np.degrees(run.q_ref))
    assert np.allclose(np.degrees(run.q), y, atol=1e-9, rtol=0)
    assert np.allclose(run.u, u, atol=1e-7, rtol=0)
    assert np.allclose(run.ise, ise, rtol=1e-10)


@pytest.mark.parametrize("controller", [PID_AUTO, APPROX_FILTERED], ids=["auto", "approx"])
def test_without_a_limit_the_sampled_run_is_the_linear_closed_loop(controller: Pid):
    """y and u from python-control, the loop closed by its algebra of transfer functions in state space."""
    h = 0.01
    run = circle_tracking(controller, "sampled", math.inf, lap_s=20.0, duration_s=20.0)
    integral = control.tf([controller.ki * h, 0.0], [1.0, -1.0], h)
    gain = controller.n * h
    derivative = controller.kd * controller.n * control.tf([1.0, -1.0], [1.0 + gain, -1.0], h)
    pid = control.ss(control.tf(controller.kp, 1, h) + integral + derivative)
    plant = control.ss(control.sample_system(PAR4_MOTOR.transfer_function(), h))
    closed, from_reference_to_u = control.feedback(plant * pid, 1), control.feedback(pid, plant)
    for joint, reference in enumerate(np.degrees(run.q_ref).T):
        y = control.forced_response(closed, run.t, reference).outputs
        u = control.forced_response(from_reference_to_u, run.t, reference).outputs
        assert np.allclose(np.degrees(run.q[:, joint]), y, atol=1e-9, rtol=0)
        assert np.allclose(run.u[:, joint], u, atol=1e-7, rtol=0)


@pytest.mark.parametrize(
    ("start", "auto", "approx"),
    [
        ("reference", [1.14, 0.81, 1.12, 0.82], [0.098, 0.015, 0.070, 0.029]),
        ("smooth", [2.01, 2.59, 2.38, 2.23], [0.339, 0.349, 0.391, 0.287]),
    ],
)
@pytest.mark.parametrize("u_max", [12.0, 100.0])
def test_without_the_first_step_the_ranking_reverses(start: Any, auto: list[float], approx: list[float], u_max: float):
    of_auto = circle_tracking("auto", "sampled", u_max, start=start)
    of_approx = circle_tracking("approx", "sampled", u_max, start=start)
    assert np.allclose(of_auto.ise, auto, atol=0.0051, rtol=0)
    assert np.allclose(of_approx.ise, approx, atol=0.00051, rtol=0)
    assert of_auto.saturation_share == of_approx.saturation_share == 0.0
    assert (of_approx.ise < of_auto.ise / 5).all()
    assert (paper("approx").ise > 2 * paper("auto").ise).all()


def test_nearly_all_of_table_4_is_spent_on_the_first_step():
    for controller, least in (("auto", 0.96), ("approx", 0.999)):
        error = np.degrees(paper(controller).q_ref - paper(controller).q)
        early = (error[:500] ** 2).sum(0) / (error**2).sum(0)
        assert (early > least).all()


def test_an_own_controller_is_accepted_in_both_modes():
    own = Pid(5.0, 1.0, 0.5, 200.0)
    for mode in ("paper", "sampled"):
        run = circle_tracking(own, mode, 12.0, duration_s=2.0)
        assert "own PID" in run.title
        assert run.u[0] == pytest.approx(12.0 * np.sign(run.q_ref[0]))
        assert np.abs(run.joint_error[-1]).max() < np.abs(run.joint_error[0]).min() / 4


def test_shapes_and_units():
    run = circle_tracking(duration_s=30.0)
    assert run.t.shape == (3000,) and run.t[0] == 0.0 and np.allclose(np.diff(run.t), 0.01)
    assert run.pose_ref.shape == run.q_ref.shape == run.q.shape == run.u.shape == (3000, 4)
    assert run.ise.shape == (4,) and run.robot == "par4" and run.joint_unit == "deg"
    assert run.effort_unit == "%" and circle_tracking(mode="sampled", duration_s=1.0).effort_unit == "V"
    radius = np.linalg.norm(run.pose_ref[:, :2] - [0.0, -0.036], axis=1)
    assert np.allclose(radius, 0.1, atol=1e-12) and np.allclose(run.pose_ref[:, 2:], [-0.3, 0.0], atol=1e-12)
    assert np.allclose(np.degrees(run.q_ref[0]), [-23.0166, 26.3939, 26.3939, -23.0166], atol=1e-4)


@pytest.mark.parametrize(
    "arguments",
    [
        {"controller": "fuzzy"},
        {"mode": "analogue"},
        {"mode": "sampled", "start": "halfway"},
        {"u_max": 0.0},
        {"u_max": math.nan},
        {"mode": "sampled", "u_max": -12.0},
        {"duration_s": 0.0},
        {"duration_s": -1.0},
        {"duration_s": 1e9},
        {"duration_s": math.inf},
        {"duration_s": math.nan},
        {"lap_s": 0.0},
        {"lap_s": -5.0},
        {"lap_s": math.nan},
        {"mode": "sampled", "duration_s": 0.001},
        {"mode": "paper", "start": "smooth"},
    ],
    ids=str,
)
def test_what_cannot_be_run_is_refused_in_one_sentence(arguments: dict[str, Any]):
    with pytest.raises(TrackingError) as refusal:
        circle_tracking(**arguments)
    sentence = str(refusal.value)
    assert sentence[0].isupper() and sentence.endswith(".") and ". " not in sentence and "\n" not in sentence
