"""The robot's other selves, translucent: the pose held with other elbows, the joints assembled another way."""

from __future__ import annotations

import viser

from app.robots import Robot
from app.robots.parts import Machine, machine_of
from app.ui.ghost_nodes import Configuration, GhostNodes
from app.ui.pacing import Paced
from app.ui.robot_view import part_color
from app.ui.session import Session
from app.ui.shape_cache import ShapeCache

REFRESH_S = 0.1
OPACITY = 0.28


class Ghosts:
    """What the view options ask for."""

    def __init__(self, client: viser.ClientHandle, session: Session, shapes: ShapeCache) -> None:
        self._session = session
        self._machine: Machine | None = None
        self._nodes = GhostNodes(client.scene, shapes, "/robot/ghosts", part_color, OPACITY)
        self._pace = Paced(self._refresh, REFRESH_S)
        session.robot_changed.connect(self._change_machine)
        session.view_changed.connect(lambda _: self._request())
        session.stance_changed.connect(lambda _: self._request())
        self._change_machine(session.robot)

    def close(self) -> None:
        self._pace.cancel()

    def _change_machine(self, robot: Robot) -> None:
        self._nodes.clear()
        self._machine = machine_of(robot)
        self._request()

    def _request(self) -> None:
        if self._session.view.elbows or self._session.view.assemblies or self._nodes.shown:
            self._pace.request()

    def _refresh(self) -> None:
        ghosts = configurations(self._session)
        if ghosts and self._machine is not None:
            self._nodes.show(self._machine, ghosts)
        else:
            self._nodes.clear()


def configurations(session: Session) -> list[Configuration]:
    """Pose and joints of every ghost that the view options ask for."""
    robot, stance, view = session.robot, session.stance, session.view
    ghosts: list[Configuration] = []
    if view.elbows:
        ghosts += [(stance.pose, mode) for mode in robot.working_modes(stance.pose)[1:].tolist()]
    if view.assemblies:
        modes = robot.assemblies(stance.joints)
        ghosts += [(mode.pose.tolist(), stance.joints) for mode in modes if not mode.valid]
    return ghosts
