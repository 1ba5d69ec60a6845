"""A drawing played on the robot: it is paused where the pen is lifted, resumed, scrubbed and stopped."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from app.drawing.toolpath import Track, pause_after
from app.signal import Signal
from app.ui.playback import Playback, instant_at
from app.ui.session import Session

State = Literal["empty", "ready", "drawing", "pausing", "paused", "done"]


class DrawingPlayer:
    """The pen's hand on play, pause and resume. Somebody who moves the robot otherwise pauses it at once."""

    def __init__(self, session: Session, playback: Playback) -> None:
        self.moved: Signal[float] = Signal()
        """The time shown, s."""
        self.state_changed: Signal[State] = Signal()
        self._session = session
        self._playback = playback
        self._track: Track | None = None
        self._told: State = "empty"
        playback.moved.connect(self._on_moved)
        playback.playing_changed.connect(lambda _: self._tell())
        session.robot_changed.connect(lambda _: self.load(None))

    @property
    def state(self) -> State:
        if self._track is None:
            return "empty"
        if self._playback.playing:
            return "pausing" if self._playback.halting else "drawing"
        if self.time_s >= self.duration_s:
            return "done"
        return "paused" if self.time_s > 0.0 else "ready"

    @property
    def track(self) -> Track | None:
        return self._track

    @property
    def time_s(self) -> float:
        return self._playback.time_s

    @property
    def duration_s(self) -> float:
        return self._playback.duration_s

    @property
    def speed(self) -> float:
        """How many times as fast as the robot it is played; may be changed meanwhile."""
        return self._playback.speed

    @speed.setter
    def speed(self, speed: float) -> None:
        self._playback.speed = speed

    @property
    def remaining_s(self) -> float:
        """Until the end, at the present speed."""
        return (self.duration_s - self.time_s) / self.speed

    @property
    def progress(self) -> float:
        """0 to 1, by time."""
        return self.time_s / self.duration_s if self.duration_s else 0.0

    @property
    def lengths_m(self) -> NDArray[np.float64]:
        """(k,) of the strokes as the robot draws them, for `InkView.load`: its corners are round."""
        lengths = np.zeros(0 if self._track is None else int(self._track.done[-1]))
        if self._track is not None:
            drawn = self._track.stroke >= 0
            np.maximum.at(lengths, self._track.stroke[drawn], 1e-3 * self._track.along_mm[drawn])
        return lengths

    @property
    def drawn(self) -> tuple[int, float, int]:
        """The stroke being drawn (-1 in hops), how much of it, m, and how many are done: for `InkView.show`."""
        return self.drawn_at(self.time_s)

    def drawn_at(self, time_s: float) -> tuple[int, float, int]:
        """The same at another time."""
        if self._track is None:
            return -1, 0.0, 0
        k = instant_at(self._track.t, time_s)
        return int(self._track.stroke[k]), 1e-3 * float(self._track.along_mm[k]), int(self._track.done[k])

    def load(self, track: Track | None, speed: float | None = None) -> None:
        """Take a drawing, at its beginning. Without a speed the present one is kept."""
        self._track = track
        self._playback.load(track, self.speed if speed is None else speed)
        self._tell()

    def play(self) -> None:
        """Begin, go on, or begin again once done; a pause that has not come yet is taken back."""
        self._playback.halt_at(None)
        self._playback.play()
        self._tell()

    def pause(self) -> None:
        """Draw on until the pen is lifted, then stand still; asked twice, stop at once."""
        if self._track is None:
            return
        if self.state == "pausing":
            self._playback.pause()
        else:
            self._playback.halt_at(pause_after(self._track, self.time_s))
        self._tell()

    def seek(self, time_s: float) -> None:
        """Show one instant, at once, and stand there."""
        self._playback.pause()
        self._playback.seek(min(max(time_s, 0.0), self.duration_s))
        self._tell()

    def stop(self) -> None:
        """Stand still at once and go home. The drawing can be resumed."""
        self._playback.pause()
        self._session.go_home()

    def _on_moved(self, time_s: float) -> None:
        self.moved.emit(time_s)
        self._tell()

    def _tell(self) -> None:
        if self.state != self._told:
            self._told = self.state
            self.state_changed.emit(self._told)
