"""A map as a picture with its limit line: made in a worker. Nothing here may import viser."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.robots import GeometryError, build_robot
from app.robots.maps import MAPS, MapSettings, WorkspaceMap, compute_map
from app.robots.slices import coverage
from app.ui import theme
from app.ui.refusal import Refusal

Array = NDArray[np.float64]

SPACING_M = 0.004
RARE = 2.0
"""Percent of the slice that may lie beyond either end of the colour scale: near a singularity values know no bounds."""
OPACITY = 225
STRIPE_M = 0.024
"""From stripe to stripe along x and y, where a drive is over its limit."""


class MapPicture(NamedTuple):
    """A map and how it is drawn."""

    map: WorkspaceMap
    rgba: NDArray[np.uint8]
    """(r, c, 4) one pixel a point of the map, clear out of reach"""
    low: float
    """Value at the dark or bright end of the colour scale."""
    high: float
    limit_line: NDArray[np.float32]
    """(k, 2, 2) x and y of the ends of the line where a drive reaches its limit, m"""


def map_picture(settings: MapSettings) -> MapPicture | Refusal:
    """The map of a slice, coloured."""
    try:
        found = compute_map(settings, SPACING_M)
    except GeometryError as error:
        return Refusal(str(error))
    if np.isnan(found.values).all():
        return Refusal("At this height nothing is in reach: move the slice.")
    low, high = color_range(found.values)
    levels = [] if found.level is None else [found.level, -found.level]
    lines = [level_line(found.x, found.y, found.values, level) for level in levels]
    line = np.concatenate([np.empty((0, 2, 2)), *lines]).astype(np.float32)
    return MapPicture(found, _paint(found, low, high), low, high, line)


def color_range(values: Array) -> tuple[float, float]:
    """Values at both ends of the colour scale, never the same."""
    low, high = np.nanpercentile(values, (RARE, 100.0 - RARE))
    room = 0.0 if high - low > 1e-9 * max(abs(high), 1.0) else 0.05 * max(abs(low), 1.0)
    return float(low - room), float(high + room)


def brightness(values: Array, low: float, high: float, quantity: str) -> Array:
    """Values as 0 (dark) to 1 (bright); bright is good."""
    share = (values - low) / (high - low)
    return np.clip(share if MAPS[quantity].more_is_better else 1.0 - share, 0.0, 1.0)


def _paint(found: WorkspaceMap, low: float, high: float) -> NDArray[np.uint8]:
    """(r, c, 4): the page blends neighbouring pixels, so colours go on a little beyond the edge."""
    robot = build_robot(found.settings.robot, found.settings.dimensions)
    filled = _grown(_grown(found.values))
    colors = theme.ramp(brightness(np.nan_to_num(filled, nan=low), low, high, found.settings.quantity))
    waves = np.cos(2.0 * np.pi / STRIPE_M * (found.x[None, :] + found.y[:, None]))
    stripes = np.clip(0.5 + 2.0 * waves, 0.0, 1.0) * found.beyond
    mixed = colors + stripes[..., None] * (np.array(theme.MARK) - colors)
    alpha = OPACITY * coverage(robot, found.x, found.y, found.settings.height_m, found.settings.rotation_rad)
    return np.rint(np.dstack([mixed, alpha])).astype(np.uint8)


def _grown(values: Array) -> Array:
    """The values, carried on to the points next to them that have none."""
    filled = np.pad(values, 1, constant_values=np.nan)
    for axis in (0, 1):
        for step in (-1, 1):
            filled = np.where(np.isnan(filled), np.roll(filled, step, axis), filled)
    return filled[1:-1, 1:-1]


def level_line(x: Array, y: Array, values: Array, level: float) -> Array:
    """(k, 2, 2) pieces of the line on which values (r, c) over x (c,) and y (r,) equal a level.

    Every cell of the grid is two triangles, in each of which the value is linear; cells with a NaN have no line.
    """
    above = values - level
    xs, ys = np.broadcast_arrays(x[None, :], y[:, None])
    points = np.stack([xs, ys, above], axis=-1)
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]
    triangles = np.concatenate([np.stack(corners, axis=2).reshape(-1, 3, 3) for corners in ((a, b, c), (a, c, d))])
    higher = triangles[..., 2] > 0.0
    crossed = np.isfinite(triangles[..., 2]).all(axis=1) & higher.any(axis=1) & ~higher.all(axis=1)
    triangles, higher = triangles[crossed], higher[crossed]
    # the corner that is alone on its side of the level, then the other two
    alone = np.where(higher.sum(axis=1) == 1, higher.argmax(axis=1), higher.argmin(axis=1))
    pick = (alone[:, None] + np.arange(3)) % 3
    apex, one, two = np.moveaxis(np.take_along_axis(triangles, pick[..., None], axis=1), 1, 0)
    return np.stack([_crossing(apex, one), _crossing(apex, two)], axis=1)


def _crossing(start: Array, end: Array) -> Array:
    """(k, 2) where the third coordinate of lines from (k, 3) to (k, 3) is zero."""
    share = start[:, 2] / (start[:, 2] - end[:, 2])
    return start[:, :2] + share[:, None] * (end[:, :2] - start[:, :2])
