"""What is compared: the task, the control laws, and how their gains are found."""

from __future__ import annotations

import html

import viser

from app.control.laws import LAWS
from app.ui.compare.desk import CompareDesk
from app.ui.compare.settings import GAINS, TASKS, CompareSettings, tasks_for
from app.ui.panels.options import show_options
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value

LOWEST_HZ, HIGHEST_HZ = 2.0, 120.0

GAIN_KEYS = {title: key for key, title in GAINS.items()}
TASK_KEYS = {task.title: key for key, task in TASKS.items()}
ABOUT_GAINS = {
    "standard": "The gains of the specification: there, too, all laws have the same bandwidth.",
    "equal": "Every law reacts equally fast, so what differs is the law itself.",
    "own": "At 45 Hz a PD beats a 30 Hz TSIDC: compare at equal bandwidth before you judge a law.",
}


class TaskPanel:
    """The upper half of the folder `Compare controllers`."""

    def __init__(self, gui: viser.GuiApi, desk: CompareDesk) -> None:
        self._gui = gui
        self._desk = desk
        settings = desk.settings
        titles = tuple(task.title for task in tasks_for(settings.robot).values())
        self._task = gui.add_dropdown("Task", titles, initial_value=TASKS[settings.task].title)
        with gui.add_folder("Control laws"):
            self._laws = {name: self._add_law(name) for name in LAWS}
        self._gains = gui.add_dropdown("Gains", tuple(GAIN_KEYS), initial_value=GAINS[settings.gains])
        self._about = gui.add_html("")
        self._bandwidth = gui.add_slider("Bandwidth (Hz)", LOWEST_HZ, HIGHEST_HZ, 0.5, settings.bandwidth_hz)
        self._own = {name: self._add_own(name) for name in LAWS}
        self._listen()
        desk.settings_changed.connect(self._follow)
        self._follow(settings)

    def _add_law(self, name: str) -> viser.GuiCheckboxHandle:
        box = self._gui.add_checkbox(
            name, name in self._desk.settings.laws, hint=f"{LAWS[name].title}: {LAWS[name].note}"
        )

        @box.on_update
        async def _(_: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            self._desk.change(laws=tuple(law for law, other in self._laws.items() if other.value))

        return box

    def _add_own(self, name: str) -> viser.GuiSliderHandle[float]:
        start = self._desk.settings.bandwidth_hz
        slider = self._gui.add_slider(f"{name} (Hz)", LOWEST_HZ, HIGHEST_HZ, 0.5, start, visible=False)

        @slider.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._desk.change(own_hz={**self._desk.settings.own_hz, name: event.target.value})

        return slider

    def _listen(self) -> None:
        desk = self._desk

        @self._task.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            key = TASK_KEYS[event.target.value]
            desk.change(task=key, friction=TASKS[key].friction)

        @self._gains.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.change(gains=GAIN_KEYS[event.target.value])

        @self._bandwidth.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            desk.change(bandwidth_hz=event.target.value)

    def _follow(self, settings: CompareSettings) -> None:
        titles = [task.title for task in tasks_for(settings.robot).values()]
        show_options(self._task, titles, TASKS[settings.task].title)
        for name, box in self._laws.items():
            show_value(box, name in settings.laws)
        show_value(self._gains, GAINS[settings.gains])
        show_value(self._bandwidth, settings.bandwidth_hz)
        _show(self._bandwidth, settings.gains == "equal")
        for name, slider in self._own.items():
            show_value(slider, settings.own_hz.get(name, settings.bandwidth_hz))
            _show(slider, settings.gains == "own" and name in settings.laws)
        content = small(html.escape(ABOUT_GAINS[settings.gains]))
        if content != self._about.content:
            self._about.content = content


def _show(element: viser.GuiSliderHandle[float], visible: bool) -> None:
    if element.visible != visible:
        element.visible = visible
