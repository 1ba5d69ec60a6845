"""Where the sheet lies in the robot's workspace, and what fits on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from app.drawing.errors import DrawingError
from app.drawing.toolpath.pen import default_pen
from app.robots import Robot
from app.robots.robot import Array

BELOW_HOME_M = 0.010
"""The paper lies this far below the home pose: on the default delta3 at z = -340 mm, under a travel height of -330."""

PROBE_M = 0.004
"""Spacing of the points at which a whole sheet is tried, m."""


@dataclass(frozen=True)
class Placement:
    """The plane of the sheet, which is horizontal."""

    height_m: float
    """z of the tool when the pen touches the paper."""
    centre_m: tuple[float, float] = (0.0, 0.0)
    """x and y of the middle of the sheet."""
    rotation_rad: float = 0.0
    """Turn of the sheet, counter-clockwise from above."""

    def on_table(self, points_mm: Array) -> Array:
        """(n, 2) sheet millimetres -> (n, 2) x and y in the robot's frame, m."""
        c, s = math.cos(self.rotation_rad), math.sin(self.rotation_rad)
        return 1e-3 * np.asarray(points_mm, dtype=float) @ np.array([[c, s], [-s, c]]) + np.array(self.centre_m)

    def on_sheet(self, points_m: Array) -> Array:
        """(n, 2) x and y in the robot's frame, m -> (n, 2) sheet millimetres: the inverse of `on_table`."""
        c, s = math.cos(self.rotation_rad), math.sin(self.rotation_rad)
        return 1e3 * (points_m - np.array(self.centre_m)) @ np.array([[c, -s], [s, c]])


class Sheet(NamedTuple):
    """A paper format as it lies, x by y."""

    name: str
    width_mm: float
    height_mm: float

    def turned(self) -> Sheet:
        """The same paper, turned by a quarter."""
        return Sheet(self.name, self.height_mm, self.width_mm)


SHEETS = (Sheet("A3", 297, 420), Sheet("A4", 210, 297), Sheet("A5", 148, 210), Sheet("A6", 105, 148))
"""From the largest to the smallest, upright."""


def default_placement(robot: Robot) -> Placement:
    """Below the home pose, where every robot has room around: the default geometries draw A5 and more."""
    x, y, z = robot.home[:3].tolist()
    lower = robot.home.copy()
    lower[2] = z - BELOW_HOME_M
    return Placement(float(lower[2]) if robot.reach(lower).ok else z, (x, y))


def largest_sheet(robot: Robot, placement: Placement | None = None, lift_mm: float | None = None) -> Sheet | None:
    """The largest of `SHEETS` that can be drawn all over, pen down and lifted; None if not even the smallest.

    Where a format fits both ways it is returned upright. The lift is by default that of `default_pen(robot)`.
    """
    placement = placement or default_placement(robot)
    tries = (sheet for upright in SHEETS for sheet in (upright, upright.turned()))
    return next((sheet for sheet in tries if sheet_fits(sheet, robot, placement, lift_mm)), None)


def sheet_fits(sheet: Sheet, robot: Robot, placement: Placement, lift_mm: float | None = None) -> bool:
    """Whether every point of the sheet is in reach, at the paper's height and at that of the lifted pen."""
    lift_m = 1e-3 * (default_pen(robot).lift_mm if lift_mm is None else lift_mm)
    axes = [
        np.linspace(-side / 2, side / 2, 1 + math.ceil(1e-3 * side / PROBE_M))
        for side in (sheet.width_mm, sheet.height_mm)
    ]
    points = placement.on_table(np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2))
    return all(bool(robot.reachable(poses(robot, points, placement.height_m + z)).all()) for z in (0.0, lift_m))


def fit_to_sheet(strokes: Sequence[Array], sheet: Sheet, margin_mm: float = 10.0) -> list[Array]:
    """The drawing as large as the margin allows, in the middle of the sheet.

    Args:
        strokes: (n, 2) each, in any unit, y up.
    Returns:
        the strokes in sheet millimetres.
    """
    room = np.array([sheet.width_mm, sheet.height_mm]) - 2 * margin_mm
    if room.min() <= 0.0:
        raise DrawingError(f"A margin of {margin_mm:g} mm leaves nothing of the {sheet.name} sheet; make it smaller.")
    low, high = _bounds(strokes)
    with np.errstate(divide="ignore"):
        scale = float(np.min(room / (high - low)))
    if not math.isfinite(scale):
        scale = 1.0  # dots on one spot: any size is as good
    return [(np.asarray(stroke, dtype=float) - (low + high) / 2) * scale for stroke in strokes]


def _bounds(strokes: Sequence[Array]) -> tuple[Array, Array]:
    if not len(strokes):
        raise DrawingError("There is nothing to draw; choose a picture with more contrast or keep shorter strokes.")
    points = np.concatenate([np.asarray(stroke, dtype=float) for stroke in strokes])
    return points.min(axis=0), points.max(axis=0)


def poses(robot: Robot, points: Array, z: Array | float) -> Array:
    """(n, dof) poses at these x and y (n, 2) and heights, m; a rotation is 0."""
    pose = np.zeros((len(points), robot.dof))
    pose[:, :2], pose[:, 2] = points, z
    return pose
