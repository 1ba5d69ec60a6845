"""How the pen is moved: speeds, lift, and a laser in its place."""

from __future__ import annotations

import viser

from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.settings import DrawingSettings
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value

NO_LIFT = "The paper's robot could not lift its pen: it also draws its way from stroke to stroke."
LASER = "A laser burns with a power in proportion to its actual speed, and is off on the way between strokes."


class PenPanel:
    """The folder `Pen`."""

    def __init__(self, gui: viser.GuiApi, desk: DrawingDesk) -> None:
        self._desk = desk
        look, pen = desk.settings.look, desk.settings.pen
        with gui.add_folder("Pen", expand_by_default=False):
            self._width = gui.add_slider("Pen width (mm)", 0.1, 2.0, 0.05, look.pen_mm)
            self._speed = gui.add_slider("Drawing speed (mm/s)", 5.0, 300.0, 5.0, pen.speed_mm_s)
            self._up_speed = gui.add_slider("Travel speed (mm/s)", 20.0, 600.0, 10.0, pen.up_speed_mm_s)
            self._height = gui.add_slider("Lift (mm)", 0.5, 20.0, 0.5, pen.lift_mm)
            self._lift = gui.add_checkbox("Lift the pen", pen.lift, hint="Off: as the robot of the paper")
            self._laser = gui.add_checkbox("Laser", pen.laser, hint="In place of the pen; off unless you switch it on")
            self._about = gui.add_html("", visible=False)
        self._listen()
        desk.settings_changed.connect(self._follow)
        self._follow(desk.settings)

    def _listen(self) -> None:
        desk = self._desk

        @self._width.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.turn(pen_mm=event.target.value)

        @self._speed.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.set_pen(speed_mm_s=event.target.value)

        @self._up_speed.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.set_pen(up_speed_mm_s=event.target.value)

        @self._height.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.set_pen(lift_mm=event.target.value)

        @self._lift.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            desk.set_pen(lift=event.target.value)

        @self._laser.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            desk.set_pen(laser=event.target.value)

    def _follow(self, settings: DrawingSettings) -> None:
        pen = settings.pen
        show_value(self._width, settings.look.pen_mm)
        show_value(self._speed, pen.speed_mm_s)
        show_value(self._up_speed, pen.up_speed_mm_s)
        show_value(self._height, pen.lift_mm)
        show_value(self._lift, pen.lift)
        show_value(self._laser, pen.laser)
        self._lift.disabled = pen.laser
        self._height.disabled = pen.laser or not pen.lift
        about = LASER if pen.laser else "" if pen.lift else NO_LIFT
        if about:
            self._about.content = small(about)
        self._about.visible = bool(about)
