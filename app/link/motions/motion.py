"""What every motion is: asked for the next target at each set-point."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from app.link.status import Activity

Joints = tuple[float, ...]


class Target(NamedTuple):
    """Where the joints should be next."""

    joints: Joints
    """(n,) rad or m"""
    manual: bool = True
    """The board limits the tool's speed."""
    pen_down: bool | None = None
    """None leaves the pen as it is."""
    laser: float = 0.0
    """Share of the power, 0 to 1."""


class Motion(Protocol):
    """Begins at rest where the board's set-point stands."""

    @property
    def activity(self) -> Activity: ...

    @property
    def finished(self) -> bool:
        """Whether it rests at its end for good."""
        ...

    @property
    def notice(self) -> str:
        """Why it stands still, in a sentence; empty while it does not."""
        ...

    def advance(self, dt_s: float, share: float) -> Target:
        """The target `dt_s` after the last one; `share` (0.05 to 1) of the speed."""
        ...
