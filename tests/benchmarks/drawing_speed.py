"""How long the computer takes for a drawing, and how much memory."""

from __future__ import annotations

import asyncio
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.compose import Look, compose
from app.drawing.source import Source, read_source
from app.drawing.toolpath import PenSettings, Track, default_placement, plan_toolpath, track
from app.robots import make_robot
from app.ui.playback import Playback
from app.ui.session import Session
from app.ui.state import Memory
from tests.benchmarks.targets import Row

REPEATS = 9
LARGE = (5774, 8660)
"""Rows and columns of 50 megapixels."""
PLAY_SPEED = 5.0
MODES = ("auto", "canny")

IN_CHILD = """
import sys
from tests.benchmarks.drawing_speed import peak_mb, whole_way, seconds_of
with open(sys.argv[1], "rb") as file:
    data = file.read()
print(seconds_of(lambda: whole_way(data)), peak_mb())
"""


def speed_rows(grey: NDArray[np.uint8]) -> list[Row]:
    """A photo (h, w) at several sizes."""
    small = Source("photo", resized(grey, (512, 512)))
    rows = []
    for mode in MODES:
        start = time.process_time()
        took = best_of(lambda mode=mode: compose(small, Look(mode=mode)))
        note = f"{(time.process_time() - start) / REPEATS:.2f} s of the processor"
        rows.append(Row("speed", f"512 x 512, preview, {mode}: s", took, 0.2, note=note))
    data = encoded(resized(grey, (2000, 2000)), ".png")
    took = best_of(lambda: whole_way(data))
    rows.append(Row("speed", "2000 x 2000, all stages: s", took, 1.5, note="from the PNG to the track"))
    for ending in (".jpg", ".png"):
        took, memory = in_child(encoded(resized(grey, LARGE), ending))
        rows.append(Row("speed", f"50 megapixels, {ending[1:]}: s", took, 4.0, note="all stages, first time"))
        rows.append(Row("speed", f"50 megapixels, {ending[1:]}: MB", memory, 500.0, note="the whole process"))
    return rows


def whole_way(data: bytes) -> Track:
    """From a file to what is played."""
    robot = make_robot("delta3")
    drawn = compose(read_source("photo", data), Look())
    return track(plan_toolpath(drawn.strokes, robot, default_placement(robot), PenSettings()))


def seconds_of(work: Callable[[], Any]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def best_of(work: Callable[[], Any]) -> float:
    return min(seconds_of(work) for _ in range(REPEATS))


def peak_mb() -> float:
    """Most memory this process has had; Linux only. `getrusage` would count the parent's."""
    status = Path("/proc/self/status").read_text()
    return float(next(line for line in status.splitlines() if line.startswith("VmHWM")).split()[1]) / 1024.0


def in_child(data: bytes) -> tuple[float, float]:
    """(seconds, MB) of the whole way in a fresh process."""
    with tempfile.NamedTemporaryFile() as file:
        file.write(data)
        file.flush()
        command = [sys.executable, "-c", IN_CHILD, file.name]
        took, memory = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    return float(took), float(memory)


def resized(grey: NDArray[np.uint8], shape: tuple[int, int]) -> NDArray[np.uint8]:
    return np.asarray(cv2.resize(grey, shape[::-1], interpolation=cv2.INTER_CUBIC), np.uint8)


def encoded(grey: NDArray[np.uint8], ending: str) -> bytes:
    return cv2.imencode(ending, grey)[1].tobytes()


def played_s(path: Track) -> float:
    """How long the page's own clock plays a drawing, at its true speed."""

    async def play() -> float:
        playback = Playback(Session(Memory("delta3")))
        playback.load(path, PLAY_SPEED)
        start = time.perf_counter()
        playback.play()
        while playback.playing:
            await asyncio.sleep(0.001)
        return PLAY_SPEED * (time.perf_counter() - start)

    return asyncio.run(play())
