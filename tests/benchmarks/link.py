"""The serial link in figures: the firmware in its emulators, pyserial between it and the host.

Real time on a computer that also emulates the boards: what is measured is an upper bound for a board on USB.

    python tests/benchmarks/link.py --seconds 10
"""

from __future__ import annotations

import math
import statistics
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass

import numpy as np
import tyro

from app.link.lease import Person
from app.link.link import RobotLink
from app.link.programs import Program
from app.link.protocol.codes import Flag, MessageType, State, TargetKind
from app.link.protocol.frames import FrameDecoder
from app.link.protocol.messages import Setpoint
from app.link.transport import Transport, open_transport
from app.robots import make_robot
from tests.support.emulators.stm32.firmware import firmware as stm32_firmware
from tests.support.emulators.stm32.qemu import running_stm32
from tests.support.emulators.uno.build import VARIANTS
from tests.support.emulators.uno.build import firmware as uno_firmware
from tests.support.emulators.uno.live import UnoPty
from tests.support.emulators.uno.rig import Rig

ANN = Person("ann", "Ann")
WRITTEN: list[float] = []
"""When set-points were written, s."""


@dataclass(frozen=True)
class Options:
    """Measure the serial link."""

    seconds: float = 8.0
    """Length of the motion that is measured."""
    stops: int = 10
    """How often Stop is pressed."""


def main(options: Options) -> None:
    print("Sizes, bytes")
    for variant in VARIANTS:
        print(f"  Uno {variant:<16} {_size('avr-size', str(uno_firmware(variant)))}")
    print(f"  STM32 par4_dc        {_size('arm-none-eabi-size', str(stm32_firmware('par4_dc')))}")
    print("The Uno's processor under 100 set-points a second, percent")
    for variant in VARIANTS:
        shares = [f"{kind.name.lower()} {_processor(variant, kind):.0f}" for kind in TargetKind]
        print(f"  {variant:<20} {', '.join(shares)}")
    with closing(UnoPty("delta3_dc", 300)) as uno:
        _measure("Uno (simavr), pty", uno.port, options, lambda: list(uno.rig.plant.joints))
    with running_stm32("par4_dc") as stm32:
        _measure("STM32 (QEMU), socket", stm32.port, options, lambda: list(stm32.plant.joints))
    _measure("emulated board in the host", "sim:delta3?drive=dc", options, None)


def _size(program: str, elf: str) -> str:
    row = subprocess.run([program, elf], capture_output=True, text=True, check=True).stdout.splitlines()[1].split()
    text, data, bss = map(int, row[:3])
    return f"flash {text + data:6d}, static RAM {data + bss:5d}"


def _processor(variant: str, kind: TargetKind) -> float:
    """Measured by the cycles that the simulated processor did not sleep."""
    robot = make_robot("linear" if variant == "linear_stepper" else "delta3")
    x, y, z = robot.home.tolist()
    with closing(Rig(variant)) as rig:
        rig.make_ready()
        slept, begin = rig.uno.slept_us, rig.uno.now_us
        for k in range(200):
            angle = 0.03 * k
            pose = x + 0.02 * (math.cos(angle) - 1), y + 0.02 * math.sin(angle), z
            target = pose if kind is TargetKind.POSE else tuple(robot.inverse(pose).tolist())
            rig.send(Setpoint(kind, target))
            rig.run(0.01)
        return 100 * (1 - (rig.uno.slept_us - slept) / (rig.uno.now_us - begin))


def _measure(title: str, port: str, options: Options, joints: Callable[[], list[float]] | None) -> None:
    print(title)
    with _homed(port) as link:
        gaps = _move(link, options.seconds)
        status = link.status
        print(f"  set-point to telemetry that names it: median {status.round_trip_ms:.1f} ms, "
              f"p95 {status.round_trip_p95_ms:.1f} ms")  # fmt: skip
        print(f"  between two set-points written: {_spread(gaps)}")
        print(f"  bad frames: {status.telemetry.bad if status.telemetry else '?'} on the board")
        times = [_stop(link, joints) for _ in range(options.stops)]
        for name, values in zip(("told", "at rest"), zip(*times, strict=True), strict=True):
            shown = [value for value in values if value == value]
            if shown:
                print(f"  Stop until {name}: median {1e3 * statistics.median(shown):.0f} ms, "
                      f"worst {1e3 * max(shown):.0f} ms")  # fmt: skip


