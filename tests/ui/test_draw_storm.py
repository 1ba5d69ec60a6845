"""What students who click quickly, and messages that no page sends, do to the tab Draw: it stays in order."""

from __future__ import annotations

import asyncio
import random
from collections.abc import Iterator

import numpy as np
import pytest

from app.drawing.modes import DRAWING_MODES, PRESETS
from app.drawing.samples import sample_bytes
from app.drawing.svg_import import read_svg
from tests.support.draw_visitor import Visitor, on_page, visitor
from tests.support.server import RunningServer, running_deltalab
from tests.support.taps import MARK, tap
from tests.support.wire import run_async

GIZMO, TOOL, HANDLE, SHEET = "/robot/gizmo", "/robot/tool", "/robot/sheet_handle", "/robot/sheet"
pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def server() -> Iterator[RunningServer]:
    """It must print no traceback: leaving it looks for one."""
    with running_deltalab("--no-shadows", "--robot", "delta3") as running:
        yield running


def test_a_knob_that_was_reset_still_takes_fractions(server: RunningServer):
    async def play(one: Visitor) -> None:
        await one.set("Mode", DRAWING_MODES["canny"].title)
        await one.until(lambda: one.cell("Mode") == DRAWING_MODES["canny"].title, "edges")
        first = one.cell("Ink")
        await one.set("Gamma", 2.45)
        await one.until(lambda: one.cell("Ink") != first, "another drawing")
        other = one.cell("Ink")
        await one.press("Reset these")
        await one.until(lambda: one.cell("Ink") == first, "the first drawing")
        await one.set("Gamma", 2.45)
        await one.until(lambda: one.cell("Ink") == other, "the other one again", 10.0)

    on_page(server, play)


def test_a_text_without_letters_can_be_mended(server: RunningServer):
    async def play(one: Visitor) -> None:
        await one.set("Text", "  ")
        await one.until(lambda: "no letter to draw" in one.said, "refusal")
        await one.set("Picture", "A text")
        await one.new_picture(one.set("Pen width (mm)", 0.8))
        assert one.client.value_of("Picture") == "A text" and one.props("Text")["visible"]
        await one.set("Text", "Hi")
        await one.until(lambda: one.cell("Mode") == "Strokes as they are", "letters")
        assert "no letter to draw" not in one.said

    on_page(server, play)


def test_a_file_is_taken_for_nothing_else_whatever_its_name(server: RunningServer):
    async def play(one: Visitor) -> None:
        for name in ("cat", "Cat", "text", "A text", "hand", "Draw by hand"):
            await one.set("Picture", "Draw by hand")
            await one.upload(name, sample_bytes("logo"))
            await one.until(lambda: one.client.value_of("Picture") == f"{name} (file)", f"{name} in the list")  # noqa: B023
            assert not one.props("Text")["visible"]

    on_page(server, play)


def test_what_cannot_be_coarser_is_not_offered(server: RunningServer):
    lines = "".join(f'<path d="M{k % 200} {k // 200}h.5"/>' for k in range(10_500))

    async def play(one: Visitor) -> None:
        await one.upload("dense.svg", f'<svg xmlns="http://www.w3.org/2000/svg">{lines}</svg>'.encode())
        await one.until(lambda: "simplify it in the program" in one.said, "refusal")
        assert not one.props("Draw it coarser")["visible"] and "The last drawing stays" in one.said

    on_page(server, play)


def test_a_sweep_keeps_its_name(server: RunningServer):
    async def play(one: Visitor) -> None:
        await one.set("Sweep", "Scale")
        await one.press("Sweep it")
        await one.set("Sweep", "Drawing speed (mm/s)")
        await one.until(lambda: ">similarity<" in one.said, "first drawing of the sweep")
        assert ">Scale</th>" in one.said
        await one.press("Cancel")
        await one.until(lambda: not one.props("Cancel")["visible"], "end of the sweep")

    on_page(server, play)


def test_the_robots_handles_come_back_when_the_sheet_is_put_away(server: RunningServer):
    async def play(one: Visitor) -> None:
        await one.set("Move the sheet", True)
        await one.until(lambda: one.visible.get(GIZMO) is False, "hidden handles")
        await one.client.set_value("Control opened", True)
        await one.until(lambda: one.visible[GIZMO] and not one.visible[SHEET], "robot's handles, and no sheet")
        await one.client.set_value("Draw opened", False)
        await one.until(lambda: one.visible[SHEET] and not one.visible[GIZMO], "sheet with its own handles")

    on_page(server, play)


