"""What worker processes do for a calibration: plain functions of plain data. Nothing here may import viser."""

from __future__ import annotations

from typing import NamedTuple

from app.errors import UserMistake
from app.link.calibration.measurements import Measurements
from app.link.calibration.next_poses import NextPoses, next_poses
from app.link.calibration.problem import KINEMATIC, Problem, make_problem
from app.link.calibration.report import Row, rows, sentences
from app.link.calibration.solve import Solution, solve
from app.robots import Robot
from app.ui.refusal import Refusal


class Wish(NamedTuple):
    """What is looked for."""

    robot: str
    nominal: dict[str, float]
    """Dimensions of the robot as the board has it, m and rad."""
    offsets: bool
    dimensions: tuple[str, ...]
    frame: tuple[str, ...]
    accuracy_m: float
    """Of a measured coordinate."""

    @property
    def problem(self) -> Problem:
        return make_problem(
            self.robot,
            offsets=self.offsets,
            dimensions=self.dimensions,
            frame=self.frame,
            nominal=self.nominal,
            noise_m=self.accuracy_m,
        )


class Calibrated(NamedTuple):
    """What came of it, and where to measure next."""

    solution: Solution
    rows: list[Row]
    sentences: list[str]
    next: NextPoses


def nominal_of(robot: Robot) -> dict[str, float]:
    """The dimensions on which the pose depends."""
    return {name: float(getattr(robot.geometry, name)) for name in KINEMATIC[robot.name]}


def calibrate(wish: Wish, measurements: Measurements) -> Calibrated | Refusal:
    """The most likely machine."""
    try:
        solution = solve(wish.problem, measurements)
        following = next_poses(solution.problem, solution.values, solution.information)
        return Calibrated(solution, rows(solution), sentences(solution), following)
    except UserMistake as error:
        return Refusal(str(error))


def propose(wish: Wish) -> NextPoses | Refusal:
    """Where to begin."""
    try:
        return next_poses(wish.problem, count=6)
    except UserMistake as error:
        return Refusal(str(error))


def read_measurements(robot: str, content: bytes) -> Measurements | Refusal:
    """A file of measured poses."""
    try:
        return Measurements.from_csv(robot, content.decode("utf-8-sig"))
    except UnicodeDecodeError:
        return Refusal("This is no text file: choose a table that was saved as CSV.")
    except UserMistake as error:
        return Refusal(str(error))
