"""The numbers of a study beside those of the ideal loop and of the baseline."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from app.control.margins import Margins
from app.control.step_metrics import StepMetrics
from app.ui import theme
from app.ui.lab.desk import Baseline
from app.ui.lab.jobs import Answer


class Row(NamedTuple):
    """One number; `UNIT` stands for the drive's."""

    label: str
    unit: str
    of: Callable[[StepMetrics, Margins], float]


STEP_ROWS = (
    Row("Overshoot", "%", lambda m, _: m.overshoot_pct),
    Row("Rise, 10 to 90 %", "s", lambda m, _: m.rise_s),
    Row("Settling, 2 %", "s", lambda m, _: m.settling_s),
    Row("Peak", "UNIT", lambda m, _: m.peak),
    Row("Error at the end", "UNIT", lambda m, _: m.steady_state_error),
    Row("ISE", "UNIT² s", lambda m, _: m.ise),
    Row("IAE", "UNIT s", lambda m, _: m.iae),
    Row("ITAE", "UNIT s²", lambda m, _: m.itae),
    Row("Control energy", "V² s", lambda m, _: m.control_energy),
    Row("At the limit", "% of time", lambda m, _: m.saturation_pct),
)
MARGIN_ROWS = (
    Row("Phase margin", "deg", lambda _, f: f.phase_margin_deg),
    Row("Crossover", "rad/s", lambda _, f: f.crossover_rad_s),
    Row("Gain margin", "times", lambda _, f: f.gain_margin),
    Row("Delay margin", "ms", lambda _, f: 1e3 * f.delay_margin_s),
    Row("Ms", "", lambda _, f: f.Ms),
    Row("Bandwidth", "rad/s", lambda _, f: f.bandwidth_rad_s),
)


def metrics_table(answer: Answer, baseline: Baseline | None, frequency: bool = False) -> str:
    """HTML: one row a number; columns now, ideal, and the baseline where there is one."""
    study = answer.study
    columns = [
        ("now", theme.ACTUAL, study.board.metrics, study.board_frequency.margins),
        ("ideal", theme.IDEAL, study.ideal.metrics, study.ideal_frequency.margins),
    ]
    if baseline is not None:
        kept = baseline.study
        columns.append(("baseline", theme.BASELINE, kept.board.metrics, kept.board_frequency.margins))
    rows = MARGIN_ROWS + STEP_ROWS if frequency else STEP_ROWS + MARGIN_ROWS
    head = "".join(
        f'<th style="text-align:right;border-bottom:3px solid {theme.css(color)}">{name}</th>'
        for name, color, _, _ in columns
    )
    unit = answer.settings.motor.unit
    body = "".join(
        f"<tr><td>{row.label} <span style='opacity:.65'>{row.unit.replace('UNIT', unit)}</span></td>"
        + "".join(f'<td style="text-align:right">{shown(row.of(m, f))}</td>' for _, _, m, f in columns)
        + "</tr>"
        for row in rows
    )
    return (
        '<div style="padding:2px 12px 8px;font-size:0.82em"><table style="width:100%;border-collapse:collapse;'
        f'line-height:1.55;font-variant-numeric:tabular-nums"><tr><th></th>{head}</tr>{body}</table>'
        f"{_verdict(study.board_frequency.margins)}</div>"
    )


def shown(value: float) -> str:
    """Three or four digits; a dash for what does not happen."""
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞"
    return f"{value:.0f}" if abs(value) >= 1000.0 else f"{value:.4g}"


def _verdict(margins: Margins) -> str:
    if margins.stable:
        return ""
    return f'<b style="color:{theme.css(theme.WARNING)}">▲ This loop is unstable: lower the gains or the delay.</b>'
