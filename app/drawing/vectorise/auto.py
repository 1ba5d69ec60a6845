"""Which way of drawing suits a picture: a drawing's lines, filled shapes, or a photograph."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from app.drawing.prepare import LEAST_HIGH, gradients
from app.drawing.vectorise.ink import LEAST_CONTRAST, depth_of, evenly_lit, split_tones

TWO_TONES = 0.88
"""Share of the pixels near one of two tones, above which a picture is a drawing."""

NEAR = 0.2
"""How near, in parts of the difference between the two."""

SHADED_CONTRAST = 140.0
"""Grey levels that ink and paper must differ by where the paper is shaded, as on a photographed page."""

FLAT_SLOPE, FLAT = 8.0, 0.88
"""Slope of an even tone, and the share of such pixels in a picture of flat colours."""

WIDE = 1 / 85
"""Half width, in parts of the picture's long side, above which ink is a shape and no line."""

FILLED = 0.3
"""Share of the ink deeper inside than that, above which a drawing has filled shapes."""


def choose_mode(grey: NDArray[np.uint8]) -> tuple[str, str]:
    """(`centreline`, `outline` or `sketch`; why, in one sentence) for a picture (h, w)."""
    ink = _two_toned_ink(grey)
    if ink is not None:
        deep = _deep_share(ink)
        if deep > FILLED:
            return "outline", f"The picture has two tones, and {deep:.0%} of its ink fills shapes: they are outlined."
        return "centreline", "The picture has two tones and thin ink, so the middle of each line is drawn."
    slope = gradients(grey).size
    if np.mean(slope <= FLAT_SLOPE) > FLAT and slope.max() > LEAST_HIGH:
        return "outline", "The picture has areas of even tone, so their borders are drawn."
    return "sketch", "The picture has many tones, as a photo has, so its dark lines are sketched."


def _two_toned_ink(grey: NDArray[np.uint8]) -> NDArray[np.bool_] | None:
    """Ink of a picture of two tones, if need be after evening out the light; None for any other picture."""
    for picture, contrast in ((grey, LEAST_CONTRAST), (evenly_lit(grey), SHADED_CONTRAST)):
        dark, found = split_tones(picture)
        if found >= contrast and _share_of_two_tones(picture, dark) >= TWO_TONES:
            return dark if np.count_nonzero(dark) <= dark.size / 2 else ~dark
    return None


def _share_of_two_tones(grey: NDArray[np.uint8], dark: NDArray[np.bool_]) -> float:
    """Share of the pixels whose tone is close to the usual one of their class."""
    low, high = np.median(grey[dark]), np.median(grey[~dark])
    tone = np.where(dark, low, high)
    return float(np.mean(np.abs(grey - tone) <= NEAR * (high - low)))


def _deep_share(ink: NDArray[np.bool_]) -> float:
    """Share of the ink that lies far from its edge."""
    return float(np.mean(depth_of(ink)[ink] > WIDE * max(ink.shape)))
