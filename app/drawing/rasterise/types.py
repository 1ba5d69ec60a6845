"""The arrays that every mode shares."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Stroke: TypeAlias = NDArray[np.float64]
"""(n, 2) points, n >= 2; here in pixels, x right and y down from the middle of the first pixel."""

Grey: TypeAlias = NDArray[np.uint8]
"""(h, w), 0 for black."""

Field: TypeAlias = NDArray[np.float32]
"""(h, w) in 0..1."""

Mask: TypeAlias = NDArray[np.bool_]
"""(h, w)."""
