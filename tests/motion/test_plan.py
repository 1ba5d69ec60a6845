"""Planned motions: rest at both ends, limits everywhere, as short as they can be, refused in one sentence."""

from __future__ import annotations

import pickle
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.motion import CURVES, PROFILES, Motion, MotionError, MotionSettings, default_motion, plan_motion
from app.motion.motion import shares_of
from app.robots import ROBOTS
from app.robots.dynamics import INERTIA, dynamics_of
from tests.support.imports import ROOT, imports_of

every_robot = pytest.mark.parametrize("robot", ROBOTS)
every_curve = pytest.mark.parametrize("curve", CURVES)


@cache
def planned(robot: str, curve: str, profile: str) -> Motion:
    return plan_motion(replace(default_motion(robot), curve=curve, profile=profile))


def usage(motion: Motion, count: int) -> np.ndarray:
    """(count,) largest share of any limit, computed anew from robot, masses and trajectory."""
    wanted = motion.settings
    assert isinstance(wanted, MotionSettings)
    robot = wanted.build()
    dynamics = dynamics_of(robot, INERTIA[robot.name].changed(payload=wanted.payload_kg))
    state = motion.trajectory.sample(np.linspace(0.0, motion.duration_s, count))
    rates, accelerations = dynamics.joint_rates(state.pose, state.rate), dynamics.joint_accelerations(*state)
    return shares_of(rates, accelerations, dynamics.inverse(*state), motion.limits).max(axis=(1, 2))


@every_robot
@every_curve
def test_every_profile_keeps_all_limits_and_touches_one(robot, curve):
    for profile in PROFILES:
        motion = planned(robot, curve, profile)
        most = usage(motion, 4001).max()
        assert most <= 1.0, f"{profile}: {most}"
        assert motion.touched.any() and motion.usage.max() <= 1.0
        assert np.allclose(motion.rate[[0, -1]], 0.0, atol=1e-9)
        assert motion.t[0] == 0.0 and motion.t[-1] == motion.duration_s and (np.diff(motion.t) > 0.0).all()
        assert "limits this motion by its" in motion.limiting


@every_robot
@every_curve
def test_time_optimal_is_fastest_and_nearly_always_at_a_limit(robot, curve):
    optimal = planned(robot, curve, "time-optimal")
    others = [planned(robot, curve, profile).duration_s for profile in PROFILES]
    assert optimal.duration_s <= min(others)
    assert (usage(optimal, 3001) > 0.99).mean() > 0.9


@every_robot
@pytest.mark.parametrize("profile", PROFILES)
def test_a_motion_is_its_own_derivative_and_agrees_with_the_robot(robot, profile):
    motion = planned(robot, "polygon", profile)
    t, h = np.linspace(0.01, 0.99, 200) * motion.duration_s, 1e-6
    after, at, before = (motion.trajectory.sample(t + step) for step in (h, 0.0, -h))
    assert np.allclose((after.pose - before.pose) / (2 * h), at.rate, rtol=1e-4, atol=1e-5)
    steady = np.abs(after.acceleration - before.acceleration).max(axis=1) < 0.01 * np.abs(at.acceleration).max()
    assert steady.mean() > 0.8, "away from jumps"
    numeric = (after.rate - before.rate) / (2 * h)
    assert np.allclose(numeric[steady], at.acceleration[steady], atol=0.02 * np.abs(at.acceleration).max())
    machine = motion.settings.build()
    assert np.allclose(machine.inverse(motion.pose), motion.q)
    rates = np.einsum("kij,kj->ki", machine.jacobian(motion.pose), motion.rate)
    assert np.allclose(rates, motion.joint_rates, atol=1e-9)
    assert np.allclose(
        motion.efforts, dynamics_of(machine).inverse(motion.pose, motion.rate, motion.acceleration), atol=1e-9
    )


def test_a_trajectory_stands_still_beyond_its_ends():
    motion = planned("linear", "helix", "cubic")
    pose, rate, acceleration = motion.trajectory.sample(np.array([-1.0, motion.duration_s + 1.0]))
    assert np.allclose(pose, motion.pose[[0, -1]])
    assert not rate.any() and not acceleration.any()


def test_the_shortest_duration_is_the_shortest_and_a_longer_one_is_kept():
    fastest, wanted = planned("delta3", "circle", "quintic"), replace(default_motion("delta3"), profile="quintic")
    same = plan_motion(replace(wanted, duration_s=np.ceil(fastest.duration_s * 1e3) / 1e3))
    assert usage(same, 2001).max() == pytest.approx(1.0, abs=3e-3)
    slow = plan_motion(replace(wanted, duration_s=3.0 * fastest.duration_s))
    assert slow.duration_s == 3.0 * fastest.duration_s
    assert slow.joint_rates.max() == pytest.approx(fastest.joint_rates.max() / 3.0, rel=1e-3)
    assert "Nothing is at its limit" in slow.limiting and not slow.touched.any()


