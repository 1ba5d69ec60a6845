"""The equations of motion at one state.

    M(p) a + n(p, v) = J^T f        a pose acceleration, f joint efforts, joint rates = J v

n is what is left at a = 0: Coriolis and centrifugal forces, and gravity g. The joints accelerate by J a + h with
h = Jdot v. Everything here is a tuple of plain floats (one state) or of columns (many), in SI units.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

from app.robots.dynamics.elementwise import Value, Values, dual3, solve_symmetric3


class Terms(ABC):
    """One robot's M, n, J and h at one state (pose, rate); what they say about motion and effort.

    A subclass knows the shape of its matrices and writes the products out.
    """

    __slots__ = ("bias_force", "gravity_force", "joint_bias", "joint_rates", "joints", "pose", "rate")

    pose: Values
    rate: Values
    joints: Values
    joint_rates: Values
    bias_force: Values
    """n along the pose coordinates: N, and N m for a rotation."""
    gravity_force: Values
    """Its part g that is left at rest."""
    joint_bias: Values
    """h: joint accelerations at a = 0."""

    @abstractmethod
    def acceleration(self, effort: Sequence[Value]) -> Values:
        """Forward dynamics: pose acceleration M^-1 (J^T f - n) under joint efforts f (N m or N)."""

    @abstractmethod
    def effort(self, pose_acceleration: Sequence[Value]) -> Values:
        """Inverse dynamics: J^-T (M a + n), N m or N."""

    @abstractmethod
    def inertial(self, pose_acceleration: Sequence[Value]) -> Values:
        """J^-T M a: the efforts that accelerate the masses."""

    @abstractmethod
    def mass_times(self, a: Sequence[Value]) -> Values:
        """M a along the pose coordinates."""

    @abstractmethod
    def to_effort(self, force: Sequence[Value]) -> Values:
        """J^-T F: joint efforts that hold a force along the pose coordinates."""

    @abstractmethod
    def to_joints(self, rate: Sequence[Value]) -> Values:
        """J v"""

    @abstractmethod
    def to_pose(self, joint_rate: Sequence[Value]) -> Values:
        """J^-1 of joint rates."""

    def bias(self) -> Values:
        """J^-T n: efforts at no pose acceleration."""
        return self.to_effort(self.bias_force)

    def gravity(self) -> Values:
        """J^-T g: efforts that hold the robot at rest."""
        return self.to_effort(self.gravity_force)

    def pose_acceleration(self, joint_acceleration: Sequence[Value]) -> Values:
        """J^-1 (qdd - h)"""
        return self.to_pose([q - h for q, h in zip(joint_acceleration, self.joint_bias, strict=True)])

    def joint_acceleration(self, pose_acceleration: Sequence[Value]) -> Values:
        """J a + h"""
        return tuple([q + h for q, h in zip(self.to_joints(pose_acceleration), self.joint_bias, strict=True)])


class ThreeLegTerms(Terms):
    """Of a delta whose platform only translates: 3 x 3 matrices."""

    __slots__ = ("_dual", "mass", "rows")

    def __init__(
        self,
        pose: Values,
        rate: Values,
        joints: Values,
        joint_rates: Values,
        rows: Values,
        joint_bias: Values,
        mass: Values,
        bias_force: Values,
        gravity_force: Values,
    ) -> None:
        self.pose, self.rate, self.joints, self.joint_rates = pose, rate, joints, joint_rates
        self.rows, self.joint_bias = rows, joint_bias
        self.mass, self.bias_force, self.gravity_force = mass, bias_force, gravity_force
        self._dual: Values | None = None

    @property
    def dual(self) -> Values:
        """J^-1, column by column."""
        if self._dual is None:
            self._dual = dual3(self.rows)
        return self._dual

    def acceleration(self, effort: Sequence[Value]) -> Values:
        f1, f2, f3 = effort
        ax, ay, az, bx, by, bz, cx, cy, cz = self.rows
        nx, ny, nz = self.bias_force
        return solve_symmetric3(
            self.mass,
            ax * f1 + bx * f2 + cx * f3 - nx,
            ay * f1 + by * f2 + cy * f3 - ny,
            az * f1 + bz * f2 + cz * f3 - nz,
        )

    def effort(self, pose_acceleration: Sequence[Value]) -> Values:
        x, y, z = self.mass_times(pose_acceleration)
        nx, ny, nz = self.bias_force
        return self.to_effort((x + nx, y + ny, z + nz))

    def inertial(self, pose_acceleration: Sequence[Value]) -> Values:
        return self.to_effort(self.mass_times(pose_acceleration))

    def mass_times(self, a: Sequence[Value]) -> Values:
        x, y, z = a
        xx, xy, xz, yy, yz, zz = self.mass
        return xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z

    def to_effort(self, force: Sequence[Value]) -> Values:
        x, y, z = force
        ax, ay, az, bx, by, bz, cx, cy, cz = self.dual
        return ax * x + ay * y + az * z, bx * x + by * y + bz * z, cx * x + cy * y + cz * z

    def to_joints(self, rate: Sequence[Value]) -> Values:
        x, y, z = rate
        ax, ay, az, bx, by, bz, cx, cy, cz = self.rows
        return ax * x + ay * y + az * z, bx * x + by * y + bz * z, cx * x + cy * y + cz * z

    def to_pose(self, joint_rate: Sequence[Value]) -> Values:
        f1, f2, f3 = joint_rate
        ax, ay, az, bx, by, bz, cx, cy, cz = self.dual
        return ax * f1 + bx * f2 + cx * f3, ay * f1 + by * f2 + cy * f3, az * f1 + bz * f2 + cz * f3
