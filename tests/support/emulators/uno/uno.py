"""An Arduino Uno in simavr, in this process: time moves only in `run`, so that everything repeats bit by bit.

simavr is under the GPL: a test tool, never part of the package.
"""

from __future__ import annotations

import ctypes
import subprocess
from ctypes import POINTER, c_char_p, c_int, c_int32, c_uint8, c_uint16, c_uint32, c_uint64, c_void_p
from pathlib import Path
from typing import Any

from tests.support.emulators.uno.build import simulator

CYCLES_PER_US = 16
EEPROM_BYTES = 1024
FLASH_WORDS = 16 * 1024

_SIGNATURES: dict[str, tuple[Any, list[Any]]] = {
    "uno_new": (c_void_p, [c_char_p]),
    "uno_free": (None, [c_void_p]),
    "uno_run": (c_int, [c_void_p, c_uint32]),
    "uno_reset": (None, [c_void_p, c_uint32]),
    "uno_bootloader_clears_cause": (None, [c_void_p, c_int]),
    "uno_cycles": (c_uint64, [c_void_p]),
    "uno_cycles_slept": (c_uint64, [c_void_p]),
    "uno_resets": (c_uint32, [c_void_p]),
    "uno_send": (None, [c_void_p, c_char_p, c_uint32]),
    "uno_take": (c_uint32, [c_void_p, c_char_p, c_uint32]),
    "uno_unsent": (c_uint32, [c_void_p]),
    "uno_analog": (None, [c_void_p, c_uint8, c_uint32]),
    "uno_drive_pin": (None, [c_void_p, c_uint8, c_uint8]),
    "uno_level": (c_uint8, [c_void_p, c_uint8]),
    "uno_rises": (c_uint32, [c_void_p, c_uint8]),
    "uno_pulse": (c_uint32, [c_void_p, c_uint8]),
    "uno_risen": (c_uint64, [c_void_p, c_uint8]),
    "uno_pwm": (c_uint8, [c_void_p, c_uint8]),
    "uno_count_steps": (None, [c_void_p, c_uint8, c_uint8]),
    "uno_steps": (c_int32, [c_void_p, c_uint8]),
    "uno_peek": (c_uint8, [c_void_p, c_uint16]),
    "uno_poke": (None, [c_void_p, c_uint16, c_uint8]),
    "uno_eeprom": (None, [c_void_p, c_char_p, c_uint32, c_int]),
    "uno_jump": (None, [c_void_p, c_uint32]),
    "uno_profile": (None, [c_void_p, POINTER(c_uint32)]),
    "uno_watch": (None, [c_void_p, c_uint32]),
    "uno_longest": (c_uint32, [c_void_p]),
    "uno_longest_masked": (c_uint32, [c_void_p]),
}


