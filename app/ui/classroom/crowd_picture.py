"""Everybody's step responses or tool paths in one picture, as SVG: the same string for all pages, and no names in it.

Not a uPlot: a path comes back to where it was, and its two axes need one scale.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.classroom.pace import OverlayKind
from app.classroom.ticks import Range, tick_words, ticks, widened
from app.ui import theme
from app.ui.classroom.lines import Line

WIDTH, HEIGHT = 400, 260
LEFT, RIGHT, TOP, BOTTOM = 50, 10, 30, 40
TICKS = 5


class Kind(NamedTuple):
    """What is drawn over what."""

    title: str
    x: str
    y: str
    equal: bool
    """One scale for both axes."""
    where_from: str


KINDS: dict[OverlayKind, Kind] = {
    "step_response": Kind("Step responses", "Time (s)", "Output (%)", False, "open the tab Control"),
    "tool_path": Kind("Tool paths from above", "x (mm)", "y (mm)", True, "run the robot in the tab Control"),
}


class Scale(NamedTuple):
    """From values to places on the paper, along one axis."""

    low: float
    high: float
    start: float
    end: float

    def at(self, value: float) -> float:
        return self.start + (self.end - self.start) * (value - self.low) / (self.high - self.low)

    @property
    def px_per_unit(self) -> float:
        return abs(self.end - self.start) / (self.high - self.low)


def crowd_picture(kind: OverlayKind, lines: Sequence[Line]) -> str:
    """SVG with one line for every student that has one."""
    what = KINDS[kind]
    title = f"{what.title} of {len(lines)} student{'s' if len(lines) != 1 else ''}"
    head = f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{title}" style="width:100%;display:block">'
    head += f'<g font-family="system-ui,sans-serif" fill="currentColor">{_text(LEFT, 18, title, 13, "start", 600)}'
    if not lines:
        return f"{head}{_text(LEFT, 60, f'Nobody has one yet: {what.where_from}.', 12)}</g></svg>"
    x, y = _scales(what, lines)
    return f"{head}{_axes(what, x, y)}</g>{''.join(_path(line, x, y) for line in lines)}</svg>"


def _scales(what: Kind, lines: Sequence[Line]) -> tuple[Scale, Scale]:
    x = Scale(*_range(line.x for line in lines), LEFT, WIDTH - RIGHT)
    y = Scale(*_range(line.y for line in lines), HEIGHT - BOTTOM, TOP)
    if what.equal:
        px_per_unit = min(x.px_per_unit, y.px_per_unit)
        x, y = _widened(x, px_per_unit), _widened(y, px_per_unit)
    return x, y


def _range(values: Iterable[NDArray[np.float64]]) -> Range:
    return widened([value for line in values for value in line.tolist()])


def _widened(scale: Scale, px_per_unit: float) -> Scale:
    middle, half = 0.5 * (scale.low + scale.high), 0.5 * abs(scale.end - scale.start) / px_per_unit
    return scale._replace(low=middle - half, high=middle + half)


def _axes(what: Kind, x: Scale, y: Scale) -> str:
    grid = "".join(
        _rule(place, TOP, place, HEIGHT - BOTTOM) + _text(place, HEIGHT - BOTTOM + 14, word)
        for place, word in _marks(x)
    )
    grid += "".join(
        _rule(LEFT, place, WIDTH - RIGHT, place) + _text(LEFT - 6, place + 4, word, anchor="end")
        for place, word in _marks(y)
    )
    across, up = 0.5 * (LEFT + WIDTH - RIGHT), 0.5 * (TOP + HEIGHT - BOTTOM)
    return grid + _text(across, HEIGHT - 8, what.x) + _text(0, 0, what.y, turn=f"translate(12,{up:g}) rotate(-90)")


def _marks(scale: Scale) -> Iterable[tuple[float, str]]:
    """Where round numbers stand, and how they are written."""
    values = ticks(scale.low, scale.high, TICKS)
    return zip(map(scale.at, values), tick_words(values), strict=True)


def _path(line: Line, x: Scale, y: Scale) -> str:
    points = " ".join(f"{x.at(a):.1f},{y.at(b):.1f}" for a, b in zip(line.x.tolist(), line.y.tolist(), strict=True))
    stroke = f'stroke="{theme.css(theme.LEGS[0])}" stroke-width="1.6" stroke-opacity="0.5"'
    return f'<polyline fill="none" {stroke} points="{points}"/>'


def _rule(x1: float, y1: float, x2: float, y2: float) -> str:
    return f'<path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}" stroke="currentColor" stroke-opacity="0.18"/>'


def _text(
    x: float, y: float, text: str, size: int = 11, anchor: str = "middle", weight: int = 400, turn: str = ""
) -> str:
    turned = f' transform="{turn}"' if turn else ""
    look = f'font-size="{size}" text-anchor="{anchor}" font-weight="{weight}"'
    return f'<text x="{x:.1f}" y="{y:.1f}" {look}{turned}>{text}</text>'
