"""The tab Hardware over the wire, against an emulated board: who may do what, and that the robot does it."""

from __future__ import annotations

import asyncio
import contextlib
import math
import re
from collections.abc import Awaitable, Callable, Iterator

import pytest

from app.link.twin.recording import Recording
from app.ui.guard import new_browser_id
from tests.support.hardware_visitor import Visitor, visitor
from tests.support.server import RunningServer, ServerFactory, running_deltalab
from tests.support.wire import run_async

TOOL = re.compile(r">z</span><br>([-\d.]+)<")


@pytest.fixture(scope="module")
def server() -> Iterator[RunningServer]:
    """It must print no traceback: leaving it looks for one."""
    with running_deltalab("--no-shadows", "--robot", "delta3", "--serial", "sim:delta3", "--pin", "4711") as running:
        yield running


def tool_z(one: Visitor) -> float:
    """mm, as the page shows it."""
    found = TOOL.search(one.said)
    return float(found[1]) if found else float("nan")


async def take(one: Visitor) -> None:
    await one.until(lambda: one.word not in ("", "Not connected", "Connecting"), "board")
    await one.press("Control", "request")
    await one.until(lambda: "<b>You</b> have control" in one.said, "control")


NEXT = {"Stopped": "clear", "Fault": "clear", "Held": "resume", "Motors off": "enable", "Not homed": "home"}
"""What leads on from a state. On a machine with too much to do the board's watchdogs may hold or switch off."""


async def make_ready(one: Visitor) -> None:
    """From any state to homed and idle."""
    await take(one)
    for _ in range(20):
        before = one.word
        if before == "Idle":
            return
        if before in NEXT:
            await one.press("Motors", NEXT[before])
        with contextlib.suppress(AssertionError):
            await one.until(lambda: one.word != before, "next state", 2.0)  # noqa: B023
    raise AssertionError(f"the robot never got ready: it is {one.word}")


async def insist(one: Visitor, grid: str, key: str, done: Callable[[], bool], what: str) -> None:
    """Press a button until it has had its effect: a board may need a moment to see that a fault is gone."""
    for _ in range(10):
        await one.press(grid, key)
        with contextlib.suppress(AssertionError):
            await one.until(done, what, 2.0)
            return
    raise AssertionError(f"no {what}: the robot is {one.word}, and the page says {one.told}")


async def achieve(one: Visitor, act: Callable[[], Awaitable[None]], done: Callable[[], bool], what: str) -> None:
    """Do something with a ready robot until it has had its effect."""
    for _ in range(6):
        await make_ready(one)
        await act()
        with contextlib.suppress(AssertionError):
            await one.until(done, what, 3.0)
            return
    raise AssertionError(f"no {what}: the robot is {one.word}, and the page says {one.told}")


async def leave(one: Visitor) -> None:
    await one.press("Control", "release")
    await one.until(lambda: "<b>You</b> have control" not in one.said, "robot handed over")


