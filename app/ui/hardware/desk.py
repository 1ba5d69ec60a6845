"""The robot on the table as one browser sees and drives it. No widgets here.

What the link refuses is told as it is: its errors are sentences.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from typing import Literal, TypeVar

from app.classroom.errors import ClassroomRefusal
from app.link.emulated.faults import Faults
from app.link.errors import LinkError
from app.link.lease import Person
from app.link.link import RobotLink
from app.link.orders import changed_dimensions
from app.link.programs import Jog, Program
from app.link.protocol.messages import Test
from app.link.status import LinkStatus
from app.link.twin.recording import Recording
from app.robots import Robot
from app.signal import Signal
from app.ui.hardware.same_robot import moves_alike
from app.ui.hardware.verbs import VERBS, holds, place_in_queue
from app.ui.hardware.workshop import Workshop
from app.ui.session import Session

Result = TypeVar("Result")
Notify = Callable[[str, Literal["red", "green"]], None]
"""Shows a sentence in a colour."""

TICKS_PER_BEAT = 4

_log = logging.getLogger(__name__)


class HardwareDesk:
    """The state behind every panel of the tab Hardware."""

    def __init__(self, session: Session, workshop: Workshop, browser: str, notify: Notify) -> None:
        self.session = session
        self.status_changed: Signal[LinkStatus] = Signal()
        """Something that a person would notice, not merely a motion."""
        self.tick: Signal[LinkStatus] = Signal()
        """How things are, 20 times a second."""
        self.beat: Signal[LinkStatus] = Signal()
        """How things are, 5 times a second."""
        self.me_changed: Signal[Person] = Signal()
        self.recorded: Signal[Recording] = Signal()
        """A recording was ended, or a test is done."""
        self.begun: Signal[Program] = Signal()
        """A program from this page runs."""
        self._workshop = workshop
        self._browser = browser
        self._notify = notify
        self._edition = -1
        self._ticks = 0
        self._leave: Callable[[], None] | None = None
        self.status = workshop.status
        self._compared: tuple[Robot | None, Robot | None, bool] = (None, None, False)
        self.recording: Recording | None = None
        """The newest."""
        self._last_refusal = ""
        self.granted = self.refused = 0
        """How many orders of this page the link has accepted, and how many not."""

    @property
    def me(self) -> Person:
        return self._workshop.people.person(self._browser)

    @property
    def link(self) -> RobotLink:
        return self._workshop.link

    @property
    def workshop(self) -> Workshop:
        return self._workshop

    @property
    def holds(self) -> bool:
        return holds(self.status, self.me)

    @property
    def engaged(self) -> bool:
        """Whether signs of life are wanted: as holder, or in the queue."""
        return self.holds or place_in_queue(self.status, self.me) > 0

    @property
    def shows_it(self) -> bool:
        """Whether the page shows the robot on the table: the same kind, with the same dimensions."""
        mine, board = self.session.robot, self.status.robot
        if self._compared[:2] != (mine, board):
            self._compared = mine, board, board is not None and moves_alike(mine, board)
        return self._compared[2]

    def show_it(self) -> None:
        """Show the robot on the table in the page's picture."""
        board = self.status.robot
        if self.session.locks:
            self.tell("The lesson needs the robot that is shown: show another one after this step.")
        elif board is not None:
            self.session.choose_robot(board.name)
            self.session.reshape(**changed_dimensions(board))

    def open(self) -> None:
        """Somebody looks: from now on there is news."""
        if self._leave is None:
            self._leave = self._workshop.watch.attend(self._receive)

    def close(self) -> None:
        if self._leave is not None:
            self._leave()
            self._leave = None

    def rename(self, name: str) -> None:
        try:
            self._workshop.people.rename(self._browser, name)
        except ClassroomRefusal as refusal:
            self.tell(str(refusal))
        self.me_changed.emit(self.me)

    def prove(self, pin: str) -> bool:
        """Become the instructor; a wrong PIN is told."""
        if refusal := self._workshop.people.prove(self._browser, pin):
            self.tell(refusal)
            return False
        self.me_changed.emit(self.me)
        return True

    def do(self, verb: str) -> None:
        """One of `VERBS`."""
        if verb == "request" and self._workshop.people.member(self._browser) is None:
            self.tell("Join the class first: then ask for the robot.")
        elif verb in VERBS:
            self.ask(getattr(self.link, verb)(self.me))

    def connect(self, port: str) -> None:
        if refusal := self._workshop.why_no_port(self.me):
            self.tell(refusal)
        else:
            self.ask(self.link.connect(port))

    def disconnect(self) -> None:
        if refusal := self._workshop.why_no_port(self.me):
            self.tell(refusal)
        else:
            self.ask(self.link.disconnect())

    def alive(self) -> None:
        """The page has given a sign of life."""
        if self.engaged:
            self.link.alive(self.me)

    def jog(self, jog: Jog) -> None:
        """Start to move, or go on: the link stops 125 ms after the last call."""
        self.ask(self.link.jog(self.me, jog), once=True)

    def jog_release(self) -> None:
        self._last_refusal = ""
        self.ask(self.link.jog_release(self.me), once=True)

    def step(self, jog: Jog, size: float) -> None:
        self.ask(self.link.step(self.me, jog, size))

    def mirror(self, pose: tuple[float, ...], refused: Callable[[], None]) -> None:
        """Let the robot follow the newest pose."""
        self.ask(self.link.mirror(self.me, pose), failed=refused, once=True)

    def mirror_end(self) -> None:
        self.ask(self.link.mirror_end(self.me), once=True)

    def run(self, program: Program) -> None:
        self.ask(self.link.run(self.me, program), lambda _: self.begun.emit(program))

    def set_override(self, share: float) -> None:
        self.ask(self.link.set_override(self.me, share))

    def apply_settings(self, values: dict[int, float], then: Callable[[], None], *, save: bool = False) -> None:
        """Write settings, which are read back and compared."""
        self.ask(self.link.apply_settings(self.me, values, save), lambda _: then())

    def restore_defaults(self) -> None:
        """The board's settings as its firmware was built."""
        self.ask(self.link.restore_defaults(self.me), lambda _: self.tell_good("The board has its built-in settings."))

    def break_board(self, faults: Faults) -> str:
        """Try a fault on an emulated board; returns why not, or nothing. Whoever drives it may, and who chose it."""
        refusal = "" if self.holds else self._workshop.why_no_port(self.me)
        if not refusal:
            self._workshop.break_board(faults)
        return refusal

    def test(self, test: Test) -> None:
        self.ask(self.link.test(self.me, test), self.keep)

    def start_recording(self) -> None:
        self.ask(self.link.start_recording())

    def stop_recording(self) -> None:
        self.ask(self.link.stop_recording(), self.keep)

    def keep(self, recording: Recording) -> None:
        """Look at a recording: made here, or read from a file."""
        self.recording = recording
        self.recorded.emit(recording)

    def tell(self, sentence: str) -> None:
        """Why something was not done."""
        self._notify(sentence, "red")

    def tell_good(self, sentence: str) -> None:
        """What was done, where nothing else shows it."""
        self._notify(sentence, "green")

    def ask(
        self,
        answer: Future[Result],
        then: Callable[[Result], None] = lambda _: None,
        failed: Callable[[], None] = lambda: None,
        *,
        once: bool = False,
    ) -> None:
        """Wait for the link's answer beside everything else. `once`: the same sentence is not told twice in a row."""
        loop = asyncio.get_running_loop()
        answer.add_done_callback(lambda done: loop.call_soon_threadsafe(self._hear, done, then, failed, once))

    def _hear(
        self, answer: Future[Result], then: Callable[[Result], None], failed: Callable[[], None], once: bool
    ) -> None:
        try:
            result = answer.result()
        except LinkError as refusal:
            self.refused += 1
            self._refuse(str(refusal), once)
            failed()
        except CancelledError:
            failed()  # the link was closed, which it says itself
        except Exception:  # whatever goes wrong in the link's thread: the log has it, the student is told
            _log.exception("the link failed")
            self.tell("The link failed unexpectedly; disconnect, then connect again.")
            failed()
        else:
            self._last_refusal = ""
            self.granted += 1
            then(result)

    def _refuse(self, sentence: str, once: bool) -> None:
        if not (once and sentence == self._last_refusal):
            self.tell(sentence)
        self._last_refusal = sentence

    def _receive(self, status: LinkStatus) -> None:
        self.status = status
        edition = self._workshop.watch.edition
        if edition != self._edition:
            self._edition = edition
            self.status_changed.emit(status)
        self.tick.emit(status)
        self._ticks += 1
        if self._ticks % TICKS_PER_BEAT == 0:
            self.beat.emit(status)
