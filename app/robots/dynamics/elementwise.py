"""Arithmetic that is the same for plain floats and, elementwise, for NumPy columns.

A formula is written once. On floats it costs what a few multiplications cost, on columns what NumPy does best.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Value = Any
"""A float or a column of floats: the type checkers know no name for what both can do."""
Values = tuple[Value, ...]


class Functions(NamedTuple):
    """The functions that floats and columns do not share by an operator."""

    sqrt: Callable[[Value], Value]
    sin: Callable[[Value], Value]
    cos: Callable[[Value], Value]
    atan2: Callable[[Value, Value], Value]


FLOATS = Functions(math.sqrt, math.sin, math.cos, math.atan2)
COLUMNS = Functions(np.sqrt, np.sin, np.cos, np.arctan2)


def stacked(values: Iterable[Value], shape: tuple[int, ...] = ()) -> NDArray[np.float64]:
    """(..., n) of n values side by side, columns or single numbers, which are repeated to `shape` at least."""
    return np.stack(np.broadcast_arrays(*values, np.empty(shape))[:-1], axis=-1)


def reciprocal(value: Value) -> Value:
    """1 / value; NaN for the float 0, which has no inf in Python."""
    try:
        return 1.0 / value
    except ZeroDivisionError:
        return math.nan


def dual3(rows: Values) -> Values:
    """Columns c_1, c_2, c_3 of the inverse of a 3 x 3 matrix given by its nine entries, row by row."""
    ax, ay, az, bx, by, bz, cx, cy, cz = rows
    px, py, pz = by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx
    k = reciprocal(ax * px + ay * py + az * pz)
    qx, qy, qz = (cy * az - cz * ay) * k, (cz * ax - cx * az) * k, (cx * ay - cy * ax) * k
    rx, ry, rz = (ay * bz - az * by) * k, (az * bx - ax * bz) * k, (ax * by - ay * bx) * k
    return px * k, py * k, pz * k, qx, qy, qz, rx, ry, rz


def solve_symmetric3(matrix: Values, x: Value, y: Value, z: Value) -> Values:
    """Solution of a symmetric system with the entries xx, xy, xz, yy, yz, zz."""
    xx, xy, xz, yy, yz, zz = matrix
    a, b, c = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
    d, e, f = xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy
    k = reciprocal(xx * a + xy * b + xz * c)
    return (a * x + b * y + c * z) * k, (b * x + d * y + e * z) * k, (c * x + e * y + f * z) * k
