"""All drives of a robot follow a path of its tool, each under a controller of its own, alike for all."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from app.control import Motor, Pid
from app.control.drives import DRIVES
from app.control.sampled_pid import Sampling
from app.motion import Tour, quintic
from app.motion.placed import obstacle
from app.robots import Robot, build_robot
from app.simulation import sampled_loop, simulink_loop
from app.simulation.hardware import Hardware
from app.simulation.run import SHOWN, Run
from app.simulation.sampled_loop import DriveLoop

Array = NDArray[np.float64]
Start = Literal["rest", "reference", "smooth"]

SMOOTH_START_S = 5.0
MAX_SAMPLES = 200_000


class TrackingError(ValueError):
    """A path that cannot be followed; the message is one sentence for the user."""


@dataclass(frozen=True)
class Task:
    """What the robot has to do."""

    robot: str = "par4"
    dimensions: dict[str, float] = field(default_factory=dict)
    tour: Tour = field(default_factory=Tour)
    duration_s: float = 100.0
    start: Start = "rest"
    """`rest`: joints at 0, or at home for a robot whose joints cannot be 0 there, which makes the first instant a
    step. `reference`: where the path begins. `smooth`: from rest to the path in 5 s, then the path."""

    def build(self) -> Robot:
        return build_robot(self.robot, self.dimensions)


def follow_sampled(task: Task, motor: Motor, pid: Pid, sampling: Sampling, hardware: Hardware, title: str = "") -> Run:
    """With controllers as a microcontroller runs them. Voltages.

    Raises:
        TrackingError: if part of the path is out of reach, or a number or name makes no sense.
    """
    _check_limit(hardware.supply_v)
    robot, t = task.build(), sample_times(task.duration_s, sampling.period_s)
    pose_ref, q_ref, starts = reference(robot, task, t)
    factor = SHOWN[robot.joint_units[0]][1]
    loop = DriveLoop(motor, pid, sampling, hardware)
    rows = zip((q_ref * factor).T.tolist(), (starts * factor).tolist(), strict=True)
    traces = [sampled_loop.simulate(loop, row, start=y, seed=joint) for joint, (row, y) in enumerate(rows)]
    every = len(traces[0].y) // len(t)
    q, u = (np.array([values[::every] for values in column]).T for column in list(zip(*traces, strict=True))[:2])
    ise = np.array([trace.ise for trace in traces])
    return Run(title, task.robot, t, pose_ref, q_ref, q / factor, u, hardware.supply_v, "V", ise, task.dimensions)


def follow_simulink(task: Task, pid: Pid, u_max: float, step_s: float = 0.01, title: str = "") -> Run:
    """With continuous controllers, as the Par4 paper simulated it; the control signal is called percent there.

    Raises:
        TrackingError: if part of the path is out of reach, or a number or name makes no sense.
    """
    if task.start != "rest":
        raise TrackingError("The paper's simulation starts from rest; choose the sampled controller for another start.")
    _check_limit(u_max)
    robot, t = task.build(), sample_times(task.duration_s, step_s)
    pose_ref, q_ref, starts = reference(robot, task, t)
    factor = SHOWN[robot.joint_units[0]][1]
    stages = [factor * reference(robot, task, t + c * step_s)[1] for c in simulink_loop.STAGES]
    motor = DRIVES[task.robot].motor
    traces = [
        simulink_loop.simulate(motor, pid, u_max, step_s, [stage[:, joint].tolist() for stage in stages], start)
        for joint, start in enumerate((starts * factor).tolist())
    ]
    q, u = (np.array(column).T for column in list(zip(*traces, strict=True))[:2])
    ise = np.array([trace.ise for trace in traces])
    return Run(title, task.robot, t, pose_ref, q_ref, q / factor, u, u_max, "%", ise, task.dimensions)


def sample_times(duration_s: float, step_s: float) -> Array:
    """(k,) from 0 to just before the end.

    Raises:
        TrackingError: for a duration or step that makes no sense.
    """
    steps = duration_s / step_s if step_s > 0.0 else math.nan
    if not 1.0 <= steps <= MAX_SAMPLES:
        raise TrackingError(
            f"A run of {duration_s:g} s in steps of {step_s:g} s cannot be computed: it takes 1 to {MAX_SAMPLES} steps."
        )
    return np.arange(round(steps), dtype=float) * step_s


def reference(robot: Robot, task: Task, t: Array) -> tuple[Array, Array, Array]:
    """(k, dof) poses and (k, n) joints wanted at times t, and (n,) the joints at the start.

    Raises:
        TrackingError: if part of the path is out of reach, with the limit that is in the way.
    """
    if not task.tour.lap_s > 0.0:
        raise TrackingError(f"A lap takes more than 0 s, not {task.tour.lap_s:g} s.")
    if task.start not in get_args(Start):
        raise TrackingError(f"There is no start {task.start!r}; choose rest, reference or smooth.")
    rest = resting_joints(robot)
    if task.start != "smooth":
        poses = _reachable(robot, task.tour.poses(robot, t))
        joints = robot.inverse(poses)
        first = robot.inverse(task.tour.poses(robot, 0.0))
        return poses, joints, rest if task.start == "rest" else first
    on_path = robot.inverse(_reachable(robot, task.tour.poses(robot, np.maximum(t - SMOOTH_START_S, 0.0))))
    joints = rest + quintic(t / SMOOTH_START_S)[:, None] * (on_path - rest)
    poses = robot.forward(joints)
    return np.where(np.isnan(poses), task.tour.poses(robot, 0.0), poses), joints, rest


def resting_joints(robot: Robot) -> Array:
    """(n,) zero where the robot can stand there, as the Par4 of the paper does before it starts; else home."""
    zero = np.zeros(len(robot.joint_names))
    pose = robot.forward(zero)
    return zero if not np.isnan(pose).any() and robot.reachable(pose) else robot.inverse(robot.home)


def _check_limit(u_max: float) -> None:
    if not u_max > 0.0:
        raise TrackingError(f"The control signal needs a limit above 0, not {u_max:g}.")


def _reachable(robot: Robot, poses: Array) -> Array:
    if found := obstacle(robot, poses):
        raise TrackingError(f"{found}: make it smaller.")
    return poses
