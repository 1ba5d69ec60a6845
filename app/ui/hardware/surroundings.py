"""What the tab Hardware finds when it is opened: the page around it, and who works for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import viser

from app.ui.bench import Bench
from app.ui.compute import Worker
from app.ui.hardware.access import RobotAccess
from app.ui.session import Session

if TYPE_CHECKING:
    from app.control.motor import Motor
    from app.simulation import Run
    from app.ui.drawing.jobs import Sketch


class HardwareSurroundings(NamedTuple):
    """Of one browser."""

    client: viser.ClientHandle
    session: Session
    tab: viser.GuiTabHandle
    bench: Bench
    access: RobotAccess
    quick: Callable[[], Worker]
    """Makes a line of quick work."""
    slow: Callable[[Callable[[], None] | None], Worker]
    """Makes a line of slow work; what it is given hears of failures."""
    drawing: Callable[[], Sketch | None]
    """What the tab Draw has planned."""
    run: Callable[[], Run | None]
    """What the tab Control shows."""
    use_motor: Callable[[str, Motor, str], str]
    """Gives a robot's motor, and where it comes from, to the control lab; returns why not, or nothing."""
