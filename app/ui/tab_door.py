"""The door to a tab: its room, and whatever that needs, is loaded and built when somebody opens it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, Protocol, TypeVar

from app.ui.tabs import Tabs


class TabRoom(Protocol):
    """What is behind a tab."""

    async def build(self) -> None:
        """For the first visit."""
        ...

    def show(self) -> None:
        """Somebody has come again."""
        ...

    def close(self) -> None: ...


Behind = TypeVar("Behind", bound=TabRoom)


class TabDoor(Generic[Behind]):
    """The tab with this label, before and after somebody has opened it."""

    def __init__(self, tabs: Tabs, label: str, make: Callable[[], Behind]) -> None:
        self._make = make
        self.room: Behind | None = None
        """None before the first visit."""
        tabs.listen(label, self._open)

    def close(self) -> None:
        if self.room is not None:
            self.room.close()

    async def _open(self) -> None:
        if self.room is not None:
            self.room.show()
            return
        self.room = self._make()
        await self.room.build()
