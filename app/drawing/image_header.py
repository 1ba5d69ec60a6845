"""What the first bytes of a picture say: its format, size and orientation, read before anything is decoded."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from app.drawing.errors import DrawingError

MAX_CHUNKS = 20_000
"""A 100-megapixel PNG has some thousands; more are there to keep us busy."""

NEEDED = (b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND")
"""Chunks without which a PNG cannot be decoded as it was meant."""

TIFF_WIDTH, TIFF_HEIGHT, TIFF_ORIENTATION = 256, 257, 274
UNREADABLE = "This file cannot be read as a picture; save it as PNG or JPEG and try again."
DAMAGED = "The picture is damaged or was not copied to its end; save or download it again."


@dataclass(frozen=True)
class ImageHeader:
    """What is known of a picture without decoding it."""

    kind: str
    """`PNG`, `JPEG`, `GIF`, `BMP`, `WebP` or `TIFF`."""
    width: int
    height: int
    """As stored: before the orientation is applied."""
    orientation: int = 1
    """EXIF, 1 to 8."""
    opaque: bool = False
    """Surely 8 bits without transparency."""
    animated: bool = False


def read_header(data: bytes) -> ImageHeader:
    """DrawingError for anything that is not one of the known formats, with its real name where that helps."""
    if not data:
        raise DrawingError("The file is empty; choose a picture.")
    readers = {
        b"\x89PNG\r\n\x1a\n": _png,
        b"\xff\xd8\xff": _jpeg,
        b"GIF87a": _gif,
        b"GIF89a": _gif,
        b"BM": _bmp,
        b"II*\0": _tiff,
        b"MM\0*": _tiff,
    }
    reader = next((found for magic, found in readers.items() if data.startswith(magic)), None)
    if data[:4] == b"RIFF" and data[8:12] == b"WEBP":
        reader = _webp
    if reader is None:
        raise DrawingError(_what_else(data))
    try:
        header = reader(data)
    except struct.error:
        raise DrawingError(DAMAGED) from None
    if header.width < 1 or header.height < 1:
        raise DrawingError(DAMAGED)
    return header


def _what_else(data: bytes) -> str:
    """Why bytes that are no known picture cannot be drawn."""
    start = data[:4096]
    if b"<svg" in start:
        return "This is an SVG, a vector drawing and not a picture; export it as PNG and try again."
    if start.startswith(b"%PDF"):
        return "This is a PDF document; export the page as PNG or JPEG and try again."
    if start[4:8] == b"ftyp":
        return "This is a HEIC, AVIF or video file; save the picture as JPEG or PNG and try again."
    if start.isascii() and b"\0" not in start:
        return "This is text, whatever the file is called; choose a picture, such as a PNG or JPEG."
    return UNREADABLE


def _png(data: bytes) -> ImageHeader:
    width, height, depth, colour = struct.unpack_from(">IIBB", data, 16)
    chunks = {name: start + 8 for name, start, _ in _chunks(data, 8)}
    orientation = _orientation(data, chunks.get(b"eXIf"))
    opaque = depth <= 8 and colour in (0, 2) and b"tRNS" not in chunks
    return ImageHeader("PNG", width, height, orientation, opaque, animated=b"acTL" in chunks)


def _jpeg(data: bytes) -> ImageHeader:
    orientation, at = 1, 2
    for _ in range(MAX_CHUNKS):
        mark, marker, length = struct.unpack_from(">BBH", data, at)
        if mark != 0xFF:
            break
        if marker == 0xFF:  # a fill byte
            at += 1
        elif 0xC0 <= marker <= 0xCF and marker not in (0xC4, 0xC8, 0xCC):
            height, width = struct.unpack_from(">HH", data, at + 5)
            return ImageHeader("JPEG", width, height, orientation, opaque=True)
        else:
            if marker == 0xE1 and data[at + 4 : at + 10] == b"Exif\0\0":
                orientation = _orientation(data, at + 4)
            at += 2 + length
    raise DrawingError(DAMAGED)


def _gif(data: bytes) -> ImageHeader:
    width, height = struct.unpack_from("<HH", data, 6)
    return ImageHeader("GIF", width, height, animated=b"NETSCAPE2.0" in data or data.count(b"\0\x21\xf9\x04") > 1)


def _bmp(data: bytes) -> ImageHeader:
    (header_size,) = struct.unpack_from("<I", data, 14)
    width, height = struct.unpack_from("<HH" if header_size == 12 else "<ii", data, 18)
    return ImageHeader("BMP", width, abs(height))


def _webp(data: bytes) -> ImageHeader:
    chunks = {name: start + 8 for name, start, _ in _chunks(data, 12, riff=True)}
    orientation = _orientation(data, chunks.get(b"EXIF"))
    kind = data[12:16]
    if kind == b"VP8X":
        low_w, high_w, low_h, high_h = struct.unpack_from("<HBHB", data, 24)
        width, height = (high_w << 16) + low_w + 1, (high_h << 16) + low_h + 1
    elif kind == b"VP8L":
        (bits,) = struct.unpack_from("<I", data, 21)
        width, height = (bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1
    else:
        width, height = (side & 0x3FFF for side in struct.unpack_from("<HH", data, 26))
    return ImageHeader("WebP", width, height, orientation, animated=b"ANIM" in chunks)


def _tiff(data: bytes) -> ImageHeader:
    """OpenCV turns a TIFF by itself: the orientation is left at 1, the sides swapped."""
    tags = _tiff_tags(data)
    width, height = tags.get(TIFF_WIDTH, 0), tags.get(TIFF_HEIGHT, 0)
    return ImageHeader("TIFF", *((height, width) if tags.get(TIFF_ORIENTATION, 1) >= 5 else (width, height)))


def still_png(data: bytes) -> bytes:
    """A PNG without what its first picture does not need: OpenCV 5.0 crashes on some damaged animations."""
    kept = [data[start:stop] for name, start, stop in _chunks(data, 8) if name in NEEDED]
    return data[:8] + b"".join(kept)


def _chunks(data: bytes, at: int, riff: bool = False) -> list[tuple[bytes, int, int]]:
    """(name, where it starts, where it stops) of every chunk of a PNG or a RIFF file, 8 bytes before its content.

    A PNG's chunks must lie within the file: OpenCV sets aside what they claim, gigabytes for a single wrong byte.
    """
    found = []
    for _ in range(MAX_CHUNKS):
        if riff and at + 8 > len(data):
            return found
        (length,) = struct.unpack_from("<I" if riff else ">I", data, at + 4 * riff)
        name = data[at : at + 4] if riff else data[at + 4 : at + 8]
        stop = at + 8 + length + (length % 2 if riff else 4)  # padding, or a checksum
        if stop > len(data) and not riff:
            break
        found.append((name, at, stop))
        if name == b"IEND":
            return found
        at = stop
    raise DrawingError(DAMAGED)


def _orientation(data: bytes, at: int | None) -> int:
    """1 to 8, from the EXIF data at `at`; 1, as stored, if there are none or they are damaged."""
    if at is None:
        return 1
    try:
        found = _tiff_tags(data[at : at + 65536].removeprefix(b"Exif\0\0")).get(TIFF_ORIENTATION, 1)
    except struct.error:
        return 1
    return found if 1 <= found <= 8 else 1


def _tiff_tags(data: bytes) -> dict[int, int]:
    """The whole numbers in the first directory of a TIFF, of which EXIF is one."""
    order = "<" if data[:2] == b"II" else ">"
    (at,) = struct.unpack_from(order + "I", data, 4)
    (count,) = struct.unpack_from(order + "H", data, at)
    tags = {}
    for entry in range(at + 2, at + 2 + 12 * count, 12):
        tag, kind = struct.unpack_from(order + "HH", data, entry)
        if kind in (3, 4):
            (tags[tag],) = struct.unpack_from(order + ("H" if kind == 3 else "I"), data, entry + 8)
    return tags
