"""The robot in the picture, standing where the one on the table is commanded to be."""

from __future__ import annotations

from app.link.protocol.codes import State
from app.link.status import LinkStatus
from app.ui.gizmo import Gizmo
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.whereabouts import commanded

NEAR = 1e-5
"""rad or m: closer joints are the same."""


class Follower:
    """While the view option asks for it, and the robot moves. A hand on the gizmo comes first."""

    def __init__(self, desk: HardwareDesk, gizmo: Gizmo) -> None:
        self._desk = desk
        self._in_hand = self._moved = False
        gizmo.held.connect(self._take)
        desk.tick.connect(self._follow)

    def _take(self, held: bool) -> None:
        self._in_hand = held

    def _follow(self, status: LinkStatus) -> None:
        moves = is_moving(status)
        if self._desk.session.view.follow and not self._in_hand and (moves or self._moved):
            stand_as_commanded(self._desk, status)
        self._moved = moves


def is_moving(status: LinkStatus) -> bool:
    """Moved by somebody else than the gizmo."""
    if status.activity == "mirror" or status.telemetry is None:
        return False
    return status.activity not in ("idle", "paused") or status.telemetry.state in (State.MOVING, State.HOMING)


def stand_as_commanded(desk: HardwareDesk, status: LinkStatus) -> None:
    """Put the robot in the picture where the board's set-point is, if that is known."""
    session, place = desk.session, commanded(status)
    if place is None or not desk.shows_it:
        return
    if max(abs(a - b) for a, b in zip(place.joints, session.stance.joints, strict=True)) > NEAR:
        session.replay(*place)
