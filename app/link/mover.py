"""What moves the robot at the moment: starts it, feeds the board with set-points, ends it with one HALT."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass

from app.link.conversation import Conversation, Refused, Script
from app.link.errors import LinkError
from app.link.motions.bounds import Bounds
from app.link.motions.course import Course
from app.link.motions.motion import Joints, Motion, Target
from app.link.protocol.codes import Command, Flag, Refusal, State, TargetKind, describe_refusal
from app.link.protocol.messages import Order, Setpoint, Telemetry
from app.link.round_trips import RoundTrips
from app.link.status import Activity

START_S = 1.0
"""A motion begins within this time, or not at all."""

REFUSALS = 3
"""A refusal stands until the next accepted set-point; so many messages in a row, and no set-point is accepted."""

STANDS = 1e-5
"""rad or m: the board's set-point is at its target."""

SETTLE_S, ARRIVE_S = 0.4, 5.0
"""How long a board may take to get ready at the end of a motion, and to come there."""

SHORTEST_STEP_S, LONGEST_STEP_S = 0.001, 0.03
"""After a late turn of the loop the target goes on as if it had been less late."""

_NOT_NOW = {
    State.OFF: Refusal.NOT_ENABLED,
    State.STOPPED: Refusal.STOPPED,
    State.FAULT: Refusal.FAULT,
    State.HOMING: Refusal.BUSY,
    State.TESTING: Refusal.BUSY,
}


@dataclass
class _Start:
    make: Callable[[Joints], Motion]
    activity: Activity
    answer: Future[None]
    since_s: float


def command(order: Command) -> Script[None]:
    yield Order(order)