def test_a_sheet_held_still_stays_when_a_better_order_is_found(server: RunningServer):
    async def play(one: Visitor) -> None:
        client, z = one.client, one.client.positions[SHEET][2]
        await one.set("Move the sheet", True)
        await one.set("Mode", DRAWING_MODES["sketch"].title)
        await one.until(lambda: not one.can_draw, "another drawing")
        await one.until(lambda: one.can_draw, "its plan")
        await client.start_drag(HANDLE)
        await one.new_picture(client.drag(HANDLE, (0.01, 0.0, z)))
        await client.end_drag(HANDLE)
        await one.until(lambda: not one.can_draw, "plan for this place")
        await one.until(lambda: one.can_draw, "plan for this place")
        assert client.value_of("Sheet x (mm)") == 10.0 and client.positions[SHEET][0] == pytest.approx(0.01)

    on_page(server, play)


def test_why_the_robot_cannot_draw_stays_in_sight(server: RunningServer):
    async def play(one: Visitor) -> None:
        await one.set("Sheet x (mm)", 400.0)
        await one.until(lambda: "is beyond the robot" in one.said, "refusal")
        await one.upload("letter.png", b"Dear robot")
        await one.until(lambda: "This is text" in one.said, "refusal of the file")
        assert "is beyond the robot" in one.said and not one.can_draw

    on_page(server, play)


def test_the_answer_about_the_arm_follows_the_drawing(server: RunningServer):
    async def play(one: Visitor) -> None:
        await one.press("Compare with the arm")
        await one.until(lambda: "Assumed:" in one.said, "answer")
        await one.set("Sheet x (mm)", 400.0)
        await one.until(lambda: "Assumed:" not in one.said and "Drawing delta: Out of reach" in one.said, "another one")

    on_page(server, play)


TAPS = 75
"""Of each of two students."""


async def storm(one: Visitor, seed: int) -> None:
    rng = random.Random(seed)
    for _ in range(TAPS):
        await tap(one, rng)
        await asyncio.sleep(rng.choice((0.0, 0.01, 0.1)))


async def comes_to_rest(one: Visitor) -> None:
    """The drawing can be drawn or it is said why not; its numbers are those of the file; the robot is its own."""
    if one.props("Cancel")["visible"]:
        await one.press("Cancel")
    await one.until(lambda: one.settled, "plan or reason", 90.0)
    numbers = ""
    while numbers != (numbers := one.cell("Ink") + one.cell("Strokes")):
        strokes = read_svg(await one.saved_svg())  # until no better order comes between
    assert int(one.cell("Strokes")) == len(strokes)
    ink_mm = sum(float(np.linalg.norm(np.diff(stroke, axis=0), axis=1).sum()) for stroke in strokes)
    assert MARK not in one.said, "nothing that was typed or uploaded is markup"
    assert millimetres(one.cell("Ink")) == pytest.approx(ink_mm, rel=0.01, abs=1.0)


def millimetres(length: str) -> float:
    number, unit = length.split()
    return float(number) * {"mm": 1.0, "m": 1e3}[unit]


async def draws(one: Visitor) -> None:
    """What every robot can draw, it begins to draw."""
    for button in ("Reset geometry", "Put the sheet back"):
        await one.press(button)
    easy = {
        "Picture": "Logo",
        "Size": "A6",
        "Margin (mm)": 10.0,
        "Laser": False,
        "Lift the pen": True,
        "Lift (mm)": 1.0,
    }
    for label, value in easy.items():
        await one.set(label, value)
    await one.set("Start from", PRESETS["line_art"].title)
    await one.until(lambda: one.cell("Mode") == "Centre lines" and one.can_draw, "an easy drawing", 60.0)
    await one.press("Stop and go home")
    start = one.client.positions[TOOL]
    await one.client.send("GuiUpdateMessage", uuid=one.go, updates={"value": True})
    await one.until(lambda: one.client.positions[TOOL] != start, "a robot that moves")


def test_two_students_click_about_and_all_is_in_order_afterwards(server: RunningServer):
    async def scene() -> None:
        async with visitor(server) as one, visitor(server) as two:
            await asyncio.gather(storm(one, 1), storm(two, 2))
            for each in (one, two):
                await comes_to_rest(each)
                await draws(each)

    run_async(scene())
