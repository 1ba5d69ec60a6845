"""What goes out to a page: fast updates of nodes, and the order in which everything arrives."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
import viser

from app.ui.viser_adapter import (
    NodeStream,
)
from tests.support.small_lab import (
    GIZMO,
    GROUP,
    INSTANCES,
    TOOL,
    SmallLab,
    eventually,
    guarded_lab,
    round_trip,
)
from tests.support.wire import note, run_async

TURNED = np.tile((0.0, 1.0, 0.0, 0.0), (INSTANCES, 1))


@pytest.fixture
def lab() -> Iterator[SmallLab]:
    with guarded_lab() as lab:
        yield lab


def test_place_sends_one_message_and_keeps_the_handle_in_step(lab: SmallLab) -> None:
    positions = np.arange(9.0).reshape(3, 3)
    colors = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255]])

    async def scene() -> None:
        async with lab.visit() as client:
            got = note(client, "SceneNodeUpdateMessage")
            handle = lab.groups[lab.client_of(client).client_id]
            NodeStream(lab.client_of(client)).place(handle, positions, TURNED, colors, (1.0, 2.0, 3.0), (0.1, 0.2, 0.3))
            await client.wait_for(lambda: got, "update")
            assert len(got) == 1
            assert got[0]["name"] == GROUP
            assert got[0]["owner"] == client.nodes[GIZMO]["owner"]
            sent = {name: (array.dtype.str, array.tolist()) for name, array in got[0]["updates"].items()}
            expected = {
                "batched_positions": positions.astype(np.float32),
                "batched_wxyzs": TURNED.astype(np.float32),
                "batched_colors": colors.astype(np.uint8),
                "batched_scales": np.array((1.0, 2.0, 3.0), np.float32),
                "batched_opacities": np.array((0.1, 0.2, 0.3), np.float32),
            }
            assert sent == {name: (array.dtype.str, array.ravel().tolist()) for name, array in expected.items()}
            for name, array in expected.items():
                kept = getattr(handle, name)
                assert kept.dtype == array.dtype
                np.testing.assert_array_equal(kept, array)

    run_async(scene())


def test_place_takes_a_copy(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            got = note(client, "SceneNodeUpdateMessage")
            positions = np.ones((INSTANCES, 3), np.float32)
            stream = NodeStream(lab.client_of(client))
            with lab.client_of(client).atomic():
                stream.place(lab.groups[lab.client_of(client).client_id], positions)
                positions[:] = 7.0
            await client.wait_for(lambda: got, "update")
            assert got[0]["updates"]["batched_positions"].tolist() == [1.0] * 9

    run_async(scene())


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("positions", np.zeros((2, 3))),
        ("positions", np.zeros(3)),
        ("wxyzs", np.zeros((3, 3))),
        ("colors", np.zeros((3, 4), np.uint8)),
        ("scales", np.zeros(2)),
        ("opacities", np.zeros((3, 3))),
    ],
)
def test_place_refuses_other_shapes_and_changes_nothing(lab: SmallLab, name: str, value: np.ndarray) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            handle = lab.groups[lab.client_of(client).client_id]
            arguments: dict[str, Any] = {"positions": np.ones((INSTANCES, 3)), name: value}
            with pytest.raises(ValueError, match=f"^{name} need the shape"):
                NodeStream(lab.client_of(client)).place(handle, **arguments)
            np.testing.assert_array_equal(handle.batched_positions, np.zeros((INSTANCES, 3)))

    run_async(scene())


def test_a_newer_update_replaces_an_unsent_one_whoever_made_it(lab: SmallLab) -> None:
    """As between viser's own setters: the last one wins, and the older are never sent."""

    async def scene() -> None:
        async with lab.visit() as client:
            handle, got = lab.client_of(client), note(client, "SceneNodeUpdateMessage", "SetPositionMessage")
            group, tool, stream = lab.groups[handle.client_id], lab.tools[handle.client_id], NodeStream(handle)
            with handle.atomic():
                for step in range(1, 101):
                    stream.place(group, np.full((INSTANCES, 3), float(step)))
                    stream.move(tool, (float(step), 0.0, 0.0))
                group.batched_positions = np.full((INSTANCES, 3), 500.0)
                tool.position = (500.0, 0.0, 0.0)
            await client.wait_for(lambda: len(got) >= 2, "updates")
            await round_trip(client, (0.1, 0.0, 0.0))
            updates = [message for message in got if message["type"] == "SceneNodeUpdateMessage"]
            assert [message["updates"]["batched_positions"][0] for message in updates] == [500.0]
            assert [message["position"][0] for message in got if message not in updates] == [500.0, 0.1]

    run_async(scene())


