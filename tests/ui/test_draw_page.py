"""The tab Draw as a student uses it, in a real browser. Each test leaves a picture in tests/artifacts."""

from __future__ import annotations

import io
import math
import re
from pathlib import Path
from urllib.request import urlopen

import cv2
import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from app.drawing.exports import EXPORTS, read_points_file
from app.drawing.samples import sample_bytes
from app.drawing.svg_import import read_svg
from app.robots import ROBOTS
from tests.support.browser import PHONE, PageFactory, node_pose, open_page, pull_gizmo, screenshot, wait_until
from tests.support.plots import chart
from tests.support.server import RunningServer
from tests.support.widgets import (
    button,
    choose,
    field,
    open_tab,
    press,
    set_slider,
    settle,
    take_robot,
    toggle,
    type_into,
    upload,
)

TOOL, SHEET = "/robot/tool", "/robot/sheet"
pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def shared_page(server: RunningServer, lasting_visit: PageFactory) -> Page:
    """One visitor for most tests."""
    page = lasting_visit()
    open_draw(page, server)
    return page


@pytest.fixture
def desk(shared_page: Page) -> Page:
    """The line drawing of a robot on A6, ready to be drawn, pen and sheet as they are at first."""
    page = shared_page
    open_tab(page, "Drawing")
    choose(page, "Picture", "Delta robot")
    field(page, "Start from").wait_for()
    choose(page, "Start from", "Line art")
    wait_until(page, lambda: cell(page, "Mode").inner_text() == "Centre lines", "the line drawing")
    choose(page, "Size", "A6")
    if field(page, "Landscape").is_checked():
        toggle(page, "Landscape")
    press(page, "Put the sheet back")
    if button(page, "Stop and go home").is_enabled():
        press(page, "Stop and go home")
    ready(page)
    return page


def open_draw(page: Page, server: RunningServer) -> None:
    open_page(page, server.url, [TOOL])
    take_robot(page, ROBOTS["delta3"].title)
    open_tab(page, "Draw")
    page.get_by_alt_text("Drawing", exact=True).first.wait_for(timeout=60_000)


def ready(page: Page) -> None:
    """Wait until the way is planned, and the search for a better order has come to rest."""
    page.wait_for_timeout(300)
    wait_until(page, lambda: button(page, "Draw").is_visible() and button(page, "Draw").is_enabled(), "a plan")
    wait_until(page, lambda: re.match(r"\d", cell(page, "Drawing time").inner_text()), "the time it takes")


def cell(page: Page, name: str) -> Locator:
    """The number beside a name in the table."""
    return page.locator("td", has_text=re.compile(f"^{name}$")).locator("xpath=following-sibling::td[1]").first


def number(page: Page, name: str) -> float:
    """In the table, without its unit; metres in mm, minutes in s."""
    text = cell(page, name).inner_text()
    minutes = re.fullmatch(r"(\d+) min (\d+) s", text)
    if minutes:
        return 60.0 * float(minutes[1]) + float(minutes[2])
    value = float(re.match(r"[\d.]+", text)[0])  # type: ignore[index]
    return 1e3 * value if text.endswith(" m") else value


def picture(page: Page, caption: str) -> np.ndarray:
    """A picture as the page got it, (h, w, 3)."""
    source = page.get_by_alt_text(caption, exact=True).first.get_attribute("src")
    assert source is not None
    with urlopen(source) as data:
        return np.asarray(cv2.imdecode(np.frombuffer(data.read(), np.uint8), cv2.IMREAD_COLOR))


def saved(page: Page, title: str) -> bytes:
    """What the browser downloads in a format."""
    if not field(page, "Format").is_visible():
        page.get_by_text("Save the drawing", exact=True).click()
    choose(page, "Format", title)
    with page.expect_download() as waiting:
        press(page, "Save")
    return waiting.value.path().read_bytes()


def nodes(page: Page, start: str) -> list[str]:
    return [
        name
        for name in page.evaluate("() => Object.keys(window.__viserSceneTree.getState())")
        if name.startswith(start)
    ]


def test_the_tab_opens_with_a_drawing_and_its_numbers(desk: Page):
    page = desk
    assert number(page, "Strokes") > 5
    assert number(page, "Lifts") == number(page, "Strokes") - 1
    assert number(page, "Ink") > 300 and number(page, "Drawing time") > 5
    height, width = picture(page, "Drawing").shape[:2]
    assert width / height == pytest.approx(105 / 148, rel=0.02), "the picture has the sheet's shape"
    assert nodes(page, f"{SHEET}/plan"), "the plan lies on the sheet"
    screenshot(page, "draw-first")


