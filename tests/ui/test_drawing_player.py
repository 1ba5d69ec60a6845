"""A drawing played on the robot: where it pauses, what it says meanwhile, and who may interrupt."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any

import numpy as np
import pytest

from app.drawing.toolpath import Track, default_placement, pause_after, plan_toolpath, track
from app.robots import build_robot
from app.ui.drawing.player import DrawingPlayer, State
from app.ui.playback import Playback
from app.ui.session import Session
from app.ui.state import Memory
from tests.support.small_lab import eventually

FAST = 10.0
"""Several strokes pass between two frames, so that a pause is not met by chance."""

ROBOT = build_robot("delta3", {})
STROKES = [np.array([[-40.0, y], [40.0, y]]) for y in (-20.0, -10.0, 0.0, 10.0, 20.0)]


@pytest.fixture(scope="module")
def five_lines() -> Track:
    return track(plan_toolpath(STROKES, ROBOT, default_placement(ROBOT)))


class Table:
    """A session with a player that notes what it says."""

    def __init__(self, drawing: Track, speed: float = FAST) -> None:
        self.session = Session(Memory("delta3"))
        self.player = DrawingPlayer(self.session, Playback(self.session))
        self.states: list[State] = []
        self.times: list[float] = []
        self.player.state_changed.connect(self.states.append)
        self.player.moved.connect(self.times.append)
        self.player.load(drawing, speed)

    def height_over_paper(self) -> float:
        return self.session.stance.pose[2] - default_placement(ROBOT).height_m

    async def until(self, state: State) -> None:
        await eventually(lambda: self.player.state == state, state)


def run(scene: Coroutine[Any, Any, None]) -> None:
    asyncio.run(scene)


def test_it_draws_to_the_end_and_begins_again(five_lines: Track) -> None:
    async def scene() -> None:
        table = Table(five_lines)
        player = table.player
        assert player.state == "ready" and player.progress == 0.0 and player.drawn == (-1, 0.0, 0)
        player.play()
        await table.until("done")
        assert table.states == ["ready", "drawing", "done"]
        assert table.times == sorted(table.times)
        assert player.progress == 1.0 and player.remaining_s == 0.0 and player.drawn == (-1, 0.0, 5)
        assert table.session.stance.joints == pytest.approx(tuple(five_lines.q[-1]))
        player.play()
        assert player.state == "drawing" and player.time_s == 0.0
        player.pause()
        player.pause()

    run(scene())


def test_a_pause_comes_where_the_pen_is_lifted(five_lines: Track) -> None:
    async def scene() -> None:
        table = Table(five_lines, 1.0)
        middle = float(five_lines.t[np.flatnonzero(five_lines.stroke == 1)[40]])
        table.player.seek(middle)
        table.player.speed = FAST
        table.player.play()
        table.player.pause()
        assert table.player.state == "pausing"
        await table.until("paused")
        assert table.player.time_s == pytest.approx(pause_after(five_lines, middle))
        assert table.player.drawn == (-1, 0.0, 2), "the stroke is finished, the next not begun"
        assert table.height_over_paper() == pytest.approx(0.004, abs=1e-4)
        table.player.play()
        assert table.states[-3:] == ["pausing", "paused", "drawing"]
        await table.until("done")

    run(scene())


def test_asked_twice_it_stops_at_once(five_lines: Track) -> None:
    async def scene() -> None:
        table = Table(five_lines, 0.5)
        table.player.seek(float(five_lines.t[np.flatnonzero(five_lines.stroke == 1)[40]]))
        table.player.play()
        await asyncio.sleep(0.12)
        table.player.pause()
        table.player.pause()
        assert table.player.state == "paused"
        assert table.height_over_paper() == pytest.approx(0.0, abs=1e-6), "in the middle of a stroke"

    run(scene())


def test_a_pause_can_be_taken_back(five_lines: Track) -> None:
    async def scene() -> None:
        table = Table(five_lines)
        table.player.play()
        table.player.pause()
        table.player.play()
        assert table.player.state == "drawing"
        await table.until("done")
        assert table.player.time_s == five_lines.duration_s

    run(scene())


def test_scrubbing_stands_still_at_that_instant(five_lines: Track) -> None:
    async def scene() -> None:
        table = Table(five_lines)
        table.player.play()
        await asyncio.sleep(0.12)
        k = int(np.flatnonzero(five_lines.stroke == 3)[50])
        table.player.seek(float(five_lines.t[k]))
        assert table.player.state == "paused"
        assert table.session.stance.pose == pytest.approx(tuple(five_lines.pose[k]))
        stroke, along, done = table.player.drawn
        assert (stroke, done) == (3, 3) and along == pytest.approx(1e-3 * five_lines.along_mm[k])
        assert table.player.progress == pytest.approx(five_lines.t[k] / five_lines.duration_s)
        table.player.seek(1e9)
        assert table.player.state == "done" and table.player.time_s == five_lines.duration_s
        table.player.seek(0.0)
        assert table.player.state == "ready"

    run(scene())


def test_stopping_goes_home_and_the_drawing_can_be_resumed(five_lines: Track) -> None:
    async def scene() -> None:
        table = Table(five_lines)
        table.player.play()
        await asyncio.sleep(0.12)
        table.player.stop()
        stopped = table.player.time_s
        assert table.player.state == "paused" and stopped > 0.0
        assert table.session.stance.pose == pytest.approx(tuple(ROBOT.home))
        await asyncio.sleep(0.12)
        assert table.player.time_s == stopped
        table.player.play()
        await table.until("done")

    run(scene())


def test_a_hand_on_the_robot_pauses_at_once_even_while_pausing(five_lines: Track) -> None:
    async def scene() -> None:
        table = Table(five_lines, 0.5)
        for pausing in (False, True):
            table.player.play()
            await asyncio.sleep(0.12)
            if pausing:
                table.player.pause()
            table.session.drag(position=(0.0, 0.0, -0.30))
            assert table.player.state == "paused"
            assert table.session.stance.pose[2] == pytest.approx(-0.30)

    run(scene())


def test_another_robot_empties_it(five_lines: Track) -> None:
    async def scene() -> None:
        table = Table(five_lines)
        table.player.play()
        await asyncio.sleep(0.06)
        table.session.choose_robot("par4")
        assert table.player.state == "empty" and table.player.track is None
        assert table.player.progress == 0.0 and len(table.player.lengths_m) == 0
        for act in (table.player.play, table.player.pause, table.player.play, lambda: table.player.seek(3.0)):
            act()
            assert table.player.state == "empty" and table.player.time_s == 0.0

    run(scene())


def test_what_remains_counts_at_the_present_speed(five_lines: Track) -> None:
    player = Table(five_lines, 1.0).player
    player.seek(0.25 * five_lines.duration_s)
    assert player.remaining_s == pytest.approx(0.75 * five_lines.duration_s)
    player.speed = 5.0
    assert player.remaining_s == pytest.approx(0.15 * five_lines.duration_s)
    player.load(five_lines)
    assert player.speed == 5.0, "a new plan of the drawing is played as fast as the last"


def test_lengths_are_those_that_the_ink_is_told(five_lines: Track) -> None:
    lengths = Table(five_lines).player.lengths_m
    assert lengths == pytest.approx([0.080] * 5, abs=2e-4)
