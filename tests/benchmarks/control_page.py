"""How soon the plots follow a slider: from the key press to the new curve in the chart, in a real browser.

Also how it is for several students at once, over the wire: from the changed value to the chart's new data. Chromium
draws the robot in software here, which delays the page's own part.

    python tests/benchmarks/control_page.py --runs 20
"""

from __future__ import annotations

import asyncio
import statistics
import time
from dataclasses import dataclass

import tyro
from playwright.sync_api import Page, sync_playwright

from tests.support.browser import DESKTOP, launch, new_page, open_page, wait_until
from tests.support.plots import chart
from tests.support.server import RunningServer, running_deltalab
from tests.support.widgets import open_tab, slider_thumb
from tests.support.wire import Message, WireClient, run_async, wire_client

STEP = "Step response"

_FOLLOW = """async ([thumb, title]) => {
  const find = () => Object.values(window.__viserTestpoints.uplots)
    .find(({chart}) => chart.root.querySelector(".u-title")?.textContent === title).chart;
  const before = find().data, started = performance.now();
  thumb.dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowRight", bubbles: true}));
  while (find().data === before) {
    if (performance.now() - started > 5000) return NaN;
    await new Promise(resolve => setTimeout(resolve, 0));
  }
  return performance.now() - started;
}"""


@dataclass(frozen=True)
class Options:
    """Measure the way from a slider to the plots."""

    runs: int = 20
    """Moves of the slider in the browser."""
    students: tuple[int, ...] = (1, 8, 30)
    """Students at once, each moving a slider 5 times a second for 5 s."""


def in_browser(page: Page, server: RunningServer, runs: int) -> list[float]:
    """Milliseconds of each move."""
    open_page(page, server.url, ["/robot/tool"], sharpness=None)
    page.get_by_role("tab", name="Control", exact=True).wait_for()
    open_tab(page, "Control")
    wait_until(page, lambda: (found := chart(page, STEP)) and len(found.x) > 100, "step response", timeout=60)
    thumb = slider_thumb(page, "kp, slider").element_handle()
    times = []
    for _ in range(runs):
        page.wait_for_timeout(400)
        times.append(page.evaluate(_FOLLOW, [thumb, STEP]))
    return times


async def over_the_wire(url: str, students: int) -> list[float]:
    """Milliseconds from a changed value to the chart's data, of all students."""

    async def study(offset: float) -> list[float]:
        async with wire_client(url) as client:
            await client.wait_for(lambda: client.has("Control opened"), "furnished room")
            await client.set_value("Control opened", True)
            await client.wait_for(lambda: client.has("kp, slider"), "control lab")
            await asyncio.sleep(1.0 + offset)
            times = []
            for k in range(25):
                times.append(await follow(client, 20 + k % 40))
                await asyncio.sleep(max(0.0, 0.2 - times[-1] / 1e3))
            return times

    rows = await asyncio.gather(*(study(0.2 * k / students) for k in range(students)))
    return [value for row in rows for value in row]


async def follow(client: WireClient, position: int) -> float:
    arrived: list[float] = []

    def note(message: Message, at: float) -> None:
        if message["type"] == "GuiUpdateMessage" and "data" in message["updates"]:
            arrived.append(at)

    client.listeners.append(note)
    started = time.perf_counter()
    await client.set_value("kp, slider", position)
    await client.wait_for(lambda: arrived, "new data")
    client.listeners.remove(note)
    return 1e3 * (arrived[0] - started)


def report(what: str, times: list[float]) -> None:
    ordered = sorted(times)
    p95 = ordered[round(0.95 * (len(ordered) - 1))]
    print(f"{what:<34} median {statistics.median(times):6.1f} ms   p95 {p95:6.1f} ms   worst {ordered[-1]:6.1f} ms")


def main(options: Options) -> None:
    with running_deltalab("--no-shadows") as server:
        time.sleep(6.0)  # the workers have warmed up
        for students in options.students:
            report(f"over the wire, {students} students", run_async(over_the_wire(server.url, students)))
        with sync_playwright() as playwright:
            browser = launch(playwright)
            report("key press to chart, browser", in_browser(new_page(browser, DESKTOP), server, options.runs))
            browser.close()


if __name__ == "__main__":
    main(tyro.cli(Options))