def test_a_photo_is_uploaded_and_follows_the_knobs(desk: Page, tmp_path: Path):
    page = desk
    path = tmp_path / "my cat.jpg"
    path.write_bytes(sample_bytes("cat"))
    upload(page, "Upload a picture", path)
    wait_until(page, lambda: field(page, "Picture").input_value() == "my cat.jpg", "my picture")
    choose(page, "Mode", "Edges (Canny)")
    wait_until(page, lambda: cell(page, "Mode").inner_text() == "Edges (Canny)", "its edges")
    ready(page)
    before, ink = picture(page, "Drawing"), number(page, "Ink")
    toggle(page, "High threshold: automatic")
    set_slider(page, "High threshold", 120)
    wait_until(page, lambda: number(page, "Ink") < 0.8 * ink, "fewer lines with a high threshold")
    assert not np.array_equal(before, picture(page, "Drawing"))
    set_slider(page, "Smooth (px)", 9)
    choose(page, "Aperture (px)", "5")
    screenshot(page, "draw-knobs")


def test_the_robot_draws_pauses_lifted_and_goes_on(desk: Page):
    page = desk
    press(page, "Draw")
    wait_until(page, lambda: nodes(page, f"{SHEET}/ink/"), "ink on the sheet")
    paper_z = tool_z(page)
    press(page, "Pause")
    wait_until(page, lambda: button(page, "Go on").is_visible(), "a pause at the stroke's end", timeout=20)
    assert tool_z(page) > -0.3395, "the pen is lifted off the paper, at z = -340 mm"
    standing = node_pose(page, TOOL)
    page.wait_for_timeout(400)
    assert node_pose(page, TOOL) == standing
    screenshot(page, "draw-paused")
    choose(page, "Play speed", "20×")
    press(page, "Go on")
    wait_until(page, lambda: button(page, "Draw again").is_visible(), "the finished drawing", timeout=30)
    assert paper_z < -0.33
    expect(page.get_by_text("0.0 s to go, done", exact=False).first).to_be_visible()
    screenshot(page, "draw-done")
    choose(page, "Play speed", "1×")


def tool_z(page: Page) -> float:
    pose = node_pose(page, TOOL)
    assert pose is not None
    return pose.position[2]


def test_time_can_be_scrubbed_both_ways(desk: Page):
    page = desk
    set_slider(page, "Drawing time (s)", 8)
    wait_until(page, lambda: "of" in page.get_by_text(re.compile("^stroke ")).first.inner_text(), "a stroke's number")
    late = node_pose(page, TOOL)
    page.wait_for_timeout(300)
    much = ink_points(page)
    set_slider(page, "Drawing time (s)", 2)
    wait_until(page, lambda: node_pose(page, TOOL) != late, "the robot where it was")
    wait_until(page, lambda: 0 < ink_points(page) < much, "less ink")


def ink_points(page: Page) -> int:
    return page.evaluate(
        """() => Object.entries(window.__viserSceneTree.getState())
            .filter(([name, node]) => name.startsWith("/robot/sheet/ink/") && node.message?.props?.points)
            .reduce((sum, [, node]) => sum + node.message.props.points.length, 0)"""
    )


def test_without_a_lift_the_paper_gets_stray_ink(desk: Page):
    page = desk
    unfold_pen(page)
    toggle(page, "Lift the pen")
    wait_until(page, lambda: cell(page, "Stray ink").is_visible(), "stray ink in the table")
    assert number(page, "Stray ink") == pytest.approx(number(page, "Between strokes"), rel=0.03, abs=12)
    assert number(page, "Lifts") == 0
    ready(page)
    screenshot(page, "draw-no-lift")
    toggle(page, "Lift the pen")
    wait_until(page, lambda: not cell(page, "Stray ink").is_visible(), "a clean drawing")


