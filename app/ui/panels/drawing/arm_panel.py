"""An exercise: is a delta quicker than a serial arm of two links? It depends on the arm."""

from __future__ import annotations

import html
import math

import viser

from app.drawing.compare import ArmComparison
from app.ui.compute import Worker
from app.ui.drawing.compare_jobs import ARM_PATHS, THIS, against_arm
from app.ui.drawing.desk import DrawingDesk
from app.ui.panels.drawing.preview_panel import duration
from app.ui.panels.text import problem, small
from app.ui.refusal import Refusal

ABOUT = (
    "The paper says that its delta draws faster than <i>the serial robot</i>, 20 % with lines and 18 % with tones, but "
    "not which robot. So find out yourself: how long must the arm's links be, and where must it stand, to win?"
)
NO_WAY = "A single dot takes neither robot any time: choose a path with lines."


class ArmPanel:
    """The folder `Against a serial arm`. Lengths on the sliders are in mm."""

    def __init__(self, gui: viser.GuiApi, desk: DrawingDesk, worker: Worker) -> None:
        self._desk = desk
        self._worker = worker
        with gui.add_folder("Against a serial arm (an exercise)", expand_by_default=False):
            gui.add_html(small(ABOUT))
            self._path = gui.add_dropdown("Path", ARM_PATHS, initial_value=THIS)
            self._upper = gui.add_slider("Upper link (mm)", 100.0, 500.0, 5.0, 200.0)
            self._lower = gui.add_slider("Lower link (mm)", 100.0, 500.0, 5.0, 200.0)
            self._share = gui.add_slider(
                "Distance of the shoulder (%)",
                40.0,
                90.0,
                1.0,
                60.0,
                hint="From the sheet's middle, of the arm's reach",
            )
            self._go = gui.add_button("Compare with the arm", icon=viser.Icon.SCALE)
            self._answer = gui.add_html("")
        for element in (self._path, self._upper, self._lower, self._share):

            @element.on_update
            async def _(_: object) -> None:
                self._ask_again()

        @self._go.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            self._ask()

        desk.sketched.connect(lambda _: self._ask_again())

    def _ask_again(self) -> None:
        """An answer is about the present drawing and robot."""
        if self._answer.content:
            self._ask()

    def _ask(self) -> None:
        sketch = self._desk.sketch
        if sketch is None:
            return
        links_m = (self._upper.value / 1e3, self._lower.value / 1e3)
        arm = links_m, self._share.value / 100.0
        self._worker.request(
            self._receive, against_arm, sketch.strokes, self._path.value, sketch.look.sheet_mm, *arm, sketch.setup
        )

    def _receive(self, result: ArmComparison | Refusal) -> None:
        if isinstance(result, Refusal) or math.isnan(result.saving_percent):
            self._answer.content = problem(result.reason or NO_WAY)
        else:
            self._answer.content = comparison(result)


def comparison(result: ArmComparison) -> str:
    """HTML: both times, the saving, and everything assumed."""
    quicker = "quicker" if result.saving_percent >= 0 else "slower"
    assumed = "".join(f"<li>{html.escape(sentence)}</li>" for sentence in result.assumptions)
    return small(
        f"<b>Delta {duration(result.delta_s)}, arm {duration(result.arm_s)}: the delta is "
        f"{abs(result.saving_percent):.0f} % {quicker}.</b> Assumed:<ul style='margin:2px 0 0;padding-left:18px'>"
        f"{assumed}</ul>"
    )
