"""Is the board still the one that it was, does it talk, is the cable clean, is this computer in time?"""

from __future__ import annotations

from app.link.protocol.messages import Telemetry

SILENT_S = 0.5
LATE_S = 0.06
"""With set-points farther apart than this the board holds."""

NOISE_WINDOW_S = 5.0
NOISY_FRAMES = 3
WRAP_US = 2**32
WRAP_FRAMES = 2**16
SLACK_S = 1.0
"""Board and host may disagree by so much about the time between two messages."""


class Health:
    """Watches one connection. `heard` and `ticked` return a sentence where a person should know."""

    def __init__(self, now: float) -> None:
        self._heard_s = self._ticked_s = self._window_s = now
        self._last: Telemetry | None = None
        self._damaged = self._bad_here = 0
        self._bad_there: int | None = None

    def was_reset(self, telemetry: Telemetry, now: float) -> bool:
        """Whether the board's clock, or its count of frames, began anew since the last message."""
        last, self._last = self._last, telemetry
        elapsed_s, self._heard_s = now - self._heard_s, now
        if last is None:
            return False
        clock_jumped = (telemetry.t_us - last.t_us) % WRAP_US > 1e6 * (elapsed_s + SLACK_S)
        return clock_jumped or (telemetry.good - last.good) % WRAP_FRAMES > WRAP_FRAMES // 2

    def is_silent(self, now: float) -> bool:
        return now - self._heard_s >= SILENT_S

    def noise(self, bad_here: int, telemetry: Telemetry, now: float) -> str | None:
        """Damaged frames: `bad_here` so far at this end, and what the board counts at its own."""
        if self._bad_there is not None:
            self._damaged += bad_here - self._bad_here + (telemetry.bad - self._bad_there) % WRAP_FRAMES
        self._bad_here, self._bad_there = bad_here, telemetry.bad
        if now - self._window_s < NOISE_WINDOW_S:
            return None
        damaged, self._damaged, self._window_s = self._damaged, 0, now
        if damaged < NOISY_FRAMES:
            return None
        return f"The line is noisy: {damaged} messages were damaged in {NOISE_WINDOW_S:.0f} s; check plugs and cable."

    def ticked(self, now: float) -> str | None:
        """To be called at each turn of the loop that writes."""
        gap_s, self._ticked_s = now - self._ticked_s, now
        if gap_s <= LATE_S:
            return None
        return f"This computer was busy: the robot got nothing for {1e3 * gap_s:.0f} ms; close other programs."
