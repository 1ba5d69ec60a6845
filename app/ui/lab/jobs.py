"""What worker processes do for the control lab: plain functions of plain data. Nothing here may import viser."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

from app.control import PID_APPROX, Pid
from app.control.tuning.methods import METHODS, TABLE_3, Wish
from app.control.tuning.reaction_curve import TuningError
from app.motion import PATHS
from app.simulation import Run, Task, TrackingError, follow_sampled, follow_simulink
from app.simulation.hardware import Hardware
from app.simulation.step_study import Study, study
from app.ui.lab.settings import STARTS, ControlSettings, default_settings
from app.ui.refusal import Refusal

PAPER_LIMIT_PERCENT = 100.0


class Answer(NamedTuple):
    """What came of some settings."""

    settings: ControlSettings
    """As asked, with the gains that their tuning method gives."""
    note: str
    """What the tuning method has to say, for students."""
    refused: bool
    """Whether it does not apply; the gains are then those from before."""
    study: Study


def answer(settings: ControlSettings) -> Answer:
    """Tune, where a method is chosen, and study the loop."""
    note, refused = "", False
    try:
        settings, note = tuned(settings)
    except TuningError as error:
        note, refused = str(error), True
    return Answer(settings, note, refused, study(settings.question))


def tuned(settings: ControlSettings) -> tuple[ControlSettings, str]:
    """The settings with the gains of their tuning method, and what that has to say.

    Raises `TuningError` where the method does not apply.
    """
    if settings.tuning not in METHODS:
        return settings, ""
    wish = Wish(settings.response_time_s, settings.transient, settings.sampling.period_s)
    found = METHODS[settings.tuning].tune(settings.motor, wish)
    return replace(settings, pid=replace(found.pid, b=settings.pid.b, c=settings.pid.c)), found.note


def run_robot(settings: ControlSettings, dimensions: dict[str, float]) -> Run | Refusal:
    """All drives of the robot follow the chosen path once."""
    try:
        settings, _ = tuned(settings)
    except TuningError as error:
        return Refusal(str(error))
    wanted = settings.run
    task = Task(settings.robot, dimensions, wanted.tour, wanted.tour.lap_s, wanted.start)
    title = run_title(settings)
    try:
        if wanted.as_in_paper:
            run = follow_simulink(task, _as_printed(settings), PAPER_LIMIT_PERCENT, title=title)
        else:
            run = follow_sampled(task, settings.motor, settings.pid, settings.sampling, settings.hardware, title)
    except TrackingError as error:
        return Refusal(str(error))
    assert run.pose.shape == run.pose_ref.shape, "computed here, not on the event loop"
    return run


def _as_printed(settings: ControlSettings) -> Pid:
    """Table 3 prints no filter; a board needs one, the paper's simulation had none."""
    return PID_APPROX if settings.tuning == TABLE_3 else settings.pid


def run_title(settings: ControlSettings) -> str:
    """What distinguishes this run from the next one."""
    wanted, hardware = settings.run, settings.hardware
    if wanted.as_in_paper:
        how = "as in the paper"
    else:
        supply = f"{hardware.supply_v:g} V" if math.isfinite(hardware.supply_v) else "no limit"
        how = f"{STARTS[wanted.start].lower()}, {supply}"
        if hardware != Hardware(supply_v=hardware.supply_v, sensor_range=hardware.sensor_range):
            how += ", with disturbances"
    return f"{PATHS[wanted.tour.path].title}, {settings.controller_name}, {how}"


def run_csv(run: Run) -> bytes:
    """A run as a file."""
    return run.csv().encode()


def warm_up() -> None:
    """Load what the first answer needs, before someone waits for it."""
    answer(default_settings("par4"))
