"""Controllers compared as a student does it, in a real browser. Each test leaves pictures in tests/artifacts."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from app.robots import ROBOTS
from tests.support.browser import PHONE, PageFactory, open_page, screenshot, wait_ready, wait_until
from tests.support.plots import chart
from tests.support.server import RunningServer
from tests.support.widgets import choose, open_tab, press, set_slider, take_robot, toggle

ROOT = "/robot/compare"
RUN = "Compare them"
_HAS_MAP = "() => '/robot/map/sheet' in window.__viserSceneTree.getState()"
pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def lab(server: RunningServer, lasting_visit: PageFactory) -> Page:
    """One visitor for all that needs a wide screen."""
    page = lasting_visit()
    open_page(page, server.url)
    enter(page)
    open_tab(page, "Compare")
    return page


def enter(page: Page) -> None:
    wait_ready(page, ["/robot/tool"])
    take_robot(page, ROBOTS["linear"].title)
    open_tab(page, "Motion")
    page.get_by_text("Compare controllers", exact=True).first.wait_for()
    page.get_by_text("Compare controllers", exact=True).first.click()
    page.get_by_role("button", name=RUN, exact=True).wait_for()


def order(page: Page) -> list[str]:
    """Laws in the order of the table."""
    cells = ranked(page).locator("tr td:first-child").all_inner_texts()
    return [re.sub(r"^\d\. ?|\s*[▲▼]\d$", "", cell.strip()).strip() for cell in cells]


def ranked(page: Page) -> Locator:
    return page.locator("table", has=page.get_by_role("columnheader", name="law", exact=True))


def compare(page: Page, laws: int) -> None:
    press(page, RUN)
    page.get_by_role("button", name="Cancel the comparison", exact=True).wait_for(timeout=2_000)
    page.get_by_role("button", name="Cancel the comparison", exact=True).wait_for(state="hidden", timeout=60_000)
    wait_until(page, lambda: len(order(page)) == laws, "table of all laws")


def nodes(page: Page) -> list[str]:
    """What is drawn of a comparison, without the empty node that carries the ghosts."""
    names = page.evaluate("() => Object.keys(window.__viserSceneTree.getState())")
    drawn = {name.removeprefix(f"{ROOT}/") for name in names if name.startswith(f"{ROOT}/")}
    return sorted(drawn - {"ghosts"})


def test_friction_turns_the_ranking_of_the_helix(lab: Page):
    page = lab
    expect(page.get_by_text("Nothing compared yet")).to_be_visible()
    compare(page, 3)
    choose(page, "Error in", "z")
    wait_until(page, lambda: order(page) == ["CTC", "PID", "PD"], "ranking without friction")
    wait_until(page, lambda: "ghosts" in " ".join(nodes(page)), "ghosts")
    assert {"reference", "path-0", "path-1", "path-2"} <= set(nodes(page))
    errors = chart(page, "Error of the tool")
    assert errors is not None and errors.legend[-3:] == ["PD", "PID", "CTC"]
    assert max(map(abs, errors.curves["PD"])) == pytest.approx(2.8, abs=0.3), "spec A6: PD sags by 2.8 mm"
    press(page, "Pause the run")
    screenshot(page, "compare-helix")
    set_slider(page, "Friction (×)", 1)
    compare(page, 3)
    wait_until(page, lambda: order(page) == ["PID", "CTC", "PD"], "spec A6: an integral wins over a model")
    expect(page.get_by_text("friction 0× → 1×").first).to_be_visible()
    assert "▲1" in ranked(page).inner_text() and "▼1" in ranked(page).inner_text()
    screenshot(page, "compare-helix-friction")


def test_a_torque_is_taken_apart(lab: Page):
    page = lab
    choose(page, "Law", "PID")
    parts = wait_until(page, lambda: (c := chart(page, "What it is made of")) and "i" in c.curves and c, "parts")
    total = [p + d + i for p, d, i in zip(*(parts.curves[name] for name in "pdi"), strict=True)]
    assert parts.curves["sum"] == pytest.approx(total, abs=1e-6)
    expect(page.get_by_text("is made of: RMS")).to_be_visible()
    page.get_by_text("is made of: RMS").scroll_into_view_if_needed()
    screenshot(page, "compare-parts")


def test_the_work_cycle_of_the_five_bar(lab: Page):
    page = lab
    open_tab(page, "Robot")
    choose(page, "Robot", "5R pick-and-place")
    open_tab(page, "Motion")
    expect(page.get_by_label("Task", exact=True)).to_have_value("Work cycle W1 (paper)")
    wait_until(page, lambda: not nodes(page), "nothing left of the other robot's runs")
    compare(page, 4)
    assert set(order(page)) == {"PD", "PID", "TSIDC", "TSIIDC"} and order(page)[-1] == "PD"
    press(page, "Pause the run")
    screenshot(page, "compare-work-cycle")
    open_tab(page, "View")
    toggle(page, "Dark theme")
    screenshot(page, "compare-dark", 2.0)


def test_on_a_phone_all_is_in_one_sheet(server: RunningServer, visit: PageFactory):
    page = visit(PHONE)
    open_page(page, server.url)
    enter(page)
    above = page.locator(".deltalab-verdict").first.bounding_box()
    below = page.get_by_label("Curve", exact=True).bounding_box()
    assert above and below and above["y"] < below["y"], "what comes of the settings is seen while they are set"
    screenshot(page, "motion-phone")
    compare(page, 3)
    assert order(page) == ["CTC", "PID", "PD"]
    ranked(page).scroll_into_view_if_needed()
    screenshot(page, "compare-phone")
    page.get_by_text("Maps", exact=True).first.click()
    toggle(page, "Show a map")
    wait_until(page, lambda: page.evaluate(_HAS_MAP), "map")
    page.get_by_text("Slice height (mm)").scroll_into_view_if_needed()
    screenshot(page, "map-phone")
    overflow = page.evaluate("() => document.documentElement.scrollWidth - window.innerWidth")
    assert overflow <= 0, "nothing sticks out of a phone's screen"
