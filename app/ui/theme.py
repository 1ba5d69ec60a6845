"""Colours, the same for the same thing in 3-D, panels and plots. Safe for the colour-blind (Okabe & Ito, Tol)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Rgb = tuple[int, int, int]

LEGS: tuple[Rgb, ...] = ((0, 114, 178), (230, 159, 0), (0, 158, 115), (204, 121, 167))
"""Colour of leg (and drive) 1, 2, 3, 4."""
WARNING: Rgb = (204, 51, 17)
"""The leg that stops the robot, and nothing else."""
TRACE: Rgb = (86, 180, 233)
ACTUAL: Rgb = TRACE
"""What a tool or a drive really did."""
REFERENCE: Rgb = (120, 120, 128)
"""What it should have done; limits too."""
IDEAL: Rgb = (153, 153, 51)
"""What an ideal machine would have done."""
BASELINE: Rgb = (180, 60, 130)
"""What was kept to compare with."""
MARK: Rgb = (213, 94, 0)
"""A point to look at."""
MARK_2: Rgb = (125, 105, 215)
"""Another one in the same plot."""
VECTOR: Rgb = (86, 86, 96)
"""Vectors that belong to no leg."""
INK: Rgb = (38, 38, 46)
"""What a pen has drawn."""
PLAN: Rgb = (176, 180, 190)
"""What it is going to draw."""
PAPER: Rgb = (252, 252, 250)
PAPER_EDGE: Rgb = (150, 154, 164)

LIGHT_FLOOR: Rgb = (244, 245, 247)
DARK_FLOOR: Rgb = (30, 33, 38)

_VIRIDIS = np.array(
    [(68, 1, 84), (71, 44, 122), (59, 81, 139), (44, 113, 142), (33, 144, 141), (39, 173, 129), (92, 200, 99),
     (170, 220, 50), (253, 231, 37)]
)  # fmt: skip


def leg_color(leg: int) -> Rgb:
    """Colour of a leg, counted from 0."""
    return LEGS[leg % len(LEGS)]


def line_colors(marked: NDArray[np.bool_], mark: Rgb, other: Rgb) -> NDArray[np.uint8]:
    """(n, 2, 3) colours of both ends of n line segments; the page takes those as linear light, unlike one for all."""
    rgb = np.where(marked[:, None], np.array(mark), np.array(other)) / 255.0
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return np.repeat(np.rint(255.0 * linear).astype(np.uint8)[:, None], 2, axis=1)


def css(color: Rgb) -> str:
    return f"rgb({color[0]},{color[1]},{color[2]})"


def conditioning_colors(conditioning: ArrayLike) -> NDArray[np.uint8]:
    """(..., 3) bright where the robot moves evenly (condition number 1.5), dark towards a singularity (10)."""
    darkness = np.log(np.maximum(conditioning, 1.5) / 1.5) / np.log(10.0 / 1.5)
    stops = np.linspace(0.0, 1.0, len(_VIRIDIS))
    channels = [np.interp(1.0 - darkness, stops, _VIRIDIS[:, channel]) for channel in range(3)]
    return np.stack(channels, axis=-1).astype(np.uint8)
