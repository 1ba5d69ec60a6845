"""The robot on the table and the one in the picture, over the wire: ghost, mirror, follow, drawing, gains."""

from __future__ import annotations

import asyncio
import math
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager

import pytest

from app.link.protocol.codes import State
from app.link.protocol.settings import setting_id
from app.ui.guard import new_browser_id
from tests.support.hardware_visitor import Visitor
from tests.support.robot_lab import RobotLab, robot_lab
from tests.support.wire import run_async, wire_client

GIZMO, GHOST = "/robot/gizmo", "/robot/measured"
MIRROR = "Mirror the gizmo"


@pytest.fixture(scope="module")
def lab() -> Iterator[RobotLab]:
    with robot_lab("delta3") as running:
        running.connect("sim:delta3?drive=dc")
        yield running


@asynccontextmanager
async def holder(lab: RobotLab) -> AsyncIterator[Visitor]:
    """A page with the tab Hardware open, whose person holds a robot that is homed."""
    browser = new_browser_id()
    async with wire_client(lab.url, headers={"Cookie": f"deltalab_id={browser}"}) as client:
        await client.wait_for(lambda: client.has("Hardware opened"), "furnished room")
        one = Visitor(client)
        await client.set_value("Hardware opened", True)
        await client.wait_for(lambda: client.has("Calibration pressed") and one.word, "tab Hardware", 60.0)
        living = asyncio.create_task(one.live())
        me = lab.lab.workshop.people.person(browser)
        try:
            await asyncio.to_thread(lab.make_ready, me)
            await one.until(lambda: "<b>You</b> have control" in one.said, "control")
            yield one
        finally:
            living.cancel()
            await asyncio.to_thread(lab.link.release(me).result, 5.0)


async def until(condition, what: str, timeout_s: float = 15.0) -> None:
    """Poll what the server knows."""
    for _ in range(math.ceil(timeout_s / 0.02)):
        if condition():
            return
        await asyncio.sleep(0.02)
    raise AssertionError(f"no {what} within {timeout_s:g} s")


def commanded(lab: RobotLab) -> tuple[float, ...]:
    assert lab.status.commanded_pose is not None
    return lab.status.commanded_pose


async def drag(one: Visitor, *positions: tuple[float, float, float]) -> None:
    await one.client.start_drag(GIZMO)
    for position in positions:
        await one.client.drag(GIZMO, position)
        await asyncio.sleep(0.05)


def ghosts(one: Visitor) -> list[str]:
    return [name for name in one.client.nodes if name.startswith(f"{GHOST}/")]


def test_the_mirror_moves_with_a_new_drag_and_ends_with_the_hand(lab: RobotLab):
    async def scene() -> None:
        async with holder(lab) as one:
            start = commanded(lab)
            await drag(one, (0.03, 0.0, start[2]))
            await one.client.end_drag(GIZMO)
            await one.until(lambda: ghosts(one), "ghost of the robot where it really is")
            await one.set(MIRROR, True)
            await one.until(lambda: math.dist(one.client.positions[GIZMO], start) < 2e-3, "gizmo where the robot is")
            await one.until(lambda: not ghosts(one), "one robot: both stand at the same place")
            await asyncio.sleep(0.3)
            assert math.dist(commanded(lab), start) < 1e-4, "switching it on moves nothing"
            goal = (0.02, 0.01, start[2] - 0.01)
            await drag(one, (0.01, 0.005, start[2]), goal)
            await until(lambda: math.dist(commanded(lab), goal) < 1e-3, "robot at the gizmo")
            assert lab.status.activity == "mirror"
            await one.client.end_drag(GIZMO)
            await until(lambda: lab.status.activity == "idle", "end of the mirroring")
            assert math.dist(commanded(lab), goal) < 1e-3

    run_async(scene())


def test_a_stop_ends_the_mirror_and_nothing_goes_on_by_itself(lab: RobotLab):
    async def scene() -> None:
        async with holder(lab) as one:
            start = commanded(lab)
            await one.set(MIRROR, True)
            await asyncio.sleep(0.2)
            await drag(one, (0.04, 0.0, start[2] - 0.03))
            await until(lambda: lab.state is State.MOVING, "motion")
            await one.client.set_value("Stop pressed", "stop 1")
            await one.until(lambda: one.client.value_of(MIRROR) is False, "mirror off")
            await one.until_word("Stopped")
            await one.client.drag(GIZMO, (-0.04, 0.0, start[2]))
            await one.client.end_drag(GIZMO)
            await one.press("Motors", "clear")
            await until(lambda: lab.state is State.READY, "cleared stop")
            await asyncio.sleep(0.2)  # the set-point runs out
            resting = lab.setpoint
            await drag(one, (0.0, 0.0, start[2]))
            await one.client.end_drag(GIZMO)
            await asyncio.sleep(0.4)
            assert lab.setpoint == resting and lab.status.activity == "idle"

    run_async(scene())


