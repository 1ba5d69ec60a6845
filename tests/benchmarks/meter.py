"""Processor time of a server, of the benchmark itself, and of whatever else runs on the machine."""

from __future__ import annotations

import time
from dataclasses import dataclass

import psutil


@dataclass(frozen=True)
class Load:
    """Means over a stretch of time, in percent of one core, and the server's memory at its end."""

    server_pct: float
    bench_pct: float
    """The benchmark's own load: near 100 the latencies are its own."""
    others_pct: float
    """Everything else, also what the host of a virtual machine takes away: it should be next to nothing."""
    server_rss_mb: float


class Meter:
    """Measures from its making until `read`."""

    def __init__(self, server_pid: int) -> None:
        self._server, self._bench = psutil.Process(server_pid), psutil.Process()
        self._since, self._before = time.perf_counter(), self._seconds_used()

    def read(self) -> Load:
        elapsed = time.perf_counter() - self._since
        server, bench, machine = (
            100 * (now - before) / elapsed for now, before in zip(self._seconds_used(), self._before, strict=True)
        )
        memory = self._server.memory_info().rss / 1e6
        return Load(server, bench, max(0.0, machine - server - bench), memory)

    def _seconds_used(self) -> tuple[float, float, float]:
        machine, server, bench = psutil.cpu_times(), self._server.cpu_times(), self._bench.cpu_times()
        return (
            server.user + server.system,
            bench.user + bench.system,
            machine.user + machine.system + machine.nice + getattr(machine, "steal", 0.0),
        )
