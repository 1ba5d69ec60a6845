"""Bytes on the cable: check sums and framing. Bytes are written as text, or in hexadecimal as "01 00 ff"."""

from __future__ import annotations

import binascii

from app.classroom.lessons.formulas.registry import formula

MOST_BYTES = 254
"""One more would need COBS' long blocks."""


def bytes_of(text: str, hexadecimal: str) -> bytes:
    """One of the two has to be empty."""
    if bool(text) == bool(hexadecimal):
        raise ValueError("give either text or hex.")
    return bytes.fromhex(hexadecimal) if hexadecimal else text.encode()


@formula("crc16")
def crc16(text: str = "", hex: str = "") -> dict[str, int | str]:
    """CRC-16/CCITT-FALSE of some bytes: its `value`, `hex`, and the two bytes `high` and `low`."""
    value = binascii.crc_hqx(bytes_of(text, hex), 0xFFFF)
    return {"value": value, "hex": f"{value:04x}", "high": value >> 8, "low": value & 0xFF}


@formula("cobs")
def cobs(text: str = "", hex: str = "", at: int = 1) -> dict[str, int | str]:
    """Bytes after COBS: their `hex`, how many (`length`), and the one `at` a place from 1."""
    return _described(_stuffed(bytes_of(text, hex)), at)


@formula("frame")
def frame(text: str = "", hex: str = "", at: int = 1) -> dict[str, int | str]:
    """A payload as it goes over the cable, 00 | COBS(payload, CRC) | 00: its `hex`, `length`, and the byte `at`."""
    from app.link.protocol.frames import encode_frame

    return _described(encode_frame(bytes_of(text, hex)), at)


def _stuffed(data: bytes) -> bytes:
    if len(data) > MOST_BYTES:
        raise ValueError(f"at most {MOST_BYTES} bytes.")
    return b"".join(bytes([len(block) + 1]) + block for block in data.split(b"\0"))


def _described(data: bytes, at: int) -> dict[str, int | str]:
    if not 1 <= at <= len(data):
        raise ValueError(f"there are {len(data)} bytes.")
    return {"hex": data.hex(" "), "length": len(data), "at": data[at - 1]}


@formula("byte_time", "ms")
def byte_time(count: float, baud: float) -> float:
    """How long so many bytes take on a line with 8 data bits, a start and a stop bit."""
    return 1e4 * count / baud


@formula("frame_survival", "%")
def frame_survival(garbled: float, count: float) -> float:
    """Share of frames of so many bytes that arrive whole, where `garbled` % of the bytes do not."""
    return 100.0 * (1.0 - 0.01 * garbled) ** count
