"""What a lesson can press on the robot on the table."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from app.errors import UserMistake
from app.ui.desks import Desks
from app.ui.hardware import jobs
from app.ui.lessons.facts.link import SIM, LinkFacts
from app.ui.lessons.presses import Press
from app.ui.refusal import Refusal

if TYPE_CHECKING:
    from app.link.programs import Program
    from app.ui.hardware.desk import HardwareDesk

JOG_M, JOG_SPEED_M_S = 0.005, 0.05
UP = 2
"""Axis of the pose."""


class LinkPresses:
    """`export` is not here: the report is not the robot's."""

    def __init__(self, desks: Desks, facts: LinkFacts) -> None:
        self._desks = desks
        self._link = facts
        self._facts = facts.field().read

    def table(self) -> Mapping[str, Press]:
        """Name -> action."""
        desk, is_ = self._get, self._is
        verbs = {
            "request": ("request", is_("link.holder", "me")),
            "hand_over": ("release", lambda: not desk().engaged),
            "enable": ("enable", is_("link.state", "ready")),
            "home_robot": ("home", lambda: is_("link.homed", True)() and is_("link.state", "ready")()),
            "clear": ("clear", lambda: self._facts["link.state"]() not in ("stopped", "fault")),
            "continue": ("resume", lambda: self._facts["link.state"]() != "held"),
            "power_off": ("power_off", is_("link.state", "off")),
        }
        plain = {name: self._order(self._verb(verb), done) for name, (verb, done) in verbs.items()}
        status = lambda: self._desks.workshop.status  # noqa: E731
        return {
            **plain,
            "connect": self._order(self._connect, lambda: status().phase == "ready" and bool(status().settings)),
            "disconnect": self._order(lambda: desk().disconnect(), is_("link.phase", "none")),
            "jog": self._order(self._jog, lambda: status().activity == "idle" and is_("link.state", "ready")()),
            "stop": self._order(self._stop, is_("link.state", "stopped")),
            "run_drawing": self._order(self._run_drawing, self._came_to_rest),
            "run_run": self._order(self._run_run, self._came_to_rest),
            "record": self._order(lambda: desk().start_recording(), lambda: status().recording_s > 0.0),
            "stop_recording": self._order(lambda: desk().stop_recording(), self._recorded),
            "twin": Press(lambda: self._desks.twin.compare(), lambda: not self._desks.staff.busy),
            "heal": Press(self._heal),
            "show_robot": Press(lambda: desk().show_it()),
        }

    def _order(self, begin: Callable[[], None], done: Callable[[], bool]) -> Press:
        """It has ended once the link has granted it and it is done, or once the link has refused it, and said so."""
        granted = refused = 0

        def give() -> None:
            nonlocal granted, refused
            desk = self._get()
            granted, refused = desk.granted, desk.refused
            begin()

        def ended() -> bool:
            desk = self._get()
            return desk.refused > refused or (desk.granted > granted and done())

        return Press(give, ended)

    def _get(self) -> HardwareDesk:
        desk = self._desks.hardware
        desk.open()
        return desk

    def _is(self, fact: str, value: object) -> Callable[[], bool]:
        return lambda: self._facts[fact]() == value

    def _verb(self, name: str) -> Callable[[], None]:
        return lambda: self._get().do(name)

    def _connect(self) -> None:
        desk, status = self._get(), self._desks.workshop.status
        if status.phase == "none":
            desk.connect(SIM + self._desks.session.robot_name)
        else:
            desk.granted += 1  # it is, or will be

    def _jog(self) -> None:
        from app.link.programs import Jog

        self._get().step(Jog("pose", UP, 1, JOG_SPEED_M_S), JOG_M)

    def _stop(self) -> None:
        desk = self._get()
        desk.ask(desk.link.stop(desk.me))

    def _heal(self) -> None:
        from app.link.emulated.faults import Faults

        if refusal := self._get().break_board(Faults()):
            raise UserMistake(refusal)

    def _run_drawing(self) -> None:
        drawing = self._desks.planned_drawing
        if drawing is None:
            raise UserMistake("There is no drawing that the robot can draw: plan one in the tab Draw.")
        self._run(jobs.drawing_program, drawing)

    def _run_run(self) -> None:
        run = self._desks.run
        if run is None:
            raise UserMistake("There is no run to follow: compute one in the tab Control.")
        self._run(jobs.run_program, run)

    def _run(self, job: Callable[..., Program | Refusal], *arguments: object) -> None:
        desk = self._get()
        self._link.deeds.attend()
        self._link.deeds.forget("finished")

        def begin(program: Program | Refusal) -> None:
            if isinstance(program, Refusal):
                desk.refused += 1
                desk.tell(program.reason)
            else:
                desk.run(program)

        self._desks.staff.slow().request(begin, job, *arguments)

    def _came_to_rest(self) -> bool:
        """The program ran to its end, or was ended."""
        return not self._link.deeds.runs

    def _recorded(self) -> bool:
        return self._desks.workshop.status.recording_s == 0.0 and self._facts["link.recorded"]() != 0.0
