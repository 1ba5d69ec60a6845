"""Free drawing in a real browser: mouse, pen and finger, and the paper they draw on."""

from __future__ import annotations

from collections.abc import Iterator

import cv2
import numpy as np
import pytest
from playwright.sync_api import Page, expect

from app.ui.drawing.pad_strokes import MAX_STROKES
from tests.support.browser import PHONE, PageFactory, screenshot, wait_until
from tests.support.pad_page import (
    PEN,
    SHEET,
    PadServer,
    Path,
    Points,
    draw,
    draw_with_finger,
    ink,
    on_page,
    open_pad,
    pad_server,
)
from tests.support.widgets import press

WIDE_SHEET = (297.0, 210.0)
CLOSE_MM = 0.6
ZIGZAG = [(-50.0, 60.0), (0.0, 90.0), (40.0, -30.0), (-20.0, -80.0)]
LONG = 1500
"""More points than fit into two messages."""


@pytest.fixture(scope="module")
def lab() -> Iterator[PadServer]:
    with pad_server() as running:
        yield running


@pytest.fixture(scope="module")
def shared_desk(lab: PadServer, lasting_visit: PageFactory) -> Page:
    return open_pad(lasting_visit(), lab)


@pytest.fixture
def desk(shared_desk: Page, lab: PadServer) -> Page:
    """A page with an empty pad that nobody has drawn on."""
    lab.pad.load([])
    lab.pad.show_sheet(SHEET)
    wait_until(shared_desk, lambda: not ink(shared_desk, (0.0, 0.0), radius_mm=70.0), "white paper")
    lab.heard.clear()
    return shared_desk


def distances(points: Points, corners: Path) -> Points:
    """How far each point is from a polyline."""
    path = np.array(corners, dtype=float)
    start, step = path[:-1], np.diff(path, axis=0)
    along = np.sum((points[:, None] - start) * step, axis=2) / np.sum(step**2, axis=1)
    foot = start + np.clip(along, 0, 1)[..., None] * step
    return np.min(np.linalg.norm(points[:, None] - foot, axis=2), axis=1)


def assert_follows(stroke: Points, corners: Path) -> None:
    """A stroke stays on a path, begins and ends with it, and reaches its corners."""
    assert np.max(distances(stroke, corners)) < CLOSE_MM
    assert np.linalg.norm(stroke[[0, -1]] - np.array([corners[0], corners[-1]]), axis=1).max() < CLOSE_MM
    assert max(np.min(np.linalg.norm(stroke - corner, axis=1)) for corner in np.array(corners)) < CLOSE_MM


def test_a_mouse_draws(desk: Page, lab: PadServer):
    draw(desk, ZIGZAG)
    wait_until(desk, lambda: lab.heard, "a stroke")
    (stroke,) = lab.heard[-1]
    assert_follows(stroke, ZIGZAG)
    assert all(ink(desk, corner) for corner in ZIGZAG) and not ink(desk, (50.0, 50.0))
    screenshot(desk, "pad-light")


def test_quick_strokes_all_arrive_in_their_order(desk: Page, lab: PadServer):
    lines = [[(-60.0, y), (60.0, y + 5.0)] for y in (80.0, 40.0, 0.0, -40.0)]
    for line in lines:
        places = on_page(desk, line)
        desk.mouse.move(*places[0])
        desk.mouse.down()
        desk.mouse.move(*places[1])
        desk.mouse.up()
    wait_until(desk, lambda: len(lab.pad.strokes) == len(lines), "four strokes")
    for stroke, line in zip(lab.pad.strokes, lines, strict=True):
        assert_follows(stroke, line)
    assert [len(strokes) for strokes in lab.heard] == [1, 2, 3, 4]


