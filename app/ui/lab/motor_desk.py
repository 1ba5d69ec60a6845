"""The motor's test of one browser: how it is moved, and which model was found in the recording. No widgets here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from app.control.drives import DRIVES
from app.robots import Robot
from app.signal import Signal
from app.ui.compute import Worker
from app.ui.lab.desk import ControlDesk
from app.ui.lab.motor_jobs import Identified, MotorTest, move_and_identify, read_and_identify
from app.ui.refusal import Refusal
from app.ui.session import Session

BY_YOU = "Identified by you"


@dataclass(frozen=True)
class TestSettings:
    """How the motor is to be moved and read; noise in the drive's unit."""

    amplitude_v: float
    excitation: str = "prbs"
    """Key of `EXCITATIONS`."""
    duration_s: float = 60.0
    noise: float = 0.5

    __test__ = False


class MotorDesk:
    """The state behind the panel `Motor`."""

    def __init__(self, session: Session, desk: ControlDesk, hire: Callable[[Callable[[], None]], Worker]) -> None:
        """
        Args:
            hire: makes a worker; what it is given hears of failures.
        """
        self.settings_changed: Signal[TestSettings] = Signal()
        self.busy_changed: Signal[bool] = Signal()
        self.answered: Signal[Identified | Refusal] = Signal()
        self._desk = desk
        self._worker = hire(lambda: self.busy_changed.emit(False))
        self._robot = session.robot_name
        self._seed = 0
        self.settings = TestSettings(DRIVES[session.robot_name].supply_v)
        self.result: Identified | None = None
        """The newest that could be identified, of this robot."""
        self.refusal: Refusal | None = None
        """Why the last one could not."""
        self.tested: TestSettings | None = None
        """With which `result` was recorded; None for a file's."""
        self.count = 0
        """Motors identified so far."""
        session.robot_changed.connect(self._follow_robot)

    @property
    def known(self) -> str:
        """The robot whose motor is moved."""
        return self._desk.settings.robot

    def change(self, **values: object) -> None:
        """Set some values of the test."""
        self.settings = replace(self.settings, **values)  # type: ignore[arg-type]
        self.settings_changed.emit(self.settings)

    def record(self) -> None:
        """Move the motor as it is set, and find its model; each time with other noise."""
        self._seed += 1
        one, lab = self.settings, self._desk.settings
        test = MotorTest(one.excitation, one.amplitude_v, one.duration_s, one.noise, self._seed)
        self._ask(one, move_and_identify, lab.robot, lab.hardware, test)

    def read(self, name: str, content: bytes) -> None:
        """Find the motor in a file."""
        self._ask(None, read_and_identify, name, content)

    def use(self) -> None:
        """Take the motor that was found for the lab."""
        if self.result is not None:
            origin = f"{BY_YOU} from {self.result.source}; Reset the lab brings the old one back."
            self._desk.change(motor=self.result.found.motor, motor_origin=origin)

    def forget(self) -> None:
        """Nothing was identified yet."""
        self._worker.cancel()
        self.busy_changed.emit(False)
        self.result = self.refusal = self.tested = None
        self.count = 0
        self.settings_changed.emit(self.settings)

    def _ask(self, test: TestSettings | None, job: Callable[..., Identified | Refusal], *arguments: object) -> None:
        self.busy_changed.emit(True)
        self._worker.request(lambda result: self._receive(test, result), job, *arguments)

    def _receive(self, test: TestSettings | None, result: Identified | Refusal) -> None:
        self.busy_changed.emit(False)
        if isinstance(result, Refusal):
            self.refusal = result
        else:
            self.result, self.refusal, self.tested = result, None, test
            self.count += 1
        self.answered.emit(result)

    def _follow_robot(self, robot: Robot) -> None:
        """Another robot has another motor."""
        if robot.name != self._robot:
            self._robot = robot.name
            self.forget()
            self.change(amplitude_v=DRIVES[robot.name].supply_v)
