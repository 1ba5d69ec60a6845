"""Where three spheres of one radius meet, on plain floats."""

from __future__ import annotations

import math

Point = tuple[float, float, float]


def lower_point(first: Point, second: Point, third: Point, radius: float) -> Point:
    """The lower common point of the spheres; ValueError where they do not meet.

    From `first`: p = (|a|^2 b - |b|^2 a) x n / (2 |n|^2) -+ sqrt(r^2 - |.|^2) n / |n| with n = a x b.
    """
    ax, ay, az = second[0] - first[0], second[1] - first[1], second[2] - first[2]
    bx, by, bz = third[0] - first[0], third[1] - first[1], third[2] - first[2]
    nx, ny, nz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    n2 = nx * nx + ny * ny + nz * nz
    a2, b2 = ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz
    ux, uy, uz = a2 * bx - b2 * ax, a2 * by - b2 * ay, a2 * bz - b2 * az
    k = 0.5 / n2
    mx, my, mz = (uy * nz - uz * ny) * k, (uz * nx - ux * nz) * k, (ux * ny - uy * nx) * k
    down = math.copysign(math.sqrt((radius * radius - mx * mx - my * my - mz * mz) / n2), -nz)
    return first[0] + mx + down * nx, first[1] + my + down * ny, first[2] + mz + down * nz
