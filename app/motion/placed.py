"""A curve where the robot is, and the movement along it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.motion.curves import CURVES
from app.motion.settings import MotionSettings
from app.motion.trajectory import Array, Law, MotionError, Sample
from app.robots import Robot

REACH_POINTS = 720
"""At so many points of a lap, reach is tried."""


@dataclass(frozen=True)
class PlacedCurve:
    """Poses over s from 0 at its start to 1 at its end, all laps included."""

    shape: Law
    """(k, 3) offsets over one lap."""
    middle: tuple[float, ...]
    """(dof,) pose around which it lies."""
    turn_rad: float = 0.0
    """A rotation goes from minus to plus half of this; on a closed curve it swings back within a lap."""
    laps: int = 1
    closed: bool = False
    rounds: int = 1
    """Laps of a closed curve, turns of a helix: how much there is to resolve."""

    def at(self, s: ArrayLike) -> tuple[Array, Array, Array]:
        """(k, dof) poses, their first and second derivative by s (k,) in [0, 1]."""
        phase = self.laps * np.asarray(s, dtype=float)
        if self.closed:
            phase = np.mod(phase, 1.0)
        offsets = self.shape.at(phase)
        poses = [np.zeros((*phase.shape, len(self.middle))) for _ in offsets]
        for power, (target, offset) in enumerate(zip(poses, offsets, strict=True)):
            target[..., :3] = offset * self.laps**power
            if len(self.middle) == 4:
                target[..., 3] = self._turned(phase)[power] * self.laps**power
        poses[0] += np.array(self.middle)
        return poses[0], poses[1], poses[2]

    def _turned(self, phase: Array) -> tuple[Array, Array, Array]:
        half, pace = 0.5 * self.turn_rad, 2.0 * math.pi
        if not self.closed:
            return 2.0 * half * phase - half, np.full_like(phase, 2.0 * half), np.zeros_like(phase)
        c, s = np.cos(pace * phase), np.sin(pace * phase)
        return -half * c, half * pace * s, half * pace * pace * c


@dataclass(frozen=True)
class AlongCurve:
    """A trajectory: a curve run through by a time law."""

    title: str
    duration_s: float
    curve: PlacedCurve
    law: Law
    """From 0 to 1 over [0, 1]."""

    def sample(self, t: ArrayLike) -> Sample:
        """See `Trajectory`."""
        s, rate, acceleration = self.law.at(np.asarray(t, dtype=float) / self.duration_s)
        pose, first, second = self.curve.at(np.clip(s, 0.0, 1.0))
        pace = (rate / self.duration_s)[..., None]
        quickening = (acceleration / self.duration_s**2)[..., None]
        return Sample(pose, first * pace, second * pace * pace + first * quickening)


def place(settings: MotionSettings, robot: Robot) -> PlacedCurve:
    """The curve of these settings around the robot's home.

    Raises:
        MotionError: if part of it is out of reach, with the limit that is in the way.
    """
    kind = CURVES[settings.curve]
    middle = robot.home.copy()
    middle[2] -= settings.lower_m
    laps = settings.laps if kind.closed else 1
    turn_rad = settings.turn_rad if robot.rotation_name else 0.0
    rounds = math.ceil(settings.turns) if "turns" in kind.parameters else laps
    curve = PlacedCurve(kind.draw(settings), tuple(middle.tolist()), turn_rad, laps, kind.closed, rounds)
    check_reach(robot, curve.at(np.linspace(0.0, 1.0 / laps, REACH_POINTS + 1))[0], "make it smaller or move it")
    return curve


def check_reach(robot: Robot, poses: Array, advice: str) -> None:
    """Raises:
    MotionError: if one of the poses (k, dof) is out of reach.
    """
    if found := obstacle(robot, poses):
        raise MotionError(f"{found}: {advice}.")


def obstacle(robot: Robot, poses: Array) -> str:
    """What stops a robot on its way through poses (k, dof), the beginning of a sentence; empty where nothing does."""
    outside = ~robot.reachable(poses)
    if not outside.any():
        return ""
    reason = robot.reach(poses[int(np.argmax(outside))]).reason.rstrip(".")
    return f"Part of the path is out of reach ({reason[:1].lower()}{reason[1:]})"
