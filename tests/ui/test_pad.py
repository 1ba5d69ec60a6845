"""Free drawing in a real browser: mouse, pen and finger, and the paper they draw on."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

import cv2
import numpy as np
import pytest
import viser
from numpy.typing import NDArray
from playwright.sync_api import Browser, CDPSession, Page, expect

from app.ui.drawing.pad_strokes import MAX_STROKES
from app.ui.guard import Guard
from app.ui.panels.drawing.pad import Pad
from app.ui.viser_adapter import start_server, stop_server
from tests.support.browser import DESKTOP, PHONE, PageFactory, new_page, screenshot, wait_until
from tests.support.widgets import press

HOST = "127.0.0.1"
SHEET, WIDE_SHEET = (148.0, 210.0), (297.0, 210.0)
CLOSE_MM = 0.6
ZIGZAG = [(-50.0, 60.0), (0.0, 90.0), (40.0, -30.0), (-20.0, -80.0)]
LONG = 1500
"""More points than fit into two messages."""
PEN = """
  const canvas = document.querySelector("canvas[data-sheet]"), box = canvas.getBoundingClientRect();
  canvas.setPointerCapture = () => {};
  const pen = (type, x, y) => canvas.dispatchEvent(new PointerEvent(type, {
    bubbles: true, pointerId: 7, pointerType: "pen", clientX: box.left + x * box.width, clientY: box.top + y * box.height,
  }));
"""
"""A digitiser that knows no pause; x and y are shares of the paper, from its upper left."""
INK = """([x, y, share]) => {
  const canvas = document.querySelector("canvas[data-sheet]"), r = Math.ceil(share * canvas.width);
  const left = Math.round(x * canvas.width) - r, top = Math.round(y * canvas.height) - r;
  const pixels = canvas.getContext("2d").getImageData(left, top, 2 * r, 2 * r).data;
  return pixels.some((value, k) => k % 4 === 0 && value < 130);
}"""

Points = NDArray[np.float64]


class PadServer:
    """A pad, and a long text, for every visitor; `heard` lists what the newest one's callback got."""

    def __init__(self, server: viser.ViserServer) -> None:
        self.url = f"http://{HOST}:{server.get_port()}"
        self.heard: list[list[Points]] = []
        self.clients: list[viser.ClientHandle] = []
        self.pads: list[Pad] = []
        server.on_client_connect(self._furnish)

    @property
    def pad(self) -> Pad:
        return self.pads[-1]

    async def _furnish(self, client: viser.ClientHandle) -> None:
        self.heard = heard = []
        self.pads.append(Pad(client, heard.append))
        client.gui.add_markdown("\n\n".join(["A panel that is longer than its place."] * 40))
        self.clients.append(client)


@pytest.fixture(scope="module")
def lab() -> Iterator[PadServer]:
    server = start_server(HOST, 0, Guard())
    try:
        yield PadServer(server)
    finally:
        stop_server(server)


@pytest.fixture(scope="module")
def shared_desk(browser: Browser, lab: PadServer) -> Iterator[Page]:
    errors: list[str] = []
    page = new_page(browser, DESKTOP)
    page.on("pageerror", lambda error: errors.append(str(error)))
    open_pad(page, lab)
    yield page
    page.context.close()
    assert not errors, f"script errors on the page: {errors}"


@pytest.fixture
def desk(shared_desk: Page, lab: PadServer) -> Page:
    """A page with an empty pad that nobody has drawn on."""
    lab.pad.load([])
    lab.pad.show_sheet(SHEET)
    wait_until(shared_desk, lambda: not ink(shared_desk, (0.0, 0.0), radius_mm=70.0), "white paper")
    lab.heard.clear()
    return shared_desk


def open_pad(page: Page, lab: PadServer) -> Page:
    """Wait until the pad is there and stands still."""
    page.goto(lab.url, wait_until="domcontentloaded")
    page.locator("canvas[data-sheet]").wait_for()
    page.get_by_text("A panel that").last.wait_for()
    wait_until(page, lambda: page.evaluate("Object.keys(window.deltalabPads ?? {}).length"), "script of the pad")
    page.wait_for_timeout(500)
    return page


def on_page(page: Page, points_mm: Sequence[tuple[float, float]], sheet: tuple[float, float] = SHEET) -> Points:
    """Where on the page these points of the sheet are."""
    box = page.locator("canvas[data-sheet]").bounding_box()
    assert box is not None and box["width"] / box["height"] == pytest.approx(sheet[0] / sheet[1], rel=0.01)
    share = np.array(points_mm) / np.array(sheet) * (1, -1) + 0.5
    return share * (box["width"], box["height"]) + (box["x"], box["y"])


