"""A real server and clients that speak its protocol: independence, memory, leaving, and one student's noise."""

from __future__ import annotations

import asyncio
import re
from pathlib import Path

import psutil
import pytest

from app.ui.guard import new_browser_id
from tests.support.server import RunningServer
from tests.support.wire import WireClient, run_async, wire_client

GIZMO, TOOL = "/robot/gizmo", "/robot/tool"
HOME = (0.0, -0.036, -0.3)
pytestmark = pytest.mark.long


async def furnished(client: WireClient) -> None:
    """Wait until the room is complete: the last of its panels has come."""
    await client.wait_for(lambda: GIZMO in client.nodes and client.has("Reset view"), "furnished room")


def near(client: WireClient, point: tuple[float, float, float]):
    return lambda: (
        TOOL in client.positions and max(abs(a - b) for a, b in zip(client.positions[TOOL], point, strict=True)) < 1e-6
    )


def own_nodes(client: WireClient) -> dict[str, tuple[float, ...]]:
    """Where the client's robot is; what all share arrives on its own time."""
    return {name: position for name, position in client.positions.items() if name.startswith("/robot")}


def text_of(client: WireClient) -> str:
    """What the page's HTML elements say."""
    return " ".join(made["props"]["content"] for made in client.inputs.values() if "content" in made["props"])


def test_a_drag_moves_the_own_robot_and_no_other(server: RunningServer):
    async def scene() -> None:
        async with wire_client(server.url) as one, wire_client(server.url) as two:
            await furnished(one)
            await furnished(two)
            before = own_nodes(two)
            target = (0.03, -0.02, -0.33)
            await one.start_drag(GIZMO)
            await one.drag(GIZMO, target)
            await one.wait_for(near(one, target), "tool at the gizmo")
            await one.set_value("Robot", "Linear delta")
            await one.wait_for(lambda: one.has("d1 (mm)"), "joints of the linear delta")
            await asyncio.sleep(0.3)
            assert own_nodes(two) == before and two.value_of("Robot") == "Par4 delta"
            assert two.value_of("x (mm)") == 0.0

    run_async(scene())


def test_out_of_reach_the_page_says_why_and_the_leg_changes_colour(server: RunningServer):
    async def scene() -> None:
        async with wire_client(server.url) as client:
            await furnished(client)
            colours: list[object] = []
            client.listeners.append(
                lambda message, _: (
                    colours.append(message["updates"]["batched_colors"].tolist())
                    if "batched_colors" in message.get("updates", {})
                    else None
                )
            )
            await client.start_drag(GIZMO)
            await client.drag(GIZMO, (0.18, -0.036, -0.3))
            await client.wait_for(lambda: "upper arm at" in text_of(client), "reason in the panel")
            await client.wait_for(lambda: "/robot/tool/notice" in client.nodes, "reason at the tool")
            reason = client.nodes["/robot/tool/notice"]["props"]["text"]
            assert re.fullmatch(r"Leg \d: upper arm at [+-]45 degrees\.", reason)
            assert colours, "the offending leg is painted"
            await client.drag(GIZMO, HOME)
            await client.wait_for(lambda: "In reach" in text_of(client), "verdict in reach")
            assert "/robot/tool/notice" not in client.nodes

    run_async(scene())


def test_a_reload_finds_the_same_robot_again(server: RunningServer):
    async def scene() -> None:
        headers = {"Cookie": f"deltalab_id={new_browser_id()}"}
        async with wire_client(server.url, headers=headers) as client:
            await furnished(client)
            await client.set_value("Robot", "Drawing delta")
            await client.wait_for(lambda: not client.has("q4 (deg)"), "three joints")
            await client.set_value("x (mm)", 25.0)
            await client.wait_for(near(client, (0.025, 0.0, -0.33)), "typed pose")
            async with wire_client(server.url, headers=headers) as before_the_old_page_is_gone:
                await furnished(before_the_old_page_is_gone)
                assert before_the_old_page_is_gone.value_of("Robot") == "Drawing delta"
        async with wire_client(server.url, headers=headers) as again:
            await furnished(again)
            assert again.value_of("Robot") == "Drawing delta"
            assert again.value_of("x (mm)") == 25.0
        async with wire_client(server.url) as stranger:
            await furnished(stranger)
            assert stranger.value_of("Robot") == "Par4 delta"

    run_async(scene())


def test_sixty_visits_leave_nothing_behind(server: RunningServer):
    async def visits(count: int) -> None:
        for _ in range(count):
            async with wire_client(server.url) as client:
                await furnished(client)
                await client.start_drag(GIZMO)
                await client.drag(GIZMO, (0.01, -0.03, -0.31))

    process = psutil.Process(server.pid)
    run_async(visits(180))  # until then the memory of an even load grows
    memory, threads = process.memory_info().rss, process.num_threads()
    run_async(visits(60))
    run_async(asyncio.sleep(0.5))
    assert process.num_threads() <= threads + 1
    assert process.memory_info().rss - memory < 5e6, "less than 80 kB a visit"
    assert len(process.net_connections(kind="tcp")) <= 3


def test_heavy_jobs_of_one_student_leave_another_dragging(server: RunningServer):
    """While one student asks for workspaces without a pause, every drag of another is answered."""

    async def scene() -> int:
        async with wire_client(server.url) as busy, wire_client(server.url) as calm:
            await furnished(busy)
            await furnished(calm)
            stop = asyncio.Event()

            async def ask() -> None:
                await busy.set_value("Show as", "Cloud")
                for angle in [-40, 25, -15, 35, 10, -30] * 20:
                    if stop.is_set():
                        return
                    await busy.set_value("At θ (deg)", angle)
                    await asyncio.sleep(0.05)

            asking = asyncio.create_task(ask())
            await calm.start_drag(GIZMO)
            answered = 0
            for k in range(40):
                target = (0.001 * k, -0.036, -0.31)
                await calm.drag(GIZMO, target)
                await calm.wait_for(near(calm, target), f"answer to drag {k}", timeout=2.0)
                answered += 1
                await asyncio.sleep(0.02)
            stop.set()
            await asking
            await busy.wait_for(lambda: "/robot/workspace" in busy.nodes, "workspace")
            return answered

    assert run_async(scene()) == 40


@pytest.mark.parametrize("robot", ["par4", "delta3", "linear", "fivebar"])
def test_every_robot_can_be_started_with(running_server, robot: str):
    server = running_server("--robot", robot)

    async def scene() -> None:
        async with wire_client(server.url) as client:
            await furnished(client)
            assert TOOL in client.nodes and "/robot/gizmo" in client.nodes

    run_async(scene())
    assert "Traceback" not in server.output() and "deprecated" not in server.output()


def test_artifacts_are_ignored_by_git():
    assert "tests/artifacts" in (Path(__file__).parents[2] / ".gitignore").read_text()
