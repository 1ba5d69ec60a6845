"""The robot on the cable, for many people at once: one thread owns the port, everybody else sends it messages."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from queue import Empty, SimpleQueue
from typing import Any, NamedTuple

from app.link.carrier import Carrier
from app.link.errors import LinkError
from app.link.lease import Person
from app.link.orders import Orders
from app.link.pilot import Pilot
from app.link.ports import Port, list_ports
from app.link.programs import Jog, Program
from app.link.protocol.messages import Test
from app.link.snapshot import Camera
from app.link.status import LinkStatus
from app.link.transport import Transport, open_transport
from app.link.twin.recording import Recording

Answer = Future[None]

TURN_S = 0.005
"""The thread looks for bytes so often; an order wakes it at once."""

IDLE_TURN_S = 0.02
"""Without a port there are only people to look after."""


class _Order(NamedTuple):
    carry_out: Callable[[float], Any]
    answer: Future[Any]


class RobotLink:
    """Every method may be called from any thread and returns at once. The answer fails with a `LinkError` of one
    sentence where something is refused; it comes from the link's thread, which must not be made to wait.

    An answer says that an order was accepted (a motion has begun, a board has obeyed), not that a motion is over:
    that shows in `status`.
    """

    def __init__(
        self,
        clock: Callable[[], float] = time.monotonic,
        open_port: Callable[[str], Transport] = open_transport,
        ports: Callable[[], Sequence[Port]] = list_ports,
        threaded: bool = True,
    ) -> None:
        """
        Args:
            threaded: False leaves it to the caller to call `turn` every few milliseconds.
        """
        self._clock = clock
        self._pilot = Pilot()
        self._orders = Orders(self._pilot)
        self._carrier = Carrier(self._pilot, open_port, ports)
        self._camera = Camera(self._pilot)
        self._queue: SimpleQueue[_Order] = SimpleQueue()
        self._status = LinkStatus()
        self._answered: list[tuple[Future[Any], Future[Any]]] = []
        self._closing = self._closed = False
        self._thread = threading.Thread(target=self._live, name="robot link", daemon=True) if threaded else None
        if self._thread:
            self._thread.start()

    @property
    def status(self) -> LinkStatus:
        """The newest snapshot."""
        return self._status

    def connect(self, port: str, robot: str | None = None) -> Answer:
        """Open a port and get to know its board.

        Args:
            robot: its name; the board must have that robot, with dimensions that the lab knows. None takes the
                robot that the board has.
        """
        return self._send(self._orders.connect, port, robot)

    def disconnect(self) -> Answer:
        return self._send(self._orders.disconnect)

    def request(self, person: Person) -> Answer:
        """Take the robot, or a place in the queue; `status` tells which."""
        return self._send(self._orders.request, person)

    def release(self, person: Person) -> Answer:
        return self._send(self._orders.release, person)

    def take_over(self, person: Person) -> Answer:
        """Instructors only: the robot halts and is theirs."""
        return self._send(self._orders.take_over, person)

    def hand_to(self, giver: Person, person: Person) -> Answer:
        """Instructors only: the robot halts and is that person's."""
        return self._send(self._orders.hand_to, giver, person)

    def alive(self, person: Person) -> Answer:
        """A sign of life, about once a second, of everybody who holds or waits."""
        return self._send(self._orders.alive, person)

    def stop(self, person: Person) -> Answer:
        """Anyone: a controlled stop; the motors hold."""
        return self._send(self._orders.stop, person)

    def power_off(self, person: Person) -> Answer:
        """Holder or instructor. The arms may fall."""
        return self._send(self._orders.power_off, person)

    def clear(self, person: Person) -> Answer:
        return self._send(self._orders.clear, person)

    def enable(self, person: Person) -> Answer:
        return self._send(self._orders.enable, person)

    def home(self, person: Person) -> Answer:
        return self._send(self._orders.home, person)

    def resume(self, person: Person) -> Answer:
        """After the board held; a paused program goes on."""
        return self._send(self._orders.resume, person)

    def jog(self, person: Person, jog: Jog) -> Answer:
        """Begin, and renew every 50 ms: without a renewal the robot halts after 125 ms."""
        return self._send(self._orders.jog, person, jog)

    def jog_release(self, person: Person) -> Answer:
        return self._send(self._orders.jog_release, person)

    def step(self, person: Person, jog: Jog, size: float) -> Answer:
        """By `size` (rad or m, above 0) along the axis and direction of a jog, at most with its speed."""
        return self._send(self._orders.step, person, jog, size)

    def mirror(self, person: Person, pose: tuple[float, ...]) -> Answer:
        """Follow the newest pose (dof,), until `mirror_end`."""
        return self._send(self._orders.mirror, person, pose)

    def mirror_end(self, person: Person) -> Answer:
        return self._send(self._orders.mirror_end, person)

    def run(self, person: Person, program: Program) -> Answer:
        return self._send(self._orders.run, person, program)

    def pause(self, person: Person) -> Answer:
        return self._send(self._orders.pause, person)

    def cancel(self, person: Person) -> Answer:
        """End a program, or whatever else moves the robot."""
        return self._send(self._orders.cancel, person)

    def set_override(self, person: Person, share: float) -> Answer:
        """Of the speed of every motion, 0.05 to 1."""
        return self._send(self._orders.set_override, person, share)

    def apply_settings(self, person: Person, values: Mapping[int, float], save: bool = False) -> Answer:
        """Set by id; each is read back and compared. Saving needs the motors off."""
        return self._send(self._orders.apply_settings, person, dict(values), save)

    def restore_defaults(self, person: Person) -> Answer:
        """The settings as the firmware was built, read anew; not saved. Needs the motors off."""
        return self._send(self._orders.restore_defaults, person)

    def read_settings(self) -> Answer:
        """All of them again; they arrive in `status` one after the other."""
        return self._send(self._orders.read_settings)

    def test(self, person: Person, test: Test) -> Future[Recording]:
        """A short experiment on one joint; the answer comes when it is over."""
        return self._send(self._orders.test, person, test)

    def start_recording(self) -> Answer:
        """Anyone; a recording that runs begins anew."""
        return self._send(self._orders.start_recording)

    def stop_recording(self) -> Future[Recording]:
        return self._send(self._orders.stop_recording)

    def close(self) -> None:
        """Halt what moves, close the port, and wait for the thread."""
        self._send(self._orders.disconnect)
        self._closing = True
        self._send(lambda now: None)
        if self._thread:
            self._thread.join()
        else:
            self._live()

    def turn(self, wait_s: float = 0.0) -> None:
        """Carry out what was ordered, or what comes within `wait_s`; then read, decide, write."""
        self._carry_out_orders(wait_s)
        now = self._clock()
        self._carrier.turn(now)
        self._status = self._camera.take(now)
        self._pass_answers_on()

    def _send(self, order: Callable[..., Any], *arguments: Any) -> Future[Any]:
        answer: Future[Any] = Future()
        if self._closed:
            answer.set_exception(LinkError("The link is closed; start the program again."))
            return answer
        self._queue.put(_Order(lambda now: order(*arguments, now=now), answer))
        return answer

    def _live(self) -> None:
        try:
            while not self._closing:
                self.turn(self._pause_s())
            self.turn()  # what was ordered last: the board is told to halt, and every order gets its answer
        finally:
            self._closed = True
            self._carrier.close()
            self._status = LinkStatus(sentence="The link is closed; start the program again.")
            self._pass_answers_on()

    def _pause_s(self) -> float:
        if not self._pilot.connection.port:
            return IDLE_TURN_S
        return min(max(self._carrier.next_tick_s - self._clock(), 0.0), TURN_S)

    def _carry_out_orders(self, wait_s: float) -> None:
        """Those that wait, or the first that comes within `wait_s`."""
        try:
            order = self._queue.get(timeout=wait_s) if wait_s else self._queue.get_nowait()
            while True:
                self._carry_out(order)
                order = self._queue.get_nowait()
        except Empty:
            return

    def _carry_out(self, order: _Order) -> None:
        if not order.answer.set_running_or_notify_cancel():
            return
        result: Future[Any] = Future()
        try:
            given = order.carry_out(self._clock())
        except Exception as error:  # also a caller's bug goes to the caller: the link is everybody's
            result.set_exception(error)
        else:
            if isinstance(given, Future):
                result = given
            else:
                result.set_result(given)
        result.add_done_callback(lambda inner: self._answered.append((inner, order.answer)))

    def _pass_answers_on(self) -> None:
        """After the snapshot: whoever gets an answer finds what it means in `status`."""
        answered, self._answered = self._answered, []
        for inner, outer in answered:
            error = inner.exception()
            if error is None:
                outer.set_result(inner.result())
            else:
                outer.set_exception(error)
