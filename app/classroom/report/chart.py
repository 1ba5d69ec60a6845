"""A line chart as SVG: axes with units, a legend, colours and dashes that differ for every eye."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any, NamedTuple

from app.classroom.ticks import Range, tick_words, ticks, widened

WIDTH, HEIGHT = 640.0, 380.0
LEFT, RIGHT, BOTTOM = 66.0, 16.0, 52.0
TITLE, LEGEND_ROW = 30.0, 20.0
LETTER = 6.9
"""Width of a letter of the legend."""

COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7d69d7", "#787880")
DASHES = ("", "7 3", "2 3", "9 3 2 3")
INK, FAINT, GRID = "#26262e", "#5f6470", "#e3e5ea"

Points = list[tuple[float, float]]


class Box(NamedTuple):
    """Where the plot is drawn, and what it shows."""

    left: float
    top: float
    width: float
    height: float
    x: Range
    y: Range

    def at(self, x: float, y: float) -> tuple[float, float]:
        """A point of the plot on the paper."""
        across, up = (x - self.x[0]) / (self.x[1] - self.x[0]), (y - self.y[0]) / (self.y[1] - self.y[0])
        return self.left + across * self.width, self.top + (1.0 - up) * self.height


def chart_svg(plot: Mapping[str, Any]) -> str:
    """A plot of the evidence (see `app.classroom.events.Plot`) as an SVG element."""
    series = [(str(one.get("label", "")), _pieces(one)) for one in plot.get("series", ())]
    legend, rows = _legend([label for label, _ in series])
    title = escape(str(plot.get("title", "")))
    box = _box([pieces for _, pieces in series], TITLE + LEGEND_ROW * rows, bool(plot.get("equal")))
    lines = "".join(_line(number, pieces, box) for number, (_, pieces) in enumerate(series))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="img" '
        f'font-family="system-ui, Segoe UI, Roboto, sans-serif" font-size="13" fill="{INK}">'
        f'<title>{title}</title><rect width="{WIDTH:g}" height="{HEIGHT:g}" fill="#fff"/>'
        f'<text x="{LEFT:g}" y="20" font-size="15" font-weight="600">{title}</text>{legend}'
        f"{_axes(box, str(plot.get('x_label', '')), str(plot.get('y_label', '')))}"
        f'<svg x="{box.left:.1f}" y="{box.top:.1f}" width="{box.width:.1f}" height="{box.height:.1f}" '
        f'viewBox="{box.left:.1f} {box.top:.1f} {box.width:.1f} {box.height:.1f}">{lines}</svg></svg>'
    )


def _pieces(series: Mapping[str, Any]) -> list[Points]:
    """The line, broken where a number is missing."""
    pieces: list[Points] = [[]]
    for x, y in zip(series.get("x", ()), series.get("y", ()), strict=False):
        if x is None or y is None or not (math.isfinite(x) and math.isfinite(y)):
            pieces.append([])
        else:
            pieces[-1].append((float(x), float(y)))
    return [piece for piece in pieces if piece]


def _box(lines: Sequence[Sequence[Points]], top: float, equal: bool) -> Box:
    points = [point for pieces in lines for piece in pieces for point in piece]
    width, height = WIDTH - LEFT - RIGHT, HEIGHT - top - BOTTOM
    x, y = widened([x for x, _ in points], 0.0), widened([y for _, y in points])
    if equal:
        scale = max((x[1] - x[0]) * 1.06 / width, (y[1] - y[0]) / height)
        x, y = _about(x, scale * width), _about(y, scale * height)
    return Box(LEFT, top, width, height, x, y)


def _about(shown: Range, length: float) -> Range:
    middle = 0.5 * (shown[0] + shown[1])
    return middle - 0.5 * length, middle + 0.5 * length


def _axes(box: Box, x_label: str, y_label: str) -> str:
    right, bottom = box.left + box.width, box.top + box.height
    parts = [f'<g stroke="{GRID}">']
    across, up = ticks(*box.x, 8), ticks(*box.y, 5)
    parts += [f'<path d="M{box.at(x, 0)[0]:.1f} {box.top:.1f}V{bottom:.1f}"/>' for x in across]
    parts += [f'<path d="M{box.left:.1f} {box.at(0, y)[1]:.1f}H{right:.1f}"/>' for y in up]
    parts.append(f'</g><path d="M{box.left:.1f} {box.top:.1f}V{bottom:.1f}H{right:.1f}" fill="none" stroke="{FAINT}"/>')
    parts.append(f'<g fill="{FAINT}" font-size="12"><g text-anchor="middle">')
    for x, word in zip(across, tick_words(across), strict=True):
        parts.append(f'<text x="{box.at(x, 0)[0]:.1f}" y="{bottom + 16:.1f}">{word}</text>')
    parts.append('</g><g text-anchor="end">')
    for y, word in zip(up, tick_words(up), strict=True):
        parts.append(f'<text x="{box.left - 6:.1f}" y="{box.at(0, y)[1] + 4:.1f}">{word}</text>')
    middle = box.top + 0.5 * box.height
    parts.append('</g></g><g text-anchor="middle">')
    parts.append(f'<text x="{box.left + 0.5 * box.width:.1f}" y="{HEIGHT - 12:g}">{escape(x_label)}</text>')
    parts.append(f'<text transform="translate(16 {middle:.1f}) rotate(-90)">{escape(y_label)}</text></g>')
    return "".join(parts)


def _line(number: int, pieces: Sequence[Points], box: Box) -> str:
    paint = _paint(number)
    drawn = []
    for piece in pieces:
        on_paper = [box.at(*point) for point in piece]
        if len(on_paper) == 1:
            drawn.append(f'<circle cx="{on_paper[0][0]:.1f}" cy="{on_paper[0][1]:.1f}" r="3" fill="{_color(number)}"/>')
        else:
            points = " ".join(f"{x:.1f},{y:.1f}" for x, y in on_paper)
            drawn.append(f'<polyline points="{points}" {paint}/>')
    return "".join(drawn)


def _legend(labels: Sequence[str]) -> tuple[str, int]:
    """The legend in rows, and their number; one line without a label needs none."""
    if not any(labels):
        return "", 0
    x, row, parts = LEFT, 0, []
    for number, label in enumerate(labels):
        width = 34.0 + LETTER * len(label) + 14.0
        if x > LEFT and x + width > WIDTH - RIGHT:
            x, row = LEFT, row + 1
        y = TITLE + LEGEND_ROW * row + 4.0
        parts.append(f'<path d="M{x:.1f} {y:.1f}h26" {_paint(number)}/>')
        parts.append(f'<text x="{x + 32:.1f}" y="{y + 4:.1f}" font-size="12">{escape(label)}</text>')
        x += width
    return "".join(parts), row + 1


def _paint(number: int) -> str:
    dash = DASHES[number % len(DASHES)]
    dashed = f' stroke-dasharray="{dash}"' if dash else ""
    return f'fill="none" stroke="{_color(number)}" stroke-width="2" stroke-linejoin="round"{dashed}'


def _color(number: int) -> str:
    return COLORS[number % len(COLORS)]
