"""Whatever bytes are called a picture: read as they look, or refused in one sentence."""

from __future__ import annotations

import base64
import struct
import zlib

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.drawing import load
from app.drawing.errors import DrawingError
from app.drawing.load import load_image

QUARTERS = np.kron(np.array([[0, 80], [160, 240]], np.uint8), np.ones((20, 32), np.uint8))
"""40 high and 64 wide: top left black to bottom right light grey."""

RED_CMYK_JPEG = base64.b64decode(
    "/9j/7gAOQWRvYmUAZAAAAAAA/9sAQwADAgIDAgIDAwMDBAMDBAUIBQUEBAUKBwcGCAwKDAwLCgsLDQ4SEA0OEQ4LCxAWEBETFBUVFQwPFxgWFBgS"
    "FBUU/8AAFAgACAAIBEMRAE0RAFkRAEsRAP/EABQAAQAAAAAAAAAAAAAAAAAAAAn/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/9oADgRDAE0AWQBLAAA/"
    "AFTFUKoqb//Z"
)
GIF_200_THEN_BLACK = bytes.fromhex(
    "47494638396104000200810000c8c8c800000000000000000021ff0b4e45545343415045322e30030100000021f904000a0000002c0000000004"
    "0002000008070001081c2830200021f904010a0001002c00000000040002008100000000000000000000000008070001081c283020003b"
)


def encoded(picture: np.ndarray, kind: str = ".png") -> bytes:
    return cv2.imencode(kind, picture)[1].tobytes()


def png_chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def png_header(width: int, height: int, depth: int = 1, colour: int = 0) -> bytes:
    head = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", head)


def exif(orientation: int, order: str) -> bytes:
    mark = b"II*\0" if order == "<" else b"MM\0*"
    entry = struct.pack(order + "HHIHH", 274, 3, 1, orientation, 0)
    return mark + struct.pack(order + "IH", 8, 1) + entry + bytes(4)


def with_exif(picture: np.ndarray, kind: str, orientation: int) -> bytes:
    data = encoded(picture, kind)
    if kind == ".jpg":
        content = b"Exif\0\0" + exif(orientation, "<")
        return data[:2] + b"\xff\xe1" + struct.pack(">H", 2 + len(content)) + content + data[2:]
    return data[:33] + png_chunk(b"eXIf", exif(orientation, ">")) + data[33:]


def refusal(data: bytes) -> str:
    with pytest.raises(DrawingError) as found:
        load_image(data)
    return str(found.value)


@pytest.mark.parametrize("kind", [".png", ".bmp", ".tif", ".webp", ".jpg"])
def test_formats(kind):
    picture = load_image(encoded(QUARTERS, kind))
    assert picture.grey.dtype == np.uint8 and (picture.width_px, picture.height_px) == (64, 40)
    assert np.abs(picture.grey.astype(int) - QUARTERS).mean() < 2.0 and picture.notes == ()


def test_colours_by_their_brightness():
    colours = np.zeros((8, 24, 3), np.uint8)
    colours[:, :8, 2], colours[:, 8:16, 1], colours[:, 16:, 0] = 255, 255, 255
    assert load_image(encoded(colours)).grey[4, [4, 12, 20]].tolist() == pytest.approx([76, 150, 29], abs=1)


def test_transparency_is_paper():
    picture = np.zeros((10, 20, 4), np.uint8)
    picture[:, 5:, 3] = 128
    picture[:, 15:, 3] = 255
    found = load_image(encoded(picture))
    assert found.grey[5, [0, 10, 19]].tolist() == [255, 127, 0]
    assert "transparent" in " ".join(found.notes).lower()


