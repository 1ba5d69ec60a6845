"""Collects telemetry into a recording; the newest 30 minutes are kept."""

from __future__ import annotations

import math
from array import array
from collections.abc import Mapping

import numpy as np

from app.link.protocol.messages import Sample, Telemetry
from app.link.twin.recording import Recording, TestSamples
from app.robots import ROBOTS

LONGEST_S = 1800.0
RATE_HZ = 50
MAX_ROWS = round(LONGEST_S * RATE_HZ)
FORGOTTEN_ROWS = 60 * RATE_HZ
"""The oldest minute goes when the recording is full."""

MAX_SAMPLES = 5_000
"""A TEST lasts at most 5 s, with 250 samples a second."""

WRAP_US = 2**32
LOST_S = 60.0
"""A longer step of the board's clock is a board that began anew."""


class Recorder:
    """Belongs to one thread; `recording` gives a copy."""

    def __init__(
        self, robot: str, title: str = "", supply_v: float = 12.0, dimensions: Mapping[str, float] | None = None
    ) -> None:
        self._robot, self._title, self._supply_v = robot, title, supply_v
        self._dimensions = dict(dimensions or {})
        self._joints = len(ROBOTS[robot].build.joint_names)
        self._width = 4 + 3 * self._joints
        self._rows = array("d")
        self._samples = array("d")
        self._test_joint = 0
        self._clock = _BoardClock()

    @property
    def duration_s(self) -> float:
        """From the first to the last message that is kept."""
        return self._rows[-self._width] - self._rows[0] if self._rows else 0.0

    def append(self, telemetry: Telemetry, now: float, latency: float | None = None) -> None:
        """One message that came at `now` (s, any clock that goes forward); `latency` is the round trip in s."""
        time_s = self._clock.seconds(telemetry.t_us, now)
        if self._rows and time_s <= self._rows[-self._width]:
            return  # the same message once more
        n = self._joints
        self._rows.extend((time_s, *telemetry.position[:n], *telemetry.setpoint[:n], *telemetry.drive[:n]))
        self._rows.extend((telemetry.state, telemetry.flags, math.nan if latency is None else latency))
        if len(self._rows) > MAX_ROWS * self._width:
            del self._rows[: FORGOTTEN_ROWS * self._width]

    def append_sample(self, sample: Sample, now: float) -> None:
        """One reading of a TEST; those of a joint that was tested earlier are forgotten."""
        time_s = self._clock.seconds(sample.t_us, now)
        if sample.joint != self._test_joint:
            self._samples = array("d")
        self._test_joint = sample.joint
        if len(self._samples) < 3 * MAX_SAMPLES:
            self._samples.extend((time_s, sample.position, sample.drive))

    def recording(self) -> Recording:
        """Everything so far; its clock starts at the first message."""
        rows = np.array(self._rows).reshape(-1, self._width)
        start = float(rows[0, 0]) if len(rows) else 0.0
        n = self._joints
        return Recording(
            self._robot,
            self._title,
            rows[:, 0] - start,
            *np.split(rows[:, 1 : 1 + 3 * n], 3, axis=1),
            state=rows[:, -3].astype(int),
            flags=rows[:, -2].astype(int),
            latency_s=rows[:, -1],
            supply_v=self._supply_v,
            samples=self._test_samples(start if len(rows) else None),
            dimensions=dict(self._dimensions),
        )

    def _test_samples(self, start: float | None) -> TestSamples | None:
        if not self._samples:
            return None
        t, position, drive = np.array(self._samples).reshape(-1, 3).T
        order = np.flatnonzero(np.diff(t, prepend=-math.inf) > 0.0)
        begin = float(t[0]) if start is None else start
        return TestSamples(self._test_joint, t[order] - begin, position[order], drive[order])


class _BoardClock:
    """The board's 32-bit microseconds as seconds that go on; a reset board goes on at the host's time."""

    def __init__(self) -> None:
        self._last: tuple[int, float] | None = None
        self._time_s = 0.0

    def seconds(self, t_us: int, now: float) -> float:
        if self._last is not None:
            step_us = (t_us - self._last[0] + WRAP_US // 2) % WRAP_US - WRAP_US // 2
            if step_us < -1_000_000 or step_us > LOST_S * 1e6:
                self._time_s += max(now - self._last[1], 1e-3)
            else:
                self._time_s += step_us / 1e6
        self._last = (t_us, now)
        return self._time_s
