"""The verdict in words, and how close the robot is to its limits."""

from __future__ import annotations

import html
import math

import viser

from app.ui import theme
from app.ui.pacing import Paced
from app.ui.panels.units import SHOWN_UNIT, shown
from app.ui.session import Session
from app.ui.state import Stance

REFRESH_S = 0.4
"""For the numbers; a change of verdict shows at once."""


class StatusPanel:
    """One line of verdict and one of numbers, kept in step with the robot."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        self._session = session
        self._html = gui.add_html(self._content())
        self._pace = Paced(self._refresh, REFRESH_S)
        self._reason = session.stance.reach.reason
        session.stance_changed.connect(self._follow)

    def close(self) -> None:
        self._pace.cancel()

    def _follow(self, stance: Stance) -> None:
        if stance.reach.reason != self._reason:
            self._reason = stance.reach.reason
            self._refresh()
        else:
            self._pace.request()

    def _refresh(self) -> None:
        self._html.content = self._content()

    def _content(self) -> str:
        style = "padding:2px 12px 4px;font-size:0.85em;line-height:1.5"
        return f'<div style="{style}">{self._verdict()}{self._numbers()}</div>'

    def _verdict(self) -> str:
        reach = self._session.stance.reach
        if reach.ok:
            return f'<div><b style="color:{theme.css(theme.LEGS[2])}">●</b> In reach</div>'
        return f'<div role="status"><b style="color:{theme.css(theme.WARNING)}">▲ {html.escape(reach.reason)}</b></div>'

    def _numbers(self) -> str:
        robot, stance = self._session.robot, self._session.stance
        conditioning = float(robot.conditioning(stance.pose))
        quality = f"{conditioning:.2f}" if math.isfinite(conditioning) else "∞ (singular)"
        joint, room = robot.nearest_stop(stance.joints)
        unit = robot.joint_units[joint]
        return (
            f'<div style="opacity:0.8">Conditioning <b>{quality}</b> &nbsp;·&nbsp; nearest stop '
            f"<b>{robot.joint_names[joint]}</b> in <b>{shown(room, unit):g} {SHOWN_UNIT[unit]}</b></div>"
        )
