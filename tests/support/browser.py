"""Chromium on a viser page: open it, read what three.js draws, drag gizmos, take pictures.

viser's production page exposes `__viserMutable` and `__viserSceneTree`. Poses are read from the matrices of
three.js, since a gizmo never updates its position, and the scene tree not its poses.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, CDPSession, Page, Playwright, ViewportSize

CHROMIUM = Path("/usr/bin/chromium")
ARTIFACTS = Path(__file__).parents[1] / "artifacts"
FLAGS = [
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
]
SKETCHY = ("--webgl-antialiasing-mode=none",)
"""Flags for tests that read poses rather than pixels: their frames cost less."""
SHARPNESS = 0.3
"""Pixels of the scene for a pixel of the page: without a graphics processor, all of them cost half a second a frame."""
READY_TIMEOUT = 60.0
SETTLE = 0.5
"""Seconds until what was just asked for is on the screen."""
GRIP = 0.75
"""Where along its arrow a gizmo is taken hold of."""
RING = 0.65
"""Radius of a gizmo's ring, relative to its scale."""

SLOW_SCREEN = """{
  const request = window.requestAnimationFrame.bind(window), cancel = window.cancelAnimationFrame.bind(window);
  const turn = new WeakMap();
  window.requestAnimationFrame = (draw) => {
    const frame = (time) => { turn.set(draw, performance.now() + 250); draw(time); };
    const wait = window.deltalabInHand ? 0 : (turn.get(draw) ?? 0) - performance.now();
    return wait > 0 ? -setTimeout(() => frame(performance.now()), wait) : request(frame);
  };
  window.cancelAnimationFrame = (id) => id < 0 ? clearTimeout(-id) : cancel(id);
}"""
"""Script of a page that paints its scene four times a second, not as often as the processor can, and leaves time to
others. Only what asks again and again has to wait, and nothing while a gizmo is in hand."""

_READY = """(nodes) => {
  const page = window.__viserMutable, tree = window.__viserSceneTree;
  if (!page || !tree || !page.canvas || !page.camera || !page.cameraControl) return false;
  if (page.messageQueue.length) return false;
  const known = tree.getState();
  return nodes.every(name => name in known && page.nodeRefFromName[name]);
}"""
_POSE = """(name) => {
  const node = window.__viserMutable.nodeRefFromName[name];
  if (!node) return null;
  if (node.matrixAutoUpdate) node.updateMatrix();
  const p = node.position.clone(), q = node.quaternion.clone(), s = node.scale.clone();
  node.matrix.decompose(p, q, s);
  return {position: p.toArray(), wxyz: [q.w, q.x, q.y, q.z]};
}"""
_PROJECT = """([name, offset]) => {
  const page = window.__viserMutable, node = page.nodeRefFromName[name];
  if (!node) return null;
  node.updateWorldMatrix(true, false);
  const point = page.camera.position.clone().set(...offset);
  point.applyMatrix4(node.matrixWorld).project(page.camera);
  const box = page.canvas.getBoundingClientRect();
  return [box.left + (point.x + 1) / 2 * box.width, box.top + (1 - point.y) / 2 * box.height];
}"""


@dataclass(frozen=True)
class Screen:
    """What a page is looked at on."""

    width: int
    height: int
    touch: bool = False

    @property
    def viewport(self) -> ViewportSize:
        return {"width": self.width, "height": self.height}


DESKTOP = Screen(1440, 900)
LAPTOP = Screen(1280, 720)
TABLET = Screen(820, 1180, touch=True)
PHONE = Screen(390, 844, touch=True)


@dataclass(frozen=True)
class Pose:
    """A node's pose relative to its parent: metres, unit quaternion."""

    position: tuple[float, float, float]
    wxyz: tuple[float, float, float, float]


def launch(playwright: Playwright, flags: Sequence[str] = ()) -> Browser:
    """Chromium with WebGL drawn in software."""
    return playwright.chromium.launch(executable_path=CHROMIUM, args=[*FLAGS, *flags])


def new_page(browser: Browser, screen: Screen = DESKTOP) -> Page:
    """A page of a fresh visitor: no cookie, nothing shared with other pages."""
    context = browser.new_context(viewport=screen.viewport, has_touch=screen.touch, is_mobile=screen.touch)
    return context.new_page()


def open_page(
    page: Page,
    url: str,
    nodes: Sequence[str] = (),
    timeout: float = READY_TIMEOUT,
    sharpness: float | None = SHARPNESS,
) -> None:
    """Go to `url` and wait until everything sent was applied and `nodes` are in the scene.

    Without `sharpness` the address is the one that a student opens, and the page chooses by itself.
    """
    page.goto(url if sharpness is None else f"{url}/?fixedDpr={sharpness}", wait_until="domcontentloaded")
    wait_ready(page, nodes, timeout)


def wait_ready(page: Page, nodes: Sequence[str] = (), timeout: float = READY_TIMEOUT) -> None:
    """Wait until no message is queued and `nodes` are in the scene."""
    page.wait_for_function(_READY, arg=list(nodes), timeout=1e3 * timeout)


