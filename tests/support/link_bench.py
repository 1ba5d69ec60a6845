"""A pilot and an emulated board on one virtual clock: nothing sleeps, the same calls give the same bytes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any

from app.link.carrier import Carrier
from app.link.emulated.board import EmulatedBoard
from app.link.errors import LinkError, LinkLost
from app.link.lease import Person
from app.link.orders import Orders
from app.link.pilot import Pilot
from app.link.ports import Port
from app.link.protocol.codes import State
from app.link.protocol.frames import FrameDecoder
from app.link.protocol.messages import Message, Order, unpack
from app.link.snapshot import Camera
from app.link.status import LinkStatus

ANNA = Person("a", "Anna")
BEN = Person("b", "Ben")
CARLA = Person("c", "Carla", instructor=True)
TURN_S = 0.005


class Cable:
    """A transport to a board that lives in virtual time."""

    def __init__(self, board: EmulatedBoard, name: str, sent: Callable[[bytes], None]) -> None:
        self.board, self.name, self._sent = board, name, sent
        self.closed = False

    def read(self) -> bytes:
        self._check()
        return self.board.transmit()

    def write(self, data: bytes) -> None:
        self._check()
        self._sent(data)
        self.board.receive(data)

    def close(self) -> None:
        self.closed = True

    def _check(self) -> None:
        if self.closed or self.board.faults.unplugged:
            raise LinkLost(f"The connection to {self.name} is gone; check the cable and connect again.")


class Bench:
    """Orders with the present time filled in; `said` are the host's messages, with their times."""

    def __init__(self, board: EmulatedBoard, port: str = "usb0") -> None:
        self.now = 100.0
        self.port = port
        self.boards = {port: board}
        self.plugged = [Port(port, "a board", 0x2341, 0x43, "77")]
        self.said: list[tuple[float, Message]] = []
        self.pilot = Pilot()
        self.orders = Orders(self.pilot)
        self.carrier = Carrier(self.pilot, self._open, lambda: self.plugged)
        self.camera = Camera(self.pilot)
        self.opened: list[str] = []
        self.lively: set[Person] = set()
        """Give a sign of life once a second."""
        self._decoder = FrameDecoder()

    @property
    def board(self) -> EmulatedBoard:
        return self.boards[self.port]

    @property
    def status(self) -> LinkStatus:
        return self.camera.take(self.now)

    @property
    def state(self) -> State:
        telemetry = self.status.telemetry
        assert telemetry is not None
        return telemetry.state

    def order(self, name: str, *arguments: Any) -> Any:
        """As the link's thread does: carried out, then the next turn without delay."""
        answer = getattr(self.orders, name)(*arguments, now=self.now)
        self.carrier.turn(self.now)
        return answer

    def refused(self, name: str, *arguments: Any) -> str:
        """The sentence with which an order is refused at once."""
        try:
            self.order(name, *arguments)
        except LinkError as error:
            return str(error)
        raise AssertionError(f"{name} was not refused")

    def run(self, seconds: float) -> None:
        """Let time pass for both."""
        for _ in range(round(seconds / TURN_S)):
            self.turn()

    def run_until(self, true: Callable[[], bool], within_s: float = 10.0) -> None:
        """Let time pass until something holds."""
        for _ in range(round(within_s / TURN_S)):
            if true():
                return
            self.turn()
        raise AssertionError(f"not within {within_s} s; {self.status.sentence}")

    def turn(self) -> None:
        self.now += TURN_S
        for board in self.boards.values():
            board.advance(TURN_S)
        if int(self.now) != int(self.now - TURN_S):
            for person in self.lively:
                self.orders.alive(person, self.now)
        self.carrier.turn(self.now)

    def answer(self, name: str, *arguments: Any, within_s: float = 5.0) -> Any:
        """Give an order and wait for its answer."""
        answer = self.order(name, *arguments)
        if answer is None:
            return None
        self.run_until(answer.done, within_s)
        return answer.result()

    def connect(self, robot: str | None = None) -> None:
        self.answer("connect", self.port, robot)
        self.run_until(lambda: self.status.telemetry is not None)

    def give(self, person: Person) -> None:
        """The robot to somebody who stays awake."""
        self.order("request", person)
        self.lively.add(person)

    def enable(self, person: Person = ANNA) -> None:
        """Connected, held, with power."""
        self.connect()
        self.give(person)
        self.answer("enable", person)
        self.run_until(lambda: self.state is State.READY)

    def home(self, person: Person = ANNA) -> None:
        """Ready, and homed."""
        self.enable(person)
        self.answer("home", person)
        self.run_until(self.pilot.is_homed, 30.0)
        self.run(0.1)

    def commands(self, since: float = 0.0) -> Counter[str]:
        """How often each command was written, repetitions included."""
        return Counter(said.command.name for time, said in self.said if isinstance(said, Order) and time >= since)

    def count(self, kind: type[Message], since: float = 0.0) -> int:
        return sum(isinstance(said, kind) for time, said in self.said if time >= since)

    def _open(self, port: str) -> Cable:
        if port not in self.boards or self.boards[port].faults.unplugged:
            raise LinkError(f"There is no port {port}; plug the board in and choose one of the list.")
        self.opened.append(port)
        return Cable(self.boards[port], port, self._note)

    def _note(self, data: bytes) -> None:
        self.said += [(self.now, unpack(payload)[0]) for payload in self._decoder.feed(data)]
