"""How long a student waits: for the server to listen, and from the link to a robot that can be dragged.

Chromium draws in software here, so the page's numbers are upper bounds for a machine with a graphics card.

    python tests/benchmarks/startup.py --runs 5
"""

from __future__ import annotations

import json
import statistics
from dataclasses import dataclass
from pathlib import Path

import tyro
from playwright.sync_api import Browser, Page, sync_playwright

from tests.support.browser import DESKTOP, drag_gizmo, launch, new_page, node_pose, wait_until
from tests.support.server import running_deltalab

GIZMO = "/robot/gizmo"
TOOL = "/robot/tool"
POLL_MS = 10

_STAGES = {
    "page received": "() => performance.getEntriesByType('navigation')[0]?.responseEnd",
    "scripts running": "() => window.__viserMutable && performance.now()",
    "robot in the scene": """() => {
        const page = window.__viserMutable, tree = window.__viserSceneTree?.getState();
        if (!page || !tree || page.messageQueue.length) return false;
        const nodes = page.nodeRefFromName;
        const robot = Object.keys(tree).filter(name => name.startsWith("/robot/"));
        const shapes = robot.filter(name => /Mesh|Glb/.test(tree[name].message?.type));
        const isBuilt = name => { let n = 0; nodes[name].traverse(o => n += +!!o.isMesh); return n > 0; };
        return robot.includes("GIZMO") && robot.includes("TOOL") && shapes.length > 0
            && robot.every(name => nodes[name]) && shapes.every(isBuilt) && performance.now();
    }""".replace("GIZMO", GIZMO).replace("TOOL", TOOL),
    "robot drawn": """() => {
        const render = window.__viserTestpoints.rendererInfo.render;
        window.__frameBefore ??= render.frame;
        return render.frame > window.__frameBefore && render.triangles > 0 && performance.now();
    }""",
}
"""Stage -> script that gives the milliseconds since the link was followed, once the stage is reached."""


@dataclass(frozen=True)
class Options:
    """Measure how long the server and the page take to start."""

    robot: str = "par4"
    """Robot to start with."""
    runs: int = 5
    """Repetitions; every page is a fresh visitor's."""
    json: Path | None = None
    """File to write all times to."""


def server_times(options: Options) -> list[float]:
    """Seconds from the start of the process to the first answer."""
    times = []
    for _ in range(options.runs):
        with running_deltalab("--robot", options.robot) as server:
            times.append(server.listened_after)
    return times


def page_times(browser: Browser, url: str) -> dict[str, float]:
    """Seconds from following the link to each stage, for one visitor; the robot is then really dragged."""
    page = new_page(browser, DESKTOP)
    page.goto(url, wait_until="commit")
    times = {stage: _reached(page, script) for stage, script in _STAGES.items()}
    before = node_pose(page, TOOL)
    drag_gizmo(page, GIZMO)
    wait_until(page, lambda: node_pose(page, TOOL) != before, "robot that follows its gizmo")
    page.context.close()
    return times


def _reached(page: Page, script: str) -> float:
    return 1e-3 * page.wait_for_function(script, polling=POLL_MS, timeout=60e3).json_value()


def main(options: Options) -> None:
    times: dict[str, list[float]] = {"server listens": server_times(options)}
    with sync_playwright() as playwright, running_deltalab("--robot", options.robot) as server:
        browser = launch(playwright)
        for _ in range(options.runs):
            for stage, seconds in page_times(browser, server.url).items():
                times.setdefault(stage, []).append(seconds)
        browser.close()
    print("| stage | median s | worst s |\n|--|--:|--:|")
    for stage, seconds in times.items():
        print(f"| {stage} | {statistics.median(seconds):.2f} | {max(seconds):.2f} |")
    if options.json:
        options.json.write_text(json.dumps(times, indent=2))


if __name__ == "__main__":
    main(tyro.cli(Options, description=__doc__))
