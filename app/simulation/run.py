"""A recorded experiment, whoever made it: what was asked of the robot, what it did, what it took."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from app.robots import build_robot

Array = NDArray[np.float64]

SHOWN = {"m": ("mm", 1e3), "rad": ("deg", 180.0 / np.pi)}
"""SI unit -> what people read, and the factor."""


@dataclass(frozen=True, eq=False)
class Run:
    """k instants of one robot with n joints; SI units and radians."""

    title: str
    robot: str
    """Its name in `ROBOTS`."""
    t: Array
    """(k,) s, evenly spaced."""
    pose_ref: Array
    """(k, dof) where the tool should have been."""
    q_ref: Array
    """(k, n) where the joints should have been."""
    q: Array
    """(k, n) where they were."""
    u: Array
    """(k, n) control signal."""
    u_max: float | Array
    """Limit of the control signal to either side, (n,) where each joint has its own."""
    effort_unit: str
    """Of the control signal, say `V`."""
    ise: Array
    """(n,) integral of the squared joint error, deg^2 s or mm^2 s."""
    dimensions: dict[str, float] = field(default_factory=dict)
    """Changed dimensions of the robot, m and rad."""

    @cached_property
    def pose(self) -> Array:
        """(k, dof) where the tool was. Where four free joints do not assemble, the last pose that did."""
        robot = build_robot(self.robot, self.dimensions)
        pose = robot.forward(self.q)
        good = ~np.isnan(pose).any(axis=1)
        last = np.maximum.accumulate(np.where(good, np.arange(len(pose)), -1))
        return np.where(last[:, None] < 0, self.pose_ref, pose[np.maximum(last, 0)])

    @property
    def joint_unit(self) -> str:
        """In which joints are read: `deg` or `mm`."""
        return SHOWN[self._joint_si][0]

    @property
    def joint_factor(self) -> float:
        """`joint_unit` per rad or m."""
        return SHOWN[self._joint_si][1]

    @property
    def joint_error(self) -> Array:
        """(k, n) reference minus actual, in `joint_unit`."""
        return (self.q_ref - self.q) * self.joint_factor

    @property
    def tool_error_m(self) -> Array:
        """(k,) distance of the tool from where it should have been."""
        return np.linalg.norm((self.pose_ref - self.pose)[:, :3], axis=1)

    def outline(self, points: int, first_s: float = 0.0, last_s: float = np.inf) -> NDArray[np.intp]:
        """Indices of about `points` instants of a stretch of time, more of them where much happens."""
        inside = np.flatnonzero((self.t >= first_s) & (self.t <= last_s))
        if len(inside) <= points:
            return inside
        motion = np.abs(np.diff(self.q[inside], axis=0)).sum(axis=1) + 1e-12
        pace = np.cumsum(motion / motion.sum() + 1.0 / len(motion))
        return inside[np.unique([0, *np.searchsorted(pace, np.linspace(0.0, pace[-1], points)), len(inside) - 1])]

    @property
    def saturation_share(self) -> float:
        """Share of all control signals that stand at their limit."""
        return float(np.mean(np.abs(self.u) >= np.asarray(self.u_max) * (1.0 - 1e-9)))

    def csv(self) -> str:
        """Every instant as a table with units in its head."""
        robot = build_robot(self.robot, self.dimensions)
        unit, factor = SHOWN[self._joint_si]
        pose_units = [SHOWN["m"]] * 3 + [SHOWN["rad"]] * (robot.dof - 3)
        scale = np.array([factor for _, factor in pose_units])
        names = [(name, unit) for name, (unit, _) in zip(robot.pose_names, pose_units, strict=True)]
        head = ["t_s"]
        head += [f"{name}_{kind}_{unit}" for kind in ("ref", "actual") for name, unit in names]
        head += [f"{name}_{kind}_{unit}" for kind in ("ref", "actual") for name in robot.joint_names]
        head += [f"u_{name}_{self.effort_unit}" for name in robot.joint_names]
        tables = (self.t[:, None], self.pose_ref * scale, self.pose * scale, self.q_ref * factor, self.q * factor)
        rows = np.hstack([*tables, self.u]).tolist()
        return "\n".join([",".join(head), *(",".join(f"{value:.6g}" for value in row) for row in rows), ""])

    @property
    def _joint_si(self) -> str:
        return build_robot(self.robot, {}).joint_units[0]
