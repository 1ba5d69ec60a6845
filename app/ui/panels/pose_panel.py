"""Pose and joints as numbers, both ways: type a pose, or move a joint and see where the tool goes."""

from __future__ import annotations

import asyncio

import viser

from app.robots import Robot
from app.ui.pacing import Paced
from app.ui.panels.units import labelled, shown, si
from app.ui.session import Session
from app.ui.viser_adapter import show_value

REFRESH_S = 0.15
STEP = 0.5
"""Of a pose field, mm or degrees; viser shows as many decimals as the step has."""

SETTLE_S = 0.3
"""A slider in hand is left alone; this long after its last move it shows the joint's true value again."""


class PosePanel:
    """Folders `Pose` and `Joints`."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        self._gui = gui
        self._session = session
        self._fields: list[viser.GuiNumberHandle[float]] = []
        self._sliders: list[viser.GuiSliderHandle[float]] = []
        self._held: int | None = None
        self._settling: asyncio.TimerHandle | None = None
        self._pace = Paced(self._refresh, REFRESH_S)
        self._pose_folder = gui.add_folder("Pose")
        self._joint_folder = gui.add_folder("Joints")
        session.robot_changed.connect(self._receive)
        session.stance_changed.connect(lambda _: self._pace.request())
        self._build()

    def close(self) -> None:
        self._pace.cancel()
        if self._settling is not None:
            self._settling.cancel()

    def _receive(self, robot: Robot) -> None:
        """New fields for another robot or other joint limits; other dimensions only change what they show."""
        if (robot.name, robot.joint_limits.tolist()) != self._built_for:
            self._build()

    def _build(self) -> None:
        """Make what depends on the robot. The position fields stay, so that nobody types into one that goes."""
        robot, stance = self._session.robot, self._session.stance
        self._built_for = (robot.name, robot.joint_limits.tolist())
        for handle in (*self._fields[3:], *self._sliders):
            handle.remove()
        with self._pose_folder:
            kept = self._fields[:3]
            names = list(enumerate(robot.pose_names))[len(kept) :]
            self._fields = kept + [self._add_field(i, name, stance.pose[i]) for i, name in names]
        with self._joint_folder:
            self._sliders = [self._add_slider(i, name, stance.joints[i]) for i, name in enumerate(robot.joint_names)]

    def _add_field(self, index: int, name: str, value: float) -> viser.GuiNumberHandle[float]:
        unit = _pose_unit(index)
        field = self._gui.add_number(labelled(name, unit), shown(value, unit), step=STEP)

        @field.on_update
        async def _(event: viser.GuiEvent[viser.GuiNumberHandle[float]]) -> None:
            pose = list(self._session.stance.pose)
            pose[index] = si(event.target.value, unit)
            self._session.go(pose)
            self._settle()

        return field

    def _add_slider(self, index: int, name: str, value: float) -> viser.GuiSliderHandle[float]:
        unit = self._session.robot.joint_units[index]
        low, high = (shown(limit, unit) for limit in self._session.robot.joint_limits[index])
        slider = self._gui.add_slider(labelled(name, unit), low, high, 0.1, min(max(shown(value, unit), low), high))

        @slider.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._held = index
            self._session.set_joint(index, si(event.target.value, unit))
            self._settle()

        return slider

    def _settle(self) -> None:
        if self._settling is not None:
            self._settling.cancel()
        self._settling = asyncio.get_running_loop().call_later(SETTLE_S, self._let_go)

    def _let_go(self) -> None:
        self._held = self._settling = None
        self._refresh()

    def _refresh(self) -> None:
        stance, robot = self._session.stance, self._session.robot
        for index, field in enumerate(self._fields):
            show_value(field, shown(stance.pose[index], _pose_unit(index)))
        for index, slider in enumerate(self._sliders):
            if index != self._held:
                value = shown(stance.joints[index], robot.joint_units[index])
                show_value(slider, min(max(value, slider.min), slider.max))


def _pose_unit(index: int) -> str:
    return "m" if index < 3 else "rad"
