"""The session without any browser: what it does with drags, numbers, joints and dimensions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from app.robots import ROBOTS, GeometryError
from app.ui.session import Session
from app.ui.state import Memory, Stance, ViewOptions


@pytest.fixture(params=sorted(ROBOTS))
def session(request: pytest.FixtureRequest) -> Session:
    return Session(Memory(request.param))


def heard(session: Session) -> list[Stance]:
    """Every stance that listeners are told from now on."""
    stances: list[Stance] = []
    session.stance_changed.connect(stances.append)
    return stances


def test_inside_reach_the_robot_follows_exactly(session):
    stances = heard(session)
    target = session.robot.home[:3] + [0.004, -0.003, 0.002]
    session.drag(position=target)
    assert session.stance.pose[:3] == tuple(target)
    assert np.allclose(session.robot.forward(session.stance.joints), session.stance.pose, atol=1e-9)
    assert session.stance.reach.ok and session.stance.blocked_leg is None
    assert stances == [session.stance]


def test_outside_reach_it_stands_at_the_nearest_pose_and_says_why(session):
    session.drag(position=session.robot.home[:3] + [0.9, 0.1, 0.2])
    stance = session.stance
    assert not stance.reach.ok and stance.reach.reason
    assert session.robot.reach(stance.pose).ok
    assert stance.wish[0] != stance.pose[0], "the gizmo stays under the pointer"
    session.release()
    assert session.stance.wish == session.stance.pose
    assert session.stance.reach.reason == stance.reach.reason, "the reason can still be read"


def test_a_walk_through_anything_never_raises(session):
    rng = np.random.default_rng(0)
    for step in rng.normal(scale=0.25, size=(300, 4)):
        session.drag(position=np.array(session.stance.wish[:3]) + step[:3], rotation=step[3] * 9)
        assert session.robot.reach(session.stance.pose).ok
    session.drag(position=(math.nan, math.inf, 0.0))
    assert session.robot.reach(session.stance.pose).ok


def test_typed_pose_out_of_reach_is_brought_back_and_explained(session):
    session.go([5.0, *session.robot.home[1:]])
    assert session.robot.reach(session.stance.pose).ok
    assert session.stance.wish == session.stance.pose and not session.stance.reach.ok


def test_joints_move_the_tool(session):
    before = session.stance
    session.set_joint(0, before.joints[0] + 0.02)
    assert session.stance.joints[0] == pytest.approx(before.joints[0] + 0.02)
    assert session.stance.joints[1:] == pytest.approx(before.joints[1:], abs=1e-9)
    assert session.stance.pose != before.pose


def test_impossible_joints_hold_the_last_pose(session):
    before = session.stance
    low, high = session.robot.joint_limits[0]
    session.set_joint(0, high + (high - low))
    assert session.stance.pose == before.pose and session.stance.joints == before.joints
    assert "holds the last pose" in session.stance.reach.reason
    session.drag(position=before.pose[:3])
    assert session.stance.reach.ok


def test_dimensions_change_the_robot_and_keep_it_in_reach(session):
    session.drag(position=session.robot.home[:3] + [0.02, 0.02, -0.02])
    name, dimension = next((n, d) for n, d in session.robot.geometry.dimensions().items() if d.essential)
    value = getattr(session.robot.geometry, name)
    session.reshape(**{name: value + 0.1 * (dimension.high - value)})
    assert getattr(session.robot.geometry, name) > value
    assert session.robot.reach(session.stance.pose).ok
    session.reset_geometry()
    assert getattr(session.robot.geometry, name) == value


def test_a_refused_dimension_changes_nothing(session):
    robot, stance = session.robot, session.stance
    with pytest.raises(GeometryError):
        session.reshape(**{next(iter(session.robot.geometry.dimensions())): 50.0})
    assert session.robot is robot and session.stance is stance


def test_choosing_a_robot_starts_it_at_home(session):
    told: list[object] = []
    session.robot_changed.connect(told.append)
    for name in ROBOTS:
        session.choose_robot(name)
        assert session.robot.name == name
        assert session.stance.pose == tuple(session.robot.home.tolist())
    assert len(told) == len(ROBOTS)


def test_presets(session):
    for preset in ROBOTS[session.robot_name].presets:
        session.choose_preset(preset)
        assert session.robot.reach(session.stance.pose).ok


def test_what_is_remembered_brings_the_same_session_back(session):
    session.drag(position=session.robot.home[:3] + [0.01, 0.0, 0.01])
    session.show(trace=True, dark=True)
    again = Session(session.memory)
    assert again.robot_name == session.robot_name
    assert again.stance.pose == session.stance.pose
    assert again.view == ViewOptions(trace=True, dark=True)


def test_two_sessions_share_nothing():
    one, two = Session(Memory("par4")), Session(Memory("par4"))
    stances = heard(two)
    one.drag(position=(0.03, 0.0, -0.35))
    one.reshape(l=0.42)
    one.choose_robot("linear")
    assert stances == [] and two.robot_name == "par4" and two.dimensions == {}
