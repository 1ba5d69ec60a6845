"""A small host: frames through pyserial, commands repeated until they are answered, set-points at 100 Hz."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from typing import TypeVar

import serial

from app.link.protocol.codes import Command, Refusal, State, TargetKind
from app.link.protocol.frames import FrameDecoder, encode_frame
from app.link.protocol.messages import (
    Ack,
    Alive,
    Get,
    Hello,
    Identity,
    Message,
    Order,
    Set,
    Setpoint,
    Telemetry,
    pack,
    unpack,
)
from app.link.protocol.settings import setting_id

PATIENCE_S = 15.0
REPEAT_S = 0.3
ALIVE_S = 0.03
PERIOD_S = 0.01

Reply = TypeVar("Reply", Ack, Identity)


class Host:
    """Talks to one board, in one thread."""

    def __init__(self, port: str) -> None:
        self.line = serial.serial_for_url(port, 115200, timeout=0.002)
        self.telemetry: list[tuple[int, Telemetry]] = []
        """All that came, each with its number."""
        self.decoder = FrameDecoder()
        self._replies: dict[int, Message] = {}
        self._number = 0
        self._alive_at = 0.0

    def close(self) -> None:
        self.line.close()

    def send(self, message: Message) -> int:
        """Its number."""
        self._number = (self._number + 1) % 0x10000
        self.line.write(encode_frame(pack(message, self._number)))
        return self._number

    def listen(self) -> None:
        """Takes what has come, for some milliseconds."""
        for payload in self.decoder.feed(self.line.read(256)):
            message, number = unpack(payload)
            if isinstance(message, Telemetry):
                self.telemetry.append((number, message))
            else:
                self._replies[number] = message

    def ask(self, message: Message, kind: type[Reply]) -> Reply:
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            number, repeat_at = self.send(message), time.monotonic() + REPEAT_S
            while time.monotonic() < repeat_at:
                self.listen()
                reply = self._replies.pop(number, None)
                if isinstance(reply, kind):
                    return reply
        raise TimeoutError(f"{message} was not answered.")

    def identity(self) -> Identity:
        return self.ask(Hello(), Identity)

    def order(self, command: Command) -> Refusal:
        return self.ask(Order(command), Ack).result

    def set(self, name: str, value: float, joint: int | None = None) -> Ack:
        return self.ask(Set(setting_id(name, joint), value), Ack)

    def get(self, name: str, joint: int | None = None) -> float:
        return self.ask(Get(setting_id(name, joint)), Ack).value

    def fresh(self) -> Telemetry:
        """Telemetry that was sent after now."""
        seen = len(self.telemetry)
        return self.wait(lambda now: len(self.telemetry) > seen + 1, alive=True)

    def wait(self, arrived: Callable[[Telemetry], bool], alive: bool = True) -> Telemetry:
        """The first telemetry from now on of which this holds; meanwhile signs of life, if `alive`."""
        deadline, seen = time.monotonic() + PATIENCE_S, len(self.telemetry)
        while time.monotonic() < deadline:
            if alive and time.monotonic() > self._alive_at:
                self.send(Alive())
                self._alive_at = time.monotonic() + ALIVE_S
            self.listen()
            for _, message in self.telemetry[seen:]:
                if arrived(message):
                    return message
            seen = len(self.telemetry)
        raise TimeoutError(f"It never came; the last was {self.telemetry[-1:]}.")

    def wait_for(self, *states: State) -> Telemetry:
        return self.wait(lambda now: now.state in states)

    def home(self) -> Telemetry:
        """Power on, and homed. Where a busy computer lets the board wait too long, homing begins again."""
        while True:
            self.order(Command.ENABLE)
            self.order(Command.HOME)
            found = self.wait_for(State.READY, State.HELD, State.OFF, State.FAULT)
            if found.state in (State.READY, State.FAULT):
                return found
            self.order(Command.FOLLOW)

    def stream(
        self, targets: Iterable[Iterable[float]], kind: TargetKind = TargetKind.POSE, laser: int = 0, pen: bool = False
    ) -> int:
        """Set-points at 100 Hz; where a busy computer lets the board wait too long, it is asked to go on.

        Returns:
            the number of the last one.
        """
        number = 0
        for target in targets:
            self._until(time.monotonic() + PERIOD_S)
            if self.telemetry and self.telemetry[-1][1].state is State.HELD:
                self.order(Command.FOLLOW)
                self.wait_for(State.READY)
            number = self.send(Setpoint(kind, tuple(target), pen_down=pen, laser=laser))
        return number

    def _until(self, end_s: float) -> None:
        """Listens, at least once however late it is."""
        self.listen()
        while time.monotonic() < end_s:
            self.listen()
