"""A student's page without the page, for tests of what lessons do on it."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor

from app.ui.lessons.play import Stage


def on_stage(scene: Callable[[Stage], Awaitable[None]], robot: str = "par4") -> None:
    async def play() -> None:
        with ThreadPoolExecutor(2) as pool:
            stage = Stage(robot, pool)
            try:
                await scene(stage)
            finally:
                stage.close()

    asyncio.run(play())


async def settled(stage: Stage, *facts: str) -> list[object]:
    """Facts once nothing computes any more; the first look begins to compute them."""
    for fact in facts:
        stage.apparatus.value(fact)
    await stage.settle()
    return [stage.apparatus.value(fact) for fact in facts]
