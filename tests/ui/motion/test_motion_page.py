"""The tab Motion as a student uses it, in a real browser. Each test leaves a picture in tests/artifacts."""

from __future__ import annotations

import csv
import io
import math
import re

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from app.motion import default_motion, plan_motion
from app.robots import ROBOTS
from app.ui import theme
from tests.support.browser import PageFactory, node_pose, open_page, screenshot, wait_ready, wait_until
from tests.support.plots import Chart, chart
from tests.support.server import RunningServer
from tests.support.widgets import button, choose, open_tab, press, set_slider, slider_box, toggle, type_into

TOOL, PATH = "/robot/tool", "/robot/motion/path"
SPEED, POSITION = "Joint speed", "Joint position"
MARKED = theme.line_colors(np.array([True]), theme.MARK, theme.PLAN)[0, 0].tolist()
_PATH = """(name) => {
  const node = window.__viserSceneTree.getState()[name];
  return node ? {colors: Array.from(node.message.props.colors), visible: window.__viserMutable.nodeRefFromName[name].visible} : null;
}"""  # noqa: E501
pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def shared_page(server: RunningServer, lasting_visit: PageFactory) -> Page:
    """One visitor for most tests."""
    page = lasting_visit()
    open_motion(page, server)
    return page


@pytest.fixture
def lab(shared_page: Page) -> Page:
    """The tab Motion with the first robot and its defaults."""
    take_robot(shared_page, "par4")
    press(shared_page, "Reset the motion")
    usual = plan_motion(default_motion("par4")).duration_s
    wait_until(shared_page, lambda: abs(seconds(shared_page) - usual) < 1e-6, "motion by default")
    return shared_page


def open_motion(page: Page, server: RunningServer) -> None:
    open_page(page, server.url)
    enter(page)


def enter(page: Page) -> None:
    wait_ready(page, [TOOL])
    page.get_by_role("tab", name="Motion", exact=True).wait_for()
    open_tab(page, "Motion")
    wait_planned(page, r"limits")


def take_robot(page: Page, name: str) -> None:
    open_tab(page, "Robot")
    if page.get_by_label("Robot", exact=True).input_value() != ROBOTS[name].title:
        choose(page, "Robot", ROBOTS[name].title)
    open_tab(page, "Motion")


def verdict(page: Page) -> Locator:
    return page.locator(".deltalab-verdict").first


def wait_planned(page: Page, says: str) -> str:
    """The verdict, once it is as expected."""
    expect(verdict(page)).to_have_text(re.compile(says), timeout=30_000)
    return verdict(page).inner_text()


def seconds(page: Page) -> float:
    """Duration of the motion that is shown."""
    found = chart(page, SPEED)
    return found.x[-1] if found else math.nan


def drawn(page: Page, title: str) -> Chart:
    found = chart(page, title)
    assert found is not None, f"no chart {title!r}"
    return found


def marked_points(page: Page) -> int:
    """Ends of path segments in the colour of a touched limit; -1 while no path is shown."""
    found = page.evaluate(_PATH, PATH)
    if not found or not found["visible"]:
        return -1
    return sum(1 for k in range(0, len(found["colors"]), 3) if found["colors"][k : k + 3] == MARKED)


@pytest.mark.parametrize("robot", ROBOTS)
def test_every_robot_is_given_a_motion_with_its_limits(shared_page: Page, robot: str):
    page = shared_page
    take_robot(page, robot)
    motion = plan_motion(default_motion(robot))
    wait_until(page, lambda: abs(seconds(page) - float(motion.t[-1])) < 1e-6, "motion of this robot")
    speeds = drawn(page, SPEED)
    names = ROBOTS[robot].build.joint_names
    assert speeds.legend == [*names, "limits"], "one entry for all limits"
    assert speeds.axes[1] == ("Speed (mm/s)" if robot == "linear" else "Speed (deg/s)")
    factor = 1e3 if robot == "linear" else math.degrees(1.0)
    assert max(speeds.scale) >= factor * float(motion.limits.speed[0]), "the limit is in the picture"
    assert max(speeds.curves[names[0]]) == pytest.approx(factor * float(motion.joint_rates[:, 0].max()), rel=0.02)
    wait_until(page, lambda: marked_points(page) > 0, "touched limit in the colour of a mark")
    screenshot(page, f"motion-{robot}")


