"""The real machine beside what was planned: how far from the path, and how late."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from app.link.errors import LinkError
from app.link.protocol.codes import State
from app.link.twin.compare import FEWEST, rms
from app.link.twin.recording import Recording, assembled, interpolated

Array = NDArray[np.float64]


class Planned(Protocol):
    """A program: where the joints are to be."""

    @property
    def t(self) -> Array:
        """(m,) s from its start."""
        ...

    @property
    def q(self) -> Array:
        """(m, n) rad or m."""
        ...


@dataclass(frozen=True, eq=False)
class PlanComparison:
    """What was drawn beside what was planned."""

    t: Array
    """(k,) s, the instants of the recording at which the robot moved."""
    pose: Array
    """(k, dof) where the tool was."""
    path_error_m: Array
    """(k,) distance of the tool from the nearest point of the planned path, whenever the robot was to be there."""
    start_s: float
    """When the program began, on the recording's clock, by the best fit in time."""
    rms_joint_error: Array
    """(n,) against the plan at the same time, rad or m; large after a pause or under another speed."""

    @property
    def rms_path_error_m(self) -> float:
        return rms(self.path_error_m)

    @property
    def largest_path_error_m(self) -> float:
        return float(self.path_error_m.max())


def compare_with_plan(recording: Recording, plan: Planned) -> PlanComparison:
    """Only instants in MOVING count. LinkError where the robot did not move, or not the same kind of robot."""
    if plan.q.shape[1] != recording.position.shape[1]:
        raise LinkError("Recording and program are of different robots; choose the recording of this program.")
    moves = recording.state == State.MOVING
    if moves.sum() < FEWEST:
        raise LinkError("The robot hardly moved in this recording; record the program while it runs.")
    robot, t = recording.build(), recording.t[moves]
    measured = recording.position[moves]
    pose = assembled(robot, measured)
    start = _start(t, measured, plan)
    wanted = interpolated(t - start, plan.t, plan.q)
    path = assembled(robot, plan.q)[:, :3]
    return PlanComparison(
        t=t,
        pose=pose,
        path_error_m=_from_path(pose[:, :3], path),
        start_s=start,
        rms_joint_error=np.sqrt(np.mean((measured - wanted) ** 2, axis=0)),
    )


def _start(t: Array, measured: Array, plan: Planned) -> float:
    """The start at which plan and measurement differ least: tried every 50 ms, then refined."""
    from scipy.optimize import minimize_scalar

    def mismatch(start: float) -> float:
        return float(np.sum((measured - interpolated(t - start, plan.t, plan.q)) ** 2))

    starts = np.arange(t[0] - float(plan.t[-1]), t[-1], 0.05)
    starts = starts[:: max(1, len(starts) // 2000)]
    step = float(starts[1] - starts[0]) if len(starts) > 1 else 0.05
    best = float(min(starts, key=mismatch, default=t[0]))
    found = minimize_scalar(mismatch, bounds=(best - step, best + step), method="bounded", options={"xatol": 1e-6})
    return float(found.x)  # pyright: ignore[reportAttributeAccessIssue]


def _from_path(points: Array, path: Array) -> Array:
    """(k,) distances of points (k, 3) from the polyline (m, 3), tried on the segments at its nearest corners."""
    from scipy.spatial import KDTree

    path = path[np.concatenate([[True], np.any(np.diff(path, axis=0) != 0.0, axis=1)])]
    _, near = KDTree(path).query(points, k=min(4, len(path)))
    corners = np.asarray(near).reshape(len(points), -1)
    starts = np.concatenate([np.maximum(corners - 1, 0), np.minimum(corners, len(path) - 2)], axis=1)
    starts = np.maximum(starts, 0)
    a, b = path[starts], path[np.minimum(starts + 1, len(path) - 1)]
    along, reach = b - a, points[:, None] - a
    share = np.clip((along * reach).sum(-1) / np.maximum((along**2).sum(-1), 1e-18), 0.0, 1.0)
    return np.linalg.norm(reach - share[..., None] * along, axis=-1).min(axis=1)
