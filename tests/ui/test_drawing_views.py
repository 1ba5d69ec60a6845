"""The drawing in 3-D: which ink is there at which moment, how little of it is sent, and where the sheet lies."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import pytest

from app.drawing.toolpath import Placement, default_placement
from app.robots import ROBOTS, build_robot
from app.robots.parts import machine_of
from app.ui import theme
from app.ui.drawing.ink import Array, lay_ink, parts
from app.ui.drawing.ink_view import InkView
from app.ui.drawing.sheet_view import SheetView, plan_lines
from app.ui.gizmo import Gizmo
from app.ui.session import Session
from app.ui.state import Memory
from app.ui.viser_adapter import NodeStream
from tests.support.small_lab import SmallLab, eventually, guarded_lab
from tests.support.wire import WireClient, note, run_async

INK = "/robot/sheet/ink/"
HANDLE = "/robot/sheet_handle"

L_SHAPE: Array = np.array([[0.0, 0.0], [0.03, 0.0], [0.03, 0.04]])
SQUARE: Array = np.array([[0.1, 0.0], [0.2, 0.0], [0.2, 0.1], [0.1, 0.1], [0.1, 0.0]])
DOT: Array = np.array([[0.3, 0.3], [0.3, 0.3]])


@pytest.fixture
def lab() -> Iterator[SmallLab]:
    with guarded_lab() as lab:
        yield lab


def drawn_length(segments: np.ndarray) -> float:
    return float(np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).sum())


@pytest.mark.parametrize(
    ("moment", "length", "end"),
    [
        ((-1, 0.0, 0), 0.0, None),
        ((0, 0.01, 0), 0.01, (0.01, 0.0)),
        ((0, 0.03, 0), 0.03, (0.03, 0.0)),
        ((0, 0.05, 0), 0.05, (0.03, 0.02)),
        ((0, 0.08, 0), 0.07, (0.03, 0.04)),
        ((-1, 0.0, 1), 0.07, (0.03, 0.04)),
        ((1, 0.25, 1), 0.32, (0.15, 0.1)),
        ((2, 0.0, 2), 0.47, (0.3, 0.3)),
        ((-1, 0.0, 3), 0.47, (0.3, 0.3)),
    ],
)
def test_the_ink_ends_where_the_pen_is(
    moment: tuple[int, float, int], length: float, end: tuple[float, float] | None
) -> None:
    ink = lay_ink([L_SHAPE, SQUARE, DOT], 0.001, stray=False)
    begun, share = ink.extent(*moment)
    segments, stray = ink.cut(0, begun, share)
    assert drawn_length(segments) == pytest.approx(length, abs=2e-5)
    assert not stray.any()
    if end is not None:
        assert segments[-1, 1] == pytest.approx((*end, 0.001), abs=2e-5)


def test_a_dot_has_a_direction() -> None:
    """A segment of no length is not drawn at all."""
    ink = lay_ink([DOT], 0.0, stray=False)
    assert drawn_length(ink.segments) > 0.0


def test_without_a_lift_the_ways_between_are_marked() -> None:
    ink = lay_ink([L_SHAPE, SQUARE, DOT], 0.0, stray=True)
    assert ink.segments[ink.stray][:, :, :2] == pytest.approx(
        np.array([[[0.03, 0.04], [0.1, 0.0]], [[0.1, 0.0], [0.3, 0.3]]])
    )
    assert ink.extent(-1, 0.0, 1)[0] == 2, "the way to the next stroke is drawn when that begins"
    begun, share = ink.extent(1, 0.05, 1)
    segments, stray = ink.cut(0, begun, share)
    assert stray.tolist() == [False, False, True, False]
    assert segments[-1, 1, :2] == pytest.approx((0.15, 0.0))


def test_lengths_counted_otherwise_end_at_the_same_place() -> None:
    """A robot rounds corners: what it counts is shorter, and must not add up to a lag."""
    zigzag = np.zeros((2001, 2))
    zigzag[:, 0], zigzag[1::2, 1] = np.linspace(0.0, 0.1, 2001), 5e-4
    own = drawn_length(lay_ink([zigzag], 0.0, stray=False).segments)
    ink = lay_ink([zigzag], 0.0, stray=False, lengths_m=np.array([0.9 * own]))
    begun, share = ink.extent(0, 0.45 * own, 0)
    assert ink.cut(0, begun, share)[0][-1, 1, 0] == pytest.approx(0.05, abs=1e-4)
    assert ink.extent(0, 0.9 * own, 0) == (2000, pytest.approx(1.0))


@pytest.mark.parametrize("count", [0, 49, 50, 399, 400, 401, 449, 1234, 20000])
def test_parts_are_whole_and_leave_little_to_the_tip(count: int) -> None:
    found = parts(count)
    assert [start for start, _ in found] == [0, *(stop for _, stop in found)][: len(found)]
    assert 0 <= count - (found[-1][1] if found else 0) < 50
    assert sum(stop - start < 400 for start, stop in found) < 8
    later = parts(count + 400)
    assert {part for part in found if part[1] - part[0] == 400} <= set(later), "large parts stay as they are"


class Paper:
    """What one client sees of the ink, rebuilt from the wire."""

    def __init__(self, client: WireClient) -> None:
        self.made: list[str] = []
        self.sent = 0
        self._nodes: dict[str, dict[str, Any]] = {}
        self._hidden: set[str] = set()
        client.listeners.append(lambda message, _: self._take(message))

    def segments(self) -> np.ndarray:
        """(n, 2, 3) shown, in the order in which they are drawn."""
        shown = [name for name in self._nodes if name not in self._hidden]
        order = sorted(
            shown, key=lambda name: math.inf if name.endswith("tip") else int(name[len(INK) :].split("-")[0])
        )
        return np.concatenate([np.zeros((0, 2, 3)), *(self._nodes[name]["points"].reshape(-1, 2, 3) for name in order)])

    def colors(self) -> set[tuple[int, ...]]:
        return {tuple(rgb) for node in self._nodes.values() for rgb in node["colors"].reshape(-1, 3).tolist()}

    def _take(self, message: dict[str, Any]) -> None:
        name, kind = str(message.get("name")), message["type"]
        if not name.startswith(INK):
            return
        if kind == "LineSegmentsMessage":
            self.made.append(name)
            self._nodes[name] = dict(message["props"])
            self._hidden.discard(name)
            self.sent += message["props"]["points"].nbytes
        elif kind == "SceneNodeUpdateMessage":
            self._nodes[name] |= message["updates"]
            self.sent += sum(array.nbytes for array in message["updates"].values())
        elif kind == "SetSceneNodeVisibilityMessage":
            (self._hidden.discard if message["visible"] else self._hidden.add)(name)
        elif kind == "RemoveSceneNodeMessage":
            del self._nodes[name]


LONG = np.zeros((2001, 2))
LONG[:, 0] = np.linspace(0.0, 0.2, 2001)
"""2000 segments of 0.1 mm."""


async def settles(client: WireClient, paper: Paper, length: float) -> None:
    await client.wait_for(lambda: drawn_length(paper.segments()) == pytest.approx(length, abs=1e-6), f"{length} m")


def test_ink_grows_and_what_is_complete_is_sent_once(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            paper, view = Paper(client), InkView(lab.client_of(client).scene)
            view.load([LONG], 5e-4, stray=False)
            for along in np.arange(0.00095, 0.2, 0.0095):
                view.show(0, float(along), 0)
                await settles(client, paper, float(along))
            assert paper.segments()[-1, 1, 0] == pytest.approx(0.19095, abs=1e-6)
            assert len(paper.made) == len(set(paper.made)), "no part is made twice"
            assert paper.sent < 4 * 2000 * 24, "each segment a few times, not again with every growth"
            assert paper.colors() == {theme.INK}
            view.close()

    run_async(scene())


def test_ink_is_right_after_scrubbing_and_is_not_sent_again(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            paper, view = Paper(client), InkView(lab.client_of(client).scene)
            view.load([LONG, LONG + (0.0, 0.01)], 5e-4, stray=False)
            for moment, length in [
                ((1, 0.12344, 1), 0.32344),
                ((0, 0.05001, 0), 0.05001),
                ((-1, 0.0, 0), 0.0),
                ((-1, 0.0, 2), 0.4),
            ]:
                view.show(*moment)
                await settles(client, paper, length)
            before = paper.sent
            for moment, length in [((0, 0.1, 0), 0.1), ((-1, 0.0, 2), 0.4)]:
                view.show(*moment)
                await settles(client, paper, length)
            assert paper.sent - before < 0.05 * before, "large parts are only hidden and shown again"
            view.clear()
            await settles(client, paper, 0.0)
            view.show(-1, 0.0, 2)
            view.load([L_SHAPE, SQUARE], 5e-4, stray=True)
            view.show(-1, 0.0, 2)
            await settles(client, paper, 0.07 + math.hypot(0.07, 0.04) + 0.4)
            ways, lines = sorted(paper.colors(), reverse=True)
            assert shown(np.array(ways)) == pytest.approx(theme.MARK, abs=6)
            assert shown(np.array(lines)) == pytest.approx(theme.INK, abs=6), "dark tones are coarse"
            view.close()

    run_async(scene())


def test_growth_is_sent_ten_times_a_second_at_most(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            paper, view = Paper(client), InkView(lab.client_of(client).scene)
            updates = note(client, "SceneNodeUpdateMessage")
            view.load([LONG], 5e-4, stray=False)
            for step in range(1, 40):
                view.show(0, 1e-4 * step, 0)
            await settles(client, paper, 39e-4)
            assert len(updates) <= 2, "the first and the last of a burst"
            view.close()

    run_async(scene())


def test_no_ink_without_a_drawing(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            paper, view = Paper(client), InkView(lab.client_of(client).scene)
            view.show(0, 0.1, 0)
            view.load([L_SHAPE], 5e-4, stray=False)
            view.show(-1, 0.0, 1)
            await settles(client, paper, 0.07)
            assert len(paper.made) == 1

    run_async(scene())


async def lay_sheet(lab: SmallLab, client: WireClient, robot: str = "delta3") -> tuple[SheetView, Session]:
    session = Session(Memory(robot))
    view = SheetView(lab.client_of(client), session)
    await client.wait_for(lambda: HANDLE in client.nodes, "handle")
    return view, session


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_tools_drawn_tip_touches_the_paper(lab: SmallLab, robot: str) -> None:
    """The lowest point of all that the robot carries, standing at the paper's height, lies in the paper's plane."""

    async def scene() -> None:
        async with lab.visit() as client:
            view, session = await lay_sheet(lab, client, robot)
            placement = default_placement(session.robot)
            view.place(placement, (148.0, 210.0))
            await client.wait_for(lambda: "/robot/sheet" in client.positions, "sheet")
            pose = [*placement.centre_m, placement.height_m, *[0.0] * (session.robot.dof - 3)]
            assert client.positions["/robot/sheet"][2] == pytest.approx(lowest_tool_point(robot, pose), abs=2e-4)

    run_async(scene())


def lowest_tool_point(robot: str, pose: Sequence[float]) -> float:
    """z of the tool's drawn vertices near its axis, m."""
    machine = machine_of(build_robot(robot, {}))
    (_, _, z), _ = machine.tool_frame(pose)
    low = np.inf
    for body in machine.bodies:
        if body.frame in ("tool", "platform") and body.fixed is not None:
            for part in body.parts:
                low = min(low, float(part.arrays()[0][:, 2].min()) + float(body.fixed.positions[:, 2].min()))
    return z + low


