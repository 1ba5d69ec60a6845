"""What the desk decides, shown in 3-D: the sheet with its plan, the ink, and the robot that draws."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.ink_view import InkView
from app.ui.drawing.jobs import Plan, Sketch
from app.ui.drawing.player import DrawingPlayer
from app.ui.drawing.sheet_view import SheetView
from app.ui.gizmo import Gizmo
from app.ui.session import Session
from app.ui.stage import Stage

ROOM_AROUND = 2.6
"""What the camera shows of the sheet's surroundings, in its long sides."""


class DrawingScene:
    """Connects desk, sheet, ink and player."""

    def __init__(
        self,
        client: viser.ClientHandle,
        session: Session,
        gizmo: Gizmo,
        stage: Stage,
        desk: DrawingDesk,
        player: DrawingPlayer,
    ) -> None:
        self._stage = stage
        self._gizmo = gizmo
        self._desk = desk
        self._player = player
        self._shown = self._placing = False
        self._looked_at = ""
        self._outside: list[NDArray[np.bool_]] = []
        self._sheet = SheetView(client, session)
        self._ink = InkView(client.scene)
        desk.sketched.connect(self._show)
        desk.planned.connect(self._load)
        desk.moved.connect(self._warn)
        player.state_changed.connect(lambda _: self._show_handles())
        player.moved.connect(lambda _: self._ink.show(*player.drawn))
        self._sheet.moved.connect(lambda placement: desk.move_sheet(placement, finished=False))
        self._sheet.released.connect(desk.move_sheet)

    def visible(self, on: bool) -> None:
        """Show or hide the sheet."""
        self._shown = on
        self._sheet.visible(on)
        self._show_handles()
        self._look_once()

    def look(self) -> None:
        """Turn the camera to the sheet."""
        self._stage.look_down_on(self._sheet.middle, ROOM_AROUND * 1e-3 * max(self._desk.settings.sheet_mm))

    def placing(self, on: bool) -> None:
        """Handles on the sheet in place of those on the robot's tool: both are at the same spot."""
        self._placing = on
        self._sheet.placing(on)
        self._show_handles()

    def show_ink(self, time_s: float) -> None:
        """What is drawn at a time of the plan: for a robot that is not ours to play."""
        self._ink.show(*self._player.drawn_at(time_s))

    def close(self) -> None:
        self._ink.close()

    def _show_handles(self) -> None:
        """While the robot draws, its handles would hide what it draws."""
        placing = self._placing and self._shown
        self._gizmo.visible(not placing and self._player.state not in ("drawing", "pausing"))

    def _show(self, sketch: Sketch) -> None:
        # where it was laid last: a sheet in hand has moved on since this drawing was asked for
        self._sheet.place(self._desk.placement, sketch.look.sheet_mm)
        self._look_once()
        self._show_plan(sketch, sketch.outside)

    def _look_once(self) -> None:
        """At the sheet of another robot, as soon as it is seen."""
        sketch = self._desk.sketch
        if self._shown and sketch is not None and sketch.setup.robot != self._looked_at:
            self._looked_at = sketch.setup.robot
            self.look()

    def _show_plan(self, sketch: Sketch, outside: list[NDArray[np.bool_]]) -> None:
        self._outside = outside
        self._sheet.show_plan(sketch.strokes, outside)

    def _load(self, plan: Plan | None) -> None:
        """The player has the robot's way already: how long a stroke of ink is, the way tells."""
        self._ink.clear()
        sketch = self._desk.sketch
        if plan is not None and sketch is not None:
            metres = [1e-3 * stroke for stroke in sketch.strokes]
            marks_hops = sketch.setup.pen.marks_hops
            self._ink.load(metres, 1e-3 * sketch.look.pen_mm, marks_hops, self._player.lengths_m)
            self._ink.show(*self._player.drawn)

    def _warn(self, outside: list[NDArray[np.bool_]]) -> None:
        """What would be out of reach where the sheet is being dragged; sent only when it changes."""
        sketch = self._desk.sketch
        if sketch is None or len(outside) != len(sketch.strokes) or _alike(outside, self._outside):
            return
        self._show_plan(sketch, outside)


def _alike(some: list[NDArray[np.bool_]], others: list[NDArray[np.bool_]]) -> bool:
    return len(some) == len(others) and all(map(np.array_equal, some, others))
