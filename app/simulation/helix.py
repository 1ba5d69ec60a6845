"""The linear delta's experiment: the tool on a helix (thesis (27), with sin and cos as its figures show)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from app.control.laws import Tuning
from app.motion.trajectory import Array, Sample
from app.simulation.closed_loop import Experiment, simulate
from app.simulation.closed_loop.experiment import PlantKind
from app.simulation.controlled_run import ControlledRun
from app.simulation.tracking import TrackingError

HelixStart = Literal["axis", "home", "reference"]

UPPER_STOPS_Z_M = -0.3164
"""Where the thesis' robot starts: every carriage at its upper stop."""

LUMPED = 0.5
"""The laws' model puts half of each rod on the platform, half on the carriage; the plant has rods that turn."""


@dataclass(frozen=True)
class Helix:
    """x = r sin wt, y = r cos wt, z = z0 + vt."""

    title: str
    radius_m: float
    omega_rad_s: float
    z0_m: float
    rise_m_s: float
    duration_s: float = 5.0

    def sample(self, t: ArrayLike) -> Sample:
        """Pose, rate and acceleration (k, 3) at t (k,); at rest where it begins and ends beyond."""
        times = np.asarray(t, dtype=float)
        inside = ((times >= 0.0) & (times <= self.duration_s)).astype(float)[..., None]
        clock = np.clip(times, 0.0, self.duration_s)
        r, w = self.radius_m, self.omega_rad_s
        sin, cos, flat = r * np.sin(w * clock), r * np.cos(w * clock), np.zeros_like(clock)
        pose = _stack(sin, cos, self.z0_m + self.rise_m_s * clock)
        rate = _stack(w * cos, -w * sin, flat + self.rise_m_s)
        return Sample(pose, rate * inside, _stack(-w * w * sin, -w * w * cos, flat) * inside)


def _stack(*columns: Array) -> Array:
    return np.stack(columns, axis=-1)


HELICES = {
    "T1": Helix("Helix of 10 mm, half a turn a second", 0.01, math.pi, -0.40, -0.01),
    "T2": Helix("Helix of 80 mm, one turn a second", 0.08, 2.0 * math.pi, -0.45, -0.03),
}
"""T1 is like the thesis', T2 asks more of the dynamics (spec A6)."""


def helix_tracking(
    controller: str,
    trajectory: str | Helix = "T1",
    friction: bool = False,
    plant: PlantKind = "exact",
    *,
    start: HelixStart = "axis",
    tuning: Tuning | None = None,
) -> ControlledRun:
    """The linear delta follows a helix at 1 kHz with forces up to 60 N (spec A6).

    Args:
        controller: key of `LAWS`.
        trajectory: `T1`, `T2`, or a helix of one's own.
        friction: Coulomb 2 N and viscous 8 N s/m in each carriage.
        start: standing still on the axis of the helix (the spec's figures over the whole run), or at `home`, every
            carriage at its upper stop as in the thesis, or `reference`: on the helix and moving with it.
        tuning: None: the spec's gains.

    Raises:
        TrackingError: for a name that does not exist, or a helix out of reach.
    """
    experiment = helix_experiment(controller, trajectory, friction, plant, start=start, tuning=tuning)
    return simulate(experiment)


def helix_experiment(
    controller: str,
    trajectory: str | Helix = "T1",
    friction: bool = False,
    plant: PlantKind = "exact",
    *,
    start: HelixStart = "axis",
    tuning: Tuning | None = None,
) -> Experiment:
    """What `helix_tracking` runs."""
    if isinstance(trajectory, str) and trajectory not in HELICES:
        raise TrackingError(f"There is no helix {trajectory!r}; choose {' or '.join(HELICES)}.")
    if start not in get_args(HelixStart):
        raise TrackingError(f"There is no start {start!r}; choose axis, home or reference.")
    helix = HELICES[trajectory] if isinstance(trajectory, str) else trajectory
    heights = {"axis": helix.z0_m, "home": UPPER_STOPS_Z_M}
    return Experiment(
        "linear",
        {},
        helix,
        controller,
        tuning,
        plant=plant,
        friction=1.0 if friction else 0.0,
        model={"lumped": LUMPED},
        start="reference" if start == "reference" else "rest",
        start_pose=(0.0, 0.0, heights[start]) if start in heights else None,
    )
