"""The door to the tab Hardware: its room, which needs the link, is loaded and built when somebody opens it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.ui.hardware.surroundings import HardwareSurroundings
from app.ui.tab_bell import on_tab_opened

if TYPE_CHECKING:
    from app.ui.hardware.room import HardwareRoom

LABEL = "Hardware"


class HardwareDoor:
    """The tab, before and after somebody has opened it."""

    def __init__(self, surroundings: HardwareSurroundings) -> None:
        self._surroundings = surroundings
        self._room: HardwareRoom | None = None
        on_tab_opened(surroundings.client, LABEL, self._open)

    def close(self) -> None:
        if self._room is not None:
            self._room.close()

    async def _open(self) -> None:
        if self._room is not None:
            self._room.show()
            return
        from app.ui.hardware.room import HardwareRoom

        self._room = HardwareRoom(self._surroundings)
        await self._room.build()
