"""The robot on the table where its sensors see it, as a ghost beside the one in the picture."""

from __future__ import annotations

from collections.abc import Sequence

import viser

from app.link.status import LinkStatus
from app.robots.parts import Machine, Part, machine_of
from app.ui import theme
from app.ui.ghost_nodes import GhostNodes
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.whereabouts import Place, measured
from app.ui.shape_cache import ShapeCache

ROOT = "/robot/measured"
OPACITY = 0.5
APART = {"rad": 0.008, "m": 0.001}
"""A joint must be so far from that of the picture (rad or m) for a ghost to be seen; half of it, for it to stay."""

MOVED = 1e-4
"""rad or m: less is noise of a sensor."""


class RobotGhost:
    """Follows the desk's news, 20 times a second at most; where both robots coincide there is nothing to show."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk, shapes: ShapeCache) -> None:
        self._client = client
        self._desk = desk
        self._nodes = GhostNodes(client.scene, shapes, ROOT, _paint, OPACITY)
        self._machine: Machine | None = None
        self._joints: Sequence[float] = ()
        desk.session.robot_changed.connect(lambda _: self._forget())
        desk.tick.connect(self._follow)

    def _follow(self, status: LinkStatus) -> None:
        place = self._place(status)
        if place is None or not self._is_apart(place.joints):
            self._forget()
            return
        joints = place.joints
        if self._nodes.shown and max(abs(a - b) for a, b in zip(joints, self._joints, strict=True)) < MOVED:
            return
        if self._machine is None:
            self._machine = machine_of(self._desk.session.robot)
        self._joints = joints
        self._nodes.show(self._machine, [place])
        self._client.flush()

    def _place(self, status: LinkStatus) -> Place | None:
        """Where the robot is; None where that is not wanted, not known, or another robot's."""
        if not self._desk.session.view.measured or not self._desk.shows_it:
            return None
        return measured(status)

    def _is_apart(self, joints: Sequence[float]) -> bool:
        robot, stance = self._desk.session.robot, self._desk.session.stance
        enough = APART[robot.joint_unit] * (0.5 if self._nodes.shown else 1.0)
        return max(abs(a - b) for a, b in zip(joints, stance.joints, strict=True)) > enough

    def _forget(self) -> None:
        self._machine = None
        if self._nodes.shown:
            self._nodes.clear()
            self._client.flush()


def _paint(part: Part, leg: int | None) -> theme.Rgb:
    return theme.ACTUAL
