"""The drawing desk of one browser: the picture, its strokes, the robot's plan. No widgets here.

A change asks a worker for new strokes; the newest wins. Then a slower worker plans the robot's way, and looks for a
better order while the student looks at the drawing. What cannot be drawn leaves the last drawing as it is.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.drawing.order import Improvement
from app.drawing.source import Source, strokes_source
from app.drawing.toolpath import Placement, default_placement
from app.robots import Robot
from app.signal import Signal
from app.ui.compute import Worker
from app.ui.drawing import jobs
from app.ui.drawing.jobs import Improved, Plan, Setup, Sketch, TooDense
from app.ui.drawing.settings import (
    DrawingSettings,
    default_settings,
    lies_flat,
    moved_to,
    resized,
    turned,
    turned_to_fit,
    with_mode,
    with_preset,
)
from app.ui.refusal import Refusal
from app.ui.session import Session
from app.ui.state import DrawingMemory

FIRST_SAMPLE = "cat"
FIRST_TEXT = "Delta Lab"
IMPROVE_AFTER_S = 1.5
"""A drawing that has been left alone for so long is improved; one that is still being changed is not worth it."""

IMPROVE_S = 0.4
"""At a time, so that others get their turn."""

SLOW_MODES = frozenset({"one_line", "stipple", "streamlines"})
"""These take a quarter of a second and more: nobody else's slider waits for them."""

ROUNDS = 3
"""Of improvement of one drawing."""


