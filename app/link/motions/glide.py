"""Along one axis, smoothly: never faster than it could stop in time."""

from __future__ import annotations

import math

from app.link.motions.motion import Joints
from app.link.motions.spaces import Space, acceleration
from app.link.programs import Jog

CRAWL = 1.001
"""Slower than this many of its changes of speed it can stop at once; without the margin, rounding leaves a rest."""

_END = "end"
_TOO_FAST = "A joint would have to turn too fast here; move along another axis."


class Glide:
    """Speeds up, brakes before an obstacle or its end."""

    def __init__(self, space: Space, jog: Jog, distance: float = math.inf) -> None:
        self._space, self._jog = space, jog
        self._acceleration = acceleration(space, jog.axis)
        self.at = space.start
        """Coordinates in the space."""
        self.speed = 0.0
        self.left = distance
        """Until its end, rad or m."""
        self.obstacle = ""
        """What it stands in front of."""

    @property
    def joints(self) -> Joints:
        return self._space.joints(self.at)

    def advance(self, dt_s: float, top: float) -> None:
        """Go on for `dt_s`, at most with the speed `top`; braking takes the time that it takes."""
        change = self._acceleration * dt_s
        slower = self.speed - change if self.speed > CRAWL * change else 0.0
        fastest = max(min(top, self.speed + change), slower)
        hindrance = ""
        for speed in (fastest, min(fastest, self.speed), slower):
            hindrance = self._hindrance(speed, dt_s) if speed else hindrance
            if speed and (not hindrance or (speed == slower and hindrance == _TOO_FAST)):
                self._set(speed, dt_s)
                return
        self.speed = 0.0
        if hindrance == _END:
            self._go(self.left)  # shorter than what one set-point covers
        self.obstacle = "" if hindrance == _END else hindrance

    def _set(self, speed: float, dt_s: float) -> None:
        self.speed, self.obstacle = speed, ""
        self._go(speed * dt_s)

    def _hindrance(self, speed: float, dt_s: float) -> str:
        """Why it must not go with this speed now: it could not stop in time, or a joint is too slow for it."""
        braking = speed * dt_s + speed * speed / (2.0 * self._acceleration)
        if braking >= self.left:
            return _END
        if obstacle := self._space.obstacle(self._ahead(braking)):
            return obstacle
        return _TOO_FAST if self._space.too_fast(self.at, self._ahead(speed * dt_s), dt_s) else ""

    def _go(self, way: float) -> None:
        self.at, self.left = self._ahead(way), self.left - way

    def _ahead(self, way: float) -> Joints:
        axis, way = self._jog.axis, self._jog.direction * way
        return (*self.at[:axis], self.at[axis] + way, *self.at[axis + 1 :])
