"""How the picture becomes strokes: preset, mode, and the knobs of the mode."""

from __future__ import annotations

import html

import viser

from app.drawing.modes import DRAWING_MODES, PRESETS
from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.jobs import Sketch
from app.ui.drawing.settings import DrawingSettings
from app.ui.panels.drawing.knobs import Knobs
from app.ui.panels.drawing.preview_panel import mode_title
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value

NO_PRESET = "Choose one …"
MODE_TITLES = {mode.title: name for name, mode in DRAWING_MODES.items()}
PRESET_TITLES = {preset.title: name for name, preset in PRESETS.items()}


class LookPanel:
    """The folder `How to draw it`."""

    def __init__(self, gui: viser.GuiApi, desk: DrawingDesk) -> None:
        self._desk = desk
        self._folder = gui.add_folder("How to draw it")
        with self._folder:
            self._preset = gui.add_dropdown("Start from", (NO_PRESET, *PRESET_TITLES), initial_value=NO_PRESET)
            title = DRAWING_MODES[desk.settings.look.mode].title
            self._mode = gui.add_dropdown("Mode", tuple(MODE_TITLES), initial_value=title)
            self._about = gui.add_html("")
            self._knobs = Knobs(gui, desk.turn)
            self._reset = gui.add_button("Reset these", icon=viser.Icon.RESTORE, color="gray")
        self._listen()
        desk.settings_changed.connect(self._follow)
        desk.sketched.connect(self._explain)
        self._follow(desk.settings)

    def _listen(self) -> None:
        desk = self._desk

        @self._preset.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            if event.target.value in PRESET_TITLES:
                desk.choose_preset(PRESET_TITLES[event.target.value])

        @self._mode.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.choose_mode(MODE_TITLES[event.target.value])

        @self._reset.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            desk.choose_mode(desk.settings.look.mode)

    def _follow(self, settings: DrawingSettings) -> None:
        is_picture = self._desk.source is None or self._desk.source.grey is not None
        if self._folder.visible != is_picture:  # what is strokes already has no knobs
            self._folder.visible = is_picture
        mode = DRAWING_MODES[settings.look.mode]
        show_value(self._mode, mode.title)
        look = settings.look
        fitting = (one.title for one in PRESETS.values() if (one.mode, one.parameters) == (look.mode, look.parameters))
        chosen = next(fitting, NO_PRESET)
        show_value(self._preset, chosen)
        self._knobs.show(mode.parameters, look.parameters)
        self._say(mode.explanation)

    def _explain(self, sketch: Sketch) -> None:
        """What `auto` has chosen, and why."""
        if sketch.look.mode == self._desk.settings.look.mode == "auto":
            self._say(f"{sketch.reason} Mode: {mode_title(sketch.mode)}.")

    def _say(self, sentence: str) -> None:
        content = small(html.escape(sentence))
        if content != self._about.content:
            self._about.content = content
