"""The Par4's equations of motion at one state: 4 x 4 matrices, two rows of J without theta."""

from __future__ import annotations

from collections.abc import Sequence

from app.robots.dynamics.elementwise import Value, Values, reciprocal
from app.robots.dynamics.terms import Terms


class Par4Terms(Terms):
    """Rows of J: (j_1, r_1), (j_2, r_2), (j_3, 0), (j_4, 0); legs 3 and 4 carry the bar of the tool point.

    With c = j_3 x j_4, whatever legs 3 and 4 do along c is nothing: that leaves two equations for legs 1 and 2.
    """

    __slots__ = ("_split", "mass", "rows", "turns")

    rows: Values
    """j_1 to j_4, twelve entries."""
    turns: Values
    """r_1 and r_2, the joints' change with theta."""
    mass: Values
    """xx, xy, xz, xt, yy, yz, yt, zz, zt, tt."""

    def __init__(self) -> None:
        self._split: Values | None = None

    def acceleration(self, effort: Sequence[Value]) -> Values:
        f1, f2, f3, f4 = effort
        ax, ay, az, bx, by, bz, cx, cy, cz, dx, dy, dz = self.rows
        r1, r2 = self.turns
        nx, ny, nz, nt = self.bias_force
        return self._mass_solve(
            ax * f1 + bx * f2 + cx * f3 + dx * f4 - nx,
            ay * f1 + by * f2 + cy * f3 + dy * f4 - ny,
            az * f1 + bz * f2 + cz * f3 + dz * f4 - nz,
            r1 * f1 + r2 * f2 - nt,
        )

    def effort(self, pose_acceleration: Sequence[Value]) -> Values:
        x, y, z, t = self.mass_times(pose_acceleration)
        nx, ny, nz, nt = self.bias_force
        return self.to_effort((x + nx, y + ny, z + nz, t + nt))

    def inertial(self, pose_acceleration: Sequence[Value]) -> Values:
        return self.to_effort(self.mass_times(pose_acceleration))

    def mass_times(self, a: Sequence[Value]) -> Values:
        x, y, z, t = a
        xx, xy, xz, xt, yy, yz, yt, zz, zt, tt = self.mass
        return (
            xx * x + xy * y + xz * z + xt * t,
            xy * x + yy * y + yz * z + yt * t,
            xz * x + yz * y + zz * z + zt * t,
            xt * x + yt * y + zt * z + tt * t,
        )

    def to_joints(self, rate: Sequence[Value]) -> Values:
        x, y, z, t = rate
        ax, ay, az, bx, by, bz, cx, cy, cz, dx, dy, dz = self.rows
        r1, r2 = self.turns
        return (
            ax * x + ay * y + az * z + r1 * t,
            bx * x + by * y + bz * z + r2 * t,
            cx * x + cy * y + cz * z,
            dx * x + dy * y + dz * z,
        )

    def to_effort(self, force: Sequence[Value]) -> Values:
        x, y, z, t = force
        ax, ay, az, bx, by, bz, *_ = self.rows
        r1, r2 = self.turns
        nx, ny, nz, p3x, p3y, p3z, p4x, p4y, p4z, a_n, b_n, k = self.split
        along = x * nx + y * ny + z * nz
        f1, f2 = (along * r2 - b_n * t) * k, (a_n * t - along * r1) * k
        x, y, z = x - ax * f1 - bx * f2, y - ay * f1 - by * f2, z - az * f1 - bz * f2
        return f1, f2, p3x * x + p3y * y + p3z * z, p4x * x + p4y * y + p4z * z

    def to_pose(self, joint_rate: Sequence[Value]) -> Values:
        q1, q2, q3, q4 = joint_rate
        ax, ay, az, bx, by, bz, *_ = self.rows
        r1, r2 = self.turns
        nx, ny, nz, p3x, p3y, p3z, p4x, p4y, p4z, a_n, b_n, k = self.split
        x, y, z = p3x * q3 + p4x * q4, p3y * q3 + p4y * q4, p3z * q3 + p4z * q4
        q1, q2 = q1 - ax * x - ay * y - az * z, q2 - bx * x - by * y - bz * z
        along, t = (q1 * r2 - q2 * r1) * k, (a_n * q2 - b_n * q1) * k
        return x + along * nx, y + along * ny, z + along * nz, t

    @property
    def split(self) -> Values:
        """c = j_3 x j_4; p_3 and p_4 in the plane of j_3 and j_4 with p_i . j_k = 1 where i = k, else 0; j_1 . c,
        j_2 . c and 1 / (j_1 . c r_2 - j_2 . c r_1)."""
        if self._split is None:
            ax, ay, az, bx, by, bz, cx, cy, cz, dx, dy, dz = self.rows
            r1, r2 = self.turns
            nx, ny, nz = cy * dz - cz * dy, cz * dx - cx * dz, cx * dy - cy * dx
            k = reciprocal(nx * nx + ny * ny + nz * nz)
            a_n, b_n = ax * nx + ay * ny + az * nz, bx * nx + by * ny + bz * nz
            px, py, pz = (dy * nz - dz * ny) * k, (dz * nx - dx * nz) * k, (dx * ny - dy * nx) * k
            qx, qy, qz = (ny * cz - nz * cy) * k, (nz * cx - nx * cz) * k, (nx * cy - ny * cx) * k
            self._split = nx, ny, nz, px, py, pz, qx, qy, qz, a_n, b_n, reciprocal(a_n * r2 - b_n * r1)
        return self._split

    def _mass_solve(self, x: Value, y: Value, z: Value, t: Value) -> Values:
        """M^-1 F by L D L^T, written out."""
        xx, xy, xz, xt, yy, yz, yt, zz, zt, tt = self.mass
        k = 1.0 / xx
        ly, lz, lt = xy * k, xz * k, xt * k
        yy, yz, yt = yy - ly * xy, yz - ly * xz, yt - ly * xt
        y, z, t = y - ly * x, z - lz * x, t - lt * x
        ky = 1.0 / yy
        mz, mt = yz * ky, yt * ky
        zz, zt = zz - lz * xz - mz * yz, zt - lz * xt - mz * yt
        z, t = z - mz * y, t - mt * y
        kz = 1.0 / zz
        nt = zt * kz
        t = (t - nt * z) / (tt - lt * xt - mt * yt - nt * zt)
        z = z * kz - nt * t
        y = y * ky - mz * z - mt * t
        return x * k - ly * y - lz * z - lt * t, y, z, t
