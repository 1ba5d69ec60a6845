"""The door to the tab Draw: its room, which needs OpenCV, is loaded and built when somebody opens it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.ui.drawing.surroundings import Surroundings
from app.ui.tab_bell import on_tab_opened

if TYPE_CHECKING:
    from app.ui.drawing.jobs import Sketch
    from app.ui.drawing.room import DrawingRoom

LABEL = "Draw"


class DrawingDoor:
    """The tab, before and after somebody has opened it."""

    def __init__(self, surroundings: Surroundings) -> None:
        self._surroundings = surroundings
        self._room: DrawingRoom | None = None
        on_tab_opened(surroundings.client, LABEL, self._open)

    @property
    def drawing(self) -> Sketch | None:
        """What is shown, if the robot has a way to draw it."""
        if self._room is None or self._room.desk.plan is None:
            return None
        return self._room.desk.sketch

    def close(self) -> None:
        if self._room is not None:
            self._room.close()

    async def _open(self) -> None:
        if self._room is not None:
            self._room.show()
            return
        from app.ui.drawing.room import DrawingRoom

        self._room = DrawingRoom(self._surroundings)
        await self._room.build()
