"""The real machine beside its twin: how late, how far off."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.link.errors import LinkError
from app.link.protocol.codes import Flag, State
from app.link.twin.lag import lag_s
from app.link.twin.model import Twin
from app.link.twin.recording import Recording, interpolated
from app.robots import ROBOTS, Robot
from app.simulation.run import SHOWN

Array = NDArray[np.float64]

LONGEST_S = 120.0
"""The newest part of a long recording is compared: the model's controller is computed period by period."""
GAP_S = 0.1
"""Telemetry that stays away longer ends a stretch: nobody knows the set-points between."""
FEWEST = 25


class Latency:
    """Round trips of the link, s; NaN where none is known."""

    def __init__(self, latency_s: Array) -> None:
        known = latency_s[np.isfinite(latency_s)]
        self.count = len(known)
        values = np.quantile(known, [0.5, 0.95, 1.0]).tolist() if len(known) else [np.nan] * 3
        self.median_s, self.p95_s, self.largest_s = values
        self.mean_s = float(known.mean()) if len(known) else np.nan


@dataclass(frozen=True, eq=False)
class TwinComparison:
    """k instants of a robot with n joints, rad or m."""

    robot: str
    note: str
    """What the measured joints are compared with, for students."""
    t: Array
    """(k,) s, on the recording's clock."""
    setpoint: Array
    """(k, n)"""
    measured: Array
    """(k, n)"""
    twin: Array
    """(k, n)"""
    tool_error_m: Array
    """(k,) distance of the two tools; NaN where a set of joints does not assemble."""
    lag_s: float
    """By which the machine is later than its twin; NaN where nothing moved long enough."""
    joint_lag_s: Array
    """(n,) the same of each joint alone."""
    following_lag_s: float
    """By which the machine is later than its set-points."""
    rms_error: Array
    """(n,) of measured minus twin, rad or m."""
    largest_error: Array
    """(n,) of its size."""
    rms_error_in_step: Array
    """(n,) when the twin is shifted by the lag: what remains is shape, not delay."""
    latency: Latency

    @property
    def rms_tool_error_m(self) -> float:
        return rms(self.tool_error_m)

    @property
    def largest_tool_error_m(self) -> float:
        known = self.tool_error_m[np.isfinite(self.tool_error_m)]
        return float(known.max()) if known.size else np.nan

    def shown(self, joint_values: Array) -> Array:
        """Joint values in deg or mm."""
        return joint_values * SHOWN[_joint_si(self.robot)][1]

    @property
    def joint_unit(self) -> str:
        """`deg` or `mm`."""
        return SHOWN[_joint_si(self.robot)][0]

    @property
    def sentence(self) -> str:
        worst = int(np.argmax(self.rms_error))
        errors = f"{self.shown(self.rms_error)[worst]:.2g} {self.joint_unit}"
        where = f"rms error of at most {errors} (joint {worst + 1}), {1e3 * self.rms_tool_error_m:.2g} mm at the tool"
        if np.isnan(self.lag_s):
            return f"Nothing moved long enough to tell a delay; {where}."
        order = "after" if self.lag_s >= 0.0 else "before"
        return f"The machine moves {1e3 * abs(self.lag_s):.1f} ms {order} its twin; {where}."


def compare(recording: Recording, twin: Twin) -> TwinComparison:
    """The longest stretch under power, or its last `LONGEST_S`, beside what the twin makes of the same set-points.

    Raises:
        LinkError: where the motors were never on for long enough.
    """
    stretch = powered_stretch(recording)
    answer = twin.follow(stretch.t, stretch.setpoint)
    robot = stretch.build()
    late = lag_s(stretch.t, answer, stretch.position)
    n = answer.shape[1]
    each = [lag_s(stretch.t, answer[:, [j]], stretch.position[:, [j]]) for j in range(n)]
    error = stretch.position - answer
    shifted = interpolated(stretch.t - (0.0 if np.isnan(late) else late), stretch.t, answer)
    return TwinComparison(
        robot=stretch.robot,
        note=twin.note,
        t=stretch.t,
        setpoint=stretch.setpoint,
        measured=stretch.position,
        twin=answer,
        tool_error_m=_tool_distance(robot, stretch.position, answer),
        lag_s=late,
        joint_lag_s=np.array(each),
        following_lag_s=lag_s(stretch.t, stretch.setpoint, stretch.position),
        rms_error=np.sqrt(np.mean(error**2, axis=0)),
        largest_error=np.abs(error).max(axis=0),
        rms_error_in_step=np.sqrt(np.mean((stretch.position - shifted) ** 2, axis=0)),
        latency=Latency(recording.latency_s),
    )


def powered_stretch(recording: Recording) -> Recording:
    """The longest part in which the joints followed their set-points without a gap, or the end of it."""
    follows = (recording.flags & Flag.POWERED).astype(bool) & (recording.state != State.TESTING)
    borders = np.diff(follows.astype(int)) != 0
    borders |= np.diff(recording.t) > GAP_S
    pieces = np.split(np.arange(len(follows)), np.flatnonzero(borders) + 1)
    longest = max((piece for piece in pieces if len(piece) and follows[piece[0]]), key=len, default=np.arange(0))
    if len(longest) < FEWEST:
        raise LinkError("The motors were not on for long enough to compare; record a motion of at least a second.")
    end = float(recording.t[longest[-1]])
    return recording.part(max(float(recording.t[longest[0]]), end - LONGEST_S), end)


def _tool_distance(robot: Robot, one: Array, other: Array) -> Array:
    return np.linalg.norm((robot.forward(one) - robot.forward(other))[:, :3], axis=1)


def rms(values: Array) -> float:
    """Of the values that are known; NaN for none."""
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if known.size else np.nan


def _joint_si(robot: str) -> str:
    return ROBOTS[robot].build.joint_unit
