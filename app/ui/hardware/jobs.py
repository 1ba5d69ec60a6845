"""What worker processes do for the tab Hardware: plain functions of plain data. Nothing here may import viser."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.errors import UserMistake
from app.link.ports import Port, list_ports
from app.link.programs import Program
from app.link.twin.recording import Recording
from app.robots import build_robot
from app.simulation import Run
from app.ui.lab.motor_jobs import Identified
from app.ui.refusal import Refusal

if TYPE_CHECKING:
    from app.control import Motor
    from app.link.protocol.messages import Identity, Test
    from app.link.twin.compare import TwinComparison
    from app.link.twin.steps import MeasuredStep
    from app.ui.drawing.jobs import Sketch


def ports() -> list[Port]:
    """Of this computer, and the emulated boards."""
    return list_ports()


def drawing_program(drawing: Sketch) -> Program | Refusal:
    """A drawing with its pen or laser, at full rate."""
    from app.drawing.toolpath import plan_toolpath

    setup = drawing.setup
    try:
        robot = build_robot(setup.robot, setup.dimensions)
        path = plan_toolpath(drawing.strokes, robot, setup.placement, setup.pen)
        return Program.from_toolpath(path, setup.robot, "Drawing", setup.pen)
    except (UserMistake, ValueError) as error:
        return Refusal(str(error))


def run_program(run: Run) -> Program | Refusal:
    """Where the joints should have been in a run of the control lab, with the pen up."""
    k = len(run.t)
    try:
        return Program(run.title, run.robot, run.t - run.t[0], run.q_ref, np.zeros(k, bool), np.zeros(k))
    except UserMistake as error:
        return Refusal(str(error))


def read_recording(content: bytes) -> Recording | Refusal:
    """A file that was saved here."""
    try:
        return Recording.from_csv(content.decode("utf-8-sig"))
    except UnicodeDecodeError:
        return Refusal("This is no text file: choose a recording that was saved as CSV.")
    except UserMistake as error:
        return Refusal(str(error))


def recording_csv(recording: Recording) -> bytes:
    """A recording as a file."""
    return recording.csv().encode()


def compare_with_twin(
    recording: Recording, identity: Identity | None, settings: dict[int, float], motor: Motor | None
) -> TwinComparison | Refusal:
    """What the simulation makes of the same set-points."""
    from app.link.twin.compare import compare
    from app.link.twin.model import board_twin

    if identity is None:
        return Refusal("Connect the board that was recorded: its gains are needed for the twin.")
    try:
        return compare(recording, board_twin(recording.robot, identity.drive, identity.period_us, settings, motor))
    except UserMistake as error:
        return Refusal(str(error))


def identify_motor(pulses: list[Recording]) -> Identified | Refusal:
    """The motor of a joint, as the control lab shows it."""
    from app.link.twin.identify import identify_drive

    try:
        recording, found = identify_drive(pulses)
    except UserMistake as error:
        return Refusal(str(error))
    joint = pulses[0].samples.joint + 1 if pulses[0].samples else 0
    return Identified(recording, found, f"Pulses of joint {joint}")


def step_response(recording: Recording, test: Test, duty_max: float) -> MeasuredStep | Refusal:
    """The step of a test in numbers."""
    from app.link.twin.steps import measured_step

    try:
        return measured_step(recording, test, duty_max)
    except UserMistake as error:
        return Refusal(str(error))
