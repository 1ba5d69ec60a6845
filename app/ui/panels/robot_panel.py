"""Choose a robot, read its state, move it by numbers, and change its dimensions."""

from __future__ import annotations

import viser

from app.robots import ROBOTS
from app.ui.panels.geometry_panel import GeometryPanel
from app.ui.panels.pose_panel import PosePanel
from app.ui.panels.status_panel import StatusPanel
from app.ui.session import Session
from app.ui.viser_adapter import show_value


class RobotPanel:
    """The `Robot` tab."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        titles = {entry.title: name for name, entry in ROBOTS.items()}
        choice = gui.add_dropdown("Robot", tuple(titles), initial_value=ROBOTS[session.robot_name].title)

        @choice.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            session.choose_robot(titles[event.target.value])

        def lock(locks: frozenset[str]) -> None:
            choice.disabled = "robot" in locks

        session.robot_changed.connect(lambda robot: show_value(choice, ROBOTS[robot.name].title))
        session.locks_changed.connect(lock)
        lock(session.locks)
        self._status = StatusPanel(gui, session)
        home = gui.add_button("Home", icon=viser.Icon.HOME, hint="Back to the pose in the middle of its reach")

        @home.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            session.go_home()

        self._pose = PosePanel(gui, session)
        GeometryPanel(gui, session)

    def close(self) -> None:
        self._status.close()
        self._pose.close()
