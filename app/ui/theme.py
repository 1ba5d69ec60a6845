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

LAWS: dict[str, Rgb] = {
    "PD": (255, 135, 0),
    "PID": (40, 110, 165),
    "PD+": (200, 185, 110),
    "PDff": (150, 90, 0),
    "CTC": (0, 195, 210),
    "CTC+DOB": (115, 40, 255),
    "MPC": (165, 195, 165),
    "SMC": (190, 10, 70),
    "TSIDC": (230, 115, 255),
    "TSIIDC": (135, 40, 195),
}
"""Colour of a control law, by its name. Any two differ for every eye, and each is seen on light and dark."""
COMPONENTS: dict[str, Rgb] = {
    "p": (255, 135, 0),
    "d": (0, 195, 210),
    "i": (40, 110, 165),
    "M": (230, 115, 255),
    "n": (190, 10, 70),
    "ff": (150, 90, 0),
    "dob": (115, 40, 255),
    "s": (135, 40, 195),
    "qp": (200, 185, 110),
}
"""Colour of a part of the torque, by its name."""

LIGHT_FLOOR: Rgb = (244, 245, 247)
DARK_FLOOR: Rgb = (30, 33, 38)

_VIRIDIS = np.array(
    [(68, 1, 84), (71, 44, 122), (59, 81, 139), (44, 113, 142), (33, 144, 141), (39, 173, 129), (92, 200, 99),
     (170, 220, 50), (253, 231, 37)]
)  # fmt: skip


def leg_color(leg: int) -> Rgb:
    """Colour of a leg, counted from 0."""
    return LEGS[leg % len(LEGS)]


def law_color(law: str) -> Rgb:
    """Colour of a control law."""
    return LAWS.get(law, VECTOR)


def component_color(component: str) -> Rgb:
    """Colour of a part of the torque."""
    return COMPONENTS.get(component, VECTOR)


def line_colors(marked: NDArray[np.bool_], mark: Rgb, other: Rgb) -> NDArray[np.uint8]:
    """(n, 2, 3) colours of both ends of n line segments; the page takes those as linear light, unlike one for all."""
    rgb = np.where(marked[:, None], np.array(mark), np.array(other)) / 255.0
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return np.repeat(np.rint(255.0 * linear).astype(np.uint8)[:, None], 2, axis=1)


def css(color: Rgb) -> str:
    return f"rgb({color[0]},{color[1]},{color[2]})"


def conditioning_colors(conditioning: ArrayLike) -> NDArray[np.uint8]:
    """(..., 3) bright where the robot moves evenly (condition number 1.5), dark towards a singularity (10)."""
    return ramp(1.0 - np.log(np.maximum(conditioning, 1.5) / 1.5) / np.log(10.0 / 1.5))


def ramp(brightness: ArrayLike) -> NDArray[np.uint8]:
    """(..., 3) colours from dark (0) to bright (1), evenly spaced for the eye."""
    stops = np.linspace(0.0, 1.0, len(_VIRIDIS))
    channels = [np.interp(np.asarray(brightness, dtype=float), stops, _VIRIDIS[:, channel]) for channel in range(3)]
    return np.stack(channels, axis=-1).astype(np.uint8)