@pytest.mark.parametrize(("colour", "depth"), [(4, 8), (4, 16)])
def test_grey_with_alpha(colour, depth):
    bright = {8: b"\x64", 16: b"\x64\x00"}[depth]
    opaque, clear = bright + b"\xff" * (depth // 8), bright + b"\0" * (depth // 8)
    body = zlib.compress((b"\0" + opaque * 6 + clear * 2) * 4)
    found = load_image(png_header(8, 4, depth, colour) + png_chunk(b"IDAT", body) + png_chunk(b"IEND", b""))
    assert (found.grey[:, 6:] == 255).all()
    if depth == 8:
        assert (found.grey[:, :6] == 100).all()


def test_a_palette_with_a_transparent_colour():
    body = zlib.compress(b"\0\x01\x00" * 2)
    chunks = [(b"PLTE", bytes([0, 0, 0, 90, 90, 90])), (b"tRNS", b"\0"), (b"IDAT", body), (b"IEND", b"")]
    data = png_header(2, 2, 8, 3) + b"".join(png_chunk(*chunk) for chunk in chunks)
    assert load_image(data).grey.tolist() == [[90, 255], [90, 255]]


def test_an_unused_fourth_byte_is_no_transparency():
    pixels = bytes([10, 10, 10, 0, 200, 200, 200, 0])
    head = struct.pack("<IHHIIiiHHIIiiII", 54 + 8, 0, 0, 54, 40, 2, 1, 1, 32, 0, 8, 0, 0, 0, 0)
    assert load_image(b"BM" + head + pixels).grey.tolist() == [[10, 200]]


@pytest.mark.parametrize("full", [4095, 65535])
def test_deep_pictures_are_stretched(full):
    """A camera's 12 bits, in a file of 16, would be black."""
    ramp = np.round(np.linspace(0, full, 256 * 64)).astype(np.uint16).reshape(64, 256)
    found = load_image(encoded(ramp))
    assert np.abs(found.grey - np.linspace(0, 255, ramp.size).reshape(ramp.shape)).max() < 2.0
    assert "16" in found.notes[0] or "8 bits" in found.notes[0]


def test_a_deep_picture_with_hardly_any_ink_and_with_none():
    sheet = np.full((200, 200), 60000, np.uint16)
    assert (load_image(encoded(sheet)).grey == 255).all()
    sheet[100, 100:110] = 0
    assert load_image(encoded(sheet)).grey[100, [99, 105]].tolist() == [255, 0]


def test_a_float_picture_with_holes():
    picture = np.linspace(-1.0, 5.0, 400).reshape(20, 20).astype(np.float32)
    picture[3, 3] = np.nan
    found = load_image(encoded(picture, ".tif")).grey
    assert found[0, 0] < 5 and found[-1, -1] > 250


def test_cmyk():
    assert np.abs(load_image(RED_CMYK_JPEG).grey.astype(int) - 76).max() < 6


def test_the_first_frame_of_an_animation():
    found = load_image(GIF_200_THEN_BLACK)
    assert (found.grey == 200).all() and found.notes == ("The GIF is animated: its first frame is drawn.",)


STORED = {
    1: lambda seen: seen,
    2: np.fliplr,
    3: lambda seen: np.rot90(seen, 2),
    4: np.flipud,
    5: np.transpose,
    6: lambda seen: np.rot90(seen, 1),
    7: lambda seen: np.rot90(seen, 2).T,
    8: lambda seen: np.rot90(seen, -1),
}
"""How a camera that notes this orientation stores what is seen."""


@pytest.mark.parametrize("orientation", STORED)
@pytest.mark.parametrize("kind", [".jpg", ".png"])
def test_orientation(orientation, kind):
    data = with_exif(np.ascontiguousarray(STORED[orientation](QUARTERS)), kind, orientation)
    found = load_image(data)
    assert (found.width_px, found.height_px) == (64, 40)
    assert np.abs(found.grey.astype(int) - QUARTERS).mean() < 2.0
    assert bool(found.notes) == (orientation != 1)


def test_damaged_exif_data_do_not_cost_the_picture():
    data = encoded(QUARTERS, ".jpg")
    for content in (b"Exif\0\0", b"Exif\0\0II*\0\xff\xff\xff\xff", b"Exif\0\0" + exif(99, "<")):
        broken = data[:2] + b"\xff\xe1" + struct.pack(">H", 2 + len(content)) + content + data[2:]
        assert load_image(broken).grey.shape == (40, 64)


@pytest.mark.parametrize(
    ("shape", "reduced"), [((3000, 100), (1000, 33)), ((1, 5000), (1, 1000)), ((900, 1000), (900, 1000))]
)
def test_the_working_size(shape, reduced):
    found = load_image(encoded(np.zeros(shape, np.uint8)))
    assert found.grey.shape == reduced and (found.height_px, found.width_px) == shape


def test_fifty_megapixels_are_never_decoded_whole(monkeypatch):
    row = np.linspace(0, 255, 8660).astype(np.uint8)
    data = encoded(np.broadcast_to(row, (5774, 8660)), ".jpg")
    sizes = []

    def spied(*arguments, decode=cv2.imdecode):
        pixels = decode(*arguments)
        sizes.append(np.size(pixels))
        return pixels

    monkeypatch.setattr(load.cv2, "imdecode", spied)
    found = load_image(data)
    assert sizes[0] < 1_000_000 and (found.width_px, found.height_px) == (8660, 5774)
    assert np.abs(found.grey[300] - np.linspace(0, 255, 1000)).max() < 4


def test_one_pixel():
    assert load_image(encoded(np.array([[7]], np.uint8))).grey.tolist() == [[7]]


@pytest.mark.parametrize(
    "data",
    [
        png_header(30000, 30000) + png_chunk(b"IDAT", b"x") + png_chunk(b"IEND", b""),
        b"GIF89a" + struct.pack("<HH", 65535, 65535) + bytes(20),
        b"BM" + bytes(12) + struct.pack("<Iii", 40, 2**30, -(2**30)),
        b"II*\0" + struct.pack("<IHHHIIHHII", 8, 2, 256, 4, 1, 90000, 257, 4, 1, 90000),
        b"RIFF\0\0\0\0WEBPVP8X" + struct.pack("<IIHBHB", 10, 0, 0xFFFF, 0, 0xFFFF, 0),
        b"\xff\xd8\xff\xc0" + struct.pack(">HBHH", 11, 8, 65535, 65535) + bytes(20),
        b"II*\0" + struct.pack("<IHHHIIHHII", 8, 2, 256, 4, 1, 60, 257, 4, 1, 800_000),
    ],
)
def test_a_bomb_is_refused_unopened(data, monkeypatch):
    monkeypatch.setattr(load.cv2, "imdecode", lambda *_: pytest.fail("it was decoded"))
    assert "100 million" in refusal(data)


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        (b"", "empty"),
        (b"just some text\n" * 20, "text"),
        (b'<?xml version="1.0"?>\n<svg xmlns="http://www.w3.org/2000/svg"/>', "SVG"),
        (b"%PDF-1.7\n%\xe2\xe3", "PDF"),
        (b"\0\0\0\x18ftypheic\0\0\0\0", "HEIC"),
        (bytes(range(256)), "cannot be read"),
        (encoded(QUARTERS, ".jpg")[:-200], "damaged"),
        (encoded(QUARTERS, ".jpg")[:300], "damaged"),
        (encoded(QUARTERS)[:-40], "damaged"),
        (encoded(QUARTERS)[:20], "damaged"),
        (encoded(QUARTERS, ".bmp")[:-500], "damaged"),
        (encoded(QUARTERS, ".tif")[:-60], "damaged"),
        (GIF_200_THEN_BLACK[:40], "damaged"),
        (b"\xff\xd8\xff", "damaged"),
        (png_header(0, 5), "damaged"),
    ],
)
def test_refusals_are_one_sentence(data, complaint):
    sentence = refusal(data)
    assert complaint in sentence and sentence.endswith(".") and "\n" not in sentence


