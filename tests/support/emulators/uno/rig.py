"""A whole robot with an Uno, in lockstep: processor, joints and the host's end of the cable."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

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
from tests.support.emulators.uno.build import firmware
from tests.support.emulators.uno.plants import ESTOP, PLANTS, SWITCHES, Plant
from tests.support.emulators.uno.uno import UnoSim

Kind = TypeVar("Kind", bound=Message)
SIGN_OF_LIFE_US = 50_000
STREAM_S = 0.01
START_S = 0.03
"""Until a board that was just switched on listens."""


class Rig:
    """Everything is stepped together; what the board says lies in `heard`, with the number it answers."""

    def __init__(self, variant: str, plant: Plant | None = None, eeprom: bytes | None = None) -> None:
        self.uno = UnoSim(firmware(variant), eeprom)
        self.plant = plant or PLANTS[variant]()
        self.heard: list[tuple[Message, int]] = []
        self.decoder = FrameDecoder()
        self._number = 0
        self._alive_due_us: float | None = None
        self.uno.drive_pin(ESTOP, False)
        for pin in SWITCHES:
            self.uno.drive_pin(pin, True)
        self.plant.attach(self.uno)
        self.run(START_S)

    def close(self) -> None:
        self.uno.close()

    def run(self, seconds: float) -> None:
        """Let time pass; with `live` a sign of life goes out in between."""
        for _ in range(max(1, round(1e6 * seconds / self.plant.step_us))):
            if self._alive_due_us is not None and self.uno.now_us >= self._alive_due_us:
                self._alive_due_us = self.uno.now_us + SIGN_OF_LIFE_US
                self.send(Alive())
            self.uno.run(self.plant.step_us)
            self.plant.step(self.uno)
            self.heard += [unpack(payload) for payload in self.decoder.feed(self.uno.take())]

    def live(self, on: bool) -> None:
        """Whether signs of life go out while time passes."""
        self._alive_due_us = self.uno.now_us if on else None

    def send(self, message: Message) -> int:
        """Put a frame on the wire; returns its number."""
        self._number = (self._number + 1) & 0xFFFF
        self.uno.send(encode_frame(pack(message, self._number)))
        return self._number

    def until(self, met: Callable[[], bool], seconds: float) -> float:
        """Let time pass until something is so; returns how long it took.

        Raises:
            AssertionError: if it is not so after `seconds`.
        """
        begin = self.uno.now_us
        while not met():
            assert self.uno.now_us - begin < 1e6 * seconds, f"not so after {seconds} s: {self.telemetry}"
            self.run(1e-6 * self.plant.step_us)
        return 1e-6 * (self.uno.now_us - begin)

    def _answer(self, message: Message, kind: type[Kind]) -> Kind:
        number, first = self.send(message), len(self.heard)

        def answers() -> list[Kind]:
            return [m for m, n in self.heard[first:] if isinstance(m, kind) and n == number]

        self.until(lambda: bool(answers()), 0.3)
        return answers()[0]

    def identify(self) -> Identity:
        return self._answer(Hello(), Identity)

    def ask(self, message: Message) -> Ack:
        """The board's answer to a command, a setting or a test."""
        return self._answer(message, Ack)

    def order(self, command: Command) -> Refusal:
        return self.ask(Order(command)).result

    def set(self, setting: int, value: float) -> Refusal:
        return self.ask(Set(setting, value)).result

    def get(self, setting: int) -> float:
        return self.ask(Get(setting)).value

    @property
    def telemetry(self) -> Telemetry:
        """The newest."""
        return next(m for m, _ in reversed(self.heard) if isinstance(m, Telemetry))

    @property
    def all_telemetry(self) -> list[Telemetry]:
        return [m for m, _ in self.heard if isinstance(m, Telemetry)]

    @property
    def missed_ticks(self) -> int:
        """Control periods that the firmware had no time for."""
        return self.uno.variable("ticks_missed", 2)

    def wait_for(self, state: State, seconds: float = 0.3) -> float:
        """Until telemetry tells this state; returns how long it took."""
        first = len(self.heard)
        return self.until(lambda: any(_is(m, state) for m, _ in self.heard[first:]), seconds)

    def make_ready(self, home: bool = True) -> None:
        """Switched on and, if wanted, homed, with signs of life."""
        self.live(True)
        assert self.order(Command.ENABLE) == Refusal.OK
        self.run(0.01)
        if home:
            assert self.order(Command.HOME) == Refusal.OK
            self.wait_for(State.READY, 8.0)

    def follow(
        self, path: Callable[[float], tuple[float, ...]], seconds: float, pen_down: bool = False, laser: int = 0
    ) -> None:
        """Stream joint targets at 100 Hz."""
        for k in range(round(seconds / STREAM_S)):
            self.send(Setpoint(TargetKind.JOINTS, path(STREAM_S * k), pen_down=pen_down, laser=laser))
            self.run(STREAM_S)


def _is(message: Message, state: State) -> bool:
    return isinstance(message, Telemetry) and message.state == state
