"""A lesson as a student does it, in a real browser: one visitor on a desk, then on a phone."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.support.browser import PHONE, SLOW_SCREEN, PageFactory, screenshot, wait_ready
from tests.support.lesson_server import running_course
from tests.support.server import RunningServer
from tests.support.widgets import button, open_tab, press, tab, type_into

TOOL = "/robot/tool"
pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("course")


@pytest.fixture(scope="module")
def server(folder: Path) -> Iterator[RunningServer]:
    with running_course(folder) as running:
        yield running


@pytest.fixture(scope="module")
def page(lasting_visit: PageFactory) -> Page:
    made = lasting_visit()
    made.add_init_script(SLOW_SCREEN)
    return made


def visit(page: Page, server: RunningServer, query: str = "") -> None:
    page.goto(f"{server.url}/?fixedDpr=0.5{query}", wait_until="domcontentloaded")
    wait_ready(page, [TOOL])


def title(page: Page) -> Locator:
    return page.get_by_role("heading", name="1 · First & foremost")


def left_and_right(thing: Locator) -> tuple[float, float]:
    box = thing.bounding_box()
    assert box is not None
    return box["x"], box["x"] + box["width"]


def test_a_link_opens_a_lesson_and_the_student_goes_through_it(page: Page, server: RunningServer):
    visit(page, server, "&lesson=01")
    expect(title(page)).to_be_visible()
    assert "lesson=" not in page.url, "a reload goes on where the student is"
    expect(page.get_by_role("button", name="Step 2, Think: locked")).to_be_visible()
    page.get_by_role("radio").nth(1).check()
    press(page, "This is my guess")
    expect(page.get_by_text("It stands at 40 mm.")).to_be_visible()
    press(page, "Check: what is missing?")
    expect(page.get_by_text("Move it to the right.")).to_be_visible()
    type_into(page, "x (mm)", 40)
    expect(page.get_by_text("Your robot shows it.")).to_be_visible()
    expect(page.get_by_text("Yes, down.")).to_be_visible()
    answer = page.get_by_label("Your answer in mm")
    answer.fill("-40")
    answer.press("Enter")
    expect(page.get_by_text("Mind the sign.")).to_be_visible()
    answer.fill("40")
    answer.press("Enter")
    expect(page.get_by_text("Right, 40.")).to_be_visible()
    screenshot(page, "lesson-step")


def test_the_labs_leave_the_lesson_where_it_is(page: Page):
    open_tab(page, "Control")
    plots = tab(page, "Frequency")
    expect(plots).to_be_visible(timeout=60_000)
    assert left_and_right(plots)[0] > left_and_right(title(page))[1], "they stand on the other side"
    screenshot(page, "lesson-and-lab")


def test_the_student_goes_on_where_he_was(page: Page, server: RunningServer, folder: Path):
    press(page, "Next step")
    expect(page.get_by_text("Is it so?")).to_be_visible()
    visit(page, server)
    expect(page.get_by_text("Is it so?")).to_be_visible()
    server.stop()
    with running_course(folder) as again:
        visit(page, again)
        page.get_by_role("tab", name="Robot", exact=True).wait_for()
        expect(title(page)).to_be_hidden()
        page.get_by_text("Lesson", exact=True).first.click()
        press(page, "Go on: lesson 1, step 2")
        page.get_by_role("radio").first.check()
        press(page, "Answer")
        press(page, "Finish the lesson")
        expect(page.get_by_text("Lesson 1 is done.")).to_be_visible()
        with page.expect_download() as download:
            button(page, "My report").click()
        assert "First &amp; foremost" in Path(download.value.path()).read_text()


def test_on_a_phone_the_lesson_comes_first(lasting_visit: PageFactory, folder: Path):
    with running_course(folder) as server:
        page = lasting_visit(PHONE)
        visit(page, server, "&lesson=01")
        expect(title(page)).to_be_visible()
        lesson, settings = title(page).bounding_box(), tab(page, "Robot").bounding_box()
        assert lesson is not None and settings is not None and lesson["y"] < settings["y"]
        expect(title(page)).to_be_in_viewport()
        screenshot(page, "lesson-phone")
