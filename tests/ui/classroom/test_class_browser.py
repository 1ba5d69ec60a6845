"""A class in browsers: the instructor's page and a student's phone are drawn, two more students come over the wire."""

from __future__ import annotations

import tempfile

import pytest
from playwright.sync_api import Page, expect

from tests.support.browser import DESKTOP, PHONE, PageFactory, node_pose, screenshot, wait_ready, wait_until
from tests.support.class_lab import PIN, class_client
from tests.support.server import running_deltalab
from tests.support.widgets import button
from tests.support.wire import run_async

GIZMO, GUEST = "/robot/gizmo", "/guest/tool"
SEEN = (0.04, -0.02, -0.32)


def come(visit: PageFactory, url: str, screen: object) -> Page:
    page = visit(screen)
    page.goto(url, wait_until="domcontentloaded")
    wait_ready(page, [GIZMO])
    return page


@pytest.mark.long
def test_a_lesson_with_an_instructor_and_three_students(visit: PageFactory) -> None:
    with tempfile.TemporaryDirectory() as data:
        arguments = "--classroom", "--pin", PIN, "--data", data, "--no-shadows", "--serial", "sim:par4"
        with running_deltalab(*arguments) as server:
            code = server.wait_for_output("is connected").partition("?class=")[2][:5]
            chief = come(visit, f"{server.url}/?fixedDpr=1&class={code}", DESKTOP)
            button(chief, "I am the instructor").click()
            chief.get_by_label("PIN").fill(PIN)
            chief.keyboard.press("Enter")
            button(chief, "Show to all").wait_for()

            phone = come(visit, f"{server.url}/?fixedDpr=1&class={code}", PHONE)
            expect(phone.get_by_label("Class code")).to_have_value(code)
            phone.get_by_label("Your name").fill("<i>Ada</i>")
            button(phone, "Join").tap()
            expect(phone.get_by_role("dialog")).to_be_hidden()
            button(chief, "<i>Ada</i>").wait_for()

            async def two_more() -> None:
                async with class_client(server.url) as ben, class_client(server.url, whole=False) as cleo:
                    await ben.join("Ben", code)
                    await cleo.join("Cleo", code)
                    await ben.client.start_drag(GIZMO)
                    await ben.client.drag(GIZMO, SEEN)
                    await ben.client.end_drag(GIZMO)

            run_async(two_more())
            button(chief, "Ben").wait_for()
            expect(chief.get_by_text("away")).to_have_count(2)

            button(chief, "<i>Ada</i>").click()
            button(chief, "Give the robot").click()
            expect(phone.locator("#deltalab-stop")).to_contain_text("You have control")
            button(chief, "Pause").click()
            veil = phone.get_by_role("alertdialog")
            expect(veil).to_be_visible()
            assert phone.evaluate("document.getElementById('root').inert"), "what lies under a pause takes no input"
            screenshot(phone, "class_pause")
            phone.locator("#deltalab-stop .stop").tap()
            expect(phone.locator("#deltalab-stop .stop")).not_to_contain_class("sent")  # the link has answered
            expect(phone.locator("#deltalab-stop .alarm")).to_have_count(0)
            phone.reload(wait_until="domcontentloaded")
            wait_ready(phone, [GIZMO])
            expect(veil).to_be_visible()
            button(chief, "Go on").click()
            expect(veil).to_be_hidden()
            expect(phone.get_by_role("dialog")).to_be_hidden()

            button(chief, "Show to all").click()
            wait_until(chief, lambda: node_pose(chief, GUEST), "the phone's robot on the instructor's page")
            expect(phone.locator("#deltalab-banner")).to_have_text("Everybody sees your robot")
            expect(chief.locator("#deltalab-banner")).to_have_text("You see <i>Ada</i>'s robot")
            assert not chief.evaluate("window.__viserSceneTree.getState()['/robot'].effectiveVisibility")
            screenshot(chief, "class_spotlight")
            button(chief, "End showing").first.click()
            wait_until(chief, lambda: not node_pose(chief, GUEST), "the own robot again")
            assert chief.evaluate("window.__viserSceneTree.getState()['/robot/gizmo'].effectiveVisibility")
