"""Thinning leaves one-pixel lines in the middle, connected as before."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.vectorise.thinning import thin


def parts(mask: np.ndarray, connectivity: int) -> int:
    return cv2.connectedComponents(mask.astype(np.uint8), connectivity=connectivity)[0]


def holes(mask: np.ndarray) -> int:
    return parts(~np.pad(mask, 1), 4)


@st.composite
def masks(draw: st.DrawFn) -> np.ndarray:
    """Blobs and lines of all sizes."""
    random = np.random.default_rng(draw(st.integers(0, 10_000)))
    soft = cv2.GaussianBlur(random.standard_normal((40, 50)), (0, 0), draw(st.sampled_from([0.3, 0.8, 1.5, 3.0])))
    return soft > np.quantile(soft, draw(st.sampled_from([0.3, 0.6, 0.9])))


@given(masks())
def test_connected_as_before(mask):
    thinned = thin(mask)
    assert not (thinned & ~mask).any()
    assert parts(thinned, 8) == parts(mask, 8)
    assert holes(thinned) == holes(mask)


@given(masks())
def test_nothing_is_left_to_thin(mask):
    thinned = thin(mask)
    assert (thin(thinned) == thinned).all()


@pytest.mark.parametrize("width", [1, 3, 7, 15])
def test_a_bar_becomes_its_middle(width):
    mask = np.zeros((40, 100), bool)
    mask[20 - width // 2 : 21 + width // 2, 10:90] = True
    rows, columns = np.nonzero(thin(mask))
    inside = (columns > 20) & (columns < 80)
    assert (rows[inside] == 20).all() and inside.sum() == 59


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (9, 1), (3, 3)])
def test_tiny_masks(shape):
    assert not thin(np.zeros(shape, bool)).any()
    assert thin(np.ones(shape, bool)).any()
