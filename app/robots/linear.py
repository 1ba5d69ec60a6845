"""linear: the delta with three carriages on vertical rails, a platform that only translates (Ashraf 2022).

The frame's origin lies in the middle of the carriage joints at displacement 0, z up; a displacement d_i >= 0
moves carriage i down. Legs 1 and 2 stand at -y, leg 3 at +y. The triangles are those of Table 1; its rounding
puts leg 3 a tenth of a millimetre farther out, of which the thesis' tables carry the trace. With
zeta_i = a_i - b_i, the carriage joint less the platform joint, the platform is a point on three spheres:

    m_i = (x, y) - zeta_i,   h_i = sqrt(l^2 - |m_i|^2),   d_i = -z - h_i,   J_i = (m_i / h_i, -1)   (9), (14)
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.robots.geometry import Geometry, GeometryError, angle, length
from app.robots.nearest import Boundary
from app.robots.reach import Reach
from app.robots.robot import LIMIT_TOLERANCE, Array, Assembly, Robot, Skeleton, condition_number
from app.robots.spheres import intersect_three_spheres

RAIL_AZIMUTHS = tuple(math.radians(a) for a in (210.0, 330.0, 90.0))


@dataclass(frozen=True, kw_only=True)
class LinearGeometry(Geometry):
    """Dimensions of Table 1, in metres."""

    S_A: float = length(0.485, "Rail spacing", 0.30, 0.90)
    """Distance between the carriage joints 1 and 2 (S_A)."""
    W_A: float = length(0.140, "Rails 1 and 2 to centre", 0.06, 0.30)
    """Distance of the carriage joints 1 and 2 from the x axis (W_A)."""
    U_A: float = length(0.280, "Rail 3 to centre", 0.15, 0.55)
    """Distance of the carriage joint 3 from the z axis (U_A)."""
    s_p: float = length(0.170, "Platform side", 0.04, 0.28, essential=False)
    """Distance between the platform joints 1 and 2 (s_p)."""
    w_p: float = length(0.049, "Platform joints 1 and 2 to centre", 0.01, 0.15, essential=False)
    """Distance of the platform joints 1 and 2 from its x axis (w_p)."""
    u_b: float = length(0.098, "Platform joint 3 to centre", 0.02, 0.14, essential=False)
    """Distance of the platform joint 3 from its centre (u_b)."""
    l: float = length(0.365, "Rod length", 0.15, 0.80)
    """Rods, carriage joint to platform joint (l)."""
    L_min: float = length(0.070, "Upper stop", 0.0, 0.30, essential=False)
    """Carriage below the frame's top at its upper stop; displacement 0 (L_min)."""
    L_max: float = length(0.580, "Lower stop", 0.20, 1.20)
    """Carriage below the frame's top at its lower stop (L_max)."""
    z_min: float = length(-0.800, "Floor", -2.0, -0.20, essential=False)
    """Height at which the platform would touch the floor; from the frame's height H."""
    beta_min: float = angle(math.acos(0.305 / 0.365), "Least rod elevation", math.radians(5.0), math.radians(70.0))
    """Flatter rods come too near the singularity where they lie level; 33 degrees keep |m_i| <= 0.305 m."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.s_p >= self.S_A or self.w_p + self.u_b >= self.W_A + self.U_A:
            raise GeometryError("The platform must be smaller than the rails' triangle; reduce s_p, w_p or u_b.")
        if self.L_max - self.L_min < 0.01:
            raise GeometryError("The lower stop (L_max) must lie at least 10 mm below the upper stop (L_min).")

    @property
    def stroke(self) -> float:
        """Largest displacement d of a carriage."""
        return self.L_max - self.L_min

    @property
    def m_max(self) -> float:
        """Farthest that a platform joint may be from its rail, seen from above."""
        return self.l * math.cos(self.beta_min)


class LinearDelta(Robot):
    """See the module; poses (x, y, z), joints d_1..d_3 in metres, positive down."""

    name = "linear"
    title = "Linear delta"
    pose_names = ("x", "y", "z")
    joint_names = ("d1", "d2", "d3")
    joint_unit = "m"
    geometry: LinearGeometry

    def _bind(self) -> None:
        g = self.geometry
        self._carriages = ((-g.S_A / 2, -g.W_A), (g.S_A / 2, -g.W_A), (0.0, g.U_A))
        self._corners = ((-g.s_p / 2, -g.w_p), (g.s_p / 2, -g.w_p), (0.0, g.u_b))
        pairs = zip(self._carriages, self._corners, strict=True)
        self._zeta = tuple((a_x - b_x, a_y - b_y) for (a_x, a_y), (b_x, b_y) in pairs)
        self._limits = ((0.0, g.stroke),) * 3

    def _default_home(self) -> tuple[float, ...]:
        return (0.0, 0.0, -0.40)

    def _inverse_columns(self, *pose: Array) -> Sequence[Array]:
        x, y, z = pose
        with np.errstate(invalid="ignore"):
            return [-z - np.sqrt(self.geometry.l**2 - (x - zx) ** 2 - (y - zy) ** 2) for zx, zy in self._zeta]

    def solve(self, *pose: float) -> tuple[float, ...]:
        x, y, z = pose
        l2 = self.geometry.l**2
        squares = [l2 - (x - zx) * (x - zx) - (y - zy) * (y - zy) for zx, zy in self._zeta]
        return tuple([-z - math.sqrt(h2) if h2 >= 0.0 else math.nan for h2 in squares])

    def working_modes(self, pose: ArrayLike) -> Array:
        """Each leg's carriage above or below the platform: up to eight rows. The stops are not applied; most
        carriages below the platform would be beyond the lower one."""
        z = float(np.asarray(pose, dtype=float)[2])
        above = self.inverse(pose)
        below = -2.0 * z - above
        modes = np.array(list(product(*zip(above, below, strict=True))))
        return modes[~np.isnan(modes).any(axis=-1)]

    def forward(self, joints: ArrayLike) -> Array:
        """Lower intersection of the three spheres of rod ends, where it hangs below every carriage."""
        d = np.asarray(joints, dtype=float)
        self._columns(d, 3)
        pose = intersect_three_spheres(self._rod_spheres(d), self.geometry.l, upper=False)
        with np.errstate(invalid="ignore"):
            return np.where(self._hangs(pose, d)[..., None], pose, np.nan)

    def assemblies(self, joints: ArrayLike) -> list[Assembly]:
        d = np.asarray(joints, dtype=float)
        spheres = self._rod_spheres(d)
        lower = intersect_three_spheres(spheres, self.geometry.l, upper=False)
        if np.isnan(lower).any():
            return []
        upper = intersect_three_spheres(spheres, self.geometry.l, upper=True)
        return [Assembly(lower, bool(self._hangs(lower, d))), Assembly(upper, False)]

    def _rod_spheres(self, d: Array) -> Array:
        """(..., 3, 3) spheres of radius l about these centres pass through the tool point."""
        zeta = np.broadcast_to(np.array(self._zeta), (*d.shape, 2))
        return np.concatenate([zeta, -d[..., None]], axis=-1)

    def _hangs(self, pose: Array, d: Array) -> NDArray[np.bool_]:
        return np.logical_and.reduce(pose[..., 2:] <= LIMIT_TOLERANCE - d, axis=-1)

    def jacobian(self, pose: ArrayLike) -> Array:
        """Rows (m_i / h_i, -1)."""
        poses = np.asarray(pose, dtype=float)
        heights = -poses[..., 2, None] - self.inverse(poses)
        with np.errstate(divide="ignore", invalid="ignore"):
            slopes = (poses[..., None, :2] - np.array(self._zeta)) / heights[..., None]
        down = np.where(np.isnan(heights), np.nan, -1.0)
        return np.concatenate([slopes, down[..., None]], axis=-1)

    def conditioning(self, pose: ArrayLike) -> Array:
        """Condition number of J: metres to metres already."""
        return condition_number(self.jacobian(pose))

    def skeleton(self, pose: Sequence[float], joints: Sequence[float]) -> Skeleton:
        d = np.asarray(joints, dtype=float)
        base = np.column_stack([self._carriages, np.zeros(3)])
        platform = np.asarray(pose, dtype=float) + np.column_stack([self._corners, np.zeros(3)])
        hinge = np.array([(-math.sin(a), math.cos(a), 0.0) for a in RAIL_AZIMUTHS])
        return Skeleton(base, base - np.column_stack([np.zeros((3, 2)), d]), platform, hinge)

    def reach(self, pose: Sequence[float] | Array) -> Reach:
        """As for every robot, but the floor is named where it stops the platform before the carriages do."""
        verdict = super().reach(pose)
        if verdict.joints is None:
            return verdict
        below_floor = self.geometry.z_min - float(pose[2])
        if below_floor > max(max(verdict.joints) - self.geometry.stroke, LIMIT_TOLERANCE):
            return verdict._replace(reason="The platform would touch the floor.", leg=None)
        return verdict

    def _from_rails(self, pose: Sequence[float]) -> list[float]:
        """|m_i|: how far each platform joint is from its rail, seen from above."""
        return [math.hypot(pose[0] - zx, pose[1] - zy) for zx, zy in self._zeta]

    def _admissible(self, pose: Array, joints: Array) -> NDArray[np.bool_]:
        g = self.geometry
        m = np.linalg.norm(pose[..., None, :2] - np.array(self._zeta), axis=-1)
        return (m <= g.m_max + LIMIT_TOLERANCE).all(axis=-1) & (pose[..., 2] >= g.z_min - LIMIT_TOLERANCE)

    def _open_loop(self, pose: list[float], joints: tuple[float, ...]) -> Reach:
        distances = self._from_rails(pose)
        leg = max(range(3), key=distances.__getitem__)
        short = (distances[leg] - self.geometry.l) * 1e3
        size = f"{short:.0f}" if short >= 0.5 else "less than 1"
        return Reach(False, f"Out of reach: leg {leg + 1} is {size} mm too short.", leg + 1)

    def _limit_reason(self, joint: int, value: float) -> str:
        low, high = self._limits[joint]
        stop, at = ("upper", low) if value < low else ("lower", high)
        return f"Leg {joint + 1}: carriage at its {stop} stop ({at * 1e3:.0f} mm)."

    def _pose_limit(self, pose: list[float], joints: tuple[float, ...]) -> Reach | None:
        g = self.geometry
        distances = self._from_rails(pose)
        leg = max(range(3), key=distances.__getitem__)
        if distances[leg] > g.m_max + LIMIT_TOLERANCE:
            reason = f"Leg {leg + 1}: rods too flat, {math.degrees(g.beta_min):.0f} degrees is the least."
            return Reach(False, reason, leg + 1, joints)
        if pose[2] < g.z_min - LIMIT_TOLERANCE:
            return Reach(False, "The platform would touch the floor.", None, joints)
        return None

    def _boundaries(self, pose: list[float]) -> list[Boundary]:
        """d_i >= 0: below the sphere of the carriage at its upper stop; d_i <= stroke: above that of the
        lower stop; rods steep enough: within a cylinder about the rail. All three keep the loop closed."""
        g = self.geometry
        limits = [Boundary(pose[2] - g.z_min, (0.0, 0.0, 1.0), 0.0)]
        for zx, zy in self._zeta:
            m_x, m_y = pose[0] - zx, pose[1] - zy
            reach, normal = self._downward_reach(m_x, m_y, pose[2])
            limits.append(Boundary(reach - g.l, normal, -1.0 / g.l))
            reach, (n_x, n_y, n_z) = self._downward_reach(m_x, m_y, pose[2] + g.stroke)
            limits.append(Boundary(g.l - reach, (-n_x, -n_y, -n_z), 1.0 / g.l))
            value = 0.5 * (g.m_max**2 - m_x * m_x - m_y * m_y) / g.m_max
            limits.append(Boundary(value, (-m_x / g.m_max, -m_y / g.m_max, 0.0), 1.0 / g.m_max))
        return limits

    def _downward_reach(self, m_x: float, m_y: float, v_z: float) -> tuple[float, tuple[float, float, float]]:
        """Largest n . v over the directions n that a rod may have, and that n. Within the cone of steep rods
        this is |v|, so that its levels are caps of spheres; they go on outside along the caps' tangents."""
        m = math.hypot(m_x, m_y)
        c, s = math.cos(self.geometry.beta_min), math.sin(self.geometry.beta_min)
        if m * s <= -v_z * c and v_z < 0.0:
            size = math.hypot(m, v_z)
            return size, (m_x / size, m_y / size, v_z / size)
        flat = c / m if m > 0.0 else 0.0
        return c * m - s * v_z, (flat * m_x, flat * m_y, -s)
