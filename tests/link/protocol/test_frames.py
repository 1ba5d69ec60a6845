"""Frames against another COBS, and what noise does to them."""

from __future__ import annotations

import binascii
import random

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from app.link.protocol.frames import FRAME_MAX, FrameDecoder, encode_frame
from app.link.protocol.messages import pack
from tests.link.protocol.strategies import messages, payloads, u16

AFTER = b"\x05\x00\x00\x00\x07"


def slow_cobs(data: bytes) -> bytes:
    """Byte by byte, as the algorithm is usually told."""
    out, place = bytearray([0]), 0
    for byte in data:
        if byte:
            out.append(byte)
        else:
            out[place], place = len(out) - place, len(out)
            out.append(0)
    out[place] = len(out) - place
    return bytes(out)


@given(payloads)
@example(bytes(56))
@example(bytes(range(1, 57)))
def test_a_frame_is_the_stuffed_payload_between_zeros(payload):
    crc = binascii.crc_hqx(payload, 0xFFFF).to_bytes(2, "big")
    frame = encode_frame(payload)
    assert frame == b"\0" + slow_cobs(payload + crc) + b"\0"
    assert len(frame) == len(payload) + 5 <= FRAME_MAX
    assert FrameDecoder().feed(frame) == [payload]


def test_the_checksum_is_the_one_of_the_textbook():
    """CRC-16/CCITT-FALSE of "123456789" is 29B1."""
    assert encode_frame(b"123456789") == b"\0\x0c123456789\x29\xb1\0"


@pytest.mark.parametrize("length", [0, 2, 57])
def test_a_payload_of_a_wrong_length_is_not_sent(length):
    with pytest.raises(ValueError, match="3 to 56"):
        encode_frame(bytes(length))


@given(st.lists(st.tuples(messages, u16), max_size=8), st.lists(st.integers(1, 9), min_size=1, max_size=5))
def test_pieces_of_any_size_give_the_same_frames(conversation, sizes):
    payloads = [pack(message, number) for message, number in conversation]
    stream = b"".join(map(encode_frame, payloads))
    decoder, found, at, turn = FrameDecoder(), [], 0, 0
    while at < len(stream):
        size = sizes[turn % len(sizes)]
        found += decoder.feed(stream[at : at + size])
        at, turn = at + size, turn + 1
    assert found == payloads
    assert (decoder.good, decoder.bad) == (len(payloads), 0)


@given(st.lists(st.binary(max_size=300), max_size=10), payloads)
def test_after_any_bytes_the_next_frame_is_good(noise, payload):
    decoder = FrameDecoder()
    for piece in noise:
        decoder.feed(piece)
    assert decoder.feed(encode_frame(payload))[-1:] == [payload]


def test_a_frame_cut_at_every_byte_costs_only_itself():
    """Where the CRC ends in a zero, that zero may be missing and the CRC is still right: over a payload that is one
    byte shorter, which its length gives away."""
    rng, shorter = random.Random(2), 0
    for _ in range(600):
        payload = rng.randbytes(rng.randrange(3, 57))
        frame = encode_frame(payload)
        for cut in range(len(frame) - 1):  # without its last border it is whole: the next frame ends it
            found = FrameDecoder().feed(frame[:cut] + encode_frame(AFTER))
            assert found in ([AFTER], [payload[:-1], AFTER])
            shorter += len(found) - 1
    assert shorter < 10


def test_every_flipped_bit_is_noticed():
    payload = bytes(range(40))
    frame = encode_frame(payload)
    for bit in range(8, 8 * (len(frame) - 1)):
        spoilt = bytearray(frame)
        spoilt[bit // 8] ^= 1 << bit % 8
        decoder = FrameDecoder()
        assert decoder.feed(bytes(spoilt) + encode_frame(AFTER)) == [AFTER]
        assert decoder.bad >= 1


def test_lost_and_inserted_bytes_cost_only_their_frame():
    rng = random.Random(1)
    decoder, accepted = FrameDecoder(), 0
    for number in range(3000):
        payload = rng.randbytes(rng.randrange(3, 57))
        spoilt = bytearray(encode_frame(payload))
        at = rng.randrange(1, len(spoilt) - 1)
        if number % 2:
            del spoilt[at]
        else:
            spoilt.insert(at, rng.randrange(256))
        found = decoder.feed(bytes(spoilt) + encode_frame(AFTER))
        assert found[-1] == AFTER
        accepted += sum(one != payload for one in found[:-1])
    assert accepted <= 2, "a CRC of 16 bits lets one in 65536 pass"


def test_endless_bytes_without_a_border_take_no_memory():
    decoder = FrameDecoder()
    for _ in range(100):
        assert decoder.feed(b"\x01" * 10_000) == []
    assert len(decoder._begun) < 100
    assert decoder.feed(encode_frame(AFTER)) == [AFTER]
    assert (decoder.good, decoder.bad) == (1, 1)
