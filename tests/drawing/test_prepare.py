"""The paper's sliders: what each does, and which values are refused."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.errors import DrawingError
from app.drawing.prepare import gradients, prepare, thresholds

RAMP = np.tile(np.arange(256, dtype=np.uint8), (64, 1))


def edge(height: int = 100) -> np.ndarray:
    """A step of so many grey levels."""
    picture = np.full((60, 60), 50, np.uint8)
    picture[:, 30:] += height
    return picture


def test_nothing_asked_nothing_done():
    assert (prepare(RAMP) == RAMP).all()


@pytest.mark.parametrize("width", [1, 128, 256, 600])
def test_width_keeps_the_aspect(width):
    found = prepare(RAMP, width=width)
    assert found.shape == (max(round(width / 4), 1), width) and found.dtype == np.uint8


@pytest.mark.parametrize("gamma", [0.5, 2.2])
def test_gamma_is_a_power(gamma):
    expected = [round(255 * (v / 255) ** gamma) for v in range(256)]
    assert prepare(RAMP, gamma=gamma)[0].tolist() == expected


@pytest.mark.parametrize(("smooth", "sigma"), [(3, 0.8), (7, 1.4), (15, 2.6)])
def test_smooth_has_the_deviation_it_is_said_to_have(smooth, sigma):
    """The slope of a blurred step is the Gaussian itself."""
    slope = np.diff(prepare(edge(200), smooth=smooth)[30].astype(float)) / 200
    at = np.arange(len(slope))
    assert np.sqrt((slope * (at - 29) ** 2).sum()) == pytest.approx(sigma, rel=0.12)


def test_thresholds_mean_the_same_with_every_aperture():
    """A straight slope has no scale: every kernel must measure it alike."""
    inside = (slice(10, -10), slice(10, -10))
    answers = [gradients(RAMP, aperture).size[inside] for aperture in (3, 5, 7)]
    np.testing.assert_allclose(answers, 8.0)


def test_automatic_thresholds():
    size = np.arange(1000, dtype=np.float32).reshape(20, 50)
    low, high = thresholds(size)
    assert (size > high).mean() == pytest.approx(0.1, abs=0.01) and low == pytest.approx(0.4 * high)
    assert thresholds(np.zeros((5, 5), np.float32)) == (12.0, 30.0)
    assert thresholds(size, low=950.0) == (950.0, 950.0)
    assert thresholds(size, high=100.0) == (40.0, 100.0)


@pytest.mark.parametrize(
    "wrong",
    [
        {"width": 0},
        {"width": 5000},
        {"gamma": 0.0},
        {"gamma": float("nan")},
        {"gamma": 50.0},
        {"smooth": 4},
        {"smooth": -3},
        {"smooth": 99},
        {"smooth": 3.5},
    ],
)
def test_refused_sliders(wrong):
    with pytest.raises(DrawingError, match="not possible; choose") as refusal:
        prepare(RAMP, **wrong)
    assert str(next(iter(wrong))) in str(refusal.value)


def test_a_strip_is_not_blown_up():
    with pytest.raises(DrawingError, match="smaller"):
        prepare(np.zeros((4000, 2), np.uint8), width=400)


@pytest.mark.parametrize("aperture", [1, 4, 9])
def test_refused_apertures(aperture):
    with pytest.raises(DrawingError, match="3, 5 or 7"):
        gradients(RAMP, aperture)


@pytest.mark.parametrize(("low", "high"), [(50.0, 40.0), (-1.0, 40.0), (float("nan"), 3.0), ("many", 3.0), (1.0, "no")])
def test_refused_thresholds(low, high):
    with pytest.raises(DrawingError, match="threshold"):
        thresholds(np.ones((3, 3), np.float32), low, high)