class UnoSim:
    """One Uno with its firmware. Pins have Arduino's numbers, A0 is 14."""

    def __init__(self, elf: Path, eeprom: bytes | None = None) -> None:
        self._elf = elf
        self._lib = ctypes.CDLL(str(simulator()))
        for name, (result, arguments) in _SIGNATURES.items():
            getattr(self._lib, name).restype, getattr(self._lib, name).argtypes = result, arguments
        self._uno: int | None = self._lib.uno_new(str(elf).encode())
        if not self._uno:
            raise RuntimeError(f"simavr cannot read the firmware {elf}.")
        self._symbols: dict[str, int] | None = None
        if eeprom is not None:
            self._lib.uno_eeprom(self._uno, eeprom, len(eeprom), 1)

    def close(self) -> None:
        """Free the simulator; twice does no harm."""
        if self._uno:
            self._lib.uno_free(self._uno)
        self._uno = None

    def run(self, us: int) -> None:
        """Let the processor run for this time."""
        if self._lib.uno_run(self._uno, us):
            raise RuntimeError("The simulated processor crashed.")

    def reset(self, boot_ms: int = 0) -> None:
        """As the button and DTR do; memory stays, the bootloader takes `boot_ms` and swallows what is sent to it."""
        self._lib.uno_reset(self._uno, 1000 * boot_ms)

    def clear_reset_cause(self) -> None:
        """From now on behave as with the genuine Uno's bootloader, which clears MCUSR."""
        self._lib.uno_bootloader_clears_cause(self._uno, 1)

    @property
    def now_us(self) -> float:
        """Since the power came."""
        return self._lib.uno_cycles(self._uno) / CYCLES_PER_US

    @property
    def slept_us(self) -> float:
        """Of it, how long the processor slept."""
        return self._lib.uno_cycles_slept(self._uno) / CYCLES_PER_US

    @property
    def resets(self) -> int:
        """By watchdog or line, since the power came."""
        return self._lib.uno_resets(self._uno)

    def send(self, data: bytes) -> None:
        """Bytes for the serial port; they reach the processor at the line's pace."""
        self._lib.uno_send(self._uno, data, len(data))

    @property
    def unsent(self) -> int:
        """How many bytes are still on their way."""
        return self._lib.uno_unsent(self._uno)

    def take(self) -> bytes:
        """What the board has sent since the last call."""
        buffer = ctypes.create_string_buffer(4096)
        count = self._lib.uno_take(self._uno, buffer, len(buffer))
        return buffer.raw[:count]

    def analog(self, channel: int, volts: float) -> None:
        """The voltage on A0 to A5."""
        self._lib.uno_analog(self._uno, channel, round(1000 * min(max(volts, 0.0), 5.0)))

    def drive_pin(self, pin: int, high: bool) -> None:
        """Hold an input high or low."""
        self._lib.uno_drive_pin(self._uno, pin, high)

    def level(self, pin: int) -> bool:
        return bool(self._lib.uno_level(self._uno, pin))

    def rises(self, pin: int) -> int:
        """How often the pin rose."""
        return self._lib.uno_rises(self._uno, pin)

    def pulse_us(self, pin: int) -> float:
        """Length of the last high pulse."""
        return self._lib.uno_pulse(self._uno, pin) / CYCLES_PER_US

    def risen_us(self, pin: int) -> float:
        """When the pin last rose."""
        return self._lib.uno_risen(self._uno, pin) / CYCLES_PER_US

    def pwm(self, pin: int) -> float:
        """Share of the time that the pin is high, 0..1."""
        return self._lib.uno_pwm(self._uno, pin) / 255

    def count_steps(self, pin: int, direction: int) -> None:
        """From now on count rising edges of `pin`, up while `direction` is high."""
        self._lib.uno_count_steps(self._uno, pin, direction)

    def steps(self, pin: int) -> int:
        return self._lib.uno_steps(self._uno, pin)

    @property
    def eeprom(self) -> bytes:
        buffer = ctypes.create_string_buffer(EEPROM_BYTES)
        self._lib.uno_eeprom(self._uno, buffer, EEPROM_BYTES, 0)
        return buffer.raw

    def symbol(self, name: str) -> int:
        """Address of a variable or function of the firmware."""
        if self._symbols is None:
            listing = subprocess.run(["avr-nm", str(self._elf)], capture_output=True, text=True, check=True).stdout
            rows = [line.split() for line in listing.splitlines()]
            self._symbols = {row[2].split(".")[0]: int(row[0], 16) for row in rows if len(row) == 3}
        demangled = {key.removeprefix("_ZL").lstrip("0123456789"): at for key, at in self._symbols.items()}
        address = demangled.get(name, demangled.get(f"{name}v"))
        if address is None:
            raise KeyError(f"{name} is not in {self._elf.name}")
        return address

    def variable(self, name: str, size: int = 1) -> int:
        """Value of an unsigned variable of the firmware."""
        at = self.symbol(name) & 0xFFFF
        return sum(self._lib.uno_peek(self._uno, at + i) << 8 * i for i in range(size))

    def hang(self, interrupts: bool = True) -> None:
        """The program runs in a circle from now on, with or without interrupts."""
        self._lib.uno_jump(self._uno, self.symbol("__stop_program" if interrupts else "_exit"))

    def profile(self, function: str) -> ctypes.Array[c_uint32]:
        """From now on (slowly) sum up cycles by flash word, and time each call of `function`."""
        self._cycles_at = (c_uint32 * FLASH_WORDS)()
        self._lib.uno_profile(self._uno, self._cycles_at)
        self._lib.uno_watch(self._uno, self.symbol(function))
        return self._cycles_at

    @property
    def longest_us(self) -> float:
        """Of a call of the profiled function, interrupts included."""
        return self._lib.uno_longest(self._uno) / CYCLES_PER_US

    @property
    def longest_masked_us(self) -> float:
        """For how long interrupts were off at a stretch, since `profile`."""
        return self._lib.uno_longest_masked(self._uno) / CYCLES_PER_US