def test_a_chunk_that_claims_gigabytes_is_not_believed(monkeypatch):
    """OpenCV would set the memory aside."""
    data = bytearray(encoded(QUARTERS))
    data[33] = 0x7F
    monkeypatch.setattr(load.cv2, "imdecode", lambda *_: pytest.fail("it was decoded"))
    assert "damaged" in refusal(bytes(data))


def test_an_animated_png_is_decoded_without_its_animation(monkeypatch):
    """OpenCV 5.0 crashes on some damaged ones."""
    data = encoded(QUARTERS)
    control = png_chunk(b"acTL", struct.pack(">II", 2, 0))
    more = png_chunk(b"fcTL", bytes(26)) + png_chunk(b"fdAT", b"\0\0\0\1nonsense")
    decoded = []

    def spied(buffer, flags, decode=cv2.imdecode):
        decoded.append(bytes(buffer))
        return decode(buffer, flags)

    monkeypatch.setattr(load.cv2, "imdecode", spied)
    found = load_image(data[:33] + control + data[33:-12] + more + data[-12:])
    assert (found.grey == QUARTERS).all() and found.notes == ("The PNG is animated: its first frame is drawn.",)
    assert not any(name in decoded[0] for name in (b"acTL", b"fcTL", b"fdAT"))


def test_what_follows_a_picture_is_ignored():
    for kind in (".png", ".jpg"):
        assert load_image(encoded(QUARTERS, kind) + b"\x7f" * 100).grey.shape == (40, 64)


def test_settings_and_sizes_that_cannot_be(monkeypatch):
    with pytest.raises(DrawingError, match="at least 1"):
        load_image(encoded(QUARTERS), longest_px=0)
    monkeypatch.setattr(load, "MAX_BYTES", 10)
    assert "larger than" in refusal(encoded(QUARTERS))


def read_or_refuse(data: bytes) -> None:
    try:
        picture = load_image(data, 100)
    except DrawingError:
        return
    assert picture.grey.dtype == np.uint8 and max(picture.grey.shape) <= 100 and picture.grey.size


MAGIC = [b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"GIF89a", b"BM", b"II*\0", b"MM\0*", b"RIFF\0\0\0\0WEBPVP8X", b""]


@given(st.sampled_from(MAGIC), st.binary(max_size=120))
def test_any_bytes_are_read_or_refused(magic, data):
    read_or_refuse(magic + data)


@settings(max_examples=150)
@given(st.sampled_from([".png", ".jpg", ".gif", ".bmp", ".tif", ".webp"]), st.integers(0, 2000), st.integers(0, 255))
def test_any_damage_is_survived(kind, at, byte):
    data = bytearray(GIF_200_THEN_BLACK if kind == ".gif" else encoded(QUARTERS, kind))
    data[at % len(data)] = byte
    read_or_refuse(bytes(data))
