"""The compared runs played: the robot plays one, ghosts show all, their errors drawn larger."""

from __future__ import annotations

import viser

from app.simulation.controlled_run import ControlledRun
from app.ui.compare.desk import CompareDesk, Comparison
from app.ui.compare.magnified import FACTORS, pleasant_factor
from app.ui.compare.scene import CompareScene
from app.ui.compare.score import POSITION
from app.ui.panels.motion.play_bar import PlayBar
from app.ui.panels.options import show_options
from app.ui.viser_adapter import show_value


class PlayPanel:
    """The folder `Playback`; it is not there before a comparison is."""

    def __init__(self, gui: viser.GuiApi, desk: CompareDesk, scene: CompareScene) -> None:
        self._desk = desk
        self._scene = scene
        self._playback = desk.motion.playback
        self._law = desk.settings.laws[0]
        self._folder = gui.add_folder("Playback", visible=False)
        with self._folder:
            self._bar = PlayBar(gui, self._playback, self._own, what="run")
            self._choice = gui.add_dropdown("Robot plays", desk.settings.laws)
            factors = tuple(f"{factor}×" for factor in FACTORS)
            self._factor = gui.add_dropdown("Errors drawn", factors, hint="Makes small errors of the tool visible")
            self._ghosts = gui.add_checkbox("Ghosts in the laws' colours", True)
        self._listen()
        desk.answered.connect(self._offer)
        desk.finished.connect(self._begin)

    def close(self) -> None:
        self._bar.close()

    def _listen(self) -> None:
        @self._choice.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._exchange(event.target.value)

        @self._factor.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._scene.magnify(float(event.target.value.rstrip("×")))

        @self._ghosts.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            self._scene.want_ghosts(event.target.value)

    def _own(self) -> ControlledRun | None:
        """What the robot plays, or would play."""
        compared = self._desk.comparison
        result = compared.results.get(self._law) if compared is not None else None
        return result.run if result is not None else None

    def _offer(self, comparison: Comparison | None) -> None:
        laws = tuple(comparison.results) if comparison is not None else ()
        if self._folder.visible != bool(laws):
            self._folder.visible = bool(laws)
        if laws:
            self._law = self._law if self._law in laws else laws[0]
            show_options(self._choice, laws, self._law)
        self._bar.fit()

    def _begin(self, comparison: Comparison) -> None:
        """All are there: the best one is played, errors drawn so that they are seen."""
        best = self._desk.best()
        if best is None:
            return
        stretch = self._desk.look.stretch
        factor = pleasant_factor(1e-3 * max(score.peak_of(POSITION, stretch) for score in comparison.scores.values()))
        show_value(self._factor, f"{factor}×")
        show_value(self._choice, best)
        self._law = best
        self._playback.load(self._own())
        self._scene.magnify(factor)
        if self._scene.in_front:
            self._playback.play()

    def _exchange(self, law: str) -> None:
        """Another law's run, at the same time and speed where one of ours was played."""
        playback = self._playback
        was_ours, going_on = playback.run is self._own(), playback.playing
        time_s, speed = playback.time_s, playback.speed
        self._law = law
        playback.load(self._own(), speed if was_ours else None)
        if was_ours:
            playback.seek(time_s)
            if going_on:
                playback.play()
