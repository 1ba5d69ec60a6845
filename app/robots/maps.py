"""Maps of a horizontal slice of the workspace: how well a robot moves there, and what a motion would cost its drives.

Each quantity is that of the worst horizontal direction. From rest, joint efforts are affine in the tool's
acceleration a:  f(a) = g + K a  with  g = J^-T g_P,  K = J^-T M_P.  With a = |a| (cos w, sin w, 0) the largest
|f_i| over w is  |g_i| + |a| sqrt(K_ix^2 + K_iy^2);  joint speeds follow likewise from J.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.robots import build_robot
from app.robots.dynamics import INERTIA, Dynamics, dynamics_of
from app.robots.limits import drive_limits
from app.robots.robot import EFFORT_UNITS, Array
from app.robots.slices import extent, slice_poses

SPACING_M = 0.005
MOST_POINTS = 240
"""Along each side; a larger slice gets a wider spacing."""

PERCENT = 100.0


@dataclass(frozen=True)
class MapSettings:
    """Which map of which slice. Plain data."""

    robot: str
    dimensions: dict[str, float] = field(default_factory=dict)
    quantity: str = "torque share"
    """A key of `MAPS`."""
    height_m: float = 0.0
    rotation_rad: float = 0.0
    """theta or phi, for a robot that has one."""
    acceleration: float = 10.0
    """Of the tool, in the worst horizontal direction, m/s^2."""
    vector: tuple[float, float, float] = (10.0, 0.0, 0.0)
    """Acceleration of the tool for the torque of one joint, m/s^2."""
    joint: int = 0
    """Whose torque, from 0."""
    speed: float = 1.0
    """Of the tool, in the worst horizontal direction, m/s."""
    payload_kg: float = 0.0


class MapKind(NamedTuple):
    """What a map can show."""

    title: str
    note: str
    """One sentence for students."""
    measure: Callable[[Mapped, Array], Array]
    """Value (k,) at poses (k, dof)."""
    uses: frozenset[str] = frozenset()
    """Fields of `MapSettings` that matter beside the slice."""
    unit: str = ""
    """As displayed; `effort` stands for N m or N."""
    level: Callable[[Mapped], float | None] = lambda _: None
    """Value at which a drive is at its limit."""
    more_is_better: bool = False


class Mapped:
    """A robot with what its maps need."""

    def __init__(self, settings: MapSettings) -> None:
        self.settings = settings
        self.robot = build_robot(settings.robot, settings.dimensions)
        self.limits = drive_limits(self.robot)

    @cached_property
    def dynamics(self) -> Dynamics:
        inertia = INERTIA[self.robot.name].changed(payload=self.settings.payload_kg)
        return dynamics_of(self.robot, inertia)

    def efforts(self, poses: Array, acceleration: tuple[float, float, float]) -> Array:
        """(k, n) joint efforts, N m or N, that give the tool at rest an acceleration (3,) in m/s^2."""
        wanted = np.zeros_like(poses)
        wanted[:, :3] = acceleration
        return self.dynamics.inverse(poses, np.zeros_like(poses), wanted)

    def horizontal(self, poses: Array) -> tuple[Array, Array]:
        """Joint efforts (k, n) that hold the robot, and those (k, n) that 1 m/s^2 adds in its worst direction."""
        holding = self.efforts(poses, (0.0, 0.0, 0.0))
        along_x = self.efforts(poses, (1.0, 0.0, 0.0)) - holding
        along_y = self.efforts(poses, (0.0, 1.0, 0.0)) - holding
        return holding, np.hypot(along_x, along_y)

    def worst_efforts(self, poses: Array) -> Array:
        """(k, n) largest |effort| of each joint while the tool accelerates in any horizontal direction."""
        holding, added = self.horizontal(poses)
        return np.abs(holding) + self.settings.acceleration * added

    def worst_joint_speeds(self, poses: Array) -> Array:
        """(k, n) largest |speed| of each joint, rad/s or m/s, while the tool moves in any horizontal direction."""
        J = self.robot.jacobian(poses)
        return self.settings.speed * np.hypot(J[..., 0], J[..., 1])

    def available_acceleration(self, poses: Array) -> Array:
        """(k,) m/s^2 that the drives can give the tool at rest in every horizontal direction; 0 where they cannot
        even hold it."""
        holding, added = self.horizontal(poses)
        left = np.maximum(self.limits.effort - np.abs(holding), 0.0)
        return np.min(left / np.maximum(added, 1e-12), axis=-1)

    @property
    def effort_unit(self) -> str:
        return EFFORT_UNITS[self.robot.joint_unit]


MAPS: dict[str, MapKind] = {
    "torque share": MapKind(
        "Torque for an acceleration",
        "The hardest worked drive, in percent of its peak, while the tool speeds up in its worst horizontal direction.",
        lambda m, poses: PERCENT * np.max(m.worst_efforts(poses) / m.limits.effort, axis=-1),
        frozenset({"acceleration", "payload_kg"}),
        "%",
        lambda _: PERCENT,
    ),
    "available": MapKind(
        "Acceleration available",
        "What the drives can give the tool in every horizontal direction, gravity already held.",
        lambda m, poses: m.available_acceleration(poses),
        frozenset({"payload_kg"}),
        "m/s²",
        more_is_better=True,
    ),
    "joint torque": MapKind(
        "Torque of one joint",
        "What one drive gives for exactly this acceleration of the tool from rest, gravity included.",
        lambda m, poses: m.efforts(poses, m.settings.vector)[:, m.settings.joint],
        frozenset({"vector", "joint", "payload_kg"}),
        "effort",
        lambda m: float(m.limits.effort[m.settings.joint]),
    ),
    "joint speed": MapKind(
        "Joint speed for a tool speed",
        "The fastest joint, in percent of its limit, while the tool moves in its worst horizontal direction.",
        lambda m, poses: PERCENT * np.max(m.worst_joint_speeds(poses) / m.limits.speed, axis=-1),
        frozenset({"speed"}),
        "%",
        lambda _: PERCENT,
    ),
    "conditioning": MapKind(
        "Conditioning",
        "1 where the robot moves equally well in all directions, large near a singularity.",
        lambda m, poses: m.robot.conditioning(poses),
    ),
}


@dataclass(frozen=True)
class WorkspaceMap:
    """One quantity over a horizontal slice."""

    settings: MapSettings
    x: Array
    """(c,) m, evenly spaced"""
    y: Array
    """(r,) m, evenly spaced"""
    values: Array
    """(r, c) in `unit`; NaN out of reach"""
    unit: str
    level: float | None
    """Beyond it (or below its negative) a drive is over its limit; None where there is no such value."""

    @property
    def beyond(self) -> NDArray[np.bool_]:
        """(r, c) where a drive is over its limit."""
        return np.zeros(self.values.shape, bool) if self.level is None else np.abs(self.values) > self.level

    def at(self, x: float, y: float) -> float:
        """The value at a position, between the points of the map; NaN out of reach."""
        column, row = ((v - axis[0]) / (axis[1] - axis[0]) for v, axis in ((x, self.x), (y, self.y)))
        if not (0.0 <= column <= len(self.x) - 1 and 0.0 <= row <= len(self.y) - 1):
            return float("nan")
        c, r = min(int(column), len(self.x) - 2), min(int(row), len(self.y) - 2)
        across, along = np.array([1 - (column - c), column - c]), np.array([1 - (row - r), row - r])
        return float(along @ self.values[r : r + 2, c : c + 2] @ across)


def compute_map(settings: MapSettings, spacing: float = SPACING_M) -> WorkspaceMap:
    """The map of a slice, on a grid of about `spacing` metres that contains x = 0 and y = 0."""
    mapped, quantity = Mapped(settings), MAPS[settings.quantity]
    low, high = extent(mapped.robot, settings.height_m, settings.rotation_rad)
    spacing = max(spacing, float(np.max(high - low)) / (MOST_POINTS - 1))
    x, y = (
        spacing * np.arange(np.floor(a / spacing), np.ceil(b / spacing) + 1) for a, b in zip(low, high, strict=True)
    )
    poses = slice_poses(mapped.robot, x, y, settings.height_m, settings.rotation_rad)
    inside = mapped.robot.reachable(poses)
    values = np.full(inside.shape, np.nan)
    values[inside] = quantity.measure(mapped, poses[inside])
    values[~np.isfinite(values)] = np.nan
    unit = mapped.effort_unit if quantity.unit == "effort" else quantity.unit
    return WorkspaceMap(settings, x, y, values, unit, quantity.level(mapped))
