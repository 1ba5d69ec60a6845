"""The control lab of one browser: settings, the present study, a kept baseline. No widgets here.

A change of settings asks a worker for a new study; the newest wins. Panels listen.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from app.control.tuning.methods import methods_for
from app.robots import Robot
from app.signal import Signal
from app.simulation.step_study import Study
from app.ui.compute import Worker
from app.ui.lab.jobs import Answer, answer
from app.ui.lab.settings import BY_HAND, ControlSettings, changed, default_settings
from app.ui.session import Session

GAINS = frozenset({"kp", "ki", "kd", "n"})


class Baseline(NamedTuple):
    """A study that was kept to compare with."""

    settings: ControlSettings
    study: Study


class ControlDesk:
    """The state behind every panel of the control lab."""

    def __init__(self, session: Session, worker: Worker) -> None:
        self.settings_changed: Signal[ControlSettings] = Signal()
        self.answered: Signal[Answer] = Signal()
        self._session = session
        self._worker = worker
        kept = session.control
        self.settings = kept if kept and kept.robot == session.robot_name else default_settings(session.robot_name)
        self.baseline: Baseline | None = None
        self.answer: Answer | None = None
        self.active = False
        """Whether anybody looks: until then nothing is computed."""
        session.robot_changed.connect(self._follow_robot)

    def open(self) -> None:
        """Somebody looks at the lab, maybe after others: he hears the last answer again."""
        if not self.active:
            self.active = True
            self._ask()
        elif self.answer is not None:
            self.answered.emit(self.answer)

    def change(self, **values: object) -> None:
        """Set some values; gains set by hand end a tuning method."""
        if GAINS & values.keys() and "tuning" not in values:
            values["tuning"] = BY_HAND
        settings = changed(self.settings, **values)
        if settings.tuning not in methods_for(settings.motor):
            settings = replace(settings, tuning=BY_HAND)
        self.take(settings)

    def set_run(self, **values: object) -> None:
        """Change how the robot is to run; the step experiment stays as it is."""
        self.settings = self._session.control = changed(self.settings, **values)
        self.settings_changed.emit(self.settings)

    def take(self, settings: ControlSettings) -> None:
        """Take whole settings over."""
        self.settings = self._session.control = settings
        self.settings_changed.emit(settings)
        self._ask()

    def reset(self) -> None:
        """Back to the defaults of the present robot."""
        self.keep_baseline(False)
        self.take(default_settings(self._session.robot_name))

    def keep_baseline(self, keep: bool = True) -> None:
        """Keep the present study to compare with, or forget the one that was kept."""
        study = self.answer.study if self.answer is not None else None
        self.baseline = Baseline(self.settings, study) if keep and study is not None else None
        if self.answer is not None:
            self.answered.emit(self.answer)

    def _follow_robot(self, robot: Robot) -> None:
        if robot.name != self.settings.robot:
            self.baseline = None
            self.take(default_settings(robot.name))

    def _ask(self) -> None:
        if self.active:
            self._worker.request(self._receive, answer, self.settings)

    def _receive(self, result: Answer) -> None:
        self.answer = result
        if result.settings.pid != self.settings.pid:
            self.settings = self._session.control = replace(self.settings, pid=result.settings.pid)
            self.settings_changed.emit(self.settings)
        self.answered.emit(result)
