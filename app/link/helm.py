"""The ways in which the holder moves the robot, and how each of them ends."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import Future

from app.link.errors import LinkError
from app.link.motions.axis import JogMotion, StepMotion
from app.link.motions.bounds import Bounds
from app.link.motions.course import Course
from app.link.motions.mirror import MirrorMotion
from app.link.motions.motion import Joints, Motion
from app.link.motions.spaces import check_axis
from app.link.mover import Mover
from app.link.programs import Jog, Program
from app.link.status import Activity

JOG_LEASE_S = 0.125
"""The page renews a jog every 50 ms; without, the robot halts."""

SAME_PRESS_S = 0.3
"""Renewals closer than this belong to one press of the button. What ended a press is not undone by the next one."""

NOT_HOMED = "The robot does not know where its tool is; home it first, or jog its joints."
PRESS_AGAIN = "The motion has ended; release the button, and press it again if all is well."


class Helm:
    """`bounds` gives those of the robot on the cable, `homed` whether its pose is known."""

    def __init__(self, mover: Mover, bounds: Callable[[], Bounds], homed: Callable[[], bool]) -> None:
        self._mover, self._bounds, self._homed = mover, bounds, homed
        self._pressed_s = -math.inf
        self._jog: Jog | None = None
        self._ended: LinkError | None = None
        """What the present press of the button was ended by."""
        self._pose: tuple[float, ...] | None = None
        """The newest of a mirroring that was not ended."""

    def jog(self, jog: Jog, now: float) -> Future[None] | None:
        """Press the button, or keep it pressed. A press that was ended by anything but its release stays ended."""
        same_press, self._pressed_s = now - self._pressed_s < SAME_PRESS_S, now
        motion = self._mover.motion
        if same_press and self._ended is not None:
            raise self._ended
        try:
            self._check_axis(jog)
            if isinstance(motion, JogMotion):
                motion.renew(jog)
            if self._mover.activity == "jog":
                self._jog = jog
                return None
            if same_press and self._jog is not None:
                raise LinkError(PRESS_AGAIN)
            answer = self._start(self._begin_jog, "jog", now, follow=True)
        except LinkError as error:
            self._ended = error
            raise
        self._jog, self._ended = jog, None
        return answer

    def jog_release(self, now: float) -> None:
        """The button is up."""
        self._pressed_s, self._jog, self._ended = -math.inf, None, None
        if self._mover.activity == "jog":
            self._mover.halt(now)

    def step(self, jog: Jog, size: float, now: float) -> Future[None]:
        """Along one axis by `size`, rad or m."""
        self._check_axis(jog)
        return self._start(lambda joints: StepMotion(self._bounds(), jog, size, joints), "step", now)

    def mirror(self, pose: tuple[float, ...], now: float) -> Future[None] | None:
        """Follow the newest pose. A mirroring that was ended otherwise begins again only after `mirror_end`."""
        motion = self._mover.motion
        if isinstance(motion, MirrorMotion):
            motion.follow(pose)
            self._pose = pose
            return None
        if not self._homed():
            raise LinkError(NOT_HOMED)
        if self._mover.activity == "mirror":
            self._pose = pose
            return None
        if self._pose is not None:
            raise LinkError("The robot does not follow any more; end the mirroring, and begin it again if all is well.")
        answer = self._start(lambda joints: MirrorMotion(self._bounds(), self._pose or pose, joints), "mirror", now)
        self._pose = pose
        return answer

    def mirror_end(self, now: float) -> None:
        """Let go of the hand."""
        self._pose = None
        if self._mover.activity == "mirror":
            self._mover.halt(now)

    def run(self, program: Program, now: float) -> Future[None]:
        """Run a program from its beginning."""
        if not (self._homed() or program.starts_manual):
            raise LinkError(NOT_HOMED)
        course = Course(program, self._bounds())
        return self._start(course.begin, "run", now)

    def pause(self, now: float) -> None:
        """Halt a program, the laser off; it can go on."""
        if self._mover.activity == "run":
            self._mover.pause(now)

    def resume(self, now: float) -> Future[None] | None:
        """Let a paused program go on where it was; None if there is none."""
        course = self._mover.paused
        if course is None:
            return None
        if not (self._homed() or course.program.starts_manual):
            raise LinkError(NOT_HOMED)
        return self._mover.start(course.begin, "run", now, follow=True)

    def let_go(self, now: float, reason: str) -> None:
        """Whoever moved the robot does not any more: halt, and forget presses and programs."""
        self._mover.halt(now, reason)
        self._pressed_s, self._jog, self._ended, self._pose = -math.inf, None, None, None

    def tick(self, now: float) -> bool:
        """The next set-point, if something moves; returns whether there was one."""
        if self._mover.activity == "jog" and now - self._pressed_s >= JOG_LEASE_S:
            self._mover.halt(now)
            self._ended = LinkError(PRESS_AGAIN)
        return self._mover.tick(now)

    def _begin_jog(self, joints: Joints) -> JogMotion:
        if self._jog is None:
            raise LinkError(PRESS_AGAIN)
        return JogMotion(self._bounds(), self._jog, joints)

    def _start(
        self, make: Callable[[Joints], Motion], activity: Activity, now: float, *, follow: bool = False
    ) -> Future[None]:
        if self._mover.paused is not None:
            raise LinkError("A program is paused; resume or cancel it first.")
        return self._mover.start(make, activity, now, follow=follow)

    def _check_axis(self, jog: Jog) -> None:
        check_axis(jog, self._bounds().robot)
        if jog.space == "pose" and not self._homed():
            raise LinkError(NOT_HOMED)