@every_robot
def test_too_short_a_duration_is_refused_with_joint_kind_and_the_shortest(robot):
    wanted = default_motion(robot)
    shortest = plan_motion(wanted).duration_s
    with pytest.raises(MotionError) as refusal:
        plan_motion(replace(wanted, duration_s=0.6 * shortest))
    sentence = str(refusal.value)
    assert any(name in sentence for name in ROBOTS[robot].build.joint_names)
    assert any(kind in sentence for kind in ("speed", "acceleration", "torque", "force"))
    given_s = float(sentence.removesuffix(" s.").split()[-1])
    assert shortest <= given_s <= shortest + 0.0011
    assert plan_motion(replace(wanted, duration_s=given_s)).usage.max() <= 1.0


def test_torque_can_be_what_limits_and_a_payload_makes_it_worse():
    weak = replace(default_motion("delta3"), profile="trapezoidal", effort_share=0.35)
    motion = plan_motion(weak)
    assert "torque" in motion.limiting and usage(motion, 4001).max() <= 1.0
    loaded = plan_motion(replace(weak, payload_kg=0.05))
    assert loaded.duration_s > motion.duration_s and usage(loaded, 4001).max() <= 1.0
    with pytest.raises(MotionError, match=r"Joint q\d cannot even hold the tool: that takes \d+ % of the torque"):
        plan_motion(replace(weak, payload_kg=10.0))


@every_robot
def test_less_of_the_drives_takes_longer(robot):
    wanted = default_motion(robot)
    shares = {"speed_share": 0.2, "acceleration_share": 0.1}
    for name, share in shares.items():
        assert plan_motion(replace(wanted, **{name: share})).duration_s > 1.2 * plan_motion(wanted).duration_s


def test_laps_are_run_through_without_a_rest():
    once, thrice = (plan_motion(replace(default_motion("delta3"), laps=laps)) for laps in (1, 3))
    assert once.duration_s * 1.5 < thrice.duration_s < 3.0 * once.duration_s
    speed = np.linalg.norm(thrice.rate[:, :3], axis=1)
    assert (speed[len(speed) // 10 : -len(speed) // 10] > 0.0).all()
    assert usage(thrice, 6001).max() <= 1.0


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"size_m": 0.4}, "out of reach"),
        ({"size_m": float("nan")}, "size must lie between"),
        ({"curve": "spiral"}, "choose one of line, circle"),
        ({"profile": "fast"}, "choose one of cubic"),
        ({"laps": 0}, "number of laps"),
        ({"curve": "polygon", "sides": 2}, "number of sides"),
        ({"curve": "arch", "height_m": 0.0}, "needs a lift"),
        ({"speed_share": 1.5}, "speed must lie between 0.01 and 1"),
        ({"duration_s": -1.0}, "duration must lie"),
        ({"turn_rad": 2.0}, "out of reach"),
        ({"payload_kg": -1.0}, "payload must lie"),
    ],
)
def test_a_mistake_is_refused_in_one_sentence(change, words):
    with pytest.raises(MotionError, match=words) as refusal:
        plan_motion(replace(default_motion("par4"), **change))
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value)


@settings(max_examples=20)
@given(
    st.sampled_from(sorted(ROBOTS)),
    st.sampled_from(sorted(CURVES)),
    st.sampled_from(sorted(PROFILES)),
    st.floats(0.01, 0.06),
    st.floats(0.005, 0.04),
    st.floats(0.1, 1.0),
    st.floats(0.1, 1.0),
)
def test_limits_hold_whatever_is_chosen(robot, curve, profile, size, height, speed, acceleration):
    wanted = replace(default_motion(robot), curve=curve, profile=profile, size_m=size, height_m=height)
    motion = plan_motion(replace(wanted, speed_share=speed, acceleration_share=acceleration, effort_share=1.0))
    assert 0.97 < usage(motion, 4001).max() <= 1.001


def test_a_motion_is_plain_data():
    motion = planned("par4", "arch", "time-optimal")
    copy = pickle.loads(pickle.dumps(motion))
    assert np.array_equal(copy.trajectory.sample(motion.t).pose, motion.pose)


def test_heavy_libraries_are_not_imported_with_the_package():
    files = (ROOT / "app" / "motion").glob("*.py")
    early = {found.module.split(".")[0] for path in files for found in imports_of(path) if found.at_start}
    assert not early & {"ruckig", "toppra", "scipy", "mujoco"}
