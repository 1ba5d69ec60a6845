"""What every planned movement of a tool offers: where it should be, how fast, and how it speeds up."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class MotionError(ValueError):
    """A motion that cannot be planned; the message is one sentence for the user."""


class Sample(NamedTuple):
    """A movement at k instants, in metres, radians and seconds."""

    pose: Array
    """(k, dof)"""
    rate: Array
    """(k, dof) first derivative by time."""
    acceleration: Array
    """(k, dof) second derivative by time."""


class Trajectory(Protocol):
    """Plain data, so that it can be sent to another process."""

    @property
    def title(self) -> str: ...

    @property
    def duration_s(self) -> float: ...

    def sample(self, t: ArrayLike) -> Sample:
        """At times t (k,), s; at rest where it begins and ends before 0 and after `duration_s`."""
        ...


class Law(Protocol):
    """One number, or several, over another: what time laws and rounded corners are made of."""

    def at(self, u: ArrayLike) -> tuple[Array, Array, Array]:
        """Value, first and second derivative at u (k,); constant beyond both ends, its derivatives 0 there."""
        ...
