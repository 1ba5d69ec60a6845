"""What every page has of the robot on the table: a desk, and the robot in its picture, as soon as there is one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import viser

from app.ui.desks import Desks
from app.ui.gizmo import Gizmo
from app.ui.hardware.sign_of_life import SignOfLife
from app.ui.shape_cache import ShapeCache

if TYPE_CHECKING:
    from app.link.status import LinkStatus
    from app.ui.hardware.desk import HardwareDesk
    from app.ui.hardware.mirror import Mirror


class _Present(NamedTuple):
    desk: HardwareDesk
    mirror: Mirror


class RobotAccess:
    """Of one browser. Nothing of the link is loaded before there is a robot, or somebody opens the tab Hardware."""

    def __init__(
        self,
        client: viser.ClientHandle,
        desks: Desks,
        gizmo: Gizmo,
        shapes: ShapeCache,
    ) -> None:
        self._client = client
        self._desks = desks
        self._gizmo = gizmo
        self._shapes = shapes
        self._present: _Present | None = None
        self._waiting: list[Callable[[HardwareDesk], None]] = []
        self._leave = desks.workshop.watch.attend(self._look)

    @property
    def desk(self) -> HardwareDesk:
        """The same for all panels of the page."""
        return self._get().desk

    @property
    def mirror(self) -> Mirror:
        return self._get().mirror

    def when_needed(self, furnish: Callable[[HardwareDesk], None]) -> None:
        """Call this with the desk, now or as soon as there is one."""
        if self._present is None:
            self._waiting.append(furnish)
        else:
            furnish(self._present.desk)

    def close(self) -> None:
        self._leave()
        if self._present is not None:
            self._present.mirror.close()

    def _look(self, status: LinkStatus) -> None:
        if status.phase != "none":
            self._get()

    def _get(self) -> _Present:
        if self._present is None:
            self._leave()
            self._present = self._make()
            waiting, self._waiting = self._waiting, []
            for furnish in waiting:
                furnish(self._present.desk)
            self._present.desk.open()
        return self._present

    def _make(self) -> _Present:
        from app.ui.hardware.follower import Follower
        from app.ui.hardware.mirror import Mirror
        from app.ui.hardware.robot_ghost import RobotGhost

        desk = self._desks.hardware
        life = SignOfLife(self._client, desk.alive)
        desk.status_changed.connect(lambda _: life.want(desk.engaged))
        desk.me_changed.connect(lambda _: life.want(desk.engaged))
        mirror = Mirror(desk, self._gizmo)
        Follower(desk, self._gizmo)
        RobotGhost(self._client, desk, self._shapes)
        return _Present(desk, mirror)