def test_a_laser_is_off_at_first_and_follows_the_speed(desk: Page):
    page = desk
    unfold_pen(page)
    assert not field(page, "Laser").is_checked()
    toggle(page, "Laser")
    wait_until(page, lambda: chart(page, "Laser power") is not None, "plot of the power")
    found = chart(page, "Laser power")
    assert found is not None
    speed, power = (np.array(found.curves[name]) for name in ("speed, of the drawing speed", "laser power"))
    burning = power > 0
    assert power[burning] == pytest.approx(speed[burning], abs=0.5)
    assert (speed[~burning] > 20).any(), "it travels with the laser off"
    screenshot(page, "draw-laser")
    toggle(page, "Laser")
    wait_until(page, lambda: chart(page, "Laser power") is None, "no laser")


def unfold_pen(page: Page) -> None:
    if not field(page, "Laser").is_visible():
        page.get_by_text("Pen", exact=True).click()
        field(page, "Laser").wait_for()
        page.wait_for_timeout(600)  # the folder has unfolded: until then its boxes move under a click


def test_every_format_is_saved_as_shown(desk: Page):
    page = desk
    strokes = read_svg(saved(page, EXPORTS[".svg"].title))
    assert len(strokes) == number(page, "Strokes")
    length = sum(float(np.linalg.norm(np.diff(stroke, axis=0), axis=1).sum()) for stroke in strokes)
    assert length == pytest.approx(number(page, "Ink"), rel=0.01)
    points, sheet = read_points_file(saved(page, EXPORTS[".txt"].title).decode())
    assert len(points) == len(strokes) and sheet == (105.0, 148.0)
    gcode = saved(page, EXPORTS[".gcode"].title).decode()
    assert gcode.count("G1 Z0") == len(strokes)
    timed = np.loadtxt(io.StringIO(saved(page, "CSV of the robot's path in time").decode()), delimiter=",", skiprows=1)
    assert timed[-1, 0] == pytest.approx(number(page, "Drawing time"), abs=0.6)


def test_a_sheet_out_of_reach_is_shown_and_refused(desk: Page):
    page = desk
    type_into(page, "Sheet x (mm)", 250)
    expect(page.get_by_text("is beyond the robot", exact=False).first).to_be_visible(timeout=15_000)
    expect(button(page, "Draw")).to_be_disabled()
    red = picture(page, "Drawing").astype(int) - np.array([17, 51, 204])  # BGR
    assert (np.abs(red).max(axis=-1) < 40).sum() > 20, "what is out of reach is red"
    screenshot(page, "draw-out-of-reach")
    press(page, "Put the sheet back")
    ready(page)
    expect(page.get_by_text("is beyond the robot", exact=False).first).to_be_hidden()


def test_the_sheet_is_moved_by_its_handle(desk: Page):
    page = desk
    toggle(page, "Move the sheet")
    before = node_pose(page, SHEET)
    shown = field(page, "Sheet x (mm)")
    pull_gizmo(page, "/robot/sheet_handle", lambda: shown.input_value() not in ("", "0"), (1.0, 0.0, 0.0), pixels=50)
    after = node_pose(page, SHEET)
    assert before is not None and after is not None
    assert after.position[0] > before.position[0] + 0.005
    assert after.position[1:] == pytest.approx(before.position[1:], abs=1e-6)
    screenshot(page, "draw-placing")
    toggle(page, "Move the sheet")


def test_text_becomes_strokes(desk: Page):
    page = desk
    choose(page, "Picture", "A text")
    words = page.locator("textarea").first
    words.fill("Hola!")
    words.press("Tab")
    settle(page)
    wait_until(page, lambda: cell(page, "Mode").inner_text() == "Strokes as they are", "letters")
    assert 5 <= number(page, "Strokes") <= 12
    screenshot(page, "draw-text")


def test_a_stroke_by_hand_is_drawn_where_it_was_put(desk: Page):
    page = desk
    choose(page, "Picture", "Draw by hand")
    canvas = page.locator("canvas[role=img]")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    assert box is not None
    across = [box["x"] + share * box["width"] for share in (0.25, 0.5, 0.75)]
    page.mouse.move(across[0], box["y"] + box["height"] / 4)
    page.mouse.down()
    for x in across:
        page.mouse.move(x, box["y"] + box["height"] / 4, steps=6)
    page.mouse.up()
    settle(page)
    wait_until(page, lambda: cell(page, "Strokes").inner_text() == "1", "my stroke")
    assert number(page, "Ink") == pytest.approx(105 / 2, abs=2.0)
    (stroke,) = read_svg(saved(page, EXPORTS[".svg"].title))
    assert stroke[:, 1].mean() == pytest.approx(148 / 4, abs=1.0), "a quarter from the top"
    screenshot(page, "draw-by-hand")


