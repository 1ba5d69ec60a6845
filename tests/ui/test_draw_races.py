"""Answers that come late to the drawing desk: of an older picture, another robot, a place where the sheet was."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable
from concurrent.futures import Executor, Future
from typing import Any

import cv2
import numpy as np
import pytest

from app.drawing.toolpath import Placement
from app.ui.compute import Worker
from app.ui.drawing.desk import DrawingDesk
from app.ui.refusal import Refusal
from app.ui.session import Session
from app.ui.state import Memory

WHITE = cv2.imencode(".png", np.full((60, 60), 255, np.uint8))[1].tobytes()
STROKE = np.array([[-40.0, 60.0], [40.0, 60.0]])


class Bench(Executor):
    """Jobs wait here until the test has them done."""

    def __init__(self) -> None:
        self.waiting: deque[tuple[Future[Any], Callable[[], Any]]] = deque()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.waiting.append((future, lambda: fn(*args, **kwargs)))
        return future

    async def work(self) -> None:
        """Do what waits and what follows from it."""
        await breathe()
        while self.waiting:
            future, job = self.waiting.popleft()
            if future.set_running_or_notify_cancel():
                future.set_result(job())
            await breathe()


async def breathe() -> None:
    for _ in range(10):
        await asyncio.sleep(0)


class Scene:
    """A desk whose four lines of work are `quick`, `thorough`, `reader` and `planner`."""

    def __init__(self, robot: str) -> None:
        self.told: list[str] = []
        self.session = Session(Memory(robot))
        self.quick, self.thorough, self.reader, self.planner = benches = [Bench() for _ in range(4)]
        self.desk = DrawingDesk(self.session, *(Worker(bench, self.told.append) for bench in benches))
        self.desk.settled = lambda: False

    async def settle(self) -> None:
        for _ in range(3):
            for bench in (self.reader, self.quick, self.thorough, self.planner):
                await bench.work()

    async def open(self, name: str = "robot", mode: str = "centreline") -> None:
        self.desk.choose_sheet("A6", False)
        self.desk.choose_mode(mode)
        self.desk.take_sample(name)
        await self.settle()
        assert self.desk.plan is not None


def on_desk(play: Callable[[Scene], Awaitable[None]], robot: str = "delta3") -> None:
    async def scene() -> None:
        stage = Scene(robot)
        await play(stage)
        assert not stage.told

    asyncio.run(scene())


def test_a_robot_chosen_before_the_first_drawing_is_the_one_that_draws():
    async def play(scene: Scene) -> None:
        scene.desk.open()
        await scene.reader.work()
        scene.session.choose_robot("fivebar")
        await scene.settle()
        desk = scene.desk
        assert desk.sketch is not None and desk.plan is not None
        assert desk.sketch.setup.robot == "fivebar" and desk.plan.track.pose.shape[1] == scene.session.robot.dof
        assert desk.settings.pen.lift_mm == desk.sketch.setup.pen.lift_mm == 2.0

    on_desk(play)


@pytest.mark.parametrize("mode", ["centreline", "one_line"])
def test_a_picture_on_its_way_is_not_lost_to_a_change_of_the_pen(mode: str):
    async def play(scene: Scene) -> None:
        await scene.open("robot", mode)
        scene.desk.take_sample("logo")
        await scene.reader.work()
        scene.desk.set_pen(speed_mm_s=50.0)
        await scene.settle()
        late = scene.desk.sketch
        scene.desk.choose_mode(mode)
        await scene.settle()
        fresh = scene.desk.sketch
        assert late is not None and fresh is not None and late.setup.pen.speed_mm_s == 50.0
        assert [len(stroke) for stroke in late.strokes] == [len(stroke) for stroke in fresh.strokes]

    on_desk(play)


def test_a_picture_on_its_way_is_not_lost_to_a_drag_of_the_sheet():
    async def play(scene: Scene) -> None:
        await scene.open()
        before = scene.desk.sketch
        scene.desk.take_sample("logo")
        await scene.reader.work()
        scene.desk.move_sheet(Placement(-0.34, (0.01, 0.0)), finished=False)
        await scene.settle()
        is_new = scene.desk.sketch is not before
        assert is_new

    on_desk(play)


def test_what_would_be_out_of_reach_is_not_told_of_another_drawing():
    async def play(scene: Scene) -> None:
        await scene.open("robot", "one_line")
        told: list[list[Any]] = []
        scene.desk.moved.connect(told.append)
        scene.desk.turn(points=1000.0)
        await breathe()
        scene.desk.move_sheet(Placement(-0.34, (0.01, 0.0)), finished=False)
        await scene.thorough.work()
        await scene.quick.work()
        assert scene.desk.sketch is not None
        assert all(len(masks[0]) == len(scene.desk.sketch.strokes[0]) for masks in told)

    on_desk(play)


def test_another_robot_gets_the_last_drawing_though_the_present_one_is_refused():
    async def play(scene: Scene) -> None:
        await scene.open()
        desk, plans = scene.desk, []
        desk.take_file("white.png", WHITE)
        await scene.settle()
        refusal = desk.refusal
        assert isinstance(refusal, Refusal)
        desk.planned.connect(plans.append)
        scene.session.choose_robot("linear")
        assert desk.plan is None and plans == [None], "the old robot's way is no way for the new one"
        await scene.settle()
        assert desk.sketch is not None and desk.plan is not None and desk.sketch.setup.robot == "linear"
        assert desk.refusal == refusal, "and it is still said why"

    on_desk(play)


def test_a_plan_for_another_robot_comes_too_late():
    async def play(scene: Scene) -> None:
        await scene.open()
        desk = scene.desk
        desk.set_pen(speed_mm_s=50.0)
        await scene.quick.work()
        scene.session.choose_robot("par4")
        await scene.planner.work()
        has_plan = desk.plan is not None
        assert not has_plan

    on_desk(play)


def test_what_is_drawn_by_hand_is_not_replaced_by_a_file_that_was_being_read():
    async def play(scene: Scene) -> None:
        await scene.open()
        scene.desk.take_sample("logo")
        await breathe()
        scene.desk.take_strokes([STROKE])
        await scene.settle()
        assert scene.desk.source_name == "hand" and scene.desk.sketch is not None
        assert len(scene.desk.sketch.strokes) == 1

    on_desk(play)


def test_the_paper_is_not_turned_under_a_hand_that_draws():
    async def play(scene: Scene) -> None:
        scene.desk.choose_sheet("A5", False)
        scene.desk.take_strokes([STROKE])
        await scene.settle()
        assert not scene.desk.settings.landscape

    on_desk(play, "fivebar")
