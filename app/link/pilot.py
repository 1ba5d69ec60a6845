"""What the host decides about the robot, without a thread, a port or a clock of its own.

It is given bytes and the time and says which bytes go out; `app.link.orders` is what people may ask of it.
"""

from __future__ import annotations

import dataclasses
from concurrent.futures import Future

from app.link.connection import Connection
from app.link.conversation import Conversation
from app.link.diary import Diary
from app.link.errors import LinkError, ProtocolError
from app.link.helm import Helm
from app.link.lease import Lease
from app.link.motions.bounds import Bounds, bounds_of
from app.link.mover import Mover, command
from app.link.protocol.codes import Command, Flag, State
from app.link.protocol.frames import FrameDecoder
from app.link.protocol.messages import Ack, Alive, Identity, Message, Sample, Telemetry, unpack
from app.link.protocol.settings import SETTING_COUNT
from app.link.round_trips import RoundTrips
from app.link.settings_exchange import read
from app.link.situation import LATCHED, describe_state
from app.link.trial import Trial
from app.link.twin.recorder import Recorder
from app.robots import Robot

ALIVE_S = 0.02
"""Between two frames while the motors have power: a board that tests or homes holds after `hold_after` without."""

READ_AGAIN_S = 2.0
UNPOWERED = (State.OFF, State.FAULT)
BY_THE_BOARD = (State.HOMING, State.TESTING)


