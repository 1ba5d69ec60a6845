"""Two drawings that need no picture, to compare robots with."""

from __future__ import annotations

import math

import numpy as np

from app.drawing.errors import DrawingError
from app.robots.robot import Array

A5_MM = (148.0, 210.0)


def zigzag(sheet_mm: tuple[float, float] = A5_MM, pitch_mm: float = 5.0, margin_mm: float = 10.0) -> list[Array]:
    """Rows to and fro all over a sheet in one stroke (n, 2) mm, as a laser draws a picture; at most a pitch apart."""
    width, height = (side - 2.0 * margin_mm for side in sheet_mm)
    if not (width > 0.0 and height > 0.0 and 0.0 < pitch_mm < math.inf):
        raise DrawingError(
            "A zigzag needs room inside the margins and a positive pitch; change the sheet or the pitch."
        )
    rows = 1 + math.ceil(height / pitch_mm)
    y = np.repeat(np.linspace(height / 2, -height / 2, rows), 2)
    side = np.resize([-1.0, 1.0, 1.0, -1.0], 2 * rows)
    return [np.column_stack([side * width / 2, y])]


def rose(radius_mm: float = 64.0, petals: int = 5, points: int = 720) -> list[Array]:
    """r = radius cos(petals phi) in one closed stroke (points + 1, 2) mm: curved all over, through the middle.

    As usual for this curve an even number gives twice as many petals.
    """
    turn = np.linspace(0.0, 2.0 * np.pi if petals % 2 == 0 else np.pi, points + 1)
    radius = radius_mm * np.cos(petals * turn)
    stroke = np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])
    stroke[-1] = stroke[0]
    return [stroke]
