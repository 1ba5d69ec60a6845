"""A recorded run under a law for the whole robot: what each part of the law contributed, and how well it went."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from app.control.laws import Tuning
from app.motion.cycle_items import ItemFlow
from app.robots import build_robot
from app.simulation.run import Array, Run

AT_LIMIT = 1.0 - 1e-9


@dataclass(frozen=True, eq=False)
class ControlledRun(Run):
    """k instants; `u` are joint efforts, N m or N, as they acted."""

    pose: Array = field(kw_only=True)
    """(k, dof) where the tool was, as simulated."""
    rate: Array = field(kw_only=True)
    """(k, dof) how it moved."""
    components: dict[str, Array] = field(kw_only=True)
    """Component -> (k, n); they add up to the effort wanted, before limits and delay."""
    speed_limit: Array = field(kw_only=True)
    """(n,) largest joint speeds, rad/s or m/s."""
    law: str = field(kw_only=True)
    """Key of `LAWS`."""
    plant: str = field(kw_only=True)
    """`exact` or `mujoco`."""
    tuning: Tuning = field(kw_only=True)
    flow: ItemFlow | None = field(kw_only=True, default=None)
    """Of a work cycle: where items are when the tool takes and leaves them as planned."""
    seen_items: Array | None = field(kw_only=True, default=None)
    """(k, m, 4) where they were, for a plant in which they are bodies."""
    computed_s: float = field(kw_only=True, default=0.0)
    """How long the loop took to compute."""

    @property
    def torque(self) -> Array:
        """(k, n) N m or N"""
        return self.u

    @property
    def effort_limit(self) -> Array:
        """(n,) N m or N to either side"""
        return np.broadcast_to(np.asarray(self.u_max, dtype=float), self.u.shape[1:])

    @cached_property
    def tool_error(self) -> Array:
        """(k, dof) reference minus actual, m and rad"""
        return self.pose_ref - self.pose

    @cached_property
    def items(self) -> Array | None:
        """(k, m, 4) x, y, z (m) and turn (rad) of what is carried and what lies on belts; None without belts"""
        if self.seen_items is not None or self.flow is None:
            return self.seen_items
        return self.flow.at(self.t, self.pose)

    @property
    def in_plane_error(self) -> Array:
        """(k,) m, in x and y"""
        return np.linalg.norm(self.tool_error[:, :2], axis=1)

    @cached_property
    def qd(self) -> Array:
        """(k, n) joint rates, rad/s or m/s"""
        return build_robot(self.robot, self.dimensions).dynamics.joint_rates(self.pose, self.rate)

    @property
    def peak(self) -> Array:
        """(dof,) largest error of the tool, m and rad"""
        return self.peak_from(0.0)

    @property
    def rms(self) -> Array:
        """(dof,) m and rad"""
        return self.rms_from(0.0)

    @property
    def rmse_mm(self) -> Array:
        """(dof,) over all samples, mm; a rotation in mrad"""
        return self.rms * 1e3

    @property
    def rmse_after_1s_mm(self) -> Array:
        """(dof,) once what the start left has died away"""
        return self.rms_from(1.0) * 1e3

    def peak_from(self, first_s: float) -> Array:
        """(dof,) largest error from a time on, m and rad"""
        return np.abs(self.tool_error[self.t >= first_s]).max(axis=0)

    def rms_from(self, first_s: float) -> Array:
        """(dof,) of the error from a time on, m and rad"""
        return _rms(self.tool_error[self.t >= first_s])

    def rms_within(self, stretches: Sequence[tuple[float, float]]) -> Array:
        """(dof,) of the error within stretches of time (s), m and rad"""
        inside = np.logical_or.reduce([(self.t >= first) & (self.t <= last) for first, last in stretches])
        return _rms(self.tool_error[inside])

    def rms_distance_m(self, first_s: float = 0.0) -> float:
        """Of the tool point in space"""
        return float(np.sqrt(np.mean(self.tool_error_m[self.t >= first_s] ** 2)))

    @cached_property
    def shares(self) -> dict[str, Array]:
        """Component -> (n,) its RMS over the sum of all RMS, 0 to 1"""
        sizes = {name: _rms(values) for name, values in self.components.items()}
        total = np.maximum(np.sum(list(sizes.values()), axis=0), np.finfo(float).tiny)
        return {name: size / total for name, size in sizes.items()}

    @property
    def torque_peak(self) -> Array:
        """(n,) N m or N"""
        return np.abs(self.u).max(axis=0)

    @property
    def torque_rms(self) -> Array:
        """(n,) N m or N"""
        return _rms(self.u)

    @property
    def saturation(self) -> Array:
        """(n,) share of samples with the effort at its limit"""
        return np.mean(np.abs(self.u) >= self.effort_limit * AT_LIMIT, axis=0)

    @property
    def overspeed(self) -> Array:
        """(n,) largest joint speed over the drive's largest: above 1 no such motor could do it"""
        return np.abs(self.qd).max(axis=0) / self.speed_limit


def _rms(values: Array) -> Array:
    return np.sqrt(np.mean(values**2, axis=0))