class Pilot:
    """One robot link. Times are in s, of any clock that does not go back."""

    def __init__(self) -> None:
        self._now = 0.0
        self.diary = Diary()
        self.lease = Lease()
        self.round_trips = RoundTrips()
        self.conversation = Conversation()
        self.connection = Connection(self.conversation, self.say, self._met)
        self.mover = Mover(self.conversation, self.round_trips, self.say, self.bounds)
        self.helm = Helm(self.mover, self.bounds, self.is_homed)
        self.telemetry: Telemetry | None = None
        """The newest of a board that is known; HOMED only after a homing on this connection."""
        self.recorder: Recorder | None = None
        self.trial: Trial | None = None
        self._decoder = FrameDecoder()
        self._homed_here = False
        self._holder = ""
        self._spoke_s = 0.0
        self._reading: Future[None] | None = None
        self._read_again_s = 0.0

    def opened(self, now: float) -> None:
        """The wanted port is open; what was read before is forgotten."""
        self._now, self._decoder = now, FrameDecoder()
        self.connection.opened(now)

    def gone(self, reason: str, now: float) -> None:
        """The port could not be opened, broke, or was closed."""
        self._now = now
        self._forget(reason)
        self.connection.gone(reason, now)

    def receive(self, data: bytes, now: float) -> None:
        """Bytes from the board."""
        self._now = now
        for payload in self._decoder.feed(data):
            try:
                message, number = unpack(payload)
            except ProtocolError as error:
                self.diary.write_seldom("strange", f"{error} Is its firmware up to date?", now)
            else:
                self._hear(message, number, now)

    def tick(self, now: float) -> str:
        """To be called every 10 ms; returns the reason why the port is to be closed, empty if it is not."""
        self._now = now
        self.lease.expire(now)
        self.watch_holder(now)
        late = self.connection.health.ticked(now)
        powered = self.telemetry is not None and self.telemetry.state not in UNPOWERED
        if late and powered:
            self.diary.write_seldom("late", late, now)
        self.conversation.repeat(now)
        if self.trial is not None:
            self.trial.tick(now)
        if self.helm.tick(now):
            self._spoke_s = now
        elif powered and now - self._spoke_s >= ALIVE_S - 1e-6:
            self.conversation.say(Alive())
            self._spoke_s = now
        self._read_settings(now)
        return self.connection.tick(now)

    def take_output(self) -> bytes:
        """The bytes to write now."""
        return self.conversation.take_output()

    def watch_holder(self, now: float) -> None:
        """When the robot goes to another person, or to nobody, it halts."""
        holder = self.lease.holder
        key = holder.key if holder else ""
        if key == self._holder:
            return
        self._holder = key
        self.halt_all(now, "The robot went to somebody else.")
        self.say(f"{holder.name} has the robot." if holder else "The robot is free.")

    def halt_all(self, now: float, reason: str) -> None:
        """End every motion, also those that the board makes by itself."""
        self.helm.let_go(now, reason)
        if self.telemetry is not None and self.telemetry.state in BY_THE_BOARD:
            self.conversation.ask(command(Command.HALT), now)
        self._end_trial(reason)

    def drop_everything(self, now: float, reason: str) -> None:
        """No motion, no program, no question, nothing that waits to be written: only for what ends them all."""
        error = LinkError(reason)
        self.mover.drop(error)
        self.helm.let_go(now, reason)
        self._end_trial(reason)
        if self.connection.ready:
            self.conversation.drop(error)

    def forget_settings(self) -> None:
        """Read them all again, in the background."""
        self.connection.settings.clear()
        self._read_again_s = 0.0

    def require_robot(self) -> Robot:
        """The robot on the cable; LinkError if there is none."""
        if self.connection.robot is None or not self.connection.ready:
            raise LinkError("No robot is connected; choose a port and connect.")
        return self.connection.robot

    def bounds(self) -> Bounds:
        return bounds_of(self.require_robot(), self.connection.settings, self.is_homed())

    def is_homed(self) -> bool:
        return self.telemetry is not None and Flag.HOMED in self.telemetry.flags

    def say(self, sentence: str) -> None:
        """Something for the diary."""
        self.diary.write(sentence, self._now)

    def _hear(self, message: Message, number: int, now: float) -> None:
        match message:
            case Telemetry():
                self._hear_telemetry(message, number, now)
            case Ack() | Identity():
                self.conversation.hear(message, number, now)
            case Sample() if self.trial is not None:
                self.trial.sampled(message, now)

    def _hear_telemetry(self, telemetry: Telemetry, number: int, now: float) -> None:
        was_ready = self.connection.ready
        self.connection.heard(telemetry, now)
        if not self.connection.ready:
            if was_ready:
                self._forget("The board was reset.")
            return
        self.round_trips.named(number, now)
        seen = self._without_old_homing(telemetry)
        before, self.telemetry = self.telemetry, seen
        if self.recorder is not None:
            self.recorder.append(seen, now, self.round_trips.last_s)
        if self.trial is not None:
            self.trial.heard(seen, now)
        self.mover.heard(seen, len(self.require_robot().joint_names), now)
        if before is not None and before.state is not seen.state:
            self._changed_state(before.state, seen)
        noise = self.connection.health.noise(self._decoder.bad, telemetry, now)
        if noise:
            self.say(noise)

    def _without_old_homing(self, telemetry: Telemetry) -> Telemetry:
        """A board with absolute sensors stays homed while nobody is connected; for people it is not: whatever was
        done to the robot meanwhile, its first motion is a homing that somebody watches."""
        homed = Flag.HOMED in telemetry.flags
        before = self.telemetry
        came_home = before is not None and before.state is State.HOMING and telemetry.state is State.READY
        self._homed_here = homed and (self._homed_here or came_home)
        if homed and not self._homed_here:
            return dataclasses.replace(telemetry, flags=telemetry.flags & ~Flag.HOMED)
        return telemetry

    def _changed_state(self, before: State, telemetry: Telemetry) -> None:
        state = telemetry.state
        if state in LATCHED or (state is State.OFF and before is not State.FAULT):
            self.say(describe_state(telemetry, self.mover.activity))
        elif before is State.HOMING and state is State.READY:
            self.say("The robot is homed." if self.is_homed() else "The homing was ended; the robot is not homed.")

    def _met(self) -> None:
        """The board is known."""
        self.telemetry, self._homed_here = None, False
        self._reading, self._read_again_s = None, 0.0

    def _forget(self, reason: str) -> None:
        self.mover.drop(LinkError(reason))
        self.helm.let_go(self._now, reason)
        self._end_trial(reason)
        self.telemetry = None

    def _end_trial(self, reason: str) -> None:
        if self.trial is not None:
            self.trial.fail(LinkError(reason))
            self.trial = None

    def _read_settings(self, now: float) -> None:
        """All of them, in the background; again after a while if it was interrupted."""
        settings = self.connection.settings
        if not self.connection.ready or now < self._read_again_s or (self._reading and not self._reading.done()):
            return
        missing = [id for id in range(SETTING_COUNT) if id not in settings and self._has_setting(id)]
        self._read_again_s = now + READ_AGAIN_S
        if missing:
            self._reading = self.conversation.ask(read(missing, settings.__setitem__), now)

    def _has_setting(self, id: int) -> bool:
        joints = len(self.require_robot().joint_names)
        return not 10 * joints <= id < 40
