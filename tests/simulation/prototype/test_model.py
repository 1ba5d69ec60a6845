"""The MuJoCo models against the closed form and against golden values of other MuJoCo models."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from app.robots import ROBOTS, Robot, make_robot
from app.robots.dynamics import INERTIA, dynamics_of
from app.simulation.prototype import mjcf
from app.simulation.prototype.engine import mujoco
from tests.robots.golden import golden
from tests.robots.test_every_robot import reachable_sample
from tests.simulation.prototype.oracle import solve

EVERY = {name: make_robot(name) for name in ROBOTS}
OTHERS = {
    "par4 with a long rod": make_robot("par4", l=0.42, h=0.06, P_z=0.05),
    "delta3 classic": make_robot("delta3", preset="classic"),
    "linear with a long rod": make_robot("linear", l=0.40),
    "fivebar of other links": make_robot("fivebar", l_p=0.27, l_d=0.24, p=0.03),
}


@pytest.mark.parametrize("robot", [*EVERY.values(), *OTHERS.values()], ids=[*EVERY, *OTHERS])
def test_closed_form_and_mujoco_agree(robot: Robot):
    """Efforts, joint rates and joint accelerations at random states, with and without a payload."""
    rng = np.random.default_rng(1)
    poses = reachable_sample(robot, 6, seed=2)
    for k, pose in enumerate(poses):
        dynamics = dynamics_of(robot, INERTIA[robot.name].changed(payload=0.4 * (k % 2)))
        rate, acceleration = rng.uniform(-1.0, 1.0, robot.dof), rng.uniform(-10.0, 10.0, robot.dof)
        answer = solve(robot, dynamics.inertia, pose, rate, acceleration)
        assert answer.mismatch < 1e-11, "MuJoCo's mechanism does not move as asked"
        effort = dynamics.inverse(pose, rate, acceleration)
        assert np.abs(answer.effort - effort).max() < 2e-10 * np.abs(effort).max()
        assert np.allclose(answer.joint_rate, dynamics.joint_rates(pose, rate), rtol=0, atol=1e-10)
        expected = dynamics.joint_accelerations(pose, rate, acceleration)
        assert np.allclose(answer.joint_acceleration, expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("name", ROBOTS)
def test_every_mass_counts(name: str):
    """Were one declared mass left out of a model, or put at another place, this would tell."""
    robot = EVERY[name]
    inertia, pose = INERTIA[name], robot.home + 0.02
    rate, acceleration = np.linspace(0.3, 0.9, robot.dof), np.linspace(6.0, -4.0, robot.dof)
    before = solve(robot, inertia, pose, rate, acceleration).effort
    for field in set(inertia.quantities()) - {"lumped"}:
        changed = inertia.changed(**{field: 0.8 * getattr(inertia, field) or 0.3})
        after = solve(robot, changed, pose, rate, acceleration).effort
        expected = dynamics_of(robot, changed).inverse(pose, rate, acceleration)
        assert np.abs(after - before).max() > 1e-9, f"{field} has no weight in the model"
        assert np.allclose(after, expected, rtol=1e-9, atol=1e-9), field


def test_golden_values_of_other_models():
    """Another MuJoCo model, with ball joints, gave these: rods on universal joints make no difference."""
    for path in golden("linear_delta_dynamics")["trajectories"]:
        for point in path["points"][::10]:
            answer = solve(EVERY["linear"], None, *(np.array(point[key]) for key in ("P", "V", "A")))
            assert np.allclose(answer.effort, point["f_mujoco"], rtol=0, atol=1e-10)
    for path in golden("fivebar_dynamics")["trajectories"]:
        for point in path["points"][::20]:
            answer = solve(EVERY["fivebar"], None, *(np.array(point[key]) for key in ("p", "pd", "pdd")))
            assert np.allclose(answer.effort, point["tau_mujoco"], rtol=0, atol=1e-10)


@pytest.mark.parametrize("name", ["par4", "delta3", "linear"])
def test_rods_end_on_the_platform(name: str):
    """MuJoCo closes a loop wherever its ends are: that they meet where kinematics says is checked here."""
    robot, mj = EVERY[name], mujoco()
    for pose in reachable_sample(robot, 3, seed=4):
        m = mj.MjModel.from_xml_string(mjcf(robot, pose=pose))
        d = mj.MjData(m)
        mj.mj_forward(m, d)
        joints = robot.solve(*pose.tolist())
        assert np.allclose([d.joint(joint).qpos[0] for joint in robot.joint_names], joints, rtol=0, atol=1e-12)
        assert np.allclose([d.joint(axis).qpos[0] for axis in robot.pose_names], pose, rtol=0, atol=1e-12)
        assert np.allclose(d.site("tool").xpos, pose[:3], rtol=0, atol=1e-12)
        skeleton = robot.skeleton(pose.tolist(), joints)
        rods = [m.body(f"rod{leg + 1}{side}") for leg in range(robot.legs) for side in "ab"]
        loops = m.eq_type == mj.mjtEq.mjEQ_CONNECT
        ends = dict(zip(m.eq_obj1id[loops].tolist(), m.eq_data[loops, :3], strict=True))
        lower = [d.xpos[rod.id] + d.xmat[rod.id].reshape(3, 3) @ ends[rod.id] for rod in rods]
        assert np.allclose(np.reshape(lower, (-1, 2, 3)).mean(axis=1), skeleton.platform, rtol=0, atol=1e-12)


def test_a_pose_out_of_reach_is_refused():
    with pytest.raises(ValueError, match="cannot be built in this pose"):
        mjcf(EVERY["delta3"], pose=[1.0, 0.0, -0.3])


def test_importing_the_prototype_leaves_mujoco_alone():
    code = "import sys, app.simulation.prototype; sys.exit('mujoco' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