class Mover:
    """One motion at a time. `say` gets the sentences that a person should read; `bounds` gives the robot's."""

    def __init__(
        self,
        conversation: Conversation,
        round_trips: RoundTrips,
        say: Callable[[str], None],
        bounds: Callable[[], Bounds],
    ) -> None:
        self._conversation, self._round_trips, self._say, self._bounds = conversation, round_trips, say, bounds
        self._telemetry: Telemetry | None = None
        self._joints = 0
        self._start: _Start | None = None
        self._command: Future[None] | None = None
        self.motion: Motion | None = None
        self.paused: Course | None = None
        self.override = 1.0
        self._target: Target | None = None
        self._sent_s = self._finished_s = self._there_s = math.inf
        self._refused = 0
        self._notice = ""

    @property
    def activity(self) -> Activity:
        if self.motion is not None:
            return self.motion.activity
        if self._start is not None:
            return self._start.activity
        return "idle" if self.paused is None else "paused"

    @property
    def course(self) -> Course | None:
        """The program that runs or is paused."""
        return self.motion if isinstance(self.motion, Course) else self.paused

    def start(
        self, make: Callable[[Joints], Motion], activity: Activity, now: float, *, follow: bool = False
    ) -> Future[None]:
        """Begin the motion that `make` gives for the board's set-point, as soon as the board is ready.

        Args:
            follow: let a board that holds go on.
        """
        if self.motion is not None or self._start is not None:
            raise LinkError("The robot is moving; wait until it stands, or stop it.")
        state = State.OFF if self._telemetry is None else self._telemetry.state
        if state in _NOT_NOW:
            raise Refused(_NOT_NOW[state])
        if state is State.HELD and not follow:
            raise Refused(Refusal.HELD)
        if state is State.HELD:
            self._order(Command.FOLLOW, now)
        self._start = _Start(make, activity, Future(), now)
        return self._start.answer

    def heard(self, telemetry: Telemetry, joints: int, now: float) -> None:
        """The newest from the board, of which `joints` numbers count."""
        stands = self._telemetry is not None and self._telemetry.setpoint == telemetry.setpoint
        self._telemetry, self._joints = telemetry, joints
        if self.motion is not None:
            self._watch(self.motion, telemetry, now)
        if self.paused is not None and telemetry.state not in (State.READY, State.MOVING, State.HELD):
            self.drop(LinkError("The program was given up."))
        if self._start is not None and stands:
            self._begin(self._start, telemetry, now)

    def halt(self, now: float, reason: str = "The motion was ended.") -> None:
        """A controlled stop, if anything moves: exactly one HALT."""
        moving = self.motion is not None
        self.drop(LinkError(reason))
        if moving:
            self._order(Command.HALT, now)

    def pause(self, now: float) -> None:
        """Halt a program so that it can go on."""
        course = self.course
        self.halt(now)
        self.paused = course

    def drop(self, reason: LinkError) -> None:
        """Forget everything; the board needs no telling."""
        start, self._start = self._start, None
        self.motion = self.paused = self._target = None
        if start is not None:
            start.answer.set_exception(reason)

    def tick(self, now: float) -> bool:
        """Send the next set-point, if something moves; returns whether one was sent."""
        if self._start is not None and now - self._start.since_s >= START_S:
            self.drop(LinkError("The board did not get ready to move; try it again."))
        if self.motion is None or self._telemetry is None:
            return False
        dt_s = min(max(now - self._sent_s, SHORTEST_STEP_S), LONGEST_STEP_S)
        self._sent_s = now
        if not (self._target and self._bounds().outruns(self._target.joints, self._telemetry.setpoint)):
            try:
                self._target = self.motion.advance(dt_s, self.override)
            except LinkError as error:
                self.halt(now)
                self._say(str(error))
                return False
        self._send(self._target, self._telemetry, now)
        self._tell(self.motion.notice)
        return True

    def _send(self, target: Target, telemetry: Telemetry, now: float) -> None:
        pen_down = bool(telemetry.flags & Flag.PEN_DOWN) if target.pen_down is None else target.pen_down
        joints = (*target.joints, *(0.0,) * (4 - len(target.joints)))
        laser = round(255.0 * min(max(target.laser, 0.0), 1.0))
        setpoint = Setpoint(TargetKind.JOINTS, joints, target.manual, pen_down, laser)
        self._round_trips.sent(self._conversation.say(setpoint), now)

    def _begin(self, start: _Start, telemetry: Telemetry, now: float) -> None:
        if self._command is not None and not self._command.done():
            return  # what is heard now may be older than the board's answer
        if telemetry.state is not State.READY:
            return
        self._start = None
        try:
            self.motion = start.make(telemetry.setpoint[: self._joints])
        except LinkError as error:
            self.paused = None
            start.answer.set_exception(error)
            return
        self.paused, self._target, self._notice = None, None, ""
        self._sent_s, self._finished_s, self._there_s, self._refused = now, math.inf, math.inf, 0
        start.answer.set_result(None)

    def _watch(self, motion: Motion, telemetry: Telemetry, now: float) -> None:
        if telemetry.state not in (State.READY, State.MOVING):
            self._ended_by_board(motion, telemetry.state)
            return
        self._refused = self._refused + 1 if telemetry.refusal is not Refusal.OK else 0
        if self._refused >= REFUSALS:
            self.halt(now)
            self._say(describe_refusal(telemetry.refusal))
        elif motion.finished and self._target is not None:
            self._end(self._target, telemetry, now)

    def _end(self, target: Target, telemetry: Telemetry, now: float) -> None:
        """The motion rests at its end, the board comes after. It gets ready by itself; where it does not, it halts."""
        self._finished_s = min(self._finished_s, now)
        there = max(abs(a - b) for a, b in zip(target.joints, telemetry.setpoint, strict=False)) < STANDS
        self._there_s = min(self._there_s, now) if there else math.inf
        if there and telemetry.state is State.READY:
            self.drop(LinkError("The motion is over."))
        elif now - self._there_s >= SETTLE_S or now - self._finished_s >= ARRIVE_S:
            self.halt(now)

    def _ended_by_board(self, motion: Motion, state: State) -> None:
        self.drop(LinkError("The board ended the motion."))
        if state is State.HELD and isinstance(motion, Course):
            self.paused = motion

    def _order(self, order: Command, now: float) -> None:
        self._command = self._conversation.ask(command(order), now)
        self._command.add_done_callback(self._answered)

    def _answered(self, answer: Future[None]) -> None:
        error = answer.exception()
        # a board that meanwhile held or stopped by itself stands as well; its state says so
        if error is not None and not isinstance(error, Refused):
            self._say(str(error))

    def _tell(self, notice: str) -> None:
        if notice and notice != self._notice:
            self._say(notice)
        self._notice = notice
