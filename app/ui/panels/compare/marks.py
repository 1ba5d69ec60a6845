"""How a law, a part of a torque and a number look in tables."""

from __future__ import annotations

import html
import math

from app.ui import theme

DOT = (
    '<span style="display:inline-block;width:.7em;height:.7em;border-radius:2px;margin-right:5px;background:{}"></span>'
)


def law_mark(law: str) -> str:
    """A law's name with its colour."""
    return f'<span style="white-space:nowrap">{DOT.format(theme.css(theme.law_color(law)))}{html.escape(law)}</span>'


def component_mark(component: str) -> str:
    """A part of the torque with its colour."""
    return DOT.format(theme.css(theme.component_color(component))) + html.escape(component)


def figure(value: float) -> str:
    """Three digits, without powers of ten: `0.000` is less than half a thousandth."""
    if not math.isfinite(value):
        return "–"
    size = abs(value)
    return (
        f"{value:.0f}"
        if size >= 100
        else f"{value:.1f}"
        if size >= 10
        else f"{value:.2f}"
        if size >= 1
        else f"{value:.3f}"
    )


def fine_figure(value: float) -> str:
    """With a fourth decimal where three say nothing."""
    return f"{value:.4f}" if 5e-5 <= abs(value) < 1e-3 else "0" if abs(value) < 5e-5 else figure(value)
