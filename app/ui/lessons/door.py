"""The way into the lessons: what they need is loaded when a page first says hello."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import viser

from app.classroom.classroom import Classroom
from app.ui.bench import Bench
from app.ui.desks import Desks
from app.ui.lessons.dock import LABEL, LessonDock
from app.ui.lessons.library import Library
from app.ui.panels.lessons.wire import LessonWire
from app.ui.tabs import Tabs

if TYPE_CHECKING:
    from app.ui.lessons.room import LessonRoom


class LessonDoor:
    """Of one browser."""

    def __init__(
        self,
        client: viser.ClientHandle,
        desks: Desks,
        library: Library,
        classroom: Classroom,
        browser: str,
        bench: Bench,
        tabs: Tabs,
    ) -> None:
        self.client = client
        self.desks = desks
        self.library = library
        self.classroom = classroom
        self.browser = browser
        self.bench = bench
        self.tabs = tabs
        self.room: LessonRoom | None = None
        """None until the lessons have been read."""
        self._furnishing: asyncio.Task[None] | None = None
        self.wire = LessonWire(client, self._hear)
        self.wire.start()

    def close(self) -> None:
        if self._furnishing is not None:
            self._furnishing.cancel()
        if self.room is not None:
            self.room.close()

    def _hear(self, what: str, value: str) -> None:
        if self.room is not None:
            self.room.hear(what, value)
        elif what == "hello" and self._furnishing is None:
            width, _, asked = value.partition(" ")
            self._furnishing = asyncio.get_running_loop().create_task(self._furnish(width, asked))

    async def _furnish(self, width: str, asked: str) -> None:
        """Put the panel where the page has room for it."""
        if width.isascii() and width.isdigit():
            self.bench.learn_width(int(width))
        dock = LessonDock(self.client, self.bench)
        tab = dock.panel.add_tab(LABEL)
        self.client.flush()
        await self.library.opened()
        from app.ui.lessons.room import LessonRoom  # needs the reader of lessons

        self.room = LessonRoom(self, dock, tab, asked)
