"""The last seconds of the robot on the table, for all rooms together."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray

from app.link.protocol.messages import Telemetry

LENGTH_S = 20.0
STEP_S = 0.1
"""Of what is plotted; recordings have every message."""

Array = NDArray[np.float64]


class History:
    """Thinned telemetry by the time of its arrival."""

    def __init__(self) -> None:
        self._rows: deque[tuple[float, ...]] = deque()
        self._columns: tuple[Array, Array, Array, Array] | None = None

    def append(self, telemetry: Telemetry, now: float) -> None:
        """What came at `now` (s, any clock that goes forward)."""
        if self._rows and now - self._rows[-1][0] < STEP_S:
            return
        self._rows.append((now, *telemetry.position, *telemetry.setpoint, *telemetry.drive))
        while now - self._rows[0][0] > LENGTH_S:
            self._rows.popleft()
        self._columns = None

    def clear(self) -> None:
        self._rows.clear()
        self._columns = None

    @property
    def columns(self) -> tuple[Array, Array, Array, Array]:
        """Time (k,) s, the newest 0; position, set-point (k, 4) rad or m, and drive (k, 4) -1..1."""
        if self._columns is None:
            rows = np.array(self._rows).reshape(-1, 13)
            t = rows[:, 0] - (rows[-1, 0] if len(rows) else 0.0)
            self._columns = t, rows[:, 1:5], rows[:, 5:9], rows[:, 9:13]
        return self._columns