def test_a_dragged_sheet_tells_where_it_is(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            view, session = await lay_sheet(lab, client)
            start = default_placement(session.robot)
            view.place(start, (148.0, 210.0))
            view.visible(True)
            view.placing(True)
            moved: list[Placement] = []
            released: list[Placement] = []
            view.moved.connect(moved.append)
            view.released.connect(released.append)
            height = start.height_m + machine_of(session.robot).tool_tip
            turn = math.radians(-100.0)
            await client.start_drag(HANDLE)
            await client.drag(HANDLE, (0.02, -0.03, height), (math.cos(turn / 2), 0.0, 0.0, math.sin(turn / 2)))
            await eventually(lambda: moved, "move")
            assert len(moved) == 1 and not released
            assert moved[0].centre_m == (0.02, -0.03) and moved[0].height_m == start.height_m
            assert moved[0].rotation_rad == pytest.approx(turn)
            await client.wait_for(lambda: client.positions.get("/robot/sheet", ())[:2] == (0.02, -0.03), "sheet")
            w, _, _, z = client.orientations["/robot/sheet"]
            assert 2.0 * math.atan2(z, w) == pytest.approx(turn)
            # a point of the drawing lies in the scene where the planner takes it to be
            corner = np.array([74.0, 105.0])
            c, s = math.cos(turn), math.sin(turn)
            in_scene = np.array([[c, -s], [s, c]]) @ (1e-3 * corner) + (0.02, -0.03)
            assert moved[0].on_table(corner[None])[0] == pytest.approx(in_scene)
            await client.end_drag(HANDLE)
            await eventually(lambda: released, "release")
            assert released == moved

    run_async(scene())


def test_a_handle_in_hand_is_left_alone_and_then_put_where_the_sheet_is(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            view, session = await lay_sheet(lab, client)
            start = default_placement(session.robot)
            view.place(start, (148.0, 210.0))
            corrected = Placement(start.height_m, (0.01, 0.0))
            view.moved.connect(lambda _: view.place(corrected, (148.0, 210.0)))
            await client.wait_for(lambda: HANDLE in client.positions and "/robot/sheet" in client.positions, "sheet")
            poses = note(client, "SetPositionMessage")
            await client.start_drag(HANDLE)
            await client.drag(HANDLE, (0.05, 0.0, 0.0))
            await client.wait_for(lambda: client.positions["/robot/sheet"][0] == 0.01, "sheet")
            assert [pose for pose in poses if pose["name"] == HANDLE] == []
            await client.end_drag(HANDLE)
            await client.wait_for(lambda: client.positions[HANDLE][0] == 0.01, "handle")

    run_async(scene())


def test_nothing_takes_the_sheet_out_of_the_room(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            view, _ = await lay_sheet(lab, client)
            moved: list[Placement] = []
            view.moved.connect(moved.append)
            await client.drag(HANDLE, (4.0, -4.0, 5.0))
            await eventually(lambda: moved, "move")
            assert moved[0].centre_m == (1.0, -1.0) and moved[0].height_m == 0.0

    run_async(scene())


def test_sheet_and_handle_are_shown_when_asked_for(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            shown: dict[str, bool] = {}
            client.listeners.append(
                lambda message, _: (
                    shown.update({message["name"]: message["visible"]})
                    if message["type"] == "SetSceneNodeVisibilityMessage"
                    else None
                )
            )
            view, _ = await lay_sheet(lab, client)
            await client.wait_for(lambda: shown.get("/robot/sheet") is False and shown.get(HANDLE) is False, "hidden")
            view.placing(True)
            view.visible(True)
            await client.wait_for(lambda: shown["/robot/sheet"] and shown[HANDLE], "sheet and handle")
            view.visible(False)
            await client.wait_for(lambda: not shown["/robot/sheet"] and not shown[HANDLE], "nothing")
            view.visible(True)
            view.placing(False)
            await client.wait_for(lambda: shown["/robot/sheet"] and not shown[HANDLE], "sheet alone")

    run_async(scene())


def shown(linear: np.ndarray) -> tuple[float, ...]:
    """What the page makes of a colour given for a line's end: light as the eye sees it."""
    light = np.asarray(linear) / 255.0
    return tuple(255.0 * np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055))


def test_the_plan_warns_where_the_pen_cannot_reach() -> None:
    strokes = [1e3 * L_SHAPE, 1e3 * SQUARE]
    segments, colors = plan_lines(strokes, [np.zeros(3, dtype=bool), np.zeros(5, dtype=bool)])
    assert drawn_length(segments) == pytest.approx(0.47), "and no way between the strokes"
    assert colors.tolist() == list(theme.PLAN)
    segments, colors = plan_lines(strokes, [np.array([False, False, True]), np.zeros(5, dtype=bool)])
    assert colors.shape == segments.shape
    wrong = [ends[0][0] > 3 * ends[0][1] for ends in colors.tolist()]
    assert wrong == [False, True, False, False, False, False], "red where an end is out of reach"
    assert shown(colors[0, 0]) == pytest.approx(theme.PLAN, abs=2)
    assert shown(colors[1, 1]) == pytest.approx(theme.WARNING, abs=6)


def test_the_plan_lies_between_paper_and_ink(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            view, _ = await lay_sheet(lab, client)
            view.place(Placement(-0.3), (148.0, 210.0))
            view.show_plan([1e3 * L_SHAPE], [np.zeros(3, dtype=bool)])
            await client.wait_for(lambda: "/robot/sheet/plan" in client.nodes, "plan")
            plan = client.nodes["/robot/sheet/plan"]["props"]["points"].reshape(-1, 3)[:, 2]
            ink = InkView(lab.client_of(client).scene)
            ink.load([L_SHAPE], 1e-4, stray=False)
            ink.show(-1, 0.0, 1)
            await client.wait_for(lambda: f"{INK}tip" in client.nodes, "ink")
            thickness = client.nodes[f"{INK}tip"]["props"]["thickness"]
            height = client.nodes[f"{INK}tip"]["props"]["points"].reshape(-1, 3)[:, 2]
            assert 0.0 < plan.max() < height.min() and height.min() >= 0.5 * thickness
            view.show_plan([], [])
            await client.wait_for(lambda: "/robot/sheet/plan" not in client.nodes, "no plan")

    run_async(scene())


def test_the_robots_own_handles_can_be_hidden(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            handle, session = lab.client_of(client), Session(Memory("par4"))
            shown: dict[str, bool] = {}
            client.listeners.append(
                lambda message, _: (
                    shown.update({message["name"]: message["visible"]})
                    if message["type"] == "SetSceneNodeVisibilityMessage"
                    else None
                )
            )
            gizmo = Gizmo(handle, session, NodeStream(handle))
            gizmo.visible(False)
            both = {"/robot/gizmo": False, "/robot/platform/turn": False}
            await client.wait_for(lambda: both.items() <= shown.items(), "hidden handles")
            shown.clear()
            session.choose_robot("fivebar")
            await client.wait_for(lambda: both.items() <= shown.items(), "hidden handles of another robot")
            gizmo.visible(True)
            await client.wait_for(lambda: all(shown[name] for name in both), "handles")

    run_async(scene())
