"""The same firmware in real time behind a pseudo terminal, through pyserial."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import pytest
import serial

from app.link.protocol.codes import BoardKind, Command, Refusal, Reset, State
from app.link.protocol.frames import FrameDecoder, encode_frame
from app.link.protocol.messages import Ack, Hello, Identity, Message, Order, Telemetry, pack, unpack
from tests.support.emulators.uno.build import needs_uno
from tests.support.emulators.uno.live import UnoPty

pytestmark = needs_uno
PATIENCE_S = 10.0


@pytest.fixture
def board() -> Iterator[UnoPty]:
    board = UnoPty("delta3_servo", boot_ms=200)
    yield board
    board.close()


class Host:
    """The least that can talk to a board."""

    def __init__(self, port: serial.Serial) -> None:
        self._port, self._decoder = port, FrameDecoder()

    def hear(self, wanted: Callable[[Message], bool], again: Message | None = None) -> Message:
        """The first message of that kind; `again` is repeated until it comes."""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            if again:
                self._port.write(encode_frame(pack(again, 7)))
            for payload in self._decoder.feed(self._port.read(200)):
                message, _ = unpack(payload)
                if wanted(message):
                    return message
        pytest.fail("The board did not answer in time.")


def test_opening_the_port_resets_the_board_and_then_it_answers(board: UnoPty) -> None:
    assert board.rig.uno.resets == 0
    with serial.Serial(board.port, 115200, timeout=0.05) as port:
        host = Host(port)
        told = host.hear(lambda m: isinstance(m, Telemetry))
        assert isinstance(told, Telemetry) and told.state == State.OFF
        identity = host.hear(lambda m: isinstance(m, Identity), again=Hello())
        assert isinstance(identity, Identity)
        assert (identity.board, identity.reset) == (BoardKind.UNO, Reset.LINE)
        assert isinstance(answer := host.hear(lambda m: isinstance(m, Ack), again=Order(Command.ENABLE)), Ack)
        assert answer.result == Refusal.OK
        host.hear(lambda m: isinstance(m, Telemetry) and m.state == State.READY, again=Hello())
        assert board.rig.uno.resets == 1
    end = time.monotonic() + PATIENCE_S
    while board.is_open and time.monotonic() < end:
        time.sleep(0.01)
    with serial.Serial(board.port, 115200, timeout=0.05) as port:
        told = Host(port).hear(lambda m: isinstance(m, Telemetry))
        assert isinstance(told, Telemetry) and told.state == State.OFF
        assert board.rig.uno.resets == 2
