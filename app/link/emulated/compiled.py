"""The firmware's own core, compiled for this computer."""

from __future__ import annotations

import ctypes
import functools
from collections.abc import Callable
from typing import Any

from app.link.emulated.core import Outputs
from app.link.errors import LinkError
from app.link.firmware.build import build_host_library
from app.link.protocol.codes import BoardKind, DriveKind, Reset, RobotKind
from app.link.protocol.frames import FRAME_MAX
from app.link.protocol.settings import SETTING_COUNT

IMAGE_BYTES = 4 * SETTING_COUNT + 2
_ROOM = 32 * FRAME_MAX

_Raw = ctypes.c_float * 4
_Out = ctypes.c_float * 7


class CompiledCore:
    """See `app.link.emulated.core.Core`. The library behind it is built when the first one is made."""

    def __init__(self) -> None:
        self._library = load_library()
        self._machine = self._library.dlh_new()
        if not self._machine:
            raise MemoryError("There is no memory for another emulated board.")
        self._tick: Callable[..., None] = self._library.dlh_tick
        self._raw, self._out = _Raw(), _Out()
        self._bytes = ctypes.create_string_buffer(_ROOM)

    def __del__(self) -> None:
        if getattr(self, "_machine", None):
            self._library.dlh_free(self._machine)

    def start(
        self,
        robot: RobotKind,
        drive: DriveKind,
        board: BoardKind,
        period_us: int,
        serial: int,
        reset: Reset,
        stored: bytes | None,
    ) -> None:
        """As after a reset.

        Raises:
            LinkError: for a robot that is not built with this drive, or an image of another size.
        """
        if stored is not None and len(stored) != IMAGE_BYTES:
            raise LinkError(f"A board's memory holds {IMAGE_BYTES} bytes, not {len(stored)}; start without them.")
        if not self._library.dlh_start(self._machine, robot, drive, board, period_us, serial, reset, stored):
            raise LinkError(f"There is no {robot.name} with {drive.name} drives; choose another drive.")

    def receive(self, data: bytes) -> None:
        self._library.dlh_receive(self._machine, data, len(data))

    def tick(self, now_us: int, raw: tuple[float, ...], limit_switches: int, estop_open: bool) -> Outputs:
        self._raw[:] = raw
        self._tick(self._machine, now_us & 0xFFFFFFFF, self._raw, limit_switches, estop_open, self._out)
        powered, a, b, c, d, pen_us, laser = self._out
        return Outputs(powered != 0.0, (a, b, c, d), pen_us, laser)

    def transmit(self) -> bytes:
        count = self._library.dlh_transmit(self._machine, self._bytes, _ROOM)
        return self._bytes.raw[:count] if count else b""

    def image(self) -> bytes:
        """(306,) bytes."""
        image = ctypes.create_string_buffer(IMAGE_BYTES)
        self._library.dlh_image(self._machine, image)
        return image.raw

    def take_save_request(self) -> bool:
        return bool(self._library.dlh_take_save_request(self._machine))


@functools.cache
def load_library() -> Any:
    """The library, its calls declared."""
    library = ctypes.CDLL(str(build_host_library()))
    machine, number, count = ctypes.c_void_p, ctypes.c_int, ctypes.c_uint32
    text, floats = ctypes.c_char_p, ctypes.POINTER(ctypes.c_float)
    declared: dict[str, tuple[Any, tuple[Any, ...]]] = {
        "dlh_new": (machine, ()),
        "dlh_free": (None, (machine,)),
        "dlh_start": (number, (machine, number, number, number, number, count, number, text)),
        "dlh_receive": (None, (machine, text, count)),
        "dlh_tick": (None, (machine, count, floats, number, number, floats)),
        "dlh_transmit": (count, (machine, text, count)),
        "dlh_image": (None, (machine, text)),
        "dlh_take_save_request": (number, (machine,)),
        "dlh_machine_bytes": (count, ()),
        "dlh_encode": (count, (text, count, text)),
        "dlh_decode": (count, (text, count, text, ctypes.POINTER(count))),
        "dl_inverse": (ctypes.c_uint8, (ctypes.c_uint8, floats, floats, floats)),
        "dl_forward_guess": (None, (ctypes.c_uint8, floats, floats, floats)),
        "dl_forward_step": (ctypes.c_float, (ctypes.c_uint8, floats, floats, floats)),
        "dl_pid_step": (ctypes.c_float, (floats, floats, *(ctypes.c_float,) * 3)),
    }
    for name, (result, arguments) in declared.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library
