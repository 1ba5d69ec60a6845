"""The verdict on one pose: can the robot stand there, and if not, what stops it."""

from __future__ import annotations

from typing import NamedTuple


class Reach(NamedTuple):
    """Whether a pose lies inside reach and limits."""

    ok: bool
    reason: str = ""
    """Why not, in words a student understands; empty when `ok`."""
    leg: int | None = None
    """Number of the offending leg, counted from 1 as in the papers; None where no single leg is to blame."""
    joints: tuple[float, ...] | None = None
    """The joints of the pose where the loop closes, also when they exceed a limit; else None."""


NOT_A_NUMBER = Reach(False, "The pose is not a number.")
