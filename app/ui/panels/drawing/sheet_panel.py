"""The sheet: its size, where it lies before the robot, and how large the drawing is on it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import viser

from app.drawing.toolpath import Placement
from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.settings import SHEETS_MM, DrawingSettings
from app.ui.viser_adapter import show_value

FARTHEST_MM = 2000.0


class SheetPanel:
    """The folder `Sheet`. `placing` shows the handles that move the sheet, `look` turns the camera to it."""

    def __init__(
        self, gui: viser.GuiApi, desk: DrawingDesk, placing: Callable[[bool], None], look: Callable[[], None]
    ) -> None:
        self._desk = desk
        self._placing = placing
        self._look = look
        settings = desk.settings
        with gui.add_folder("Sheet"):
            self._size = gui.add_dropdown("Size", tuple(SHEETS_MM), initial_value=settings.sheet)
            self._landscape = gui.add_checkbox("Landscape", settings.landscape)
            self._margin = gui.add_slider("Margin (mm)", 0.0, 40.0, 1.0, settings.look.margin_mm)
            self._scale = gui.add_slider("Scale (%)", 10.0, 100.0, 1.0, 100.0 * settings.look.scale)
            self._move = gui.add_checkbox(
                "Move the sheet", False, hint="Shows handles on the sheet that move and turn it; the robot's own hide"
            )
            self._x = gui.add_number("Sheet x (mm)", 0.0, min=-FARTHEST_MM, max=FARTHEST_MM, step=1.0)
            self._y = gui.add_number("Sheet y (mm)", 0.0, min=-FARTHEST_MM, max=FARTHEST_MM, step=1.0)
            self._height = gui.add_number("Sheet height z (mm)", 0.0, min=-FARTHEST_MM, max=FARTHEST_MM, step=1.0)
            self._turn = gui.add_number("Sheet turned (deg)", 0.0, min=-360.0, max=360.0, step=1.0)
            self._see = gui.add_button("Look at the sheet", icon=viser.Icon.EYE, color="gray")
            self._back = gui.add_button("Put the sheet back", icon=viser.Icon.RESTORE, color="gray")
        self._listen()
        desk.settings_changed.connect(self._follow)
        self._follow(settings)

    def _listen(self) -> None:
        desk = self._desk

        @self._size.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.choose_sheet(event.target.value, self._landscape.value)

        @self._landscape.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            desk.choose_sheet(self._size.value, event.target.value)

        @self._margin.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.turn(margin_mm=event.target.value)

        @self._scale.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.turn(scale=event.target.value / 100.0)

        @self._move.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            self._placing(event.target.value)

        @self._see.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            self._look()

        @self._back.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            desk.move_sheet(None)

        for number in (self._x, self._y, self._height, self._turn):

            @number.on_update
            async def _(_: viser.GuiEvent[viser.GuiNumberHandle[float]]) -> None:
                desk.move_sheet(self._typed())

    def _typed(self) -> Placement:
        """What the numbers say; those that were not changed keep their digits."""
        old = self._desk.placement
        shown = _numbers(old)
        x, y, z, turn = (
            was if field.value == read else field.value * factor
            for was, read, field, factor in zip(
                (*old.centre_m, old.height_m, old.rotation_rad),
                shown,
                (self._x, self._y, self._height, self._turn),
                (1e-3, 1e-3, 1e-3, math.radians(1.0)),
                strict=True,
            )
        )
        return replace(old, centre_m=(x, y), height_m=z, rotation_rad=turn)

    def _follow(self, settings: DrawingSettings) -> None:
        show_value(self._size, settings.sheet)
        show_value(self._landscape, settings.landscape)
        show_value(self._margin, settings.look.margin_mm)
        show_value(self._scale, float(round(100.0 * settings.look.scale)))
        fields = (self._x, self._y, self._height, self._turn)
        for field, value in zip(fields, _numbers(self._desk.placement), strict=True):
            show_value(field, value)


def _numbers(placement: Placement) -> tuple[float, float, float, float]:
    """x, y, z in mm and the turn in degrees, as shown."""
    x, y = placement.centre_m
    turn = math.degrees(placement.rotation_rad)
    return tuple(round(value, 1) + 0.0 for value in (1e3 * x, 1e3 * y, 1e3 * placement.height_m, turn))  # type: ignore[return-value]
