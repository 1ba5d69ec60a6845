"""What every robot can do, whatever its legs look like."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.robots.geometry import Geometry, GeometryError
from app.robots.nearest import Boundary, last_feasible, nearest_feasible
from app.robots.reach import NOT_A_NUMBER, Reach

if TYPE_CHECKING:
    from app.robots.dynamics import Dynamics

Array = NDArray[np.float64]

CHUNK = 8192
"""Poses solved at a time: the temporaries of one chunk stay in the processor's cache."""

EFFORT_UNITS = {"rad": "N m", "m": "N"}
"""What drives a joint, by the joint's unit."""

LIMIT_TOLERANCE = 1e-9
"""A joint this little beyond its limit still counts as standing on it (rad or m)."""


class Skeleton(NamedTuple):
    """The joint centres of one configuration, in the base frame, metres; one row a leg."""

    base: Array
    """(legs, 3) motor axes, or the carriage joints of a linear robot at zero displacement."""
    elbow: Array
    """(legs, 3) ends of the driven links, where the rods begin."""
    platform: Array
    """(legs, 3) where the rods end."""
    hinge: Array
    """(legs, 3) unit vectors along which the two rods of a leg lie side by side."""


class Assembly(NamedTuple):
    """One way of closing the loops for a given set of joints."""

    pose: Array
    """(dof,)"""
    valid: bool
    """Whether this is the assembly that the real machine is in."""


