"""From a source to strokes on a sheet in the order in which they are drawn: what every preview and file shows."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.drawing.crowd import in_words, too_many
from app.drawing.errors import DrawingError, TooManyStrokes
from app.drawing.fitting import fitted, leaves_sheet, on_sheet, pixel_mm, room_mm, seen_width
from app.drawing.likeness import likeness
from app.drawing.modes import AUTO, MAX_STROKES, PAPER, PORTRAIT, PORTRAIT_LINES
from app.drawing.order import join_touching, order_strokes
from app.drawing.prepare import prepare
from app.drawing.rasterise import RASTER_MODES, portrait, rasterise
from app.drawing.settings import checked_settings
from app.drawing.source import Source
from app.drawing.vectorise import vectorise

Array = NDArray[np.float64]
Grey = NDArray[np.uint8]
Settings = dict[str, Any]
OnStage = Callable[[str], None]

STROKES = "strokes"
"""The mode of a composition of a source without a picture."""

STAGES = ("lines", "order", "likeness")
PREPARE = ("width", "gamma", "smooth")
FINEST_PEN_MM, WIDEST_PEN_MM = 0.05, 20.0
MANY = 2000
"""Strokes that are put in a good order, not in the best: that would gain half a per cent and take a second."""

NO_INK = "There is nothing to draw in this picture: choose another mode, lower its thresholds or smooth less."
LARGE = "The drawing is larger than its sheet: choose a smaller scale."


@dataclass(frozen=True)
class Look:
    """How a source is to look on its sheet."""

    mode: str = AUTO
    """One of `DRAWING_MODES`."""
    sheet_mm: tuple[float, float] = (148.0, 210.0)
    """Width and height."""
    margin_mm: float = 10.0
    scale: float = 1.0
    """Of what fits inside the margins."""
    pen_mm: float = 0.5
    """Width of the pen's line."""
    weight: float = 0.5
    """Of the tones of a portrait, 0 to 1; a parameter of this name comes first."""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    """Of the mode, by the names in `DRAWING_MODES`; "auto" leaves one to the mode."""


@dataclass(frozen=True, eq=False)
class Composition:
    """A drawing on its sheet."""

    strokes: list[Array]
    """(n, 2) each, sheet millimetres, in the order in which they are drawn; those that touch are one."""
    mode: str
    """How it was drawn: never `auto`; `strokes` for a source without a picture."""
    reason: str
    """Why so, in one sentence."""
    notes: tuple[str, ...]
    """What there is to say about the source and the drawing, a sentence each."""
    similarity: float | None
    """0 to 1, how like the picture the ink looks from a little away; None without a picture."""
    prepared: Grey | None
    """(h, w) the picture as the mode saw it."""
    mm_per_px: float
    """Of the prepared picture on the sheet; 1 without one."""


class _Lines(NamedTuple):
    """What is to be drawn, in any order, and how it came about."""

    strokes: list[Array]
    """(n, 2) sheet millimetres."""
    mode: str
    reason: str
    pixels: list[Array]
    """The same in pixels of the prepared picture."""
    prepared: Grey | None
    mm_per_px: float


def _ignore(_stage: str) -> None:
    pass


def compose(
    source: Source, look: Look, *, order_s: float = 0.0, seed: int = 0, on_stage: OnStage = _ignore
) -> Composition:
    """Draw a source on a sheet. DrawingError for what cannot be drawn; TooManyStrokes tells a coarser setting.

    order_s: seconds to spend on a still better order. on_stage: told when one of `STAGES` begins.
    """
    settings = checked_settings(look.mode, look.parameters)
    if not FINEST_PEN_MM <= look.pen_mm <= WIDEST_PEN_MM:
        raise DrawingError(f"A pen cannot be {look.pen_mm:g} mm wide; choose {FINEST_PEN_MM:g} to {WIDEST_PEN_MM:g}.")
    on_stage("lines")
    lines = _given(source, look) if source.grey is None else _drawn(source.grey, look, settings)
    if not lines.strokes:
        raise DrawingError(NO_INK)
    on_stage("order")
    strokes = lines.strokes if lines.mode == PAPER else _ordered(lines.strokes, order_s, seed)
    on_stage("likeness")
    grey = lines.prepared
    alike = None if grey is None else likeness(grey, lines.pixels, lines.mm_per_px, look.pen_mm)
    notes = (*source.notes, LARGE) if leaves_sheet(strokes, look.sheet_mm) else source.notes
    return Composition(strokes, lines.mode, lines.reason, notes, alike, grey, lines.mm_per_px)


def _ordered(strokes: list[Array], order_s: float, seed: int) -> list[Array]:
    at_once = len(strokes) > MANY and order_s <= 0.0
    found = order_strokes(strokes, budget_s=order_s, seed=seed, progress=(lambda _share: False) if at_once else None)
    return join_touching(found)


def _given(source: Source, look: Look) -> _Lines:
    """A source of strokes, fitted to the sheet unless they have their place on it."""
    strokes, room = source.strokes or [], room_mm(look.sheet_mm, look.margin_mm, look.scale)
    if len(strokes) > MAX_STROKES:
        raise TooManyStrokes(
            f"This drawing has {in_words(len(strokes))} strokes, more than the {in_words(MAX_STROKES)} that make "
            "sense: simplify it in the program that made it.",
            len(strokes),
        )
    placed = strokes if source.in_place else fitted(strokes, room)
    return _Lines(placed, STROKES, "Its strokes are drawn as they are.", [], None, 1.0)


def _drawn(grey: Grey, look: Look, settings: Settings) -> _Lines:
    """A source with a picture (h, w), in the mode that is wanted."""
    room = room_mm(look.sheet_mm, look.margin_mm, look.scale)
    own = {each.name for each in RASTER_MODES[look.mode].parameters} if look.mode in RASTER_MODES else set()
    of_picture = {name: settings[name] for name in PREPARE if name in settings and name not in own}
    of_mode = {name: value for name, value in settings.items() if name not in of_picture}
    prepared = prepare(grey, **{"width": seen_width(grey.shape, room, look.pen_mm), **of_picture})
    mm_per_px = pixel_mm(prepared.shape, room)
    try:
        pixels, mode, reason = _in_mode(prepared, mm_per_px, look, of_mode)
    except TooManyStrokes as crowd:
        raise too_many(crowd.count, look.mode, settings) from None
    if len(pixels) > MAX_STROKES:
        raise too_many(len(pixels), look.mode, settings)
    return _Lines(on_sheet(pixels, prepared.shape, mm_per_px), mode, reason, pixels, prepared, mm_per_px)


def _in_mode(grey: Grey, mm_per_px: float, look: Look, settings: Settings) -> tuple[list[Array], str, str]:
    """Strokes in pixels of a prepared picture (h, w), the mode used, and why."""
    if look.mode in RASTER_MODES:
        strokes = rasterise(grey, look.mode, mm_per_px, pen_mm=look.pen_mm, **settings)
        return strokes, look.mode, RASTER_MODES[look.mode].explanation
    weight = settings.pop("weight", look.weight)
    found = vectorise(grey, PORTRAIT_LINES if look.mode == PORTRAIT else look.mode, mm_per_px, **settings)
    if look.mode != PORTRAIT:
        return found.strokes, found.mode, found.reason
    strokes = portrait(found.strokes, grey, mm_per_px, pen_mm=look.pen_mm, weight=weight)
    return strokes, PORTRAIT, "Lines tell who it is, light tones give the face its shape."
