"""A program, run: a slow way to its beginning, then its joints at its times, or slower."""

from __future__ import annotations

import numpy as np

from app.link.errors import LinkError
from app.link.motions.bounds import Bounds
from app.link.motions.motion import Joints, Target
from app.link.programs import Program
from app.link.status import Activity
from app.simulation.run import SHOWN

APPROACH_SHARE = 0.25
"""Of the joints' speeds, on the way to the beginning."""

SHORTEST_APPROACH_S = 0.3
PEAK = 1.875
"""Highest speed of the way from rest to rest, as a multiple of its mean."""

SHARE_RATE = 2.0
"""1/s: how fast the override changes, so that turning its knob is no blow."""

SLOWEST = 0.05
"""A program that would have to run slower than this is none for this robot."""

ON_LIMIT = 1e-6
SAMPLING = 41


def check_program(program: Program, bounds: Bounds) -> float:
    """The share of its speed (up to 1) with which every joint can follow. LinkError where none can, with the moment."""
    robot = bounds.robot
    if program.robot != robot.name or program.q.shape[1] != bounds.joints:
        raise LinkError(f"The program is for {program.robot}, the robot on the cable is {robot.name}; choose that one.")
    unit, factor = SHOWN[robot.joint_unit]
    outside = (program.q < np.array(bounds.low) - ON_LIMIT) | (program.q > np.array(bounds.high) + ON_LIMIT)
    if outside.any():
        k, joint = np.argwhere(outside)[0]
        raise LinkError(
            f"After {program.t[k]:.1f} s the program takes joint {joint + 1} to {program.q[k, joint] * factor:.1f} "
            f"{unit}, outside of the limits; move the path."
        )
    loads = np.abs(np.diff(program.q, axis=0)) / np.diff(program.t)[:, None] / np.array(bounds.speed)
    k, joint = np.unravel_index(int(np.argmax(loads)), loads.shape)
    share = min(1.0, 1.0 / float(max(loads[k, joint], 1e-9)))
    if share < SLOWEST:
        raise LinkError(
            f"After {program.t[k]:.1f} s the program wants joint {joint + 1} {loads[k, joint]:.0f} times as fast as it "
            "can go; make the program slower, or its path smoother."
        )
    return share


class Approach:
    """From rest to rest on a straight line of the joints, with the pen lifted."""

    def __init__(self, bounds: Bounds, start: Joints, end: Joints) -> None:
        self._start, self._way = np.array(start), np.array(end) - np.array(start)
        line = bounds.robot.forward(self._start + np.linspace(0.0, 1.0, SAMPLING)[:, None] * self._way)
        if np.isnan(line).any():
            raise LinkError("The way to the program's beginning is not free; move the robot closer to it.")
        steps = np.linalg.norm(np.diff(line[:, :3], axis=0), axis=1)
        joints = np.abs(self._way) / (APPROACH_SHARE * np.array(bounds.speed))
        tool = float(steps.max()) * (SAMPLING - 1) / (0.8 * bounds.tool_speed)
        self.duration_s = max(SHORTEST_APPROACH_S, PEAK * max(float(joints.max()), tool))

    def at(self, time_s: float) -> Joints:
        x = min(time_s / self.duration_s, 1.0)
        return tuple((self._start + x**3 * (10.0 - 15.0 * x + 6.0 * x * x) * self._way).tolist())


class Course:
    """Remembers how far it came, so that it can go on from there after a pause."""

    activity: Activity = "run"
    notice = ""

    def __init__(self, program: Program, bounds: Bounds) -> None:
        self.pace = check_program(program, bounds)
        """Share of the program's speed at an override of 100 %: less than 1 where the joints are too slow for it."""
        self.program, self._bounds = program, bounds
        self._time_s = 0.0
        self._approach: Approach | None = None
        self._approach_s = 0.0
        self._share = 0.0

    @property
    def progress(self) -> float:
        return self._time_s / self.program.duration_s

    @property
    def finished(self) -> bool:
        return self._approach is None and self._time_s >= self.program.duration_s

    def begin(self, joints: Joints) -> Course:
        """Start, or go on, from these joints; the way back to where it was is slow."""
        self._approach = Approach(self._bounds, joints, self._joints())
        self._approach_s = self._share = 0.0
        return self

    def advance(self, dt_s: float, share: float) -> Target:
        if self._approach is not None:
            return self._come_closer(self._approach, dt_s, share)
        change = share * self.pace - self._share
        self._share += max(-SHARE_RATE * dt_s, min(change, SHARE_RATE * dt_s))
        self._time_s = min(self._time_s + self._share * dt_s, self.program.duration_s)
        laser = float(np.interp(self._time_s, self.program.t, self.program.laser))
        return Target(self._joints(), self.program.starts_manual, self._pen_down(), laser * self._share)

    def _come_closer(self, approach: Approach, dt_s: float, share: float) -> Target:
        self._approach_s += share * dt_s
        if self._approach_s >= approach.duration_s:
            self._approach = None
        return Target(approach.at(self._approach_s), True, self._time_s > 0.0 and self._pen_down())

    def _pen_down(self) -> bool:
        return bool(self.program.pen_down[np.searchsorted(self.program.t, self._time_s, side="right") - 1])

    def _joints(self) -> Joints:
        """Between the samples by straight lines."""
        t, q = self.program.t, self.program.q
        k = min(int(np.searchsorted(t, self._time_s, side="right")) - 1, len(t) - 2)
        part = (self._time_s - t[k]) / (t[k + 1] - t[k])
        return tuple((q[k] + part * (q[k + 1] - q[k])).tolist())
