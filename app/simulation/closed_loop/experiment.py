"""What is to be tried: a robot, a trajectory, a law, and everything that is not ideal. Plain data."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, Literal, get_args

import numpy as np

from app.control.laws import LAWS, Tuning
from app.motion import CycleMotion, Motion, Trajectory
from app.motion.cycle_items import ItemFlow
from app.robots import Robot, build_robot
from app.robots.dynamics import INERTIA, Inertia
from app.robots.limits import DriveLimits, drive_limits
from app.robots.robot import Array
from app.simulation.tracking import MAX_SAMPLES, TrackingError

Start = Literal["reference", "rest"]
PlantKind = Literal["exact", "mujoco"]

PERIOD_S = {"fivebar": 0.00025}
USUAL_PERIOD_S = 0.001


@dataclass(frozen=True)
class Experiment:
    """One closed loop."""

    robot: str
    dimensions: dict[str, float]
    trajectory: Trajectory
    law: str
    """Key of `LAWS`."""
    tuning: Tuning | None = None
    """None: `Tuning.default` of robot and law."""
    plant: PlantKind = "exact"
    friction: float = 1.0
    """Share of `FRICTION`; 0 is none. The laws know nothing of it."""
    payload_kg: float = 0.0
    """In the plant only, for the whole run or within `carried_s`."""
    carried_s: tuple[float, float] | None = None
    """From when to when the payload is carried."""
    model_error: float = 0.0
    """The law's masses are 1 + this times the true ones."""
    model: dict[str, float] = field(default_factory=dict)
    """Further fields of the law's `Inertia`, say `lumped`."""
    encoder_step: float = 0.0
    """Resolution of the joints' sensors, rad or m."""
    velocity_filter_hz: float = 0.0
    """0: joint rates are known; else they are differences of the readings, filtered to this bandwidth."""
    delay_samples: int = 0
    """Periods after which an effort takes effect."""
    limit_effort: bool = True
    effort_share: float = 1.0
    """Of the drives' peak effort: less than 1 makes them weaker."""
    limit_speed: bool = False
    """Whether drives refuse to push a joint further beyond its largest speed."""
    period_s: float | None = None
    """None: 1 ms; 0.25 ms for the five-bar."""
    start: Start = "reference"
    """`reference`: on it and with its speed. `rest`: standing still at `start_pose`."""
    start_pose: tuple[float, ...] | None = None
    """m and rad; None: the reference's first."""
    flow: ItemFlow | None = None
    """Items on belts, of a work cycle; recorded beside the robot."""

    @classmethod
    def of_motion(cls, motion: Motion, law: str, **changes: Any) -> Experiment:
        """A law follows a planned motion with its payload; the items of a work cycle weigh as much."""
        settings = motion.settings
        experiment = cls(settings.robot, settings.dimensions, motion.trajectory, law, payload_kg=settings.payload_kg)
        if isinstance(motion, CycleMotion):
            flow = motion.flow
            experiment = experiment.changed(flow=flow, carried_s=(flow.grasp_s, flow.release_s))
        return experiment.changed(**changes)

    def changed(self, **values: Any) -> Experiment:
        """A copy with some fields replaced."""
        return replace(self, **values)

    def build(self) -> Robot:
        return build_robot(self.robot, self.dimensions)

    @property
    def drives(self) -> DriveLimits:
        """What the drives can do."""
        speed, acceleration, effort = drive_limits(self.build())
        return DriveLimits(speed, acceleration, self.effort_share * effort)

    @property
    def tuned(self) -> Tuning:
        return self.tuning or Tuning.default(self.robot, self.law)

    @property
    def sampled_s(self) -> float:
        """Period of the controller, s."""
        return self.period_s or PERIOD_S.get(self.robot, USUAL_PERIOD_S)

    @property
    def steps(self) -> int:
        return round(self.trajectory.duration_s / self.sampled_s)

    @property
    def times(self) -> Array:
        """(k,) s, the controller's instants."""
        return np.arange(self.steps, dtype=float) * self.sampled_s

    @property
    def plant_inertia(self) -> Inertia:
        """The truth, as the run starts."""
        payload = 0.0 if self.carried_s else self.payload_kg
        return INERTIA[self.robot].changed(payload=payload)

    @property
    def model_inertia(self) -> Inertia:
        """What the law believes."""
        return INERTIA[self.robot].scaled(1.0 + self.model_error).changed(**self.model)

    def check(self) -> None:
        """
        Raises:
            TrackingError: if a name is unknown or a number makes no sense.
        """
        if self.law not in LAWS:
            raise TrackingError(f"There is no control law {self.law!r}; choose one of {', '.join(LAWS)}.")
        if self.plant not in get_args(PlantKind) or self.start not in get_args(Start):
            raise TrackingError("A run needs a plant (exact or mujoco) and a start (reference or rest).")
        amounts = (self.friction, self.payload_kg, self.encoder_step, self.velocity_filter_hz, self.delay_samples)
        if not all(0.0 <= amount < math.inf for amount in amounts):
            raise TrackingError("Friction, payload, sensor step, filter and delay cannot be negative; use 0 for none.")
        if not 0.0 < self.effort_share < math.inf:
            raise TrackingError("Drives need some effort; choose a share above 0.")
        if not -1.0 < self.model_error < math.inf:
            raise TrackingError("The model's error must be above -100 %: a robot without mass cannot be controlled.")
        if not self.sampled_s > 0.0 or not 1 <= self.steps <= MAX_SAMPLES:
            raise TrackingError(f"A run takes 1 to {MAX_SAMPLES} periods; shorten the motion or lengthen the period.")