@contextmanager
def _homed(port: str) -> Iterator[RobotLink]:
    link = RobotLink(open_port=lambda name: _Timed(open_transport(name)))
    over = threading.Event()
    living = threading.Thread(target=_live, args=(link, over), daemon=True)
    try:
        link.connect(port).result(8.0)
        link.request(ANN).result(2.0)
        living.start()
        _make_ready(link)
        yield link
    finally:
        over.set()
        link.close()


def _live(link: RobotLink, over: threading.Event) -> None:
    """Signs of life, as of a page."""
    while not over.wait(1.0):
        link.alive(ANN)


def _make_ready(link: RobotLink) -> None:
    """A busy computer may need more than one attempt."""
    deadline = time.monotonic() + 30.0
    while time.monotonic() < deadline:
        telemetry = link.status.telemetry
        if telemetry is None:
            time.sleep(0.05)
            continue
        if telemetry.state is State.READY and Flag.HOMED in telemetry.flags:
            return
        steps = {State.OFF: link.enable, State.HELD: link.resume, State.READY: link.home}
        steps |= {State.STOPPED: link.clear, State.FAULT: link.clear}
        if link.status.activity == "paused":
            link.cancel(ANN).exception(2.0)
        if telemetry.state in steps:
            steps[telemetry.state](ANN).exception(2.0)
        time.sleep(0.1)
    raise RuntimeError(f"the robot does not get ready: {link.status.sentence}")


def _wave(link: RobotLink, seconds: float) -> Program:
    robot = link.status.robot
    assert robot is not None
    t = np.arange(0.0, seconds, 0.005)
    bump = 0.12 * np.sin(np.pi * t / seconds) ** 2
    q = robot.inverse(robot.home) + bump[:, None]
    return Program("Wave", robot.name, t, q, np.zeros(len(t), dtype=bool), np.zeros(len(t)))


def _move(link: RobotLink, seconds: float) -> list[float]:
    """Run a wave; gives the ms between the set-points that were written."""
    WRITTEN.clear()
    link.run(ANN, _wave(link, seconds)).result(4.0)
    while link.status.activity != "idle":
        time.sleep(0.05)
    return (1e3 * np.diff(WRITTEN)).tolist()


def _spread(gaps_ms: list[float]) -> str:
    gaps = np.array(gaps_ms)
    return f"mean {gaps.mean():.2f} ms, sd {gaps.std():.2f} ms, p99 {np.percentile(gaps, 99):.1f} ms"


class _Timed:
    """A transport that notes when set-points are written."""

    def __init__(self, inner: Transport) -> None:
        self._inner, self.name = inner, inner.name
        self.read, self.close = inner.read, inner.close

    def write(self, data: bytes) -> None:
        if any(payload[0] == MessageType.SETPOINT for payload in FrameDecoder().feed(data)):
            WRITTEN.append(time.perf_counter())
        self._inner.write(data)


def _stop(link: RobotLink, joints: Callable[[], list[float]] | None) -> tuple[float, float]:
    """Seconds from the call until telemetry tells STOPPED, and until the true joints rest (NaN where unknown)."""
    _make_ready(link)
    link.run(ANN, _wave(link, 3.0)).result(4.0)
    time.sleep(1.0)
    begin = time.perf_counter()
    link.stop(ANN)
    while (telemetry := link.status.telemetry) is None or telemetry.state is not State.STOPPED:
        time.sleep(0.001)
    told = time.perf_counter() - begin
    if joints is None:
        return told, math.nan
    moved = begin
    before = joints()
    while time.perf_counter() - moved < 0.15:
        now = joints()
        if max(abs(a - b) for a, b in zip(now, before, strict=True)) > 3e-3:
            moved, before = time.perf_counter(), now
        time.sleep(0.002)
    return told, moved - begin


if __name__ == "__main__":
    main(tyro.cli(Options))
