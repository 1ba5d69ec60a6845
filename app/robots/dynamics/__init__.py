"""Dynamics of the robots: what moves them, on one state in microseconds or on many at once."""

from __future__ import annotations

from app.robots.dynamics.delta3 import Delta3Dynamics
from app.robots.dynamics.dynamics import Dynamics
from app.robots.dynamics.fivebar import FiveBarDynamics
from app.robots.dynamics.inertia import (
    GRAVITY,
    INERTIA,
    Delta3Inertia,
    FiveBarInertia,
    Inertia,
    InertiaError,
    LinearInertia,
    Par4Inertia,
)
from app.robots.dynamics.linear import LinearDynamics
from app.robots.dynamics.par4 import Par4Dynamics
from app.robots.dynamics.terms import Terms
from app.robots.robot import Robot

__all__ = [
    "GRAVITY",
    "INERTIA",
    "Delta3Inertia",
    "Dynamics",
    "FiveBarInertia",
    "Inertia",
    "InertiaError",
    "LinearInertia",
    "Par4Inertia",
    "Terms",
    "dynamics_of",
]

_DYNAMICS: dict[str, type[Dynamics]] = {
    "par4": Par4Dynamics,
    "delta3": Delta3Dynamics,
    "linear": LinearDynamics,
    "fivebar": FiveBarDynamics,
}


def dynamics_of(robot: Robot, inertia: Inertia | None = None) -> Dynamics:
    """The robot's dynamics; with its declared masses where none are given.

    Raises:
        InertiaError: for masses of another robot.
    """
    declared = INERTIA[robot.name]
    if inertia is not None and not isinstance(inertia, type(declared)):
        raise InertiaError(f"The {robot.title} needs a {type(declared).__name__}, not a {type(inertia).__name__}.")
    return _DYNAMICS[robot.name](robot, inertia or declared)
