"""A map in words and numbers: values with units, the colour scale, and what is where."""

from __future__ import annotations

import html

import numpy as np

from app.robots.maps import MAPS
from app.ui import theme
from app.ui.motion.map_picture import MapPicture, brightness
from app.ui.panels.tables import table
from app.ui.panels.text import small

STOPS = 11
BAR = "height:10px;border-radius:5px;position:relative"
TICK = f"position:absolute;top:-3px;width:3px;height:16px;border-radius:1px;background:{theme.css(theme.MARK)}"
STRIPED = "Striped: a drive would be over its limit."


def with_unit(value: float, unit: str) -> str:
    """A value to three digits; a dash where there is none."""
    if not np.isfinite(value):
        return "–"
    digits = f"{value:.3g}" if abs(value) < 1000.0 else f"{value:.0f}"
    return f"{digits} {unit}".strip()


def color_bar(picture: MapPicture) -> str:
    """HTML: the colour scale with its ends, and a tick where a drive reaches its limit."""
    low, high, found = picture.low, picture.high, picture.map
    quantity = MAPS[found.settings.quantity]
    colors = theme.ramp(brightness(np.linspace(low, high, STOPS), low, high, found.settings.quantity))
    stops = ",".join(theme.css((int(r), int(g), int(b))) for r, g, b in colors)
    ticks = [level for level in (found.level, found.level and -found.level) if level and low < level < high]
    marks = "".join(f'<div style="{TICK};left:{100.0 * (level - low) / (high - low):.1f}%"></div>' for level in ticks)
    below, above = ("≤ " * bool(np.nanmin(found.values) < low), "≥ " * bool(np.nanmax(found.values) > high))
    ends = f"<span>{below}{with_unit(low, found.unit)}</span><span>{above}{with_unit(high, found.unit)}</span>"
    striped = f'<div style="color:{theme.css(theme.MARK)}">{STRIPED}</div>' if found.beyond.any() else ""
    return small(
        f"<b>{html.escape(quantity.title)}</b>"
        f'<div style="{BAR};margin-top:5px;background:linear-gradient(90deg,{stops})">{marks}</div>'
        f'<div style="display:flex;justify-content:space-between">{ends}</div>{striped}'
    )


def extremes(picture: MapPicture, tool: tuple[float, float]) -> str:
    """HTML: least, greatest and value at the tool, each with its place."""
    found = picture.map
    rows = []
    for name, where in (("least", np.nanargmin), ("greatest", np.nanargmax)):
        r, c = np.unravel_index(int(where(found.values)), found.values.shape)
        rows.append(_row(name, float(found.values[r, c]), found.unit, float(found.x[c]), float(found.y[r])))
    rows.append(_row("at the tool", found.at(*tool), found.unit, *tool))
    return table(("", "value", "x (mm)", "y (mm)"), rows)


def _row(name: str, value: float, unit: str, x: float, y: float) -> list[str]:
    return [name, f"<b>{with_unit(value, unit)}</b>", f"{1e3 * x:.0f}", f"{1e3 * y:.0f}"]
