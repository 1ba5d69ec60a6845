"""What worker processes do to compare controllers: plain functions of plain data. Nothing here may import viser."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import numpy as np

from app.errors import UserMistake
from app.motion import MotionError
from app.robots import GeometryError, build_robot
from app.simulation import TrackingError
from app.ui.compare.score import Score, score_of
from app.ui.compare.settings import CompareSettings
from app.ui.refusal import Refusal

if TYPE_CHECKING:
    from app.motion import Motion
    from app.simulation.closed_loop import Experiment
    from app.simulation.controlled_run import ControlledRun

KEPT_HZ = 1000.0
"""What is kept of a run for plots, playback and files; its figures are those of every sample."""


@dataclass(frozen=True, eq=False)
class Result:
    """What one law made of the task."""

    law: str
    run: ControlledRun
    """At `KEPT_HZ` at most."""
    score: Score


def run_law(
    settings: CompareSettings, law: str, dimensions: dict[str, float], planned: Motion | None
) -> Result | Refusal:
    """One law at the task that the settings describe."""
    from app.control.laws import TuningError
    from app.simulation.closed_loop import simulate

    try:
        run = simulate(experiment(settings, law, dimensions, planned))
    except (UserMistake, TrackingError, TuningError, MotionError, GeometryError) as error:
        return Refusal(str(error))
    robot = build_robot(settings.robot, dimensions)
    return Result(law, thinned(run), score_of(run, robot.pose_names))


def experiment(settings: CompareSettings, law: str, dimensions: dict[str, float], planned: Motion | None) -> Experiment:
    """What the settings mean for one law."""
    from app.control.laws import Tuning

    hertz = settings.bandwidth_of(law)
    base = _task(settings, law, planned)
    return base.changed(
        dimensions=dimensions,
        tuning=base.tuning if hertz is None else Tuning.equal(settings.robot, law, hertz),
        plant=settings.plant,
        friction=settings.friction,
        payload_kg=base.payload_kg + settings.payload_kg,
        model_error=settings.model_error,
        encoder_step=settings.encoder_step,
        delay_samples=settings.delay_samples,
        velocity_filter_hz=settings.velocity_filter_hz,
        limit_effort=settings.limit_effort,
        limit_speed=settings.limit_speed,
    )


def _task(settings: CompareSettings, law: str, planned: Motion | None) -> Experiment:
    """The paper's experiment or the planned motion, everything else ideal."""
    from app.simulation.closed_loop import Experiment
    from app.simulation.helix import HELICES, helix_experiment
    from app.simulation.work_cycle import cycle_experiment

    if settings.task in HELICES:
        return helix_experiment(law, settings.task)
    return cycle_experiment(law, settings.task) if planned is None else Experiment.of_motion(planned, law)


def thinned(run: ControlledRun) -> ControlledRun:
    """The run at `KEPT_HZ` at most."""
    samples = len(run.t)
    step = max(1, round(1.0 / (KEPT_HZ * (run.t[1] - run.t[0]))))
    if step == 1:
        return run
    shorter = {}
    for field in fields(run):
        value = getattr(run, field.name)
        if isinstance(value, np.ndarray) and value.shape[:1] == (samples,):
            shorter[field.name] = value[::step].copy()
    components = {name: part[::step].copy() for name, part in run.components.items()}
    return replace(run, **shorter, components=components)


def comparison_csv(runs: list[ControlledRun]) -> bytes:
    """Every kept sample of every run, one run below the other; the first column names the law."""
    lines: list[str] = []
    for run in runs:
        head, *rows = run.csv().splitlines()
        lines += [] if lines else [f"law,{head}"]
        lines += [f"{run.law},{row}" for row in rows]
    return "\n".join([*lines, ""]).encode()
