"""The state behind all tabs of one browser. Each desk is made when somebody first wants it: a tab, or a lesson.

No widgets, and nothing of viser. What a desk needs is loaded with it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

from app.signal import Signal
from app.ui.lab.desk import ControlDesk
from app.ui.lab.run_book import RunBook
from app.ui.playback import Playback
from app.ui.session import Session
from app.ui.staff import Staff

if TYPE_CHECKING:
    from app.control.motor import Motor
    from app.link.lease import Person
    from app.simulation import Run
    from app.ui.compare.desk import CompareDesk
    from app.ui.drawing.desk import DrawingDesk
    from app.ui.drawing.jobs import Plan, Sketch
    from app.ui.drawing.player import DrawingPlayer
    from app.ui.hardware.desk import HardwareDesk
    from app.ui.hardware.twin_desk import TwinDesk
    from app.ui.hardware.workshop import Workshop
    from app.ui.lab.motor_desk import MotorDesk
    from app.ui.motion.desk import MotionDesk
    from app.ui.motion.map_desk import MapDesk

Notify = Callable[[str, Literal["red", "green"]], None]
"""Shows a sentence about the robot on the table in a colour."""


class Desks:
    """Of one session."""

    def __init__(self, session: Session, staff: Staff, workshop: Workshop, browser: str, notify: Notify) -> None:
        """
        Args:
            staff: works for these desks only, so that it is busy while one of them is.
            browser: identity of the browser, as the workshop knows it.
        """
        self.changed: Signal[None] = Signal()
        """Something on a desk that is in use may have changed, or in the session."""
        self.session = session
        self.staff = staff
        self.workshop = workshop
        self._browser = browser
        self._notify = notify
        self._closers: list[Callable[[], None]] = []
        self._watch(session.robot_changed, session.stance_changed, session.view_changed)

    @cached_property
    def control(self) -> ControlDesk:
        """The control lab."""
        desk = ControlDesk(self.session, self.staff.quick())
        self._watch(desk.settings_changed, desk.answered)
        return desk

    @cached_property
    def runs(self) -> RunBook:
        """Runs of the whole robot; a new one is played."""
        book = RunBook(self.session, self.staff.slow(lambda: book.failed()), self.staff.tell)
        playback = self.run_playback
        book.selected.connect(playback.load)
        book.finished.connect(lambda _: playback.play())
        self._watch(book.selected, book.busy_changed)
        return book

    @cached_property
    def run_playback(self) -> Playback:
        """Plays the run that is shown."""
        playback = Playback(self.session)
        self._closers.append(playback.pause)
        return playback

    @property
    def run(self) -> Run | None:
        """The run that is shown; looking makes no desk."""
        return self.runs.run if self.has("runs") else None

    def use_motor(self, robot: str, motor: Motor, origin: str) -> str:
        """Give the control lab a motor that was identified on the table; returns why not, or nothing."""
        if robot != self.session.robot_name:
            return "The page shows another robot than the one with this motor: show that one first."
        self.control.change(motor=motor, motor_origin=origin)
        return ""

    @cached_property
    def motor(self) -> MotorDesk:
        """The motor's test."""
        from app.ui.lab.motor_desk import MotorDesk

        desk = MotorDesk(self.session, self.control, self.staff.slow)
        self._watch(desk.settings_changed, desk.answered)
        return desk

    @cached_property
    def motion(self) -> MotionDesk:
        """Motions and work cycles."""
        from app.ui.motion.desk import MotionDesk

        desk = MotionDesk(self.session, self.staff.quick(), self.staff.slow())
        self._watch(desk.settings_changed, desk.planned, desk.refused, desk.playback.playing_changed)
        self._closers.append(desk.close)
        return desk

    @cached_property
    def compare(self) -> CompareDesk:
        """Controllers compared."""
        from app.ui.compare.desk import CompareDesk
        from app.ui.series import Series

        series = Series(self.staff.slow(lambda: series.failed()))
        desk = CompareDesk(self.session, self.motion, series, self.staff.tell)
        self._watch(desk.settings_changed, desk.answered, desk.looked)
        self._closers.append(desk.cancel)
        return desk

    @cached_property
    def maps(self) -> MapDesk:
        """Maps of the workspace."""
        from app.ui.motion.map_desk import MapDesk

        desk = MapDesk(self.session, self.staff.quick())
        self._watch(desk.changed, desk.answered)
        return desk

    @cached_property
    def drawing(self) -> DrawingDesk:
        """The drawing."""
        from app.ui.drawing.desk import DrawingDesk  # needs OpenCV

        hire = self.staff
        desk = DrawingDesk(self.session, hire.quick(), hire.slow(), hire.quick(), hire.slow())
        self._watch(desk.settings_changed, desk.sketched, desk.planned, desk.refused, desk.saved)
        self._closers.append(desk.leave_alone)
        return desk

    @property
    def planned_drawing(self) -> Sketch | None:
        """What is shown, if the robot has a way to draw it; looking makes no desk."""
        return self.drawing.sketch if self.has("drawing") and self.drawing.plan is not None else None

    @cached_property
    def player(self) -> DrawingPlayer:
        """Plays the drawing."""
        from app.ui.drawing.player import DrawingPlayer

        playback = Playback(self.session)
        player, desk = DrawingPlayer(self.session, playback), self.drawing
        desk.settled = lambda: player.state in ("empty", "ready")

        def load(plan: Plan | None) -> None:
            track = None if plan is None else plan.track
            if track is not player.track:
                player.load(track, speed=player.speed)

        desk.planned.connect(load)
        load(desk.plan)
        self._watch(player.state_changed)
        self._closers.append(playback.pause)
        return player

    @cached_property
    def hardware(self) -> HardwareDesk:
        """The robot on the table."""
        from app.ui.hardware.desk import HardwareDesk  # needs the link

        desk = HardwareDesk(self.session, self.workshop, self._browser, self._notify)
        self._watch(desk.status_changed, desk.beat, desk.me_changed, desk.recorded)
        self._closers.append(desk.close)
        return desk

    @cached_property
    def twin(self) -> TwinDesk:
        """The robot on the table beside its simulated twin."""
        from app.ui.hardware.twin_desk import TwinDesk

        desk = TwinDesk(self.hardware, self.staff.slow)
        self._watch(desk.answered)
        return desk

    @property
    def has_hardware(self) -> bool:
        """Whether somebody has wanted the robot on the table already."""
        return self.has("hardware")

    def has(self, desk: str) -> bool:
        """Whether this desk has been made; looking makes none."""
        return desk in vars(self)

    @property
    def me(self) -> Person:
        """Who sits at this browser."""
        return self.workshop.people.person(self._browser)

    def stand_still(self) -> None:
        """What was made to be looked at moves the robot no longer."""
        if self.has("run_playback"):
            self.run_playback.pause()
        if self.has("motion"):
            self.motion.playback.pause()

    def close(self) -> None:
        """Stop what would go on without the browser."""
        self.staff.cancel()
        for close in self._closers:
            close()

    def _watch(self, *signals: Signal[Any]) -> None:
        for signal in signals:
            signal.connect(lambda _: self.changed.emit(None))
