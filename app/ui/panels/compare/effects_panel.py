"""What makes the plant differ from the controllers' model of it, and how it is simulated."""

from __future__ import annotations

import viser

from app.robots import ROBOTS
from app.ui.compare.desk import CompareDesk
from app.ui.compare.settings import PLANTS, CompareSettings
from app.ui.panels.options import show_options
from app.ui.viser_adapter import show_value

IDEAL = "ideal"
ENCODER_STEPS: dict[str, dict[str, float]] = {
    "m": {IDEAL: 0.0, "1 µm": 1e-6, "10 µm": 1e-5, "0.1 mm": 1e-4},
    "rad": {IDEAL: 0.0, "10 µrad": 1e-5, "0.1 mrad": 1e-4, "1 mrad": 1e-3},
}
"""Smallest step that a joint's sensor sees, by the joint's unit."""
FILTERS = {IDEAL: 0.0, "500 Hz": 500.0, "200 Hz": 200.0, "100 Hz": 100.0, "50 Hz": 50.0}
PLANT_KEYS = {title: key for key, title in PLANTS.items()}


class EffectsPanel:
    """Sliders and choices."""

    def __init__(self, gui: viser.GuiApi, desk: CompareDesk) -> None:
        self._desk = desk
        settings = desk.settings
        self._friction = gui.add_slider(
            "Friction (×)",
            0.0,
            2.0,
            0.25,
            settings.friction,
            hint="In the joints; 1 is what the specification declares",
        )
        with gui.add_folder("Imperfections", expand_by_default=False):
            self._payload = gui.add_slider(
                "Unknown load (kg)",
                0.0,
                2.0,
                0.05,
                settings.payload_kg,
                hint="At the tool; the controllers know nothing of it",
            )
            self._error = gui.add_slider(
                "Model error (%)",
                -50.0,
                50.0,
                5.0,
                0.0,
                hint="Masses in the controllers' model, too large or too small",
            )
            steps = _encoder_steps(settings.robot)
            self._encoder = gui.add_dropdown("Encoder step", tuple(steps), hint="What the joint sensors can tell apart")
            self._delay = gui.add_slider(
                "Delay (samples)", 0, 5, 1, settings.delay_samples, hint="Between computing a torque and applying it"
            )
            self._filter = gui.add_dropdown("Speed filter", tuple(FILTERS), hint="Of the speed found from the encoder")
            self._limits = gui.add_checkbox("Torque limits", settings.limit_effort)
            self._speeds = gui.add_checkbox(
                "Speed limits", settings.limit_speed, hint="Beyond its largest speed a drive brakes but does not push"
            )
        self._plant = gui.add_dropdown(
            "Plant", tuple(PLANT_KEYS), initial_value=PLANTS[settings.plant], hint="What stands in for the real robot"
        )
        self._listen_to_numbers()
        self._listen_to_choices()
        desk.settings_changed.connect(self._follow)
        self._follow(settings)

    def _listen_to_numbers(self) -> None:
        desk = self._desk

        @self._friction.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.change(friction=event.target.value)

        @self._payload.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.change(payload_kg=event.target.value)

        @self._error.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.change(model_error=event.target.value / 100.0)

        @self._delay.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[int]]) -> None:
            desk.change(delay_samples=round(event.target.value))

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
        show_value(self._friction, settings.friction)
        show_value(self._payload, settings.payload_kg)
        show_value(self._error, round(100.0 * settings.model_error))
        show_value(self._delay, settings.delay_samples)
        show_value(self._limits, settings.limit_effort)
        show_value(self._speeds, settings.limit_speed)
        show_value(self._plant, PLANTS[settings.plant])


def _encoder_steps(robot: str) -> dict[str, float]:
    return ENCODER_STEPS[ROBOTS[robot].build.joint_unit]


def _key_of(options: dict[str, float], value: float) -> str:
    return next((key for key, other in options.items() if other == value), IDEAL)