def wait_until(page: Page, condition: Callable[[], Any], what: str, timeout: float = 30.0) -> Any:
    """Poll `condition` until it is true, keeping the page alive meanwhile; returns its value."""
    for _ in range(math.ceil(timeout / 0.05)):
        if value := condition():
            return value
        page.wait_for_timeout(50)
    raise AssertionError(f"no {what} within {timeout:g} s")


def node_pose(page: Page, name: str) -> Pose | None:
    """The pose that three.js renders, or None where there is no such node."""
    pose = page.evaluate(_POSE, name)
    return pose and Pose(tuple(pose["position"]), tuple(pose["wxyz"]))


def project(page: Page, name: str, offset: Sequence[float] = (0.0, 0.0, 0.0)) -> tuple[float, float]:
    """Pixel on the page of a point of node `name`, `offset` in the node's frame, metres."""
    pixel = page.evaluate(_PROJECT, [name, list(offset)])
    if pixel is None:
        raise LookupError(f"the scene has no node {name}")
    return pixel[0], pixel[1]


def drag_gizmo(
    page: Page,
    name: str,
    axis: Sequence[float] = (0.0, 0.0, 1.0),
    *,
    pixels: float = 60.0,
    touch: bool = False,
    steps: int = 12,
) -> None:
    """Drag a translation arrow `pixels` along its direction on the screen, with the mouse or a finger.

    `axis` is the arrow's direction in the gizmo's frame; negative pixels drag against it.
    """
    wait_ready(page, [name])
    grip = GRIP * gizmo_scale(page, name)
    centre, start = project(page, name), project(page, name, [grip * component for component in axis])
    length = math.dist(start, centre)
    assert length > 4, "the arrow points at the camera"
    stride = [pixels * (s - c) / length / steps for s, c in zip(start, centre, strict=True)]
    _drag(page, [(start[0] + stride[0] * k, start[1] + stride[1] * k) for k in range(steps + 1)], touch)


def wait_still(page: Page, gizmo: str) -> None:
    """Wait until nothing is on its way and the camera rests: a drag aims at where the gizmo is on the screen."""
    for _ in range(40):
        wait_ready(page, [gizmo])
        before = project(page, gizmo)
        page.wait_for_timeout(500)
        if math.dist(before, project(page, gizmo)) < 0.5:
            return
    raise AssertionError("the picture never came to rest")


def pull_gizmo(
    page: Page,
    name: str,
    moved: Callable[[], bool],
    axis: Sequence[float] = (0.0, 0.0, 1.0),
    *,
    pixels: float = 60.0,
    touch: bool = False,
) -> None:
    """Drag an arrow until something has moved. On a machine that draws few frames a first grip can miss."""
    for _ in range(3):
        wait_still(page, name)
        drag_gizmo(page, name, axis=axis, pixels=pixels, touch=touch, steps=16)
        for _ in range(20):
            if moved():
                return
            page.wait_for_timeout(250)
    raise AssertionError(f"nothing followed {name}")


def turn_gizmo(page: Page, name: str, degrees: float, *, touch: bool = False, steps: int = 12) -> None:
    """Drag the ring about z; it is a quarter of a circle from x to y.

    From a low camera a pixel is many degrees: expect the direction then, and the angle only roughly.
    """
    wait_ready(page, [name])
    radius = RING * gizmo_scale(page, name)
    angles = [math.radians(45 + degrees * k / steps) for k in range(steps + 1)]
    _drag(page, [project(page, name, [radius * math.cos(a), radius * math.sin(a), 0.0]) for a in angles], touch)


def gizmo_scale(page: Page, name: str) -> float:
    """Length of a gizmo's arrows, metres."""
    return page.evaluate("name => window.__viserSceneTree.getState()[name].message.props.scale", name)


def _drag(page: Page, path: Sequence[tuple[float, float]], touch: bool) -> None:
    page.evaluate("window.deltalabInHand = true")
    (_drag_with_finger if touch else _drag_with_mouse)(page, path)
    page.evaluate("window.deltalabInHand = false")


def _drag_with_mouse(page: Page, path: Sequence[tuple[float, float]]) -> None:
    page.mouse.move(*path[0])
    page.wait_for_timeout(150)
    page.mouse.down()
    for point in path[1:]:
        page.mouse.move(*point)
        page.wait_for_timeout(30)
    page.wait_for_timeout(80)
    page.mouse.up()


def _drag_with_finger(page: Page, path: Sequence[tuple[float, float]]) -> None:
    session: CDPSession = page.context.new_cdp_session(page)
    _touch(session, "touchStart", path[0])
    page.wait_for_timeout(150)
    for point in path[1:]:
        _touch(session, "touchMove", point)
        page.wait_for_timeout(30)
    page.wait_for_timeout(80)
    _touch(session, "touchEnd")
    session.detach()


def _touch(session: CDPSession, kind: str, *fingers: tuple[float, float]) -> None:
    points = [{"x": x, "y": y} for x, y in fingers]
    session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})


def screenshot(page: Page, name: str, settle: float = SETTLE) -> Path:
    """Picture of the page in `tests/artifacts/NAME.png`."""
    ARTIFACTS.mkdir(exist_ok=True)
    page.wait_for_timeout(1e3 * settle)
    path = ARTIFACTS / f"{name}.png"
    page.screenshot(path=path)
    return path


PageFactory = Callable[..., Page]
"""`make(PHONE)` brings one more visitor."""
