"""A drawing pad on a page of its own: drawn on with mouse, finger and pen, and looked at."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np
import pytest
import viser
from numpy.typing import NDArray
from playwright.sync_api import CDPSession, Page

from app.ui.guard import Guard
from app.ui.panels.drawing.pad import Pad
from app.ui.viser_adapter import start_server, stop_server
from tests.support.browser import open_page, wait_until

HOST = "127.0.0.1"
SHEET = (148.0, 210.0)
PEN = """
  const canvas = document.querySelector("canvas[data-sheet]"), box = canvas.getBoundingClientRect();
  const pen = (type, x, y) => canvas.dispatchEvent(new PointerEvent(type, {
    bubbles: true, pointerId: 1, pointerType: "pen",
    clientX: box.left + x * box.width, clientY: box.top + y * box.height,
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
Path = Sequence[tuple[float, float]]


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


@contextmanager
def pad_server() -> Iterator[PadServer]:
    server = start_server(HOST, 0, Guard())
    try:
        yield PadServer(server)
    finally:
        stop_server(server)


def open_pad(page: Page, lab: PadServer) -> Page:
    """Wait until the pad is there and stands still: the panel grows and moves while a slow machine starts the page."""
    open_page(page, lab.url)
    page.get_by_text("A panel that").last.wait_for()
    wait_until(page, lambda: page.evaluate("Object.keys(window.deltalabPads ?? {}).length"), "script of the pad")
    places: list[Points] = []

    def stands_still() -> bool:
        places.append(on_page(page, [(0.0, 0.0)]))
        return len(places) > 20 and np.ptp(places[-20:], axis=0).max() < 0.01

    wait_until(page, stands_still, "pad that stands still", timeout=60.0)
    return page


def on_page(page: Page, points_mm: Path, sheet: tuple[float, float] = SHEET) -> Points:
    """Where on the page these points of the sheet are."""
    box = page.locator("canvas[data-sheet]").bounding_box()
    assert box is not None and box["width"] / box["height"] == pytest.approx(sheet[0] / sheet[1], rel=0.01)
    share = np.array(points_mm) / np.array(sheet) * (1, -1) + 0.5
    return share * (box["width"], box["height"]) + (box["x"], box["y"])


def draw(page: Page, points_mm: Path) -> None:
    places = on_page(page, points_mm)
    page.mouse.move(*places[0])
    page.mouse.down()
    for place in places[1:]:
        page.mouse.move(*place, steps=4)
    page.mouse.up()


def draw_with_finger(page: Page, points_mm: Path) -> None:
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
