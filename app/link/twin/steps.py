"""The step response of a real joint, in the numbers of the control lab."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.control.step_metrics import StepMetrics, step_metrics
from app.link.errors import LinkError
from app.link.protocol.codes import TestKind
from app.link.protocol.messages import Test
from app.link.twin.recording import Recording
from app.robots import ROBOTS
from app.simulation.run import SHOWN

FEWEST = 20


class MeasuredStep(NamedTuple):
    """A step from 0, in deg or mm and volts, on an even grid."""

    t: NDArray[np.float64]
    """(k,) s, from 0"""
    y: NDArray[np.float64]
    """(k,)"""
    u: NDArray[np.float64]
    """(k,) V"""
    setpoint: float
    unit: str
    metrics: StepMetrics


def measured_step(recording: Recording, test: Test, duty_max: float = 1.0) -> MeasuredStep:
    """The samples of a TEST step; LinkError where there are none. `duty_max`: the board's limit of its output."""
    samples = recording.samples
    if test.kind != TestKind.STEP or samples is None or samples.joint != test.joint or len(samples.t) < FEWEST:
        raise LinkError("There are too few samples of this step; run the step test again, for at least 0.2 s.")
    if not test.amplitude:
        raise LinkError("A step of 0 shows nothing; choose another height.")
    unit, factor = SHOWN[ROBOTS[recording.robot].build.joint_unit]
    t = np.linspace(samples.t[0], samples.t[-1], len(samples.t))
    y = factor * (np.interp(t, samples.t, samples.position) - samples.position[0])
    u = recording.supply_v * np.interp(t, samples.t, samples.drive)
    setpoint, elapsed = factor * test.amplitude, t - t[0]
    metrics = step_metrics(elapsed, y, setpoint, u, duty_max * recording.supply_v)
    return MeasuredStep(elapsed, y, u, setpoint, unit, metrics)
