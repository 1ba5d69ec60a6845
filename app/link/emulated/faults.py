"""What can be wrong with an emulated board, its wires and its cable; each can be switched on while it runs."""

from __future__ import annotations

import random
from collections import deque
from dataclasses import dataclass


@dataclass(frozen=True)
class Faults:
    """The defaults are a healthy board. Joints count from 0."""

    noise: float = 0.0
    """Share of the bytes that are garbled, both ways."""
    loss: float = 0.0
    """Share of the bytes that get lost, both ways."""
    delay_s: float = 0.0
    """Each way."""
    stuck_joint: int | None = None
    """Something holds this joint."""
    limit_switch: int | None = None
    """The switch of this joint is closed, wherever the joint is."""
    estop: bool = False
    """The emergency stop is pressed."""
    sensor_broken: int | None = None
    """The wire of this joint's potentiometer is broken: it reads 0."""
    unplugged: bool = False
    """The cable is pulled; the board runs on."""


class Line:
    """One direction of the cable."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self._under_way: deque[tuple[float, bytes]] = deque()

    def put(self, data: bytes, now_s: float, faults: Faults) -> None:
        """Bytes enter the cable."""
        if faults.noise or faults.loss:
            data = self._spoilt(data, faults)
        if data and not faults.unplugged:
            self._under_way.append((now_s + faults.delay_s, data))

    def get(self, now_s: float) -> bytes:
        """Bytes that have come to its end by now."""
        if not self._under_way:
            return b""
        arrived = []
        while self._under_way and self._under_way[0][0] <= now_s:
            arrived.append(self._under_way.popleft()[1])
        return b"".join(arrived)

    def cut(self) -> None:
        """What is under way is lost."""
        self._under_way.clear()

    def _spoilt(self, data: bytes, faults: Faults) -> bytes:
        draw = self._random.random
        kept = [byte for byte in data if draw() >= faults.loss]
        return bytes(byte ^ self._random.randrange(1, 256) if draw() < faults.noise else byte for byte in kept)
