"""The belts of the work cycle and the maps of the tab Motion, in a real browser. Pictures go to tests/artifacts."""

from __future__ import annotations

import re

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from app.motion import CYCLES, plan_work_cycle
from app.robots import ROBOTS
from tests.support.browser import PageFactory, open_page, screenshot, wait_ready, wait_until
from tests.support.plots import chart
from tests.support.server import RunningServer
from tests.support.widgets import choose, open_tab, set_slider, take_robot, toggle

TOOL, BELTS, MAP = "/robot/tool", "/robot/belts", "/robot/map"
_SHOWN = "name => Boolean(window.__viserMutable.nodeRefFromName[name]?.visible)"
_ITEMS = """(name) => {
  const node = window.__viserSceneTree.getState()[name];
  return node && {places: Array.from(node.message.props.batched_positions),
                  sizes: Array.from(node.message.props.batched_scales)};
}"""
pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def page(server: RunningServer, lasting_visit: PageFactory) -> Page:
    page = lasting_visit()
    enter(page, server)
    return page


def enter(page: Page, server: RunningServer) -> None:
    open_page(page, server.url)
    wait_ready(page, [TOOL])
    take_robot(page, ROBOTS["fivebar"].title)
    open_tab(page, "Motion")
    choose(page, "Show", "Work cycle")
    expect(page.locator(".deltalab-verdict").first).to_have_text(re.compile("2.46 s"), timeout=30_000)
    wait_until(page, lambda: shown(page, BELTS), "belts")


def shown(page: Page, node: str) -> bool:
    return page.evaluate(_SHOWN, node)


def items(page: Page) -> np.ndarray:
    """(m, 3) places of the items that are seen."""
    found = page.evaluate(_ITEMS, f"{BELTS}/item")
    places, sizes = (np.array(found[key]).reshape(-1, 3) for key in ("places", "sizes"))
    return places[sizes[:, 0] > 0.0]


def lies_at(page: Page, x: float, y: float) -> bool:
    """Whether an item is there, to a millimetre."""
    return bool(len(found := items(page))) and np.hypot(found[:, 0] - x, found[:, 1] - y).min() < 1e-3


def test_an_item_goes_from_belt_to_belt(page: Page):
    cycle = plan_work_cycle(CYCLES["W1"])
    for time_s, where in ((0.2, "on the pick belt"), (1.34, "in the gripper"), (2.4, "on the place belt")):
        set_slider(page, "Time (s)", time_s)
        k = int(np.searchsorted(cycle.t, time_s))
        x, y = cycle.items_at(time_s, cycle.pose[k])[cycle.flow.handled][:2]
        wait_until(page, lambda x=x, y=y: lies_at(page, x, y), f"item {where}")
        screenshot(page, f"belts-{time_s:g}s")


def test_belts_are_there_only_for_the_work_cycle(page: Page):
    choose(page, "Show", "Along a curve")
    wait_until(page, lambda: not shown(page, BELTS), "room without belts")
    choose(page, "Show", "Work cycle")
    wait_until(page, lambda: shown(page, BELTS), "belts again")


def test_a_map_appears_follows_its_sliders_and_goes(page: Page):
    page.get_by_text("Maps", exact=True).click()
    toggle(page, "Show a map")
    wait_until(page, lambda: shown(page, MAP) and known(page, f"{MAP}/sheet"), "map")
    open_tab(page, "Map")
    wait_until(page, lambda: chart(page, "Cut through the map") is not None, "cut")
    screenshot(page, "map-torque")
    assert not known(page, f"{MAP}/limit")
    set_slider(page, "Acceleration (m/s²)", 32)
    wait_until(page, lambda: known(page, f"{MAP}/limit"), "line of the limit")
    expect(page.get_by_text("Striped: a drive would be over its limit.").first).to_be_visible()
    found = chart(page, "Cut through the map")
    assert found is not None and found.axes == ["x (mm)", "Torque for an acceleration (%)"]
    choose(page, "Quantity", "Conditioning")
    wait_until(page, lambda: not known(page, f"{MAP}/limit"), "map without a limit")
    choose(page, "Quantity", "Torque for an acceleration")
    wait_until(page, lambda: known(page, f"{MAP}/limit"), "line of the limit")
    open_tab(page, "View")
    toggle(page, "Dark theme")
    open_tab(page, "Motion")
    screenshot(page, "map-dark", settle=2.0)
    toggle(page, "Show a map")
    wait_until(page, lambda: not shown(page, MAP), "room without a map")


def known(page: Page, node: str) -> bool:
    return page.evaluate("name => name in window.__viserSceneTree.getState()", node)
