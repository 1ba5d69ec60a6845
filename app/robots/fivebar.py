"""fivebar: a planar five-bar (5R) with a ball-screw spline, x, y, z and a turn phi (Righettini et al. 2024).

Motors at (-+l_f / 2, 0) drive the proximal links l_p, and the distal links l_d meet in the tool's axis
P = (x, y). q_1, q_2 are absolute angles from +x, counter-clockwise. Two nuts turn and lift the screw:

    q_4 = phi,   q_3 = phi - 2 pi z / p                                                      (7)-(11), z up

The machine works with both elbows out and P on the left of the line from elbow 1 to elbow 2. It stays away
from its singularities by an angle: an arm stretched or folded (serial), both rods in line (parallel).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.robots.fivebar_limits import planar_limits
from app.robots.fivebar_linkage import OUTWARD, Linkage
from app.robots.geometry import Geometry, GeometryError, angle, length
from app.robots.nearest import Boundary
from app.robots.reach import Reach
from app.robots.robot import LIMIT_TOLERANCE, Array, Assembly, Robot, Skeleton, condition_number

WORKING_BOX = ((-0.165, 0.165), (0.262, 0.410))
"""x and y (metres) in which the default machine has torque and speed to spare: sines of at least 0.49 and a
condition number of at most 3.8. A rule for planners, not part of reach: outside it the machine still stands
safely, only its accelerations are not guaranteed."""

SCREW_SLACK = 1e-6
"""q_3 may exceed its range this little (rad), so that the verdict names the turn or the height, not both."""


@dataclass(frozen=True, kw_only=True)
class FiveBarGeometry(Geometry):
    """Dimensions of the paper's robot; the limits are those within which it is far from singular."""

    l_f: float = length(0.18, "Motor distance", 0.04, 0.60)
    """Distance between the two motor axes (l_f)."""
    l_p: float = length(0.25, "Proximal link", 0.10, 0.60)
    """Driven arm, motor axis to elbow (l_p)."""
    l_d: float = length(0.25, "Distal link", 0.10, 0.60)
    """Rod, elbow to the tool's axis (l_d)."""
    p: float = length(0.02, "Screw lead", 0.002, 0.10, essential=False)
    """Travel of the screw a turn (p)."""
    z_min: float = length(-0.10, "Lower end of the screw", -0.50, -0.005, essential=False)
    """Lowest height of the tool."""
    z_max: float = length(0.05, "Upper end of the screw", 0.005, 0.30, essential=False)
    """Greatest height of the tool."""
    q1_min: float = angle(math.radians(65.0), "Lowest angle of arm 1", 0.0, math.radians(110.0))
    """Limit of q_1 towards arm 2."""
    q1_max: float = angle(math.radians(170.0), "Highest angle of arm 1", math.radians(115.0), math.radians(220.0))
    """Limit of q_1 away from arm 2."""
    q2_min: float = angle(math.radians(10.0), "Lowest angle of arm 2", math.radians(-40.0), math.radians(65.0))
    """Limit of q_2 away from arm 1."""
    q2_max: float = angle(math.radians(115.0), "Highest angle of arm 2", math.radians(70.0), math.radians(180.0))
    """Limit of q_2 towards arm 1."""
    phi_max: float = angle(math.pi, "Largest turn of the tool", 0.1, 2 * math.pi)
    """Limit of phi to either side."""
    sigma_min: float = angle(math.asin(0.40), "Least angle from a singularity", 0.02, math.radians(60.0))
    """Between two links that would be in line at a singularity; 23.6 degrees keep the sines above 0.40."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if abs(self.l_p - self.l_d) > 0.5 * (self.l_p + self.l_d):
            raise GeometryError("The links differ too much: neither l_p nor l_d may exceed three times the other.")

    @property
    def sin_min(self) -> float:
        """Least sine of the three angles that vanish at a singularity."""
        return math.sin(self.sigma_min)


class FiveBar(Robot):
    """See the module; poses (x, y, z, phi), joints q_1, q_2 (arms) and q_3, q_4 (nuts) in radians."""

    name = "fivebar"
    title = "5R pick-and-place"
    pose_names = ("x", "y", "z", "phi")
    joint_names = ("q1", "q2", "q3", "q4")
    joint_unit = "rad"
    geometry: FiveBarGeometry

    def _bind(self) -> None:
        g = self.geometry
        self.linkage = Linkage((-g.l_f / 2, g.l_f / 2), g.l_p, g.l_d)
        self._turn = 2 * math.pi / g.p
        self._sin_min = g.sin_min
        highest, lowest = self._turn * g.z_max + SCREW_SLACK, self._turn * g.z_min - SCREW_SLACK
        self._limits = (
            (g.q1_min, g.q1_max),
            (g.q2_min, g.q2_max),
            (-g.phi_max - highest, g.phi_max - lowest),
            (-g.phi_max, g.phi_max),
        )

    @property
    def rotation_limit(self) -> float:
        return self.geometry.phi_max

    def _default_home(self) -> tuple[float, ...]:
        return (0.0, 0.336, 0.0, 0.0)

    def _find_home(self) -> Array:
        """The default home, or the middle of what is in reach straight ahead."""
        home = np.array(self._default_home())
        if self.reach(home).ok:
            return home
        ahead = np.repeat(home[None], 2000, axis=0)
        ahead[:, 1] = np.linspace(0.0, self.geometry.l_p + self.geometry.l_d, len(ahead))
        ahead = ahead[self.reachable(ahead)]
        if not len(ahead):
            raise GeometryError(f"With these dimensions the {self.title} cannot reach any pose; lengthen its rods.")
        return ahead[len(ahead) // 2]

    def _inverse_columns(self, *pose: Array) -> Sequence[Array]:
        x, y, z, phi = pose
        return [*self.linkage.arm_angles(x, y), phi - self._turn * z, phi]

    def solve(self, *pose: float) -> tuple[float, ...]:
        x, y, z, phi = pose
        arm = self.linkage.arm_angle
        return arm(0, x, y), arm(1, x, y), phi - self._turn * z, phi

    def working_modes(self, pose: ArrayLike) -> Array:
        """Each elbow out or in: up to four rows. Limits are not applied."""
        x, y, z, phi = np.asarray(pose, dtype=float)
        sides = product(*((side, -side) for side in OUTWARD))
        modes = np.array([[*self.linkage.arm_angles(x, y, way), phi - self._turn * z, phi] for way in sides])
        return modes[~np.isnan(modes).any(axis=-1)]

    def forward(self, joints: ArrayLike) -> Array:
        """P on the left of the line from elbow 1 to elbow 2, if both elbows are out as seen from there: the
        other assemblies lie beyond a singularity."""
        q = np.asarray(joints, dtype=float)
        self._columns(q, 4)
        pose = self._assembled(q, 1.0)
        return np.where(self._elbows_out(pose, q)[..., None], pose, np.nan)

    def assemblies(self, joints: ArrayLike) -> list[Assembly]:
        q = np.asarray(joints, dtype=float)
        left, right = self._assembled(q, 1.0), self._assembled(q, -1.0)
        if np.isnan(left).any():
            return []
        return [Assembly(left, bool(self._elbows_out(left, q))), Assembly(right, False)]

    def _assembled(self, q: Array, side: float) -> Array:
        plane = self.linkage.tool(q[..., :2], side)
        z, phi = (q[..., 3:] - q[..., 2:3]) / self._turn, q[..., 3:]
        return np.where(np.isnan(plane[..., :1]), np.nan, np.concatenate([plane, z, phi], axis=-1))

    def _elbows_out(self, pose: Array, q: Array) -> NDArray[np.bool_]:
        first, second, _ = self._sines(pose, q)
        return (first >= -LIMIT_TOLERANCE) & (second >= -LIMIT_TOLERANCE)

    def jacobian(self, pose: ArrayLike) -> Array:
        """Inverse of block(D_5R, D_bss)."""
        poses = np.asarray(pose, dtype=float)
        J = np.zeros((*poses.shape, 4))
        J[..., :2, :2] = self.linkage.rates(poses[..., 0], poses[..., 1], self.inverse(poses)[..., :2])
        J[..., 2, 2], J[..., 2:, 3] = -self._turn, 1.0
        return J

    def conditioning(self, pose: ArrayLike) -> Array:
        """Condition number of D_5R, the linkage in its plane; screw and spline are the same everywhere."""
        return condition_number(self.jacobian(pose)[..., :2, :2])

    def singularity_sines(self, pose: ArrayLike) -> Array:
        """(..., 3) sines of the angles between arm and rod of leg 1, of leg 2, and between both rods: 1 at
        best, 0 at a singularity (serial, serial, parallel), negative beyond it, NaN where a loop is open."""
        poses = np.asarray(pose, dtype=float)
        return np.stack(self._sines(poses, self.inverse(poses)), axis=-1)

    def _sines(self, pose: Array, joints: Array) -> tuple[Array, Array, Array]:
        return self.linkage.sines(np, pose[..., 0], pose[..., 1], joints[..., 0], joints[..., 1])

    def skeleton(self, pose: Sequence[float], joints: Sequence[float]) -> Skeleton:
        """The linkage, which lies in the plane z = 0; the spline hangs from its last joint."""
        base = np.column_stack([self.linkage.motors, np.zeros((2, 2))])
        elbows = self.linkage.elbows(np.asarray(joints, dtype=float)[:2])
        platform, hinge = np.array([[pose[0], pose[1], 0.0]] * 2), np.array([[0.0, 0.0, 1.0]] * 2)
        return Skeleton(base, np.column_stack([elbows, np.zeros(2)]), platform, hinge)

    def _leg_number(self, joint: int) -> int | None:
        return joint + 1 if joint < 2 else None

    def _admissible(self, pose: Array, joints: Array) -> NDArray[np.bool_]:
        g, z = self.geometry, pose[..., 2]
        safe = [sine >= self._sin_min - LIMIT_TOLERANCE for sine in self._sines(pose, joints)]
        lifted = (z >= g.z_min - LIMIT_TOLERANCE) & (z <= g.z_max + LIMIT_TOLERANCE)
        return np.logical_and.reduce([lifted, *safe])

    def _open_loop(self, pose: list[float], joints: tuple[float, ...]) -> Reach:
        gaps = [self.linkage.gap(leg, pose[0], pose[1]) for leg in (0, 1)]
        leg = max((0, 1), key=lambda k: abs(gaps[k]))
        size = f"{abs(gaps[leg]) * 1e3:.0f}" if abs(gaps[leg]) >= 5e-4 else "less than 1"
        if gaps[leg] < 0.0:
            return Reach(False, f"Too close: leg {leg + 1} is {size} mm too long.", leg + 1)
        return Reach(False, f"Out of reach: leg {leg + 1} is {size} mm too short.", leg + 1)

    def _limit_reason(self, joint: int, value: float) -> str:
        low, high = self._limits[joint]
        if joint == 3:
            return f"The tool turns at most {math.degrees(high):.0f} degrees to either side."
        if joint == 2:
            return self._screw_reason(lower=value > high)
        return f"Leg {joint + 1}: motor arm at {math.degrees(high if value > high else low):+.0f} degrees."

    def _screw_reason(self, *, lower: bool) -> str:
        end, height = ("lower", self.geometry.z_min) if lower else ("upper", self.geometry.z_max)
        return f"The screw is at its {end} end ({height * 1e3:.0f} mm)."

    def _pose_limit(self, pose: list[float], joints: tuple[float, ...]) -> Reach | None:
        g = self.geometry
        x, y, z, _ = pose
        if not g.z_min - LIMIT_TOLERANCE <= z <= g.z_max + LIMIT_TOLERANCE:
            return Reach(False, self._screw_reason(lower=z < g.z_min), None, joints)
        sines = self.linkage.sines(math, x, y, joints[0], joints[1])
        least = min(sines)
        if least >= self._sin_min - LIMIT_TOLERANCE:
            return None
        if least < 0.0:
            return Reach(False, "Beyond a singularity: on the way the two rods come into line.", None, joints)
        leg = sines.index(least)
        if leg == 2:
            return Reach(False, "Near a singularity: the two rods are almost in line.", None, joints)
        how = "stretched" if self.linkage.distance(leg, x, y) ** 2 > g.l_p**2 + g.l_d**2 else "folded"
        return Reach(False, f"Near a singularity: leg {leg + 1} is almost {how}.", leg + 1, joints)

    def _boundaries(self, pose: list[float]) -> list[Boundary]:
        g = self.geometry
        x, y, z, _ = pose
        return [
            Boundary(z - g.z_min, (0.0, 0.0, 1.0), 0.0),
            Boundary(g.z_max - z, (0.0, 0.0, -1.0), 0.0),
            *planar_limits(self.linkage, self._limits[:2], g.sigma_min, x, y),
        ]
