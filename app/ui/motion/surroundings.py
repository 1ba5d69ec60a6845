"""What the tab Motion finds when it is opened: the page around it, and who works for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import viser

from app.ui.bench import Bench
from app.ui.compute import Worker
from app.ui.desks import Desks
from app.ui.gizmo import Gizmo
from app.ui.session import Session
from app.ui.shape_cache import ShapeCache
from app.ui.stage import Stage


class MotionSurroundings(NamedTuple):
    """Of one browser."""

    client: viser.ClientHandle
    session: Session
    desks: Desks
    tab: viser.GuiTabHandle
    """On the right, for settings."""
    bench: Bench
    gizmo: Gizmo
    stage: Stage
    shapes: ShapeCache
    """Of the robots' parts, for ghosts."""
    slow: Callable[[Callable[[], None] | None], Worker]
    """Makes a line of slow work; what it is given hears of failures."""
