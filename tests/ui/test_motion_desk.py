"""The motion desk without a page: what is planned, refused, kept, and played."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from app.motion import CYCLES, Motion, default_motion
from app.ui.compute import Worker
from app.ui.motion import jobs
from app.ui.motion.desk import MotionDesk
from app.ui.motion.path_view import path_segments
from app.ui.session import Session
from app.ui.state import Memory


def with_desk(scene: Callable[[MotionDesk, Session], Awaitable[None]], memory: Memory) -> None:
    """Play a scene on an event loop; no worker may have anything to complain of."""
    told: list[str] = []

    async def play() -> None:
        with ThreadPoolExecutor(2) as pool:
            session = Session(memory)
            workers = [Worker(pool, told.append) for _ in range(2)]
            desk = MotionDesk(session, *workers)
            await scene(desk, session)
            desk.close()
            for worker in workers:
                worker.cancel()

    asyncio.run(play())
    assert told == []


async def until(condition: Callable[[], object], what: str) -> None:
    for _ in range(3000):
        if condition():
            return
        await asyncio.sleep(0.01)
    raise AssertionError(f"no {what}")


async def opened(desk: MotionDesk) -> Motion:
    desk.open()
    await until(lambda: desk.motion is not None, "motion")
    assert desk.motion is not None
    return desk.motion


def test_nothing_is_planned_before_somebody_looks_and_the_newest_wins():
    async def scene(desk: MotionDesk, session: Session) -> None:
        sizes: list[float] = []
        desk.planned.connect(lambda motion: sizes.append(motion.settings.size_m))  # type: ignore[union-attr]
        desk.change(size_m=0.03)
        await asyncio.sleep(0.02)
        assert desk.motion is None and not desk.planning
        desk.open()
        for size in (0.031, 0.032, 0.033, 0.034):
            desk.change(size_m=size)
        await until(lambda: sizes and sizes[-1] == 0.034, "newest plan")
        assert len(sizes) <= 2, "what was overtaken is never shown"

    with_desk(scene, Memory("par4"))


def test_a_refusal_leaves_the_last_motion_and_is_forgotten_with_the_next_one():
    async def scene(desk: MotionDesk, session: Session) -> None:
        good = await opened(desk)
        desk.change(duration_s=0.02)
        await until(lambda: desk.refusal, "refusal")
        assert desk.motion is good and desk.refusal.count(".") >= 1 and "\n" not in desk.refusal
        desk.change(duration_s=None)
        await until(lambda: not desk.refusal, "motion")
        assert desk.motion is not good

    with_desk(scene, Memory("delta3"))


def test_an_out_of_reach_size_is_refused_in_words():
    async def scene(desk: MotionDesk, session: Session) -> None:
        await opened(desk)
        desk.change(size_m=0.9)
        await until(lambda: desk.refusal, "refusal")

    with_desk(scene, Memory("linear"))


def test_what_is_being_played_goes_on_along_the_new_motion():
    async def scene(desk: MotionDesk, session: Session) -> None:
        await opened(desk)
        desk.playback.speed = 0.1
        desk.playback.play()
        await until(lambda: desk.playback.time_s > 0.02, "robot on its way")
        before, share = desk.motion, desk.playback.time_s / desk.playback.duration_s
        desk.change(size_m=0.02)
        await until(lambda: desk.motion is not before, "smaller motion")
        assert desk.playback.playing and desk.playback.run is desk.motion and desk.playback.speed == 0.1
        assert desk.playback.time_s >= 0.9 * share * desk.playback.duration_s
        session.drag((0.0, 0.0, -0.3))
        assert not desk.playback.playing, "somebody who moves the robot has it"
        held = session.stance
        desk.change(size_m=0.021)
        await until(lambda: desk.motion is not None and desk.motion.settings.size_m == 0.021, "another motion")  # type: ignore[union-attr]
        assert session.stance is held, "planning moves nothing"

    with_desk(scene, Memory("delta3"))


def test_another_robot_keeps_the_choice_of_curve_and_its_own_size():
    async def scene(desk: MotionDesk, session: Session) -> None:
        await opened(desk)
        desk.change(curve="lemniscate", size_m=0.011)
        session.choose_robot("linear")
        assert desk.motion is None and desk.playback.run is None
        assert (desk.course.curve, desk.course.size_m) == ("lemniscate", default_motion("linear").size_m)
        motion = await opened(desk)
        assert motion.q.shape[1] == 3
        session.reshape(S_A=0.49)
        await until(lambda: desk.motion is not None and desk.motion is not motion, "plan for other dimensions")
        assert desk.course.dimensions == session.dimensions

    with_desk(scene, Memory("delta3"))


def test_the_work_cycle_belongs_to_the_five_bar_and_is_remembered():
    async def scene(desk: MotionDesk, session: Session) -> None:
        desk.take_cycle(CYCLES["W2"])
        motion = await opened(desk)
        assert motion.t[-1] == pytest.approx(2.46) and motion.settings == CYCLES["W2"]
        again = MotionDesk(Session(session.memory), *[Worker(None, print)] * 2)  # type: ignore[arg-type]
        assert again.cycling and again.cycle == CYCLES["W2"]
        session.choose_robot("par4")
        assert not desk.cycling and desk.settings is desk.course and desk.course.robot == "par4"

    with_desk(scene, Memory("fivebar"))


@pytest.mark.parametrize("robot", ["par4", "linear"])
def test_the_csv_holds_every_sample_in_si(robot: str):
    motion = jobs.plan(default_motion(robot))
    assert isinstance(motion, Motion)
    head, *rows = jobs.motion_csv(motion, robot).decode().splitlines()
    names = head.split(",")
    table = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    assert table.shape == (len(motion.t), len(names))
    joint = names.index("d2_effort" if robot == "linear" else "q2_effort")
    assert table[:, joint] == pytest.approx(motion.efforts[:, 1], rel=1e-8, abs=1e-9)
    speed = names.index("z_rate")
    assert table[:, speed] == pytest.approx(np.gradient(table[:, names.index("z")], table[:, 0]), abs=2e-2)


def test_no_touch_of_a_limit_is_lost_when_the_path_is_thinned():
    motion = jobs.plan(default_motion("par4"))
    assert isinstance(motion, Motion)
    segments, touched = path_segments(motion)
    assert len(segments) == len(touched) <= 800 and touched.any() == motion.touched.any()
    assert np.allclose(segments[1:, 0], segments[:-1, 1]) and np.allclose(segments[-1, 1], motion.pose[-1, :3])
