"""What a user of the drawing pipeline has to expect."""

from __future__ import annotations

from collections.abc import Mapping


class DrawingError(ValueError):
    """A picture, file or setting that cannot be drawn; the message is one sentence for the user."""


class TooManyStrokes(DrawingError):
    """A drawing of more strokes than make sense, with what makes it coarser."""

    def __init__(self, message: str, count: int = 0, coarser: Mapping[str, float] | None = None):
        super().__init__(message)
        self.count = count
        """Strokes that the picture would give, about."""
        self.coarser: dict[str, float] = dict(coarser or {})
        """Settings of the mode with which it gives fewer; empty if there are none."""
