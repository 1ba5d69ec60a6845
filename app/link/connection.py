"""From a port that was asked for to a board that is known, and back again when it is lost."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from concurrent.futures import Future

from app.link.conversation import Conversation, Script
from app.link.errors import LinkError
from app.link.handshake import NO_SERIAL, Acquaintance, Mismatch, describe, number_board, shake_hands
from app.link.health import Health
from app.link.protocol.codes import Command, State
from app.link.protocol.messages import Identity, Order, Telemetry
from app.link.status import Phase
from app.robots import Robot

FIRST_WORD_S = 3.0
"""An Uno resets when its port is opened, and its bootloader takes a second: nothing is sent before it speaks."""

STALE_S = 0.1
"""What comes so soon after opening may have waited in the computer."""

RETRY_S = 1.0
NOTHING = "No robot is connected."


class Connection:
    """The state of one port. `say` gets sentences for the diary, `met` is called when a board got known."""

    def __init__(self, conversation: Conversation, say: Callable[[str], None], met: Callable[[], None]) -> None:
        self._conversation, self._say, self._met = conversation, say, met
        self.phase: Phase = "none"
        self.sentence = NOTHING
        self.port = ""
        """The port that should be open; empty for none."""
        self.asked_anew = False
        """Somebody asked for a connection since the port was opened: a port that is open is to be opened again."""
        self.retry_s = 0.0
        """Not to be opened before this time."""
        self.identity: Identity | None = None
        self.robot: Robot | None = None
        self.settings: dict[int, float] = {}
        self.health = Health(0.0)
        self._wanted: str | None = None
        self._before: Identity | None = None
        self._answer: Future[None] | None = None
        self._handshake: Future[Acquaintance] | None = None
        self._opened_s: float | None = None
        self._state = State.OFF

    @property
    def ready(self) -> bool:
        return self.phase == "ready"

    @property
    def is_open(self) -> bool:
        return self._opened_s is not None

    @property
    def same_only(self) -> bool:
        """Whether only the board that was here before may come back."""
        return self._before is not None

    def connect(self, port: str, robot: str | None, now: float) -> Future[None]:
        """Want a port; the answer comes when its board is known or refused."""
        self.disconnect()
        self.phase, self.port, self._wanted, self.retry_s = "connecting", port, robot, now
        self.asked_anew = True
        self.sentence = f"Connecting to {port}; an Arduino takes a few seconds to start."
        self._answer = Future()
        return self._answer

    def disconnect(self) -> None:
        self._forget_board()
        self.phase, self.sentence, self.port, self._before = "none", NOTHING, "", None
        self._fail_answer("The connection was ended.")

    def opened(self, now: float) -> None:
        """The port is open; what was to be said to another one is not said to this one."""
        self._forget_board()
        self._conversation.take_output()
        self._opened_s, self.health = now, Health(now)

    def heard(self, telemetry: Telemetry, now: float) -> None:
        """Something that a board says on its own."""
        if self._opened_s is None or now - self._opened_s < STALE_S:
            return
        self._state = telemetry.state
        if self.health.was_reset(telemetry, now):
            self._restarted(now)
        elif self.phase in ("connecting", "lost") and self._handshake is None:
            self._handshake = self._conversation.ask(self._get_to_know(), now)
            self._handshake.add_done_callback(lambda answer: self._known(answer, now))

    def tick(self, now: float) -> str:
        """The reason why the port is to be closed now; empty if it is not."""
        if self._opened_s is None:
            return ""
        if self.ready and self.health.is_silent(now):
            return "The board went silent; check its power and the cable."
        waiting = not self.ready and self._handshake is None
        if waiting and now - self._opened_s >= FIRST_WORD_S:
            return f"No Delta Lab board speaks at {self.port}; check the port, or flash it: deltalab firmware upload."
        return ""

    def gone(self, reason: str, now: float) -> None:
        """The port could not be opened, or is closed again. A board that was known is waited for."""
        known = self.ready or self.same_only
        if known:
            self._before = self.identity or self._before
            self._say(reason) if self.phase != "lost" else None
            self.phase, self.retry_s = "lost", now + RETRY_S
            self.sentence = f"{reason} The same board will be taken again; then it is off and not homed."
            self._forget_board()
        else:
            self.refuse(reason)

    def refuse(self, reason: str) -> None:
        """Give the port up, for a reason that trying again does not change."""
        self._say(reason)
        self._forget_board()
        self.phase, self.sentence, self.port, self._before = "refused", reason, "", None
        self._fail_answer(reason)

    def _get_to_know(self) -> Script[Acquaintance]:
        """The handshake; then the motors are off, whatever they were before."""
        found = yield from shake_hands(self._wanted, self._before)
        if self._state not in (State.OFF, State.FAULT):
            yield Order(Command.OFF)
        if found.identity.serial == NO_SERIAL and self._state is not State.FAULT:
            return dataclasses.replace(found, identity=(yield from number_board(found.identity)))
        return found

    def _known(self, answer: Future[Acquaintance], now: float) -> None:
        if self._handshake is None:
            return  # given up meanwhile
        error = answer.exception()
        if isinstance(error, Mismatch) or (error is not None and not self.same_only):
            self.refuse(str(error))
        elif error is not None:
            self._handshake = None  # the next telemetry begins it again
        else:
            self._meet(answer.result())

    def _meet(self, found: Acquaintance) -> None:
        again = self.same_only
        self.identity, self.robot, self.settings = found.identity, found.robot, dict(found.settings)
        self._before, self._handshake, self.phase = found.identity, None, "ready"
        self.sentence = f"Connected: {describe(found.identity)}{', again' if again else ''}."
        self._say(f"{self.sentence[:-1]}; the motors are off.")
        answer, self._answer = self._answer, None
        self._met()
        if answer is not None:
            answer.set_result(None)

    def _restarted(self, now: float) -> None:
        """The board began anew, and so does the handshake."""
        if self.ready:
            self._say("The board was reset: it is off and not homed.")
        self._forget_board()
        self._opened_s, self.phase = now - STALE_S, "connecting"
        self.sentence = "The board was reset: it is off and not homed."

    def _forget_board(self) -> None:
        self.identity, self.robot, self.settings = None, None, {}
        self._opened_s = self._handshake = None
        self._conversation.drop(LinkError("The connection is gone; connect again."))

    def _fail_answer(self, reason: str) -> None:
        answer, self._answer = self._answer, None
        if answer is not None:
            answer.set_exception(LinkError(reason))
