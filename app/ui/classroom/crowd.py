"""The picture of all, while the instructor wishes it: gathered every few seconds, told when it has changed."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from app.classroom.pace import Overlay, OverlayKind
from app.signal import Signal
from app.ui.classroom.crowd_picture import crowd_picture
from app.ui.classroom.lines import Line

PERIOD_S = 3.0


class Crowd:
    """`gather` gives everybody's line of a kind."""

    def __init__(self, gather: Callable[[OverlayKind], list[Line]]) -> None:
        self.changed: Signal[str] = Signal()
        self.picture = ""
        """SVG; empty while there is none."""
        self._gather = gather
        self._gathering: asyncio.Task[None] | None = None

    def follow(self, overlay: Overlay | None) -> None:
        """Begin another picture, or end it."""
        if self._gathering is not None:
            self._gathering.cancel()
            self._gathering = None
        if overlay is None:
            self._tell("")
        else:
            self._draw(overlay.kind)
            self._gathering = asyncio.get_running_loop().create_task(self._go_on(overlay.kind))

    async def _go_on(self, kind: OverlayKind) -> None:
        while True:
            await asyncio.sleep(PERIOD_S)
            self._draw(kind)

    def _draw(self, kind: OverlayKind) -> None:
        self._tell(crowd_picture(kind, self._gather(kind)))

    def _tell(self, picture: str) -> None:
        if picture != self.picture:
            self.picture = picture
            self.changed.emit(picture)
