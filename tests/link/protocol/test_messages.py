"""Messages there and back, byte by byte against the document, and what is no message."""

from __future__ import annotations

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.link.errors import ProtocolError
from app.link.protocol import codes
from app.link.protocol.messages import PAYLOAD_LENGTHS, Order, Set, Setpoint, Telemetry, pack, unpack
from tests.link.protocol.strategies import messages, u16


@given(messages, u16)
def test_a_message_is_read_back(message, number):
    payload = pack(message, number)
    assert unpack(payload) == (message, number)
    assert len(payload) == PAYLOAD_LENGTHS[codes.MessageType(payload[0])]


@given(st.binary(max_size=60))
def test_any_bytes_are_a_message_or_refused(payload):
    try:
        message, number = unpack(payload)
    except ProtocolError:
        return
    again = unpack(pack(message, number))
    assert again == (message, number) or "nan" in repr(message)


@given(messages, st.integers(0, 60))
def test_a_wrong_length_is_refused(message, length):
    payload = pack(message, 0)
    cut = (payload + bytes(60))[:length]
    if len(cut) != len(payload):
        with pytest.raises(ProtocolError):
            unpack(cut)


def test_a_setpoint_lies_in_its_bytes_as_documented():
    message = Setpoint(codes.TargetKind.POSE, (0.5, -1.0, 2.0, 0.25), manual=True, pen_down=True, laser=255)
    numbers = "0000003f 000080bf 00000040 0000803e"
    assert pack(message, 0x0201) == bytes.fromhex("03 0102 01 03 ff " + numbers)


def test_telemetry_lies_in_its_bytes_as_documented():
    message = Telemetry(
        codes.State.FAULT,
        codes.Flag.HOMED | codes.Flag.ESTOP_OPEN,
        codes.Fault.FOLLOWING,
        2,
        codes.Refusal.JUMP,
        0b101,
        0x01020304,
        (1.0, 2.0, 3.0, 4.0),
        (5.0, 6.0, 7.0, 8.0),
        (1.0, -1.0, 0.0, 64 / 127),
        0x1122,
        0x3344,
        99,
    )
    floats = struct.pack("<8f", *range(1, 9)).hex()
    wanted = f"81 ffff 07 09 04 02 07 05 04030201 {floats} 7f 81 00 40 2211 4433 63"
    assert pack(message, -1) == bytes.fromhex(wanted)


def test_three_joints_are_filled_up():
    found, _ = unpack(pack(Setpoint(codes.TargetKind.JOINTS, (1.0, 2.0, 3.0)), 0))
    assert found == Setpoint(codes.TargetKind.JOINTS, (1.0, 2.0, 3.0, 0.0))


def test_a_number_that_does_not_fit_is_refused_with_a_sentence():
    for message in (Set(1, 1e39), Set(300, 1.0), Order(codes.Command.STOP, -1)):
        with pytest.raises(ProtocolError, match="cannot carry"):
            pack(message, 0)


def test_numbers_that_are_not_finite_travel():
    """A board must refuse them itself."""
    assert unpack(pack(Set(1, math.inf), 0))[0] == Set(1, math.inf)
    assert "nan" in repr(unpack(pack(Set(1, math.nan), 0))[0])
