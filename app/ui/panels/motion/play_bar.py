"""Play, pause, scrub and speed of one of the things that a playback can play."""

from __future__ import annotations

from collections.abc import Callable

import viser

from app.ui.pacing import Paced
from app.ui.playback import SPEEDS, Playback, Played
from app.ui.viser_adapter import show_value

REFRESH_S = 0.2
TIME_STEP_S = 0.001


class PlayBar:
    """Buttons and the time slider. What another bar plays is exchanged for one's own as soon as this one is used.

    Args:
        own: what this bar plays, None while there is nothing.
        what: named in the labels where a page has several bars.
    """

    def __init__(self, gui: viser.GuiApi, playback: Playback, own: Callable[[], Played | None], what: str = "") -> None:
        self._playback = playback
        self._own = own
        self._says_pause = False
        self._the_what = f" the {what}" if what else ""
        self._play = gui.add_button(f"Play{self._the_what}", icon=viser.Icon.PLAYER_PLAY, color="blue", disabled=True)
        self._time = gui.add_slider(f"{what} time (s)".lstrip().capitalize(), 0.0, 1.0, TIME_STEP_S, 0.0, disabled=True)
        self._speed = gui.add_dropdown(
            f"{what} speed".lstrip().capitalize(),
            tuple(f"{s:g}×" for s in SPEEDS),
            initial_value="1×",
            hint="1× is real time",
        )
        self._again = gui.add_checkbox(f"Repeat{self._the_what}", False, hint="Begins again at the end")
        self._pace = Paced(self._refresh, REFRESH_S)
        playback.moved.connect(lambda _: self._pace.request())
        playback.playing_changed.connect(lambda _: self._refresh())
        playback.loaded.connect(lambda _: self.fit())
        self._listen()
        self.fit()

    def fit(self) -> None:
        """What this bar plays has changed."""
        own = self._own()
        self._play.disabled = self._time.disabled = own is None
        if own is not None:
            longest = max(TIME_STEP_S, round(float(own.t[-1]), 3))
            if self._time.max != longest:
                show_value(self._time, min(self._time.value, longest))
                self._time.max = longest
        if self._in_use:
            self._playback.repeats = self._again.value
        self._refresh()

    def close(self) -> None:
        self._pace.cancel()

    @property
    def _in_use(self) -> bool:
        """Whether what is loaded is one's own."""
        return self._playback.run is not None and self._playback.run is self._own()

    @property
    def _speed_said(self) -> float:
        return float(self._speed.value.rstrip("×"))

    def _take(self) -> None:
        if not self._in_use:
            self._playback.load(self._own(), self._speed_said)

    def _listen(self) -> None:
        playback = self._playback

        @self._play.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            if self._in_use and playback.playing:
                playback.pause()
                return
            self._take()
            playback.play()

        @self._time.on_update
        async def _(event: viser.GuiEvent[viser.GuiSliderHandle[float]]) -> None:
            self._take()
            playback.pause()
            playback.seek(event.target.value)

        @self._speed.on_update
        async def _(_: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            if self._in_use:
                playback.speed = self._speed_said

        @self._again.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            if self._in_use:
                playback.repeats = event.target.value

    def _refresh(self) -> None:
        playing = self._in_use and self._playback.playing
        if playing != self._says_pause:
            self._says_pause = playing
            self._play.label = f"{'Pause' if playing else 'Play'}{self._the_what}"
            self._play.icon = viser.Icon.PLAYER_PAUSE if playing else viser.Icon.PLAYER_PLAY
        show_value(self._time, min(round(self._playback.time_s, 3), self._time.max) if self._in_use else 0.0)
        if self._in_use:
            show_value(self._speed, f"{self._playback.speed:g}×")
