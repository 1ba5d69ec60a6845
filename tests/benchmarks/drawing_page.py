"""How soon a drawing follows its knobs, and whether those who only drag their robot feel it.

Over the wire, on the real server: students pull the gamma of the first sample (a photo on A5), once every two
seconds each, and wait for the new picture of the sheet; meanwhile one more student drags a robot at 30 Hz. Then all
robots draw at once, and the server's load and what it sends are measured.

    python tests/benchmarks/drawing_page.py --students 1 8
"""

from __future__ import annotations

import asyncio
import time
from contextlib import AsyncExitStack
from dataclasses import dataclass

import numpy as np
import tyro

from app.robots import make_robot
from tests.benchmarks.load import GIZMO, Student, circle
from tests.benchmarks.meter import Meter
from tests.support.server import RunningServer, running_deltalab
from tests.support.wire import Message, WireClient, run_async, wire_client

PULLS = 6
PULL_EVERY_S = 2.0
DRAG_HZ = 30.0
DRAW_S = 8.0
PICTURE = 'alt="Drawing"'


@dataclass(frozen=True)
class Options:
    """Measure the tab Draw for several students at once."""

    students: tuple[int, ...] = (1, 8)
    """Numbers of students."""


async def furnished(client: WireClient) -> WireClient:
    """Open the tab and wait for the first drawing and its plan."""
    await client.wait_for(lambda: client.has("Draw opened"), "furnished room")
    await client.set_value("Draw opened", True)
    await client.wait_for(lambda: client.has("Gamma"), "knobs", 60.0)
    await client.wait_for(lambda: client.has("Draw") and not disabled(client, "Draw"), "plan", 120.0)
    return client


def disabled(client: WireClient, label: str) -> bool:
    return bool(client.inputs[client.uuid_of(label)]["props"]["disabled"])


async def pulls(client: WireClient, offset: float) -> list[float]:
    """Milliseconds from a changed knob to the new picture."""
    arrived: list[float] = []

    def note(message: Message, at: float) -> None:
        if message["type"] == "GuiUpdateMessage" and PICTURE in str(message["updates"].get("content", "")):
            arrived.append(at)

    client.listeners.append(note)
    await asyncio.sleep(offset)
    times = []
    for k in range(PULLS):
        arrived.clear()
        started = time.perf_counter()
        await client.set_value("Gamma", round(0.6 + 0.05 * k + 0.3 * (k % 2), 2))
        await client.wait_for(lambda: arrived, "new picture", 60.0)
        times.append(1e3 * (arrived[0] - started))
        await asyncio.sleep(max(0.0, PULL_EVERY_S - times[-1] / 1e3))
    return times


async def dragged(client: WireClient, seconds: float) -> list[float]:
    """Milliseconds from a drag to the robot's new pose."""
    await client.wait_for(lambda: GIZMO in client.nodes, "gizmo")
    student = Student(client)
    home = tuple(make_robot("delta3").home.tolist())
    path = circle(home, 0.05, 0.3517 / DRAG_HZ)
    points = (next(path) for _ in range(round(seconds * DRAG_HZ)))
    await student.drag(points, DRAG_HZ, time.perf_counter())
    await asyncio.sleep(1.0)
    return [1e3 * latency for latency in student.latencies]


async def measure(server: RunningServer, students: int) -> None:
    async with AsyncExitStack() as stack:
        clients = [await stack.enter_async_context(wire_client(server.url)) for _ in range(students)]
        await asyncio.gather(*map(furnished, clients))
        await asyncio.sleep(6.0)
        other = await stack.enter_async_context(wire_client(server.url))
        seconds = PULLS * PULL_EVERY_S
        pulling = [pulls(client, PULL_EVERY_S * k / students) for k, client in enumerate(clients)]
        drags, *times = await asyncio.gather(dragged(other, seconds), *pulling)
        report(f"knob to picture, {students} students", [value for row in times for value in row])
        report("a drag meanwhile", drags)
        await draw_together(server, clients)


async def draw_together(server: RunningServer, clients: list[WireClient]) -> None:
    for client in clients:
        await client.wait_for(lambda c=client: not disabled(c, "Draw"), "plan", 120.0)
    await asyncio.sleep(4.0)
    received = [0]
    for client in clients:
        client.listeners.append(lambda message, _: received.__setitem__(0, received[0] + size_of(message)))
        await client.set_value("Draw", True)
    meter = Meter(server.pid)
    await asyncio.sleep(DRAW_S)
    load = meter.read()
    rate = received[0] / DRAW_S / len(clients) / 1e3
    print(f"  all {len(clients)} draw: {load}; {rate:.1f} kB/s of arrays each")


def size_of(message: Message) -> int:
    """Bytes of a message's arrays."""
    values = {**message.get("updates", {}), **message.get("props", {})}.values()
    return sum(value.nbytes for value in values if isinstance(value, np.ndarray))


def report(what: str, times: list[float]) -> None:
    median, p95, worst = (float(np.quantile(times, share)) for share in (0.5, 0.95, 1.0))
    print(f"{what:<34} median {median:6.1f} ms   p95 {p95:6.1f} ms   worst {worst:6.1f} ms", flush=True)


def main(options: Options) -> None:
    with running_deltalab("--no-shadows", "--robot", "delta3") as server:
        time.sleep(8.0)  # the workers have warmed up
        for students in options.students:
            run_async(measure(server, students))


if __name__ == "__main__":
    main(tyro.cli(Options))
