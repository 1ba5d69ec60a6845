"""The robot's dimensions as sliders: robot, workspace and shapes follow."""

from __future__ import annotations

import html

import viser

from app.robots import ROBOTS, GeometryError
from app.ui import theme
from app.ui.panels.units import labelled, shown, si
from app.ui.session import Session
from app.ui.viser_adapter import show_value


class GeometryPanel:
    """The folder `Geometry`, closed at first."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        self._gui = gui
        self._session = session
        self._built_for = ""
        self._sliders: dict[str, viser.GuiSliderHandle[float]] = {}
        self._others: list[viser.GuiDropdownHandle[str] | viser.GuiButtonHandle | viser.GuiHtmlHandle] = []
        self._folder = gui.add_folder("Geometry", expand_by_default=False)
        session.robot_changed.connect(lambda _: self._follow())
        session.locks_changed.connect(lambda _: self._lock())
        self._build()

    def _build(self) -> None:
        for handle in (*self._sliders.values(), *self._others):
            handle.remove()
        self._built_for = self._session.robot_name
        with self._folder:
            self._others = []
            self._add_presets()
            self._sliders = {
                name: self._add_slider(name)
                for name, dimension in self._session.robot.geometry.dimensions().items()
                if dimension.essential and dimension.unit == "m"
            }
            self._refusal = self._gui.add_html("")
            reset = self._gui.add_button("Reset geometry", icon=viser.Icon.RESTORE)
            self._others += [self._refusal, reset]
        self._lock()

        @reset.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            self._session.reset_geometry()

    def _lock(self) -> None:
        """In some steps of a lesson the dimensions stay as they are."""
        for handle in (*self._sliders.values(), *self._others):
            if not isinstance(handle, viser.GuiHtmlHandle):
                handle.disabled = "geometry" in self._session.locks

    def _add_presets(self) -> None:
        presets = tuple(ROBOTS[self._session.robot_name].presets)
        if len(presets) < 2:
            return
        choice = self._gui.add_dropdown("Preset", presets, initial_value=presets[0])
        self._others.append(choice)

        @choice.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._session.choose_preset(event.target.value)

    def _add_slider(self, name: str) -> viser.GuiSliderHandle[float]:
        dimension = self._session.robot.geometry.dimensions()[name]
        low, high = shown(dimension.low, "m"), shown(dimension.high, "m")
        value = shown(getattr(self._session.robot.geometry, name), "m")
        slider = self._gui.add_slider(f"{dimension.label} {labelled(name, 'm')}", low, high, 1.0, value)

        @slider.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._change(name, si(event.target.value, "m"))

        return slider

    def _change(self, name: str, value: float) -> None:
        try:
            self._session.reshape(**{name: value})
        except GeometryError as refusal:
            color = theme.css(theme.WARNING)
            self._refusal.content = (
                f'<div style="padding:0 12px;font-size:0.85em;color:{color}">▲ {html.escape(str(refusal))}</div>'
            )

    def _follow(self) -> None:
        if self._built_for != self._session.robot_name:
            self._build()
            return
        self._refusal.content = ""
        for name, slider in self._sliders.items():
            show_value(slider, shown(getattr(self._session.robot.geometry, name), "m"))
