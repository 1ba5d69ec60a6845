"""Frames on the wire: 00 | COBS(payload, CRC) | 00.

COBS (consistent overhead byte stuffing): each zero becomes the distance to the next one, so that 00 is always a border.
"""

from __future__ import annotations

import binascii

MIN_PAYLOAD, MAX_PAYLOAD = 3, 56
_CRC_BYTES = 2
_MAX_STUFFED = MAX_PAYLOAD + _CRC_BYTES + 1
FRAME_MAX = _MAX_STUFFED + 2
"""Bytes of the longest frame, with its borders."""


def encode_frame(payload: bytes) -> bytes:
    """The bytes to send for a payload of 3 to 56 bytes."""
    if not MIN_PAYLOAD <= len(payload) <= MAX_PAYLOAD:
        raise ValueError(f"A payload has {MIN_PAYLOAD} to {MAX_PAYLOAD} bytes, not {len(payload)}.")
    blocks = (payload + _crc(payload)).split(b"\0")
    return b"\0" + b"".join(bytes([len(block) + 1]) + block for block in blocks) + b"\0"


class FrameDecoder:
    """Takes bytes as they come, in pieces of any size, and finds the payloads in them."""

    def __init__(self) -> None:
        self.good = 0
        """Frames whose CRC was right."""
        self.bad = 0
        """Pieces between two borders that were no frame."""
        self._begun = b""

    def feed(self, data: bytes) -> list[bytes]:
        """The payloads that these bytes complete, in order. Never raises."""
        *ended, begun = (self._begun + data).split(b"\0")
        self._begun = begun[: _MAX_STUFFED + 1]  # what is longer is no frame, whatever follows
        payloads = [self._payload(piece) for piece in ended if piece]
        return [payload for payload in payloads if payload is not None]

    def _payload(self, stuffed: bytes) -> bytes | None:
        content = _unstuffed(stuffed) if len(stuffed) <= _MAX_STUFFED else b""
        payload, crc = content[:-_CRC_BYTES], content[-_CRC_BYTES:]
        if len(payload) < MIN_PAYLOAD or crc != _crc(payload):
            self.bad += 1
            return None
        self.good += 1
        return payload


def _unstuffed(stuffed: bytes) -> bytes:
    """Empty where the distances do not lead exactly to the end."""
    blocks, at = [], 0
    while at < len(stuffed):
        end = at + stuffed[at]
        blocks.append(stuffed[at + 1 : end])
        at = end
    return b"\0".join(blocks) if at == len(stuffed) else b""


def _crc(payload: bytes) -> bytes:
    return binascii.crc_hqx(payload, 0xFFFF).to_bytes(_CRC_BYTES, "big")
