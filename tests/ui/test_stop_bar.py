"""Stop on every page: who sees it, what it says, and that anybody's press stops the board."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Iterator
from typing import Any

import pytest

from app.link.lease import Person
from app.link.protocol.codes import Fault, Flag, Refusal, State
from app.link.protocol.messages import Telemetry
from app.link.status import LinkStatus
from app.ui.hardware import stop_script
from app.ui.hardware.stop_bar import bar_script
from tests.support.robot_lab import ADA, RobotLab, robot_lab
from tests.support.wire import Message, WireClient, run_async, wire_client

BOB, CHIEF = Person("bob", "Bob <b>"), Person("chief", "Chief", instructor=True)


@pytest.fixture(scope="module")
def lab() -> Iterator[RobotLab]:
    with robot_lab("delta3") as running:
        yield running


def status(state: State, **news: Any) -> LinkStatus:
    zeros = (0.0,) * 4
    telemetry = Telemetry(state, Flag.HOMED, Fault.NONE, 0, Refusal.OK, 0, 0, zeros, zeros, zeros, 0, 0, 0)
    return LinkStatus("ready", telemetry=telemetry, holder=ADA, **news)


def said(script: str) -> dict[str, Any]:
    """What a script tells the bar."""
    head = "window.deltalabStop?.show("
    assert script.startswith(head)
    return json.loads(script.removeprefix(head).removesuffix(");"))


def test_clear_is_for_the_holder_and_the_instructor_after_a_stop():
    for person, may in ((ADA, True), (BOB, False), (CHIEF, True)):
        assert said(bar_script(status(State.STOPPED), person))["clear"] is may
        assert not said(bar_script(status(State.MOVING), person))["clear"]
    assert said(bar_script(status(State.STOPPED), ADA))["word"] == "Stopped"


def test_the_bar_says_who_and_how_far():
    moving = status(State.MOVING, activity="run", progress=0.344, program_title="Drawing")
    assert said(bar_script(moving, ADA))["word"] == "Moving · 34 %"
    assert said(bar_script(moving, ADA))["line"] == "You have control"
    assert said(bar_script(moving, BOB))["line"] == "Ada has control"


def test_nothing_a_student_types_becomes_script():
    """Texts are JSON, which ends no script and no string early."""
    script = stop_script.show(mark="■", color="red", word='");alert(1);("', line="</script>\u2028", clear=False)
    assert said(script)["word"] == '");alert(1);("' and "\u2028" not in script


class Page:
    """A page that has not opened the tab Hardware, as the wire sees it."""

    def __init__(self, client: WireClient) -> None:
        self.client = client
        self.scripts: list[str] = []
        client.listeners.append(self._see)
        self._presses = 0

    def _see(self, message: Message, _: float) -> None:
        if message["type"] == "RunJavascriptMessage" and message["source"].startswith("window.deltalabStop"):
            self.scripts.append(message["source"])

    @property
    def bar(self) -> dict[str, Any]:
        """What the bar shows; empty where it is hidden."""
        shown = [script for script in self.scripts if ".answered(" not in script]
        return said(shown[-1]) if shown and ".show(" in shown[-1] else {}

    async def press(self, what: str) -> None:
        self._presses += 1
        await self.client.set_value("Stop pressed", f"{what} {self._presses}")

    async def until_word(self, word: str) -> None:
        await self.client.wait_for(lambda: self.bar.get("word", "") == word, f"{word!r}, but {self.bar}")


def test_a_strangers_stop_stops_the_board_and_only_the_holder_clears(lab: RobotLab):
    async def scene() -> None:
        async with wire_client(lab.url) as client:
            page = Page(client)
            await client.wait_for(lambda: client.has("Hardware opened"), "furnished room")
            await asyncio.sleep(0.5)
            assert not page.scripts, "without a robot nothing is sent"
            await asyncio.to_thread(lab.connect, "sim:delta3")
            await page.until_word("Motors off")
            await asyncio.to_thread(lab.make_ready)
            await page.until_word("Idle")
            assert page.bar["line"] == "Ada has control" and not page.bar["clear"]
            await jog_until_stopped(lab, page)
            await page.until_word("Stopped")
            await asyncio.sleep(0.2)  # the set-point runs out
            resting = lab.setpoint
            heard = len(page.scripts)
            await asyncio.sleep(0.5)
            assert lab.setpoint == resting and lab.state is State.STOPPED
            assert len(page.scripts) == heard, "nothing has changed, so nothing is sent"
            for forged in ("clear", "close", "__class__", "", "stop" * 99):
                await page.press(forged)
            await asyncio.sleep(0.5)
            assert lab.state is State.STOPPED
            await asyncio.to_thread(lambda: lab.link.clear(ADA).result(5.0))
            await page.until_word("Idle")
            await asyncio.to_thread(lambda: lab.link.disconnect().result(5.0))
            await client.wait_for(lambda: not page.bar, "hidden bar")

    run_async(scene())


async def jog_until_stopped(lab: RobotLab, page: Page) -> None:
    """The holder goes on renewing, as a held button does; the stranger presses in the middle."""
    for k in range(40):
        lab.link.alive(ADA)
        await asyncio.to_thread(lab.start_jog)
        if k > 4 and lab.state in (State.READY, State.MOVING):
            await page.press("stop")
        if lab.state is State.STOPPED:
            return
        await asyncio.sleep(0.05)
    raise AssertionError(f"the robot is {lab.state!r}")