def test_move_sends_the_pose_and_keeps_the_handle_in_step(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            handle = lab.client_of(client)
            tool, stream = lab.tools[handle.client_id], NodeStream(handle)
            stream.move(tool, np.array([1.0, 2.0, 3.0]), (0.0, 0.0, 1.0, 0.0))
            stream.flush()
            await client.wait_for(lambda: client.orientations.get(TOOL) == (0.0, 0.0, 1.0, 0.0), "orientation")
            assert client.positions[TOOL] == (1.0, 2.0, 3.0)
            assert tool.position.tolist() == [1.0, 2.0, 3.0]
            assert tool.wxyz.tolist() == [0.0, 0.0, 1.0, 0.0]

    run_async(scene())


def test_updates_of_a_removed_node_are_a_mistake(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            handle = lab.client_of(client)
            group, stream = lab.groups[handle.client_id], NodeStream(handle)
            group.remove()
            with pytest.raises(RuntimeError, match="has been removed"):
                stream.place(group, np.zeros((INSTANCES, 3)))

    run_async(scene())


@pytest.mark.filterwarnings("error")
def test_updates_for_a_client_that_has_left_vanish(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            handle = lab.client_of(client)
        await eventually(lambda: handle.client_id not in lab.server.get_clients(), "farewell")
        stream = NodeStream(handle)
        stream.place(lab.groups[handle.client_id], np.ones((INSTANCES, 3)))
        stream.move(lab.tools[handle.client_id], (1.0, 0.0, 0.0))
        stream.flush()
        lab.tools[handle.client_id].position = (2.0, 0.0, 0.0)
        assert not handle._websock_connection.get_message_buffer().message_from_id

    run_async(scene())


def test_what_a_drag_changes_arrives_together(lab: SmallLab) -> None:
    """All updates up to a flush come in one window, and windows are sent without waiting for the next one."""

    async def scene() -> None:
        async with lab.visit() as client:
            handle = lab.client_of(client)
            windows: dict[float, list[str]] = {}
            client.listeners.append(lambda message, time: windows.setdefault(time, []).append(message["type"]))
            group, stream = lab.groups[handle.client_id], NodeStream(handle)

            @lab.gizmos[handle.client_id].on_update
            async def _(event: viser.TransformControlsEvent) -> None:
                stream.place(group, np.full((INSTANCES, 3), event.target.position[0]))
                stream.flush()

            for step in range(1, 11):
                await round_trip(client, (step / 100, 0.0, 0.0))
            await client.wait_for(
                lambda: sum("SceneNodeUpdateMessage" in window for window in windows.values()) == 10, "10"
            )

    run_async(scene())


def test_what_nobody_flushes_is_sent_all_the_same(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            lab.tools[lab.client_of(client).client_id].position = (9.0, 0.0, 0.0)
            await client.wait_for(lambda: client.positions.get(TOOL) == (9.0, 0.0, 0.0), "tool")

    run_async(scene())


def test_many_messages_arrive_in_their_order(lab: SmallLab) -> None:
    """More than viser puts into one window, from a thread of the app's own."""

    async def scene() -> None:
        async with lab.visit() as client:
            made = note(client, "FrameMessage")
            handle = lab.client_of(client)

            def build() -> None:
                for number in range(500):
                    handle.scene.add_frame(f"/frame {number}")
                handle.flush()

            await asyncio.to_thread(build)
            await client.wait_for(lambda: len(made) == 500, "500 frames")
            assert [message["name"] for message in made] == [f"/frame {number}" for number in range(500)]

    run_async(scene())


def test_an_atomic_block_is_sent_as_one(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            handle = lab.client_of(client)
            times: list[float] = []
            client.listeners.append(
                lambda message, time: times.append(time) if message["type"] == "FrameMessage" else None
            )

            def build() -> None:
                with handle.atomic():
                    for number in range(20):
                        handle.scene.add_frame(f"/frame {number}")
                        handle.flush()
                        time.sleep(0.005)

            await asyncio.to_thread(build)
            await client.wait_for(lambda: len(times) == 20, "20 frames")
            assert len(set(times)) == 1

    run_async(scene())
