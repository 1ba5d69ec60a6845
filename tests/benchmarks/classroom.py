"""A class of 30 at work, as its server feels it: a rush at the door, lessons beside heavy jobs, and the spotlight.

Every student is a client over the wire who joins by the card, opens a lesson, answers, asks for checks and drags the
robot. The server is a process of its own; the load of this one and of others stands beside the figures.

    python tests/benchmarks/classroom.py --students 30 --seconds 20
"""

from __future__ import annotations

import asyncio
import random
import tempfile
import time
from collections.abc import Sequence
from contextlib import AsyncExitStack
from dataclasses import dataclass
from itertools import islice

import numpy as np
import tyro

from tests.benchmarks.load import GIZMO, LAPS_PER_SECOND, TOOL, Student, circle, reachable_home
from tests.benchmarks.meter import Load, Meter
from tests.benchmarks.targets import Row, table
from tests.support.class_lab import PIN, ClassClient, class_client
from tests.support.server import RunningServer, running_deltalab

RADIUS_M = 0.06
RUSH_S = 10.0
LESSON, TURN_TO = "06", "03 · Forward kinematics"
WARM_UP_S = 8.0
BROWSER_HZ = 20.0
BOUT_S = 2.0


@dataclass(frozen=True)
class Options:
    """Measure a class."""

    rush: int = 60
    """Students who come within ten seconds."""
    students: int = 30
    """Students at work."""
    heavy: int = 5
    """Of them, how many let their robot run, or compare controllers, again and again."""
    seconds: float = 20.0
    """Duration of each stage."""


class Worker:
    """One student at work."""

    def __init__(self, page: ClassClient) -> None:
        self.page = page
        self.drags = Student(page.client)
        self._said = 0

    async def say(self, what: str, value: str = "") -> None:
        """To the lesson panel, as its page does."""
        self._said += 1
        await self.page.set("Lesson", f"{self._said} {what} {value}")

    async def learn(self, end: float) -> None:
        """Answer, ask for the checks, and go on where it is open, until `end` (perf_counter)."""
        await asyncio.sleep(1.5 * random.random())
        for number in range(10_000):
            for what, value in (("predict", "1"), ("check", ""), ("explain", str(number % 3 + 1)), ("next", "")):
                if time.perf_counter() > end:
                    return
                await self.say(what, value)
                await asyncio.sleep(1.5)

    async def settle_in(self, toils: bool = False, compares: bool = False) -> None:
        """Open the lesson, and the lab in which to toil."""
        await self.say("open", LESSON)
        if toils:
            client, button = self.page.client, heavy_button(compares)
            await client.set_value("Motion opened" if compares else "Control opened", True)
            await client.wait_for(lambda: client.has(button), button, 60.0)

    async def toil(self, end: float, compares: bool) -> None:
        """Heavy jobs, one after the other."""
        client, button = self.page.client, heavy_button(compares)
        while time.perf_counter() < end:
            await client.set_value(button, True)
            await asyncio.sleep(2.0)

    async def drag(self, seconds: float, phase: float) -> None:
        centre, count = reachable_home("par4", RADIUS_M), round(seconds * BROWSER_HZ)
        path = islice(circle(centre, RADIUS_M, LAPS_PER_SECOND / BROWSER_HZ, phase), count)
        await self.drags.drag(path, BROWSER_HZ, time.perf_counter() + phase / BROWSER_HZ)

    async def work(self, seconds: float, phase: float) -> None:
        """Drag for two seconds, then read for two, and so on."""
        end = time.perf_counter() + seconds
        await asyncio.sleep(2.0 * BOUT_S * phase)
        while time.perf_counter() < end:
            await self.drag(BOUT_S, phase)
            await asyncio.sleep(BOUT_S)


def heavy_button(compares: bool) -> str:
    return "Compare them" if compares else "Run on the robot"


async def rush(server: RunningServer, code: str, students: int) -> list[Row]:
    """They come evenly over ten seconds, and join at once."""
    seen: list[float] = []
    joined: list[float] = []

    async def come(number: int, stack: AsyncExitStack) -> None:
        await asyncio.sleep(RUSH_S * number / students)
        start = time.perf_counter()
        page = await stack.enter_async_context(class_client(server.url, whole=False))
        nodes = page.client.nodes
        await page.until(lambda: nodes.keys() >= {GIZMO, TOOL, "/robot/arm"}, "robot")
        seen.append(time.perf_counter() - start)
        await page.join(f"Rush {number}", code)
        joined.append(time.perf_counter() - start)

    async with AsyncExitStack() as stack:
        meter = Meter(server.pid)
        await asyncio.gather(*(come(number, stack) for number in range(students)))
        note = loads(meter.read())
    return [
        Row(f"{students} come in {RUSH_S:g} s", "last sees the robot, s", max(seen), 5.0, note=note),
        Row("", "median sees the robot, s", float(np.median(seen))),
        Row("", "slowest is a member, s", max(joined)),
    ]


