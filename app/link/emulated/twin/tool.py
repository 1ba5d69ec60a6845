"""Where the tool is at the set-point: known well enough to bound its speed in manual mode."""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.link.emulated.twin.kinematics import forward_guess, forward_step
from app.link.emulated.twin.motion import Motion
from app.link.protocol.codes import RobotKind

SETTLED = 1e-5
"""m or rad"""
LOOK_S = 0.01
"""So far ahead it looks, and so long the velocity that it finds holds: the pose is then corrected once."""
PROBE = 0.05
"""rad or m: so far ahead the tool goes in a straight line."""


class Tool:
    """At rest, Newton's method comes closer to the pose with each period; in manual mode it follows the joints."""

    def __init__(self, kind: RobotKind) -> None:
        self._kind = kind
        self._curved = 2 if kind == RobotKind.FIVEBAR else 4  # its screw and spline go straight
        self._pose = [0.0] * 4
        self._velocity = [0.0] * 4
        self._look_left = 0.0
        self.known = False

    def look_again(self) -> None:
        """The motion has another target."""
        self._look_left = 0.0

    def lose(self, geometry: Sequence[float], joints: Sequence[float]) -> None:
        """The joints are somewhere else now."""
        self._pose = forward_guess(self._kind, geometry, joints)
        self.known = False

    def settle(self, geometry: Sequence[float], motion: Motion) -> None:
        """At rest: one step nearer to where the tool is."""
        if self.known:
            return
        step = forward_step(self._kind, geometry, motion.setpoint, self._pose)
        self.known = step < SETTLED
        if math.isnan(step):
            self.lose(geometry, motion.setpoint)

    def limit(
        self,
        geometry: Sequence[float],
        motion: Motion,
        speed: float,
        slow: Sequence[float],
        homed: bool,
        dt: float,
    ) -> None:
        """Make the next `dt` so slow that the tool keeps its `speed`; where its pose is not known, that no joint is
        faster than `slow`."""
        ways = [there - here for there, here in zip(motion.target, motion.setpoint, strict=True)]
        if self.known and self._look_left <= 0.0:
            self.known = homed and self._look(geometry, motion, ways, speed, max(LOOK_S, dt))
            self._look_left = LOOK_S
        if not self.known:
            motion.time_left = max(motion.time_left, *(abs(way) / v for way, v in zip(ways, slow, strict=True)))
            return
        step = min(dt, motion.time_left)
        self._pose = [here + step * v for here, v in zip(self._pose, self._velocity, strict=True)]
        self._look_left -= dt

    def _look(
        self, geometry: Sequence[float], motion: Motion, ways: Sequence[float], speed: float, look_s: float
    ) -> bool:
        """Find the tool's velocity, and slow the motion down to its limit. False at a singularity."""
        share = min(look_s / motion.time_left, 1.0)
        farthest = max(map(abs, ways[: self._curved]))
        probe = PROBE / farthest if farthest * share > PROBE else share
        ahead = list(self._pose)
        joints = [here + probe * way for here, way in zip(motion.setpoint, ways, strict=True)]
        if math.isnan(forward_step(self._kind, geometry, joints, ahead)):
            return False
        probe_s = probe * motion.time_left
        self._velocity = [(there - here) / probe_s for here, there in zip(self._pose, ahead, strict=True)]
        excess = math.hypot(*self._velocity[:3]) / speed
        if excess > 1.0:
            motion.time_left *= excess
            self._velocity = [v / excess for v in self._velocity]
        return True