def test_from_cold_to_a_step_and_a_stop(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one:
            await one.until_word("Motors off")
            assert one.why_not("Enable") == "Request control first."
            await one.press("Motors", "enable")
            await one.until_told("Request control first.")
            await make_ready(one)
            await one.until(lambda: abs(tool_z(one) + 330.0) < 0.06, "tool at home")
            await one.set("Move", "Tool")
            await one.set("By", "10 mm or °")
            await one.until(lambda: "Moves z by -10 mm" in one.said, "buttons of the tool")
            await achieve(one, lambda: one.press("Jog", "pose:2:-"), lambda: tool_z(one) < -339.9, "tool 10 mm below")
            await make_ready(one)
            await one.press("Motors", "power_off")
            await one.until_word("Motors off")
            await leave(one)

    run_async(scene())


def test_a_held_button_moves_and_a_released_one_stops(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one:
            await make_ready(one)
            await one.set("Move", "Tool")
            await one.until(lambda: "data-hold=" in one.said, "armed buttons")
            await one.until(lambda: not math.isnan(tool_z(one)), "place of the tool")
            before = tool_z(one)
            await achieve(one, lambda: one.hold("pose:2:-", 0.8), lambda: tool_z(one) < before - 3.0, "motion")
            await one.until(lambda: one.word != "Moving", "rest")
            await asyncio.sleep(0.5)
            rests = tool_z(one)
            await asyncio.sleep(0.5)
            assert tool_z(one) == rests
            await leave(one)

    run_async(scene())


def test_the_second_waits_and_gets_the_robot(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one, visitor(server) as two:
            await two.set("Your name", "<i>Zoe</i>")
            await take(one)
            await two.press("Control", "request")
            await two.until(lambda: "1. <b>you</b>" in two.said, "place in the queue")
            await one.until(lambda: "1. &lt;i&gt;Zoe" in one.said, "name of who waits")
            await two.press("Motors", "enable")
            await two.until_told("has control: request it")
            await leave(one)
            await two.until(lambda: "<b>You</b> have control" in two.said, "turn of the second")
            await leave(two)

    run_async(scene())


def test_an_instructor_takes_over_and_a_wrong_pin_does_not(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one, visitor(server) as chief:
            await take(one)
            await chief.set("Instructor's PIN", "1234")
            await chief.press("PIN", "prove")
            await chief.until_told("This is not the PIN")
            await chief.press("Control", "take_over")
            assert "Take over" not in chief.said
            await chief.set("Instructor's PIN", "4711")
            await chief.press("PIN", "prove")
            await chief.until(lambda: "Take over" in chief.said, "button to take over")
            await chief.press("Control", "take_over")
            await chief.until(lambda: "<b>You</b> have control (instructor)" in chief.said, "robot")
            await one.until(lambda: "1. <b>you</b>" in one.said, "first place in the queue")
            await leave(chief)
            await one.until(lambda: "<b>You</b> have control" in one.said, "robot again")
            await leave(one)

    run_async(scene())


def test_a_reload_keeps_the_robot(server: RunningServer):
    async def scene() -> None:
        headers = {"Cookie": f"deltalab_id={new_browser_id()}"}
        async with visitor(server, headers) as one:
            await one.set("Your name", "Ada")
            await take(one)
        async with visitor(server, headers) as again:
            await again.until(lambda: "<b>You</b> have control" in again.said, "same holder")
            assert again.client.value_of("Your name") == "Ada"
            await leave(again)

    run_async(scene())


def test_faults_can_be_tried_and_mended(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one:
            await make_ready(one)
            await one.set("Emergency stop pressed", True)
            await one.until_word("Fault")
            assert "emergency stop is pressed" in one.said
            await one.press("Motors", "clear")
            await one.until_told("emergency stop is still pressed")
            await one.press("Faults", "heal")
            await one.until(lambda: not one.client.value_of("Emergency stop pressed"), "mended board")
            await insist(one, "Motors", "clear", lambda: one.word == "Motors off", "cleared fault")
            await one.set("Cable pulled", True)
            await one.until_word("Connection lost")
            await one.set("Cable pulled", False)
            await one.until_word("Motors off")
            await leave(one)

    run_async(scene())


def test_a_setting_is_written_and_read_back(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one:
            await take(one)
            await make_ready(one)
            await insist(one, "Motors", "power_off", lambda: one.word == "Motors off", "power off")
            await one.set("Show", "Safety")
            await one.until(lambda: one.client.has("hold after (ms)"), "fields")
            await one.until(lambda: one.client.value_of("hold after (ms)") > 0, "values of the board")
            await one.set("hold after (ms)", 77.0)
            await one.until(lambda: one.why_not("Apply") is None, "something to apply")
            await one.press("Settings", "apply")
            await one.until_told("read back, they agree")
            await one.set("hold after (ms)", 5000.0)
            await one.until(lambda: one.why_not("Apply") is None, "something to apply")
            await one.press("Settings", "apply")
            await one.until_told("was not changed")
            await one.press("Settings", "defaults")
            await one.until_told("built-in settings")
            await one.until(lambda: one.client.value_of("hold after (ms)") not in (77.0, 0.0, 5000.0), "built-in value")
            await leave(one)

    run_async(scene())


def test_a_recording_is_kept_saved_and_compared(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one:
            await make_ready(one)
            assert one.why_not("Compare") == "Record something first."
            await one.press("Recording", "record")
            await one.until(lambda: "● Recording" in one.said, "recording")
            await asyncio.sleep(1.2)
            await one.press("Recording", "stop")
            await one.until(lambda: one.why_not("Compare") is None, "recording that can be compared")
            await one.press("Recording", "save")
            await one.until(lambda: one.files, "file")
            kept = Recording.from_csv(b"".join(one.files).decode())
            assert kept.robot == "delta3" and kept.duration_s > 0.5 and kept.position.shape[1] == 3
            await one.press("Recording", "compare")
            await one.until(lambda: "Hobby servos report nothing" in one.said, "comparison with the twin", 60.0)
            await leave(one)

    run_async(scene())


def test_a_calibration_needs_more_than_one_pose(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one:
            assert one.why_not("Solve") == "Take a pose first."
            await one.set("Measured (mm)", [1.0, 2.0, -330.0])
            await one.press("Poses", "take")
            await one.until(lambda: ">-330.00</td>" in one.said, "row of the table")
            await one.press("Calibration", "solve")
            await one.until_told("too few")
            await one.press("Calibration", "next")
            await one.until(lambda: "Measure next" in one.said, "poses to measure", 60.0)

    run_async(scene())


def test_forged_messages_move_nothing(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one:
            await take(one)
            for grid in ("Motors", "Control", "Jog", "Run", "Recording", "Drive", "Poses", "Calibration", "Settings"):
                for key in ("close", "__class__", "connect", "", "pose:9:+", "status", "x" * 900):
                    await one.client.set_value(f"{grid} pressed", key)
            await one.hold("joint:0:+", 0.2)
            await one.set("Measured (mm)", [1.0, 2.0, 3.0])
            await asyncio.sleep(0.3)
            assert one.word != "Moving"
            await leave(one)

    run_async(scene())


def test_on_the_network_the_port_is_the_instructors(running_server: ServerFactory):
    """And a port that cannot be opened is said, while the page is served."""
    server = running_server("--no-shadows", "--host", "0.0.0.0", "--serial", "/dev/there-is-no-such-port")
    assert "There is no port /dev/there-is-no-such-port" in server.wait_for_output("no-such-port;")
    pin = re.search(r"PIN is (\d{4})", server.output())
    assert pin

    async def scene() -> None:
        async with visitor(server) as one:
            await one.until_word("Refused")
            assert "There is no port" in one.said
            await one.until(lambda: (one.why_not("Connect") or "").startswith("Only the instructor"), "grey button")
            await one.press("Connection", "connect")
            await one.until_told("Only the instructor")
            await one.set("Instructor's PIN", pin[1])
            await one.press("PIN", "prove")
            await one.until(lambda: one.why_not("Connect") is None, "button")
            await one.press("Connection", "connect")
            await one.until_word("Motors off")

    run_async(scene())
