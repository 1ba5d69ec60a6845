"""How much is drawn twice."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.retraced import retraced_share

LINE = np.array([[0.0, 0.0], [100.0, 0.0]])
t = np.linspace(0.0, 2.0 * np.pi, 400)
CIRCLE = 40.0 * np.column_stack([np.cos(t), np.sin(t)])


@pytest.mark.parametrize(
    ("strokes", "share"),
    [
        ([], 0.0),
        ([LINE], 0.0),
        ([CIRCLE], 0.0),
        ([LINE, LINE], 0.5),
        ([LINE, LINE[::-1] + (0.0, 0.2)], 0.5),
        ([np.vstack([LINE, LINE[::-1]])], 0.5),
        ([LINE, LINE + (0.0, 2.0)], 0.0),
        ([CIRCLE] * 3, 2.0 / 3.0),
        ([LINE, np.array([[50.0, -50.0], [50.0, 50.0]])], 0.0),
    ],
)
def test_the_share_of_known_drawings(strokes: list[np.ndarray], share: float):
    assert retraced_share(strokes) == pytest.approx(share, abs=0.02)
