"""What worker processes do for the tab Motion: plain functions of plain data. Nothing here may import viser."""

from __future__ import annotations

import numpy as np

from app.motion import Motion, MotionError, MotionSettings, WorkCycle, plan_motion, plan_work_cycle
from app.robots import ROBOTS, GeometryError
from app.ui.refusal import Refusal


def plan(settings: MotionSettings) -> Motion | Refusal:
    """The motion along a curve."""
    try:
        return plan_motion(settings)
    except (MotionError, GeometryError) as error:
        return Refusal(str(error))


def plan_cycle(cycle: WorkCycle) -> Motion | Refusal:
    """A work cycle of the five-bar robot."""
    try:
        return plan_work_cycle(cycle)
    except (MotionError, GeometryError) as error:
        return Refusal(str(error))


def motion_csv(motion: Motion, robot: str) -> bytes:
    """Every sample: the tool's pose, rate and acceleration, and the joints' with their efforts, in SI units."""
    kind = ROBOTS[robot].build
    columns = [("t_s", motion.t)]
    for suffix, table in (("", motion.pose), ("_rate", motion.rate), ("_acceleration", motion.acceleration)):
        columns += [(f"{name}{suffix}", column) for name, column in zip(kind.pose_names, table.T, strict=True)]
    joints = (
        ("", motion.q),
        ("_rate", motion.joint_rates),
        ("_acceleration", motion.joint_accelerations),
        ("_effort", motion.efforts),
    )
    for suffix, table in joints:
        columns += [(f"{name}{suffix}", column) for name, column in zip(kind.joint_names, table.T, strict=True)]
    head = ",".join(name for name, _ in columns)
    rows = np.column_stack([column for _, column in columns]).tolist()
    return "\n".join([head, *(",".join(f"{value:.9g}" for value in row) for row in rows), ""]).encode()
