"""Whether a picture has so many lines, as noise and dithering have, that tracing them would take minutes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import TooManyStrokes

MAX_LINES = 20_000
"""Between ends and junctions: photos and drawings of a megapixel have some hundreds to some thousands."""

SIDES = ((-1, 0), (1, 0), (0, -1), (0, 1))


def check_lines(thin: NDArray[np.bool_]) -> None:
    """TooManyStrokes for a mask (h, w) of thin lines that nobody would draw."""
    count = line_count(thin)
    if count > MAX_LINES:
        raise TooManyStrokes(
            f"This picture gives {count} lines, more than {MAX_LINES} that make sense; smooth it or make it smaller.",
            count,
        )


def line_count(thin: NDArray[np.bool_]) -> int:
    """How many lines between ends and junctions a mask (h, w) of thin lines has, rings not counted.

    Neighbours are as in `pixel_graph`: those at a corner count only if no third pixel joins the two by its sides.
    """
    height, width = thin.shape
    padded = np.pad(thin, 1)

    def beside(y: int, x: int) -> NDArray[np.bool_]:
        return padded[1 + y : 1 + y + height, 1 + x : 1 + x + width]

    degree = np.zeros(thin.shape, np.uint8)
    for y, x in SIDES:
        degree += beside(y, x)
    for y in (-1, 1):
        for x in (-1, 1):
            degree += beside(y, x) & ~beside(y, 0) & ~beside(0, x)
    degree = degree[thin]
    return int(degree[degree != 2].sum(dtype=np.int64)) // 2 + int(np.count_nonzero(degree == 0))
