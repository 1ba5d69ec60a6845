"""The door to the tab Draw: its room, which needs OpenCV, is loaded and built when somebody opens it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import viser

from app.ui.bench import Bench
from app.ui.compute import Worker
from app.ui.gizmo import Gizmo
from app.ui.session import Session
from app.ui.stage import Stage
from app.ui.tab_bell import on_tab_opened

if TYPE_CHECKING:
    from app.ui.drawing.room import DrawingRoom

LABEL = "Draw"


class DrawingDoor:
    """The tab, and who works in it: makers of lines of quick and of slow work."""

    def __init__(
        self,
        client: viser.ClientHandle,
        session: Session,
        gizmo: Gizmo,
        stage: Stage,
        tab: viser.GuiTabHandle,
        bench: Bench,
        quick: Callable[[], Worker],
        slow: Callable[[Callable[[], None] | None], Worker],
    ) -> None:
        self._parts = (client, session, gizmo, stage, tab, bench, quick, slow)
        self._room: DrawingRoom | None = None
        on_tab_opened(client, LABEL, self._open)

    def close(self) -> None:
        if self._room is not None:
            self._room.close()

    async def _open(self) -> None:
        if self._room is not None:
            self._room.show()
            return
        from app.ui.drawing.room import DrawingRoom

        self._room = DrawingRoom(*self._parts)
        await self._room.build()
