"""The kept runs side by side."""

from __future__ import annotations

import html
from collections.abc import Sequence

import numpy as np

from app.robots import ROBOTS
from app.simulation import Run
from app.ui import theme
from app.ui.panels.text import small

SETTLED_AFTER_S = 5.0


def runs_table(runs: Sequence[Run], shown: Run | None) -> str:
    """HTML: one row a run with the squared error of each drive, in the colours of the legs; empty without runs."""
    if not runs:
        return small("No run yet. Runs are kept to compare.")
    names = ROBOTS[runs[0].robot].build.joint_names
    drives = "".join(
        f'<th style="text-align:right;border-bottom:3px solid {theme.css(theme.leg_color(k))}">{name}</th>'
        for k, name in enumerate(names)
    )
    rows = "".join(_row(number, run, run is shown) for number, run in enumerate(runs, 1))
    return (
        '<div style="padding:2px 12px 8px;font-size:0.8em;overflow-x:auto">'
        f"<b>ISE of each drive ({runs[0].joint_unit}² s)</b>"
        '<table style="width:100%;border-collapse:collapse;line-height:1.5;font-variant-numeric:tabular-nums">'
        f'<tr><th></th>{drives}<th style="text-align:right" title="Largest error of the tool after the first 5 s">'
        f"tool, mm</th></tr>{rows}</table>"
        '<span style="opacity:.7">tool: largest distance from the path after the first 5 s</span></div>'
    )


def _row(number: int, run: Run, shown: bool) -> str:
    cells = "".join(f'<td style="text-align:right">{value:.4g}</td>' for value in run.ise)
    late = run.t >= SETTLED_AFTER_S if run.t[-1] > SETTLED_AFTER_S else np.ones(len(run.t), dtype=bool)
    error = 1e3 * float(run.tool_error_m[late].max())
    weight = "font-weight:600" if shown else ""
    return (
        f'<tr><td colspan="{len(run.ise) + 2}" style="padding-top:4px;{weight}">'
        f"{number}. {html.escape(run.title)}</td></tr>"
        f'<tr style="{weight}"><td></td>{cells}<td style="text-align:right">{error:.3g}</td></tr>'
    )