def test_strokes_of_the_same_moment_do_not_replace_each_other(desk: Page, lab: PadServer):
    """The same tap twice, and a stroke of several messages."""
    desk.evaluate(
        f"""() => {{ {PEN}
          pen("pointerdown", 0.1, 0.1); pen("pointerup", 0.1, 0.1);
          pen("pointerdown", 0.1, 0.1); pen("pointerup", 0.1, 0.1);
          pen("pointerdown", 0.5, 0.9);
          for (let k = 1; k < {LONG}; k++) pen("pointermove", k % 2 ? 0.2 : 0.8, 0.9 - 0.8 * k / {LONG});
          pen("pointerup", 0.8, 0.1);
        }}"""
    )
    wait_until(desk, lambda: len(lab.pad.strokes) == 3, "three strokes")
    assert [len(strokes) for strokes in lab.heard] == [1, 2, 3], "heard once a stroke, not once a message"
    assert [len(stroke) for stroke in lab.pad.strokes] == [2, 2, LONG + 1]
    for dot in lab.pad.strokes[:2]:
        np.testing.assert_allclose(dot, np.full((2, 2), (-59.2, 84.0)), atol=CLOSE_MM)
    assert np.all(np.diff(lab.pad.strokes[2][:, 1]) >= 0.0), "in the order in which it was drawn"


def test_a_slow_pen_does_not_send_every_step(desk: Page, lab: PadServer):
    """40 mm in steps of a tenth: of four points one is enough, and the end is exact."""
    desk.evaluate(
        f"""() => {{ {PEN}
          pen("pointerdown", 0.5, 0.5);
          for (let k = 1; k <= 401; k++) pen("pointermove", 0.5 + 0.1 * k / {SHEET[0]}, 0.5);
          pen("pointerup", 0.5 + 40.1 / {SHEET[0]}, 0.5);
        }}"""
    )
    wait_until(desk, lambda: lab.pad.strokes, "a stroke")
    (stroke,) = lab.pad.strokes
    assert 80 <= len(stroke) <= 102 and stroke[-1] == pytest.approx([40.1, 0.0], abs=0.11)
    assert np.all(np.diff(stroke[:-1, 0]) > 0.39)


def test_a_stroke_drawn_while_the_server_speaks_stays(desk: Page, lab: PadServer):
    """What the server shows was true before it heard of the stroke."""
    desk.evaluate(
        f"""() => {{ {PEN}
          pen("pointerdown", 0.4, 0.5); pen("pointermove", 0.6, 0.5); pen("pointerup", 0.6, 0.5);
          window.deltalabPads[canvas.id].show([[-1, [[-300, 600], [300, 600]]]], 0);
        }}"""
    )
    assert ink(desk, (0.0, 0.0)) and ink(desk, (0.0, 60.0))
    wait_until(desk, lambda: len(lab.pad.strokes) == 1, "the stroke")
    lab.pad.load([])
    wait_until(desk, lambda: not ink(desk, (0.0, 0.0)), "gone, once the server has heard of it")


def test_undo_and_clear(desk: Page, lab: PadServer):
    places = [(-40.0, 60.0), (0.0, 20.0), (40.0, -20.0)]
    for x, y in places:
        draw(desk, [(x - 10, y), (x + 10, y)])
    wait_until(desk, lambda: len(lab.pad.strokes) == 3, "three strokes")
    press(desk, "Undo")
    wait_until(desk, lambda: len(lab.heard[-1]) == 2, "undo")
    wait_until(desk, lambda: not ink(desk, places[2]), "the last line gone")
    assert ink(desk, places[0]) and ink(desk, places[1])
    draw(desk, [(30.0, 80.0), (60.0, 80.0)])
    wait_until(desk, lambda: len(lab.pad.strokes) == 3, "one more")
    press(desk, "Clear")
    wait_until(desk, lambda: lab.heard[-1] == [], "nothing left")
    wait_until(desk, lambda: not any(ink(desk, place) for place in [*places, (45.0, 80.0)]), "clean paper")
    heard = len(lab.heard)
    press(desk, "Undo")
    assert lab.pad.strokes == [] and len(lab.heard) == heard


