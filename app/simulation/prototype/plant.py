"""A MuJoCo model as the plant of a closed loop: efforts in, motion out."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from app.robots.dynamics.inertia import Inertia
from app.robots.robot import Array, Robot
from app.simulation.prototype.draft import STEP_S
from app.simulation.prototype.engine import Data, Model, mujoco
from app.simulation.prototype.items import BeltSpeed, Grasps, Item
from app.simulation.prototype.model import PAYLOAD, mjcf

if TYPE_CHECKING:
    from app.simulation.plant import Friction

Values = tuple[float, ...]


class MujocoPlant:
    """A robot that MuJoCo moves. Joints and tool are read from MuJoCo's own coordinates, not from kinematics.

    MuJoCo steps by h <= `step_s`: v += h a, then q += h v. As efforts are held over a step, h^2/2 a of that is too
    much, and is taken back: what is left is exact for a constant acceleration.

    A robot that is torn apart is at NaN from then on; MuJoCo by itself would put it back to where it began.

    Friction f is stiff near standstill: over a step it counts as f + f'/2 dv (linearly implicit). To MuJoCo the slope
    is an inertia h f'/2 beside that of the motor.
    """

    def __init__(
        self,
        robot: Robot,
        inertia: Inertia | None = None,
        *,
        pose: Sequence[float] | Array,
        rate: Sequence[float] | Array | None = None,
        friction: Friction | None = None,
        step_s: float = STEP_S,
        items: Sequence[Item] = (),
    ) -> None:
        """
        Args:
            pose: (dof,) where it stands, m and rad.
            rate: (dof,) how it moves; at rest unless given.
            items: what lies on belts; see `grasp`.
        """
        mj = mujoco()
        self.model: Model = mj.MjModel.from_xml_string(mjcf(robot, inertia, pose=pose, items=items))
        self.model.opt.disableflags |= mj.mjtDisableBit.mjDSBL_AUTORESET
        self.data: Data = mj.MjData(self.model)
        self._step, self._shift = mj.mj_step, mj.mj_integratePos
        self._step_s = step_s
        self._friction = friction
        joints, tool = ([self.model.joint(name) for name in names] for names in (robot.joint_names, robot.pose_names))
        self._q, self._p = ([int(joint.qposadr[0]) for joint in group] for group in (joints, tool))
        self._qd, self._v = ([int(joint.dofadr[0]) for joint in group] for group in (joints, tool))
        self._drive = self.model.dof_armature[self._qd].tolist()
        self._payload = int(self.model.body(PAYLOAD).id)
        mj.mj_forward(self.model, self.data)
        self._grasps = Grasps(self.model, self.data, items) if items else None
        if rate is not None:
            self._set_in_motion(rate)
        mj.mj_forward(self.model, self.data)

    @property
    def joints(self) -> Values:
        """(n,) rad or m."""
        return tuple(self.data.qpos[self._q].tolist())

    @property
    def joint_rates(self) -> Values:
        """(n,) rad/s or m/s."""
        return tuple(self.data.qvel[self._qd].tolist())

    @property
    def pose(self) -> Values:
        """(dof,) m and rad."""
        return tuple(self.data.qpos[self._p].tolist())

    @property
    def rate(self) -> Values:
        """(dof,) m/s and rad/s."""
        return tuple(self.data.qvel[self._v].tolist())

    @property
    def gap_m(self) -> float:
        """Largest distance between two ends that a loop should keep together, as of the last step."""
        d = self.data
        connects = self.model.eq_type[d.efc_id[: d.ne]] == 0
        return float(np.linalg.norm(d.efc_pos[: d.ne][connects].reshape(-1, 3), axis=1).max())

    @property
    def items(self) -> list[tuple[float, float, float, float]]:
        """x, y, z of its centre and turn about z of every item, m and rad."""
        return self._grasps.poses() if self._grasps else []

    def advance(self, effort: Sequence[float], duration_s: float) -> None:
        """Let constant efforts (n,) (N m or N) act for a time."""
        steps = max(1, math.ceil(duration_s / self._step_s - 1e-6))
        h = self.model.opt.timestep = duration_s / steps
        applied, armature, rates = self.data.qfrc_applied, self.model.dof_armature, self.data.qvel
        if self._friction is None:
            applied[self._qd] = effort
        for _ in range(steps):
            if self._friction is not None:
                forces, slopes = self._friction.at(rates[self._qd].tolist())
                for dof, drive, tau, force, slope in zip(self._qd, self._drive, effort, forces, slopes, strict=True):
                    applied[dof] = tau - force
                    armature[dof] = drive + 0.5 * h * slope
            self._step(self.model, self.data)
            self._shift(self.model, self.data.qpos, self.data.qacc, -0.5 * h * h)
            if self._grasps is not None:
                self._grasps.carry(h)

    def set_payload(self, kg: float) -> None:
        """Hang a point mass on the tool, or take it off."""
        self.model.body_mass[self._payload] = kg
        mujoco().mj_setConst(self.model, mujoco().MjData(self.model))

    def grasp(self, k: int) -> None:
        """Let the tool take item k along, as it lies relative to the tool."""
        assert self._grasps is not None, "this plant was built without items"
        self._grasps.grasp(k)

    def release(self, k: int, belt: BeltSpeed) -> None:
        """Leave item k on a belt with a speed (2,) in m/s."""
        assert self._grasps is not None, "this plant was built without items"
        self._grasps.release(k, belt)

    def _set_in_motion(self, rate: Sequence[float] | Array) -> None:
        """Give every coordinate the rate that the loops demand when the tool has a rate (dof,)."""
        d, nv = self.data, self.model.nv
        loops = d.efc_J.reshape(-1, nv)[: d.ne]
        rows = np.vstack([loops, np.eye(nv)[self._v]])
        moving = np.linalg.lstsq(rows, np.concatenate([np.zeros(d.ne), rate]), rcond=1e-9)[0]
        robot = nv - 6 * len(self.items)  # items come last and ride already
        d.qvel[:robot] = moving[:robot]
