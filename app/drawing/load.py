"""A picture's bytes, whatever they are, become a small grey image, or one sentence says why not."""

from __future__ import annotations

import os
from dataclasses import dataclass

os.environ.setdefault("OPENCV_IO_MAX_IMAGE_PIXELS", "100000000")  # OpenCV reads it once, when it is imported

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.image_header import DAMAGED, ImageHeader, read_header, still_png

MAX_BYTES = 100_000_000
MAX_PIXELS = 100_000_000
MAX_SIDE = 30_000
LARGE_JPEG_PIXELS = 4_000_000
"""A larger JPEG is decoded at a half, a quarter or an eighth of its size, which takes a fraction of the time."""

REDUCED = {2: cv2.IMREAD_REDUCED_GRAYSCALE_2, 4: cv2.IMREAD_REDUCED_GRAYSCALE_4, 8: cv2.IMREAD_REDUCED_GRAYSCALE_8}
EXTREME_SHARE = 0.001
"""Of the pixels of a deep picture, lost to pure black and to pure white."""


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture ready to be prepared."""

    grey: NDArray[np.uint8]
    """(h, w), 0 black to 255 white, upright, transparency over white, at most the wanted pixels on its long side."""
    width_px: int
    height_px: int
    """Of the file, upright."""
    notes: tuple[str, ...] = ()
    """What was done to it that its owner may want to know, in sentences."""


def load_image(data: bytes, longest_px: int = 1000) -> Picture:
    """Decode a PNG, JPEG, GIF, BMP, WebP or TIFF. DrawingError, in one sentence, for everything else.

    The size is checked before anything is decoded, so that a small file cannot unfold into gigabytes.
    """
    if longest_px < 1:
        raise DrawingError(f"A picture of {longest_px} pixels cannot be drawn; ask for at least 1.")
    if len(data) > MAX_BYTES:
        raise DrawingError(f"The file is larger than {MAX_BYTES // 1_000_000} MB; save the picture smaller.")
    header = read_header(data)
    _check_size(header)
    pixels = _decoded(data, header, longest_px)
    upright = _upright(_resized(_grey(pixels), longest_px), header.orientation)
    turned = header.orientation >= 5
    width, height = (header.height, header.width) if turned else (header.width, header.height)
    return Picture(np.ascontiguousarray(upright), width, height, _notes(header, pixels))


def _check_size(header: ImageHeader) -> None:
    if header.width * header.height > MAX_PIXELS or max(header.width, header.height) > MAX_SIDE:
        raise DrawingError(
            f"The picture has {header.width} x {header.height} pixels; make it smaller: "
            f"{MAX_PIXELS // 1_000_000} million, and {MAX_SIDE} to a side, can be drawn."
        )


def _decoded(data: bytes, header: ImageHeader, longest_px: int) -> NDArray:
    """(h, w) or (h, w, channels) as stored, only grey and smaller where that loses nothing."""
    flags = cv2.IMREAD_UNCHANGED
    if header.opaque:
        flags = _jpeg_size(header, longest_px) if header.kind == "JPEG" else cv2.IMREAD_GRAYSCALE
        flags |= cv2.IMREAD_IGNORE_ORIENTATION
    if header.kind == "PNG":
        data = still_png(data)
    try:
        pixels = cv2.imdecode(np.frombuffer(data, np.uint8), flags)
    except cv2.error:
        pixels = None
    if pixels is None or pixels.size == 0:
        raise DrawingError(DAMAGED)
    return pixels


def _jpeg_size(header: ImageHeader, longest_px: int) -> int:
    if header.width * header.height <= LARGE_JPEG_PIXELS:
        return cv2.IMREAD_GRAYSCALE
    shrinks = [factor for factor in REDUCED if max(header.width, header.height) >= factor * longest_px]
    return REDUCED[max(shrinks)] if shrinks else cv2.IMREAD_GRAYSCALE


def _grey(pixels: NDArray) -> NDArray[np.uint8]:
    """(h, w) from any depth and number of channels, transparency over white."""
    channels = 1 if pixels.ndim == 2 else pixels.shape[2]
    if channels == 1:
        return _eight_bits(pixels.reshape(pixels.shape[:2]))
    if channels not in (3, 4):
        raise DrawingError(f"The picture has {channels} channels; save it in colour or grey and try again.")
    grey = _eight_bits(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY if channels == 3 else cv2.COLOR_BGRA2GRAY))
    return _over_white(grey, cv2.extractChannel(pixels, 3)) if channels == 4 else grey


def _over_white(grey: NDArray[np.uint8], alpha: NDArray) -> NDArray[np.uint8]:
    opaque = np.iinfo(alpha.dtype).max if alpha.dtype.kind == "u" else 1.0
    shade = cv2.multiply(255 - grey, alpha, scale=1.0 / opaque, dtype=cv2.CV_8U)
    return 255 - np.asarray(shade, np.uint8)


def _eight_bits(grey: NDArray) -> NDArray[np.uint8]:
    """Stretched: a 16-bit file may hold 12 bits, and a float one anything."""
    if grey.dtype == np.uint8:
        return grey
    grey = np.nan_to_num(grey.astype(np.float32), posinf=0.0, neginf=0.0)
    some = grey[:: 1 + grey.shape[0] // 1000, :: 1 + grey.shape[1] // 1000]
    low, high = np.quantile(some, (EXTREME_SHARE, 1.0 - EXTREME_SHARE))
    if low == high:  # hardly any ink, or none
        low, high = float(grey.min()), float(grey.max())
    if low == high:
        return np.full(grey.shape, 255, np.uint8)
    return np.clip((grey - low) * (255.0 / (high - low)) + 0.5, 0.0, 255.0).astype(np.uint8)


def _resized(grey: NDArray[np.uint8], longest_px: int) -> NDArray[np.uint8]:
    height, width = grey.shape
    scale = longest_px / max(height, width)
    if scale >= 1.0:
        return grey
    size = max(round(width * scale), 1), max(round(height * scale), 1)
    return np.asarray(cv2.resize(grey, size, interpolation=cv2.INTER_AREA), np.uint8)


def _upright(grey: NDArray[np.uint8], orientation: int) -> NDArray[np.uint8]:
    """EXIF: 5 to 8 swap rows and columns; then the picture is mirrored."""
    if orientation >= 5:
        grey = grey.T
    if orientation in (3, 4, 7, 8):
        grey = grey[::-1]
    return grey[:, ::-1] if orientation in (2, 3, 6, 7) else grey


def _notes(header: ImageHeader, pixels: NDArray) -> tuple[str, ...]:
    notes = []
    if header.animated:
        notes.append(f"The {header.kind} is animated: its first frame is drawn.")
    if header.orientation != 1:
        notes.append("The picture was turned upright as its camera noted.")
    if pixels.dtype != np.uint8:
        notes.append("The picture has more than 8 bits: its tones were stretched from black to white.")
    if pixels.ndim == 3 and pixels.shape[2] == 4 and (pixels[..., 3] < np.max(pixels[..., 3])).any():
        notes.append("Transparent parts are taken as white paper.")
    return tuple(notes)
