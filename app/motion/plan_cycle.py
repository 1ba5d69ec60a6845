"""Planning a work cycle anew for other belts, or saying why it cannot be."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from itertools import accumulate

import numpy as np
from numpy.typing import ArrayLike

from app.motion.checks import within
from app.motion.cycle_items import ItemFlow
from app.motion.cycle_path import CyclePath, cycle_path
from app.motion.motion import Motion, drive_name, record
from app.motion.placed import check_reach
from app.motion.trajectory import Array, MotionError
from app.motion.work_cycle import SEGMENTS, WorkCycle
from app.robots import Robot
from app.robots.dynamics import INERTIA, dynamics_of
from app.robots.fivebar import WORKING_BOX, FiveBarGeometry
from app.robots.limits import DriveLimits, drive_limits

EFFORT_SHARE = 0.9
"""Of the peak torque that a plan may use; the rest is left to the controller."""

MIDDLE_Y_M = 0.0005
"""Middle of the stretch along which the tool moves with a belt, from home."""

LEAST_REST = 0.02
"""Of the period, the least time for coming to rest at a."""


@dataclass(frozen=True, eq=False)
class CycleMotion(Motion):
    """A work cycle, with its segments and the items on the belts. No acceleration limit binds it: the arms' is
    assumed, not the paper's, and speeds and torques are checked."""

    settings: WorkCycle
    segments: tuple[tuple[str, float, float], ...] = field(kw_only=True)
    """(name, start, end) of a-b to i-a, s."""
    flow: ItemFlow = field(kw_only=True)

    def items_at(self, t: ArrayLike, tool_pose: ArrayLike) -> Array:
        """(..., m, 4) x, y, z and turn of the items on both belts and in the gripper; see `ItemFlow.at`."""
        return self.flow.at(t, tool_pose)


def plan_work_cycle(cycle: WorkCycle, robot: Robot | None = None) -> CycleMotion:
    """The cycle for these belts, closed and inside the working box.

    Args:
        robot: a five-bar; None: the one that the cycle names.
    Raises:
        MotionError: if there is no such cycle, with the reason.
    """
    _check(cycle)
    robot = robot or cycle.build()
    if robot.name != cycle.robot:
        raise MotionError(f"The work cycle is one for the 5R robot; the {robot.title} has none.")
    path = cycle_path(cycle, _middle_y(cycle, robot))
    ends = list(accumulate(cycle.durations))
    segments = tuple(zip(SEGMENTS, [0.0, *ends[:-1]], ends, strict=True))
    inertia = INERTIA[robot.name]
    empty, loaded = (dynamics_of(robot, inertia.changed(payload=kg)) for kg in (0.0, cycle.payload_kg))

    def effort(t: Array, *state: Array) -> Array:
        carrying = (t >= ends[2]) & (t < ends[6])
        return np.where(carrying[:, None], loaded.inverse(*state), empty.inverse(*state))

    check_reach(robot, path.sample(np.linspace(0.0, path.duration_s, 500)).pose, "choose slower belts or a shorter way")
    speed, acceleration, peak = drive_limits(robot)
    limits = DriveLimits(speed, acceleration, EFFORT_SHARE * peak)
    motion = record(cycle, empty, path, limits, binding=("speed", "effort"), effort=effort)
    _check_drives(cycle, robot, motion)
    return CycleMotion(
        **{part.name: getattr(motion, part.name) for part in fields(motion)},
        segments=segments,
        flow=_flow(cycle, path, ends[2], ends[6]),
    )


def _check(cycle: WorkCycle) -> None:
    within("The belts' speed", cycle.belt_speed_m_s, 0.0, 2.0, "m/s")
    within("The stroke", cycle.stroke_m, 0.0, 0.5, "m")
    within("The period", cycle.period_s, 0.2, 60.0, "s")
    within("The turn of the tool", cycle.turn_rad, -np.pi, np.pi, "rad")
    within("An item's mass", cycle.payload_kg, 0.0, 50.0, "kg")
    within("The pick belt's x", cycle.pick_x_m, -1.0, 1.0, "m")
    within("The place belt's x", cycle.place_x_m, -1.0, 1.0, "m")
    if cycle.transfer_s is not None:
        within("The transfer", cycle.transfer_s, 0.05, 60.0, "s")
    rest, transfer = cycle.durations[8], cycle.durations[0]
    if rest < LEAST_REST * cycle.period_s:
        most = transfer + 0.5 * (rest - LEAST_REST * cycle.period_s)
        raise MotionError(
            f"With transfers of {transfer:.2f} s the tool is not back in time for the next item; "
            f"shorten them to at most {most:.2f} s, or let the items come less often."
        )


def _middle_y(cycle: WorkCycle, robot: Robot) -> float:
    """As in the reference cycle, or as near to it as the working box allows; the box is the default machine's."""
    wanted = MIDDLE_Y_M + float(robot.home[1])
    if robot.geometry != FiveBarGeometry():
        return wanted
    (left, right), (near, far) = WORKING_BOX
    outermost = max((cycle.pick_x_m, cycle.place_x_m), key=abs)
    if not left <= outermost <= right:
        raise MotionError(
            f"A belt at x = {outermost * 1e3:.0f} mm lies outside the working box; keep to {right * 1e3:.0f} mm."
        )
    y = cycle_path(cycle, 0.0).sample(np.linspace(0.0, cycle.period_s, 500)).pose[:, 1]
    low, high = float(y.min()), float(y.max())
    if high - low > far - near:
        most = cycle.belt_speed_m_s * (far - near) / (high - low)
        raise MotionError(
            f"Moving along with belts of {cycle.belt_speed_m_s:.3g} m/s, the tool would leave the working box; "
            f"slow them to {np.floor(most * 1e3) / 1e3:g} m/s or shorten the period."
        )
    return min(max(wanted, near - low), far - high)


def _check_drives(cycle: WorkCycle, robot: Robot, motion: Motion) -> None:
    speed, _, effort = motion.shares.max(axis=0)
    if cycle.enforce_motor_speed and speed.max() > 1.0:
        name, _ = drive_name(robot, int(speed.argmax()), "speed")
        advice = "shorten the stroke or take a longer period" if speed.argmax() == 2 else "take a longer period"
        raise MotionError(f"{name} would turn at {100 * speed.max():.0f} % of its motor's speed; {advice}.")
    if effort.max() > 1.0:
        name, _ = drive_name(robot, int(effort.argmax()), "effort")
        share = 100 * EFFORT_SHARE * effort.max()
        raise MotionError(
            f"{name} would need {share:.0f} % of its peak torque, a plan may use {100 * EFFORT_SHARE:.0f} %; "
            "take a longer period or a lighter item."
        )


def _flow(cycle: WorkCycle, path: CyclePath, grasp_s: float, release_s: float) -> ItemFlow:
    grasp, release = path.sample(np.array([grasp_s, release_s])).pose.tolist()
    return ItemFlow(cycle.period_s, grasp_s, release_s, cycle.belt_speed_m_s, tuple(grasp), tuple(release))