def test_beyond_the_edge_the_line_follows_it(desk: Page, lab: PadServer):
    draw(desk, [(60.0, 50.0), (78.0, 50.0), (78.0, 0.0), (60.0, 0.0)])
    wait_until(desk, lambda: lab.heard, "a stroke")
    (stroke,) = lab.heard[-1]
    assert stroke[:, 0].max() == 74.0
    assert_follows(stroke, [(60.0, 50.0), (74.0, 50.0), (74.0, 0.0), (60.0, 0.0)])


def test_a_loaded_drawing_survives_hiding_and_another_sheet(desk: Page, lab: PadServer):
    lab.pad.load([np.array([(-30.0, 10.0), (30.0, 10.0)]), np.array([(0.0, -40.0), (0.0, -40.0)])])
    wait_until(desk, lambda: ink(desk, (0.0, 10.0)) and ink(desk, (0.0, -40.0)), "line and dot")
    lab.pad.visible = False
    expect(desk.locator("canvas[data-sheet]")).to_have_count(0)
    expect(desk.get_by_role("button", name="Undo", exact=True)).to_have_count(0)
    lab.pad.visible = True
    desk.locator("canvas[data-sheet]").wait_for()
    wait_until(desk, lambda: ink(desk, (0.0, 10.0)), "the line again")
    lab.pad.show_sheet(WIDE_SHEET)
    wait_until(
        desk, lambda: ink(desk, (-25.0, 10.0), WIDE_SHEET) and not ink(desk, (-35.0, 10.0), WIDE_SHEET), "a wider sheet"
    )
    on_page(desk, [(0.0, 0.0)], WIDE_SHEET)
    assert lab.heard == []
    press(desk, "Undo")
    wait_until(desk, lambda: len(lab.pad.strokes) == 1 and not ink(desk, (0.0, -40.0), WIDE_SHEET), "no dot")


def test_a_full_pad_says_so_and_drops_the_stroke(desk: Page, lab: PadServer):
    lab.pad.load([np.array([(0.0, 60.0), (1.0, 60.0)])] * MAX_STROKES)
    wait_until(desk, lambda: ink(desk, (0.0, 60.0)), "what is loaded")
    draw(desk, [(-30.0, -50.0), (30.0, -50.0)])
    expect(desk.get_by_text("undo or clear some before you draw on", exact=False)).to_be_visible()
    wait_until(desk, lambda: not ink(desk, (0.0, -50.0)), "the refused stroke gone")
    assert len(lab.pad.strokes) == MAX_STROKES and lab.heard == []


def test_the_paper_stays_white_in_the_dark_theme(desk: Page, lab: PadServer):
    draw(desk, ZIGZAG)
    lab.clients[-1].gui.configure_theme(dark_mode=True)
    wait_until(desk, lambda: desk.locator("html[data-mantine-color-scheme=dark]").count(), "dark theme")
    picture = cv2.imread(str(screenshot(desk, "pad-dark", 1.0)))
    lab.clients[-1].gui.configure_theme(dark_mode=False)
    assert picture is not None
    (x, y), (beside, _) = on_page(desk, [(50.0, 50.0), (-77.0, 50.0)]).astype(int)
    assert picture[y, x].tolist() == [255, 255, 255] and picture[y, beside].max() < 60


def test_a_finger_draws_and_does_not_scroll(visit: PageFactory, lab: PadServer):
    page = open_pad(visit(PHONE), lab)
    before = on_page(page, [(0.0, 0.0)])
    path = [(-30.0, -60.0), (20.0, 70.0)]
    draw_with_finger(page, path)
    wait_until(page, lambda: lab.heard, "a stroke")
    assert_follows(lab.heard[-1][0], path)
    np.testing.assert_allclose(on_page(page, [(0.0, 0.0)]), before, atol=0.01)
    screenshot(page, "pad-phone")
    draw_with_finger(page, [(80.0, 40.0), (80.0, 90.0)])
    draw_with_finger(page, [(80.0, 0.0), (80.0, 90.0)])
    wait_until(
        page, lambda: on_page(page, [(0.0, 0.0)])[0, 1] < before[0, 1] - 20, "the panel scrolled beside the paper"
    )
    assert len(lab.pad.strokes) == 1
