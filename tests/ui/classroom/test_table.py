"""The robot on the table goes from hand to hand as the instructor says; and a server that is killed forgets nothing."""

from __future__ import annotations

from contextlib import AsyncExitStack
from pathlib import Path

from tests.support.class_lab import PIN, ClassLab, class_client
from tests.support.robot_lab import wait
from tests.support.server import running_deltalab
from tests.support.wire import run_async


def test_the_instructor_hands_the_robot_over_and_takes_it_back(lab: ClassLab) -> None:
    workshop = lab.lab.workshop

    def holder() -> str:
        held = workshop.status.holder
        return "" if held is None else held.name

    async def scene() -> None:
        async with AsyncExitStack() as stack:
            chief, ada, ben = [await stack.enter_async_context(class_client(lab.url)) for _ in range(3)]
            await ada.join("Ada", lab.code)
            await ben.join("Ben", lab.code)
            await chief.prove()
            await chief.press("Ada")
            await chief.until(lambda: "aria-disabled" in chief.buttons()["Give the robot"], "no robot to give")
            workshop.link.connect("sim:par4").result(20.0)
            wait(lambda: workshop.status.phase == "ready", "board")
            await chief.until(lambda: "aria-disabled" not in chief.buttons()["Give the robot"], "robot to give")
            await chief.press("Give the robot")
            await chief.until(lambda: "has the robot" in chief.said, "Ada as the holder on the board")
            assert holder() == "Ada"
            mine = await lab.on_the_loop(lambda: lab.classroom.person(ben.browser))
            workshop.link.request(mine).result(5.0)
            await chief.press("Take it back")
            await chief.until(lambda: "aria-disabled" in chief.buttons()["Take it back"], "instructor as the holder")
            assert holder() == "Instructor"
            await chief.press("Give to Ben")
            await chief.until(lambda: "Give to Ben" not in chief.buttons(), "Ben out of the queue")
            assert holder() == "Ben"
            await chief.press("Ben")
            await chief.press("Remove")
            await chief.press("Really remove?")
            await chief.until(lambda: "Ben" not in chief.buttons(), "end of Ben")
            wait(lambda: holder() != "Ben", "robot without Ben")

    run_async(scene())


def test_a_killed_server_goes_on_with_its_class(tmp_path: Path) -> None:
    arguments = "--classroom", "--pin", PIN, "--data", str(tmp_path), "--no-shadows"

    async def before(url: str, code: str) -> tuple[str, str]:
        async with class_client(url) as chief, class_client(url, whole=False) as ada:
            await ada.join("Ada", code)
            await chief.prove()
            await chief.set("Said in the pause", "Back in a minute")
            await chief.press("Pause")
            await ada.until(lambda: ada.parts["pause"] == "Back in a minute", "pause")
            return chief.browser, ada.browser

    async def after(url: str, chiefs: str, adas: str) -> None:
        async with class_client(url, chiefs) as chief, class_client(url, adas, whole=False) as ada:
            assert ada.asked is None
            await ada.until(lambda: ada.parts["pause"] == "Back in a minute", "pause")
            await chief.until(lambda: "Ada" in chief.buttons(), "instructor's page")
            await chief.press("Go on")
            await ada.until(lambda: ada.parts["pause"] is None, "end of the pause")

    with running_deltalab(*arguments) as server:
        code = code_of(server.wait_for_output("PIN"))
        browsers = run_async(before(server.url, code))
        server.process.kill()
        server.process.wait()
    with running_deltalab(*arguments) as server:
        assert code_of(server.wait_for_output("PIN")) == code
        run_async(after(server.url, *browsers))


def code_of(output: str) -> str:
    """The class code that a server has printed."""
    return output.partition("?class=")[2][:5]
