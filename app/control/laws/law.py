"""What every model-based law is given, what it is asked once a period, and what it tells afterwards."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.control.laws.tuning import Tuning
from app.robots.dynamics import Dynamics, Terms
from app.robots.dynamics.elementwise import stacked

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Reference:
    """Where tool and joints should be at k instants, SI units and radians."""

    pose: Array
    """(k, dof)"""
    rate: Array
    """(k, dof)"""
    acceleration: Array
    """(k, dof)"""
    joints: Array
    """(k, n)"""
    joint_rates: Array
    """(k, n)"""
    joint_accelerations: Array
    """(k, n)"""


@dataclass(frozen=True, eq=False)
class Setup:
    """Everything a law may know."""

    model: Dynamics
    """The law's own idea of the robot, which may be wrong."""
    reference: Reference
    tuning: Tuning
    period_s: float
    effort_limit: Array
    """(n,) N m or N to either side."""


@dataclass(frozen=True, eq=False)
class Seen:
    """What a law was shown at k instants."""

    terms: Terms
    """The model there, with columns (k,) in place of floats."""
    joints: Array
    """(k, n)"""
    joint_rates: Array
    """(k, n)"""
    pose: Array
    """(k, dof)"""
    rate: Array
    """(k, dof)"""


class Law(ABC):
    """One run's controller: it may remember what happened before, so each run makes a new one."""

    def __init__(self, setup: Setup) -> None:
        self.setup = setup

    @abstractmethod
    def effort(self, k: int, state: Terms, applied: Sequence[float]) -> Sequence[float]:
        """Joint efforts (n,) wanted from instant k on, N m or N, not yet limited.

        `state` is the law's model at the measured pose and rate; `applied` the limited efforts of the period before.
        """

    @abstractmethod
    def components(self, seen: Seen) -> dict[str, Array]:
        """Component -> (k, n) its share of the efforts wanted; they add up to them."""


def inertial_of_pose(terms: Terms, acceleration: Array) -> Array:
    """(k, n) efforts J^-T M a of tool accelerations (k, dof)."""
    return stacked(terms.inertial(tuple(acceleration.T)), acceleration.shape[:1])


def inertial_of_joints(terms: Terms, acceleration: Array) -> Array:
    """(k, n) efforts M_d qdd of joint accelerations (k, n), M_d = J^-T M J^-1: what they add to the effort of none."""
    return stacked(terms.inertial(terms.to_pose(tuple(acceleration.T))), acceleration.shape[:1])


def joint_bias(terms: Terms, count: int) -> Array:
    """(count, n) H_d: the effort at which no joint accelerates."""
    still = (0.0,) * len(terms.joints)
    return stacked(terms.effort(terms.pose_acceleration(still)), (count,))
