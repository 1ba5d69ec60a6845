"""The page as a student uses it, in a real browser. Each test leaves a picture in tests/artifacts."""

from __future__ import annotations

import math
import re

import pytest
from playwright.sync_api import Page, expect

from app.robots import ROBOTS, make_robot
from tests.support.browser import (
    PHONE,
    SHARPNESS,
    PageFactory,
    Screen,
    node_pose,
    open_page,
    pull_gizmo,
    screenshot,
    turn_gizmo,
    wait_ready,
    wait_still,
    wait_until,
)
from tests.support.server import RunningServer
from tests.support.widgets import choose, field, open_tab, press, set_slider, slider_box, toggle, type_into

GIZMO, TOOL = "/robot/gizmo", "/robot/tool"
pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def shared_page(server: RunningServer, lasting_visit: PageFactory) -> Page:
    """One visitor for the tests that change no more than the robot and its pose."""
    page = lasting_visit()
    visit_lab(page, server)
    return page


@pytest.fixture
def lab(shared_page: Page) -> Page:
    """The Par4 delta at home."""
    press(shared_page, "Home")
    choose_robot(shared_page, "par4")
    return shared_page


def visit_lab(page: Page, server: RunningServer, sharpness: float | None = SHARPNESS) -> None:
    open_page(page, server.url, sharpness=sharpness)
    wait_for_lab(page)


def wait_for_lab(page: Page) -> None:
    wait_ready(page, [GIZMO, TOOL])
    expect(page.get_by_role("combobox", name="Robot")).to_be_visible(timeout=20_000)


def tool_mm(page: Page) -> list[float]:
    """Where the browser draws the tool."""
    pose = node_pose(page, TOOL)
    assert pose is not None
    return [1e3 * value for value in pose.position]


def gizmo_mm(page: Page) -> list[float]:
    pose = node_pose(page, GIZMO)
    assert pose is not None
    return [1e3 * value for value in pose.position]


def shown_mm(page: Page) -> list[float]:
    """What the panel says about the same."""
    return [float(field(page, f"{axis} (mm)").input_value()) for axis in "xyz"]


def agree(page: Page) -> bool:
    return max(abs(a - b) for a, b in zip(tool_mm(page), shown_mm(page), strict=True)) < 0.06


def pull(page: Page, axis: tuple[float, float, float], pixels: float, touch: bool = False) -> None:
    """Drag an arrow until the tool has moved."""
    before = tool_mm(page)
    pull_gizmo(page, GIZMO, lambda: math.dist(tool_mm(page), before) > 3.0, axis, pixels=pixels, touch=touch)


def choose_robot(page: Page, name: str) -> None:
    """Pick a robot and wait until it is there, and the panel in step with it."""
    choose(page, "Robot", ROBOTS[name].title)
    home = [1e3 * value for value in make_robot(name).home[:3]]
    wait_until(page, lambda: math.dist(tool_mm(page), home) < 0.01 and agree(page), f"{name} at home")
    wait_still(page, GIZMO)


@pytest.mark.parametrize("name", ROBOTS)
def test_each_robot_comes_alive(lab: Page, name: str):
    page = lab
    if name != "par4":
        choose_robot(page, name)
    home = [1e3 * value for value in make_robot(name).home[:3]]
    pull(page, (1.0, 0.0, 0.0), 40)
    wait_until(page, lambda: math.dist(tool_mm(page), home) > 5.0, "tool away from home")
    wait_until(page, lambda: agree(page), "panel in step with the picture")
    wait_until(page, lambda: math.dist(gizmo_mm(page), tool_mm(page)) < 0.01, "gizmo at the tool")
    screenshot(page, f"robot-{name}")


def test_a_drag_out_of_reach_says_which_limit_and_returns_the_gizmo(lab: Page):
    page = lab
    pull(page, (1.0, 0.0, 0.0), 330)
    expect(page.get_by_text(re.compile(r"Leg \d: upper arm at|leg \d is \d+ mm too short")).first).to_be_visible()
    stood = tool_mm(page)
    assert make_robot("par4").nearest([v / 1e3 for v in stood] + [0.0])[0] == pytest.approx(stood[0] / 1e3, abs=1e-5)
    wait_until(
        page,
        lambda: math.dist(gizmo_mm(page), tool_mm(page)) < 0.01,
        "gizmo at the tool",
    )
    screenshot(page, "out-of-reach")


def test_the_ring_turns_the_platform_and_the_tool_twice_as_far(lab: Page):
    page = lab
    wait_still(page, GIZMO)
    turn_gizmo(page, "/robot/platform/turn", degrees=20)
    wait_until(page, lambda: abs(float(field(page, "θ (deg)").input_value())) > 5, "a turned platform")
    wait_until(
        page,
        lambda: abs(math.remainder(tool_turn(page) - 2.0 * shown_theta(page), math.tau)) < 0.005,
        "a tool turned twice as far",
    )


def shown_theta(page: Page) -> float:
    return math.radians(float(field(page, "θ (deg)").input_value()))


def tool_turn(page: Page) -> float:
    """About z, as the browser draws it."""
    pose = node_pose(page, TOOL)
    assert pose is not None
    return 2.0 * math.atan2(pose.wxyz[3], pose.wxyz[0])


