"""Horizontal slices of the space that a robot reaches."""

from __future__ import annotations

import numpy as np

from app.robots.robot import Array, Robot

COARSE_POINTS = 97
HEIGHTS = 400
PARTS = 4
"""Into so many times so many parts a cell at the edge of reach is divided."""


def slice_poses(robot: Robot, x: Array, y: Array, height: float, rotation: float) -> Array:
    """(r, c, dof) poses of a horizontal grid."""
    poses = np.empty((len(y), len(x), robot.dof))
    poses[..., 0], poses[..., 1], poses[..., 2], poses[..., 3:] = x, y[:, None], height, rotation
    return poses


def extent(robot: Robot, height: float, rotation: float) -> tuple[Array, Array]:
    """Lowest and highest corner (2,) of a rectangle around the reachable part of a slice, m."""
    span = _span(robot)
    axis, step = np.linspace(-span, span, COARSE_POINTS, retstep=True)
    rows, columns = np.nonzero(robot.reachable(slice_poses(robot, axis, axis, height, rotation)))
    if not len(rows):  # smaller than the coarse grid, or nothing: then it lies around home
        return robot.home[:2] - step, robot.home[:2] + step
    corners = axis[[columns.min(), rows.min()]], axis[[columns.max(), rows.max()]]
    return corners[0] - step, corners[1] + step


def heights(robot: Robot, rotation: float = 0.0) -> tuple[float, float]:
    """How far the tool can go straight down and up from home, z in m."""
    steps = np.linspace(0.0, _span(robot), HEIGHTS)
    column = np.tile(np.array([*robot.home[:3], rotation][: robot.dof]), (2, HEIGHTS, 1))
    column[..., 2] += np.stack([-steps, steps])
    outside = ~robot.reachable(column)
    last = np.maximum(np.where(outside.any(axis=1), outside.argmax(axis=1), HEIGHTS) - 1, 0)
    return float(column[0, last[0], 2]), float(column[1, last[1], 2])


def _span(robot: Robot) -> float:
    """No robot reaches farther than all its lengths together, m."""
    dimensions = robot.geometry.dimensions().items()
    return sum(abs(getattr(robot.geometry, name)) for name, dimension in dimensions if dimension.unit == "m")


def coverage(robot: Robot, x: Array, y: Array, height: float, rotation: float) -> Array:
    """How much of each cell of a slice's grid lies in reach, 0 to 1.

    Args:
        x, y: (c,) and (r,) middles of the cells, evenly spaced, m.
        height: z, m.
        rotation: theta or phi, rad; ignored by a robot that has none.
    Returns:
        (r, c); cells whose neighbours are all like them count as whole.
    """
    poses = slice_poses(robot, x, y, height, rotation)
    inside = robot.reachable(poses)
    ringed = np.pad(inside, 1)
    around = np.stack([ringed[i : i + len(y), j : j + len(x)] for i in range(3) for j in range(3)])
    edge = around.any(axis=0) & ~around.all(axis=0)
    offsets = ((np.arange(PARTS) + 0.5) / PARTS - 0.5) * (x[1] - x[0])
    parts = np.tile(poses[edge][:, None, None], (1, PARTS, PARTS, 1))
    parts[..., 0] += offsets
    parts[..., 1] += offsets[:, None]
    shares = inside.astype(float)
    shares[edge] = robot.reachable(parts).mean(axis=(1, 2))
    return shares
