"""Everything that one browser sees, put together; and taken apart when it leaves."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING, Literal

import viser

from app.ui.bench import SETTINGS_PX, Bench
from app.ui.classroom.class_page import ClassPage
from app.ui.classroom.guest_view import GuestView
from app.ui.classroom.hall import Hall
from app.ui.classroom.lines import line_of
from app.ui.compute import Pools
from app.ui.desks import Desks
from app.ui.drawing.surroundings import Surroundings
from app.ui.ghosts import Ghosts
from app.ui.gizmo import Gizmo
from app.ui.hardware.access import RobotAccess
from app.ui.hardware.stop_bar import StopBar
from app.ui.hardware.surroundings import HardwareSurroundings
from app.ui.hardware.workshop import Workshop
from app.ui.lab.room import ControlRoom
from app.ui.lessons.door import LessonDoor
from app.ui.lessons.library import Library
from app.ui.motion.surroundings import MotionSurroundings
from app.ui.notice import Notice
from app.ui.overlay import Overlay
from app.ui.panels.robot_panel import RobotPanel
from app.ui.panels.view_panel import ViewPanel
from app.ui.picture_width import PictureWidth
from app.ui.robot_view import RobotView
from app.ui.session import Session
from app.ui.shape_cache import ShapeCache
from app.ui.staff import Staff
from app.ui.stage import Stage
from app.ui.state import Memory
from app.ui.tab_door import TabDoor
from app.ui.tabs import Tabs
from app.ui.viser_adapter import NodeStream, browser_id, run_javascript
from app.ui.workspace_view import WorkspaceCache, WorkspaceView

if TYPE_CHECKING:
    from app.ui.drawing.room import DrawingRoom
    from app.ui.hardware.room import HardwareRoom
    from app.ui.motion.room import MotionRoom

NARROW_TABS = """
const style = document.createElement("style");
style.textContent = '[role="tab"] { padding: 0.7em 0.45em !important; }';
document.head.append(style);
"""
"""Six tabs stand in one row. None has a picture: viser reads each from an archive, which takes 30 ms."""


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
        hall: Hall | None = None,
        library: Library | None = None,
    ) -> None:
        """
        Args:
            hall: of the class; None for everybody who works alone.
            library: of lessons; None for a page without.
        """
        self._client = client
        self.browser = browser_id(client)
        self.session = Session(memory)
        self._staff = Staff(pools, self._tell)
        """Works for what is seen; the desks have their own."""
        self.desks = Desks(self.session, Staff(pools, self._tell), workshop, self.browser, self._tell_of_robot)
        self.tabs = Tabs(client)
        self.tabs.changed.connect(lambda _: self.desks.changed.emit(None))
        self._shapes = shapes
        self._spaces = spaces
        self._workshop = workshop
        self._hall = hall
        self._library = library
        self._class_page: ClassPage | None = None
        self._closers: list[Callable[[], None]] = []
        self._closed = False

    async def furnish(self) -> None:
        """Build scene and panels, the robot first; others get their turn between the steps."""
        client, session = self._client, self.session
        stream = NodeStream(client)
        run_javascript(client, 'document.title = "Delta Lab"' + NARROW_TABS)
        width = PictureWidth(client)
        stage = Stage(client, session, width)
        view = RobotView(client, session, stream, self._shapes, self._staff.slow())
        gizmo = Gizmo(client, session, stream)
        Notice(client, session)
        self._closers.append(StopBar(client, self._workshop, self.browser).close)
        if self._hall is not None:
            self._enter(self._hall, GuestView(client, view, stage, self._shapes, self._staff.slow()))
        client.flush()
        await asyncio.sleep(0)
        if self._closed:
            return
        self._add_panels(stage, gizmo, width)
        session.stance_changed.connect(lambda _: stream.flush())
        client.flush()

    def _enter(self, hall: Hall, guests: GuestView) -> None:
        page = self._class_page = ClassPage(self._client, hall, self.browser, self.session, guests)
        page.draw_lines(lambda kind: line_of(self.desks, kind))
        self._closers.append(page.close)

    def close(self) -> None:
        """Stop what would go on without the browser."""
        self._closed = True
        self._staff.cancel()
        for close in self._closers:
            close()
        self.desks.close()

    def _add_panels(self, stage: Stage, gizmo: Gizmo, width: PictureWidth) -> None:
        client, session, gui = self._client, self.session, self._client.gui
        overlay = Overlay(client, session)
        ghosts = Ghosts(client, session, self._shapes)
        WorkspaceView(client, session, self._staff.slow(), self._spaces)
        gui.main_panel.dock_right()
        gui.main_panel.set_width(SETTINGS_PX)
        tabs, group = self.tabs, gui.add_tab_group()
        with group.add_tab("Robot"):
            robot_panel = RobotPanel(gui, session)
        control_tab = group.add_tab("Control")
        motion_tab = group.add_tab("Motion")
        draw_tab = group.add_tab("Draw")
        hardware_tab = group.add_tab("Hardware")
        with group.add_tab("View"):
            ViewPanel(gui, session, stage, overlay)
        bench = Bench(client, width)
        desks, quick, slow = self.desks, self._staff.quick, self._staff.slow
        access = RobotAccess(client, desks, gizmo, self._shapes)
        lab = ControlRoom(client, tabs, control_tab, bench, desks, slow, access)
        drawn = Surroundings(client, session, desks, gizmo, stage, draw_tab, bench, access, quick, slow)
        moved = MotionSurroundings(client, session, desks, motion_tab, bench, gizmo, stage, self._shapes, slow)
        wired = HardwareSurroundings(client, desks, hardware_tab, bench, access, quick, slow)
        motion = TabDoor(tabs, "Motion", lambda: _motion_room(moved))
        drawing = TabDoor(tabs, "Draw", lambda: _drawing_room(drawn))
        hardware = TabDoor(tabs, "Hardware", lambda: _hardware_room(wired))
        for label in ("Robot", "View"):
            tabs.listen(label)
        self._closers += [overlay.close, ghosts.close, robot_panel.close, lab.close]
        self._closers += [motion.close, drawing.close, hardware.close, access.close]
        if self._library is not None:
            lessons = LessonDoor(client, desks, self._library, self._workshop.people, self.browser, bench, tabs)
            self._closers.append(lessons.close)
        if self._hall is not None and self._class_page is not None:
            hall = self._hall
            self._class_page.when_instructor(lambda: self._open_instructor(hall, bench))

    def _open_instructor(self, hall: Hall, bench: Bench) -> None:
        from app.ui.classroom.instructor_desk import InstructorDesk  # one page of many needs it
        from app.ui.classroom.instructor_room import InstructorRoom

        desk = InstructorDesk(hall, self.browser, self._workshop, self.desks, self._tell)
        self._closers.append(InstructorRoom(self._client, desk, bench).close)

    def _tell(self, sentence: str) -> None:
        self._client.add_notification("Delta Lab", sentence, color="red", auto_close_seconds=8)

    def _tell_of_robot(self, sentence: str, color: Literal["red", "green"]) -> None:
        seconds = 8 if color == "red" else 5
        self._client.add_notification("The robot on the table", sentence, color=color, auto_close_seconds=seconds)


def _drawing_room(surroundings: Surroundings) -> DrawingRoom:
    from app.ui.drawing.room import DrawingRoom  # needs OpenCV

    return DrawingRoom(surroundings)


def _motion_room(surroundings: MotionSurroundings) -> MotionRoom:
    from app.ui.motion.room import MotionRoom  # needs the planners

    return MotionRoom(surroundings)


def _hardware_room(surroundings: HardwareSurroundings) -> HardwareRoom:
    from app.ui.hardware.room import HardwareRoom  # needs the link

    return HardwareRoom(surroundings)