class Robot(ABC):
    """A parallel robot with fixed geometry. Poses and joints in metres and radians, base frame with z up."""

    name: ClassVar[str]
    title: ClassVar[str]
    pose_names: ClassVar[tuple[str, ...]]
    joint_names: ClassVar[tuple[str, ...]]
    joint_unit: ClassVar[str]
    """`rad` or `m`."""

    geometry: Geometry
    home: Array
    """(dof,) a comfortable pose to start from."""

    def __init__(self, geometry: Geometry) -> None:
        self.geometry = geometry
        self._bind()
        self.home = self._find_home()

    @property
    def dof(self) -> int:
        return len(self.pose_names)

    @property
    def joint_limits(self) -> Array:
        """(n, 2) lowest and highest value of each joint, rad or m."""
        return np.array(self._limits)

    @property
    def joint_units(self) -> tuple[str, ...]:
        return (self.joint_unit,) * len(self.joint_names)

    @property
    def legs(self) -> int:
        """Number of legs, which may be less than the joints."""
        return max(leg or 0 for leg in map(self._leg_number, range(len(self.joint_names))))

    @property
    def rotation_name(self) -> str | None:
        """Name of the rotation about z, for a robot that has one."""
        return self.pose_names[3] if self.dof == 4 else None

    @property
    def rotation_limit(self) -> float:
        """Largest rotation about z to either side, rad; 0 for a robot that has none."""
        return 0.0

    def inverse(self, pose: ArrayLike) -> Array:
        """Joints of a pose, the branch that the real machine uses.

        Args:
            pose: (..., dof)
        Returns:
            (..., n); NaN for a leg whose loop cannot close. Joint limits are not applied.
        """
        poses = self._columns(pose, self.dof)
        joints = np.empty((poses.shape[0], len(self.joint_names)))
        for start in range(0, len(poses), CHUNK):
            rows = slice(start, start + CHUNK)
            for leg, values in enumerate(self._inverse_columns(*np.ascontiguousarray(poses[rows].T))):
                joints[rows, leg] = values
        return joints.reshape(*np.shape(pose)[:-1], len(self.joint_names))

    @abstractmethod
    def forward(self, joints: ArrayLike) -> Array:
        """Pose of a set of joints in the assembly that the real machine is in.

        Args:
            joints: (..., n)
        Returns:
            (..., dof); NaN rows where there is no valid assembly.
        """

    @abstractmethod
    def assemblies(self, joints: ArrayLike) -> list[Assembly]:
        """Every real way of closing the loops for one set of joints (n,), the valid one marked."""

    @abstractmethod
    def working_modes(self, pose: ArrayLike) -> Array:
        """(modes, n) every set of joints that holds one pose (dof,), the robot's own first; the others have
        elbows flipped. Rows that cannot close are left out."""

    @abstractmethod
    def jacobian(self, pose: ArrayLike) -> Array:
        """(..., n, dof) J with joint rates = J @ pose rates; NaN where the loop cannot close."""

    @abstractmethod
    def conditioning(self, pose: ArrayLike) -> Array:
        """(...,) dimensionless condition number of the scaled Jacobian, 1 at best, inf at a singularity."""

    @abstractmethod
    def skeleton(self, pose: Sequence[float], joints: Sequence[float]) -> Skeleton:
        """Joint centres of one configuration; the loops close where `joints` belongs to `pose`."""

    @abstractmethod
    def solve(self, *pose: float) -> tuple[float, ...]:
        """`inverse` of one pose in plain floats: a drag event or a control step costs microseconds."""

    @cached_property
    def dynamics(self) -> Dynamics:
        """Equations of motion with the robot's declared masses."""
        from app.robots.dynamics import dynamics_of  # it builds on this module

        return dynamics_of(self)

    def inverse_dynamics(self, pose: ArrayLike, rate: ArrayLike, acceleration: ArrayLike) -> Array:
        """(..., n) joint torques (N m) or forces (N) of a motion of the pose, each (..., dof); NaN out of reach."""
        return self.dynamics.inverse(pose, rate, acceleration)

    def reachable(self, pose: ArrayLike) -> NDArray[np.bool_]:
        """(...,) whether each pose of (..., dof) lies inside reach and every limit."""
        poses = np.asarray(pose, dtype=float)
        joints = self.inverse(poses)
        low, high = self.joint_limits.T
        with np.errstate(invalid="ignore"):
            inside = (joints >= low - LIMIT_TOLERANCE) & (joints <= high + LIMIT_TOLERANCE)
        return inside.all(axis=-1) & self._admissible(poses, joints)

    def reach(self, pose: Sequence[float] | Array) -> Reach:
        """Verdict on one pose (dof,), with the limit that stops it."""
        values = [float(value) for value in pose]
        if not all(abs(value) < np.inf for value in values):
            return NOT_A_NUMBER
        joints = self.solve(*values)
        if any(q != q for q in joints):
            return self._open_loop(values, joints)
        worst, excess = -1, LIMIT_TOLERANCE
        for leg, (q, (low, high)) in enumerate(zip(joints, self._limits, strict=True)):
            if max(low - q, q - high) > excess:
                worst, excess = leg, max(low - q, q - high)
        if worst >= 0:
            return Reach(False, self._limit_reason(worst, joints[worst]), self._leg_number(worst), joints)
        return self._pose_limit(values, joints) or Reach(True, joints=joints)

    def nearest_stop(self, joints: Sequence[float]) -> tuple[int, float]:
        """The joint (from 0) with the least room to its stops, and that room in its unit, at least 0."""
        rooms = [min(q - low, high - q) for q, (low, high) in zip(joints, self._limits, strict=True)]
        joint = min(range(len(rooms)), key=rooms.__getitem__)
        return joint, max(rooms[joint], 0.0)

    def nearest(self, pose: ArrayLike, seed: Sequence[float] | Array | None = None) -> Array:
        """The closest pose inside reach and limits.

        A rotation is brought inside its own limits and then kept: a robot that is pulled out of reach slides
        along its boundary and does not twist.

        Args:
            pose: (..., dof) any poses; a pose that is not finite gives home.
            seed: (dof,) a reachable pose to slide from, such as the last answer during a drag. It keeps the
                answer on the same side where two are equally near.
        """
        poses = np.asarray(pose, dtype=float)
        rows = [self._nearest_one(row.tolist(), seed) for row in self._columns(poses, self.dof)]
        return np.array(rows).reshape(poses.shape)

    def _nearest_one(self, pose: list[float], seed: Sequence[float] | Array | None) -> list[float]:
        if self.reach(pose).ok:
            return pose
        home = self.home.tolist()
        if not all(abs(value) < np.inf for value in pose):
            return home
        turn = self._rotation_inside_limits(pose[3:])
        starts = [[*map(float, point[:3]), *turn] for point in (seed, home) if point is not None]
        inside = next((start for start in starts if self.reach(start).ok), None)
        if inside is None:
            return last_feasible(home, [*pose[:3], *turn], lambda point: self.reach(point).ok, precision=1e-7)
        position = nearest_feasible(
            pose[:3],
            inside[:3],
            lambda point: self._boundaries([*point, *turn]),
            lambda point: self.reach([*point, *turn]).ok,
        )
        return [*position, *turn]

    def _rotation_inside_limits(self, turn: list[float]) -> list[float]:
        """The rotation of a pose (empty for a robot without one), clipped to its range."""
        return [min(max(angle, -self.rotation_limit), self.rotation_limit) for angle in turn]

    def _columns(self, values: ArrayLike, width: int) -> Array:
        array = np.asarray(values, dtype=float)
        if array.ndim == 0 or array.shape[-1] != width:
            raise ValueError(f"{type(self).__name__} expects arrays of shape (..., {width}), not {array.shape}.")
        return array.reshape(-1, width)

    def _find_home(self) -> Array:
        home = np.array(self._default_home())
        if self.reach(home).ok:
            return home
        lowest = -2.0 * float(sum(abs(getattr(self.geometry, name)) for name in self.geometry.dimensions()))
        axis = np.repeat(home[None], 2000, axis=0)
        axis[:, 2] = np.linspace(0.0, lowest, len(axis))
        heights = axis[self.reachable(axis), 2]
        if not heights.size:
            raise GeometryError(f"With these dimensions the {self.title} cannot reach any pose; lengthen its rods.")
        home[2] = heights[len(heights) // 2]
        return home

    def _leg_number(self, joint: int) -> int | None:
        """Number of the leg that a joint belongs to."""
        return joint + 1

    @abstractmethod
    def _bind(self) -> None:
        """Take the constants of the formulas and `_limits` from the geometry."""

    _limits: tuple[tuple[float, float], ...]

    @abstractmethod
    def _default_home(self) -> tuple[float, ...]: ...

    @abstractmethod
    def _inverse_columns(self, *pose: Array) -> Sequence[Array]:
        """Elementwise inverse: one array a pose component in, one array a joint out."""

    @abstractmethod
    def _admissible(self, pose: Array, joints: Array) -> NDArray[np.bool_]:
        """(...,) limits beside those of the joints."""

    @abstractmethod
    def _open_loop(self, pose: list[float], joints: tuple[float, ...]) -> Reach:
        """Verdict for a pose at which some loop cannot close."""

    @abstractmethod
    def _limit_reason(self, joint: int, value: float) -> str: ...

    @abstractmethod
    def _pose_limit(self, pose: list[float], joints: tuple[float, ...]) -> Reach | None:
        """Verdict for limits beside those of the joints; None where all hold."""

    @abstractmethod
    def _boundaries(self, pose: list[float]) -> list[Boundary]:
        """The limits on the position (x, y, z) around one pose, its rotation held. They are defined everywhere
        and gradients are with respect to the position."""


def condition_number(scaled: Array) -> Array:
    """(...,) condition number of dimensionless Jacobians (..., n, n); inf where one is singular or NaN."""
    good = np.asarray(np.isfinite(scaled).all(axis=(-1, -2)))
    safe = np.where(good[..., None, None], scaled, np.eye(scaled.shape[-1]))
    return np.where(good, np.linalg.cond(safe), np.inf)
