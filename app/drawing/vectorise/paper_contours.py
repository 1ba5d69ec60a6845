"""The paper's own way, for comparison: contours around Canny's edges, which draw nearly every line twice."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.vectorise.chains import Line


def paper_contours(edges: NDArray[np.bool_]) -> list[Line]:
    """Closed strokes around an edge mask (h, w), pixel by pixel as `findContours` returns them; dots are left out."""
    found, _ = cv2.findContours(edges.astype(np.uint8), cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE)
    return [np.concatenate([contour, contour[:1]])[:, 0].astype(float) for contour in found if len(contour) > 1]