class DrawingDesk:
    """The state behind every panel of the tab Draw."""

    def __init__(self, session: Session, quick: Worker, thorough: Worker, reader: Worker, planner: Worker) -> None:
        self.settings_changed: Signal[DrawingSettings] = Signal()
        self.sketched: Signal[Sketch] = Signal()
        """Another drawing is shown."""
        self.moved: Signal[list[NDArray[np.bool_]]] = Signal()
        """The sheet is being moved: which points would be out of reach there."""
        self.planned: Signal[Plan | None] = Signal()
        """The way along the drawing that is shown; None while it is being planned."""
        self.refused: Signal[Refusal | TooDense | None] = Signal()
        """Why the last change could not be drawn; None when all is well again."""
        self.saved: Signal[Sketch] = Signal()
        """What is shown was saved as a file."""
        self._session = session
        self._quick, self._thorough, self._reader, self._planner = quick, thorough, reader, planner
        memory = session.drawing
        self.settings = memory.settings if memory else default_settings(session.robot)
        if memory and memory.robot != session.robot_name:
            self.settings = moved_to(self.settings, session.robot)
        self.source: Source | None = memory.source if memory else None
        self.source_name = memory.source_name if memory else FIRST_SAMPLE
        """Key of the sample, or what else is drawn."""
        self.text = memory.text if memory else FIRST_TEXT
        self.sketch: Sketch | None = None
        self.plan: Plan | None = None
        self.refusal: Refusal | TooDense | None = None
        self.no_way: Refusal | None = None
        """Why the robot cannot draw what is shown; `refusal` may be about something newer."""
        self.settled: Callable[[], bool] = lambda: True
        """Whether the drawing may be exchanged for a quicker one: not while the robot draws it."""
        self.is_saved = False
        """Whether what is shown was saved as a file; a better order of it counts as the same."""
        self.is_improved = False
        """Whether it is drawn in a better order than the first."""
        self._opened = False
        self._improvement: Improvement | None = None
        self._rounds = 0
        self._patience: asyncio.TimerHandle | None = None
        self._up_to_date = False
        """Whether `sketch` shows the present picture in the present look."""
        self._robot_name = session.robot_name
        session.robot_changed.connect(self._follow_robot)

    @property
    def placement(self) -> Placement:
        return self.settings.placement or default_placement(self._session.robot)

    @property
    def improving(self) -> bool:
        """Whether a better order is still being looked for."""
        return self._planner.busy or self._patience is not None

    @property
    def setup(self) -> Setup:
        session = self._session
        return Setup(session.robot_name, dict(session.dimensions), self.placement, self.settings.pen)

    def open(self) -> None:
        """Somebody looks at the tab: he sees the drawing of his last visit, or a first one.

        Whoever comes later hears again what there is.
        """
        if self._opened:
            self._tell_again()
        else:
            self.look()

    def look(self) -> None:
        """Somebody wants to know what comes of the settings."""
        if self._opened:
            return
        self._opened = True
        if self.source is None:
            self.take_sample(FIRST_SAMPLE)
        else:
            self._ask()

    def take_sample(self, name: str) -> None:
        self._read(name, jobs.read_sample, name)

    def take_file(self, name: str, content: bytes) -> None:
        self._read(name, jobs.read, name, content)

    def take_text(self, text: str) -> None:
        self.text = text
        self._read("text", jobs.read_text, text)

    def take_strokes(self, strokes: list[NDArray[np.float64]]) -> None:
        """Drawn by hand, sheet mm."""
        self._opened = True
        if self.source is not None:
            self._reader.cancel()  # the hand is newer than what is being read
        if strokes:
            self._receive_source("hand", strokes_source("By hand", strokes, in_place=True))
        elif self.source_name == "hand":
            self._refuse(Refusal("There is no stroke on the pad: draw at least one."))

    def turn(self, **knobs: Any) -> None:
        """Set parameters of the mode, or margin, scale and width of the pen."""
        self._change(turned(self.settings, **knobs))

    def choose_mode(self, mode: str) -> None:
        self._change(with_mode(self.settings, mode))

    def choose_preset(self, name: str) -> None:
        self._change(with_preset(self.settings, name))

    def choose_sheet(self, sheet: str, landscape: bool) -> None:
        self._change(resized(self.settings, sheet, landscape))

    def draw_coarser(self) -> None:
        """Take the settings that a refusal has offered."""
        if isinstance(self.refusal, TooDense):
            self.turn(**self.refusal.coarser)

    def set_pen(self, **values: Any) -> None:
        """Change how the pen is moved: the strokes stay as they are.

        Raises DrawingError for what no pen can do.
        """
        self._keep(replace(self.settings, pen=replace(self.settings.pen, **values)))
        self._replace_sheet()

    def move_sheet(self, placement: Placement | None, *, finished: bool = True) -> None:
        """Lay the sheet elsewhere, None: where the robot has room around it. The drawing is planned when finished."""
        self._keep(replace(self.settings, placement=placement))
        sketch = self.sketch
        if finished:
            self._replace_sheet()
        elif sketch is not None and self._up_to_date:
            self._quick.request(partial(self._warn, sketch), jobs.outside_of, sketch.strokes, self.setup)

    def note_saved(self) -> None:
        """What is shown was saved as a file."""
        if self.sketch is not None:
            self.is_saved = True
            self.saved.emit(self.sketch)

    @property
    def up_to_date(self) -> bool:
        """Whether what is shown is what was asked for."""
        return self._up_to_date and self.sketch is not None and self.sketch.setup == self.setup

    def improve_now(self) -> None:
        """Look for a better order at once, and not only after a while."""
        self.leave_alone()
        self._look_for_better()

    def _tell_again(self) -> None:
        if self.sketch is not None:
            self.sketched.emit(self.sketch)
            self.planned.emit(self.plan)
        if self.refusal is not None:
            self.refused.emit(self.refusal)

    def _warn(self, sketch: Sketch, outside: list[NDArray[np.bool_]]) -> None:
        if sketch is self.sketch:
            self.moved.emit(outside)

    def _change(self, settings: DrawingSettings) -> None:
        self._keep(settings)
        self._ask()

    def _keep(self, settings: DrawingSettings) -> None:
        self.settings = settings
        self._session.drawing = DrawingMemory(
            self._session.robot_name, settings, self.source, self.source_name, self.text
        )
        self.settings_changed.emit(settings)

    def _read(self, name: str, job: Callable[..., Source | Refusal], *arguments: object) -> None:
        self._opened = True
        self._reader.request(lambda result: self._receive_source(name, result), job, *arguments)

    def _receive_source(self, name: str, result: Source | Refusal) -> None:
        if isinstance(result, Refusal):
            self._refuse(result)
            self.settings_changed.emit(self.settings)
            return
        self.source, self.source_name = result, name
        self._change(self._turned(self.settings, lies_flat(result)))

    def _turned(self, settings: DrawingSettings, landscape: bool | None) -> DrawingSettings:
        """With the sheet in the robot's reach; but nobody's paper is turned while it is being drawn on."""
        in_place = self.source is not None and self.source.in_place
        return settings if in_place else turned_to_fit(settings, self._session.robot, landscape)

    def _ask(self) -> None:
        self._up_to_date = False
        if self.source is None:
            return
        takes_long = self.settings.look.mode in SLOW_MODES
        worker, other = (self._thorough, self._quick) if takes_long else (self._quick, self._thorough)
        other.cancel()
        worker.request(self._receive, jobs.sketch, self.source, self.settings.look, self.setup)

    def _replace_sheet(self) -> None:
        """The strokes stay; unless others are on their way, which then come for this sheet."""
        if self.sketch is not None and self._up_to_date:
            self._quick.request(self._receive, jobs.placed, self.sketch, self.setup)
        else:
            self._ask()

    def _receive(self, result: Sketch | Refusal | TooDense) -> None:
        if isinstance(result, Sketch):
            self._up_to_date = True
            self._refuse(None)
            self._show(result)
            return
        self._refuse(result)
        if self.sketch is not None and self.sketch.setup != self.setup:
            self._quick.request(self._show, jobs.placed, self.sketch, self.setup)

    def _show(self, result: Sketch) -> None:
        self.leave_alone()
        self.is_saved = self.is_improved = False
        self.sketch, self.plan, self.no_way = result, None, None
        self._improvement, self._rounds = Improvement(result.strokes), 0
        self.sketched.emit(result)
        self.planned.emit(None)
        self._planner.request(self._receive_plan, jobs.plan, result.strokes, result.setup)

    def _receive_plan(self, result: Plan | Refusal) -> None:
        if isinstance(result, Refusal):
            self.no_way = result
            self._refuse(result)
            return
        self.plan = result
        self.planned.emit(result)
        self._patience = asyncio.get_running_loop().call_later(IMPROVE_AFTER_S, self._look_for_better)

    def leave_alone(self) -> None:
        """Look for no better order of this drawing."""
        if self._patience is not None:
            self._patience.cancel()
            self._patience = None

    def _look_for_better(self) -> None:
        self._patience = None
        if self.sketch is None or self.plan is None or self._improvement is None:
            return
        if self._rounds < ROUNDS and jobs.can_improve(self.sketch) and not self._improvement.finished:
            self._rounds += 1
            task = (self._improvement, self.sketch, self.plan, IMPROVE_S)
            self._planner.request(self._receive_better, jobs.improve, *task)

    def _receive_better(self, result: Improved | None) -> None:
        if result is None or not self.settled():
            return
        self._improvement, self.sketch, self.plan = result.state, result.sketch, result.plan
        self.is_improved = True
        self.sketched.emit(result.sketch)
        self.planned.emit(result.plan)
        self._look_for_better()

    def _refuse(self, refusal: Refusal | TooDense | None) -> None:
        if refusal is not None or self.refusal is not None:
            self.refusal = refusal
            self.refused.emit(refusal)

    def _follow_robot(self, robot: Robot) -> None:
        """Another robot has its own place for the sheet, and its own lift."""
        self._drop_plan()
        same, self._robot_name = robot.name == self._robot_name, robot.name
        settings = self.settings
        if not same:
            settings = self._turned(moved_to(settings, robot), None)
            self._up_to_date = self._up_to_date and settings.look == self.settings.look
        self._keep(settings)
        self._replace_sheet()

    def _drop_plan(self) -> None:
        self.leave_alone()
        self._planner.cancel()
        self.plan = self.no_way = None
        self.planned.emit(None)
