"""Where the tool was found to be, beside what the board said of its joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.link.errors import LinkError
from app.link.twin.tables import read_tables, write_table
from app.robots import ROBOTS
from app.robots.robot import Robot
from app.simulation.run import SHOWN

Array = NDArray[np.float64]

MAX_ROWS = 1000
FARTHEST_M = 5.0
"""A tool farther from the origin is a mistake in the unit."""


@dataclass(frozen=True, eq=False)
class Measurements:
    """k poses of a robot with n joints."""

    robot: str
    """Its name in `ROBOTS`."""
    joints: Array
    """(k, n) as the board reports them, rad or m."""
    tool_m: Array
    """(k, 3) x, y, z of the tool as measured, in the frame of the ruler or grid."""
    angle: Array
    """(k,) rad, the pose's rotation as measured; NaN where it was not."""
    lines: tuple[int, ...]
    """What each row is called in sentences: its line in the file, or its number."""

    def __post_init__(self) -> None:
        k, n = len(self.lines), len(ROBOTS[self.robot].build.joint_names)
        if self.joints.shape != (k, n) or self.tool_m.shape != (k, 3) or self.angle.shape != (k,):
            raise LinkError(f"Each measurement of {self.robot} needs {n} joints and x, y, z of the tool.")
        if not k:
            raise LinkError("There are no measurements yet; move the tool to a known point and add a row.")
        if k > MAX_ROWS:
            raise LinkError(f"There are more than {MAX_ROWS} measurements; keep the best of them.")
        wrong = ~(np.isfinite(self.joints).all(axis=1) & np.isfinite(self.tool_m).all(axis=1)) | np.isinf(self.angle)
        if wrong.any():
            raise LinkError(
                f"Row {self.lines[int(np.argmax(wrong))]}: a value is missing or not finite; delete the row."
            )
        far = np.abs(self.tool_m).max(axis=1) > FARTHEST_M
        if far.any():
            line = self.lines[int(np.argmax(far))]
            raise LinkError(f"Row {line}: the tool is more than {FARTHEST_M:g} m away; give x, y and z in millimetres.")

    @property
    def values(self) -> int:
        """How many numbers were measured."""
        return self.tool_m.size + int(np.isfinite(self.angle).sum())

    @classmethod
    def of(cls, robot: str, joints: Array, tool_m: Array, angle: Array | None = None) -> Measurements:
        """From arrays as in the class; rows are called by their numbers from 1."""
        count = len(joints)
        missing = np.full(count, np.nan) if angle is None else np.asarray(angle, dtype=float)
        rows = tuple(range(1, count + 1))
        return cls(robot, np.asarray(joints, dtype=float), np.asarray(tool_m, dtype=float), missing, rows)

    @classmethod
    def from_csv(cls, robot: str, text: str) -> Measurements:
        """A table with the columns of `head`, in any order; the angle's column and its cells may be left out (nan).

        Raises:
            LinkError: with the line's number, for anything that is not such a table.
        """
        _, tables = read_tables(text)
        names, kind = head(robot), ROBOTS[robot].build
        if not tables:
            raise LinkError(f"The file is empty; it needs a head ({', '.join(names)}) and a row for each pose.")
        table, n = tables[0], len(kind.joint_names)
        tool_names, angle_name = names[n : n + 3], names[n + 3 :]
        with_angle = bool(angle_name) and angle_name[0] in table.names
        angle = np.radians(table.column(angle_name[0])) if with_angle else np.full(len(table.values), np.nan)
        joints = table.columns(names[:n]) / SHOWN[kind.joint_unit][1]
        return cls(robot, joints, table.columns(tool_names) / 1e3, angle, table.lines)

    def csv(self) -> str:
        """What `from_csv` reads."""
        kind = ROBOTS[self.robot].build
        columns = [self.joints * SHOWN[kind.joint_unit][1], self.tool_m * 1e3]
        if len(kind.pose_names) == 4:
            columns.append(np.degrees(self.angle)[:, None])
        return write_table(head(self.robot), np.hstack(columns))

    def without(self, lines: Sequence[int]) -> Measurements:
        """All rows but those of this name."""
        return self.rows([k for k, line in enumerate(self.lines) if line not in lines])

    def rows(self, kept: Sequence[int]) -> Measurements:
        """Only these, counted from 0; they keep their names."""
        lines = tuple(self.lines[k] for k in kept)
        return Measurements(self.robot, self.joints[kept], self.tool_m[kept], self.angle[kept], lines)


def head(robot: str) -> list[str]:
    """Columns of a table of measurements."""
    kind: type[Robot] = ROBOTS[robot].build
    unit = SHOWN[kind.joint_unit][0]
    joints = [f"{name}_{unit}" for name in kind.joint_names]
    return [*joints, "x_mm", "y_mm", "z_mm", *(f"{name}_deg" for name in kind.pose_names[3:])]