def test_the_mirror_is_refused_without_control(lab: RobotLab):
    async def scene() -> None:
        async with holder(lab) as one:
            await one.press("Control", "release")
            await one.until(lambda: "Nobody has control" in one.said, "free robot")
            await one.set(MIRROR, True)
            await one.until_told("Request control first.")
            await one.until(lambda: one.client.value_of(MIRROR) is False, "mirror off")

    run_async(scene())


def test_other_dimensions_have_no_ghost_and_the_tab_offers_the_right_ones(lab: RobotLab):
    async def scene() -> None:
        async with holder(lab) as one:
            start = commanded(lab)
            await drag(one, (0.03, 0.0, start[2]))
            await one.client.end_drag(GIZMO)
            await one.until(lambda: ghosts(one), "ghost")
            room = next(iter(lab.lab.rooms.values()))
            lab.on_the_loop(lambda: room.session.choose_robot("linear"))
            await one.until(lambda: not ghosts(one), "no ghost of another robot")
            await one.press("Board's robot", "show")
            await one.until(lambda: room.session.robot_name == "delta3", "robot of the board")
            await drag(one, (0.03, 0.0, start[2]))
            await one.client.end_drag(GIZMO)
            await one.until(lambda: ghosts(one), "ghost")
            lab.on_the_loop(lambda: room.session.reshape(rf=0.17))
            await one.until(lambda: not ghosts(one), "no ghost of other dimensions")
            await one.press("Board's robot", "show")
            await one.until(lambda: room.session.dimensions.get("rf", 0.16) == 0.16, "dimensions of the board")

    run_async(scene())


def test_the_picture_follows_the_robot_if_asked_to(lab: RobotLab):
    async def scene() -> None:
        async with holder(lab) as one:
            await one.set("Follow the robot", True)
            await one.set("Move", "Tool")
            await one.set("By", "10 mm or °")
            start = commanded(lab)
            await one.until(lambda: "Moves y by +10 mm" in one.said, "buttons of the tool")
            await one.press("Jog", "pose:1:+")
            await one.until(lambda: abs(one.client.positions[GIZMO][1] - start[1] - 0.01) < 1e-4, "gizmo 10 mm aside")
            assert not ghosts(one)

    run_async(scene())


def test_gains_go_to_all_joints_and_come_back(lab: RobotLab):
    async def scene() -> None:
        async with holder(lab) as one:
            await one.set("Control opened", True)
            await one.until(lambda: one.client.has("Board's gains pressed"), "panel", 60.0)
            await one.until(lambda: one.why_not("Send gains to the board") is None, "button")
            await one.set("kp", 0.5)
            await one.press("Board's gains", "send")
            kp = [setting_id("kp", joint) for joint in range(3)]
            await until(lambda: all(abs(lab.status.settings[id] - math.degrees(0.5)) < 1e-3 for id in kp), "new gains")
            await one.until(lambda: "read back. Stable: phase margin" in one.said, "answer")
            await one.set("kp", 900.0)
            await one.press("Board's gains", "send")
            await one.until_told("swing")
            assert all(abs(lab.status.settings[id] - math.degrees(0.5)) < 1e-3 for id in kp), "nothing unsafe was sent"
            await one.press("Board's gains", "read")
            await one.until(lambda: abs(one.client.value_of("kp") - 0.5) < 1e-3, "gains of the board")

    run_async(scene())


def test_the_drawing_is_drawn_by_the_robot(lab: RobotLab):
    async def scene() -> None:
        async with holder(lab) as one:
            await one.set("Draw opened", True)
            await one.until(lambda: one.client.has("Drawing on the robot pressed"), "panel", 60.0)
            await one.until(lambda: one.why_not("Draw with the robot") is None, "plan of the drawing", 60.0)
            await one.press("Drawing on the robot", "draw")
            await until(lambda: lab.status.progress > 0.0, "robot that draws", 30.0)
            assert lab.status.activity == "run"
            await one.until(lambda: "The robot draws: " in one.said, "progress")
            await one.until(lambda: any("sheet/ink" in name for name in one.client.nodes), "ink")
            await one.press("Drawing on the robot", "cancel")
            await until(lambda: lab.status.activity == "idle", "end")
            await one.press("Control", "release")
            await one.until(lambda: one.why_not("Draw with the robot") == "Request control first.", "reason")

    run_async(scene())
