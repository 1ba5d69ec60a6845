"""The text display: what is written on it, seen by a display built here from the HD44780's data sheet."""

from __future__ import annotations

import ctypes
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.robots import make_robot
from tests.support.emulators.stm32.drivers import Drivers, Machine
from tests.support.emulators.stm32.firmware import needs_drivers

pytestmark = needs_drivers

RS, E = 0x10, 0x20
LINE_STARTS = (0x00, 0x40, 0x14, 0x54)
"""Where the rows of a 20 x 4 display begin in its memory of 2 x 40 characters."""
SOURCE = ctypes.CFUNCTYPE(None, ctypes.c_uint8, ctypes.POINTER(ctypes.c_char * 20))


class TextDisplay:
    """Reads its wires when E falls; asserts that it had the time which each instruction takes."""

    def __init__(self) -> None:
        self.memory = bytearray(b" " * 0x80)
        self._address = 0
        self._upper: int | None = None
        self._four_bits = False
        self._ready_ms = 40.0
        self._wake_ups = 0
        self._wires = 0

    def wires(self, now_ms: float, wires: int) -> None:
        if self._wires & E and not wires & E:
            self._fall(now_ms, wires)
        elif wires & E and not self._wires & E:
            assert now_ms >= self._ready_ms
        self._wires = wires

    @property
    def rows(self) -> list[bytes]:
        return [bytes(self.memory[start : start + 20]) for start in LINE_STARTS]

    def _fall(self, now_ms: float, wires: int) -> None:
        half = wires & 0x0F
        if not self._four_bits:
            self._wake_up(now_ms, half)
        elif self._upper is None:
            self._upper = half
        else:
            value, self._upper = self._upper << 4 | half, None
            self._ready_ms = now_ms + 0.04
            self._write(value) if wires & RS else self._instruct(now_ms, value)

    def _wake_up(self, now_ms: float, half: int) -> None:
        self._wake_ups += half == 3
        assert half == (3 if self._wake_ups < 3 or half == 3 else 2)
        self._ready_ms = now_ms + (4.1 if self._wake_ups == 1 else 0.1)
        self._four_bits = half == 2

    def _write(self, value: int) -> None:
        self.memory[self._address] = value
        self._address = {0x27: 0x40, 0x67: 0x00}.get(self._address, self._address + 1)

    def _instruct(self, now_ms: float, value: int) -> None:
        if value & 0x80:
            self._address = value & 0x7F
        elif value == 0x01:
            self.memory[:], self._address = b" " * 0x80, 0
            self._ready_ms = now_ms + 1.52
        else:
            assert value in (0x28, 0x0C, 0x06)  # 4 bits and two lines; on, no cursor; from left to right


def test_rows_appear_on_a_display(drivers: Drivers):
    texts = [bytes(range(65 + row, 85 + row)) for row in range(4)]

    @SOURCE
    def source(row, text):
        text.contents[:] = texts[row]

    state, shown = ctypes.create_string_buffer(64), TextDisplay()
    drivers.library.display_step.restype = ctypes.c_uint8
    for now_ms in range(600):
        shown.wires(now_ms, drivers.library.display_step(state, source))
    assert shown.rows == texts
    texts.reverse()
    for now_ms in range(600, 1300):
        shown.wires(now_ms, drivers.library.display_step(state, source))
    assert shown.rows == texts


def test_joints_and_pose_appear_on_the_boards_pins(drivers: Drivers):
    robot, pose, machine = make_robot("par4"), (0.03, -0.05, -0.32, 0.2), Machine(drivers)
    offsets, scales = machine.settings[7:40:10], machine.settings[8:40:10]
    joints = robot.inverse(pose).tolist()
    machine.tick(1000, [(q - offset) / scale for q, offset, scale in zip(joints, offsets, scales, strict=True)])
    drivers.call("panel_start")
    assert all(drivers.pin_mode("E", pin) == 1 for pin in (2, 4, 5, 6, 7, 8))
    shown = TextDisplay()
    for now_ms in range(600):
        drivers.library.panel_step(machine.memory)
        data = sum(drivers.pin("E", 5 + i) << i for i in range(4))
        shown.wires(now_ms, data | RS * drivers.pin("E", 2) | E * drivers.pin("E", 4))
    found = [row.decode("latin-1") for row in shown.rows]
    for row, (text, axis, value) in enumerate(zip(found, "XYZ\xf2", (30.0, -50.0, -320.0, 11.459), strict=True)):
        assert text[0] == str(row + 1) and text[13] == axis
        assert float(text[14:]) == pytest.approx(value, abs=0.0501)
        assert float(text[1:7]) == float(text[7:13]) == pytest.approx(math.degrees(joints[row]), abs=0.0501)


@pytest.mark.parametrize(
    ("row", "values", "text"),
    [
        (0, (-23.0166, -22.96, 100.0), b"1 -23.0 -23.0X 100.0"),
        (1, (26.3939, 26.4, -36.0), b"2  26.4  26.4Y -36.0"),
        (2, (0.0, -0.04, -300.04), b"3   0.0   0.0Z-300.0"),
        (3, (1980.04, math.nan, -0.05), b"41980.0   ---\xf2  -0.1"),
    ],
)
def test_a_row(drivers: Drivers, row, values, text):
    found = ctypes.create_string_buffer(20)
    drivers.library.display_row(found, row, *map(ctypes.c_float, values))
    assert found.raw == text


@given(st.floats(width=32))
def test_a_number_is_rounded_as_python_does_it_or_is_dashes(compiled_drivers, number):
    found = tenths(compiled_drivers, number, 6)
    wanted = f"{number:6.1f}"
    if found.strip() == "---":
        assert not math.isfinite(number) or len(wanted) > 6
    else:
        assert abs(float(found) - number) <= 0.0501
        assert len(found) == 6 and "-0.0" not in found


@pytest.mark.parametrize(
    ("number", "text"), [(9999.0, "9999.0"), (-999.9, "-999.9"), (-9999.0, "   ---"), (1e5, "   ---")]
)
def test_numbers_at_the_edge_of_their_room(drivers, number, text):
    assert tenths(drivers, number, 6) == text


def tenths(drivers: Drivers, number: float, width: int) -> str:
    text = ctypes.create_string_buffer(width)
    drivers.library.write_tenths(text, width, ctypes.c_float(number))
    return text.raw.decode()
