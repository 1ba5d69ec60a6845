"""The reason why the robot holds back, written beside its tool, where the eye is during a drag."""

from __future__ import annotations

import viser

from app.ui.session import Session
from app.ui.state import Stance

BELOW_TOOL_M = 0.035


class Notice:
    """`/robot/tool/notice`: it rides on the tool, so that moving it costs nothing."""

    def __init__(self, client: viser.ClientHandle, session: Session) -> None:
        self._scene = client.scene
        self._label: viser.LabelHandle | None = None
        session.stance_changed.connect(self._follow)

    def _follow(self, stance: Stance) -> None:
        if stance.reach.ok:
            if self._label is not None:
                self._label.remove()
                self._label = None
        elif self._label is None:
            self._label = self._scene.add_label(
                "/robot/tool/notice",
                stance.reach.reason,
                position=(0.0, 0.0, -BELOW_TOOL_M),
                anchor="top-center",
                font_screen_scale=1.15,
            )
        elif self._label.text != stance.reach.reason:
            self._label.text = stance.reach.reason
