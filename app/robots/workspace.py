"""The set of positions a robot can reach, as a cloud of points or as a closed surface."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.robots.robot import Array, Robot


class Cloud(NamedTuple):
    """Reachable points of a regular grid."""

    points: Array
    """(k, 3) m"""
    conditioning: Array
    """(k,)"""
    volume: float
    """Points times the volume of a grid cell, m^3."""


class Surface(NamedTuple):
    """A closed triangle mesh around the home pose, as far as straight lines from there stay inside."""

    vertices: Array
    """(v, 3) m"""
    faces: NDArray[np.int64]
    """(f, 3)"""
    conditioning: Array
    """(v,) just inside the surface"""


def grid(low: Array, high: Array, step: float, rotation: float | None = None) -> Array:
    """(k, dof) poses of a regular grid, both ends included, at one angle of the rotation if there is one."""
    axes = [np.arange(a, b + step * 1e-6, step) for a, b in zip(low, high, strict=True)]
    if rotation is not None:
        axes.append(np.array([rotation]))
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))


def bounding_box(robot: Robot, rotation: float = 0.0) -> tuple[Array, Array]:
    """Lowest and highest corner (3,) of the reachable positions, to a few millimetres outward."""
    surface = boundary(robot, rotation, rings=24, segments=48)
    margin = 0.02 * np.ptp(surface.vertices, axis=0).max()
    return surface.vertices.min(axis=0) - margin, surface.vertices.max(axis=0) + margin


def cloud(robot: Robot, rotation: float = 0.0, step: float = 0.02) -> Cloud:
    """Reachable points on a grid of `step` metres that contains the home position.

    Args:
        rotation: theta or phi of the poses, rad; ignored by a robot without rotation.
    """
    low, high = bounding_box(robot, rotation)
    centre = robot.home[:3]
    poses = grid(
        centre + np.floor((low - centre) / step) * step,
        centre + np.ceil((high - centre) / step) * step,
        step,
        rotation if robot.dof == 4 else None,
    )
    poses = poses[robot.reachable(poses)]
    return Cloud(poses[:, :3], robot.conditioning(poses), len(poses) * step**3)


def step_for(robot: Robot, rotation: float, points: int) -> float:
    """The grid step, m, at which the cloud has about this many points."""
    low, high = bounding_box(robot, rotation)
    coarse = float(np.max(high - low)) / 16
    return coarse * (max(len(cloud(robot, rotation, coarse).points), 1) / points) ** (1 / 3)


def boundary(robot: Robot, rotation: float = 0.0, rings: int = 64, segments: int = 96) -> Surface:
    """The surface seen from inside: along each direction of a sphere, bisection finds where reach ends."""
    centre = _centre(robot, rotation)
    directions, faces = _sphere(rings, segments)
    low, high = np.zeros(len(directions)), np.full(len(directions), 2.0)
    high = _first_exit(robot, centre, directions, high)
    for _ in range(24):
        middle = 0.5 * (low + high)
        inside = robot.reachable(_along(centre, directions, middle))
        low, high = np.where(inside, middle, low), np.where(inside, high, middle)
    poses = _along(centre, directions, low)
    conditioning = robot.conditioning(_along(centre, directions, 0.999 * low))
    return Surface(poses[:, :3], faces, conditioning)


def _centre(robot: Robot, rotation: float) -> Array:
    """A pose well inside: half-way between the ends of reach along each axis through home, z first."""
    centre = robot.nearest([*robot.home[:3], rotation][: robot.dof])
    for axis in (2, 1, 0):
        line = np.repeat(centre[None], 401, axis=0)
        line[:, axis] += np.linspace(-1.0, 1.0, len(line))
        inside = robot.reachable(line)
        first, last = 200 - np.argmin(inside[200::-1]) + 1, 200 + np.argmin(inside[200:]) - 1
        centre = 0.5 * (line[first] + line[last])
    return centre


def _along(centre: Array, directions: Array, distance: Array) -> Array:
    poses = np.repeat(centre[None], len(directions), axis=0)
    poses[:, :3] += directions * distance[:, None]
    return poses


def _first_exit(robot: Robot, centre: Array, directions: Array, far: Array) -> Array:
    """A distance just beyond the first exit in each direction, found by coarse steps of 2 cm."""
    exit_distance = far.copy()
    open_ = np.ones(len(far), dtype=bool)
    for distance in np.arange(0.02, float(far.max()), 0.02):
        rows = np.flatnonzero(open_)
        if not rows.size:
            break
        inside = robot.reachable(_along(centre, directions[rows], np.full(len(rows), distance)))
        exit_distance[rows[~inside]] = distance
        open_[rows[~inside]] = False
    return exit_distance


def _sphere(rings: int, segments: int) -> tuple[Array, NDArray[np.int64]]:
    """Unit directions and faces of a sphere of latitude rings, poles included once each."""
    latitude = np.linspace(-np.pi / 2, np.pi / 2, rings + 1)[1:-1]
    longitude = np.linspace(0.0, 2 * np.pi, segments, endpoint=False)
    lat, lon = (a.ravel() for a in np.meshgrid(latitude, longitude, indexing="ij"))
    ring = np.column_stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])
    directions = np.vstack([ring, [[0.0, 0.0, -1.0]], [[0.0, 0.0, 1.0]]])
    index = np.arange(len(lat)).reshape(len(latitude), segments)
    following = np.roll(index, -1, axis=1)
    a, b, c, d = (g.ravel() for g in (index[:-1], following[:-1], index[1:], following[1:]))
    south, north = np.full(segments, len(lat)), np.full(segments, len(lat) + 1)
    faces = [
        np.column_stack([a, b, d]),
        np.column_stack([a, d, c]),
        np.column_stack([following[0], index[0], south]),
        np.column_stack([index[-1], following[-1], north]),
    ]
    return directions, np.vstack(faces)
