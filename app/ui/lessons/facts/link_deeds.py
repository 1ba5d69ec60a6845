"""What this page has done with the robot on the table, as far as lessons want to know."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

from app.ui.desks import Desks

if TYPE_CHECKING:
    from app.link.programs import Program
    from app.link.status import LinkStatus

LAST_LOOK_S = 0.3
"""A program that had so little to do when it was seen last has come to its end: looks are 50 ms apart."""


class LinkDeeds:
    """Begins to watch as soon as there is a desk and somebody wants to know."""

    def __init__(self, desks: Desks) -> None:
        self.finished = self.drawn = False
        """A program, and one with ink, ran to its end."""
        self._desks = desks
        self._attends = False
        self._program: Program | None = None
        self._left_s = math.inf
        self._anchor: tuple[float, ...] | None = None
        self._moved_mm = 0.0
        self._wants_moves = False

    @property
    def moved_mm(self) -> float:
        """Farthest that the tool was from where it was, while this page had the robot."""
        self._wants_moves = True
        self.attend()
        return self._moved_mm

    @property
    def runs(self) -> bool:
        """Whether a program from this page runs or is paused."""
        return self._program is not None

    def forget(self, what: Literal["finished", "drawn", "moved"], _: object = None) -> None:
        """Begin anew."""
        if what == "moved":
            self._anchor, self._moved_mm = None, 0.0
            self._wants_moves = True
        elif what == "drawn":
            self.drawn = False
        else:
            self.finished = False

    def attend(self) -> None:
        if not self._attends and self._desks.has_hardware:
            self._attends = True
            desk = self._desks.hardware
            desk.begun.connect(self._begin)
            desk.tick.connect(self._watch_program)
            desk.tick.connect(self._watch_tool)  # five looks a second would miss a short jog

    def _begin(self, program: Program) -> None:
        self._program, self._left_s = program, math.inf

    def _watch_program(self, status: LinkStatus) -> None:
        program = self._program
        if program is None:
            return
        if status.activity in ("run", "paused") and status.program_title == program.title:
            self._left_s = (1.0 - status.progress) * program.duration_s / status.override
        elif self._left_s < math.inf:
            self._program = None
            if self._left_s < LAST_LOOK_S and status.phase == "ready":
                self.finished = True
                self.drawn = self.drawn or bool(program.pen_down.any() or program.laser.any())

    def _watch_tool(self, status: LinkStatus) -> None:
        if not self._wants_moves or not self._desks.hardware.holds or status.measured_pose is None:
            return
        if self._anchor is None:
            self._anchor = status.measured_pose
        self._moved_mm = max(self._moved_mm, 1e3 * math.dist(status.measured_pose[:3], self._anchor[:3]))
