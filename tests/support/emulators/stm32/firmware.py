"""The STM32's firmware, and its drivers for the desktop, compiled once and kept by a hash of their sources."""

from __future__ import annotations

import functools
import subprocess
from pathlib import Path

from tests.support.emulators.cache import kept, run
from tests.support.imports import ROOT
from tests.support.tools import needs

FIRMWARE = ROOT / "app" / "link" / "firmware"
HERE = Path(__file__).parent
CORE = FIRMWARE / "deltalab" / "src" / "core"
VARIANTS = ("par4_dc", "fivebar_dc", "linear_stepper")
DRIVERS = "stm32-drivers.so"
needs_drivers = needs("gcc")
"""For tests of the drivers on a desktop."""
needs_stm32 = needs("make", "arm-none-eabi-gcc", "qemu-system-arm")
"""For tests that emulate an STM32."""


@functools.cache
def firmware(variant: str = "par4_dc") -> Path:
    """The ELF file, with symbols, of one of the variants."""
    return kept("stm32", _sources(), _make) / f"stm32_{variant}.elf"


@functools.cache
def driver_library() -> Path:
    """The drivers as a shared library; the processor's registers are an array in it."""
    return kept("drivers", _sources(), _compile_drivers) / DRIVERS


def symbol(elf: Path, name: str) -> int:
    """Where the linker put something."""
    table = subprocess.run(["arm-none-eabi-nm", elf], check=True, capture_output=True, text=True).stdout
    return next(int(line.split()[0], 16) for line in table.splitlines() if line.split()[-1] == name)


def _make(folder: Path) -> None:
    for variant in VARIANTS:
        run(["make", "-C", str(FIRMWARE), "stm32", f"BUILD={folder}", f"VARIANT={variant}"])


def _compile_drivers(folder: Path) -> None:
    apart = {"main.c", "startup.c"}
    sources = [path for path in sorted((FIRMWARE / "stm32").glob("*.c")) if path.name not in apart]
    flags = ["-std=gnu99", "-O1", "-fPIC", "-shared", "-Wall", "-Wextra", "-Werror", "-DDL_HOST_REGISTERS"]
    include = [f"-I{CORE}", f"-I{FIRMWARE / 'stm32'}"]
    files = [*sources, *sorted(CORE.glob("*.c")), HERE / "registers.c"]
    run(["gcc", *flags, *include, *map(str, files), "-lm", "-o", str(folder / DRIVERS)])


def _sources() -> list[Path]:
    found = [path for folder in (FIRMWARE / "stm32", CORE) for path in folder.iterdir()]
    return [
        *(path for path in found if path.suffix in (".c", ".h", ".ld")),
        FIRMWARE / "stm32.mk",
        HERE / "registers.c",
    ]
