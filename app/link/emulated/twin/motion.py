"""The set-points of all joints on their way to the newest target."""

from __future__ import annotations

import math
from collections.abc import Sequence


class Motion:
    """Positions in rad or m, times in s. What is asked of it is checked already."""

    def __init__(self, joints: int) -> None:
        self.joints = joints
        self.place([0.0] * joints)

    def place(self, at: Sequence[float]) -> None:
        """At rest, here."""
        self.setpoint = list(at)
        self.target = list(at)
        self.velocity = [0.0] * self.joints
        self.time_left = 0.0
        """Until the set-point is at its target."""
        self.stop_left = 0.0
        """Until a controlled stop is at rest; 0 if there is none."""

    def aim(self, target: Sequence[float], speeds: Sequence[float], time: float) -> None:
        """Straight there in this time, or longer where a joint's speed demands it. The same again changes nothing."""
        if self.stop_left == 0.0 and self.time_left > 0.0 and self.target == list(target):
            return  # a repeated target does not put its own arrival off
        ways = [abs(there - here) for there, here in zip(target, self.setpoint, strict=True)]
        self.target = list(target)
        self.stop_left = 0.0
        self.time_left = (
            max(time, *(way / speed for way, speed in zip(ways, speeds, strict=True))) if any(ways) else 0.0
        )

    def stop(self, stop_time: float) -> None:
        """On along the present direction, slower and slower; a stop that is under way goes on."""
        if self.stop_left == 0.0:
            self.stop_left = stop_time

    def run(self, dt: float, limits: Sequence[tuple[float, float]], stop_time: float) -> None:
        """`dt` later."""
        if self.stop_left > 0.0:
            self._slow_down(dt, limits, stop_time)
        elif self.time_left > 0.0:
            self._go_on(dt)
        else:
            self.velocity = [0.0] * self.joints

    def approach(self, joint: int, goal: float, speed: float, dt: float) -> bool:
        """One joint alone goes towards its goal; True when it is there."""
        way, reach = goal - self.setpoint[joint], speed * dt
        there = abs(way) <= reach
        self.velocity[joint] = 0.0 if there else math.copysign(speed, way)
        self.setpoint[joint] = goal if there else self.setpoint[joint] + math.copysign(reach, way)
        return there

    def _go_on(self, dt: float) -> None:
        left = self.time_left
        ways = [there - here for there, here in zip(self.target, self.setpoint, strict=True)]
        self.velocity = [way / left for way in ways]
        share = min(dt / left, 1.0)
        if share < 1.0:
            self.setpoint = [here + share * way for here, way in zip(self.setpoint, ways, strict=True)]
        else:
            self.setpoint = list(self.target)
        self.time_left = max(left - dt, 0.0)

    def _slow_down(self, dt: float, limits: Sequence[tuple[float, float]], stop_time: float) -> None:
        before, rest = self.stop_left, max(self.stop_left - dt, 0.0)
        way = 0.5 * (before + rest) * (before - rest) / stop_time
        moves = zip(self.setpoint, self.velocity, limits, strict=True)
        self.setpoint = [_within(here, here + way * v, low, high) for here, v, (low, high) in moves]
        self.stop_left = rest
        if rest == 0.0:
            self.place(self.setpoint)


def _within(here: float, there: float, low: float, high: float) -> float:
    """A joint that would leave its limits stops there; one that is outside already does not jump back."""
    if there > here and there > high:
        return max(here, high)
    if there < here and there < low:
        return min(here, low)
    return there
