"""The belts of the five-bar's work cycle without a page: where they are, what rides, what they must not touch."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from manifold3d import Manifold, OpType

from app.motion import CYCLES, CycleMotion, plan_work_cycle
from app.robots import make_robot
from app.robots.fivebar import FiveBar
from app.robots.parts import conveyors, machine_of, tools
from app.robots.parts.fivebar import GRIPPER
from app.robots.parts.part import Part
from app.signal import Signal
from app.ui.motion.belts_layout import MARKS, Layout, item_places, layout_for, mark_places
from app.ui.motion.belts_view import BeltsView

BELTS = "/robot/belts"


@pytest.fixture(scope="module", params=CYCLES)
def cycle(request: pytest.FixtureRequest) -> CycleMotion:
    return plan_work_cycle(CYCLES[request.param])


def layout_of(cycle: CycleMotion) -> Layout:
    robot = make_robot("fivebar")
    assert isinstance(robot, FiveBar)
    return layout_for(cycle.items_at(cycle.t, cycle.pose), robot)


def test_the_belts_lie_under_the_items_of_the_cycle(cycle: CycleMotion):
    layout = layout_of(cycle)
    assert layout.x == (-0.159, 0.159)
    assert layout.item_top == -cycle.settings.stroke_m, "the tool goes down to the items"
    assert layout.belt_top - layout.floor > 0.04, "a belt stands on the floor"
    lowest, highest = cycle.pose[:, 1].min(), cycle.pose[:, 1].max()
    assert layout.y[0] + conveyors.HOOD < lowest and highest < layout.y[1]


def test_marks_move_with_the_belts(cycle: CycleMotion):
    layout, step = layout_of(cycle), 0.001
    places, sizes = mark_places(layout, 0.1)
    later, _ = mark_places(layout, 0.1 + step)
    moved = (later - places)[:, 1]
    stayed = np.abs(moved) < 0.1
    assert stayed.sum() > 2 * MARKS - 3, "at most one mark a belt comes round"
    pick = np.arange(2 * MARKS) < MARKS
    assert moved[stayed & pick] == pytest.approx(step, abs=1e-6)
    assert moved[stayed & ~pick] == pytest.approx(-step, abs=1e-6)
    assert (places[pick, 0] == np.float32(-0.159)).all() and (places[~pick, 0] == np.float32(0.159)).all()
    assert sizes.max() == 1.0 and sizes.min() >= 0.0


def test_an_item_is_seen_between_hood_and_end_and_turns_with_the_tool(cycle: CycleMotion):
    layout = layout_of(cycle)
    for k in range(0, len(cycle.t), 40):
        items = cycle.items_at(cycle.t[k], cycle.pose[k])
        places, wxyzs, seen = item_places(layout, items)
        assert not seen[len(items) :].any()
        assert seen[cycle.flow.handled], "the item that is handled is always in the picture"
        assert places[seen, 1].min() > layout.hood
        turns = 2.0 * np.arctan2(wxyzs[: len(items), 3], wxyzs[: len(items), 0])
        assert np.cos(turns - items[:, 3]) == pytest.approx(1.0, abs=1e-6)


class FakeScene:
    """Takes nodes and lets them be moved."""

    def __init__(self) -> None:
        self.nodes: dict[str, Any] = {}

    def add_frame(self, name: str, **values: Any) -> Any:
        self.nodes[name] = SimpleNamespace(**values, remove=lambda: None)
        return self.nodes[name]

    def add_batched_meshes_simple(self, name: str, *_: Any, **values: Any) -> Any:
        return self.add_frame(name, **values)


def test_a_simulated_runs_own_items_are_shown_while_it_is_played(cycle: CycleMotion):
    playback = SimpleNamespace(loaded=Signal(), moved=Signal(), run=None, time_s=0.0)
    desk: Any = SimpleNamespace(planned=Signal(), settings_changed=Signal(), playback=playback, motion=None)
    desk.cycling, desk.cycle, desk.robot = False, cycle.settings, make_robot("fivebar")
    scene: Any = FakeScene()
    view = BeltsView(scene, desk)
    view.visible(True)
    assert not scene.nodes[BELTS].visible, "no work cycle, no belts"
    items = cycle.items_at(cycle.t, cycle.pose) + 1e-4
    playback.run = SimpleNamespace(t=cycle.t, pose=cycle.pose, q=cycle.q, items=items)
    playback.loaded.emit(playback.run)
    assert scene.nodes[BELTS].visible
    for k in (0, 500, 900):
        playback.time_s = float(cycle.t[k])
        playback.moved.emit(playback.time_s)
        shown_places = scene.nodes[f"{BELTS}/item"].batched_positions[: items.shape[1]]
        assert shown_places == pytest.approx(items[k, :, :3], abs=1e-6)
    view.visible(False)
    assert not scene.nodes[BELTS].visible
    view.visible(True)
    playback.run = None
    desk.robot = make_robot("par4")
    playback.loaded.emit(None)
    assert not scene.nodes[BELTS].visible, "another robot has no belts"


def test_nothing_collides_with_the_belts(cycle: CycleMotion):
    robot, layout = make_robot("fivebar"), layout_of(cycle)
    machine, belts = machine_of(robot), standing_solids(layout)
    for k in range(0, len(cycle.t), 150):
        pose = cycle.pose[k].tolist()
        placements = machine.place(pose, robot.solve(*pose))
        position, wxyz = machine.tool_frame(pose)
        tool = rigid(position, wxyz)
        for body in machine.bodies:
            place = placements[body.name] if body.fixed is None else body.fixed
            for copy in zip(place.positions, place.wxyzs, strict=True):
                frame = tool @ rigid(*copy) if body.frame == "tool" else rigid(*copy)
                for part in body.parts:
                    for solid in solids_of(part):
                        overlap = (solid.transform(frame[:3]) ^ belts).volume()
                        assert overlap < 1e-12, f"{part.name} touches the belts after {cycle.t[k]:.2f} s"


def test_the_gripper_fits_around_an_items_handle():
    gripper = Manifold.batch_boolean(
        [*tools.gripper_jaws(GRIPPER), *tools.gripper_pads(GRIPPER)], OpType.Add
    )  # closed on nothing: the pads leave their gap
    for solid in (conveyors.item(), *(piece.scale((1.0, 1.0, 0.010)) for piece in conveyors.handle())):
        assert (solid ^ gripper).volume() < 1e-13
    pads = Manifold.batch_boolean(tools.gripper_pads(GRIPPER), OpType.Add)
    wider = conveyors.handle()[0].scale((1.08, 1.0, 0.008))
    assert (wider ^ pads).volume() > 1e-10, "the pads are close to the handle"


def solids_of(part: Part) -> list[Manifold]:
    built = part.build(*part.dimensions)
    return built if isinstance(built, list) else [built]


def standing_solids(layout: Layout) -> Manifold:
    """Everything of both conveyors that stands still, as one solid."""
    height, hood = layout.belt_top - layout.floor, layout.hood - layout.middle
    pieces = [*conveyors.frame(layout.length, height, hood), *conveyors.drive(layout.length, height)]
    pieces += [conveyors.belt(layout.length), *(s.translate((0.0, hood, 0.0)) for s in conveyors.hood(0.042))]
    return Manifold.batch_boolean(
        [piece.translate((x, layout.middle, layout.belt_top)) for x in layout.x for piece in pieces], OpType.Add
    )


def rigid(position: Any, wxyz: Any) -> np.ndarray:
    """(4, 4) matrix of a placement."""
    w, x, y, z = (float(v) for v in wxyz)
    frame = np.eye(4)
    frame[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    frame[:3, 3] = position
    return frame
