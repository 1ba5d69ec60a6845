"""The robot draws: begin, pause at a stroke's end, go on, scrub, faster and slower, and how long it still takes."""

from __future__ import annotations

import viser

from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.jobs import Plan
from app.ui.drawing.player import DrawingPlayer, State
from app.ui.pacing import Paced
from app.ui.panels.drawing.preview_panel import duration
from app.ui.panels.text import problem, small
from app.ui.viser_adapter import show_value

SPEEDS = (0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
REFRESH_S = 0.2
BUTTONS: dict[State, tuple[str, viser.IconName]] = {
    "empty": ("Draw", viser.Icon.PENCIL),
    "ready": ("Draw", viser.Icon.PENCIL),
    "drawing": ("Pause", viser.Icon.PLAYER_PAUSE),
    "pausing": ("Pause at once", viser.Icon.PLAYER_PAUSE),
    "paused": ("Go on", viser.Icon.PLAYER_PLAY),
    "done": ("Draw again", viser.Icon.PENCIL),
}
"""State -> what the button says and shows."""

SAID: dict[State, str] = {
    "pausing": "finishes its stroke, then lifts the pen",
    "paused": "paused",
    "done": "done",
}


class PlayPanel:
    """Buttons, the time slider, and the progress."""

    def __init__(self, gui: viser.GuiApi, desk: DrawingDesk, player: DrawingPlayer) -> None:
        self._desk = desk
        self._player = player
        self._go = gui.add_button("Draw", icon=viser.Icon.PENCIL, color="blue", disabled=True)
        self._stop = gui.add_button("Stop and go home", icon=viser.Icon.PLAYER_STOP, color="gray", disabled=True)
        self._bar = gui.add_progress_bar(0.0)
        self._said = gui.add_html(small("The way is being planned …"))
        self._time = gui.add_slider("Drawing time (s)", 0.0, 1.0, 0.1, 0.0, disabled=True)
        self._speed = gui.add_dropdown(
            "Play speed", tuple(f"{speed:g}×" for speed in SPEEDS), initial_value="1×", hint="1× is real time"
        )
        self._pace = Paced(self._refresh, REFRESH_S)
        player.moved.connect(lambda _: self._pace.request())
        player.state_changed.connect(self._show_state)
        desk.planned.connect(self._receive)
        desk.refused.connect(lambda _: self._refresh())
        self._listen()

    def close(self) -> None:
        self._pace.cancel()

    def _listen(self) -> None:
        player = self._player

        @self._go.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            player.pause() if player.state in ("drawing", "pausing") else player.play()

        @self._stop.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            player.stop()

        @self._time.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            player.seek(event.target.value)

        @self._speed.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            player.speed = float(event.target.value.rstrip("×"))
            self._refresh()

    def _receive(self, plan: Plan | None) -> None:
        self._go.disabled = self._stop.disabled = self._time.disabled = plan is None
        if plan is not None:
            self._time.max = max(0.1, round(plan.time_s, 1))
        self._refresh()

    def _show_state(self, state: State) -> None:
        label, icon = BUTTONS[state]
        if self._go.label != label:
            self._go.label, self._go.icon = label, icon
        self._refresh()

    def _refresh(self) -> None:
        player, sketch = self._player, self._desk.sketch
        self._bar.value = 100.0 * player.progress
        show_value(self._time, min(round(player.time_s, 1), self._time.max))
        if self._desk.plan is None or sketch is None:
            self._said.content = self._reason()
            return
        _, _, done = player.drawn
        said = SAID.get(player.state, "")
        parts = [
            f"stroke {min(done + 1, len(sketch.strokes))} of {len(sketch.strokes)}" if player.time_s else "",
            f"{duration(player.remaining_s)} to go",
            said,
        ]
        self._said.content = small(", ".join(part for part in parts if part))

    def _reason(self) -> str:
        """HTML of why there is no way to draw along."""
        desk = self._desk
        if desk.no_way is not None and desk.no_way != desk.refusal:
            return problem(desk.no_way.reason)  # above stands something newer
        refused = desk.no_way is not None or (desk.sketch is None and desk.refusal is not None)
        return small("Not drawn: see above." if refused else "The way is being planned …")