def test_a_typed_pose_moves_robot_gizmo_and_sliders(lab: Page):
    page = lab
    type_into(page, "x (mm)", 60)
    wait_until(page, lambda: abs(tool_mm(page)[0] - 60) < 0.01, "tool at the typed x")
    gizmo = node_pose(page, GIZMO)
    assert gizmo is not None and gizmo.position[0] == pytest.approx(0.06, abs=1e-5)
    joints = [math.degrees(q) for q in make_robot("par4").solve(0.06, -0.036, -0.3, 0.0)]
    wait_until(
        page, lambda: abs(float(slider_box(page, "q1 (deg)").input_value()) - joints[0]) < 0.06, "slider in step"
    )
    wait_until(page, lambda: agree(page), "panel in step: a number typed before that could be overwritten")
    type_into(page, "z (mm)", -900)
    expect(page.get_by_text(re.compile("too short|upper arm")).first).to_be_visible()
    wait_until(page, lambda: agree(page) and shown_mm(page)[2] > -600, "pose brought back into reach")


def test_a_joint_slider_moves_the_tool_and_refuses_the_impossible(lab: Page):
    page = lab
    choose_robot(page, "delta3")
    set_slider(page, "q1 (deg)", 30)
    pose = make_robot("delta3").forward([math.radians(30), *make_robot("delta3").solve(0.0, 0.0, -0.33)[1:]])
    wait_until(page, lambda: math.dist(tool_mm(page), [1e3 * v for v in pose]) < 0.5, "tool where the joints put it")
    press(page, "Home")
    choose_robot(page, "par4")
    before = tool_mm(page)
    set_slider(page, "q1 (deg)", 44)
    expect(page.get_by_text(re.compile("holds the last pose")).first).to_be_visible()
    assert math.dist(tool_mm(page), before) < 0.01
    wait_until(page, lambda: abs(float(slider_box(page, "q1 (deg)").input_value()) + 2.1) < 0.06, "slider back")


def test_a_changed_geometry_changes_the_machine(lab: Page):
    page = lab
    page.get_by_text("Geometry", exact=True).click()
    set_slider(page, "Rod length l (mm)", 450)
    longer = make_robot("par4", l=0.45)
    stands = longer.nearest([0.0, -0.036, -0.3, 0.0]).tolist()
    joints = [math.degrees(q) for q in longer.solve(*stands)]
    wait_until(
        page, lambda: abs(float(slider_box(page, "q1 (deg)").input_value()) - joints[0]) < 0.06, "joints of longer rods"
    )
    lowest = "() => { const p = window.__viserSceneTree.getState()['/robot/rod'].message.props;\
        let z = 0; for (let i = 2; i < p.vertices.length; i += 3) z = Math.min(z, p.vertices[i]); return z; }"
    wait_until(page, lambda: page.evaluate(lowest) < -0.44, "longer rods on the screen")
    screenshot(page, "geometry")
    press(page, "Reset geometry")
    wait_until(page, lambda: page.evaluate(lowest) > -0.44, "the rods of before")


def test_two_browsers_are_independent(lab: Page, page: Page, server: RunningServer):
    one, two = lab, page
    visit_lab(two, server)
    choose_robot(one, "linear")
    type_into(one, "x (mm)", 40)
    wait_until(one, lambda: abs(tool_mm(one)[0] - 40) < 0.01, "first browser's robot")
    assert field(two, "Robot").input_value() == ROBOTS["par4"].title
    assert tool_mm(two) == pytest.approx([0.0, -36.0, -300.0], abs=0.01)


def test_a_reload_keeps_the_students_robot(visit: PageFactory, server: RunningServer):
    """At the address that a student opens, and as sharp; a small window, since that costs."""
    page = visit(Screen(960, 600))
    visit_lab(page, server, sharpness=None)
    choose_robot(page, "fivebar")
    type_into(page, "y (mm)", 350)
    wait_until(page, lambda: abs(tool_mm(page)[1] - 350) < 0.01, "typed pose")
    page.reload(wait_until="domcontentloaded")
    wait_for_lab(page)
    assert field(page, "Robot").input_value() == ROBOTS["fivebar"].title
    wait_until(page, lambda: abs(tool_mm(page)[1] - 350) < 0.01, "the same pose again")


def test_view_options_show_what_they_say(lab: Page):
    page = lab
    open_tab(page, "View")
    choose(page, "Show as", "Surface")
    choose(page, "Loop vectors", "Leg 1")
    for label in ("Coordinate frames", "Other elbow solutions", "Trace of the tool"):
        toggle(page, label)
    names = "() => Object.keys(window.__viserSceneTree.getState())"
    wanted = {"/robot/workspace", "/robot/vectors", "/robot/base_frame", "/robot/ghosts/arm"}
    wait_until(page, lambda: wanted <= set(page.evaluate(names)), "workspace, vectors, frames and ghosts", timeout=20)
    pull(page, (1.0, 0.0, 0.0), 60)
    wait_until(page, lambda: "/robot/trace" in page.evaluate(names), "trace of the tool")
    screenshot(page, "view-options")
    toggle(page, "Dark theme")
    screenshot(page, "dark")
    press(page, "Reset view")
    wait_until(page, lambda: not (wanted & set(page.evaluate(names))), "a clean view")
    open_tab(page, "Robot")


def test_on_a_phone_a_finger_drags_the_robot(visit, server: RunningServer):
    page = visit(PHONE)
    visit_lab(page, server)
    before = tool_mm(page)
    pull(page, (0.0, 0.0, 1.0), -30, touch=True)
    wait_until(page, lambda: tool_mm(page)[2] < before[2] - 3, "tool pulled down")
    screenshot(page, "phone")
    overflow = page.evaluate("() => document.documentElement.scrollWidth - window.innerWidth")
    assert overflow <= 0, "nothing sticks out of a phone's screen"
