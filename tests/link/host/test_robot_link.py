"""The thread, with an emulated board in real time: waits are long, nothing is asserted about short times."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator

import pytest

from app.link.emulated.board import EmulatedBoard
from app.link.errors import LinkError, LinkLost
from app.link.link import RobotLink
from app.link.programs import Jog
from app.link.protocol.codes import State
from tests.support.link_bench import ANNA, BEN

PATIENCE_S = 20.0
PORT = "sim:delta3?boot_ms=0"


@pytest.fixture
def link() -> Iterator[RobotLink]:
    link = RobotLink()
    yield link
    link.close()


def wait(true: Callable[[], bool]) -> None:
    end = time.monotonic() + PATIENCE_S
    while not true():
        assert time.monotonic() < end
        time.sleep(0.01)


def state(link: RobotLink) -> State | None:
    return link.status.telemetry.state if link.status.telemetry else None


def test_from_nothing_to_a_step_and_a_stop(link):
    assert link.status.phase == "none"
    link.connect(PORT, "delta3").result(PATIENCE_S)
    assert link.status.phase == "ready"  # whoever has the answer finds it in the status
    link.request(ANNA).result(PATIENCE_S)
    assert link.status.holder == ANNA
    wait(lambda: state(link) is State.OFF)
    link.enable(ANNA).result(PATIENCE_S)
    wait(lambda: state(link) is State.READY)
    link.step(ANNA, Jog("joint", 0, 1, 0.5), 0.05).result(PATIENCE_S)
    assert link.status.activity in ("step", "idle")
    wait(lambda: link.status.activity == "idle")
    link.stop(BEN).result(PATIENCE_S)
    wait(lambda: state(link) in (State.STOPPED, State.OFF))  # off, where the computer was too busy meanwhile
    link.disconnect().result(PATIENCE_S)
    assert link.status.phase == "none"


def test_a_refusal_comes_through_the_answer(link):
    with pytest.raises(LinkError, match="no port"):
        link.connect("/dev/nothing-here").result(PATIENCE_S)
    with pytest.raises(LinkError, match="Nobody has the robot"):
        link.enable(ANNA).result(PATIENCE_S)


def test_a_callers_bug_does_not_take_the_link_from_the_others(link):
    link.request(ANNA).result(PATIENCE_S)
    with pytest.raises(AttributeError):
        link.jog("Anna", None).result(PATIENCE_S)  # pyright: ignore[reportArgumentType]
    link.alive(ANNA).result(PATIENCE_S)
    assert link.status.holder == ANNA


def test_many_threads_may_ask_at_once(link):
    answers = []

    def ask(person):
        answers.extend(link.request(person) for _ in range(50))

    threads = [threading.Thread(target=ask, args=(person,)) for person in (ANNA, BEN)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for answer in answers:
        answer.result(PATIENCE_S)
    assert {link.status.holder, *link.status.queue} == {ANNA, BEN}


def test_an_order_wakes_the_thread(link):
    """Without a port the thread sleeps 20 ms a turn; ten orders one after the other take less than that each."""
    link.request(ANNA).result(PATIENCE_S)
    begin = time.monotonic()
    for _ in range(10):
        link.alive(ANNA).result(PATIENCE_S)
    assert time.monotonic() - begin < 2.0


class Cut:
    """A port whose cable is pulled on command."""

    name = "cut"

    def __init__(self) -> None:
        self.board = EmulatedBoard("delta3", boot_s=0.0)
        self.pulled = False
        self._last = time.monotonic()

    def read(self) -> bytes:
        if self.pulled:
            raise LinkLost("The connection to cut is gone; check the cable and connect again.")
        now = time.monotonic()
        self.board.advance(min(now - self._last, 0.5))
        self._last = now
        return self.board.transmit()

    def write(self, data: bytes) -> None:
        self.board.receive(data)

    def close(self) -> None:
        self.pulled = False


def test_a_pulled_cable_is_found_again():
    port = Cut()
    link = RobotLink(open_port=lambda name: port, ports=list)
    try:
        link.connect("cut").result(PATIENCE_S)
        port.pulled = True
        wait(lambda: link.status.phase == "lost")
        wait(lambda: link.status.phase == "ready")
        assert any("cable" in line.sentence for line in link.status.log)
    finally:
        link.close()


def test_closing_answers_what_was_ordered_before():
    link = RobotLink()
    answers = [link.request(ANNA), link.enable(ANNA)]
    link.close()
    assert answers[0].result(0) is None
    with pytest.raises(LinkError, match="No robot is connected"):
        answers[1].result(0)


def test_after_closing_an_order_is_refused():
    link = RobotLink()
    link.close()
    with pytest.raises(LinkError, match="closed"):
        link.request(ANNA).result(PATIENCE_S)
