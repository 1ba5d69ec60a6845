"""What a calibration looks for, what was assumed before, and what the assumed machine would measure.

    joints = reported + offsets,   tool = turn about z (forward(joints; dimensions)) + origin

The measuring frame (the ruler's) lies at `origin` and is turned against the robot's. How the pose p moves with the
offsets and dimensions follows from the inverse kinematics q(p; dimensions), whose loops are closed exactly:
dp = J^-1 (d offsets - dq/d dimensions), J = dq/dp.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.link.calibration.measurements import Measurements
from app.link.errors import LinkError
from app.robots import ROBOTS, GeometryError, Robot, build_robot

Array = NDArray[np.float64]
Kind = Literal["offset", "dimension", "frame"]

KINEMATIC: dict[str, tuple[str, ...]] = {
    "par4": ("R", "L", "l", "h", "d", "d_i", "h_i", "B_z", "P_z"),
    "delta3": ("f", "e", "rf", "re"),
    "linear": ("S_A", "W_A", "U_A", "s_p", "w_p", "u_b", "l"),
    "fivebar": ("l_f", "l_p", "l_d", "p"),
}
"""Dimensions on which the pose depends; the others are limits."""

TOLERANCES = {"offset rad": math.radians(3.0), "offset m": 3e-3, "dimension": 1e-3, "frame m": 20e-3}
TOLERANCES |= {"frame rad": math.radians(5.0), "p": 2e-5}
"""Standard deviations of what is assumed, rad or m; the screw's lead p is made finer than other parts."""

FRAME = (("frame x", "m"), ("frame y", "m"), ("frame z", "m"), ("frame turn", "rad"))
STEP_M = 1e-6
"""Of a dimension, for its influence on the inverse kinematics."""


@dataclass(frozen=True)
class Unknown:
    """One number that is looked for."""

    name: str
    """`offset q1`, a dimension's symbol, or `frame x`."""
    kind: Kind
    unit: str
    """`rad` or `m`."""
    assumed: float
    tolerance: float
    """Standard deviation of what is assumed, before any measurement."""
    low: float = -math.inf
    high: float = math.inf


@dataclass(frozen=True)
class Problem:
    """p unknowns of one robot."""

    robot: str
    unknowns: tuple[Unknown, ...]
    noise_m: float = 2e-4
    """Standard deviation of a measured coordinate."""
    angle_noise: float = math.radians(0.5)
    """Standard deviation of a measured angle, rad."""
    dimensions: dict[str, float] = field(default_factory=dict)
    """Those of the assumed robot that differ from the default."""

    @cached_property
    def assumed(self) -> Array:
        """(p,)"""
        return np.array([unknown.assumed for unknown in self.unknowns])

    @cached_property
    def tolerances(self) -> Array:
        """(p,)"""
        return np.array([unknown.tolerance for unknown in self.unknowns])

    def places(self, kind: Kind) -> list[int]:
        """Where the unknowns of a kind stand."""
        return [k for k, unknown in enumerate(self.unknowns) if unknown.kind == kind]

    def build(self, values: Array) -> Robot:
        """The robot with the dimensions of these values (p,)."""
        changed = {self.unknowns[k].name: float(values[k]) for k in self.places("dimension")}
        return build_robot(self.robot, {**self.dimensions, **changed})

    def poses(self, values: Array, joints: Array) -> Array:
        """(k, dof) in the robot's frame, of reported joints (k, n); NaN where they do not assemble."""
        return self.build(values).forward(joints + self.offsets(values))

    def predict(self, values: Array, joints: Array) -> Array:
        """(k, 4) x, y, z in m and the angle in rad (0 for a robot without) that would be measured."""
        pose = self.poses(values, joints)
        x, y, z, turn = self._frame(values)
        c, s = math.cos(turn), math.sin(turn)
        angle = pose[:, 3] + turn if pose.shape[1] == 4 else np.zeros(len(pose))
        rotated = c * pose[:, 0] - s * pose[:, 1], s * pose[:, 0] + c * pose[:, 1]
        return np.column_stack([rotated[0] + x, rotated[1] + y, pose[:, 2] + z, angle])

    def jacobian(self, values: Array, joints: Array) -> Array:
        """(k, 4, p) derivatives of `predict` with respect to the unknowns."""
        pose = self.poses(values, joints)
        robot, dof = self.build(values), pose.shape[1]
        to_pose = np.linalg.inv(robot.jacobian(pose))
        moved = np.zeros((len(pose), 4, len(self.unknowns)))
        offsets = self.places("offset")
        moved[:, :dof, offsets] = to_pose[:, :, [self._joint(k) for k in offsets]]
        for k in self.places("dimension"):
            moved[:, :dof, k] = -np.einsum("kij,kj->ki", to_pose, self._inverse_slope(values, k, pose))
        turn = self._frame(values)[3]
        c, s = math.cos(turn), math.sin(turn)
        moved[:, :2] = np.einsum("ij,kjp->kip", np.array([[c, -s], [s, c]]), moved[:, :2])
        for k in self.places("frame"):
            axis = [name for name, _ in FRAME].index(self.unknowns[k].name)
            moved[:, axis, k] = 1.0 if axis < 3 or dof == 4 else 0.0
            if axis == 3:
                moved[:, 0, k] = -s * pose[:, 0] - c * pose[:, 1]
                moved[:, 1, k] = c * pose[:, 0] - s * pose[:, 1]
        return moved

    def _inverse_slope(self, values: Array, place: int, pose: Array) -> Array:
        """(k, n) change of the joints with one dimension, the pose held."""
        unknown, ends = self.unknowns[place], []
        for side in (-STEP_M, STEP_M):
            moved = values.copy()
            moved[place] = min(max(values[place] + side, unknown.low), unknown.high)
            ends.append((moved[place], self.build(moved).inverse(pose)))
        (before, at_first), (after, at_last) = ends
        return (at_last - at_first) / (after - before)

    def _joint(self, place: int) -> int:
        return ROBOTS[self.robot].build.joint_names.index(self.unknowns[place].name.removeprefix("offset "))

    def offsets(self, values: Array) -> Array:
        """(n,) to be added to what the board reports."""
        offsets = np.zeros(len(ROBOTS[self.robot].build.joint_names))
        for k in self.places("offset"):
            offsets[self._joint(k)] = values[k]
        return offsets

    def _frame(self, values: Array) -> list[float]:
        """x, y, z and turn."""
        known = {unknown.name: float(value) for unknown, value in zip(self.unknowns, values, strict=True)}
        return [known.get(name, 0.0) for name, _ in FRAME]


