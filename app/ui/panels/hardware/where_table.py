"""Where the robot on the table is, in numbers."""

from __future__ import annotations

import html

from app.link.protocol.codes import Flag
from app.link.status import LinkStatus
from app.ui import theme
from app.ui.panels.tables import STYLE
from app.ui.panels.units import GREEK, SHOWN_UNIT, shown


def where_table(status: LinkStatus) -> str:
    """HTML: joints in the colours of their legs, and the tool; empty without a board."""
    robot, telemetry = status.robot, status.telemetry
    if robot is None or telemetry is None:
        return ""
    joints = [
        (name, theme.css(theme.leg_color(k)), f"{shown(telemetry.position[k], robot.joint_units[k]):.1f}")
        for k, name in enumerate(robot.joint_names)
    ]
    unit = SHOWN_UNIT[robot.joint_unit]
    rows = _row(f"joints, {unit}", joints)
    homed = bool(telemetry.flags & Flag.HOMED)
    pose = status.measured_pose if homed else None
    units = ["m"] * 3 + ["rad"] * (robot.dof - 3)
    tool = [
        (GREEK.get(name, name), "inherit", "–" if pose is None else f"{shown(pose[k], units[k]):.1f}")
        for k, name in enumerate(robot.pose_names)
    ]
    rows += _row("tool, mm" + (" and °" if robot.dof > 3 else ""), tool)
    return f'<table style="{STYLE}">{rows}</table>'


def _row(title: str, cells: list[tuple[str, str, str]]) -> str:
    numbers = "".join(
        f'<td style="text-align:right;white-space:nowrap;line-height:1.5;padding-left:6px">'
        f'<span style="opacity:.75;border-bottom:2px solid {color}">{html.escape(name)}</span><br>{value}</td>'
        for name, color, value in cells
    )
    return f'<tr><td style="text-align:left;opacity:.8">{title}</td>{numbers}</tr>'