def test_bad_files_are_refused_and_the_drawing_stays(desk: Page, tmp_path: Path):
    page = desk
    strokes = number(page, "Strokes")
    for name, content, complaint in (
        ("empty.png", b"", "empty"),
        ("letter.png", b"Dear robot, please draw me.", "This is text"),
        ("half.jpg", sample_bytes("cat")[:3000], "damaged"),
    ):
        path = tmp_path / name
        path.write_bytes(content)
        upload(page, "Upload a picture", path)
        expect(page.get_by_text("▲", exact=False).filter(has_text=complaint).first).to_be_visible(timeout=15_000)
        assert number(page, "Strokes") == strokes
        expect(button(page, "Draw")).to_be_enabled()


def test_a_picture_of_noise_offers_a_coarser_drawing(desk: Page, tmp_path: Path):
    page = desk
    noise = np.random.default_rng(1).integers(0, 256, (1000, 1000), dtype=np.uint8)
    choose(page, "Mode", "Outlines")
    (path := tmp_path / "noise.png").write_bytes(cv2.imencode(".png", noise)[1].tobytes())
    upload(page, "Upload a picture", path)
    button(page, "Draw it coarser").wait_for(timeout=20_000)
    expect(page.get_by_text("strokes, more than", exact=False).first).to_be_visible()
    strokes = number(page, "Strokes")
    press(page, "Draw it coarser")
    wait_until(page, lambda: not button(page, "Draw it coarser").is_visible(), "a drawing after all", timeout=30)
    assert number(page, "Strokes") != strokes


def test_comparisons(desk: Page):
    page = desk
    open_tab(page, "Compare")
    choose(page, "Sweep", "Drawing speed (mm/s)")
    press(page, "Sweep it")
    wait_until(page, lambda: points_of(page) >= 6, "a curve of quality against speed", timeout=60)
    found = chart(page, "Quality against speed")
    assert found is not None and found.x == sorted(found.x) and found.x[-1] > 2 * found.x[0]
    button(page, "Sweep it").wait_for()
    wait_until(page, lambda: button(page, "Compare the robots").is_enabled(), "the end of the sweep", timeout=60)
    press(page, "Compare the robots")
    for title in ("Par4 delta", "Linear delta", "5R pick-and-place"):
        expect(page.get_by_role("cell", name=re.compile(title)).first).to_be_attached(timeout=60_000)
    page.get_by_text("Against a serial arm (an exercise)", exact=True).click()
    field(page, "Path").nth(-1).scroll_into_view_if_needed()
    page.wait_for_timeout(600)  # the folder has unfolded
    choose(page, "Path", "Zigzag rows")
    press(page, "Compare with the arm")
    expect(page.get_by_text("the delta is", exact=False).first).to_be_visible(timeout=20_000)
    expect(page.get_by_text("not reproduced", exact=False).first).to_be_visible()
    screenshot(page, "draw-compare")


def points_of(page: Page) -> int:
    found = chart(page, "Quality against speed")
    return 0 if found is None else sum(math.isfinite(value) for value in found.curves["drawings"])


def test_another_robot_draws_it_too(desk: Page):
    page = desk
    open_tab(page, "Robot")
    choose(page, "Robot", ROBOTS["fivebar"].build.title)
    open_tab(page, "Draw")
    ready(page)
    choose(page, "Play speed", "20×")
    press(page, "Draw")
    wait_until(page, lambda: button(page, "Draw again").is_visible(), "the finished drawing", timeout=60)
    screenshot(page, "draw-fivebar")
    open_tab(page, "Robot")
    choose(page, "Robot", ROBOTS["delta3"].build.title)
    open_tab(page, "Draw")


def test_on_a_phone_the_drawing_stands_above_the_settings(visit, server: RunningServer):
    page = visit(PHONE)
    open_draw(page, server)
    expect(page.get_by_alt_text("Drawing", exact=True).first).to_be_in_viewport()
    expect(button(page, "Draw").first).to_be_in_viewport()
    overflow = page.evaluate("() => document.documentElement.scrollWidth - window.innerWidth")
    assert overflow <= 0, "nothing sticks out of a phone's screen"
    screenshot(page, "draw-phone")
