"""The loop itself: read, compute, limit, hold, once a period."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import isfinite

from app.control.laws import Law
from app.simulation.closed_loop.drives import Drives
from app.simulation.closed_loop.sensor import Sensor
from app.simulation.plant import Plant
from app.simulation.tracking import TrackingError

Progress = Callable[[float], None]
"""Is told the share done, 0 to 1; it ends the run by raising."""

REPORT_STEPS = 250


@dataclass
class Trace:
    """One row an instant, as plain numbers."""

    pose: list[Sequence[float]] = field(default_factory=list)
    rate: list[Sequence[float]] = field(default_factory=list)
    joints: list[Sequence[float]] = field(default_factory=list)
    effort: list[Sequence[float]] = field(default_factory=list)
    """What acted from the instant on."""


@dataclass(frozen=True)
class Loop:
    """Everything that takes part."""

    plant: Plant
    sensor: Sensor
    law: Law
    drives: Drives
    period_s: float
    steps: int
    events: dict[int, Callable[[], None]]
    """What else happens, by instant."""
    watch: Callable[[], None]
    """Called at every instant, to record more."""

    def run(self, progress: Progress | None = None) -> Trace:
        """
        Raises:
            TrackingError: if the robot leaves its reach.
        """
        trace = Trace()
        keep_pose, keep_rate, keep_joints = trace.pose.append, trace.rate.append, trace.joints.append
        keep_effort = trace.effort.append
        plant, read, law, drives, period = self.plant, self.sensor.read, self.law, self.drives, self.period_s
        watch = self.watch
        applied: Sequence[float] = [0.0] * len(plant.joints)
        for k in range(self.steps):
            if k in self.events:
                self.events[k]()
            pose, joints = plant.pose, plant.joints
            if not isfinite(pose[0] + sum(joints)):
                raise _lost(k * period)
            state = read()
            applied = drives.limited(law.effort(k, state, applied), state.joint_rates)
            acting = drives.delayed(applied)
            keep_pose(pose)
            keep_rate(plant.rate)
            keep_joints(joints)
            keep_effort(acting)
            watch()
            plant.advance(acting, period)
            if progress is not None and k % REPORT_STEPS == 0:
                progress(k / self.steps)
        return trace


def _lost(t: float) -> TrackingError:
    return TrackingError(
        f"The robot was torn out of its reach after {t:.2f} s: the loop is unstable or the motion too wild; "
        "lower the bandwidth, the delay or the payload."
    )
