"""What makes the plant differ from the controllers' model of it, and how it is simulated."""

from __future__ import annotations

import viser

from app.robots import ROBOTS
from app.ui.compare.desk import CompareDesk
from app.ui.compare.settings import PLANTS, CompareSettings
from app.ui.panels.motion.knob import Knob
from app.ui.panels.options import show_options
from app.ui.viser_adapter import show_value

IDEAL = "ideal"
ENCODER_STEPS: dict[str, dict[str, float]] = {
    "m": {IDEAL: 0.0, "1 µm": 1e-6, "10 µm": 1e-5, "0.1 mm": 1e-4},
    "rad": {IDEAL: 0.0, "10 µrad": 1e-5, "0.1 mrad": 1e-4, "1 mrad": 1e-3},
}
"""Smallest step that a joint's sensor sees, by the joint's unit."""
FILTERS = {IDEAL: 0.0, "500 Hz": 500.0, "200 Hz": 200.0, "100 Hz": 100.0, "50 Hz": 50.0}
FRICTION_HINT = "In the joints; 1 is what the specification declares"
LOAD_HINT = "At the tool; the controllers know nothing of it"
ERROR_HINT = "Masses in the controllers' model, too large or too small"
DELAY_HINT = "Between computing a torque and applying it"
PLANT_KEYS = {title: key for key, title in PLANTS.items()}


class EffectsPanel:
    """Sliders and choices."""

    def __init__(self, gui: viser.GuiApi, desk: CompareDesk) -> None:
        self._gui, self._desk = gui, desk
        self._knobs = [self._knob("Friction (×)", (0.0, 2.0, 0.25), "friction", FRICTION_HINT)]
        with gui.add_folder("Imperfections", expand_by_default=False):
            self._knobs += [
                self._knob("Unknown load (kg)", (0.0, 2.0, 0.05), "payload_kg", LOAD_HINT),
                self._knob("Model error (%)", (-50.0, 50.0, 5.0), "model_error", ERROR_HINT, 100.0),
            ]
            self._encoder = gui.add_dropdown(
                "Encoder step", tuple(_encoder_steps(desk.settings.robot)), hint="What the joint sensors can tell apart"
            )
            self._knobs.append(self._knob("Delay (samples)", (0, 5, 1), "delay_samples", DELAY_HINT))
            self._filter = gui.add_dropdown("Speed filter", tuple(FILTERS), hint="Of the speed found from the encoder")
            self._limits = gui.add_checkbox("Torque limits", True)
            self._speeds = gui.add_checkbox(
                "Speed limits", False, hint="Beyond its largest speed a drive brakes but does not push"
            )
        self._plant = gui.add_dropdown("Plant", tuple(PLANT_KEYS), hint="What stands in for the real robot")
        self._listen_to_choices()
        desk.settings_changed.connect(self._follow)
        self._follow(desk.settings)

    def _knob(self, label: str, bounds: tuple[float, float, float], name: str, hint: str, factor: float = 1.0) -> Knob:
        return Knob(self._gui, label, bounds, name, factor, self._desk.change, hint)

    def _listen_to_choices(self) -> None:
        desk = self._desk

        @self._encoder.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.change(encoder_step=_encoder_steps(desk.settings.robot).get(event.target.value, 0.0))

        @self._filter.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.change(velocity_filter_hz=FILTERS[event.target.value])

        @self._limits.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            desk.change(limit_effort=event.target.value)

        @self._speeds.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            desk.change(limit_speed=event.target.value)

        @self._plant.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.change(plant=PLANT_KEYS[event.target.value])

    def _follow(self, settings: CompareSettings) -> None:
        steps = _encoder_steps(settings.robot)
        show_options(self._encoder, tuple(steps), _key_of(steps, settings.encoder_step))
        show_value(self._filter, _key_of(FILTERS, settings.velocity_filter_hz))
        for knob in self._knobs:
            knob.show(getattr(settings, knob.name))
        show_value(self._limits, settings.limit_effort)
        show_value(self._speeds, settings.limit_speed)
        show_value(self._plant, PLANTS[settings.plant])


def _encoder_steps(robot: str) -> dict[str, float]:
    return ENCODER_STEPS[ROBOTS[robot].build.joint_unit]


def _key_of(options: dict[str, float], value: float) -> str:
    return next((key for key, other in options.items() if other == value), IDEAL)
