"""The C framing against the standard library's CRC and a COBS decoder of a few lines."""

from __future__ import annotations

import binascii
import ctypes

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.link.emulated.compiled import load_library
from tests.support.tools import needs

pytestmark = needs("gcc")

payloads = st.binary(min_size=3, max_size=56) | st.lists(st.sampled_from([0, 1, 255]), min_size=3, max_size=56).map(
    bytes
)


def encode(payload: bytes) -> bytes:
    frame = ctypes.create_string_buffer(61)
    length = load_library().dlh_encode(payload, len(payload), frame)
    return frame.raw[:length]


def decode(stream: bytes) -> tuple[list[bytes], int]:
    """The good payloads, and how many pieces were bad."""
    found, bad = ctypes.create_string_buffer(len(stream) * 10 + 1), ctypes.c_uint32()
    used = load_library().dlh_decode(stream, len(stream), found, ctypes.byref(bad))
    content, at = [], 0
    while at < used:
        length = found.raw[at]
        content.append(found.raw[at + 1 : at + 1 + length])
        at += 1 + length
    return content, bad.value


def unstuffed(frame: bytes) -> bytes:
    """Consistent overhead byte stuffing undone, as its definition says."""
    content, code = bytearray(), 0
    for at, byte in enumerate(frame):
        if code == 0:
            if at:
                content.append(0)
            code = byte
        else:
            content.append(byte)
        code -= 1
    assert code == 0
    return bytes(content)


@settings(max_examples=40)
@given(payloads)
def test_a_frame_is_cobs_of_payload_and_crc(payload):
    frame = encode(payload)
    assert frame[0] == frame[-1] == 0 and 0 not in frame[1:-1]
    assert unstuffed(frame[1:-1]) == payload + binascii.crc_hqx(payload, 0xFFFF).to_bytes(2, "big")


@settings(max_examples=40)
@given(st.lists(payloads, max_size=5))
def test_frames_are_read_back_in_order(sent):
    assert decode(b"".join(map(encode, sent))) == (sent, 0)


@settings(max_examples=40)
@given(payloads, st.integers(0, 60), st.integers(0, 7))
def test_a_flipped_bit_is_noticed_and_the_next_frame_is_good(payload, place, bit):
    frame = bytearray(encode(payload))
    frame[place % len(frame)] ^= 1 << bit
    found, bad = decode(bytes(frame) + encode(b"next"))
    assert found[-1] == b"next"
    assert payload not in found[:-1] or place % len(frame) in (0, len(frame) - 1)
    assert bad or place % len(frame) in (0, len(frame) - 1)


@settings(max_examples=40)
@given(payloads, st.integers(0, 60))
def test_a_frame_cut_anywhere_is_never_taken_for_the_whole(payload, place):
    frame = encode(payload)
    cut = place % len(frame)
    found, _ = decode(frame[:cut] + encode(b"next"))
    assert found.pop() == b"next"
    # Without its last zero it is whole. A CRC may be right for the beginning too: the type's length tells then.
    assert all(len(one) < len(payload) or cut == len(frame) - 1 for one in found)


@settings(max_examples=40)
@given(st.binary(max_size=400))
def test_noise_never_hides_the_next_frame(noise):
    assert decode(noise + encode(b"after"))[0][-1] == b"after"


@pytest.mark.parametrize("length", [0, 1, 2, 57, 58, 59, 100, 250])
def test_a_payload_of_a_wrong_length_is_bad(length):
    payload = b"\x01" * length
    body = payload + binascii.crc_hqx(payload, 0xFFFF).to_bytes(2, "big")
    blocks = b"".join(bytes([len(block) + 1]) + block for block in body.split(b"\0"))
    assert decode(b"\0" + blocks + b"\0") == ([], 1)


def test_borders_alone_are_nothing():
    assert decode(bytes(20)) == ([], 0)
