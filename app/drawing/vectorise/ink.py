"""What of a picture is ink and what is paper, in any light, on light paper or on a dark board."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

LEAST_CONTRAST = 24.0
"""Grey levels between ink and paper; less is an empty sheet."""

SMALLER = 8
"""The paper's brightness is sought in a picture so many times smaller."""

WIDEST_INK = 10
"""Ink wider than this part of the picture's long side may be taken for paper in the shade."""


def split_tones(grey: NDArray[np.uint8]) -> tuple[NDArray[np.bool_], float]:
    """(which pixels of (h, w) are dark, grey levels between dark and light): two classes, by Otsu."""
    level, _ = cv2.threshold(grey, 0, 255, cv2.THRESH_BINARY | cv2.THRESH_OTSU)
    dark = grey <= level
    if dark.all() or not dark.any():
        return np.zeros(grey.shape, bool), 0.0
    return dark, float(grey[~dark].mean() - grey[dark].mean())


def depth_of(ink: NDArray[np.bool_]) -> NDArray[np.float32]:
    """(h, w) pixels from each pixel of ink to the next that is none; beyond the picture there is none."""
    depth = cv2.distanceTransform(np.pad(ink, 1).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    return np.asarray(depth[1:-1, 1:-1], np.float32)


def find_ink(grey: NDArray[np.uint8]) -> tuple[NDArray[np.bool_], NDArray[np.float32]]:
    """(which pixels are ink, how dark each is from 0 to 255), both (h, w). Ink is what covers less than half."""
    dark, contrast = split_tones(grey)
    if np.count_nonzero(dark) > dark.size / 2:
        grey = 255 - grey
    flat = evenly_lit(grey)
    dark, contrast = split_tones(flat)
    if contrast < LEAST_CONTRAST:
        dark = np.zeros(grey.shape, bool)
    return dark, 255.0 - flat.astype(np.float32)


def evenly_lit(grey: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """A picture (h, w) divided by its paper, which is what is left when narrow dark things are filled."""
    height, width = grey.shape
    small = cv2.resize(grey, (max(width // SMALLER, 1), max(height // SMALLER, 1)), interpolation=cv2.INTER_AREA)
    size = max(max(small.shape) // WIDEST_INK, 1)
    paper = cv2.morphologyEx(small, cv2.MORPH_CLOSE, np.ones((size, size), np.uint8))
    paper = cv2.resize(cv2.blur(paper, (size, size)), (width, height), interpolation=cv2.INTER_LINEAR)
    return np.asarray(cv2.divide(grey, np.maximum(paper, 1), scale=255.0), np.uint8)
