"""The work cycle: the reference points and figures, other belts, refusals, and items that never jump."""

from __future__ import annotations

import json
import pickle
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.motion import CYCLES, CycleMotion, MotionError, WorkCycle, plan_work_cycle
from app.robots import make_robot
from app.robots.fivebar import WORKING_BOX, FiveBar
from tests.support.imports import ROOT

GOLDEN = json.loads((ROOT / "tests" / "golden" / "fivebar_dynamics.json").read_text())
PLANS = {name: plan_work_cycle(cycle) for name, cycle in CYCLES.items()}
every_cycle = pytest.mark.parametrize("name", CYCLES)
few = settings(max_examples=20)


def golden(name: str) -> list[dict[str, Any]]:
    return next(entry["points"] for entry in GOLDEN["trajectories"] if entry["name"].startswith(f"workcycle_{name}"))


def evenly(motion: CycleMotion, count: int = 24601):
    return motion.trajectory.sample(np.linspace(0.0, motion.duration_s, count))


@every_cycle
def test_it_is_the_reference_cycle(name):
    points = golden(name)
    assert len(points) > 60
    sample = PLANS[name].trajectory.sample(np.array([point["t"] for point in points]))
    for values, key in zip(sample, ("p", "pd", "pdd"), strict=True):
        assert np.abs(values - np.array([point[key] for point in points])).max() < 1e-9, key


@every_cycle
def test_joints_and_torques_equal_those_of_the_reference(name):
    motion, points = PLANS[name], golden(name)
    t = np.array([point["t"] for point in points])
    for values, key in ((motion.q, "q"), (motion.joint_rates, "qd"), (motion.efforts, "tau_mujoco")):
        wanted = np.array([point[key] for point in points])
        between = np.stack([np.interp(t, motion.t, column) for column in values.T], axis=1)
        assert np.allclose(between, wanted, atol=2e-3 * np.abs(wanted).max(axis=0)), key


def test_peaks_and_rms_are_those_of_the_specification():
    motion = PLANS["W1"]
    sample = evenly(motion)
    assert np.linalg.norm(sample.rate[:, :2], axis=1).max() == pytest.approx(1.1605, abs=2e-4)
    assert np.linalg.norm(sample.acceleration[:, :2], axis=1).max() == pytest.approx(11.293, abs=3e-3)
    assert np.abs(motion.efforts).max(axis=0) == pytest.approx([25.06, 24.01, 4.93, 2.90], abs=0.01)
    assert np.sqrt((motion.efforts**2).mean(axis=0)) == pytest.approx([7.35, 7.02, 2.63, 1.29], abs=0.01)
    assert np.abs(motion.rate[:, 2:]).max(axis=0) == pytest.approx([0.036, 12.27], rel=5e-3)
    assert np.abs(motion.joint_rates[:, :2]).max() == pytest.approx(4.79, abs=0.01)
    robot = make_robot("fivebar")
    assert isinstance(robot, FiveBar)
    sines = robot.singularity_sines(motion.pose)
    assert sines[:, 2].min() == pytest.approx(0.532, abs=1e-3) and sines[:, :2].min() == pytest.approx(0.700, abs=1e-3)
    stronger = PLANS["W2"]
    assert np.abs(stronger.efforts[:, 2]).max() == pytest.approx(24.6, abs=0.05)
    assert np.sqrt((stronger.efforts[:, 2] ** 2).mean()) == pytest.approx(11.5, abs=0.05)
    assert np.abs(stronger.joint_rates[:, 2]).max() == pytest.approx(56.6, abs=0.05)


def test_w1_keeps_the_limits_and_w2_does_not():
    assert PLANS["W1"].usage.max() < 1.0 and PLANS["W1"].limiting.startswith("Nothing is at its limit; joint q3")
    assert PLANS["W2"].usage.max() == pytest.approx(4.53, abs=0.01)
    assert PLANS["W2"].limiting.startswith("Joint q3 exceeds its speed limit: 453 %")
    with pytest.raises(MotionError, match="q3 would turn at 453 % of its motor's speed; shorten the stroke"):
        plan_work_cycle(replace(CYCLES["W2"], enforce_motor_speed=True))


def test_segments_follow_each_other_and_do_what_they_say():
    motion = PLANS["W1"]
    names, starts, ends = zip(*motion.segments, strict=True)
    assert names == ("a-b", "b-c", "c-d", "d-e", "e-f", "f-g", "g-h", "h-i", "i-a")
    assert starts[0] == 0.0 and starts[1:] == ends[:-1] and ends[-1] == pytest.approx(motion.duration_s)
    for (name, start, end), speed, x in zip(
        motion.segments, (None, 0.15, 0.15, 0.15, None, -0.15, -0.15, -0.15), (0, -1, -1, -1, 0, 1, 1, 1), strict=False
    ):
        if speed is not None:
            pose, rate, _ = motion.trajectory.sample(np.linspace(start + 1e-9, end - 1e-9, 30))
            assert np.allclose(rate[:, :2], [0.0, speed]), f"{name}: moves along with the belt"
            assert np.allclose(pose[:, 0], 0.159 * x)


cycles = st.builds(
    WorkCycle,
    belt_speed_m_s=st.floats(0.0, 0.15),
    stroke_m=st.floats(0.0, 0.005),
    period_s=st.floats(2.42, 2.6),
    pick_x_m=st.floats(-0.159, -0.05),
    place_x_m=st.floats(0.05, 0.159),
    turn_rad=st.floats(-3.0, 3.0),
)


