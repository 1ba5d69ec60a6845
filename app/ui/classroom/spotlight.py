"""The robot of one person on everybody's page: looked at ten times a second, told page by page."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Iterable
from typing import Protocol

from app.robots import Robot
from app.robots.parts import machine_of
from app.ui.session import Session
from app.ui.shape_cache import ShapeCache
from app.ui.state import Stance

PERIOD_S = 0.1

_log = logging.getLogger(__name__)


class Viewer(Protocol):
    """A page that may be shown somebody else's robot."""

    def show_guest(self, robot: Robot, stance: Stance) -> None: ...

    def end_guest(self) -> None: ...


class Spotlight:
    """`source` gives the session that is shown, None while its browser is away; `viewers` the others' pages."""

    def __init__(
        self, source: Callable[[], Session | None], viewers: Callable[[], Iterable[Viewer]], shapes: ShapeCache
    ) -> None:
        self._source = source
        self._viewers = viewers
        self._shapes = shapes
        self._showing: asyncio.Task[None] | None = None
        self._drawn: Robot | None = None

    def begin(self) -> None:
        """Show, or show somebody else."""
        if self._showing is None:
            self._showing = asyncio.get_running_loop().create_task(self._show())

    def end(self) -> None:
        """Everybody has his own robot back."""
        if self._showing is not None:
            self._showing.cancel()
            self._showing = None

    async def _show(self) -> None:
        while True:
            session = self._source()
            if session is not None and self._is_drawn(session.robot):
                robot, stance = session.robot, session.stance
                for viewer in tuple(self._viewers()):
                    _tell(viewer, robot, stance)
                    await asyncio.sleep(0)  # a new robot takes a few milliseconds a page: drags go on between them
            await asyncio.sleep(PERIOD_S)

    def _is_drawn(self, robot: Robot) -> bool:
        """Whether its shapes are at hand: the page that shows it itself gets them, not every other one."""
        if robot is not self._drawn and all(self._shapes.get(part) is not None for part in machine_of(robot).parts):
            self._drawn = robot
        return robot is self._drawn


def _tell(viewer: Viewer, robot: Robot, stance: Stance) -> None:
    try:
        viewer.show_guest(robot, stance)
    except Exception:  # one page's trouble is not the others'
        _log.exception("a page could not follow the spotlight")
