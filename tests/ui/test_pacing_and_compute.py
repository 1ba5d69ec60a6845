"""Fewer calls than events, and slow work of which only the newest result counts."""

from __future__ import annotations

import asyncio
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from app.ui.compute import Worker, make_pools
from app.ui.pacing import Paced


def test_a_burst_acts_at_once_and_once_more_at_its_end():
    async def burst() -> list[int]:
        seen: list[int] = []
        events: list[int] = []
        paced = Paced(lambda: seen.append(events[-1]), 0.05)
        for event in range(20):
            events.append(event)
            paced.request()
        await asyncio.sleep(0.2)
        return seen

    assert asyncio.run(burst()) == [0, 19]


def test_cancelled_pacing_never_acts_again():
    async def cancelled() -> int:
        calls: list[None] = []
        paced = Paced(lambda: calls.append(None), 0.02)
        paced.request()
        paced.request()
        paced.cancel()
        await asyncio.sleep(0.1)
        return len(calls)

    assert asyncio.run(cancelled()) == 1


def test_newest_job_wins_and_those_between_never_run():
    async def jobs() -> tuple[list[int], list[int]]:
        gate, ran, told = threading.Event(), [], []

        def job(number: int) -> int:
            ran.append(number)
            gate.wait(5)
            return number

        with ThreadPoolExecutor(1) as pool:
            worker = Worker(pool, pytest.fail)
            for number in range(5):
                worker.request(told.append, job, number)
                await asyncio.sleep(0.01)
            gate.set()
            while worker.busy:
                await asyncio.sleep(0.01)
        return ran, told

    assert asyncio.run(jobs()) == ([0, 4], [4])


def test_a_failing_job_is_reported_in_a_sentence_and_the_next_one_runs():
    async def jobs() -> tuple[list[str], list[float]]:
        sentences: list[str] = []
        told: list[float] = []
        with ThreadPoolExecutor(1) as pool:
            worker = Worker(pool, sentences.append)
            worker.request(told.append, float, "seven")
            while worker.busy:
                await asyncio.sleep(0.01)
            worker.request(told.append, float, "7")
            while worker.busy:
                await asyncio.sleep(0.01)
        return sentences, told

    sentences, told = asyncio.run(jobs())
    assert len(sentences) == 1 and "could not be computed" in sentences[0]
    assert told == [7.0]


def test_a_cancelled_job_tells_nobody():
    async def cancelled() -> list[int]:
        told: list[int] = []
        with ThreadPoolExecutor(1) as pool:
            worker = Worker(pool, pytest.fail)
            worker.request(told.append, int, "1")
            worker.cancel()
            await asyncio.sleep(0.05)
        return told

    assert asyncio.run(cancelled()) == []


def test_the_pool_computes_in_another_process():
    import os

    pool = make_pools().slow
    try:
        assert pool.submit(os.getpid).result(30) != os.getpid()
    finally:
        pool.shutdown()