def draw(page: Page, points_mm: Sequence[tuple[float, float]]) -> None:
    places = on_page(page, points_mm)
    page.mouse.move(*places[0])
    page.mouse.down()
    for place in places[1:]:
        page.mouse.move(*place, steps=8)
    page.mouse.up()


def draw_with_finger(page: Page, points_mm: Sequence[tuple[float, float]]) -> None:
    session: CDPSession = page.context.new_cdp_session(page)
    stops = on_page(page, points_mm)
    fractions = np.linspace(0, len(stops) - 1, 20)
    path = np.column_stack([np.interp(fractions, range(len(stops)), stops[:, axis]) for axis in (0, 1)])
    for kind, place in zip(itertools.chain(["touchStart"], itertools.repeat("touchMove")), path, strict=False):
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": place[0], "y": place[1]}]})
        page.wait_for_timeout(15)
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    session.detach()


def ink(page: Page, place_mm: tuple[float, float], sheet: tuple[float, float] = SHEET, radius_mm: float = 1.0) -> bool:
    """Whether something dark is drawn around a place on the sheet."""
    x, y = place_mm[0] / sheet[0] + 0.5, 0.5 - place_mm[1] / sheet[1]
    return page.evaluate(INK, [x, y, radius_mm / sheet[0]])


def distances(points: Points, corners: Sequence[tuple[float, float]]) -> Points:
    """How far each point is from a polyline."""
    path = np.array(corners, dtype=float)
    start, step = path[:-1], np.diff(path, axis=0)
    along = np.sum((points[:, None] - start) * step, axis=2) / np.sum(step**2, axis=1)
    foot = start + np.clip(along, 0, 1)[..., None] * step
    return np.min(np.linalg.norm(points[:, None] - foot, axis=2), axis=1)


def assert_follows(stroke: Points, corners: Sequence[tuple[float, float]]) -> None:
    """A stroke stays on a path, begins and ends with it, and reaches its corners."""
    assert np.max(distances(stroke, corners)) < CLOSE_MM
    assert np.linalg.norm(stroke[[0, -1]] - np.array([corners[0], corners[-1]]), axis=1).max() < CLOSE_MM
    assert max(np.min(np.linalg.norm(stroke - corner, axis=1)) for corner in np.array(corners)) < CLOSE_MM
    assert np.all(np.linalg.norm(np.diff(stroke, axis=0), axis=1)[:-1] > 0.39), "thinned"


def test_a_mouse_draws(desk: Page, lab: PadServer):
    draw(desk, ZIGZAG)
    wait_until(desk, lambda: lab.heard, "a stroke")
    (stroke,) = lab.heard[-1]
    assert_follows(stroke, ZIGZAG)
    assert all(ink(desk, corner) for corner in ZIGZAG) and not ink(desk, (50.0, 50.0))
    screenshot(desk, "pad-light", 0.5)


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
    """A tap, a stroke of several messages, and a tap."""
    desk.evaluate(
        f"""() => {{ {PEN}
          pen("pointerdown", 0.1, 0.1); pen("pointerup", 0.1, 0.1);
          pen("pointerdown", 0.5, 0.9);
          for (let k = 1; k < {LONG}; k++) pen("pointermove", k % 2 ? 0.2 : 0.8, 0.9 - 0.8 * k / {LONG});
          pen("pointerup", 0.8, 0.1);
          pen("pointerdown", 0.1, 0.1); pen("pointerup", 0.1, 0.1);
        }}"""
    )
    wait_until(desk, lambda: len(lab.pad.strokes) == 3, "three strokes")
    assert [len(strokes) for strokes in lab.heard] == [1, 2, 3], "heard once a stroke, not once a message"
    assert [len(stroke) for stroke in lab.pad.strokes] == [2, LONG + 1, 2]
    dot, scribble, _ = lab.pad.strokes
    np.testing.assert_allclose(dot, np.full((2, 2), (-59.2, 84.0)), atol=CLOSE_MM)
    assert np.all(np.diff(scribble[1:-1, 1]) >= 0.0), "in the order in which it was drawn"


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
    screenshot(page, "pad-phone", 0.5)
    draw_with_finger(page, [(80.0, 40.0), (80.0, 90.0)])
    draw_with_finger(page, [(80.0, 0.0), (80.0, 90.0)])
    wait_until(
        page, lambda: on_page(page, [(0.0, 0.0)])[0, 1] < before[0, 1] - 20, "the panel scrolled beside the paper"
    )
    assert len(lab.pad.strokes) == 1
