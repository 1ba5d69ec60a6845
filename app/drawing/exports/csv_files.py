"""Strokes, and a timed path of a robot, as CSV for spreadsheets and other programs."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.exports.strokes import Stroke, checked_strokes


class TimedPath(Protocol):
    """A robot's path in time, as a toolpath has it."""

    @property
    def t(self) -> NDArray[np.float64]:
        """(n,) s."""
        ...

    @property
    def pose(self) -> NDArray[np.float64]:
        """(n, 3 or more): x, y, z in the robot's base frame, m; what follows is not written."""
        ...

    @property
    def q(self) -> NDArray[np.float64]:
        """(n, joints) in the robot's units: rad, or m of a carriage."""
        ...

    @property
    def pen(self) -> NDArray[np.bool_]:
        """(n,) whether the pen is down."""
        ...


def write_strokes_csv(strokes: Sequence[Stroke]) -> str:
    """Rows `stroke_id,x_mm,y_mm`: strokes counted from 0, mm from the sheet's middle, y up; nothing is rounded."""
    rows = ["stroke_id,x_mm,y_mm\n"]
    for number, stroke in enumerate(checked_strokes(strokes)):
        rows += [f"{number},{x!r},{y!r}\n" for x, y in stroke.tolist()]
    return "".join(rows)


def write_toolpath_csv(toolpath: TimedPath) -> str:
    """Rows `t,x,y,z,q1,...,qn,pen` in s, m and the joints' units, to 1e-7; the pen is 1 down and 0 up."""
    t, pose, q, pen = (np.asarray(part, dtype=float) for part in (toolpath.t, toolpath.pose, toolpath.q, toolpath.pen))
    if pose.ndim != 2 or pose.shape[1] < 3 or q.ndim != 2 or not len(t) == len(pose) == len(q) == len(pen):
        raise DrawingError("The path has no time, place, joints and pen for every sample; compute it again.")
    table = np.column_stack([t, pose[:, :3], q, pen])
    joints = [f"q{number}" for number in range(1, q.shape[1] + 1)]
    text = io.StringIO()
    formats = ["%.7f"] * (table.shape[1] - 1) + ["%d"]
    header = ",".join(["t", "x", "y", "z", *joints, "pen"])
    np.savetxt(text, table, fmt=formats, delimiter=",", header=header, comments="")
    return text.getvalue()
