"""Bars of RMS and peak, one pair a law: how much better the better one is, at a glance."""

from __future__ import annotations

import html
import math

from app.ui import theme
from app.ui.compare.desk import Look
from app.ui.compare.score import Score, ranking, unit_of
from app.ui.panels.compare.marks import fine_figure

ROW = (
    '<div style="display:grid;grid-template-columns:4.6em 1fr 8.4em;align-items:center;gap:6px;line-height:1.5">'
    '<span>{name}</span><div style="position:relative;height:11px;border-radius:3px;background:rgba(128,128,128,.14)">'
    "{bars}</div>"
    '<span style="text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums">{value}</span></div>'
)
BAR = (
    '<div style="position:absolute;left:0;top:0;height:100%;min-width:2px;border-radius:3px;'
    'width:{width:.1f}%;background:{color};opacity:{opacity}"></div>'
)


def error_bars(scores: dict[str, Score], look: Look) -> str:
    """HTML: RMS error in full colour over the peak error, on one scale."""
    if not scores:
        return ""
    longest = max(
        filter(math.isfinite, (score.peak_of(look.quantity, look.stretch) for score in scores.values())), default=1.0
    )
    rows = []
    for law in ranking(scores, look.quantity, look.stretch):
        rms, peak = (one(look.quantity, look.stretch) for one in (scores[law].rms_of, scores[law].peak_of))
        rows.append(_row(law, rms / longest, peak / longest, f"{fine_figure(rms)} | {fine_figure(peak)}"))
    return _block(f"Error in {html.escape(look.quantity)}: RMS | peak, {unit_of(look.quantity)}", rows)


def effort_bars(scores: dict[str, Score], look: Look, joint: str, unit: str) -> str:
    """HTML: RMS and largest effort of the joint that is looked at, on the scale of its limit."""
    if not scores:
        return ""
    k = look.joint
    limit = max(score.effort_limit[k] for score in scores.values())
    longest = limit if math.isfinite(limit) else max(score.effort_peak[k] for score in scores.values())
    rows = []
    for law in ranking(scores, look.quantity, look.stretch):
        rms, peak = scores[law].effort_rms[k], scores[law].effort_peak[k]
        rows.append(_row(law, rms / longest, peak / longest, f"{rms:.2f} | {peak:.2f}"))
    of = f" (of {limit:g})" if math.isfinite(limit) else ""
    return _block(f"Effort of {joint}: RMS | peak, {unit}{of}", rows)


def _row(law: str, rms: float, peak: float, value: str) -> str:
    color = theme.css(theme.law_color(law))
    widths = [(100.0 * min(share, 1.0) if math.isfinite(share) else 100.0) for share in (peak, rms)]
    bars = BAR.format(width=widths[0], color=color, opacity=0.35) + BAR.format(width=widths[1], color=color, opacity=1)
    return ROW.format(name=html.escape(law), bars=bars, value=value)


def _block(title: str, rows: list[str]) -> str:
    return f'<div style="padding:2px 12px 8px;font-size:.8em"><b>{title}</b>{"".join(rows)}</div>'
