"""The ways of drawing a picture, by name, with their parameters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.prepare import Threshold
from app.drawing.vectorise.auto import choose_mode
from app.drawing.vectorise.canny import canny_edges
from app.drawing.vectorise.centreline import centrelines
from app.drawing.vectorise.chains import Line
from app.drawing.vectorise.outline import outline_edges
from app.drawing.vectorise.paper_contours import paper_contours
from app.drawing.vectorise.sketch import sketch_lines
from app.drawing.vectorise.tracing import Finish, trace_strokes


class Own(NamedTuple):
    """What a mode takes where nothing else is wanted."""

    shortest_mm: float
    join_mm: float


OWN: dict[str, Own] = {
    "sketch": Own(shortest_mm=3.0, join_mm=1.5),
    "canny": Own(shortest_mm=1.8, join_mm=2.2),
    "centreline": Own(shortest_mm=0.8, join_mm=0.8),
    "outline": Own(shortest_mm=0.8, join_mm=1.5),
}
"""Of all modes but paper, which has neither."""


@dataclass(frozen=True)
class Settings:
    """Parameters of all modes; each uses what it knows. None is the mode's own value."""

    aperture: int = 3
    """Of the Sobel kernel, 3, 5 or 7: canny, outline, paper."""
    low: Threshold = "auto"
    """Of the gradient, where an edge ends: canny, outline, paper."""
    high: Threshold = "auto"
    """Where an edge may start."""
    strong: float = 0.06
    """Share of the picture that starts a line: sketch."""
    weak: float = 0.12
    """Share that may continue one: sketch."""
    shortest_mm: float | None = None
    """Shorter strokes are dropped: all but paper."""
    join_mm: float | None = None
    """Widest gap that is drawn over: all but paper."""
    smooth_px: float = 1.0
    """Deviation of the Gaussian along a stroke: all but paper."""
    tolerance_mm: float = 0.05
    """By how much a stroke may move to be drawn with fewer points: all but paper."""

    def __post_init__(self) -> None:
        for name in ("shortest_mm", "join_mm", "smooth_px", "tolerance_mm"):
            value = getattr(self, name)
            if value is not None and not 0.0 <= value <= 1000.0:
                raise DrawingError(f"The setting {name} cannot be {value:g}; choose 0 or more.")

    def finish(self, own: Own) -> Finish:
        """What follows the tracing, with a mode's own values where none are wanted."""
        shortest_mm = own.shortest_mm if self.shortest_mm is None else self.shortest_mm
        join_mm = own.join_mm if self.join_mm is None else self.join_mm
        return Finish(shortest_mm, join_mm, self.smooth_px, self.tolerance_mm)


@dataclass(frozen=True, eq=False)
class Vectorised:
    """Strokes of a picture."""

    strokes: list[Line]
    """Each (n, 2), n >= 2, in pixels: x right, y down, (0, 0) the middle of the top left pixel."""
    mode: str
    """The mode used: never `auto`."""
    reason: str
    """Why this mode, in one sentence."""
    edge_mask: NDArray[np.bool_]
    """(h, w) what was traced: edges, or ink."""


Grey = NDArray[np.uint8]
Drawn = tuple[list[Line], NDArray[np.bool_]]


def vectorise(grey: Grey, mode: str, mm_per_px: float, **parameters: Any) -> Vectorised:
    """Strokes of a prepared picture (h, w), by one of `MODES` or by what suits it best, `auto`.

    mm_per_px: how large a pixel becomes on the sheet. parameters: the fields of `Settings`.
    Nothing to draw gives no strokes; a setting that cannot be is a DrawingError.
    """
    unknown = parameters.keys() - {field.name for field in fields(Settings)}
    if unknown:
        raise DrawingError(f"There is no setting called {min(unknown)}; see the list of settings.")
    if mode != "auto" and mode not in MODES:
        raise DrawingError(f"There is no mode called {mode}; choose auto, {', '.join(MODES)}.")
    if not 0.0 < mm_per_px < np.inf:
        raise DrawingError(f"A pixel cannot be {mm_per_px:g} mm large; choose a sheet larger than nothing.")
    settings = Settings(**parameters)
    mode, reason = choose_mode(grey) if mode == "auto" else (mode, "The mode was chosen by hand.")
    strokes, edge_mask = MODES[mode](grey, mm_per_px, settings)
    return Vectorised(strokes, mode, reason, edge_mask)


def _canny(grey: Grey, mm_per_px: float, settings: Settings) -> Drawn:
    edges, ridge = canny_edges(grey, settings.aperture, settings.low, settings.high)
    return trace_strokes(edges, ridge, mm_per_px, settings.finish(OWN["canny"])), edges


def _sketch(grey: Grey, mm_per_px: float, settings: Settings) -> Drawn:
    lines, ridge = sketch_lines(grey, settings.strong, settings.weak)
    return trace_strokes(lines, ridge, mm_per_px, settings.finish(OWN["sketch"])), lines


def _centreline(grey: Grey, mm_per_px: float, settings: Settings) -> Drawn:
    return centrelines(grey, mm_per_px, settings.finish(OWN["centreline"]))


def _outline(grey: Grey, mm_per_px: float, settings: Settings) -> Drawn:
    edges, ridge = outline_edges(grey, settings.aperture, settings.low, settings.high)
    return trace_strokes(edges, ridge, mm_per_px, settings.finish(OWN["outline"])), edges


def _paper(grey: Grey, mm_per_px: float, settings: Settings) -> Drawn:
    edges, _ = canny_edges(grey, settings.aperture, settings.low, settings.high, blur=0.0)
    return paper_contours(edges), edges


MODES: dict[str, Callable[[Grey, float, Settings], Drawn]] = {
    "sketch": _sketch,
    "canny": _canny,
    "centreline": _centreline,
    "outline": _outline,
    "paper": _paper,
}
"""Name -> how a picture (h, w) becomes strokes and the mask that was traced."""
