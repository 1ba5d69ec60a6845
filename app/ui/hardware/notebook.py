"""Measured poses of one browser, until they are enough for a calibration. No widgets here."""

from __future__ import annotations

import numpy as np

from app.link.calibration.measurements import Measurements


class Notebook:
    """Rows of reported joints and measured tool, of one robot."""

    def __init__(self) -> None:
        self.robot = ""
        self._joints: list[tuple[float, ...]] = []
        self._tool_m: list[tuple[float, float, float]] = []
        self._angle: list[float] = []

    def __len__(self) -> int:
        return len(self._joints)

    def add(
        self, robot: str, joints: tuple[float, ...], tool_m: tuple[float, float, float], angle: float = float("nan")
    ) -> None:
        """One more pose (rad or m, m, rad); another robot begins a new page."""
        if robot != self.robot:
            self.clear()
            self.robot = robot
        self._joints.append(joints)
        self._tool_m.append(tool_m)
        self._angle.append(angle)

    def remove_last(self) -> None:
        for column in (self._joints, self._tool_m, self._angle):
            del column[-1:]

    def clear(self) -> None:
        self._joints, self._tool_m, self._angle = [], [], []

    def load(self, measurements: Measurements) -> None:
        """In place of what is there."""
        self.clear()
        rows = zip(measurements.joints.tolist(), measurements.tool_m.tolist(), measurements.angle.tolist(), strict=True)
        for joints, (x, y, z), angle in rows:
            self.add(measurements.robot, tuple(joints), (x, y, z), angle)

    @property
    def measurements(self) -> Measurements:
        """LinkError without a row, or with one that cannot be."""
        columns = (np.array(self._joints), np.array(self._tool_m).reshape(-1, 3), np.array(self._angle))
        return Measurements.of(self.robot, *columns)