@few
@given(cycles)
def test_other_belts_are_planned_anew_inside_the_working_box(cycle):
    motion = plan_work_cycle(cycle)
    sample = evenly(motion, 4001)
    (left, right), (near, far) = WORKING_BOX
    x, y = sample.pose[:, 0], sample.pose[:, 1]
    assert left <= x.min() and x.max() <= right and near - 1e-5 <= y.min() and y.max() <= far + 1e-5
    assert motion.usage.max() <= 1.0
    assert np.allclose(sample.pose[0], sample.pose[-1]) and np.allclose(sample.rate[[0, -1]], 0.0, atol=1e-9)
    step = motion.duration_s / 4000
    assert np.allclose(np.gradient(sample.pose, step, axis=0)[2:-2], sample.rate[2:-2], atol=1e-3)
    assert np.allclose(np.gradient(sample.rate, step, axis=0)[2:-2], sample.acceleration[2:-2], atol=0.25)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"belt_speed_m_s": 0.2}, r"leave the working box; slow them to 0.16\d m/s or shorten the period"),
        ({"period_s": 3.0}, "leave the working box"),
        ({"period_s": 2.0}, "q3 would turn at 121 %"),
        ({"period_s": 2.0, "stroke_m": 0.0}, "q4 would turn at 121 %|q3 would turn at 121 %"),
        ({"transfer_s": 0.7}, "not back in time .* shorten them to at most 0.58 s|0.59 s"),
        ({"pick_x_m": -0.17}, "x = -170 mm lies outside the working box"),
        ({"stroke_m": 0.2}, "out of reach .*screw is at its lower end"),
        ({"period_s": 1.2, "enforce_motor_speed": False}, r"need \d+ % of its peak torque, a plan may use 90 %"),
        ({"belt_speed_m_s": -0.1}, "belts' speed must lie"),
        ({"period_s": float("nan")}, "period must lie"),
        ({"dimensions": {"l_p": 0.20}}, "out of reach|singular|working"),
    ],
)
def test_what_cannot_be_is_refused_with_the_reason(change, words):
    with pytest.raises(MotionError, match=words) as refusal:
        plan_work_cycle(replace(CYCLES["W1"], **change))
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value)


def test_the_speed_a_refusal_offers_is_accepted():
    with pytest.raises(MotionError) as refusal:
        plan_work_cycle(WorkCycle(belt_speed_m_s=0.3))
    offered = float(str(refusal.value).split("slow them to ")[1].split(" m/s")[0])
    assert 0.15 < offered < 0.17
    assert plan_work_cycle(WorkCycle(belt_speed_m_s=offered)).usage.max() <= 1.0


def test_a_quicker_transfer_leaves_time_to_wait_at_a():
    motion = plan_work_cycle(WorkCycle(transfer_s=0.42, turn_rad=1.0))
    late = motion.t > 2.20 - 0.12 + 0.27
    assert late.any() and np.allclose(motion.rate[late], 0.0)


def test_an_item_weighs_from_grasp_to_release():
    loaded, empty = plan_work_cycle(WorkCycle(payload_kg=0.5)), PLANS["W1"]
    heavier = np.abs(loaded.efforts - empty.efforts).max(axis=1) > 1e-9
    assert empty.t[heavier].min() >= 0.84 - 1e-9 and empty.t[heavier].max() <= 1.94
    assert heavier[(empty.t > 0.9) & (empty.t < 1.9)].mean() > 0.99


@few
@given(cycles)
def test_items_move_without_a_jump_also_into_the_next_cycle(cycle):
    motion = plan_work_cycle(cycle)
    t = np.linspace(0.0, motion.duration_s, 2001)
    tool = motion.trajectory.sample(t).pose
    items = motion.items_at(t, tool)
    assert items.shape == (2001, motion.flow.count, 4)
    fastest = 1.05 * np.abs(motion.rate).max(axis=0) + [0.0, cycle.belt_speed_m_s, 0.0, 0.0] + 1e-9
    assert (np.abs(np.diff(items, axis=0)).max(axis=(0, 1)) <= fastest * np.diff(t)[0] + 1e-9).all()
    assert np.allclose(items[-1, 1:], items[0, :-1], atol=1e-9), "each item ends where the one before it began"
    assert np.allclose(motion.items_at(t[7], tool[7]), items[7])
    after = motion.items_at(t[1:] + motion.duration_s, tool[1:])
    assert np.allclose(after, items[1:], atol=1e-9), "the next cycle is the same again"


def test_the_item_is_on_the_belt_then_in_the_gripper_then_on_the_other_belt():
    motion = PLANS["W1"]
    flow = motion.flow
    times = np.array([0.2, 0.8, 1.0, 1.9, 2.2])
    tool = motion.trajectory.sample(times).pose
    item = motion.items_at(times, tool)[:, flow.handled]
    assert np.allclose(item[0], [-0.159, 0.29 + 0.15 * (0.2 - 0.48), -0.005, 0.0])
    assert np.allclose(item[1:4], tool[1:4], atol=1e-9), "touched at 0.8, carried at 1.0, put down at 1.9"
    assert np.allclose(item[4], [0.159, 0.383 - 0.15 * (2.2 - 1.58), -0.005, np.pi])
    spacing = np.diff(motion.items_at(0.1, motion.pose[0])[flow.handled :, 1])
    assert np.allclose(spacing, -0.15 * 2.46), "the belt brings one item each period"


def test_a_cycle_is_plain_data():
    motion = PLANS["W2"]
    copy = pickle.loads(pickle.dumps(motion))
    assert np.array_equal(copy.items_at(copy.t, copy.pose), motion.items_at(motion.t, motion.pose))
