"""Tests of one real joint: its step response, and the motor that its answers to pulses show."""

from __future__ import annotations

from collections.abc import Callable

import viser

from app.control.drives import DRIVES
from app.control.motor import Motor
from app.link.errors import LinkError
from app.link.protocol.codes import DriveKind, TestKind
from app.link.protocol.messages import Test
from app.link.protocol.settings import setting_id
from app.link.status import LinkStatus
from app.link.twin.pulses import pulse_plan
from app.link.twin.recording import Recording
from app.link.twin.steps import MeasuredStep
from app.ui import theme
from app.ui.compute import Worker
from app.ui.hardware import jobs
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.pulse_series import PulseSeries
from app.ui.hardware.verbs import not_free
from app.ui.lab.motor_jobs import Identified
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.lab.motor_panel import MotorPlots, result_table
from app.ui.panels.options import show_options
from app.ui.panels.tables import table
from app.ui.panels.text import small
from app.ui.panels.units import SHOWN_UNIT, si
from app.ui.plots import DASHED, Axes, Curve, Plot
from app.ui.refusal import Refusal

ABOUT = "Short tests that respect the joint limits. The robot moves: keep clear, and home it first."
ONLY_DC = "Only DC motors with a sensor can be tested: hobby servos and steppers report nothing."
NO_JOINT: str = "No board"
STEP_MS = 1500

UseMotor = Callable[[str, Motor, str], str]
"""Gives a robot's motor, and where it comes from, to the control lab; returns why not, or nothing."""


class DrivePanel:
    """The tab `Drive`."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk, worker: Worker, use: UseMotor) -> None:
        self._desk = desk
        self._worker = worker
        self._use = use
        self._series = PulseSeries(desk, self._identify, self.failed)
        self._result: tuple[str, Identified] | None = None
        gui = client.gui
        gui.add_html(small(ABOUT))
        self._joint = gui.add_dropdown("Joint tested", (NO_JOINT,))
        self._height = gui.add_slider("Step height (° or mm)", -20.0, 20.0, 0.5, 5.0)
        self._grid = ButtonGrid(client, "Drive", self._press, desk.tell)
        self._said = gui.add_html("")
        self._step_place = gui.add_folder(None, visible=False)
        with self._step_place:
            self._step = _StepView(gui)
        self._motor_place = gui.add_folder(None, visible=False)
        with self._motor_place:
            self._found = gui.add_html("")
            self._plots = MotorPlots(gui)
        desk.status_changed.connect(self._follow)
        desk.me_changed.connect(lambda _: self._follow(desk.status))
        self._follow(desk.status)

    def failed(self) -> None:
        """The link or the worker could not do it, and has said so."""
        self._say("")

    def _follow(self, status: LinkStatus) -> None:
        names = (NO_JOINT,) if status.robot is None else status.robot.joint_names
        if self._joint.options != names:
            show_options(self._joint, names, names[0])
        self._grid.show(self._cells(status))

    def _cells(self, status: LinkStatus) -> list[Cell]:
        why_not = not_free(status, self._desk.me)
        if not why_not and status.identity is not None and status.identity.drive != DriveKind.DC:
            why_not = ONLY_DC
        unknown = "" if self._result is not None else "Find the motor first."
        return [
            Cell("step", "Step", "The set-point of this joint jumps", why_not),
            Cell("pulses", "Find the motor", "Four short pulses, there and back", why_not, "main"),
            Cell("use", "Use in Control", "Tune for this motor; from there the gains go to the board", unknown),
        ]

    def _press(self, key: str) -> None:
        if key == "use":
            self._use_motor()
        elif self._desk.status.robot is not None:
            self._test_step() if key == "step" else self._test_pulses()

    @property
    def _joint_index(self) -> int:
        return self._joint.options.index(self._joint.value)

    def _test_step(self) -> None:
        status, desk = self._desk.status, self._desk
        assert status.robot is not None
        unit = status.robot.joint_units[self._joint_index]
        test = Test(TestKind.STEP, self._joint_index, si(self._height.value, unit), STEP_MS)
        duty_max = status.settings.get(setting_id("duty_max"), 1.0)
        self._say("The joint is being tested …")
        desk.ask(desk.link.test(desk.me, test), lambda recording: self._measure(recording, test, duty_max), self.failed)

    def _test_pulses(self) -> None:
        status, joint = self._desk.status, self._joint_index
        assert status.robot is not None and status.telemetry is not None
        low, high = map(float, status.robot.joint_limits[joint])
        low = status.settings.get(setting_id("min", joint), low)
        high = status.settings.get(setting_id("max", joint), high)
        try:
            pulses = pulse_plan(joint, status.telemetry.position[joint], (low, high), DRIVES[status.robot.name])
        except LinkError as refusal:
            self._desk.tell(str(refusal))
            return
        self._say(f"{len(pulses)} pulses, one after another …")
        self._series.start(pulses)

    def _measure(self, recording: Recording, test: Test, duty_max: float) -> None:
        self._desk.keep(recording)
        self._worker.request(self._receive_step, jobs.step_response, recording, test, duty_max)

    def _receive_step(self, result: MeasuredStep | Refusal) -> None:
        if isinstance(result, Refusal):
            self._refuse(result)
        else:
            self._say("")
            self._step_place.visible = True
            self._step.show(result)

    def _identify(self, pulses: list[Recording]) -> None:
        self._say("The motor is being sought …")
        self._worker.request(lambda found: self._receive(pulses[0].robot, found), jobs.identify_motor, pulses)

    def _receive(self, robot: str, result: Identified | Refusal) -> None:
        if isinstance(result, Refusal):
            self._refuse(result)
            return
        self._say("")
        self._result = robot, result
        self._motor_place.visible = True
        self._found.content = result_table(result, DRIVES[robot].motor)
        self._plots.show(result)
        self._follow(self._desk.status)

    def _use_motor(self) -> None:
        assert self._result is not None
        robot, found = self._result
        origin = f"Identified on the robot on the table, {found.source}; Reset the lab brings the old one back."
        if refusal := self._use(robot, found.found.motor, origin):
            self._desk.tell(refusal)
        else:
            self._desk.tell_good("The control lab has this motor now: tune it there.")

    def _refuse(self, refusal: Refusal) -> None:
        self._say("")
        self._desk.tell(refusal.reason)

    def _say(self, sentence: str) -> None:
        self._said.content = small(sentence) if sentence else ""


class _StepView:
    """The step as measured, and its numbers."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._unit = SHOWN_UNIT["rad"]
        curves = (Curve("set-point", theme.REFERENCE, 1.2, DASHED), Curve("measured", theme.ACTUAL))
        self._plot = Plot(gui, self._axes(), curves, "Step response of the real joint", 190)
        self._table = gui.add_html("")

    def show(self, step: MeasuredStep) -> None:
        if step.unit != self._unit:
            self._unit = step.unit
            self._plot.rename(self._axes())
        chosen = slice(None, None, max(1, len(step.t) // 400))
        self._plot.show(step.t[chosen], [step.setpoint] * len(step.t[chosen]), step.y[chosen])
        found = step.metrics
        self._table.content = table(
            ("", ""),
            [
                ("Overshoot", f"{found.overshoot_pct:.1f} %"),
                ("Rise, 10 to 90 %", f"{found.rise_s:.3f} s"),
                ("Settling, 2 %", f"{found.settling_s:.3f} s"),
                ("Error at the end", f"{found.steady_state_error:.3g} {step.unit}"),
            ],
        )

    def _axes(self) -> Axes:
        return Axes("Time (s)", f"Joint ({self._unit})")
