"""Slow work in worker processes; the event loop only sends results. Newest wins, one job at a time.

Jobs are plain functions of plain data, so that any `concurrent.futures.Executor` can take the pool's place.
"""

from __future__ import annotations

import asyncio
import logging
import multiprocessing
import os
import signal
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, ProcessPoolExecutor
from typing import Any, NamedTuple

_log = logging.getLogger(__name__)


class Pools(NamedTuple):
    """Two lanes, so that what must follow a slider never waits behind what takes seconds."""

    quick: Executor
    """For jobs of some ten milliseconds."""
    slow: Executor

    def shutdown(self) -> None:
        """Drop what is waiting, and wait for nothing: a worker that was killed never answers."""
        for pool in self:
            pool.shutdown(wait=False, cancel_futures=True)


def make_pools() -> Pools:
    """Workers that leave the interrupt key to the server and the processor to the event loop."""
    cores = os.cpu_count() or 2
    return Pools(quick=_make_pool(max(1, min(2, cores - 1)), 0), slow=_make_pool(max(1, min(4, cores - 1)), 5))


def _make_pool(workers: int, niceness: int) -> ProcessPoolExecutor:
    context = multiprocessing.get_context("spawn")
    return ProcessPoolExecutor(workers, context, initializer=_start_worker, initargs=(niceness,))


def _start_worker(niceness: int) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(niceness)


class Worker:
    """One line of work of one session. While a job runs, only the newest of those that follow is kept."""

    def __init__(self, pool: Executor, failed: Callable[[str], None]) -> None:
        self._pool = pool
        self._failed = failed
        self._waiting: tuple[Callable[[Any], None], Callable[..., Any], tuple[Any, ...]] | None = None
        self._running: asyncio.Task[None] | None = None

    @property
    def busy(self) -> bool:
        return self._running is not None

    def request(self, then: Callable[[Any], None], job: Callable[..., Any], *arguments: Any) -> None:
        """Run `job(*arguments)` in the pool, then `then(result)` on the event loop, unless a newer job came."""
        self._waiting = (then, job, arguments)
        if self._running is None:
            self._running = asyncio.get_running_loop().create_task(self._work())

    def cancel(self) -> None:
        """Forget everything asked for; a running job's result is dropped."""
        self._waiting = None
        if self._running is not None:
            self._running.cancel()
            self._running = None

    async def _work(self) -> None:
        try:
            while self._waiting is not None:
                then, job, arguments = self._waiting
                self._waiting = None
                result = await asyncio.get_running_loop().run_in_executor(self._pool, job, *arguments)
                if self._waiting is None:
                    then(result)
        except BrokenExecutor:
            self._failed("The computation stopped unexpectedly. Please try again.")
        except Exception as error:  # whatever a job may raise: the log has it, the student is told
            _log.exception("job failed")
            self._failed(f"This could not be computed: {error}")
        finally:
            if self._running is asyncio.current_task():
                self._running = None
