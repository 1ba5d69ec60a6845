"""Everything that one browser sees, put together; and taken apart when it leaves."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING

import viser

from app.ui.bench import Bench
from app.ui.compute import Pools, Worker
from app.ui.drawing.surroundings import Surroundings
from app.ui.ghosts import Ghosts
from app.ui.gizmo import Gizmo
from app.ui.hardware.access import RobotAccess
from app.ui.hardware.stop_bar import StopBar
from app.ui.hardware.surroundings import HardwareSurroundings
from app.ui.hardware.workshop import Workshop
from app.ui.lab.room import ControlRoom
from app.ui.motion.surroundings import MotionSurroundings
from app.ui.notice import Notice
from app.ui.overlay import Overlay
from app.ui.panels.robot_panel import RobotPanel
from app.ui.panels.view_panel import ViewPanel
from app.ui.picture_width import PictureWidth
from app.ui.robot_view import RobotView
from app.ui.session import Session
from app.ui.shape_cache import ShapeCache
from app.ui.stage import Stage
from app.ui.state import Memory
from app.ui.tab_door import TabDoor
from app.ui.viser_adapter import NodeStream, browser_id, run_javascript
from app.ui.workspace_view import WorkspaceCache, WorkspaceView

if TYPE_CHECKING:
    from app.ui.drawing.room import DrawingRoom
    from app.ui.hardware.room import HardwareRoom
    from app.ui.motion.room import MotionRoom

PANEL_WIDTH = 330
NARROW_TABS = """
const style = document.createElement("style");
style.textContent = '[role="tab"] { padding: 0.7em 0.45em !important; }'
  + '[role="tab"] > :has(svg) { display: none !important; }';
document.head.append(style);
"""
"""Six tabs in one row have no room for pictures."""


class Room:
    """One browser's session with its views and panels."""

    def __init__(
        self,
        client: viser.ClientHandle,
        memory: Memory,
        pools: Pools,
        shapes: ShapeCache,
        spaces: WorkspaceCache,
        workshop: Workshop,
    ) -> None:
        self._client = client
        self.browser = browser_id(client)
        self.session = Session(memory)
        self._pools = pools
        self._shapes = shapes
        self._spaces = spaces
        self._workshop = workshop
        self._workers: list[Worker] = []
        self._closers: list[Callable[[], None]] = []
        self._closed = False

    async def furnish(self) -> None:
        """Build scene and panels, the robot first; others get their turn between the steps."""
        client, session = self._client, self.session
        stream = NodeStream(client)
        run_javascript(client, 'document.title = "Delta Lab"' + NARROW_TABS)
        width = PictureWidth(client)
        stage = Stage(client, session, width)
        RobotView(client, session, stream, self._shapes, self._worker())
        gizmo = Gizmo(client, session, stream)
        Notice(client, session)
        self._closers.append(StopBar(client, self._workshop, self.browser).close)
        client.flush()
        await asyncio.sleep(0)
        if self._closed:
            return
        self._add_panels(stage, gizmo, width)
        session.stance_changed.connect(lambda _: stream.flush())
        client.flush()

    def close(self) -> None:
        """Stop what would go on without the browser."""
        self._closed = True
        for worker in self._workers:
            worker.cancel()
        for close in self._closers:
            close()

    def _add_panels(self, stage: Stage, gizmo: Gizmo, width: PictureWidth) -> None:
        client, session, gui = self._client, self.session, self._client.gui
        overlay = Overlay(client, session)
        ghosts = Ghosts(client, session, self._shapes)
        WorkspaceView(client, session, self._worker(), self._spaces)
        gui.main_panel.dock_right()
        gui.main_panel.set_width(PANEL_WIDTH)
        tabs = gui.add_tab_group()
        with tabs.add_tab("Robot", viser.Icon.ROBOT):
            robot_panel = RobotPanel(gui, session)
        control_tab = tabs.add_tab("Control", viser.Icon.ADJUSTMENTS)
        motion_tab = tabs.add_tab("Motion", viser.Icon.ROUTE)
        draw_tab = tabs.add_tab("Draw", viser.Icon.PENCIL)
        hardware_tab = tabs.add_tab("Hardware", viser.Icon.PLUG)
        with tabs.add_tab("View", viser.Icon.EYE):
            ViewPanel(gui, session, stage, overlay)
        bench = Bench(client, width)
        access = RobotAccess(client, session, gizmo, self._shapes, self._workshop, self.browser)
        lab = ControlRoom(client, session, control_tab, bench, self._quick_worker(), self._worker, self._tell, access)
        quick, slow = self._quick_worker, self._worker
        drawn = Surroundings(client, session, gizmo, stage, draw_tab, bench, access, quick, slow)
        moved = MotionSurroundings(
            client, session, motion_tab, bench, gizmo, stage, self._shapes, quick, slow, self._tell
        )
        motion = TabDoor(client, "Motion", lambda: _motion_room(moved))
        drawing = TabDoor(client, "Draw", lambda: _drawing_room(drawn))
        wired = HardwareSurroundings(
            client,
            session,
            hardware_tab,
            bench,
            access,
            quick,
            slow,
            drawing=lambda: drawing.room and drawing.room.drawing,
            run=lambda: lab.run,
            use_motor=lab.use_motor,
        )
        hardware = TabDoor(client, "Hardware", lambda: _hardware_room(wired))
        self._closers += [overlay.close, ghosts.close, robot_panel.close, lab.close]
        self._closers += [motion.close, drawing.close, hardware.close, access.close]

    def _worker(self, failed: Callable[[], None] | None = None) -> Worker:
        """A line of slow work; `failed` is called after a job of it could not be done and the user was told."""

        def tell(sentence: str) -> None:
            self._tell(sentence)
            if failed is not None:
                failed()

        return self._employ(Worker(self._pools.slow, tell))

    def _quick_worker(self) -> Worker:
        return self._employ(Worker(self._pools.quick, self._tell))

    def _employ(self, worker: Worker) -> Worker:
        self._workers.append(worker)
        return worker

    def _tell(self, sentence: str) -> None:
        self._client.add_notification("Delta Lab", sentence, color="red", auto_close_seconds=8)


def _drawing_room(surroundings: Surroundings) -> DrawingRoom:
    from app.ui.drawing.room import DrawingRoom  # needs OpenCV

    return DrawingRoom(surroundings)


def _motion_room(surroundings: MotionSurroundings) -> MotionRoom:
    from app.ui.motion.room import MotionRoom  # needs the planners

    return MotionRoom(surroundings)


def _hardware_room(surroundings: HardwareSurroundings) -> HardwareRoom:
    from app.ui.hardware.room import HardwareRoom  # needs the link

    return HardwareRoom(surroundings)
