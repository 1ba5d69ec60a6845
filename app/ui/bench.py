"""The side panels of the labs: settings stand on the right, what comes of them on the left, one lab at a time."""

from __future__ import annotations

from functools import cached_property

import viser

from app.ui.picture_width import PictureWidth
from app.ui.session import Signal

WIDTH = 420
ROOM_FOR_BOTH_PX = 800
"""Width of the picture of the robot, before a side panel takes its part of it."""

PHONE_PICTURE_PX = 450
"""A narrower picture of the robot is a phone's; a tablet's is wider even beside the panels."""


class Bench:
    """Gives every lab a side panel; the one in use folds the others away."""

    def __init__(self, client: viser.ClientHandle, width: PictureWidth) -> None:
        self._client = client
        self._width = width
        self._beside: list[viser.PanelHandle] = []
        self.shown: Signal[viser.PanelHandle] = Signal()
        """Another lab is in use."""

    @cached_property
    def _picture_px(self) -> int:
        """Width of the robot's picture before the first side panel came."""
        return self._width.px

    @property
    def on_a_phone(self) -> bool:
        """There the panels are sections of one sheet, the side panels at its end."""
        return self._picture_px < PHONE_PICTURE_PX

    def add_panel(self) -> viser.PanelHandle:
        """A new panel on the left, where the robot keeps enough room; on a tablet below the settings."""
        panel = self._client.gui.add_panel()
        if self._picture_px < ROOM_FOR_BOTH_PX:
            panel.dock_below(self._client.gui.main_panel)
            return panel
        panel.dock_left()
        panel.set_width(WIDTH)
        self._beside.append(panel)
        return panel

    def show(self, panel: viser.PanelHandle) -> None:
        """Unfold a lab's panel and fold the others. On tablets and phones they stand one below the other."""
        if panel in self._beside:
            for other in self._beside:
                if other is not panel:
                    other.minimize()
            panel.expand()
        self.shown.emit(panel)
