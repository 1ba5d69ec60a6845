"""In one sentence: how long the motion takes and what limits it; or why it cannot be."""

from __future__ import annotations

import html

import viser

from app.motion import Motion
from app.ui.motion.desk import MotionDesk
from app.ui.panels.text import problem, small

VERDICT = "deltalab-verdict"


class VerdictPanel:
    """What the plan says."""

    def __init__(self, gui: viser.GuiApi, desk: MotionDesk) -> None:
        self._desk = desk
        self._said = gui.add_html(small("The motion is being planned …"))
        desk.planned.connect(lambda _: self._show())
        desk.refused.connect(lambda _: self._show())
        desk.settings_changed.connect(lambda _: self._show())
        self._show()

    def _show(self) -> None:
        motion, refusal = self._desk.motion, self._desk.refusal
        if refusal:
            kept = small("The last motion that was possible is still shown.")
            content = problem(refusal) + (kept if motion is not None else "")
        elif motion is None:
            content = small("The motion is being planned …")
        else:
            content = verdict(motion)
        content = f'<div class="{VERDICT}">{content}</div>'
        if content != self._said.content:
            self._said.content = content


def verdict(motion: Motion) -> str:
    """HTML: the duration, the largest share of a limit, and what limits."""
    peak = float(motion.usage.max())
    return small(
        f"<b>{float(motion.t[-1]):.3g} s</b>, at most <b>{100.0 * peak:.0f} %</b> of the limits. "
        f"{html.escape(motion.limiting)}"
    )
