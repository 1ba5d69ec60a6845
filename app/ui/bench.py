"""The side panels of the labs: settings stand on the right, what comes of them on the left, one lab at a time.

While a lesson stands on the left, and where the page is narrow, they stand below the settings.
"""

from __future__ import annotations

import viser

from app.signal import Signal
from app.ui.picture_width import PictureWidth
from app.ui.stage import PHONE_WIDTH_PX

WIDTH = 420
SETTINGS_PX = 330
"""Width of the settings on the right."""

ROOM_FOR_BOTH_PX = 800
"""Width of the picture of the robot, before a side panel takes its part of it."""

PHONE_PICTURE_PX = 450
"""A narrower picture of the robot is a phone's; a tablet's is wider even beside the panels."""


class Bench:
    """Gives every lab a side panel; the one in use folds the others away."""

    def __init__(self, client: viser.ClientHandle, width: PictureWidth) -> None:
        self._client = client
        self._width = width
        self._panels: list[viser.PanelHandle] = []
        self._lasting: list[viser.PanelHandle] = []
        self._front: viser.PanelHandle | None = None
        self._lesson = False
        self._told_px = 0
        self.shown: Signal[viser.PanelHandle] = Signal()
        """Another lab is in use."""

    def learn_width(self, page_px: int) -> None:
        """The page has told its own width, before any side panel took its part of the picture."""
        beside_settings = max(page_px - SETTINGS_PX, PHONE_PICTURE_PX)
        self._told_px = page_px if page_px < PHONE_WIDTH_PX else beside_settings

    @property
    def _picture_px(self) -> int:
        """Width of the robot's picture before the first side panel came."""
        if not self._told_px:
            self._told_px = self._width.px
        return self._told_px

    @property
    def on_a_phone(self) -> bool:
        """There the panels are sections of one sheet, the side panels at its end."""
        return self._picture_px < PHONE_PICTURE_PX

    @property
    def is_narrow(self) -> bool:
        """Too narrow for panels on both sides: a tablet, or a phone."""
        return self._picture_px < ROOM_FOR_BOTH_PX

    def add_panel(self, *, lasting: bool = False) -> viser.PanelHandle:
        """A new panel on the left, where the robot keeps enough room; on a tablet below the settings.

        A lasting one belongs to no lab: it is never hidden.
        """
        panel = self._client.gui.add_panel()
        self._panels.append(panel)
        if lasting:
            self._lasting.append(panel)
        self._dock(panel)
        return panel

    def show(self, panel: viser.PanelHandle) -> None:
        """Unfold a lab's panel and fold the others."""
        self._front = panel
        self._fold_others()
        self.shown.emit(panel)

    def make_room(self, lesson: bool) -> None:
        """A lesson has come to the left, or has gone from there."""
        if lesson != self._lesson:
            self._lesson = lesson
            if not self.is_narrow:
                for panel in self._panels:
                    panel.visible = True
                    self._dock(panel)
            self._fold_others()

    def _dock(self, panel: viser.PanelHandle) -> None:
        if self._lesson or self.is_narrow:
            panel.dock_below(self._client.gui.main_panel)
        else:
            panel.dock_left()
            panel.set_width(WIDTH)

    def _fold_others(self) -> None:
        """Below the settings two of them would be too low to read, so that the others are hidden there."""
        if self._front is None:
            return
        others = [panel for panel in self._panels if panel is not self._front]
        if self._lesson and not self.on_a_phone:
            for panel in self._panels:
                panel.visible = panel is self._front or panel in self._lasting
        elif not self.is_narrow:
            for panel in others:
                panel.minimize()
            self._front.expand()