async def warm_up(url: str, code: str) -> None:
    """What is loaded when a server's first page opens a tab or a lesson is not measured."""
    async with class_client(url) as page:
        await page.join("Early", code)
        first = Worker(page)
        await first.say("hello")
        await asyncio.sleep(3.0)
        now = time.perf_counter()
        for compares in (False, True):
            await first.settle_in(True, compares)
            await first.toil(now + 2.0, compares)
        await first.learn(now + 8.0)


async def lessons(server: RunningServer, code: str, options: Options) -> list[Row]:
    """All work at lessons and drag; some let the workers toil."""
    await warm_up(server.url, code)
    async with AsyncExitStack() as stack:
        chief = await stack.enter_async_context(class_client(server.url))
        await chief.prove()
        students = await assemble(stack, server.url, code, options)
        rows: list[Row] = []
        for always in (False, True):
            rows += await at_work(server, students, options, always)
        rows += await spotlight(server, chief, students, options)
        return rows + await all_turn(server, chief, len(students))


async def at_work(server: RunningServer, students: Sequence[Worker], options: Options, always: bool) -> list[Row]:
    """All learn and drag, at times or without a pause, and some have heavy jobs."""
    meter, end = Meter(server.pid), time.perf_counter() + options.seconds
    async with asyncio.TaskGroup() as work:
        for number, student in enumerate(students):
            student.drags.latencies.clear()
            drag = student.drag if always else student.work
            work.create_task(student.learn(end))
            work.create_task(drag(options.seconds, number / len(students)))
            if number < options.heavy:
                work.create_task(student.toil(end, compares=number % 2 == 1))
    how = "drag without a pause" if always else "drag and read"
    stage = f"{len(students)} at lessons {how}, {options.heavy} with heavy jobs"
    return drags(stage, [student.drags for student in students], 33.0, loads(meter.read()))


async def all_turn(server: RunningServer, chief: ClassClient, students: int) -> list[Row]:
    """The instructor drags, and meanwhile turns everybody's page to the same step: with another robot on it."""
    one = Worker(chief)
    meter = Meter(server.pid)
    dragging = asyncio.create_task(one.drag(6.0, 0.3))
    await asyncio.sleep(1.0)
    await chief.set("Up to lesson", TURN_TO)
    await asyncio.sleep(0.3)
    await chief.press("All to here")
    await dragging
    worst, stage = 1e3 * max(one.drags.latencies), f"all {students} pages turn to a step at once"
    return [Row(stage, "worst drag, ms", worst, note=loads(meter.read()))]


async def spotlight(
    server: RunningServer, chief: ClassClient, students: Sequence[Worker], options: Options
) -> list[Row]:
    """One drags; with and without being shown on all the other pages."""
    rows = []
    shown = students[-1]
    for on in (False, True):
        if on:
            await chief.press(f"Student {len(students) - 1}")
            await chief.press("Show to all")
            for student in students[:-1]:
                nodes = student.page.client.nodes
                await student.page.until(lambda nodes=nodes: "/guest/tool" in nodes, "guest")
        shown.drags.latencies.clear()
        meter = Meter(server.pid)
        await shown.drag(options.seconds / 2, 0.3)
        stage = f"one drags, {'shown on' if on else 'unseen by'} {len(students)} pages"
        rows += drags(stage, [shown.drags], None, loads(meter.read()))
    return rows


async def assemble(stack: AsyncExitStack, url: str, code: str, options: Options) -> list[Worker]:
    """All members, each with the lesson open, and some with a lab."""
    workers = []
    for number in range(options.students):
        page = await stack.enter_async_context(class_client(url))
        await page.join(f"Student {number}", code)
        workers.append(Worker(page))
        await workers[-1].say("hello")
        await workers[-1].settle_in(number < options.heavy, number % 2 == 1)
        await asyncio.sleep(0.3)
    await asyncio.sleep(3.0)
    return workers


def drags(stage: str, students: Sequence[Student], target: float | None, note: str) -> list[Row]:
    times = 1e3 * np.array([latency for student in students for latency in student.latencies])
    p50, p95 = (float(value) for value in np.percentile(times, [50, 95]))
    return [Row(stage, "drag to pose, p95 ms", p95, target, note=note), Row("", "median ms", p50)]


def loads(load: Load) -> str:
    return (
        f"server {load.server_pct:.0f} % of a core, bench {load.bench_pct:.0f} %, others {load.others_pct:.0f} %,"
        f" {load.server_rss_mb:.0f} MB"
    )


def main(options: Options) -> None:
    rows: list[Row] = []
    for stage in (
        lambda server, code: rush(server, code, options.rush),
        lambda server, code: lessons(server, code, options),
    ):
        with tempfile.TemporaryDirectory() as data:
            arguments = "--classroom", "--pin", PIN, "--data", data, "--no-shadows"
            with running_deltalab(*arguments) as server:
                code = server.wait_for_output("PIN").partition("?class=")[2][:5]
                time.sleep(WARM_UP_S)
                rows += asyncio.run(stage(server, code))
    print(table(rows))


if __name__ == "__main__":
    main(tyro.cli(Options, description=__doc__))
