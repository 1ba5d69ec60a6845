"""The tab Hardware in a real browser, with an emulated board. Each test leaves a picture in tests/artifacts."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.browser import DESKTOP, PHONE, new_page, open_page, screenshot, wait_until
from tests.support.plots import chart
from tests.support.server import RunningServer, running_deltalab
from tests.support.widgets import button, choose, open_tab, press, settle

TOOL = "/robot/tool"
NEXT = {"Stopped": "Clear", "Fault": "Clear", "Held": "Continue", "Motors off": "Enable", "Not homed": "Home"}
"""What leads on from a state. On a machine with too much to do the board's watchdogs may hold or switch off."""

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def server() -> Iterator[RunningServer]:
    with running_deltalab("--no-shadows", "--robot", "delta3") as running:
        yield running


@pytest.fixture(scope="module")
def shared_page(browser: Browser, server: RunningServer) -> Iterator[Page]:
    """One visitor, connected and in control."""
    page = new_page(browser, DESKTOP)
    open_hardware(page, server)
    press(page, "Connect")
    wait_until(page, lambda: word(page) == "Motors off", "a board")
    press(page, "Request")
    expect(page.get_by_text("You have control. Kept", exact=False)).to_be_visible()
    yield page
    page.context.close()


def open_hardware(page: Page, server: RunningServer) -> None:
    open_page(page, server.url, [TOOL])
    page.get_by_role("tab", name="Hardware", exact=True).wait_for()
    open_tab(page, "Hardware")
    button(page, "Cancel").wait_for(state="attached", timeout=30_000)


def word(page: Page) -> str:
    """State of the robot."""
    shown = page.locator("[data-robot=state] b").all_inner_texts()
    return shown[-1] if shown else ""


def make_ready(page: Page) -> None:
    """From any state to homed and idle."""
    for _ in range(30):
        now = word(page)
        if now == "Idle":
            return
        if now in NEXT:
            button(page, NEXT[now]).first.click(force=True)
        page.wait_for_timeout(500)
    raise AssertionError(f"the robot never got ready: it is {word(page)}")


def tool_z(page: Page) -> float:
    """mm"""
    cell = page.locator("td", has=page.locator("span", has_text=re.compile("^z$"))).first.inner_text()
    number = cell.split()[-1].replace("−", "-")
    return float(number) if re.fullmatch(r"-?[\d.]+", number) else float("nan")


def test_a_held_button_moves_the_robot_until_it_is_let_go(shared_page: Page):
    page = shared_page
    choose(page, "Move", "Tool")
    for _ in range(6):
        make_ready(page)
        page.wait_for_timeout(300)
        before = tool_z(page)
        button(page, "z −").scroll_into_view_if_needed()
        box = button(page, "z −").bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.mouse.down()
        page.wait_for_timeout(900)
        page.mouse.up()
        page.wait_for_timeout(700)
        if tool_z(page) < before - 1.0:
            break
    assert tool_z(page) < before - 1.0, "it moved"
    wait_until(page, lambda: word(page) != "Moving", "rest")
    page.wait_for_timeout(300)
    rests = tool_z(page)
    page.wait_for_timeout(500)
    assert tool_z(page) == pytest.approx(rests, abs=0.05, nan_ok=True)
    screenshot(page, "hardware-jog", 0.5)


def test_a_grey_button_says_why(shared_page: Page):
    page = shared_page
    expect(button(page, "Clear")).to_be_disabled()
    button(page, "Request").click(force=True)
    expect(page.get_by_text("You have control.", exact=True).first).to_be_visible()


def test_the_plots_show_what_the_board_reports(shared_page: Page):
    page = shared_page
    wait_until(page, lambda: (found := chart(page, "Joints and set-points")) and len(found.x) > 10, "a plot")
    found = chart(page, "Joints and set-points")
    assert found is not None and found.x[-1] == 0.0
    assert found.axes == ["Time (s), now is 0", "Joint (°)"]
    assert [*found.curves][1:] == ["q1", "q2", "q3", "q1 set-point", "q2 set-point", "q3 set-point"]
    shown = page.locator("td", has=page.locator("span", has_text=re.compile("^q1$"))).first.inner_text().split()[-1]
    assert found.last("q1") == pytest.approx(float(shown), abs=30.0), "degrees"
    assert "Connected" in page.get_by_role("log").inner_text()


def test_a_phone_waits_in_the_queue_and_gets_the_robot(shared_page: Page, browser: Browser, server: RunningServer):
    phone = new_page(browser, PHONE)
    open_hardware(phone, server)
    button(phone, "Request").scroll_into_view_if_needed()
    button(phone, "Request").tap()
    settle(phone)
    expect(phone.get_by_text("In the queue: 1. you.", exact=False)).to_be_visible(timeout=15_000)
    screenshot(phone, "hardware-phone", 0.5)
    press(shared_page, "Hand over")
    expect(phone.get_by_text("You have control. Kept", exact=False)).to_be_visible(timeout=15_000)
    button(phone, "Hand over").tap()
    expect(phone.get_by_text("it is free", exact=False)).to_be_visible(timeout=15_000)
    phone.context.close()
