"""Stop and hold-to-run in a real browser, against an emulated board whose own state is looked at."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress

import pytest
from playwright.sync_api import Locator, Page, expect

from app.errors import UserMistake
from app.link.lease import Person
from app.link.protocol.codes import State
from tests.support.browser import PageFactory, open_page, screenshot, wait_until
from tests.support.robot_lab import ADA, RobotLab, robot_lab
from tests.support.widgets import field, open_tab

pytestmark = pytest.mark.browser
HIDE = """hidden => {
  Object.defineProperty(document, "hidden", {configurable: true, get: () => hidden});
  document.dispatchEvent(new Event("visibilitychange"));
}"""


@pytest.fixture(scope="module")
def lab() -> Iterator[RobotLab]:
    with robot_lab("delta3") as running:
        running.connect("sim:delta3")
        yield running


@pytest.fixture(scope="module")
def page(lab: RobotLab, lasting_visit: PageFactory) -> Page:
    page = lasting_visit()
    open_page(page, lab.url, ["/robot/gizmo"])
    expect(stop_button(page)).to_be_visible(timeout=20_000)
    return page


def stop_button(page: Page) -> Locator:
    return page.get_by_role("button", name="Stop the robot")


@contextmanager
def jogging(lab: RobotLab) -> Iterator[None]:
    """Ada holds a button on another page."""
    lab.make_ready(ADA)
    over = threading.Event()

    def renew() -> None:
        while not over.wait(0.05):
            lab.link.alive(ADA)
            lab.start_jog(ADA)

    thread = threading.Thread(target=renew, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
        lab.link.jog_release(ADA)


def check_at_rest(lab: RobotLab, page: Page) -> None:
    """A controlled stop takes up to 80 ms; after that nothing moves."""
    page.wait_for_timeout(300)
    resting = lab.setpoint
    page.wait_for_timeout(400)
    assert lab.setpoint == resting


def test_stop_works_by_click_and_by_key_on_a_page_that_never_opened_the_tab(lab: RobotLab, page: Page):
    number = field(page, "x (mm)")
    for stop in (lambda: stop_button(page).click(), lambda: number.press("Escape")):
        with jogging(lab):
            wait_until(page, lambda: lab.state is State.MOVING, "motion")
            stop()
            wait_until(page, lambda: lab.state is State.STOPPED, "stop")
            check_at_rest(lab, page)
            assert lab.state is State.STOPPED
        expect(page.locator("#deltalab-stop")).to_contain_text("Stopped")
        expect(page.locator("#deltalab-stop .clear")).to_be_hidden()
    box = stop_button(page).bounding_box()
    assert box is not None and min(box["width"], box["height"]) >= 44
    assert page.evaluate("([x, y]) => document.elementFromPoint(x, y).closest('.stop') !== null", [
        box["x"] + box["width"] / 2, box["y"] + box["height"] / 2,
    ]), "something lies over Stop"  # fmt: skip
    screenshot(page, "stop-bar")


@pytest.fixture
def releases(lab: RobotLab, monkeypatch: pytest.MonkeyPatch) -> list[Person]:
    """Everybody who let a button go, in turn."""
    heard: list[Person] = []
    release = lab.link.jog_release

    def note(person: Person):
        heard.append(person)
        return release(person)

    monkeypatch.setattr(lab.link, "jog_release", note)
    return heard


def test_a_held_button_stops_once_when_the_page_loses_it(lab: RobotLab, page: Page, releases: list[Person]):
    open_tab(page, "Hardware")
    request = page.locator("button[data-press=request]")
    expect(request).to_be_visible(timeout=30_000)
    lab.link.release(ADA).result(5.0)
    wait_until(page, lambda: request.get_attribute("aria-disabled") is None, "free robot")
    request.click()
    wait_until(page, lambda: lab.status.holder is not None, "holder")
    assert lab.status.holder is not None
    me = lab.status.holder
    losses = {
        "blur": lambda: page.evaluate("window.dispatchEvent(new Event('blur'))"),
        "hidden": lambda: page.evaluate(HIDE, True),
        "key": lambda: page.keyboard.press("Escape"),
    }
    for name, lose in losses.items():
        hold(lab, page, me)
        releases.clear()
        lose()
        wait_until(page, lambda: lab.state is not State.MOVING, f"end after {name}")
        check_at_rest(lab, page)
        page.mouse.up()
        page.wait_for_timeout(200)
        assert releases == [me], f"exactly one release after {name}"
        page.evaluate(HIDE, False)
    with suppress(UserMistake):
        lab.link.clear(me).result(5.0)


def hold(lab: RobotLab, page: Page, person: Person) -> None:
    """Press a jog button with the mouse until the board moves. On a busy computer the board holds by itself now and
    then, and must be made ready again."""
    armed = page.locator("button[data-hold='joint:0:+']")
    for _ in range(3):
        lab.make_ready(person)
        expect(armed).to_be_visible(timeout=20_000)
        armed.hover()
        page.mouse.down()
        with suppress(AssertionError):
            wait_until(page, lambda: lab.state is State.MOVING, "motion", 4.0)
            return
        page.mouse.up()
    raise AssertionError(f"no motion: the robot is {lab.state!r}")
