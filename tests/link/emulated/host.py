"""A host for boards whose time passes only when it says so."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.link.emulated.board import EmulatedBoard
from app.link.protocol.codes import Command, Flag, Refusal, State, TargetKind
from app.link.protocol.frames import FrameDecoder, encode_frame
from app.link.protocol.messages import Ack, Alive, Identity, Message, Order, Setpoint, Telemetry, pack, unpack

PACE_S = 0.01


class Host:
    """Sends, waits, and remembers what the board said."""

    def __init__(self, board: EmulatedBoard) -> None:
        self.board = board
        self.decoder = FrameDecoder()
        self.number = 0
        self.heard: list[tuple[Message, int]] = []
        self.telemetry: Telemetry | None = None

    def send(self, message: Message) -> int:
        """Returns the frame's number."""
        self.number += 1
        self.board.receive(encode_frame(pack(message, self.number)))
        return self.number

    def wait(self, seconds: float, alive: bool = True) -> None:
        """Time passes, with signs of life."""
        for _ in range(round(seconds / PACE_S)):
            if alive:
                self.send(Alive())
            self.board.advance(PACE_S)
            self._listen()

    def until(self, ready: Callable[[Telemetry], object], within_s: float = 8.0) -> Telemetry:
        """Waits for telemetry that is as wanted."""
        for _ in range(round(within_s / 0.02)):
            self.wait(0.02)
            if self.telemetry is not None and ready(self.telemetry):
                return self.telemetry
        raise AssertionError(f"in vain, last: {self.telemetry}")

    def ask(self, message: Message, within_s: float = 1.0) -> Message:
        """Sends, and again until it is answered."""
        for _ in range(round(within_s / 0.05)):
            number = self.send(message)
            self.wait(0.05)
            answers = [m for m, to in self.heard if to == number and isinstance(m, Ack | Identity)]
            if answers:
                return answers[-1]
        raise AssertionError(f"no answer to {message}")

    def order(self, command: Command) -> Refusal:
        """The answer to a command."""
        answer = self.ask(Order(command))
        assert isinstance(answer, Ack)
        return answer.result

    def home(self) -> None:
        """On, and homed."""
        self.until(lambda seen: seen.state == State.OFF)
        assert self.order(Command.ENABLE) == Refusal.OK
        assert self.order(Command.HOME) == Refusal.OK
        self.until(lambda seen: seen.state == State.READY and seen.flags & Flag.HOMED)

    def stream(self, kind: TargetKind, targets: Sequence[Sequence[float]], manual: bool = False) -> None:
        """100 set-points a second."""
        for target in targets:
            self.send(Setpoint(kind, tuple(target), manual))
            self.board.advance(PACE_S)
            self._listen()

    def go(self, pose: Sequence[float], seconds: float = 1.0) -> None:
        """From home to a pose along the straight line, and rest."""
        self.stream(TargetKind.POSE, way(self.board.robot.home, pose, round(seconds / PACE_S)).tolist())
        self.rest(pose)

    def rest(self, pose: Sequence[float]) -> None:
        """At a pose; a stream that ended at once would be taken for a lost one."""
        self.stream(TargetKind.POSE, [pose] * 20)
        self.until(lambda seen: seen.state == State.READY)

    def _listen(self) -> None:
        for payload in self.decoder.feed(self.board.transmit()):
            message, number = unpack(payload)
            if isinstance(message, Telemetry):
                self.telemetry = message
            else:
                self.heard.append((message, number))


def way(start: ArrayLike, end: ArrayLike, steps: int) -> NDArray[np.float64]:
    """(steps, n) from start, excluded, to end, with a smooth beginning and end."""
    share = np.linspace(0.0, 1.0, steps + 1)[1:, None]
    share = share * share * (3.0 - 2.0 * share)
    return np.asarray(start) + share * (np.asarray(end) - np.asarray(start))
