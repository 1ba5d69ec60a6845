"""What a student measured, as small plots for the report: plain data, whatever the step's checks are about."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.classroom.events import Plot
from app.classroom.lessons.catalogue import namespace
from app.classroom.lessons.lesson import Step
from app.simulation.run import SHOWN
from app.ui.desks import Desks

POINTS = 300
"""A curve has no more."""

STROKES = 60
"""A drawing is shown by so many of its strokes, the longest ones."""

STROKE_POINTS = 1200
"""Of all strokes together."""

Array = NDArray[np.floating[Any]]


def plots_for(desks: Desks, step: Step) -> list[Plot]:
    """Of what the step's checks read, as far as it is there."""
    checks = step.act.checks if step.act is not None else ()
    spaces = dict.fromkeys(namespace(check.fact) for check in checks)
    makers = dict.fromkeys(MAKERS[space] for space in spaces if space in MAKERS)
    return [plot for make in makers for plot in make(desks)]


def plot(title: str, x_label: str, y_label: str, series: Sequence[tuple[str, Array, Array]], **more: Any) -> Plot:
    """One plot; series are (label, x, y), thinned to `POINTS`."""
    curves = [{"label": label, "x": _thin(x), "y": _thin(y)} for label, x, y in series]
    return {"title": title, "x_label": x_label, "y_label": y_label, "series": curves, **more}


def _thin(values: Array, points: int = POINTS) -> list[float]:
    chosen = values if len(values) <= points else values[np.linspace(0, len(values) - 1, points).astype(int)]
    return np.asarray(chosen, dtype=float).tolist()


def _step_response(desks: Desks) -> list[Plot]:
    lab = desks.control
    if lab.answer is None:
        return []
    unit, now, kept = lab.settings.motor.unit, lab.answer.study.board, lab.baseline
    series = [("now", now.t, now.y)]
    voltage = [("now", now.t, now.u)]
    if kept is not None:
        series.append(("kept", kept.study.board.t, kept.study.board.y))
        voltage.append(("kept", kept.study.board.t, kept.study.board.u))
    return [
        plot("Step response", "time (s)", f"position ({unit})", series),
        plot("Controller", "time (s)", "voltage (V)", voltage),
    ]


def _run(desks: Desks) -> list[Plot]:
    run = desks.run
    if run is None:
        return []
    chosen = run.outline(POINTS)
    names = desks.session.robot.joint_names
    t, error = run.t[chosen], run.joint_error[chosen]
    wanted, actual = 1e3 * run.pose_ref[chosen], 1e3 * run.pose[chosen]
    path = [("wanted", wanted[:, 0], wanted[:, 1]), ("actual", actual[:, 0], actual[:, 1])]
    return [
        plot(
            run.title, "time (s)", f"error ({run.joint_unit})", [(names[k], t, error[:, k]) for k in range(len(names))]
        ),
        plot("Tool from above", "x (mm)", "y (mm)", path, equal=True),
    ]


def _motor(desks: Desks) -> list[Plot]:
    result = desks.motor.result
    if result is None:
        return []
    found, unit = result.found, result.recording.unit
    series = [("measured", found.t, found.model_output - found.residuals), ("model", found.t, found.model_output)]
    return [plot("Identification", "time (s)", f"position ({unit})", series)]


def _motion(desks: Desks) -> list[Plot]:
    motion = desks.motion.motion
    if motion is None:
        return []
    names, shares = desks.session.robot.joint_names, 100.0 * motion.shares.max(axis=1)
    pose = 1e3 * motion.pose
    return [
        plot("Use of the limits", "time (s)", "share of the limit (%)", _columns(names, motion.t, shares)),
        plot("Tool from above", "x (mm)", "y (mm)", [("tool", pose[:, 0], pose[:, 1])], equal=True),
    ]


def _columns(names: Sequence[str], t: Array, table: Array) -> list[tuple[str, Array, Array]]:
    return [(name, t, column) for name, column in zip(names, table.T, strict=True)]


def _comparison(desks: Desks) -> list[Plot]:
    compared = desks.compare.comparison
    if compared is None or not compared.results:
        return []
    runs = {law: result.run for law, result in compared.results.items()}
    series = [(law, run.t, 1e3 * run.tool_error_m) for law, run in runs.items()]
    return [plot("Error of the tool", "time (s)", "error (mm)", series)]


def _drawing(desks: Desks) -> list[Plot]:
    """One curve with gaps where the pen is up."""
    sketch = desks.drawing.sketch
    if sketch is None or not sketch.strokes:
        return []
    strokes = sorted(sketch.strokes, key=len, reverse=True)[:STROKES]
    points, gap = max(2, STROKE_POINTS // len(strokes)), [math.nan]
    x, y = ([v for stroke in strokes for v in (*_thin(stroke[:, axis], points), *gap)] for axis in (0, 1))
    labels = {"title": "Drawing", "x_label": "x (mm)", "y_label": "y (mm)"}
    return [{**labels, "series": [{"label": "ink", "x": x, "y": y}], "equal": True}]


def _recording(desks: Desks) -> list[Plot]:
    recording = desks.hardware.recording if desks.has_hardware else None
    if recording is None:
        return []
    robot = recording.build()
    unit, factor = SHOWN[robot.joint_unit]
    series = _columns(robot.joint_names, recording.t, recording.position * factor)
    return [plot("Recorded joints", "time (s)", f"position ({unit})", series)]


MAKERS: Mapping[str, Callable[[Desks], list[Plot]]] = {
    **dict.fromkeys(("step", "margin", "kept", "ideal", "control"), _step_response),
    **dict.fromkeys(("run", "before"), _run),
    **dict.fromkeys(("identify", "found", "motor"), _motor),
    **dict.fromkeys(("motion", "cycle"), _motion),
    **dict.fromkeys(("compare", "compare_before"), _comparison),
    "drawing": _drawing,
    **dict.fromkeys(("link", "twin"), _recording),
}
"""Namespace of a fact -> plots of it."""
