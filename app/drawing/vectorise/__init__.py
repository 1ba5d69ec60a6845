"""From a grey picture to strokes in pixels: the right end of the paper's "vectorise"."""

from __future__ import annotations

from app.drawing.vectorise.auto import choose_mode
from app.drawing.vectorise.modes import MODES, Settings, Vectorised, vectorise

__all__ = ["MODES", "Settings", "Vectorised", "choose_mode", "vectorise"]
