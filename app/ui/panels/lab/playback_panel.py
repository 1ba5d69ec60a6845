"""Play, pause, scrub and speed of the run that is shown."""

from __future__ import annotations

import viser

from app.simulation import Run
from app.ui.pacing import Paced
from app.ui.playback import SPEEDS, Playback
from app.ui.run_view import RunView
from app.ui.viser_adapter import show_value

REFRESH_S = 0.2
FACTORS = (1, 2, 5, 10, 20, 50, 100)


class PlaybackPanel:
    """Buttons and the time slider."""

    def __init__(self, gui: viser.GuiApi, playback: Playback, view: RunView) -> None:
        self._playback = playback
        self._play = gui.add_button("Play", icon=viser.Icon.PLAYER_PLAY, disabled=True)
        self._time = gui.add_slider("Time (s)", 0.0, 1.0, 0.01, 0.0, disabled=True)
        self._speed = gui.add_dropdown("Speed", tuple(f"{s:g}×" for s in SPEEDS), initial_value="1×")
        factors = tuple(f"{factor}×" for factor in FACTORS)
        self._factor = gui.add_dropdown("Error drawn", factors, hint="Makes small errors of the tool visible")
        self._pace = Paced(self._refresh, REFRESH_S)
        playback.moved.connect(lambda _: self._pace.request())
        playback.playing_changed.connect(self._show_playing)

        @self._play.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            playback.pause() if playback.playing else playback.play()

        @self._time.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            playback.pause()
            playback.seek(event.target.value)

        @self._speed.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            playback.speed = float(event.target.value.rstrip("×"))

        @self._factor.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            view.magnify(float(event.target.value.rstrip("×")))

    def load(self, run: Run | None) -> None:
        """Fit the time slider to a run."""
        self._play.disabled = self._time.disabled = run is None
        if run is not None:
            self._time.max = max(0.01, round(float(run.t[-1]), 2))
            show_value(self._speed, f"{self._playback.speed:g}×")
        self._refresh()

    def close(self) -> None:
        self._pace.cancel()
        self._playback.pause()

    def _show_playing(self, playing: bool) -> None:
        self._play.label = "Pause" if playing else "Play"
        self._play.icon = viser.Icon.PLAYER_PAUSE if playing else viser.Icon.PLAYER_PLAY
        self._refresh()

    def _refresh(self) -> None:
        show_value(self._time, min(round(self._playback.time_s, 2), self._time.max))
