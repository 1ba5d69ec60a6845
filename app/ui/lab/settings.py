"""What a student has set in the control lab. Immutable: a change makes a new one."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from app.control import PID_AUTO, Motor, Pid
from app.control.drives import DRIVES
from app.control.sampled_pid import Sampling
from app.control.tuning.methods import METHODS, TABLE_2, TUNER, Wish
from app.motion import Tour
from app.simulation.hardware import Hardware
from app.simulation.sampled_loop import DriveLoop
from app.simulation.step_study import Question
from app.simulation.tracking import Start

BY_HAND = "By hand"

STARTS: dict[Start, str] = {"rest": "From rest", "reference": "On the path", "smooth": "Smooth start (5 s)"}
"""Start of a run -> what students read."""


@dataclass(frozen=True)
class RunSettings:
    """How the robot is to run."""

    tour: Tour = field(default_factory=Tour)
    start: Start = "rest"
    as_in_paper: bool = False
    """The paper's own simulation in place of the sampled one."""


@dataclass(frozen=True)
class ControlSettings:
    """One drive of one robot, its controller, and the experiment. Voltages, and the drive's unit (deg or mm)."""

    robot: str
    motor: Motor
    motor_origin: str
    """Where the motor's numbers come from, for students."""
    pid: Pid
    tuning: str
    """Name of the tuning method, or `BY_HAND`."""
    sampling: Sampling
    hardware: Hardware
    setpoint: float
    duration_s: float = 3.0
    response_time_s: float = 0.2
    """Of the tuner: 2 / crossover."""
    transient: float = 0.8
    """Of the tuner: 0 quick, 1 calm."""
    run: RunSettings = field(default_factory=RunSettings)

    @property
    def question(self) -> Question:
        """The step experiment that these settings describe."""
        loop = DriveLoop(self.motor, self.pid, self.sampling, self.hardware)
        return Question(loop, self.setpoint, self.duration_s)

    @property
    def controller_name(self) -> str:
        """For titles."""
        if self.tuning != BY_HAND:
            return self.tuning
        return f"PID ({self.pid.kp:.3g}, {self.pid.ki:.3g}, {self.pid.kd:.3g})"


RUN_SIZES_M = {"par4": 0.1, "delta3": 0.1, "linear": 0.08, "fivebar": 0.06}
"""Radius of a path that lies well within reach of the default geometry."""


def default_settings(robot: str) -> ControlSettings:
    """A good starting point: the drive as its board runs it, without disturbances."""
    drive = DRIVES[robot]
    is_par4 = robot == "par4"
    response_time_s, transient = 0.2 if is_par4 else 0.08, 0.8
    tuner = METHODS[TUNER].tune(drive.motor, Wish(response_time_s, transient))
    return ControlSettings(
        robot=robot,
        motor=drive.motor,
        motor_origin=drive.note,
        pid=PID_AUTO if is_par4 else tuner.pid,
        tuning=TABLE_2 if is_par4 else TUNER,
        sampling=Sampling(drive.period_s),
        hardware=Hardware(supply_v=drive.supply_v, sensor_range=drive.sensor_range),
        setpoint=drive.setpoint,
        duration_s=3.0 if is_par4 else 1.0,
        response_time_s=response_time_s,
        transient=transient,
        run=RunSettings(
            Tour(size_m=RUN_SIZES_M[robot], lap_s=100.0 if is_par4 else 10.0), "rest" if is_par4 else "smooth"
        ),
    )


def changed(settings: ControlSettings, **values: object) -> ControlSettings:
    """A copy with some values replaced, wherever in the settings they live. `by_hand` gains end a tuning method."""
    parts: dict[str, object] = {}
    for part in ("pid", "sampling", "hardware", "run"):
        mine = {name: values.pop(name) for name in list(values) if name in getattr(settings, part).__dataclass_fields__}
        if mine:
            parts[part] = replace(getattr(settings, part), **mine)
    if tour := {name: values.pop(name) for name in list(values) if name in Tour.__dataclass_fields__}:
        run = parts.get("run", settings.run)
        assert isinstance(run, RunSettings)
        parts["run"] = replace(run, tour=replace(run.tour, **tour))
    return replace(settings, **parts, **values)  # type: ignore[arg-type]
