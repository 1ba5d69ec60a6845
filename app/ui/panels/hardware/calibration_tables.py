"""HTML of measured poses, of a calibration, and of the poses to measure next."""

from __future__ import annotations

import html

from app.link.calibration.measurements import Measurements
from app.link.calibration.next_poses import NextPoses
from app.robots import ROBOTS
from app.simulation.run import SHOWN
from app.ui import theme
from app.ui.hardware.calibration_jobs import Calibrated
from app.ui.panels.tables import table
from app.ui.panels.text import small

MOST_ROWS = 12
"""Of the measured poses; the others are in the file."""


def rows_table(data: Measurements) -> str:
    """The newest poses."""
    kind = ROBOTS[data.robot].build
    unit, factor = SHOWN[kind.joint_unit]
    head = ("", *kind.joint_names, "x", "y", "z")
    shown = range(max(0, len(data.lines) - MOST_ROWS), len(data.lines))
    rows = [
        (
            str(data.lines[k]),
            *(f"{factor * value:.2f}" for value in data.joints[k].tolist()),
            *(f"{1e3 * value:.2f}" for value in data.tool_m[k].tolist()),
        )
        for k in shown
    ]
    hidden = f" The first {shown.start} are not shown." if shown.start else ""
    return table(head, rows) + small(f"Joints in {unit}, tool in mm.{hidden}")


def found_table(found: Calibrated) -> str:
    """Each unknown with its 95 % interval, and what to know before using it."""
    color = theme.css(theme.LEGS[2] if found.solution.trusted else theme.WARNING)
    verdict = "● The measurements fit to one machine." if found.solution.trusted else "▲ Not to be trusted yet."
    rows = [
        (
            html.escape(row.name),
            f"{row.assumed:.3f}",
            f"<b>{row.found:.3f}</b>",
            f"± {row.half_width:.3f} {row.unit}",
            f"{100.0 * row.shrinkage:.0f} %",
        )
        for row in found.rows
    ]
    head = ("", "assumed", "found", "95 % interval", "doubt left")
    said = "".join(f"<div>▲ {html.escape(sentence)}</div>" for sentence in found.sentences)
    left = f"Left over: {1e3 * found.solution.tool_rms_m:.3f} mm rms a coordinate."
    return small(f'<b style="color:{color}">{verdict}</b> {left}') + table(head, rows) + (small(said) if said else "")


def next_table(robot: str, following: NextPoses) -> str:
    """The poses that would help most, in order."""
    kind = ROBOTS[robot].build
    rows = [
        (str(number), *(f"{1e3 * value:.0f}" for value in pose[:3]))
        for number, pose in enumerate(following.pose.tolist(), 1)
    ]
    head = ("", *(f"{name}, mm" for name in kind.pose_names[:3]))
    return small("<b>Measure next</b> near these poses:") + table(head, rows)
