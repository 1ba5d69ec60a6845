"""How many students can drag at once: time from a drag to the robot's new pose, and the server's load.

Starts the real server as a process of its own, connects N websocket clients that each drag the gizmo of their
own session on a circle inside the robot's reach, and matches every drag with the position of the tool that
answers it exactly. A drag without an answer of its own was overtaken by a newer one.

    python tests/benchmarks/load.py --clients 1 30 --rates 30 --json load.json
"""

from __future__ import annotations

import asyncio
import json
import math
import time
from collections.abc import Iterator
from contextlib import AsyncExitStack
from dataclasses import asdict, dataclass
from itertools import count, islice
from pathlib import Path

import numpy as np
import tyro

from app.robots import make_robot
from tests.benchmarks.meter import Load, Meter
from tests.support.server import RunningServer, running_deltalab
from tests.support.wire import Message, WireClient, wire_client

GIZMO = "/robot/gizmo"
TOOL = "/robot/tool"
LAPS_PER_SECOND = 0.3517
"""Odd on purpose: no two drags of a run are at the same place."""
DECIMALS = 6
"""Positions are sent in whole micrometres, so that an answer in float32 still matches."""
CONNECT_INTERVAL = 0.02
SETTLED_AFTER = 2.0
DRAIN = 1.0

Point = tuple[float, ...]


@dataclass(frozen=True)
class Options:
    """Measure the drags of many browsers at once."""

    robot: str = "par4"
    """Robot that every client drags."""
    clients: tuple[int, ...] = (1, 8, 16, 30, 60)
    """Numbers of clients."""
    rates: tuple[float, ...] = (20.0, 30.0)
    """Drags per second of each client; a browser sends 20."""
    seconds: float = 10.0
    """Duration of the drags."""
    radius_mm: float = 60.0
    """Radius of the circle about the robot's home."""
    json: Path | None = None
    """File to write the rows to."""


@dataclass(frozen=True)
class Row:
    """One line of the table; latencies in milliseconds."""

    clients: int
    rate_hz: float
    sent: int
    answered_pct: float
    p50_ms: float
    p95_ms: float
    p99_ms: float
    load: Load


class Student:
    """One client, its drags and how long their answers took (seconds)."""

    def __init__(self, client: WireClient) -> None:
        self.client = client
        self.sent = 0
        self.latencies: list[float] = []
        self._waiting: dict[Point, float] = {}
        client.listeners.append(self._match)

    async def drag(self, path: Iterator[Point], rate: float, start: float) -> None:
        """Drag along `path` at an even pace from `start` (perf_counter)."""
        await self.client.start_drag(GIZMO)
        for k, point in enumerate(path):
            await asyncio.sleep(start + k / rate - time.perf_counter())
            self._waiting[point] = time.perf_counter()
            self.sent += 1
            await self.client.drag(GIZMO, point)
        await self.client.end_drag(GIZMO)

    def _match(self, message: Message, arrived: float) -> None:
        if message["type"] == "SetPositionMessage" and message["name"] == TOOL:
            sent = self._waiting.pop(rounded(message["position"]), None)
            if sent is not None:
                self.latencies.append(arrived - sent)


def rounded(point: Point) -> Point:
    return tuple(round(float(value), DECIMALS) for value in point)


def circle(centre: Point, radius: float, step: float, phase: float = 0.0) -> Iterator[Point]:
    """Points without end on a level circle, metres; `step` and `phase` in laps."""
    for k in count():
        angle = 2 * math.pi * (phase + step * k)
        yield rounded((centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle), centre[2]))


def reachable_home(robot_name: str, radius: float) -> Point:
    """Where the robot's tool is at home, with a level circle of this radius in reach around it."""
    robot = make_robot(robot_name)
    x, y, z, *rotation = (float(value) for value in robot.home)
    for point in islice(circle((x, y, z), radius, 1 / 360), 360):
        reach = robot.reach([*point, *rotation])
        if not reach.ok:
            raise SystemExit(f"{robot_name} cannot follow the circle: {reach.reason} at {point}.")
    return x, y, z


async def join(stack: AsyncExitStack, url: str, clients: int) -> list[Student]:
    """Connect so many students and wait until each has the whole page."""
    students = []
    for _ in range(clients):
        students.append(Student(await stack.enter_async_context(wire_client(url))))
        await asyncio.sleep(CONNECT_INTERVAL)
    for student in students:
        nodes = student.client.nodes
        await student.client.wait_for(lambda nodes=nodes: nodes.keys() >= {GIZMO, TOOL}, "gizmo and tool")
    await asyncio.gather(*(settled(student.client) for student in students))
    return students


async def settled(client: WireClient) -> None:
    """Wait until nothing is added to the client's page any more."""
    before = -1
    while (now := len(client.nodes) + len(client.inputs)) != before:
        before = now
        await asyncio.sleep(SETTLED_AFTER)


async def measure(server: RunningServer, options: Options, clients: int, rate: float) -> Row:
    """Connect, drag for a while, count."""
    radius, drags = 1e-3 * options.radius_mm, round(rate * options.seconds)
    centre = reachable_home(options.robot, radius)
    async with AsyncExitStack() as stack:
        students = await join(stack, server.url, clients)
        meter, start = Meter(server.pid), time.perf_counter()
        async with asyncio.TaskGroup() as dragging:
            for index, student in enumerate(students):
                path = islice(circle(centre, radius, LAPS_PER_SECOND / rate, phase=0.17 * index), drags)
                dragging.create_task(student.drag(path, rate, start + index / clients / rate))
        load = meter.read()
        await asyncio.sleep(DRAIN)
    latencies_ms = 1e3 * np.array([latency for student in students for latency in student.latencies])
    if not latencies_ms.size:
        raise SystemExit("No drag was answered by the tool's position: the robot does not follow its gizmo.")
    p50, p95, p99 = (float(value) for value in np.percentile(latencies_ms, [50, 95, 99]))
    sent = sum(student.sent for student in students)
    return Row(clients, rate, sent, 100 * latencies_ms.size / sent, p50, p95, p99, load)


def table_line(row: Row) -> str:
    load = row.load
    cells = (
        f"{row.clients}", f"{row.rate_hz:g}", f"{row.p50_ms:.1f}", f"{row.p95_ms:.1f}", f"{row.p99_ms:.1f}",
        f"{row.answered_pct:.1f}", f"{load.server_pct:.0f}", f"{load.server_rss_mb:.0f}",
        f"{load.bench_pct:.0f}", f"{load.others_pct:.0f}",
    )  # fmt: skip
    return "| " + " | ".join(cells) + " |"


def main(options: Options) -> None:
    print("| clients | Hz | p50 ms | p95 ms | p99 ms | answered % | server % | RSS MB | bench % | others % |")
    print("|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|", flush=True)
    rows = []
    for rate in options.rates:
        for clients in options.clients:
            with running_deltalab("--robot", options.robot) as server:
                rows.append(asyncio.run(measure(server, options, clients, rate)))
            print(table_line(rows[-1]), flush=True)
    if options.json:
        options.json.write_text(json.dumps([asdict(row) for row in rows], indent=2))


if __name__ == "__main__":
    main(tyro.cli(Options, description=__doc__))
