"""A colour for each law and each part of a torque: told apart by every eye, seen on light and dark."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
import pytest
from numpy.typing import NDArray

from app.control.laws import LAWS
from app.ui import theme

Array = NDArray[np.float64]

EYES = {
    "normal": np.eye(3),
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
"""What an eye sees of linear light (Machado, Oliveira & Fernandes 2009, severity 1)."""
XYZ = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)
WHITE = XYZ.sum(axis=1)

APART = 20.0
"""CIELAB distance at which two colours are easily told apart; 2.3 is just noticeable."""
LEAST_CONTRAST = 1.7
"""Of a thick line against the page, after WCAG's formula."""


def linear(colors: Sequence[theme.Rgb]) -> Array:
    rgb = np.asarray(colors) / 255.0
    return np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)


def lab(light: Array) -> Array:
    """(k, 3) CIELAB of linear light (k, 3)."""
    share = np.clip(light, 0.0, 1.0) @ XYZ.T / WHITE
    f = np.where(share > 0.008856, np.cbrt(share), 7.787 * share + 16.0 / 116.0)
    return np.stack([116.0 * f[:, 1] - 16.0, 500.0 * (f[:, 0] - f[:, 1]), 200.0 * (f[:, 1] - f[:, 2])], axis=1)


def contrast(a: theme.Rgb, b: theme.Rgb) -> float:
    low, high = sorted((linear([a, b]) @ XYZ[1]).tolist())
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("eye", EYES)
@pytest.mark.parametrize("colors", [theme.LAWS, theme.COMPONENTS], ids=["laws", "components"])
def test_any_two_are_told_apart_by_every_eye(eye: str, colors: dict[str, theme.Rgb]):
    seen = dict(zip(colors, lab(linear([*colors.values()]) @ np.array(EYES[eye]).T), strict=True))
    near = {
        (a, b): distance
        for a, b in itertools.combinations(colors, 2)
        if (distance := float(np.linalg.norm(seen[a] - seen[b]))) < APART
    }
    assert not near


@pytest.mark.parametrize("floor", [theme.LIGHT_FLOOR, theme.DARK_FLOOR])
def test_each_is_seen_on_light_and_dark(floor: theme.Rgb):
    for name, color in {**theme.LAWS, **theme.COMPONENTS}.items():
        assert contrast(color, floor) > LEAST_CONTRAST, name


def test_every_law_and_every_part_of_it_has_a_colour():
    assert theme.LAWS.keys() == LAWS.keys()
    assert {part for law in LAWS.values() for part in law.parts} <= theme.COMPONENTS.keys()
