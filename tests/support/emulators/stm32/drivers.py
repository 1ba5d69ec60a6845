"""The STM32's drivers on a desktop: its functions, and its registers at the addresses of the reference manual."""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Sequence

from app.link.protocol.settings import SETTING_COUNT
from tests.support.emulators.stm32.firmware import driver_library

SPACE = 1 << 20
GPIO_A = 0x4002_0000
OUTPUT, ALTERNATE, ANALOG = 1, 2, 3


class Drivers:
    """The compiled drivers. Everything is 0 after `clear`, as a chip's registers mostly are after a reset."""

    def __init__(self) -> None:
        self.library = ctypes.CDLL(str(driver_library()))
        self._space = (ctypes.c_uint8 * SPACE).in_dll(self.library, "host_registers")

    def clear(self) -> None:
        ctypes.memset(self._space, 0, SPACE)

    def read(self, address: int) -> int:
        return self._register(address).value

    def write(self, address: int, value: int) -> None:
        self._register(address).value = value

    def emulated(self, value: bool) -> None:
        ctypes.c_uint8.in_dll(self.library, "emulated").value = value

    def call(self, name: str, *numbers: int) -> int:
        """A function of whole numbers."""
        function = getattr(self.library, name)
        function.restype = ctypes.c_uint32
        return function(*map(ctypes.c_uint32, numbers))

    def pin_mode(self, port: str, number: int) -> int:
        return self.read(_gpio(port)) >> 2 * number & 3

    def pin_function(self, port: str, number: int) -> int:
        return self.read(_gpio(port) + 0x20 + 4 * (number // 8)) >> 4 * (number % 8) & 15

    def pin_pulled_up(self, port: str, number: int) -> bool:
        return self.read(_gpio(port) + 0x0C) >> 2 * number & 3 == 1

    def pin(self, port: str, number: int) -> int:
        """The level that an output has."""
        return self.read(_gpio(port) + 0x14) >> number & 1

    def set_inputs(self, port: str, levels: int) -> None:
        self.write(_gpio(port) + 0x10, levels)

    def _register(self, address: int) -> ctypes.c_uint32:
        return ctypes.c_uint32.from_buffer(self._space, address & (SPACE - 1))


class Inputs(ctypes.Structure):
    """`dl_inputs` of the core."""

    _fields_ = (
        ("raw", ctypes.c_float * 4),
        ("limit_switches", ctypes.c_uint8),
        ("estop_open", ctypes.c_uint8),
        ("load", ctypes.c_uint8),
    )


class Machine:
    """The core's machine, in the Par4's build."""

    def __init__(self, drivers: Drivers, stored: ctypes.c_void_p | None = None) -> None:
        self._library = drivers.library
        self.memory = ctypes.create_string_buffer(8192)  # more than it needs
        build = ctypes.c_uint8.in_dll(self._library, "board_build")
        assert self._library.dl_start(self.memory, ctypes.byref(build), 0, 1, stored)

    @property
    def image(self) -> bytes:
        """As it is to be stored."""
        return bytes(self._library.dl_image_byte(self.memory, i) & 0xFF for i in range(4 * SETTING_COUNT + 2))

    @property
    def settings(self) -> tuple[float, ...]:
        return struct.unpack(f"<{SETTING_COUNT}f", self.image[:-2])

    def receive(self, data: bytes) -> None:
        for byte in data:
            self._library.dl_receive(self.memory, byte)

    def tick(self, now_us: int, raw: Sequence[float]) -> None:
        outputs = ctypes.create_string_buffer(64)
        self._library.dl_tick(self.memory, now_us, ctypes.byref(Inputs(floats(raw))), outputs)


def floats(values: Sequence[float]) -> ctypes.Array[ctypes.c_float]:
    """An argument of the drivers."""
    return (ctypes.c_float * len(values))(*values)


def _gpio(port: str) -> int:
    return GPIO_A + 0x400 * (ord(port) - ord("A"))
