"""What one student adds to the picture of all: a short line of points."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.classroom.pace import OverlayKind

if TYPE_CHECKING:
    from app.ui.desks import Desks

POINTS = 160


class Line(NamedTuple):
    """Points in the order in which they are joined, in display units: s and %, or mm and mm."""

    x: NDArray[np.float64]
    """(k,)"""
    y: NDArray[np.float64]
    """(k,)"""


def thinned(x: ArrayLike, y: ArrayLike) -> Line | None:
    """At most `POINTS` of (n,) points, the first and the last among them; None where there is nothing to draw."""
    points = np.column_stack([np.asarray(x, dtype=float), np.asarray(y, dtype=float)])
    points = points[np.isfinite(points).all(axis=1)]
    if len(points) < 2:
        return None
    chosen = np.unique(np.linspace(0, len(points) - 1, min(POINTS, len(points))).round().astype(int))
    return Line(*points[chosen].T)


def line_of(desks: Desks, kind: OverlayKind) -> Line | None:
    """What the desks of one page have of this kind; looking makes no desk."""
    return _step_response(desks) if kind == "step_response" else _tool_path(desks)


def _step_response(desks: Desks) -> Line | None:
    answer = desks.control.answer if desks.has("control") else None
    if answer is None or answer.settings.setpoint == 0.0:
        return None
    board = answer.study.board
    return thinned(board.t, 100.0 * board.y / answer.settings.setpoint)


def _tool_path(desks: Desks) -> Line | None:
    run = desks.run
    return None if run is None else thinned(1e3 * run.pose[:, 0], 1e3 * run.pose[:, 1])
