"""The robot on the table follows the gizmo, while its holder wants that."""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.link.protocol.codes import State
from app.link.status import LinkStatus
from app.signal import Signal
from app.ui.gizmo import Gizmo
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.follower import stand_as_commanded
from app.ui.hardware.verbs import not_free, not_in_control
from app.ui.pacing import Paced

INTERVAL_S = 1.0 / 30.0
"""Between two poses."""

THERE = 5e-4
"""m or rad: as near to the last pose, the robot has arrived."""

PATIENCE_S = 15.0
TICK_S = 0.05

OTHER_ROBOT = "The picture shows another robot than the one on the table: press Show at the top of the tab Hardware."


class Mirror:
    """Switched on, the picture shows where the robot stands; only a new drag moves the robot."""

    def __init__(self, desk: HardwareDesk, gizmo: Gizmo) -> None:
        self.switched: Signal[bool] = Signal()
        self.on = False
        self._desk = desk
        self._dragging = False
        self._waits_s: float | None = None
        """Since the gizmo was let go; None while it is held, and after the robot has arrived."""
        self._goal: Sequence[float] = ()
        self._pace = Paced(self._send, INTERVAL_S)
        gizmo.held.connect(self._take)
        desk.session.stance_changed.connect(lambda _: self._move())
        desk.tick.connect(self._follow)

    def switch(self, on: bool) -> None:
        """What cannot be is told, and stays off."""
        if on and not self.on:
            refusal = not_free(self._desk.status, self._desk.me) or ("" if self._desk.shows_it else OTHER_ROBOT)
            if refusal:
                self._desk.tell(refusal)
                self.switched.emit(False)
                return
            self.on = True
            stand_as_commanded(self._desk, self._desk.status)
            self.switched.emit(True)
        elif not on:
            self._end()

    def close(self) -> None:
        """The page is gone: so is the hand."""
        self._end()

    def _take(self, held: bool) -> None:
        if held:
            self._dragging, self._waits_s = self.on, None
        elif self._dragging:
            self._dragging = False
            if self._goal:
                self._waits_s = 0.0
                self._goal = self._desk.session.stance.pose
                self._pace.request()

    def _move(self) -> None:
        if self._dragging:
            self._goal = self._desk.session.stance.pose
            self._pace.request()

    def _send(self) -> None:
        if self.on and self._goal:
            self._desk.mirror(tuple(self._goal), self._end)

    def _follow(self, status: LinkStatus) -> None:
        if not self.on:
            return
        if _is_over(self._desk, status):
            self._end()
        elif self._waits_s is not None:
            self._wait(status, self._waits_s + TICK_S)
        elif not self._dragging:
            stand_as_commanded(self._desk, status)

    def _wait(self, status: LinkStatus, waited_s: float) -> None:
        self._waits_s = waited_s
        pose = status.commanded_pose
        arrived = pose is not None and math.dist(pose, self._goal) < THERE
        if arrived or waited_s > PATIENCE_S:
            self._let_go()

    def _let_go(self) -> None:
        self._pace.cancel()
        self._waits_s = None
        if self._goal:
            self._goal = ()
            self._desk.mirror_end()

    def _end(self) -> None:
        if self.on:
            self.on = self._dragging = False
            self._let_go()
            self.switched.emit(False)


def _is_over(desk: HardwareDesk, status: LinkStatus) -> bool:
    """Control lost, stopped, a fault, held, or no connection."""
    if not_in_control(status, desk.me) or status.telemetry is None or not desk.shows_it:
        return True
    return status.telemetry.state not in (State.READY, State.MOVING)
