"""Which map, and of which slice of the workspace."""

from __future__ import annotations

import math

import viser

from app.robots.maps import MAPS, MapSettings
from app.robots.slices import heights
from app.ui.motion.map_desk import MapDesk
from app.ui.panels.motion.knob import Knob
from app.ui.panels.motion.map_texts import color_bar
from app.ui.panels.options import show_options
from app.ui.panels.text import small
from app.ui.panels.units import GREEK
from app.ui.viser_adapter import show_value

TITLES = {quantity.title: name for name, quantity in MAPS.items()}
FASTEST = 100.0
HIGHEST, LOWEST = (FASTEST, FASTEST, FASTEST), (-FASTEST, -FASTEST, -FASTEST)
"""Components of an acceleration, m/s^2."""


class MapSettingsPanel:
    """The folder `Maps`. Its knobs are those that the quantity has; on a phone the colour scale stands among them."""

    def __init__(self, gui: viser.GuiApi, desk: MapDesk, with_colors: bool) -> None:
        self._gui = gui
        self._desk = desk
        self._fitted_for: tuple[str, dict[str, float]] | None = None
        with gui.add_folder("Maps", expand_by_default=False):
            self._on = gui.add_checkbox("Show a map", desk.on, hint="Colours a horizontal slice of the workspace")
            self._quantity = gui.add_dropdown("Quantity", tuple(TITLES))
            self._note = gui.add_html("")
            self._bar = gui.add_html("", visible=False) if with_colors else None
            self._add_knobs()
        self._listen()
        desk.changed.connect(self._follow)
        desk.answered.connect(lambda _: self._show_bar())
        self._follow(desk.settings)

    def _add_knobs(self) -> None:
        gui, change, joints = self._gui, self._desk.change, self._joint_names
        self._height = gui.add_slider("Slice height (mm)", -1000.0, 1000.0, 1.0, 0.0)
        self._turn = gui.add_slider("Slice at (deg)", -180.0, 180.0, 5.0, 0.0)
        self._knobs = [
            Knob(gui, "Acceleration (m/s²)", (0.5, 60.0, 0.1), "acceleration", 1.0, change),
            Knob(gui, "Tool speed (m/s)", (0.02, 4.0, 0.02), "speed", 1.0, change),
            Knob(gui, "Carried (kg)", (0.0, 2.0, 0.05), "payload_kg", 1.0, change),
        ]
        self._joint = gui.add_dropdown("Torque of", joints)
        self._vector = gui.add_vector3(
            "Along x, y, z (m/s²)", (0.0, 0.0, 0.0), min=LOWEST, max=HIGHEST, step=0.1, hint="Acceleration of the tool"
        )

    @property
    def _joint_names(self) -> tuple[str, ...]:
        return self._desk.robot.joint_names

    def _listen(self) -> None:
        desk = self._desk

        @self._on.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            desk.show(event.target.value)

        @self._quantity.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.change(quantity=TITLES[event.target.value])

        @self._height.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.change(height_m=1e-3 * event.target.value)

        @self._turn.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.change(rotation_rad=math.radians(event.target.value))

        @self._joint.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.change(joint=self._joint_names.index(event.target.value))

        @self._vector.on_update
        async def _(event: viser.GuiEvent[viser.GuiVector3Handle]) -> None:
            x, y, z = (min(max(float(v), -FASTEST), FASTEST) for v in event.target.value)
            desk.change(vector=(x, y, z))

    def _follow(self, settings: MapSettings) -> None:
        self._fit(settings)
        quantity = MAPS[settings.quantity]
        show_value(self._on, self._desk.on)
        show_value(self._quantity, quantity.title)
        note = small(quantity.note)
        if note != self._note.content:
            self._note.content = note
        height = float(round(1e3 * settings.height_m))
        show_value(self._height, min(max(height, self._height.min), self._height.max))
        show_value(self._turn, round(math.degrees(settings.rotation_rad)))
        for knob in self._knobs:
            knob.visible = knob.name in quantity.uses
            knob.show(getattr(settings, knob.name))
        for element, name in ((self._joint, "joint"), (self._vector, "vector")):
            if element.visible != (name in quantity.uses):
                element.visible = name in quantity.uses
        show_options(self._joint, self._joint_names, self._joint_names[settings.joint])
        show_value(self._vector, settings.vector)

    def _fit(self, settings: MapSettings) -> None:
        """Sliders that end where this robot does."""
        if self._fitted_for == (settings.robot, settings.dimensions):
            return
        self._fitted_for = settings.robot, settings.dimensions
        robot = self._desk.robot
        low, high = heights(robot)
        self._height.min, self._height.max = float(math.ceil(1e3 * low)), float(math.floor(1e3 * high))
        self._turn.visible = robot.rotation_name is not None
        if robot.rotation_name is not None:
            limit = float(math.floor(math.degrees(robot.rotation_limit) / 5.0) * 5.0)
            self._turn.label = f"Slice at {GREEK[robot.rotation_name]} (deg)"
            self._turn.min, self._turn.max = -limit, limit

    def _show_bar(self) -> None:
        if self._bar is not None:
            picture = self._desk.picture
            self._bar.visible = picture is not None
            self._bar.content = "" if picture is None else color_bar(picture)
