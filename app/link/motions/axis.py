"""Along one axis for as long as a button is pressed, or by one step."""

from __future__ import annotations

import math

from app.link.errors import LinkError
from app.link.motions.bounds import Bounds
from app.link.motions.glide import Glide
from app.link.motions.motion import Joints, Target
from app.link.motions.spaces import space_of
from app.link.programs import Jog
from app.link.status import Activity


class JogMotion:
    """Goes on until it is given up; another axis or direction is taken once it has braked."""

    activity: Activity = "jog"
    finished = False

    def __init__(self, bounds: Bounds, jog: Jog, joints: Joints) -> None:
        self._bounds = bounds
        self._jog = self._next = jog
        self._space = space_of(jog, bounds, joints)
        self._glide = Glide(self._space, jog)

    @property
    def notice(self) -> str:
        return self._glide.obstacle

    def renew(self, jog: Jog) -> None:
        """The button is still pressed, or another one is."""
        self._next = jog

    def advance(self, dt_s: float, share: float) -> Target:
        if self._turns() and not self._glide.speed:
            self._space = space_of(self._next, self._bounds, self._glide.joints)
            self._glide = Glide(self._space, self._next)
            self._jog = self._next
        wanted = 0.0 if self._turns() else share * self._next.speed
        self._glide.advance(dt_s, min(wanted, self._space.top_speed(self._jog.axis)))
        return Target(self._glide.joints)

    def _turns(self) -> bool:
        before, then = self._jog, self._next
        return (before.space, before.axis, before.direction) != (then.space, then.axis, then.direction)


class StepMotion:
    """By a distance, rad or m; refused at once where its end is out of reach."""

    activity: Activity = "step"

    def __init__(self, bounds: Bounds, jog: Jog, size: float, joints: Joints) -> None:
        if not (math.isfinite(size) and size > 0.0):
            raise LinkError("A step needs a size above 0; choose one.")
        space = space_of(jog, bounds, joints)
        end = list(space.start)
        end[jog.axis] += jog.direction * size
        if obstacle := space.obstacle(end):
            raise LinkError(f"There is no room for that step. {obstacle}")
        self._glide = Glide(space, jog, size)
        self._top = min(jog.speed, space.top_speed(jog.axis))

    @property
    def finished(self) -> bool:
        return self._glide.left <= 0.0 or bool(self.notice)

    @property
    def notice(self) -> str:
        return self._glide.obstacle

    def advance(self, dt_s: float, share: float) -> Target:
        self._glide.advance(dt_s, share * self._top)
        return Target(self._glide.joints)
