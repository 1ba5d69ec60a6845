"""Emulated boards in real time, by the names of their ports."""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Callable

import pytest

from app.link.emulated import EmulatedBoard, Faults, SimTransport
from app.link.emulated.options import board_of
from app.link.errors import LinkError, LinkLost
from app.link.protocol.codes import DriveKind, Reset
from app.link.protocol.frames import FrameDecoder, encode_frame
from app.link.protocol.messages import Hello, Identity, Message, Telemetry, pack, unpack
from app.link.transport import Transport, open_transport

PATIENCE_S = 10.0


def listen(transport: Transport, enough: Callable[[list[Message]], bool]) -> list[Message]:
    decoder, heard, end = FrameDecoder(), [], time.monotonic() + PATIENCE_S
    while not enough(heard) and time.monotonic() < end:
        heard += [unpack(payload)[0] for payload in decoder.feed(transport.read())]
        time.sleep(0.005)
    return heard


def test_it_talks_in_real_time_and_answers():
    transport = open_transport("sim:par4?core=twin")
    heard = listen(transport, lambda heard: len(heard) > 15)
    times = [message.t_us for message in heard if isinstance(message, Telemetry)]
    assert {b - a for a, b in itertools.pairwise(times)} == {20_000}
    transport.write(encode_frame(pack(Hello(), 5)))
    assert any(isinstance(message, Identity) for message in listen(transport, lambda heard: len(heard) > 4))
    assert transport.name == "sim:par4?core=twin"
    transport.close()


def test_its_watchdogs_run_although_nobody_reads():
    board = EmulatedBoard("delta3", core="twin", boot_s=0.0)
    transport = SimTransport(board)
    end = time.monotonic() + PATIENCE_S
    while board.time_s < 0.1 and time.monotonic() < end:
        time.sleep(0.01)
    assert board.time_s >= 0.1
    transport.close()


def test_closing_ends_it():
    before = threading.active_count()
    transport = open_transport("sim:linear?core=twin")
    transport.close()
    transport.close()
    assert threading.active_count() == before
    with pytest.raises(LinkLost):
        transport.read()
    with pytest.raises(LinkLost):
        transport.write(b"x")


def test_a_pulled_cable_is_noticed():
    board = EmulatedBoard("par4", core="twin")
    transport = SimTransport(board)
    assert transport.name == "sim:par4"
    board.faults = Faults(unplugged=True)
    with pytest.raises(LinkLost, match="check the cable"):
        transport.read()
    with pytest.raises(LinkLost, match="check the cable"):
        transport.write(b"x")
    transport.close()
    with pytest.raises(LinkError, match="pulled"):
        SimTransport(board)


def test_opening_resets_a_uno_and_no_other_board():
    for robot, wanted in (("delta3", Reset.LINE), ("par4", Reset.POWER)):
        transport = open_transport(f"sim:{robot}?core=twin&boot_ms=0")
        transport.write(encode_frame(pack(Hello(), 1)))
        heard = listen(transport, lambda heard: any(isinstance(message, Identity) for message in heard))
        assert [message.reset for message in heard if isinstance(message, Identity)] == [wanted]
        transport.close()


def test_options_say_what_is_wrong_with_the_board():
    board = board_of(
        "sim:delta3?noise=0.01&loss=0.5&delay_ms=20&stuck_joint=3&limit_switch=1&sensor_broken=2&estop=1&drive=dc"
        "&core=twin&serial=99&boot_ms=1000&misaligned=0.01,0,-0.02"
    )
    assert board.faults == Faults(0.01, 0.5, 0.02, stuck_joint=2, limit_switch=0, sensor_broken=1, estop=True)
    assert (board.drive, board.serial) == (DriveKind.DC, 99)


@pytest.mark.parametrize(
    ("port", "what"),
    [
        ("sim:scara", "choose one of sim:par4"),
        ("sim:", "choose one of sim:par4"),
        ("sim:par4?nois=1", "has no option 'nois'"),
        ("sim:par4?noise=2", "between 0 and 1"),
        ("sim:par4?noise=nan", "between 0 and 1"),
        ("sim:par4?noise", "between 0 and 1"),
        ("sim:par4?stuck_joint=5", "1 to 4"),
        ("sim:delta3?stuck_joint=4", "1 to 3"),
        ("sim:par4?drive=steam", "servo, dc, stepper"),
        ("sim:linear?drive=servo&core=twin", "another drive"),
        ("sim:par4?misaligned=0.1", "4 numbers"),
        ("sim:par4?core=quantum", "compiled, twin"),
        ("sim:par4?estop=maybe", "0, 1"),
        ("sim:par4?delay_ms=-1", "milliseconds"),
        ("sim:par4?unplugged=1&core=twin", "pulled"),
    ],
)
def test_a_name_that_makes_no_sense_is_one_sentence(port: str, what: str):
    with pytest.raises(LinkError, match=what) as found:
        open_transport(port)
    assert str(found.value).endswith(".")
