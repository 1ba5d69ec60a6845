"""The STM32's firmware in QEMU, with a machine around it: its serial line is a socket or a pseudo terminal.

QEMU has no converter, PWM or pins: firmware/stm32/emulator.h says what stands in for them. A thread here carries
drives to the plant and sensors back, some 400 times a second.
"""

from __future__ import annotations

import re
import socket
import subprocess
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from app.link.protocol.codes import DriveKind
from tests.support.emulators.stm32.firmware import firmware, symbol
from tests.support.emulators.stm32.memory import Memory
from tests.support.emulators.stm32.plant import Plant

OUTPUTS = "<II4fff"
"""Control periods made, powered, drives, the pen's pulse, the laser."""
INPUTS, INPUTS_AT = "<4f3I", 32
"""Raw sensors, limit switches, emergency stop open, cause of the next reset."""
PACE_S = 0.002
START_S = 20.0
LINE_RESET, WATCHDOG_RESET = 1, 2


@dataclass(frozen=True)
class Outputs:
    """What the processor does at the moment."""

    ticks: int
    """Control periods since power on, modulo 2^32."""
    powered: bool
    drive: tuple[float, ...]
    pen_us: float
    laser: float


class Stm32:
    """A running board. Its plant's faults may be changed at any time."""

    def __init__(self, port: str, plant: Plant, memory: Memory, sim: int, monitor: socket.socket) -> None:
        self.port = port
        """As pyserial's `serial_for_url` takes it."""
        self.plant = plant
        self._memory, self._sim, self._monitor = memory, sim, monitor
        self._outputs = self._read()
        self._cause, self._rounds = LINE_RESET, 0
        self._failure: Exception | None = None
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._carry, name="plant", daemon=True)
        self._thread.start()

    @property
    def outputs(self) -> Outputs:
        """The newest."""
        if self._failure:
            raise self._failure
        return self._outputs

    def reset(self, cause: int = LINE_RESET) -> None:
        """As by its button, or by its watchdog, which QEMU does not have."""
        self._cause, seen = cause, self._rounds
        while self._rounds < seen + 2 and self.outputs:
            time.sleep(PACE_S)
        self._monitor.sendall(b"system_reset\n")

    def close(self) -> None:
        self._ending.set()
        self._thread.join(10.0)

    def _carry(self) -> None:
        try:
            while not self._ending.wait(PACE_S):
                self._exchange()
        except (OSError, ValueError) as failure:
            self._failure = failure

    def _exchange(self) -> None:
        """The plant's clock are the processor's control periods: both may be late, but never apart."""
        before, self._outputs = self._outputs, self._read()
        periods = (self._outputs.ticks - before.ticks) % 2**32
        self.plant.run(periods, self._outputs.powered, self._outputs.drive)
        seen = self.plant.sensors()
        inputs = *seen.raw, seen.switches, seen.estop_open, self._cause
        self._memory.write(self._sim + INPUTS_AT, INPUTS, *inputs)
        self._rounds += 1

    def _read(self) -> Outputs:
        ticks, powered, *rest = self._memory.read(self._sim, OUTPUTS)
        return Outputs(int(ticks), bool(powered), tuple(rest[:4]), rest[4], rest[5])


@contextmanager
def running_stm32(variant: str = "par4_dc", line: Literal["tcp", "pty"] = "tcp", *options: str) -> Iterator[Stm32]:
    """A board that has just got power, until the end of the `with`."""
    elf = firmware(variant)
    with ExitStack() as cleanup:
        folder = Path(cleanup.enter_context(tempfile.TemporaryDirectory()))
        process, port = _start(elf, folder, line, options, cleanup)
        memory = Memory(_connected(folder / "qtest", process))
        cleanup.callback(memory.close)
        monitor = cleanup.enter_context(_connected(folder / "monitor", process))
        robot, _, drive = variant.partition("_")
        plant = Plant(robot, DriveKind[drive.upper()])
        board = Stm32(port, plant, memory, symbol(elf, "sim"), monitor)
        cleanup.callback(board.close)
        yield board


def _start(
    elf: Path, folder: Path, line: str, options: tuple[str, ...], cleanup: ExitStack
) -> tuple[subprocess.Popen[str], str]:
    """QEMU, and the port that leads to its serial line."""
    command = ["qemu-system-arm", "-M", "netduinoplus2", "-kernel", str(elf), "-nographic", *options]
    for name in ("qtest", "monitor"):
        command += [f"-{name}", f"unix:{folder / name},server=on,wait=off"]
    command += ["-qtest-log", "none", "-serial", "null"]  # USART1; the one after it is USART2
    if line == "pty":
        process = _spawn([*command, "-serial", "pty"], (), cleanup)
        assert process.stdout
        found = re.search(r"redirected to (\S+)", process.stdout.readline())
        assert found, "QEMU named no pseudo terminal"
        return process, found[1]
    listener = cleanup.enter_context(socket.create_server(("127.0.0.1", 0)))
    listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # inherited; without it an answer takes 40 ms
    fd = listener.fileno()
    command += ["-chardev", f"socket,id=line,fd={fd},server=on,wait=off", "-serial", "chardev:line"]
    return _spawn(command, (fd,), cleanup), f"socket://127.0.0.1:{listener.getsockname()[1]}"


def _spawn(command: list[str], fds: tuple[int, ...], cleanup: ExitStack) -> subprocess.Popen[str]:
    process = subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, pass_fds=fds
    )
    cleanup.callback(_end, process)
    return process


def _end(process: subprocess.Popen[str]) -> None:
    process.kill()
    process.communicate()


def _connected(path: Path, process: subprocess.Popen[str]) -> socket.socket:
    """QEMU makes its sockets while it starts."""
    deadline = time.monotonic() + START_S
    while True:
        connection = socket.socket(socket.AF_UNIX)
        try:
            connection.connect(str(path))
            return connection
        except OSError:
            connection.close()
            if process.poll() is not None or time.monotonic() > deadline:
                raise
            time.sleep(0.01)
