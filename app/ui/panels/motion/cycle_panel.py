"""The work cycle of the five-bar robot: from belt to belt, as fast as the belts run."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import viser

from app.motion import CYCLES, MotionSettings, WorkCycle
from app.ui.motion.desk import WITH_CYCLE, MotionDesk
from app.ui.panels.motion.knob import Knob
from app.ui.panels.options import show_options
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value

COURSE, CYCLE = "Along a curve", "Work cycle"
OWN = "My own"
ABOUT = (
    "The tool meets an item on a moving belt, goes down, grasps it, and puts it on the belt that moves the other way. "
    "W1 is as fast as the paper's cycle; W2 goes deeper, which loads the screw as much as the paper reports."
)
MOTOR_SPEED = "Refuses a cycle that asks the motors for more speed than they have; the paper's W2 does"


class CyclePanel:
    """What to show, and the folder `Work cycle`; only for the robot that has the belts."""

    def __init__(self, gui: viser.GuiApi, desk: MotionDesk) -> None:
        self._desk = desk
        self._choice = gui.add_dropdown("Show", (COURSE, CYCLE), initial_value=COURSE)
        self._folder = gui.add_folder("Work cycle", visible=False)
        presets: tuple[str, ...] = tuple(CYCLES)
        with self._folder:
            gui.add_html(small(ABOUT))
            self._preset = gui.add_dropdown("Preset", presets)
            change = desk.change_cycle
            self._knobs = [
                Knob(gui, "Belt speed (mm/s)", (0.0, 400.0, 5.0), "belt_speed_m_s", 1e3, change),
                Knob(gui, "Stroke (mm)", (1.0, 40.0, 1.0), "stroke_m", 1e3, change),
                Knob(gui, "Cycle time (s)", (1.5, 6.0, 0.02), "period_s", 1.0, change),
                Knob(gui, "Mass of an item (kg)", (0.0, 5.0, 0.05), "payload_kg", 1.0, change),
            ]
            self._enforce = gui.add_checkbox("Enforce motor speed", True, hint=MOTOR_SPEED)
        self._listen()
        desk.settings_changed.connect(self._follow)
        self._follow(desk.settings)

    def _listen(self) -> None:
        desk = self._desk

        @self._choice.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[Any]]) -> None:
            desk.show_cycle(event.target.value == CYCLE)

        @self._preset.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            if event.target.value in CYCLES:
                desk.take_cycle(CYCLES[event.target.value])

        @self._enforce.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            desk.change_cycle(enforce_motor_speed=event.target.value)

    def _follow(self, _: MotionSettings | WorkCycle) -> None:
        desk, cycle = self._desk, self._desk.cycle
        has_belts = desk.robot.name == WITH_CYCLE
        for element, shown in ((self._choice, has_belts), (self._folder, has_belts and desk.cycling)):
            if element.visible != shown:
                element.visible = shown
        show_value(self._choice, CYCLE if desk.cycling else COURSE)
        known = next((name for name, one in CYCLES.items() if replace(one, dimensions=cycle.dimensions) == cycle), None)
        show_options(self._preset, (*CYCLES, *(() if known else (OWN,))), known or OWN)
        show_value(self._enforce, cycle.enforce_motor_speed)
        for knob in self._knobs:
            knob.show(getattr(cycle, knob.name))
