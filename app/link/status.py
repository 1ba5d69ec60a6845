"""What is known about the robot on the cable at one moment, for whoever shows it."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np

from app.link.lease import Person
from app.link.protocol.messages import Identity, Telemetry
from app.robots import Robot

Phase: TypeAlias = Literal["none", "connecting", "ready", "lost", "refused"]
"""Of the connection: none wanted, being made, made, broken and tried again by itself, given up."""

Pose: TypeAlias = tuple[float, ...]

Activity: TypeAlias = Literal["idle", "jog", "step", "mirror", "run", "paused", "test"]
"""What the host moves the robot for; homing is a state of the board."""


@dataclass(frozen=True)
class LogLine:
    """Something that happened, in one sentence."""

    time_s: float
    """Of the link's clock."""
    sentence: str


@dataclass(frozen=True, eq=False)
class LinkStatus:
    """An immutable snapshot. SI units and radians."""

    phase: Phase = "none"
    sentence: str = "No robot is connected."
    """What a person should know now: of the connection, the board's fault or stop, or the last refusal."""
    port: str = ""
    identity: Identity | None = None
    robot: Robot | None = None
    """With the geometry that the board has."""
    telemetry: Telemetry | None = None
    """The newest. HOMED is shown only after a homing on this connection."""
    holder: Person | None = None
    holder_left_s: float = 0.0
    queue: tuple[Person, ...] = ()
    activity: Activity = "idle"
    progress: float = 0.0
    """0 to 1 of a program, by time."""
    program_title: str = ""
    override: float = 1.0
    """Share of the speed, 0.05 to 1."""
    round_trip_ms: float = float("nan")
    """Median from a set-point to the telemetry that names it; NaN before the first motion."""
    round_trip_p95_ms: float = float("nan")
    settings: dict[int, float] = field(default_factory=dict)
    """By id; only those that were read already."""
    log: tuple[LogLine, ...] = ()
    """The last 100, the newest last."""
    recording_s: float = 0.0
    """Length of the recording that runs; 0 for none."""
    revision: int = 0
    """Grows with every change that a person would notice."""

    @property
    def measured_pose(self) -> Pose | None:
        """(dof,) of the measured joints; None where they do not assemble, or nothing is known."""
        return self._poses[0]

    @property
    def commanded_pose(self) -> Pose | None:
        """(dof,) of the board's set-point; None like the other."""
        return self._poses[1]

    @cached_property
    def _poses(self) -> tuple[Pose | None, Pose | None]:
        """Of the newest telemetry; they take a millisecond, so only when somebody asks."""
        if self.telemetry is None or self.robot is None:
            return None, None
        n = len(self.robot.joint_names)
        found = self.robot.forward([self.telemetry.position[:n], self.telemetry.setpoint[:n]])
        measured, commanded = (None if np.isnan(pose).any() else tuple(pose.tolist()) for pose in found)
        return measured, commanded