def make_problem(
    robot: str,
    *,
    offsets: bool = True,
    dimensions: Sequence[str] = (),
    frame: Sequence[str] = (),
    nominal: Mapping[str, float] | None = None,
    tolerances: Mapping[str, float] | None = None,
    noise_m: float = 2e-4,
    angle_noise: float = math.radians(0.5),
) -> Problem:
    """A problem by names: dimensions by their symbols, `frame` by `frame x` ... `frame turn`.

    `nominal` are dimensions of the assumed robot, `tolerances` standard deviations (rad or m) by the unknown's name.

    Raises:
        LinkError: for unknown names, tolerances or noise of 0 or less, and when nothing is looked for.
    """
    given = dict(tolerances or {})
    unknowns = _unknowns(robot, offsets, dimensions, frame, nominal or {})
    _check_names(given, [unknown.name for unknown in unknowns], "unknown of this problem")
    if not unknowns:
        raise LinkError("Nothing is looked for; choose joint offsets, dimensions or the measuring frame.")
    if not (noise_m > 0.0 and angle_noise > 0.0 and all(value > 0.0 for value in given.values())):
        raise LinkError("Tolerances and the accuracy of the measurements must be above 0.")
    chosen = [replace(unknown, tolerance=given.get(unknown.name, unknown.tolerance)) for unknown in unknowns]
    return Problem(robot, tuple(chosen), noise_m, angle_noise, dict(nominal or {}))


def _unknowns(
    robot: str, offsets: bool, dimensions: Sequence[str], frame: Sequence[str], nominal: Mapping[str, float]
) -> list[Unknown]:
    """Offsets, dimensions, frame, with the usual tolerances."""
    kind, units = ROBOTS[robot].build, dict(FRAME)
    try:
        geometry = build_robot(robot, nominal).geometry
    except GeometryError as error:
        raise LinkError(str(error)) from None
    _check_names(dimensions, KINEMATIC[robot], "dimension to calibrate")
    _check_names(frame, units, "part of the measuring frame")
    unknowns = [
        Unknown(f"offset {name}", "offset", kind.joint_unit, 0.0, TOLERANCES[f"offset {kind.joint_unit}"])
        for name in (kind.joint_names if offsets else ())
    ]
    for name in dimensions:
        bounds, value = geometry.dimensions()[name], float(getattr(geometry, name))
        tolerance = TOLERANCES.get(name, TOLERANCES["dimension"])
        unknowns.append(Unknown(name, "dimension", bounds.unit, value, tolerance, bounds.low, bounds.high))
    return unknowns + [Unknown(name, "frame", units[name], 0.0, TOLERANCES[f"frame {units[name]}"]) for name in frame]


def observed(problem: Problem, data: Measurements) -> tuple[Array, Array]:
    """(k, 4) measured values and their standard deviations, inf where nothing was measured."""
    values = np.column_stack([data.tool_m, np.where(np.isnan(data.angle), 0.0, data.angle)])
    with_angle = np.isfinite(data.angle) & (len(ROBOTS[problem.robot].build.pose_names) == 4)
    noise = np.full_like(values, problem.noise_m)
    noise[:, 3] = np.where(with_angle, problem.angle_noise, np.inf)
    return values, noise


def _check_names(
    names: Sequence[str] | Mapping[str, float], known: Sequence[str] | Mapping[str, str], what: str
) -> None:
    for name in names:
        if name not in known:
            raise LinkError(f"{name!r} is no {what}; choose from {', '.join(known)}.")