def test_a_profile_and_a_curve_change_the_motion(lab: Page):
    page = lab
    before = seconds(page)
    choose(page, "Profile", "Cubic")
    wait_until(page, lambda: abs(seconds(page) - before) > 1e-3, "another duration")
    choose(page, "Curve", "Helix")
    expect(slider_box(page, "Turns")).to_have_value("3")
    choose(page, "Profile", "Time-optimal")
    wait_until(page, lambda: len(drawn(page, SPEED).x) > 50 and marked_points(page) > 100, "limits touched all along")
    choose(page, "Joint", "q2")
    wait_until(page, lambda: math.isnan(drawn(page, SPEED).last("q1")), "one joint only")
    choose(page, "Joint", "All joints")
    screenshot(page, "motion-time-optimal")


def test_too_short_a_duration_is_refused_and_the_last_motion_stays(lab: Page):
    page = lab
    before = seconds(page)
    toggle(page, "As short as the limits allow")
    type_into(page, "Duration (s)", 0.05)
    said = wait_planned(page, "▲")
    assert "still shown" in said
    assert seconds(page) == pytest.approx(before, abs=2e-3)
    assert float(page.locator(".uplot").first.evaluate("e => getComputedStyle(e).opacity")) < 0.5, "greyed"
    assert marked_points(page) == 0
    screenshot(page, "motion-refused")
    type_into(page, "Duration (s)", 4)
    wait_until(page, lambda: abs(seconds(page) - 4.0) < 1e-6, "slow motion")
    assert float(page.locator(".uplot").first.evaluate("e => getComputedStyle(e).opacity")) == 1.0


def test_it_plays_pauses_and_is_scrubbed(lab: Page):
    page = lab
    motion = plan_motion(default_motion("par4"))
    set_slider(page, "Time (s)", 0.6)
    there = motion.trajectory.sample(np.array([0.6])).pose[0]
    wait_until(page, lambda: tool_distance_mm(page, there) < 2.0, "tool where it is after 0.6 s")
    press(page, "Play")
    first = node_pose(page, TOOL)
    wait_until(page, lambda: node_pose(page, TOOL) != first, "robot on its way")
    press(page, "Pause")
    expect(button(page, "Play")).to_be_visible()
    with page.expect_download() as waiting:
        press(page, "Save this motion as CSV")
    rows = list(csv.DictReader(io.StringIO(waiting.value.path().read_text())))
    assert [float(row["x"]) for row in rows] == pytest.approx(motion.pose[:, 0].tolist(), abs=1e-9)


def tool_distance_mm(page: Page, pose: np.ndarray) -> float:
    found = node_pose(page, TOOL)
    return 1e3 * math.dist(found.position, pose[:3]) if found else math.inf


def test_the_path_hides_behind_another_lab(lab: Page):
    page = lab
    wait_until(page, lambda: marked_points(page) > 0, "path")
    open_tab(page, "Control")
    wait_until(page, lambda: marked_points(page) == -1, "path out of the way", timeout=60)
    open_tab(page, "Motion")
    wait_until(page, lambda: marked_points(page) > 0, "path again")


def test_the_work_cycle_follows_its_belts_and_survives_a_reload(lab: Page):
    page = lab
    take_robot(page, "fivebar")
    wait_planned(page, r"limits")
    choose(page, "Show", "Work cycle")
    wait_until(page, lambda: abs(seconds(page) - 2.46) < 1e-6, "cycle of 2.46 s")
    choose(page, "Preset", "W2")
    wait_planned(page, r"limits")
    expect(page.get_by_label("Enforce motor speed", exact=True)).not_to_be_checked()
    toggle(page, "Enforce motor speed")
    wait_planned(page, "▲")
    choose(page, "Preset", "W1")
    wait_planned(page, r"limits")
    set_slider(page, "Belt speed (mm/s)", 400)
    wait_planned(page, "▲")
    set_slider(page, "Belt speed (mm/s)", 120)
    wait_planned(page, r"limits")
    screenshot(page, "motion-cycle")
    page.reload(wait_until="domcontentloaded")
    enter(page)
    expect(page.get_by_label("Show", exact=True)).to_have_value("Work cycle")
    expect(page.get_by_label("Preset", exact=True)).to_have_value("My own")
