"""The motion desk of one browser: what the robot shall do, the plan of it, and what is played. No widgets here.

A change of settings asks a worker for a new plan; the newest wins. What cannot be done leaves the last motion as it is.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from app.motion import CYCLES, Motion, MotionSettings, WorkCycle, default_motion
from app.robots import Robot
from app.signal import Signal
from app.ui.compute import Worker
from app.ui.motion import jobs
from app.ui.playback import Playback
from app.ui.refusal import Refusal
from app.ui.session import Session
from app.ui.state import MotionMemory

WITH_CYCLE = "fivebar"
"""The robot that picks and places between two belts."""

SLOW_PROFILES = frozenset({"time-optimal"})
"""These take a second and more: nobody else's slider waits for them."""


FIRST_SPEED = 0.5
"""At which a motion is played: most take a second or two."""


class MotionDesk:
    """The state behind every panel of the tab Motion."""

    def __init__(self, session: Session, quick: Worker, thorough: Worker) -> None:
        self.settings_changed: Signal[MotionSettings | WorkCycle] = Signal()
        self.planned: Signal[Motion] = Signal()
        """Another motion is shown; all is well again."""
        self.refused: Signal[str] = Signal()
        """Why the newest settings cannot be: one sentence. `motion` stays the last one that could."""
        self.playback = Playback(session)
        """The only thing of this tab that moves the robot: motions and simulated runs are loaded here."""
        self._session = session
        self._quick, self._thorough = quick, thorough
        memory = session.motion
        self.course: MotionSettings = memory.course if memory else default_motion(session.robot_name)
        """The motion along a curve, also while a work cycle is shown."""
        self.cycle: WorkCycle = memory.cycle if memory else next(iter(CYCLES.values()))
        """The work cycle, also while another motion is shown."""
        self.cycling = bool(memory and memory.cycling)
        """Whether the work cycle is shown."""
        self.motion: Motion | None = None
        """The last that could be planned for this robot; None before the first."""
        self.refusal = ""
        """Why the present settings cannot be; empty when they can or are being planned."""
        self._open = False
        self._fit(session.robot)
        session.robot_changed.connect(self._follow_robot)

    @property
    def settings(self) -> MotionSettings | WorkCycle:
        """What is shown, or asked for."""
        return self.cycle if self.cycling else self.course

    @property
    def robot(self) -> Robot:
        return self._session.robot

    @property
    def planning(self) -> bool:
        return self._quick.busy or self._thorough.busy

    def open(self) -> None:
        """Somebody looks at the tab: until then nothing is computed. Who comes later hears the last answer again."""
        if not self._open:
            self.look()
        elif self.refusal:
            self.refused.emit(self.refusal)
        elif self.motion is not None:
            self.planned.emit(self.motion)

    def look(self) -> None:
        """Somebody wants to know what comes of the settings."""
        if not self._open:
            self._open = True
            self._ask()

    def change(self, **values: Any) -> None:
        """Set some values of the motion along a curve, and show that."""
        self.course = replace(self.course, **values)
        self._keep(cycling=False)

    def change_cycle(self, **values: Any) -> None:
        """Set some values of the work cycle, and show that."""
        self.take_cycle(replace(self.cycle, **values))

    def take_cycle(self, cycle: WorkCycle) -> None:
        """Take a whole work cycle over, and show it."""
        self.cycle = cycle
        self._fit(self.robot)
        self._keep(cycling=True)

    def show_cycle(self, on: bool) -> None:
        """Show the work cycle, or the motion along a curve again."""
        self._keep(cycling=on)

    def reset(self) -> None:
        """Back to the defaults of this robot."""
        self.course = default_motion(self._session.robot_name)
        self.cycle = next(iter(CYCLES.values()))
        self._fit(self.robot)
        self._keep(cycling=self.cycling)

    def close(self) -> None:
        self.playback.pause()

    def _keep(self, cycling: bool) -> None:
        self.cycling = cycling and self._session.robot_name == WITH_CYCLE
        self._session.motion = MotionMemory(self.course, self.cycle, self.cycling)
        self.settings_changed.emit(self.settings)
        self._ask()

    def _ask(self) -> None:
        if not self._open:
            return
        if self.cycling:
            self._thorough.cancel()
            self._quick.request(self._receive, jobs.plan_cycle, self.cycle)
            return
        takes_long = self.course.profile in SLOW_PROFILES
        worker, other = (self._thorough, self._quick) if takes_long else (self._quick, self._thorough)
        other.cancel()
        worker.request(self._receive, jobs.plan, self.course)

    def _receive(self, result: Motion | Refusal) -> None:
        if isinstance(result, Refusal):
            self.refusal = result.reason
            self.refused.emit(result.reason)
            return
        self.refusal, self.motion = "", result
        self._load(result)
        self.planned.emit(result)

    def _load(self, motion: Motion) -> None:
        """To be played; a robot that is moving goes on from the same share of the new motion."""
        playback = self.playback
        going_on, speed = playback.playing, FIRST_SPEED if playback.run is None else playback.speed
        share = playback.time_s / playback.duration_s if going_on else 0.0
        playback.load(motion, speed)
        if going_on:
            playback.time_s = share * playback.duration_s
            playback.play()

    def _follow_robot(self, robot: Robot) -> None:
        self.playback.load(None)
        self.motion = None
        self._fit(robot)
        self._keep(self.cycling)

    def _fit(self, robot: Robot) -> None:
        """Sizes suit a robot: another one starts with its own. Its dimensions are the session's."""
        dimensions = dict(self._session.dimensions)
        if self.course.robot != robot.name:
            self.course = replace(default_motion(robot.name), **_chosen(self.course))
        self.course = replace(self.course, dimensions=dimensions)
        if robot.name == WITH_CYCLE:
            self.cycle = replace(self.cycle, dimensions=dimensions)
        self.cycling = self.cycling and robot.name == WITH_CYCLE


def _chosen(course: MotionSettings) -> dict[str, Any]:
    """Curve and profile where somebody has chosen them."""
    usual = default_motion(course.robot)
    names = ("curve", "profile")
    return {name: getattr(course, name) for name in names if getattr(course, name) != getattr(usual, name)}
