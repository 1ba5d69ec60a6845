"""From an image to a path that a robot draws."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from app.drawing.errors import DrawingError, TooManyStrokes

if TYPE_CHECKING:
    from app.drawing.pipeline import Drawing

__all__ = ["DrawingError", "TooManyStrokes", "draw_image"]


def draw_image(image_bytes: bytes, *arguments: Any, **parameters: Any) -> Drawing:
    """See `app.drawing.pipeline.draw_image`, which is loaded when it is first needed: OpenCV takes its time."""
    from app.drawing import pipeline

    return pipeline.draw_image(image_bytes, *arguments, **parameters)
