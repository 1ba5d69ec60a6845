"""What worker processes do to identify a motor: plain functions of plain data. Nothing here may import viser."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.control.drives import DRIVES
from app.control.identification import Identification, IdentificationError, identify
from app.control.identification.excitation import EXCITATIONS, pulses
from app.control.identification.recordings import Recording, RecordingError, read_recording
from app.simulation.hardware import FINE_STEP_S, Hardware, sensor, shaft
from app.ui.refusal import Refusal

PERIOD_S = 0.01


class MotorTest(NamedTuple):
    """How the motor is to be moved, and read."""

    excitation: str
    """Key of `EXCITATIONS`."""
    amplitude_v: float
    duration_s: float
    noise: float
    """Standard deviation of the reading, in the drive's unit."""
    seed: int


class Identified(NamedTuple):
    """A recording, and the motor found in it."""

    recording: Recording
    found: Identification
    source: str
    """Where the recording comes from, for students."""


def move_and_identify(robot: str, hardware: Hardware, test: MotorTest) -> Identified | Refusal:
    """Move the robot's own motor, with the imperfections that are switched on, and find its model."""
    try:
        recording = record(robot, hardware, test)
        found = identify(recording.t, recording.u, recording.y, unit=recording.unit)
    except (IdentificationError, ValueError) as error:
        return Refusal(_sentence(error))
    return Identified(recording, found, f"{EXCITATIONS[test.excitation].title}, {test.duration_s:g} s")


def read_and_identify(name: str, content: bytes) -> Identified | Refusal:
    """Find the motor in a file of times, voltages and positions."""
    try:
        recording = read_recording(content)
        found = identify(recording.t, recording.u, recording.y, unit=recording.unit, initial_state="estimated")
    except (RecordingError, IdentificationError) as error:
        return Refusal(_sentence(error))
    return Identified(recording, found, name)


def record(robot: str, hardware: Hardware, test: MotorTest) -> Recording:
    """What the board would have logged."""
    motor = DRIVES[robot].motor
    if test.excitation == "pulses":
        t, u = pulses(test.amplitude_v, test.duration_s, PERIOD_S, motor=motor)
    else:
        t, u = EXCITATIONS[test.excitation].signal(test.amplitude_v, test.duration_s, PERIOD_S)
    noisy = replace(hardware, noise=test.noise)
    turn = shaft(motor, noisy, FINE_STEP_S)
    read = sensor(noisy, test.seed, len(t))
    y = np.empty(len(t))
    position = 0.0
    for k, volts in enumerate(np.clip(u, -hardware.supply_v, hardware.supply_v).tolist()):
        y[k] = read(position)
        for _ in range(round(PERIOD_S / FINE_STEP_S)):
            position = turn(volts)
    return Recording(t, u, y, motor.unit)


def thinned(recording: Recording, points: int) -> NDArray[np.intp]:
    """Indices of about this many samples."""
    return np.arange(0, len(recording.t), max(1, len(recording.t) // points))


def _sentence(error: Exception) -> str:
    text = str(error)
    return text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".")
