"""What is shown beside the robot: workspace, vectors, ghosts, trace, camera, theme."""

from __future__ import annotations

import math
from typing import cast, get_args

import viser

from app.ui.overlay import Overlay
from app.ui.panels.units import GREEK
from app.ui.session import Session
from app.ui.stage import DIRECTIONS, Stage, View
from app.ui.state import ViewOptions, WorkspaceStyle
from app.ui.viser_adapter import show_value

NO_LEG = "None"


class ViewPanel:
    """The `View` tab."""

    def __init__(self, gui: viser.GuiApi, session: Session, stage: Stage, overlay: Overlay) -> None:
        self._gui = gui
        self._session = session
        self._built_for = ""
        self._angle: viser.GuiSliderHandle[float] | None = None
        self._leg: viser.GuiDropdownHandle[str] | None = None
        self._switches: dict[str, viser.GuiCheckboxHandle] = {}
        with gui.add_folder("Camera"):
            self._add_cameras(stage)
        with gui.add_folder("Workspace") as self._workspace_folder:
            self._add_workspace_style()
        with gui.add_folder("On the robot") as self._robot_folder:
            self._add_switch("frames", "Coordinate frames")
            self._add_switch("trace", "Trace of the tool")
            self._add_switch("elbows", "Other elbow solutions")
            self._add_switch("assemblies", "Other assembly modes")
        self._add_switch("dark", "Dark theme")
        self._add_switch("shadows", "Shadows")
        self._add_reset(stage, overlay)
        session.robot_changed.connect(lambda _: self._follow_robot())
        session.view_changed.connect(lambda _: self._follow_view())
        self._follow_robot()

    def _add_cameras(self, stage: Stage) -> None:
        views = self._gui.add_button_group("Look from", tuple(DIRECTIONS))

        @views.on_click
        async def _(_: object) -> None:
            stage.look(cast(View, views.value))

    def _add_workspace_style(self) -> None:
        self._style = self._gui.add_dropdown(
            "Show as", get_args(WorkspaceStyle), initial_value=self._session.view.workspace
        )

        @self._style.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._session.show(workspace=event.target.value)

        self._gui.add_html(
            '<div style="padding:0 12px;font-size:0.8em;opacity:0.8"><div style="height:8px;border-radius:4px;'
            'background:linear-gradient(90deg,#440154,#3b528b,#21918c,#5ec962,#fde725)"></div>'
            '<div style="display:flex;justify-content:space-between"><span>near a singularity</span>'
            "<span>moves evenly</span></div></div>"
        )

    def _add_switch(self, option: str, label: str) -> None:
        switch = self._gui.add_checkbox(label, getattr(self._session.view, option))
        self._switches[option] = switch

        @switch.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            self._session.show(**{option: event.target.value})

    def _add_reset(self, stage: Stage, overlay: Overlay) -> None:
        clear = self._gui.add_button("Clear trace", icon=viser.Icon.ERASER)
        reset = self._gui.add_button("Reset view", icon=viser.Icon.RESTORE)

        @clear.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            overlay.clear_trace()

        @reset.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            defaults = ViewOptions(dark=self._session.view.dark, shadows=self._session.view.shadows)
            self._session.show(**{name: getattr(defaults, name) for name in vars(defaults)})
            stage.look("3-D")

    def _follow_robot(self) -> None:
        if self._built_for == self._session.robot_name:
            return
        self._built_for = self._session.robot_name
        for handle in (self._angle, self._leg):
            if handle is not None:
                handle.remove()
        self._angle = self._leg = None
        robot = self._session.robot
        if robot.rotation_name is not None:
            with self._workspace_folder:
                self._add_angle(GREEK[robot.rotation_name], round(math.degrees(robot.rotation_limit)))
        with self._robot_folder:
            self._add_leg(robot.legs)

    def _add_angle(self, name: str, limit: int) -> None:
        value = min(max(round(math.degrees(self._session.view.workspace_angle)), -limit), limit)
        self._angle = self._gui.add_slider(f"At {name} (deg)", -float(limit), float(limit), 5.0, float(value))

        @self._angle.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._session.show(workspace_angle=math.radians(event.target.value))

    def _add_leg(self, legs: int) -> None:
        options = (NO_LEG, *(f"Leg {i + 1}" for i in range(legs)))
        chosen = self._session.view.vectors_leg
        value = options[0] if chosen is None or chosen >= legs else options[chosen + 1]
        self._leg = self._gui.add_dropdown("Loop vectors", options, initial_value=value)

        @self._leg.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            index = options.index(event.target.value)
            self._session.show(vectors_leg=index - 1 if index else None)

    def _follow_view(self) -> None:
        view = self._session.view
        show_value(self._style, view.workspace)
        for option, switch in self._switches.items():
            show_value(switch, getattr(view, option))
        if self._angle is not None:
            show_value(self._angle, float(round(math.degrees(view.workspace_angle))))
        if self._leg is not None:
            show_value(self._leg, NO_LEG if view.vectors_leg is None else f"Leg {view.vectors_leg + 1}")
