"""What the tab Hardware finds when it is opened: the page around it, and who works for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import viser

from app.ui.bench import Bench
from app.ui.compute import Worker
from app.ui.desks import Desks
from app.ui.hardware.access import RobotAccess


class HardwareSurroundings(NamedTuple):
    """Of one browser."""

    client: viser.ClientHandle
    desks: Desks
    tab: viser.GuiTabHandle
    bench: Bench
    access: RobotAccess
    quick: Callable[[], Worker]
    """Makes a line of quick work."""
    slow: Callable[[Callable[[], None] | None], Worker]
    """Makes a line of slow work; what it is given hears of failures."""
