"""What the instructor shows: somebody's robot on every page, and one picture of all."""

from __future__ import annotations

import asyncio
from contextlib import AsyncExitStack
from typing import Any

import pytest

from tests.support.class_lab import GIZMO, ClassClient, ClassLab, class_client
from tests.support.wire import note, run_async

GUEST, TOOL = "/guest/tool", "/robot/tool"


def hidden(page: ClassClient) -> list[bool]:
    """Fills with whether the page's own robot is hidden, at each change."""
    changes: list[bool] = []
    page.client.listeners.append(
        lambda message, _: (
            changes.append(not message["visible"])
            if message["type"] == "SetSceneNodeVisibilityMessage" and message["name"] == "/robot"
            else None
        )
    )
    return changes


async def stand(page: ClassClient, *position: float) -> None:
    """Drag the robot there and let it go."""
    await page.client.start_drag(GIZMO)
    await page.client.drag(GIZMO, position)
    await page.until(lambda: page.client.positions.get(TOOL) == pytest.approx(position, abs=1e-6), "own tool")
    await page.client.end_drag(GIZMO)


def test_everybody_sees_the_robot_that_is_shown_and_has_the_own_one_back(lab: ClassLab) -> None:
    async def scene() -> None:
        async with AsyncExitStack() as stack:
            chief, ada, ben = [await stack.enter_async_context(class_client(lab.url)) for _ in range(3)]
            await ada.join("Ada", lab.code)
            await ben.join("Ben", lab.code)
            await chief.prove()
            covered = hidden(ben)
            await stand(ben, 0.02, 0.03, -0.31)
            await chief.press("Ada")
            await chief.press("Show to all")
            await ben.until(lambda: GUEST in ben.client.positions, "guest")
            assert ben.parts["banner"] == "You see Ada's robot" and covered == [True]
            assert ada.parts["banner"] == "Everybody sees your robot" and GUEST not in ada.client.nodes
            await stand(ada, 0.05, -0.02, -0.32)
            for page in (ben, chief):
                await page.until(
                    lambda page=page: page.client.positions[GUEST] == pytest.approx((0.05, -0.02, -0.32), abs=1e-6),
                    "the guest where Ada's robot is",
                )
            await chief.press("End showing")
            await ben.until(lambda: GUEST not in ben.client.nodes, "end")
            assert ben.parts["banner"] == "" and covered == [True, False]
            assert ben.client.positions[TOOL] == pytest.approx((0.02, 0.03, -0.31), abs=1e-6)

    run_async(scene())


def test_a_name_that_is_hidden_is_on_no_page(lab: ClassLab) -> None:
    async def scene() -> None:
        async with AsyncExitStack() as stack:
            chief, cleo, dora = [await stack.enter_async_context(class_client(lab.url)) for _ in range(3)]
            heard: list[str] = []
            dora.client.listeners.append(lambda message, _: heard.append(str(message)))
            await cleo.join("Cleopatra", lab.code)
            await dora.join("Dora", lab.code)
            await chief.prove()
            await chief.press("Cleopatra")
            await chief.press("Show, no name")
            await dora.until(lambda: dora.parts["banner"] == "You see a classmate's robot", "banner")
            await dora.until(lambda: GUEST in dora.client.nodes, "guest")
            assert not any("Cleopatra" in message for message in heard)
            await chief.press("End showing")

    run_async(scene())


def test_another_robot_a_reload_and_somebody_else_are_followed(lab: ClassLab) -> None:
    async def scene() -> None:
        async with AsyncExitStack() as stack:
            chief, eli, fred = [await stack.enter_async_context(class_client(lab.url)) for _ in range(3)]
            await eli.join("Eli", lab.code)
            await fred.join("Fred", lab.code)
            await chief.prove()
            await chief.press("Show my robot")
            await fred.until(lambda: fred.parts["banner"] == "You see your instructor's robot", "banner")
            await chief.set("Robot", "Linear delta")
            await fred.until(lambda: "/guest/carriage" in fred.client.nodes, "linear delta")
            await chief.press("Eli")
            await chief.press("Show to all")
            await fred.until(lambda: "/guest/arm" in fred.client.nodes, "Eli's Par4")
            await chief.until(lambda: GUEST in chief.client.nodes, "guest at the instructor's")
            async with class_client(lab.url, eli.browser) as again:
                await stand(again, 0.01, 0.06, -0.33)
                await fred.until(
                    lambda: fred.client.positions[GUEST] == pytest.approx((0.01, 0.06, -0.33), abs=1e-6), "new page"
                )
                async with class_client(lab.url, fred.browser) as later:
                    await later.until(lambda: GUEST in later.client.nodes, "guest on a page that came later")
            await chief.press("Remove")
            await chief.press("Really remove?")
            await fred.until(lambda: GUEST not in fred.client.nodes, "end with the one who is shown")
            await chief.set("Robot", "Par4 delta")

    run_async(scene())


def test_a_visitor_sees_no_student(lab: ClassLab) -> None:
    async def scene() -> None:
        async with AsyncExitStack() as stack:
            chief, gil, visitor = [await stack.enter_async_context(class_client(lab.url)) for _ in range(3)]
            await gil.join("Gil", lab.code)
            await chief.prove()
            await chief.press("Gil")
            await chief.press("Show to all")
            await chief.until(lambda: GUEST in chief.client.nodes, "guest")
            await asyncio.sleep(0.15)
            assert GUEST not in visitor.client.nodes and visitor.parts["banner"] == ""
            await visitor.join("Hal", lab.code)
            await visitor.until(lambda: GUEST in visitor.client.nodes, "guest for the member")
            await chief.press("End showing")

    run_async(scene())


def test_the_picture_of_all_has_a_line_a_student_and_no_names(lab: ClassLab) -> None:
    async def scene() -> None:
        async with AsyncExitStack() as stack:
            chief, ida, joe = [await stack.enter_async_context(class_client(lab.url)) for _ in range(3)]
            await ida.join("Ida", lab.code)
            await joe.join("Joe", lab.code)
            await chief.prove()
            await chief.press("Step responses")
            await chief.until(lambda: "Nobody has one yet" in chief.said, "empty picture")
            assert ida.parts["picture"] == ""
            for page in (ida, joe):
                await page.set("Control opened", True)
            await chief.set("On every page", True)
            for page in (ida, joe):
                await page.until(lambda page=page: "of 2 students" in page.parts["picture"], "picture of both", 60.0)
                assert page.parts["picture"].count("<polyline") == 2
                assert not any(name in page.parts["picture"] for name in ("Ida", "Joe"))
            await chief.until(lambda: chief.said.count("<polyline") == 2, "picture in the instructor's panel")
            assert chief.parts["picture"] == ""
            await chief.press("Hide")
            await ida.until(lambda: ida.parts["picture"] == "", "end of the picture")

    run_async(scene())


def test_a_board_that_stays_as_it_is_is_not_sent(lab: ClassLab) -> None:
    async def scene() -> None:
        async with class_client(lab.url) as chief:
            await chief.prove()
            await asyncio.sleep(1.2)
            sent: list[Any] = note(chief.client, "GuiUpdateMessage")
            await asyncio.sleep(2.2)
            assert sent == []

    run_async(scene())
