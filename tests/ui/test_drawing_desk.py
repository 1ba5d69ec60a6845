"""The drawing desk without a page: what is drawn, refused, planned, improved and saved."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import cv2
import numpy as np
import pytest

from app.drawing.compose import Look
from app.drawing.order import pen_up_s
from app.drawing.samples import SAMPLES, sample_bytes
from app.drawing.source import read_source
from app.drawing.svg_import import read_svg
from app.drawing.toolpath import Placement, default_placement
from app.ui.compute import Worker
from app.ui.drawing import jobs
from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.jobs import Plan, Sketch, TooDense
from app.ui.drawing.settings import default_settings, lies_flat, resized, turned, with_mode, with_preset
from app.ui.refusal import Refusal
from app.ui.series import Series
from app.ui.session import Session
from app.ui.state import Memory

SMALL = Look(mode="centreline", sheet_mm=(105.0, 148.0))


def noise(side: int) -> bytes:
    grey = np.random.default_rng(3).integers(0, 256, (side, side), dtype=np.uint8)
    return cv2.imencode(".png", grey)[1].tobytes()


def with_desk(scene: Callable[[DrawingDesk, Session], Awaitable[None]], memory: Memory | None = None) -> list[str]:
    """Play a scene on an event loop; returns what the workers complained of."""
    told: list[str] = []

    async def play() -> None:
        with ThreadPoolExecutor(2) as pool:
            session = Session(memory or Memory("delta3"))
            workers = [Worker(pool, told.append) for _ in range(4)]
            await scene(DrawingDesk(session, *workers), session)
            for worker in workers:
                worker.cancel()

    asyncio.run(play())
    return told


async def until(condition: Callable[[], object], what: str) -> None:
    for _ in range(3000):
        if condition():
            return
        await asyncio.sleep(0.01)
    raise AssertionError(f"no {what}")


async def opened(desk: DrawingDesk, name: str = "robot") -> Sketch:
    desk.settled = lambda: False  # no other order under our feet
    desk.choose_sheet("A6", False)
    desk.choose_mode("centreline")
    desk.take_sample(name)
    await until(lambda: desk.plan is not None and desk.source_name == name, "plan")
    assert desk.sketch is not None
    return desk.sketch


def test_settings_are_changed_where_they_live():
    settings = default_settings(Session(Memory("delta3")).robot)
    assert turned(settings, strong=0.03, margin_mm=5.0).look == replace(
        settings.look, margin_mm=5.0, parameters={"strong": 0.03}
    )
    flat = resized(settings, "A4", True)
    assert flat.look.sheet_mm == flat.sheet_mm == (297.0, 210.0)
    quick = with_preset(settings, "quick")
    assert quick.look.mode == "sketch" and quick.look.parameters["shortest_mm"] == 6.0
    assert with_mode(quick, "canny").look.parameters == {}, "a mode begins with its own values"


def test_a_sample_is_drawn_planned_and_fits_its_numbers():
    async def scene(desk: DrawingDesk, session: Session) -> None:
        drawn = await opened(desk)
        assert drawn.mode == "centreline" and drawn.is_reachable and desk.refusal is None
        assert desk.plan is not None and desk.plan.track.duration_s == desk.plan.time_s
        assert desk.plan.track.done[-1] == len(drawn.strokes)
        assert cv2.imdecode(np.frombuffer(drawn.preview, np.uint8), cv2.IMREAD_COLOR) is not None
        assert session.memory.drawing is not None and session.memory.drawing.source is desk.source

    assert not with_desk(scene)


def test_what_cannot_be_read_or_drawn_leaves_the_drawing():
    async def scene(desk: DrawingDesk, _: Session) -> None:
        drawn, said = await opened(desk), []
        desk.refused.connect(said.append)
        desk.take_file("white.png", cv2.imencode(".png", np.full((50, 50), 255, np.uint8))[1].tobytes())
        await until(lambda: len(said) == 1, "refusal of white paper")
        desk.take_file("letter.png", b"Dear robot")
        await until(lambda: len(said) == 2, "refusal of a letter")
        assert all(isinstance(one, Refusal) and one.reason.endswith(".") for one in said)
        assert desk.sketch is drawn and desk.plan is not None
        desk.take_sample("logo")
        await until(lambda: desk.sketch is not drawn, "another drawing")
        assert desk.refusal is None and said[-1] is None, "all is well again"

    assert not with_desk(scene)


def test_a_dense_picture_offers_settings_that_help():
    async def scene(desk: DrawingDesk, _: Session) -> None:
        drawn = await opened(desk)
        desk.choose_mode("outline")
        desk.take_file("noise.png", noise(1000))
        await until(lambda: isinstance(desk.refusal, TooDense), "refusal")
        before = desk.sketch
        desk.draw_coarser()
        await until(lambda: desk.sketch is not before and desk.refusal is None, "a coarser drawing")
        assert desk.sketch is not None and desk.sketch is not drawn and len(desk.sketch.strokes) <= 10_000

    assert not with_desk(scene)


def test_a_sheet_out_of_reach_is_refused_with_the_reason_before_anything_moves():
    async def scene(desk: DrawingDesk, session: Session) -> None:
        await opened(desk)
        pose = session.stance.pose
        desk.move_sheet(Placement(-0.34, (0.25, 0.0)))
        await until(lambda: desk.refusal is not None, "refusal")
        assert desk.plan is None and desk.sketch is not None and not desk.sketch.is_reachable
        assert isinstance(desk.refusal, Refusal) and "beyond the robot" in desk.refusal.reason
        assert session.stance.pose == pose
        desk.move_sheet(None)
        await until(lambda: desk.plan is not None, "plan where there is room")
        assert desk.sketch.is_reachable and desk.refusal is None

    assert not with_desk(scene)


def test_the_sheet_can_be_dragged_over_the_edge_and_tells_what_would_be_lost():
    async def scene(desk: DrawingDesk, _: Session) -> None:
        drawn, masks = await opened(desk), []
        desk.moved.connect(masks.append)
        desk.move_sheet(Placement(-0.34, (0.26, 0.0)), finished=False)
        await until(lambda: masks, "masks")
        assert [len(mask) for mask in masks[0]] == [len(stroke) for stroke in drawn.strokes]
        assert any(mask.any() for mask in masks[0]) and desk.sketch is drawn

    assert not with_desk(scene)


def test_another_robot_gets_the_drawing_where_it_has_room():
    async def scene(desk: DrawingDesk, session: Session) -> None:
        drawn = await opened(desk)
        desk.move_sheet(Placement(-0.35, (0.02, 0.0)))
        session.choose_robot("fivebar")
        await until(
            lambda: desk.plan and desk.sketch and desk.sketch.setup.robot == "fivebar", "plan for another robot"
        )
        assert desk.sketch is not None and desk.settings.placement is None
        assert desk.settings.pen.lift_mm == 2.0, "its screws are slow"
        assert all(np.array_equal(a, b) for a, b in zip(drawn.strokes, desk.sketch.strokes, strict=True))

    assert not with_desk(scene)


def test_a_better_order_replaces_the_first_unless_the_robot_draws():
    async def scene(desk: DrawingDesk, _: Session) -> None:
        drawn = await opened(desk, "mandala")
        await until(lambda: not desk.improving, "rest")
        assert desk.sketch is drawn, "the robot was drawing"
        first = desk.plan
        desk.settled = lambda: True
        desk.set_pen(up_speed_mm_s=290.0)
        await until(lambda: desk.plan is not None and not desk.improving, "rest")
        assert first is not None and desk.plan is not None and desk.sketch is not None
        assert pen_up_s(desk.sketch.strokes) <= pen_up_s(drawn.strokes) + 1e-9
        ends = sorted(len(stroke) for stroke in desk.sketch.strokes)
        assert sum(ends) == sum(len(stroke) for stroke in drawn.strokes) or len(ends) < len(drawn.strokes)

    assert not with_desk(scene)


def test_a_visit_later_finds_the_picture_and_its_settings():
    kept: list[Memory] = []

    async def first(desk: DrawingDesk, session: Session) -> None:
        await opened(desk, "logo")
        desk.turn(scale=0.5)
        kept.append(session.memory)

    async def second(desk: DrawingDesk, _: Session) -> None:
        desk.open()
        await until(lambda: desk.sketch is not None, "drawing")
        assert desk.source_name == "logo" and desk.settings.look.scale == 0.5

    with_desk(first)
    with_desk(second, kept[0])


@pytest.mark.parametrize("suffix", [".svg", ".gcode", ".csv", ".txt", ".dxf", ".png", "timed.csv"])
def test_what_is_saved_is_what_is_shown(suffix: str):
    setup = setup_for("delta3")
    drawn = jobs.sketch(read_source("robot.png", sample_bytes("robot")), SMALL, setup)
    assert isinstance(drawn, Sketch)
    content = jobs.export(drawn, suffix, {})
    assert isinstance(content, bytes) and content
    if suffix == ".svg":
        for read, shown in zip(read_svg(content), drawn.strokes, strict=True):
            assert read == pytest.approx(shown, abs=1e-3)
    if suffix == "timed.csv":
        planned = jobs.plan(drawn.strokes, setup)
        assert isinstance(planned, Plan)
        assert float(content.splitlines()[-1].split(b",")[0]) == pytest.approx(planned.time_s, abs=1e-6)


def setup_for(robot: str) -> jobs.Setup:
    session = Session(Memory(robot))
    settings = default_settings(session.robot)
    return jobs.Setup(robot, {}, default_placement(session.robot), settings.pen)


def test_the_estimate_is_what_is_played():
    setup = setup_for("delta3")
    drawn = jobs.sketch(read_source("cat.jpg", sample_bytes("cat")), Look(sheet_mm=(148.0, 105.0)), setup)
    assert isinstance(drawn, Sketch)
    planned = jobs.plan(drawn.strokes, setup)
    assert isinstance(planned, Plan)
    path = planned.track
    assert path.t[-1] == planned.time_s and (np.diff(path.t) > 0).all()
    for stroke in (0, len(drawn.strokes) - 1):
        length = np.linalg.norm(np.diff(drawn.strokes[stroke], axis=0), axis=1).sum()
        assert path.along_mm[path.stroke == stroke].max() == pytest.approx(length, abs=1.0)


def test_pictures_choose_the_sheets_direction():
    flat = {name: lies_flat(read_source(name, sample_bytes(name))) for name in ("cat", "bicycle")}
    assert flat == {"cat": True, "bicycle": None}
    assert set(SAMPLES) >= set(flat)


def test_a_series_runs_in_order_and_can_be_cancelled():
    async def scene(desk: DrawingDesk, _: Session) -> None:
        with ThreadPoolExecutor(1) as pool:
            series, got, shares = Series(Worker(pool, print)), [], []
            series.progressed.connect(shares.append)
            series.start([(pow, (2, k)) for k in range(4)], got.append)
            await until(lambda: not series.busy, "end")
            assert got == [1, 2, 4, 8] and shares == sorted(shares) and shares[-1] == 1.0
            series.start([(pow, (3, k)) for k in range(1000)], got.append)
            series.cancel()
            await asyncio.sleep(0.05)
            assert got == [1, 2, 4, 8] and not series.busy

    with_desk(scene)


def test_a_visit_later_with_another_robot_lays_the_sheet_anew():
    kept: list[Memory] = []

    async def first(desk: DrawingDesk, session: Session) -> None:
        await opened(desk, "logo")
        desk.move_sheet(Placement(-0.36, (0.03, 0.0)))
        desk.take_text("Hola")
        await until(lambda: desk.source_name == "text", "text")
        kept.append(session.memory)

    async def second(desk: DrawingDesk, _: Session) -> None:
        assert desk.settings.placement is None and desk.settings.pen.lift_mm == 2.0
        assert desk.text == "Hola"

    with_desk(first)
    with_desk(second, replace(kept[0], robot="fivebar", pose=None))
