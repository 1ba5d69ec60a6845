"""Where the pen goes down along parallel lines."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def places(extent: float, spacing: float) -> NDArray[np.float64]:
    """(n,) positions of lines around 0 that fill `extent` at `spacing`; one at least."""
    count = max(1, round(extent / spacing))
    return (np.arange(count, dtype=np.float64) - (count - 1) / 2) * spacing


def runs(
    down: NDArray[np.bool_], line: NDArray[np.int64], gap: int = 0, shortest: int = 1
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """First and last sample (m,) of each run, within one line, of samples (n,) that are `down`.

    Gaps of up to `gap` samples are drawn over; then runs of fewer than `shortest` samples are left out.
    """
    at = np.flatnonzero(down)
    if not len(at):
        return at, at
    apart = (np.diff(at) > gap + 1) | (np.diff(line[at]) != 0)
    first, last = at[np.r_[True, apart]], at[np.r_[apart, True]]
    long_enough = last - first + 1 >= shortest
    return first[long_enough], last[long_enough]
