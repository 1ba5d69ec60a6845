"""Somebody else's robot on a page, in place of its own, which is hidden and stays as it is."""

from __future__ import annotations

import viser

from app.robots import Robot
from app.signal import Signal
from app.ui.compute import Worker
from app.ui.robot_view import RobotView
from app.ui.shape_cache import ShapeCache
from app.ui.stage import Stage
from app.ui.state import Stance, ViewOptions
from app.ui.viser_adapter import NodeStream

ROOT = "/guest"


class Guest:
    """The robot of a guest, as a `RobotView` shows it."""

    def __init__(self, robot: Robot, stance: Stance) -> None:
        self.robot_changed: Signal[Robot] = Signal()
        self.stance_changed: Signal[Stance] = Signal()
        self.view_changed: Signal[ViewOptions] = Signal()
        self.robot = robot
        self.stance = stance
        self.view = ViewOptions()

    def follow(self, robot: Robot, stance: Stance) -> None:
        """Be like this now. Nobody hears of what has not changed."""
        same_robot, same_stance = robot is self.robot, stance is self.stance
        self.robot, self.stance = robot, stance
        if not same_robot:
            self.robot_changed.emit(robot)
        elif not same_stance:
            self.stance_changed.emit(stance)


class GuestView:
    """Of one page; nothing is made before the first guest comes."""

    def __init__(
        self, client: viser.ClientHandle, own: RobotView, stage: Stage, shapes: ShapeCache, worker: Worker
    ) -> None:
        self._client = client
        self._own = own
        self._stage = stage
        self._shapes = shapes
        self._worker = worker
        self._guest: Guest | None = None
        self._view: RobotView | None = None

    def show(self, robot: Robot, stance: Stance) -> None:
        """Show a guest's robot, or move the one that is shown."""
        if self._guest is None:
            self._guest = Guest(robot, stance)
            stream = NodeStream(self._client)
            self._view = RobotView(self._client, self._guest, stream, self._shapes, self._worker, ROOT)
            self._own.root.visible = False
            self._stage.host(robot)
            return
        if robot is not self._guest.robot:
            self._stage.host(robot)
        self._guest.follow(robot, stance)

    def end(self) -> None:
        """Back to the page's own robot."""
        if self._view is None:
            return
        self._worker.cancel()
        self._view.root.remove()
        self._guest = self._view = None
        self._stage.host(None)
        self._own.root.visible = True
